#include "result_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hooke/core/printable.h"
#include "hooke/core/stopwatch.h"
#include "hooke/geometry/triangle.h"
#include "hooke/io/carried_data.h"
#include "hooke/io/files.h"
#include "hooke/io/mesh_file.h"
#include "hooke/io/ply.h"
#include "hooke/io/polygon_triangulation.h"
#include "hooke/io/rewrite.h"
#include "hooke/io/stl.h"
#include "hooke/mesh/curvature.h"
#include "hooke/mesh/junctions.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/normals.h"
#include "hooke/springs/sizing.h"

namespace hooke::app {

bool is_repaired(const LoadedMesh& loaded) {
  return std::ranges::any_of(loaded.repairs, [](const Note& n) { return !n.code.ends_with("_left"); });
}

std::string obstacle_to_preserving(const Settings& s, const LoadedMesh& loaded) {
  if (s.check) return "nothing is written";
  if (!keeps_faces(s)) return "faces change with this --connectivity";
  if (loaded.format != s.format)
    return fmt::format("the input is {} and the output {}", name_of(loaded.format), name_of(*s.format));
  if (!can_rewrite(*s.format)) return fmt::format("{} files are always written anew", name_of(*s.format));
  if (is_repaired(loaded)) return "the input was repaired";
  if (is_standard_input(s.input)) return "standard input cannot be read again";
  if (!s.preserve_given && !loaded.misread.empty())
    return fmt::format("simple readers would misread its {}; --preserve on keeps them", loaded.misread);
  return "";
}

PlyEncoding encoding_of_output(const Settings& s, const LoadedMesh& loaded) {
  return s.format == loaded.format ? loaded.encoding : PlyEncoding::binary_little_endian;
}

bool has_float_points(const Settings& s, const LoadedMesh& loaded) {
  return s.format == MeshFormat::stl && encoding_of_output(s, loaded) != PlyEncoding::ascii;
}

namespace {

/// Whether a user would expect the output to be the input's bytes with other digits: a file of a format that
/// can be, the same faces, and nothing repaired.
bool is_of_its_kind(const Settings& s, const LoadedMesh& loaded) {
  return keeps_faces(s) && loaded.format == s.format && can_rewrite(*s.format) && !is_repaired(loaded);
}

/// The vertex data of the result: that of the input if the faces are kept, else interpolated at the surface
/// positions of its vertices. Normals are always recomputed from the result.
FormatData vertex_data_of_result(const Settings& s, const LoadedMesh& loaded, const Original& original,
                                 const Mat3X& points, const RunRecord& run) {
  const MemoryOrder& memory_order = loaded.memory_order;
  const bool interpolated = !keeps_faces(s) && !loaded.vertex_data.empty();
  VertexData data =
      interpolated ? interpolate(loaded.vertex_data, run.result->map,
                                 original.memory_order.order.scatter(original.memory_order.adjacency->faces))
                   : loaded.vertex_data;
  if (has_normals(data))
    set_normals(data, memory_order.order.scatter(vertex_normals(points, *memory_order.adjacency)));
  return data_for_format(data, loaded.format, *s.format);
}

/// The data of corners in the result: of new faces as they are, else with normals that follow the vertices.
CornerData corner_data_of_result(const Settings& s, const LoadedMesh& loaded, const Original& original) {
  CornerData data = loaded.corner_data;
  if (keeps_faces(s) && !data.normals.empty())
    data.normals =
        moved_normals(data.normals, triangles_of(loaded.mesh),
                      original.memory_order.order.scatter(original.points), vertex_points(loaded.mesh));
  return data;
}

/// The format that holds what this one cannot.
const char* format_for(const FormatData& vertices, const FormatFaceData& faces) {
  const auto is_dropped = [&](const std::string& channel) {
    return std::ranges::find(faces.dropped, channel) != faces.dropped.end();
  };
  for (const std::string channel : {material_channel, object_channel, smoothing_channel})
    if (is_dropped(channel) || is_dropped("names of " + channel)) return "OBJ";
  if (!vertices.dropped.empty()) return "PLY";
  for (const std::string channel : {group_channel, entity_channel})
    if (is_dropped(channel) || is_dropped("names of " + channel)) return "MSH";
  return is_dropped(attribute_channel) ? "STL" : "PLY";
}

/// The data of the result that its file can hold. Warns of the rest.
MeshData data_of_result(const Settings& s, const LoadedMesh& loaded, const Original& original,
                        const Mat3X& points, PlyEncoding encoding, RunRecord& run) {
  FormatData vertices = vertex_data_of_result(s, loaded, original, points, run);
  FormatFaceData faces = face_data_for_format(loaded.face_data, loaded.format, *s.format, encoding);
  MeshData result{std::move(vertices.data), std::move(faces.data), {}, {}, loaded.stl_header};
  if (s.format == MeshFormat::obj) {
    result.corners = corner_data_of_result(s, loaded, original);
    result.material_libraries = loaded.material_libraries;
  }
  std::vector<std::string> lost = vertices.dropped;
  for (const std::string& channel : faces.dropped)
    lost.push_back(channel.starts_with("names of ") ? channel + "s" : channel);
  if (!lost.empty())
    run.warnings.push_back(
        {"attributes_not_kept",
         fmt::format("{}: {} files cannot hold {}; use {}", name_of_output(s.output), name_of(*s.format),
                     fmt::join(lost, ", "), format_for(vertices, faces))});
  return result;
}

/// Polygons that are concave now make another surface in programs that cut them as fans.
void warn_of_concave_polygons(const Settings& s, const LoadedMesh& loaded, const Original& original,
                              RunRecord& run) {
  const size_t after = count_concave(vertex_points(loaded.mesh), loaded.polygons);
  if (after == 0) return;
  const size_t before = count_concave(original.memory_order.order.scatter(original.points), loaded.polygons);
  if (after > before)
    run.warnings.push_back(
        {"polygons_concave",
         fmt::format("{}: {} polygons are concave, {} before, and programs may cut them in another way than "
                     "was measured; --preserve off writes the triangles",
                     name_of_output(s.output), after, before)});
}

Warnings losses_of_output(const TriMesh& mesh, PlyEncoding encoding, const std::string& name) {
  if (const std::optional<JoinedMesh> joined = join_sheets(mesh))
    return losses_in_stl(joined->gather(vertex_points(mesh)), joined->triangles, encoding, name);
  return losses_in_stl(vertex_points(mesh), triangles_of(mesh), encoding, name);
}

}  // namespace

PendingMesh prepare_output(const Settings& s, const LoadedMesh& loaded, const Original& original,
                           const Mat3X& points, RunRecord& record, Stopwatch& stopwatch) {
  record.output.emplace();
  std::string obstacle = obstacle_to_preserving(s, loaded);
  if (s.preserve && obstacle.empty()) {
    PreservedMesh preserved = prepare_preserved_mesh(
        s.output, loaded.mesh, {s.input, loaded.format, loaded.sha256, loaded.connectivity_sha256},
        s.reproject_uv, &stopwatch);
    if (preserved.mesh) {
      record.output->preserved = true;
      append(record.warnings, loaded.content.preserved);
      append(record.warnings, preserved.warnings);
      warn_of_concave_polygons(s, loaded, original, record);
      return *std::move(preserved.mesh);
    }
    obstacle = std::move(preserved.obstacle);
  }
  append(record.warnings, loaded.content.anew);
  if (s.format != MeshFormat::obj) append(record.warnings, loaded.content.no_obj);
  if (s.preserve && (s.preserve_given || is_of_its_kind(s, loaded)))
    record.warnings.push_back(
        {"not_preserved", fmt::format("{}: is a new file, and not {} with moved vertices: {}",
                                      name_of_output(s.output), record.input.path, obstacle)});
  const PlyEncoding encoding = encoding_of_output(s, loaded);
  const MeshData data = data_of_result(s, loaded, original, points, encoding, record);
  if (s.format == MeshFormat::stl)
    append(record.warnings, losses_of_output(loaded.mesh, encoding, name_of_output(s.output)));
  return prepare_mesh(s.output, loaded.mesh, *s.format, encoding, data, &stopwatch);
}

std::vector<MapEntry> map_of_output(const TriMesh& result, const MeshOrigin& origin,
                                    const RunRecord& record) {
  std::vector<MapEntry> map = map_to_old(record.result->map, origin);
  const std::optional<JoinedMesh> joined = join_sheets(result);
  if (!joined) return map;
  std::vector<MapEntry> left;
  for (const int v : joined->vertices) left.push_back(map[v]);
  return left;
}

void join_ids(const TriMesh& result, const MeshOrigin& origin, RunRecord& record) {
  const auto renumber = [](Quality& quality, const std::vector<int>& id) {
    for (WorstFace& face : quality.worst_faces) {
      for (int& v : face.vertices) v = id[v];
      for (int& v : face.bound.vertices) v = id[v];
    }
  };
  if (origin.joined.empty()) return;
  renumber(record.before, origin.joined);
  if (record.after) renumber(*record.after, join_sheets(result)->id);
}

namespace {

std::vector<double> length_errors(const Mat3X& points, const Adjacency& c, const UniformVector& targets) {
  std::vector<double> worst(c.vertex_count, 0);
  for (size_t e = 0; e < c.edges.size(); ++e) {
    const auto& [v, w] = c.edges[e];
    const double error = std::abs((points.col(v) - points.col(w)).norm() - targets[e]) / targets[e];
    for (int end : {v, w}) {
      double& at_vertex = worst[end];
      at_vertex = std::max(at_vertex, error);
    }
  }
  return worst;
}

}  // namespace

Fields measure_fields(const Mat3X& points, const Adjacency& c, const UniformVector& edge_targets,
                      const std::vector<double>& distances, const Mat3X* start) {
  Fields fields;
  const auto add = [](VertexData& data, const char* name, std::vector<double> values) {
    data.push_back({name, NumberType::float64, std::move(values)});
  };
  if (start) {
    std::vector<double> moved(c.vertex_count);
    for (size_t v = 0; v < moved.size(); ++v)
      moved[v] = (points.col(static_cast<Eigen::Index>(v)) - start->col(static_cast<Eigen::Index>(v))).norm();
    add(fields.vertices, "displacement", std::move(moved));
  }
  add(fields.vertices, "distance", distances);
  VertexCurvature curvature = measure_curvature(points, c);
  add(fields.vertices, "mean_curvature", std::move(curvature.mean));
  add(fields.vertices, "gaussian_curvature", std::move(curvature.gaussian));
  add(fields.vertices, "length_error", length_errors(points, c, edge_targets));
  std::vector<double> angles;
  for (const Triangle& face : c.faces) angles.push_back(angle_with_cotangent(max_cotangent(points, face)));
  add(fields.faces, "min_angle", std::move(angles));
  return fields;
}

std::string fields_text(const LoadedMesh& loaded, const Mat3X& points, const Original& original,
                        const RunRecord& record) {
  const TriMesh& mesh = loaded.mesh;
  const Permutation& order = loaded.memory_order.order;
  const Adjacency& adjacency = *loaded.memory_order.adjacency;
  const bool corresponds = record.deviation->displacement.has_value();
  const Mat3X start =
      corresponds ? order.gather(original.memory_order.order.scatter(original.points)) : Mat3X();
  Fields fields =
      measure_fields(points, adjacency, target_lengths_of(mesh, order, adjacency).edge,
                     record.deviation->vertices_to_reference.distances, corresponds ? &start : nullptr);
  for (VertexChannel& channel : fields.vertices) channel.values = order.scatter(channel.values);
  for (VertexChannel& channel : fields.faces) {
    const std::vector<double> in_memory = std::exchange(channel.values, {});
    channel.values.resize(in_memory.size());
    for (size_t f = 0; f < in_memory.size(); ++f) channel.values[order.old_face[f]] = in_memory[f];
  }
  if (const std::optional<JoinedMesh> joined = join_sheets(mesh))
    return write_ply(joined->gather(vertex_points(mesh)), joined->triangles,
                     PlyEncoding::binary_little_endian, joined->gather(fields.vertices), fields.faces);
  return write_ply(vertex_points(mesh), triangles_of(mesh), PlyEncoding::binary_little_endian,
                   fields.vertices, fields.faces);
}

}  // namespace hooke::app
