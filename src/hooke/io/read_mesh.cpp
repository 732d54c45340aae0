#include "hooke/io/read_mesh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/parallel.h"
#include "hooke/core/printable.h"
#include "hooke/io/files.h"
#include "hooke/io/polygon_triangulation.h"
#include "hooke/io/sha256.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/validation.h"

namespace hooke {
namespace {

/// The memory order and adjacency of a mesh, after validation. The mesh is checked in memory order, which is
/// faster; errors and warnings are then generated in file order.
MemoryOrder valid_layout(const Mat3X& points, const std::vector<Triangle>& triangles, Permutation order,
                         const MeshOrigin& origin, const MeshSource& source, Warnings& warnings,
                         Stopwatch* stopwatch) {
  const auto explain = [&] {
    append(warnings, require_valid_sheets(points, triangles, origin.joined, source));
  };
  MemoryOrder memory_order{std::move(order), nullptr};
  VertexFans fans;
  timed(stopwatch, "validate", [&] {
    if (!find_problems(memory_order.order.gather(points), memory_order.order.faces, &fans).empty()) explain();
  });
  memory_order.adjacency = timed(stopwatch, "connectivity", [&] {
    return std::make_shared<const Adjacency>(
        make_adjacency(std::exchange(memory_order.order.faces, {}), std::move(fans)));
  });
  return memory_order;
}

/// The values at the corners of the triangles. A triangle has none where one of its corners has none, of
/// which a new file warns.
CornerValues values_of_triangles(PolygonCorners& of_polygons, const char* what, MeshFile& file,
                                 const TriangulatedPolygons& triangulation) {
  CornerValues result;
  if (of_polygons.corners.empty()) return result;
  result = {std::move(of_polygons.values), of_polygons.width,
            items_of_triangles(triangulation, file.polygons, of_polygons.corners)};
  int lost = 0;
  for (Triangle& values : result.corners) {
    const auto [least, greatest] = std::ranges::minmax(values);
    if (least >= 0) continue;
    lost += greatest >= 0;
    values = {-1, -1, -1};
  }
  if (lost > 0)
    file.content.anew.push_back(
        {"attributes_not_kept",
         fmt::format("{}: not kept in the output: {} of triangles of which another corner has none: {}",
                     file.name, what, lost)});
  return result;
}

/// The old vertices that were merged with one of another value: what is no number is equal, whole numbers are
/// compared exactly, others up to this share of the greater one, or of `unit` if that is more.
std::size_t count_merged_with_others(const MeshOrigin& origin, const VertexChannel& channel, double share,
                                     double unit) {
  const auto are_equal = [&](double a, double b) {
    if (a == b || (std::isnan(a) && std::isnan(b))) return true;
    if (a == std::round(a) && b == std::round(b)) return false;
    return std::abs(a - b) <= share * std::max({std::abs(a), std::abs(b), unit});
  };
  std::size_t count = 0;
  for (std::size_t v = 0; v < origin.merged.size(); ++v)
    count += !are_equal(channel.values[v], channel.values[origin.merged[v]]);
  return count;
}

/// Where vertices were merged that have other texture coordinates, as at the seams of a file that cuts the
/// mesh open there, these become values of the corners too, of the triangles before the repair. As values of
/// vertices they, like all others, are those of the first, and a warning counts what is lost.
void keep_merged_values(const MeshOrigin& origin, const std::vector<Triangle>& triangles, MeshFile& file,
                        CornerData& corner_data, Warnings& warnings) {
  constexpr double rounding = 1e-9, texture_rounding = 1e-6;
  const ChannelList texture = texture_of(file.vertex_data);
  std::vector<std::string> lost;
  std::size_t most = 0, torn = 0;
  for (const VertexChannel& channel : file.vertex_data) {
    const bool is_texture = std::ranges::find(texture, &channel) != texture.end();
    const std::size_t count = is_texture ? count_merged_with_others(origin, channel, texture_rounding, 1)
                                         : count_merged_with_others(origin, channel, rounding, 0);
    if (is_texture) {
      torn = std::max(torn, count);
    } else if (count > 0 && std::ranges::find(normal_names, channel.name) == normal_names.end()) {
      lost.push_back(channel.name);
      most = std::max(most, count);
    }
  }
  if (!lost.empty())
    warnings.push_back(
        {"merged_values",
         fmt::format("{}: {} vertices had other values than those they were merged with, which stay: {}",
                     file.name, most, fmt::join(lost, ", "))});
  if (torn == 0) return;
  file.content.no_obj.push_back(
      {"texture_seams",
       fmt::format(
           "{}: not kept in the output: the texture coordinates of {} vertices that were merged with others, "
           "whose coordinates they got; OBJ holds both",
           file.name, torn)});
  CornerValues& of_corners = corner_data.texture;
  of_corners = {Mat3X::Zero(3, static_cast<Eigen::Index>(origin.merged.size())), 0, triangles};
  for (const VertexChannel* channel : texture)
    of_corners.values.row(of_corners.width++) = Eigen::Map<const Eigen::RowVectorXd>(
        channel->values.data(), static_cast<Eigen::Index>(channel->values.size()));
}

/// Brings values of corners in the order of a repaired mesh; faces over holes have none.
void follow(const MeshOrigin& origin, CornerValues& values) {
  if (values.empty()) return;
  for (size_t f = 0; f < values.corners.size(); ++f) {
    Triangle& corners = values.corners[f];
    if (origin.flipped[f]) std::swap(corners[1], corners[2]);
    if (f + origin.filled >= values.corners.size()) corners = {-1, -1, -1};
  }
}

/// Brings the data of vertices, faces and corners in the order of a repaired mesh.
void follow(const MeshOrigin& origin, VertexData& vertex_data, FaceData& face_data, CornerData& corner_data,
            MeshSource& source) {
  if (origin.vertex.empty()) return;
  corner_data = gather(corner_data, origin.face);
  follow(origin, corner_data.texture);
  follow(origin, corner_data.normals);
  for (VertexChannel& channel : vertex_data) {
    std::vector<double> values;
    values.reserve(origin.vertex.size());
    for (const int v : origin.vertex) values.push_back(channel.values[v]);
    channel.values = std::move(values);
  }
  face_data = gather(face_data, origin.face);
  std::vector<int> face;
  face.reserve(origin.face.size());
  for (const int f : origin.face) face.push_back(source.face[f]);
  source.face = std::move(face);
}

/// Returns work(). Says in the messages of its errors what the repair had done.
template <typename Work>
auto after_repairs(const Notes& repairs, const Work& work) {
  try {
    return work();
  } catch (const MeshError& e) {
    if (repairs.empty()) throw;
    std::string done;
    for (const Note& repair : repairs)
      done += fmt::format("{}{} {}", done.empty() ? "" : ", ", repair.code, repair.count);
    throw MeshError(fmt::format("{}; this is after the repair: {}", e.what(), done));
  }
}

}  // namespace

std::string name_of_input(const std::filesystem::path& path) {
  return is_standard_input(path) ? "standard input" : printable(path.native());
}

LoadedMesh read_mesh(const std::filesystem::path& path, Stopwatch* stopwatch, const ReadOptions& options) {
  const MeshFormat format = options.format ? *options.format : input_format_of(path);
  FileBytes content = timed(stopwatch, "file", [&] {
    return is_standard_input(path) ? read_standard_input() : read_regular_file(path);
  });
  MeshFile file =
      timed(stopwatch, "parse", [&] { return parse_mesh_file(content.text(), name_of_input(path), format); });
  TriangulatedPolygons triangulation =
      timed(stopwatch, "triangulate", [&] { return triangulate(file.points, file.polygons); });
  Warnings warnings = std::move(file.warnings);
  append_warnings(triangulation, file.name, file.content, warnings);
  if (misread_as_fans(file.points, file.polygons, triangulation))
    file.misread = "concave polygons, which overlap when they are cut as fans";
  CornerData corner_data{values_of_triangles(file.texture, "texture coordinates", file, triangulation),
                         values_of_triangles(file.normals, "normals", file, triangulation)};
  MeshSource source{file.name, std::move(triangulation.polygon), std::move(file.lines)};
  FaceData face_data = gather(file.face_data, source.face);
  Notes repairs;
  MeshOrigin origin;
  const auto repair_as = [&](const RepairOptions& wanted) {
    if (!wanted.any()) return;
    const Stage stage(stopwatch, "repair");
    const std::vector<Triangle> before =
        file.vertex_data.empty() ? std::vector<Triangle>() : triangulation.triangles;
    Repaired repaired = repair(file.points, std::move(triangulation.triangles), wanted, source);
    file.points = std::move(repaired.points);
    triangulation.triangles = std::move(repaired.triangles);
    repairs = std::move(repaired.changes);
    origin = std::move(repaired.origin);
    if (!repairs.empty()) file.marked_vertices.clear(), file.marked_edges.clear();
    if (!before.empty()) keep_merged_values(origin, before, file, corner_data, warnings);
    follow(origin, file.vertex_data, face_data, corner_data, source);
    source.repaired = wanted.repair;
    source.keeps_junctions = wanted.keep_junctions;
  };
  RepairOptions wanted = options.repair;
  // The vertices of an STL file are only made by its reader. Of facets without area in 32 bits, and of those
  // that marching cubes make at grid points of the level, corners lie in one place and so are one vertex.
  const bool is_soup = file.format == MeshFormat::stl && !wanted.repair && !wanted.keep_junctions;
  wanted.drop_strays =
      file.format == MeshFormat::stl && std::ranges::any_of(triangulation.triangles, uses_a_vertex_twice);
  wanted.separate = is_soup && (wanted.drop_strays || wanted.weld >= 0 || wanted.weld_share >= 0);
  repair_as(wanted);

  std::string hash, faces_hash;
  const auto lay_out = [&] {
    const std::vector<Triangle>& triangles = triangulation.triangles;
    Permutation order;
    const auto find_order = [&] {
      order = reorder(triangles, bfs_cluster_order(static_cast<int>(file.points.cols()), triangles));
    };
    const auto take_hashes = [&] {
      if (hash.empty()) hash = sha256(content.text());
      content = {};  // frees memory for the mesh
      faces_hash = origin.joined.empty() ? connectivity_sha256(triangles)
                                         : connectivity_sha256(join_faces(triangles, origin.joined));
    };
    timed(stopwatch, "order", [&] { parallel_invoke(find_order, take_hashes); });
    return after_repairs(repairs, [&] {
      return valid_layout(file.points, triangles, std::move(order), origin, source, warnings, stopwatch);
    });
  };
  MemoryOrder memory_order;
  try {
    memory_order = lay_out();
  } catch (const MeshError&) {
    if (!is_soup || !origin.vertex.empty()) throw;
    wanted.separate = true;
    repair_as(wanted);
    if (repairs.empty()) throw;
    memory_order = lay_out();
  }
  require_workable_size(file.points, file.name);
  const int polygons_cut = triangulation.polygons_cut;
  triangulation = {};
  // Constructed in place, because OpenMesh meshes can only be copied, not moved.
  return {timed(stopwatch, "build",
                [&] {
                  TriMesh mesh =
                      build_mesh(file.points, *memory_order.adjacency, memory_order.order.old_ids());
                  if (!origin.joined.empty()) set_joined_vertices(mesh, origin.joined);
                  return mesh;
                }),
          std::move(memory_order),
          file.format,
          file.encoding,
          std::move(hash),
          std::move(faces_hash),
          polygons_cut > 0 ? std::move(file.polygons) : IntLists(),
          std::move(file.vertex_data),
          std::move(face_data),
          std::move(corner_data),
          std::move(file.material_libraries),
          std::move(file.marked_vertices),
          std::move(file.marked_edges),
          std::move(file.stl_header),
          std::move(origin),
          std::move(file.notes),
          std::move(repairs),
          std::move(file.content),
          std::move(file.misread),
          std::move(warnings)};
}

}  // namespace hooke
