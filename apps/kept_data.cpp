#include "kept_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "hooke/constraints/seams.h"
#include "hooke/io/carried_data.h"
#include "hooke/mesh/attributes.h"
#include "hooke/mesh/chart_places.h"
#include "hooke/mesh/hard_edges.h"
#include "hooke/mesh/mesh.h"
#include "hooke/mesh/normals.h"
#include "hooke/mesh/surface_point.h"
#include "hooke/mesh/wedges.h"
#include "hooke/springs/rest_ratios.h"
#include "hooke/springs/sizing.h"
#include "result_files.h"

namespace hooke::app {
namespace {

/// Removes the channels that are not to be kept. Returns their names.
std::vector<std::string> drop_channels(const SeamKinds& keep, FaceData& data) {
  const auto is_dropped = [&](const FaceChannel& channel) {
    return !(channel.kind == LabelKind::group ? keep.groups : keep.materials);
  };
  std::vector<std::string> names;
  for (const FaceChannel& channel : data)
    if (is_dropped(channel)) names.push_back(channel.name);
  std::erase_if(data, is_dropped);
  return names;
}

void drop_unkept(const SeamKinds& keep, LoadedMesh& loaded, RunRecord& record) {
  const std::vector<std::string> names = drop_channels(keep, loaded.face_data);
  if (!names.empty())
    record.warnings.push_back({"attributes_not_kept",
                               fmt::format("{}: face data not kept: {}: new faces have none with this --keep",
                                           record.input.path, fmt::join(names, ", "))});
  CornerData& corners = loaded.corner_data;
  if (!keep.texture && !keep.hard_edges) {
    if (!corners.empty()) append(loaded.content.anew, std::exchange(loaded.content.no_obj, {}));
    corners = {};
  } else if (!keep.texture && !corners.texture.empty()) {
    record.warnings.push_back(
        {"attributes_not_kept",
         fmt::format("{}: texture coordinates not kept: new faces have none with this --keep",
                     record.input.path)});
    corners.texture = {};
  }
  if (!keep.materials) loaded.material_libraries.clear();
}

/// Which --keep holds all but the most frequent kind of seams.
std::string what_gives_up_most(const Seams& seams, const Settings& s) {
  const std::size_t most = std::max({seams.texture, seams.hard_edges, seams.materials, seams.groups});
  std::vector<const char*> words;
  if (s.keep.texture && seams.texture < most) words.push_back("seams");
  if (s.keep.hard_edges && seams.hard_edges < most) words.push_back("hard-edges");
  if (s.keep.materials && seams.materials < most) words.push_back("materials");
  if (s.keep.groups && seams.groups < most) words.push_back("groups");
  if (words.empty() && (keeps_faces(s) || s.repair.keep_junctions))
    return fmt::format("{} gives them up", keeps_faces(s) ? "no --keep" : "--connectivity fixed");
  if (s.repair.keep_junctions) words.push_back("non-manifold");
  return fmt::format("--keep {} gives them up",
                     words.empty() ? "none" : fmt::format("{}", fmt::join(words, ",")));
}

/// How many seams are not along sharp edges.
std::size_t count_smooth(const Seams& seams, const Settings& s, const LoadedMesh& loaded) {
  const MemoryOrder& m = loaded.memory_order;
  const std::vector<int> sharp = sharp_edges(m.order.gather(vertex_points(loaded.mesh)), *m.adjacency,
                                             s.remesh.constraints.features.angle);
  std::vector<int> smooth;
  std::ranges::set_difference(seams.edges, sharp, std::back_inserter(smooth));
  return smooth.size();
}

constexpr SeamKinds no_seams{false, false, false, false};

/// More than so many seams hold most vertices.
std::size_t many_seams(const LoadedMesh& loaded) {
  constexpr double many = 1. / 3;  // of all edges
  return static_cast<std::size_t>(many * static_cast<double>(loaded.memory_order.adjacency->edges.size()));
}

/// Warns where faces stay if data of them, which the output holds, have borders that moved with them: not
/// along creases.
void warn_of_moved_borders(const Settings& s, const LoadedMesh& loaded, const Original& original,
                           RunRecord& record) {
  const FormatFaceData held =
      face_data_for_format(loaded.face_data, loaded.format, *s.format, encoding_of_output(s, loaded));
  const SeamKinds kinds{.texture = s.format == MeshFormat::obj, .hard_edges = false};
  const Seams seams = find_seams(loaded.memory_order, loaded.corner_data, held.data, kinds);
  std::vector<Edge> creases = record.result->crease_edges;
  for (Edge& crease : creases) std::ranges::sort(crease);
  std::ranges::sort(creases);
  const Mat3X before = original.memory_order.order.scatter(original.points);
  const auto after = vertex_points(loaded.mesh);
  const auto has_moved = [&](Edge ends) {
    std::ranges::sort(ends);
    return !std::ranges::binary_search(creases, ends) &&
           std::ranges::any_of(ends, [&](int v) { return before.col(v) != after.col(v); });
  };
  const auto count = static_cast<std::size_t>(std::ranges::count_if(seams.ends, has_moved));
  if (count == 0 || count > many_seams(loaded)) return;
  std::vector<const char*> words;
  if (seams.texture > 0) words.push_back("seams");
  if (seams.materials > 0) words.push_back("materials");
  if (seams.groups > 0) words.push_back("groups");
  record.warnings.push_back(
      {"borders_moved", fmt::format("{}: {} edges at borders of {} have moved with their faces; --keep {} "
                                    "holds these borders in their places",
                                    record.input.path, count,
                                    seams.texture == 0 ? "materials, groups or labels"
                                    : words.size() > 1 ? "the texture, materials or groups"
                                                       : "the texture",
                                    fmt::join(words, ","))});
}

bool is_named(const VertexChannel& channel, std::span<const char* const> names) {
  return std::ranges::find(names, channel.name) != names.end();
}

/// Is it a value that goes with the surface? No normal, and no number of its own for each vertex.
bool is_of_places(const VertexChannel& channel, const std::vector<Triangle>& faces) {
  if (is_named(channel, normal_names)) return false;
  return !is_integer(channel.type) || is_named(channel, colour_names) ||
         is_equal_at_most_sides(channel, faces);
}

/// The root mean square of the differences of finite values of vertices with faces, of their range.
double difference(const VertexChannel& here, const VertexChannel& there, const Adjacency& c) {
  double squares = 0, count = 0;
  Eigen::AlignedBox1d range;
  for (int v = 0; v < c.vertex_count; ++v) {
    const double difference = here.values[v] - there.values[v];
    if (c.vertex_edges[v].empty() || !std::isfinite(difference)) continue;
    squares += difference * difference;
    range.extend(Eigen::Matrix<double, 1, 1>(here.values[v]));
    ++count;
  }
  return count > 0 && range.volume() > 0 ? std::sqrt(squares / count) / range.volume() : 0;
}

/// The texture coordinates of the corners as values of the vertices in memory order; NaN at seams.
VertexData texture_of_vertices(const CornerValues& texture, const MemoryOrder& memory_order) {
  const Adjacency& c = *memory_order.adjacency;
  VertexData channels;
  for (int k = 0; k < texture.width; ++k) {
    VertexChannel& channel = channels.emplace_back(VertexChannel{texture_names[k]});
    channel.values.assign(c.vertex_count, std::numeric_limits<double>::quiet_NaN());
    std::vector<char> is_seen(c.vertex_count, 0);
    for (std::size_t f = 0; f < c.faces.size(); ++f)
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const int v = c.faces[f][corner], element = texture.corners[memory_order.order.old_face[f]][corner];
        double& value = channel.values[v];
        const double here =
            element < 0 ? std::numeric_limits<double>::quiet_NaN() : texture.values(k, element);
        if (!std::exchange(is_seen[v], 1))
          value = here;
        else if (value != here)
          value = std::numeric_limits<double>::quiet_NaN();
      }
  }
  return channels;
}

/// Warns where faces stay if values of vertices that moved along are clearly others than the input has at
/// their places.
void warn_of_moved_values(const Settings& s, const LoadedMesh& loaded, const Original& original,
                          RunRecord& record) {
  constexpr double clearly = .01, visibly = .0025;  // root mean square, of the range; of textures
  const Permutation& order = loaded.memory_order.order;
  const Adjacency& c = *original.memory_order.adjacency;
  const bool has_corners = !loaded.corner_data.texture.empty() && s.format == MeshFormat::obj;
  const ChannelList of_vertices = texture_of(loaded.vertex_data);
  VertexData values;
  std::vector<char> is_texture;
  for (const VertexChannel& channel : loaded.vertex_data) {
    const bool is_of_texture = std::ranges::find(of_vertices, &channel) != of_vertices.end();
    if (is_of_texture && (has_corners || s.reproject_uv)) continue;
    VertexChannel here{channel.name, channel.type, order.gather(channel.values)};
    if (!is_of_places(here, c.faces)) continue;
    values.push_back(std::move(here));
    is_texture.push_back(is_of_texture);
  }
  if (has_corners && !s.reproject_uv)
    std::ranges::move(texture_of_vertices(loaded.corner_data.texture, original.memory_order),
                      std::back_inserter(values));
  is_texture.resize(values.size(), 1);
  if (values.empty()) return;
  const Mat3X after = order.gather(vertex_points(loaded.mesh));
  std::vector<MapEntry> map(c.vertex_count);
  for (int v = 0; v < c.vertex_count; ++v)
    map[v] = {v, original.points.col(v) == after.col(v) ? SurfacePoint{}
                                                        : locate(original.points, c, after.col(v), v)};
  const VertexData there = interpolate(values, map, c.faces);
  std::vector<std::string> moved;
  bool moves_texture = false;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double share = difference(values[k], there[k], c);
    if (share <= (is_texture[k] ? visibly : clearly)) continue;
    moves_texture |= is_texture[k] != 0;
    moved.push_back(fmt::format("{}{} by {:.2g} %", is_texture[k] ? "texture coordinate " : "",
                                values[k].name, 100 * share));
  }
  if (!moved.empty())
    record.warnings.push_back(
        {"values_moved",
         fmt::format(
             "{}: values of vertices went along with these, and differ from those at their new places: {} "
             "of the range (rms); {}--connectivity flip and adapt take the values of the places",
             record.input.path, fmt::join(moved, ", "),
             moves_texture && s.format == MeshFormat::obj && s.preserve &&
                     obstacle_to_preserving(s, loaded).empty()
                 ? "--reproject-uv on lets texture coordinates follow, "
                 : "")});
}

/// Warns if so many edges are seams, though the surface is smooth across them, that little can change.
void warn_of_many_seams(const Seams& seams, const Settings& s, const LoadedMesh& loaded, RunRecord& record) {
  const MemoryOrder& m = loaded.memory_order;
  const std::size_t limit = many_seams(loaded);
  if (seams.edges.size() <= limit || count_smooth(seams, s, loaded) <= limit) return;
  record.warnings.push_back(
      {"many_seams",
       fmt::format("{}: {} of {} edges are seams, which stay where they are, so that little can change "
                   "(texture: {}, hard edges: {}, materials and labels: {}, groups: {}); {}",
                   record.input.path, seams.edges.size(), m.adjacency->edges.size(), seams.texture,
                   seams.hard_edges, seams.materials, seams.groups, what_gives_up_most(seams, s))});
}

/// The face of the input where each vertex of the result lies, in memory order; -1 for none.
std::vector<int> faces_near(const std::vector<MapEntry>& map, const MemoryOrder& before,
                            const MemoryOrder& after) {
  std::vector<int> index(before.order.old_face.size()), near;
  for (std::size_t f = 0; f < index.size(); ++f) index[before.order.old_face[f]] = static_cast<int>(f);
  for (const int id : after.order.old_vertex) {
    const int face = map[id].position.face;
    near.push_back(face < 0 ? -1 : index[face]);
  }
  return near;
}

/// The new id of each face where faces of equal labels come together, these in the order in which the input
/// has them.
std::vector<int> order_by_labels(const FaceData& of_input, const FaceData& of_result, std::size_t faces) {
  const auto labels_of = [](const FaceData& data, std::size_t face) {
    std::vector<int> labels;
    for (const FaceChannel& channel : data)
      if (channel.kind != LabelKind::other) labels.push_back(channel.values[face]);
    return labels;
  };
  std::map<std::vector<int>, int> ranks;
  for (std::size_t f = 0; !of_input.empty() && f < of_input.front().values.size(); ++f)
    ranks.try_emplace(labels_of(of_input, f), static_cast<int>(ranks.size()));
  std::vector<int> rank(faces), order(faces);
  for (std::size_t f = 0; f < faces; ++f) rank[f] = ranks[labels_of(of_result, f)];
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int f) { return rank[f]; });
  return order;
}

/// Gives the faces of the result new ids: face f was order[f]. Those in the record follow.
void renumber_faces(const std::vector<int>& order, LoadedMesh& loaded, RunRecord& record) {
  std::vector<int> fresh(order.size());
  for (std::size_t f = 0; f < order.size(); ++f) fresh[order[f]] = static_cast<int>(f);
  const auto renumber = [&](int& face) { face = fresh[face]; };
  const auto renumber_all = [&](std::vector<int>& faces) {
    std::ranges::for_each(faces, renumber);
    std::ranges::sort(faces);
  };
  std::ranges::for_each(loaded.memory_order.order.old_face, renumber);
  replace_faces(loaded.mesh, *loaded.memory_order.adjacency, loaded.memory_order.order.old_ids());
  loaded.face_data = gather(loaded.face_data, order);
  loaded.corner_data = gather(loaded.corner_data, order);
  renumber_all(record.deviation->flipped_faces);
  renumber_all(record.deviation->opposing_faces);
  for (WorstFace& face : record.after->worst_faces) renumber(face.face);
}

}  // namespace

bool keeps_polygons(const Settings& s, const LoadedMesh& loaded) {
  return keeps_faces(s) && !loaded.polygons.items.empty() && !is_repaired(loaded);
}

namespace {

/// Is it the polygons that are moved, not their triangles?
bool moves_polygons(const Settings& s, const LoadedMesh& loaded) {
  return keeps_polygons(s, loaded) && s.edge_lengths.empty() && !s.paper;
}

/// Are these most of the triangles that the polygons are cut into?
bool are_most(std::size_t triangles, const LoadedMesh& loaded) {
  return 2 * triangles >= loaded.mesh.n_faces();
}

}  // namespace

bool guards_polygons(const Settings& s, const LoadedMesh& loaded) {
  return moves_polygons(s, loaded) && s.sizing.kind == SizingSource::Kind::none &&
         are_most(loaded.mesh.n_faces() - count_with_corners(loaded.polygons, 3), loaded);
}

void set_rest_ratios(const Settings& s, LoadedMesh& loaded) {
  if (!moves_polygons(s, loaded) || !are_most(2 * count_with_corners(loaded.polygons, 4), loaded)) return;
  const Permutation& order = loaded.memory_order.order;
  const Adjacency& c = *loaded.memory_order.adjacency;
  const Mat3X points = order.gather(vertex_points(loaded.mesh));
  set_edge_values(
      loaded.mesh, rest_ratio_property, order, c,
      rest_ratios(loaded.polygons, loaded.memory_order, points, target_lengths_of(loaded.mesh, order, c)));
}

namespace {

/// Holds the vertices of points in their places, and those of lines on these, as both are conditions there.
void hold_marks(const LoadedMesh& loaded, ConstraintOptions& constraints) {
  std::vector<int>& fixed = constraints.fixed_vertices;
  fixed.insert(fixed.end(), loaded.marked_vertices.begin(), loaded.marked_vertices.end());
  const Adjacency& c = *loaded.memory_order.adjacency;
  const std::vector<Edge> ends = loaded.memory_order.order.new_edges(loaded.marked_edges);
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const auto edges = c.vertex_edges[ends[k][0]];
    const auto edge = std::ranges::find(edges, ends[k][1], [&](int e) { return c.other_end(e, ends[k][0]); });
    if (edge == edges.end())
      fixed.insert(fixed.end(), loaded.marked_edges[k].begin(), loaded.marked_edges[k].end());
    else if (!c.is_boundary_edge(*edge))
      constraints.seams.push_back(loaded.marked_edges[k]);
  }
}

}  // namespace

void keep_seams(Settings& s, LoadedMesh& loaded, RunRecord& record) {
  const bool faces_stay = keeps_faces(s);
  if (faces_stay) hold_marks(loaded, s.remesh.constraints);
  if (faces_stay || s.keep.hard_edges)
    s.remesh.constraints.hard_edges = find_hard_edges(loaded.memory_order, loaded.corner_data.normals).ends;
  if (faces_stay && s.keep == no_seams) return;
  if (!faces_stay) {
    drop_unkept(s.keep, loaded, record);
    if (s.format != MeshFormat::obj) loaded.corner_data = {};
  }
  const FormatFaceData held =
      face_data_for_format(loaded.face_data, loaded.format, *s.format, encoding_of_output(s, loaded));
  Seams seams = find_seams(loaded.memory_order, loaded.corner_data, held.data, s.keep);
  warn_of_many_seams(seams, s, loaded, record);
  record.seam_edges = static_cast<int>(seams.edges.size());
  std::vector<Edge>& kept = s.remesh.constraints.seams;
  kept.insert(kept.end(), seams.ends.begin(), seams.ends.end());
  std::vector<int>& fixed = s.remesh.constraints.fixed_vertices;
  fixed.insert(fixed.end(), seams.poles.begin(), seams.poles.end());
  if (!faces_stay) s.remesh.map |= !loaded.face_data.empty() || !loaded.corner_data.empty();
}

void carry_data(const Settings& s, LoadedMesh& loaded, const Original& original, RunRecord& record) {
  if (keeps_faces(s)) warn_of_moved_values(s, loaded, original, record);
  if (loaded.face_data.empty() && loaded.corner_data.empty()) return;
  if (keeps_faces(s)) {
    if (!s.paper && s.keep == no_seams) warn_of_moved_borders(s, loaded, original, record);
    return;
  }
  const MemoryOrder &before = original.memory_order, &after = loaded.memory_order;
  Adjacency input = *before.adjacency, result = *after.adjacency;
  split_wedges(input, before.order.new_edges(record.result->input_creases));
  split_wedges(result, after.order.new_edges(record.result->crease_edges));
  const Mat3X points = after.order.gather(vertex_points(loaded.mesh));
  const Remeshed meshes{{original.points, input}, before, {points, result}, after.order};
  const ChartPlaces places =
      find_chart_places(meshes.input, meshes.result, faces_near(record.result->map, before, after));
  const FaceData of_input = std::move(loaded.face_data);
  loaded.face_data = carry_face_data(of_input, places, meshes);
  loaded.corner_data = carry_corner_data(loaded.corner_data, places, meshes);
  if (!of_input.empty())
    renumber_faces(order_by_labels(of_input, loaded.face_data, result.faces.size()), loaded, record);
}

}  // namespace hooke::app
