#include "hooke/working_mesh/vertex_table.h"

#include <utility>

#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

enum class RowOf { vertex, wedge };

/// Calls use(row, empty, column) for each column: `column` tells where it is in a table, and `empty` is the
/// value of a new row. The only list of the columns.
void for_each_column(const auto& use) {
  use(RowOf::vertex, 0., [](auto& t) { return &t.positions.points; });
  use(RowOf::vertex, 0, [](auto& t) { return &t.positions.segments; });
  use(RowOf::vertex, 0., [](auto& t) { return &t.positions.drift; });
  use(RowOf::wedge, 0., [](auto& t) { return &t.positions.normals; });
  use(RowOf::wedge, 0, [](auto& t) { return &t.positions.hints; });
  use(RowOf::vertex, Freedom::fixed, [](auto& t) { return &t.constraints.freedom; });
  use(RowOf::vertex, -1, [](auto& t) { return &t.constraints.curve; });
  use(RowOf::vertex, char{0}, [](auto& t) { return &t.constraints.frozen; });
  use(RowOf::vertex, std::optional<Freedom>(), [](auto& t) { return &t.constraints.held; });
  use(RowOf::vertex, -1, [](auto& t) { return &t.constraints.junction; });
  use(RowOf::vertex, 0., [](auto& t) { return &t.vertex_length; });
  use(RowOf::vertex, -1, [](auto& t) { return &t.origins; });
  use(RowOf::vertex, -1, [](auto& t) { return &t.previous_ids; });
  use(RowOf::wedge, 0, [](auto& t) { return &t.corner_valences; });
}

/// An empty column is not in use.
template <typename T>
void resize_column(std::vector<T>& column, int rows, int, T empty) {
  if (!column.empty()) column.resize(rows, empty);
}

void resize_column(Mat3X& column, int rows, int spare, double) {
  if (column.cols() < rows) column.conservativeResize(3, Eigen::Index{rows} + spare);
}

template <typename T>
std::vector<T> rows_of(const std::vector<T>& column, const std::vector<int>& rows) {
  std::vector<T> selected;
  if (column.empty()) return selected;  // not in use
  selected.reserve(rows.size());
  for (int row : rows) selected.push_back(column[row]);
  return selected;
}

Mat3X rows_of(const Mat3X& column, const std::vector<int>& rows) {
  Mat3X selected(3, std::ssize(rows));
  for (size_t i = 0; i < rows.size(); ++i) selected.col(static_cast<Eigen::Index>(i)) = column.col(rows[i]);
  return selected;
}

}  // namespace

void VertexTable::resize(int ids, int spare) {
  for_each_column(
      [&](RowOf, auto empty, const auto& column) { resize_column(*column(*this), ids, spare, empty); });
  if (!positions.other_wedge.empty()) positions.other_wedge.resize(ids, -1);
}

VertexTable VertexTable::rows(const std::vector<int>& vertices, const std::vector<int>& wedges) const {
  VertexTable selected;
  for_each_column([&](RowOf row, auto, const auto& column) {
    *column(selected) = rows_of(*column(*this), row == RowOf::vertex ? vertices : wedges);
  });
  return selected;
}

void VertexTable::keep(const std::vector<int>& vertices, const std::vector<int>& wedges,
                       std::vector<int> extra_wedges) {
  for_each_column([&](RowOf row, auto, const auto& column) {
    *column(*this) = rows_of(*column(*this), row == RowOf::vertex ? vertices : wedges);
  });
  positions.other_wedge = other_wedges(vertices.size(), extra_wedges);
  constraints.extra_wedges = std::move(extra_wedges);
}

}  // namespace hooke
