#include "hooke/springs/sizing.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <queue>

#include "hooke/core/error.h"
#include "hooke/io/files.h"
#include "hooke/io/mesh_file.h"
#include "hooke/io/ply.h"
#include "hooke/io/printable.h"
#include "hooke/io/vertex_lists.h"
#include "hooke/springs/target_lengths.h"

namespace hooke {
namespace {

constexpr double longest = .1;  // of the box's diagonal: beyond it a mesh hardly shows a shape

SizingSource parse_curvature(std::string_view error) {
  SizingSource source{.kind = SizingSource::Kind::curvature, .name = {}};
  const char* const end = error.data() + error.size();
  const auto [rest, failed] = std::from_chars(error.data(), end, source.chord_error);
  const std::string_view unit(rest, end);
  source.percent = unit == "%";
  if (failed != std::errc() || !(unit.empty() || source.percent) || !(source.chord_error > 0) ||
      !std::isfinite(source.chord_error))
    throw Error(
        fmt::format("curvature: chord error {}; expected a positive number, alone or with %; for instance "
                    "curvature:0.1%",
                    in_quotes(error)));
  return source;
}

std::vector<double> read_property(const std::string& property, const std::filesystem::path& mesh_file,
                                  int count) {
  const std::string name = printable(mesh_file.native());
  if (input_format_of(mesh_file) != "ply")
    throw Error(fmt::format("{}: sizing by the property {}; expected a PLY file; name a file of lengths",
                            name, in_quotes(property)));
  const FileBytes file = read_regular_file(mesh_file);
  std::vector<double> lengths = read_ply_lengths(file.text(), name, property);
  if (lengths.size() != static_cast<size_t>(count))
    throw InputError(fmt::format("{}: {} vertices, and {} when it was first read; it has been changed", name,
                                 lengths.size(), count));
  return lengths;
}

}  // namespace

SizingSource parse_sizing(const std::string& text) {
  const std::string curvature = "curvature", ply = "ply:";
  if (text == curvature) return {.kind = SizingSource::Kind::curvature, .name = {}};
  if (text.starts_with(curvature + ":"))
    return parse_curvature(std::string_view(text).substr(curvature.size() + 1));
  const bool is_property = text.starts_with(ply);
  const std::string name = is_property ? text.substr(ply.size()) : text;
  if (name.empty())
    throw Error(fmt::format("{}; expected FILE, ply:PROPERTY or curvature[:ERROR]", in_quotes(text)));
  return {.kind = is_property ? SizingSource::Kind::ply_property : SizingSource::Kind::file, .name = name};
}

std::vector<double> read_sizing(const SizingSource& source, const std::filesystem::path& mesh_file,
                                const Mat3X& points, const Layout& layout) {
  const Connectivity& c = *layout.connectivity;
  switch (source.kind) {
    case SizingSource::Kind::none:
      break;
    case SizingSource::Kind::file:
      return layout.order.in_new_order(read_length_list(source.name, c.vertex_count));
    case SizingSource::Kind::ply_property:
      return layout.order.in_new_order(read_property(source.name, mesh_file, c.vertex_count));
    case SizingSource::Kind::curvature: {
      const double diagonal = box_diagonal(points);
      const double error = source.percent ? source.chord_error / 100 * diagonal : source.chord_error;
      return curvature_lengths(points, c, error, longest * diagonal);
    }
  }
  return {};
}

void limit_gradation(const Mat3X& points, const Connectivity& c, double slope, std::vector<double>& length) {
  if (std::isinf(slope)) return;
  const auto at = [&](int v) -> double& { return length[static_cast<size_t>(v)]; };
  const auto limit = [&](int from, int to) {
    return at(from) + slope * (points.col(to) - points.col(from)).norm();
  };
  // The smallest first, as in Dijkstra's shortest paths: a vertex that comes up has its final length.
  using Item = std::pair<double, int>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  for (const auto& [a, b] : c.edges) {
    if (at(b) > limit(a, b)) queue.emplace(at(a), a);
    if (at(a) > limit(b, a)) queue.emplace(at(b), b);
  }
  while (!queue.empty()) {
    const auto [l, v] = queue.top();
    queue.pop();
    if (l > at(v)) continue;
    for (int w : c.vertex_neighbours[v])
      if (const double most = limit(v, w); at(w) > most) {
        at(w) = most;
        queue.emplace(most, w);
      }
  }
}

}  // namespace hooke
