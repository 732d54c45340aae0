#include "hooke/io/rewrite_formats.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <vector>

#include "hooke/io/edited_copy.h"
#include "hooke/io/obj.h"
#include "hooke/io/renewed_normals.h"
#include "hooke/io/reprojected_texture.h"
#include "hooke/io/text.h"

namespace hooke {
namespace {

constexpr std::array<std::string_view, 3> changed_rows = {"v", "vt", "vn"};
enum : size_t { vertex_rows, texture_rows, normal_rows, row_kinds };

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
  if (!normals.renewed[normal]) return;
  const auto tokens = three_tokens(in);
  if (tokens.back().empty() || !in.token().empty()) return;  // not three numbers: no normal
  for (size_t k = 0; k < 3; ++k)
    copy.set_normal(tokens[k], normals.values(static_cast<Eigen::Index>(k), normal));
}

void set_texture_line(Scanner& in, const ReprojectedTexture& texture, Eigen::Index element,
                      EditedCopy& copy) {
  if (!texture.moved[element]) return;
  const auto tokens = three_tokens(in);
  for (size_t k = 0; k < 3; ++k) {
    double old = 0;
    if (parse_number(tokens[k], old) == NumberError::none)
      copy.set_number(tokens[k], texture.values(static_cast<Eigen::Index>(k), element));
  }
}

// The new data of face corners; none where they stay.
struct NewCorners {
  std::optional<RenewedNormals> normals;
  std::optional<ReprojectedTexture> texture;
};

NewCorners renew_corners(std::string_view text, const std::string& name, const Mat3X& points,
                         bool texture_follows) {
  const ObjCorners old = read_obj_corners(text, name);
  const auto& [values, width, of_corners] = old.normals;
  NewCorners result;
  if (!of_corners.empty())
    result.normals = renew_corner_normals({old.polygons, old.points, points}, of_corners, values);
  if (texture_follows && !old.texture.corners.empty())
    result.texture =
        reproject_texture({old.polygons, old.texture.corners, old.texture.values, old.points, points});
  return result;
}

void warn_of_torn(const NewCorners& corners, const std::string& name, Warnings& warnings) {
  if (corners.normals && corners.normals->torn > 0)
    warnings.push_back(
        {"normals_shared",
         fmt::format("{}: normals (vn) that several corners share, which now differ by more than 10 degrees: "
                     "{}; they were set to the mean",
                     name, corners.normals->torn)});
  if (corners.texture && corners.texture->torn > 0)
    warnings.push_back(
        {"texture_shared",
         fmt::format("{}: texture coordinates (vt) that several vertices share, which would need different "
                     "ones now: {}; they were left as they are",
                     name, corners.texture->torn)});
}

}  // namespace

RewrittenMesh rewrite_obj(std::string_view text, const std::string& name, const Mat3X& points,
                          bool texture_follows) {
  const std::vector<TextPiece> pieces = remaining_pieces(Scanner(text, name, obj_syntax), changed_rows);
  std::vector<std::array<Eigen::Index, row_kinds>> first(pieces.size() + 1,
                                                         {0, 0, 0});  // rows before a piece
  for (size_t p = 0; p < pieces.size(); ++p)
    for (size_t k = 0; k < row_kinds; ++k) first[p + 1][k] = first[p][k] + pieces[p].rows_of[k];
  const bool has_corner_data =
      first.back()[normal_rows] > 0 || (texture_follows && first.back()[texture_rows] > 0);
  const NewCorners corners =
      has_corner_data ? renew_corners(text, name, points, texture_follows) : NewCorners{};
  RewrittenMesh result;
  result.bytes = edited_text(text, pieces, [&](const TextPiece& piece, size_t p, EditedCopy& copy) {
    auto [vertex, element, normal] = first[p];
    Scanner in = piece.scanner;
    while (in.next_line()) {
      const std::string_view keyword = in.token();
      if (keyword == "v")
        set_vertex(in, points, vertex++, copy);
      else if (keyword == "vt" && corners.texture)
        set_texture_line(in, *corners.texture, element++, copy);
      else if (keyword == "vn" && corners.normals)
        set_normal_line(in, *corners.normals, normal++, copy);
    }
  });
  warn_of_torn(corners, name, result.warnings);
  return result;
}

}  // namespace hooke
