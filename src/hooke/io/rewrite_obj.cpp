#include "hooke/io/rewrite_obj.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <vector>

#include "hooke/io/edited_copy.h"
#include "hooke/io/obj.h"
#include "hooke/io/renewed_normals.h"
#include "hooke/io/text.h"

namespace hooke {
namespace {

constexpr std::array<std::string_view, 2> changed_rows = {"v", "vn"};
enum : size_t { vertex_rows, normal_rows };

std::array<std::string_view, 3> three_tokens(Scanner& in) {
  std::array<std::string_view, 3> tokens;
  for (std::string_view& token : tokens) token = in.token();
  return tokens;
}

// Rewrites a vertex or a normal line whose keyword was read.
void set_vertex(Scanner& in, const Mat3X& points, Eigen::Index vertex, EditedCopy& copy) {
  const auto tokens = three_tokens(in);
  for (size_t k = 0; k < 3; ++k) copy.set_number(tokens[k], points(static_cast<Eigen::Index>(k), vertex));
}

void set_normal_line(Scanner& in, const RenewedNormals& normals, Eigen::Index normal, EditedCopy& copy) {
  if (!normals.renewed[static_cast<size_t>(normal)]) return;
  const auto tokens = three_tokens(in);
  if (tokens.back().empty() || !in.token().empty()) return;  // not three numbers: no normal
  for (size_t k = 0; k < 3; ++k)
    copy.set_normal(tokens[k], normals.values(static_cast<Eigen::Index>(k), normal));
}

std::optional<RenewedNormals> renew_obj_normals(std::string_view text, const std::string& name,
                                                const Mat3X& points) {
  const ObjNormals old = read_obj_normals(text, name);
  if (old.of_corners.empty()) return std::nullopt;  // normals without corners
  return renew_corner_normals({old.polygons, old.points, points}, old.of_corners, old.values);
}

}  // namespace

RewrittenMesh rewrite_obj(std::string_view text, const std::string& name, const Mat3X& points) {
  const std::vector<TextPiece> pieces = remaining_pieces(Scanner(text, name, obj_syntax), changed_rows);
  std::vector<std::array<Eigen::Index, 2>> first(pieces.size() + 1, {0, 0});  // vertex and normal of a piece
  for (size_t p = 0; p < pieces.size(); ++p)
    for (const size_t k : {vertex_rows, normal_rows}) first[p + 1][k] = first[p][k] + pieces[p].rows_of[k];
  const bool has_normals = first.back()[normal_rows] > 0;
  const std::optional<RenewedNormals> normals =
      has_normals ? renew_obj_normals(text, name, points) : std::nullopt;
  RewrittenMesh result;
  result.bytes = edited_text(text, pieces, [&](const TextPiece& piece, size_t p, EditedCopy& copy) {
    auto [vertex, normal] = first[p];
    Scanner in = piece.scanner;
    while (in.next_line()) {
      const std::string_view keyword = in.token();
      if (keyword == "v")
        set_vertex(in, points, vertex++, copy);
      else if (keyword == "vn" && normals)
        set_normal_line(in, *normals, normal++, copy);
    }
  });
  if (normals && normals->torn > 0)
    result.warnings.push_back(
        {"normals_shared",
         fmt::format("{}: normals (vn) that several corners share, which now differ by more than 10 degrees: "
                     "{}; they were set to the mean",
                     name, normals->torn)});
  return result;
}

}  // namespace hooke
