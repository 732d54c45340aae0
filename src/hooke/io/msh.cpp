#include "hooke/io/msh.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "hooke/core/error.h"
#include "hooke/core/printable.h"
#include "hooke/io/msh_format.h"
#include "hooke/io/text.h"

namespace hooke {
namespace {

// The polygons and the nodes that they use.
void take_polygons(const MshContent& content, MeshFile& file) {
  auto corner = content.corners.begin();
  for (const int size : content.sizes) {
    for (int k = 0; k < size; ++k) file.polygons.items.push_back(content.vertex[*corner++]);
    end_polygon(file);
  }
  file.points.resize(3, std::ranges::count_if(content.vertex, [](int v) { return v >= 0; }));
  for (size_t n = 0; n < content.nodes.size(); ++n)
    if (content.vertex[n] >= 0) file.points.col(content.vertex[n]) = content.nodes[n];
  for (const int node : content.points)
    if (content.vertex[node] >= 0) file.marked_vertices.push_back(content.vertex[node]);
  for (const auto& [from, to] : content.segments)
    if (content.vertex[from] >= 0 && content.vertex[to] >= 0)
      file.marked_edges.push_back({content.vertex[from], content.vertex[to]});
}

std::vector<std::string> kinds_not_kept(const MshContent& content, size_t vertices) {
  std::vector<std::string> kinds;
  for (const auto& [plural, others] : content.other_elements)
    kinds.push_back(fmt::format("{} {}", others.count, plural));
  if (const size_t loose = content.nodes.size() - vertices; loose > 0)
    kinds.push_back(fmt::format("{} nodes of no triangle", loose));
  if (content.in_several_groups > 0)
    kinds.push_back(fmt::format("all physical groups but the first of {} faces", content.in_several_groups));
  for (const std::string& section : content.other_sections)
    kinds.push_back(fmt::format("section {}", in_quotes(section)));
  return kinds;
}

bool any_label(const FaceChannel& channel) {
  return std::ranges::any_of(channel.values, [](int value) { return value != 0; });
}

}  // namespace

MeshFile read_msh(std::string_view bytes, const std::string& name) {
  MshContent content = read_msh_content(bytes, name);
  MeshFile file;
  file.name = name;
  file.format = content.old ? MeshFormat::msh2 : MeshFormat::msh;
  file.encoding = PlyEncoding::ascii;
  take_polygons(content, file);
  file.lines = std::move(content.lines);
  const std::vector<std::string> kinds = kinds_not_kept(content, file.points.cols());
  if (content.sizes.empty())
    throw InputError(
        fmt::format("{}: no triangles, but {}; expected a surface mesh of first order; make one with gmsh "
                    "-2 -order 1",
                    name, kinds.empty() ? "nothing else" : fmt::format("{}", fmt::join(kinds, ", "))));
  warn_not_kept(file, kinds);
  if (any_label(content.groups)) file.face_data.push_back(std::move(content.groups));
  if (any_label(content.entities)) file.face_data.push_back(std::move(content.entities));
  return file;
}

namespace {

// The surfaces of an output: a label for each face.
struct Surfaces {
  std::vector<int> entity;            // of each face
  std::map<int, int> group;           // of each entity; 0 for none
  std::map<int, std::string> titles;  // of groups

  Surfaces(size_t faces, const FaceData& data) : entity(faces, 1) {
    const FaceChannel* groups = find_channel(data, group_channel);
    const FaceChannel* entities = find_channel(data, entity_channel);
    const auto group_of = [&](size_t f) { return groups ? groups->values[f] : 0; };
    if (groups) titles = groups->names;
    if (entities && fits(*entities, group_of)) {
      entity = entities->values;
    } else {
      std::map<std::pair<int, int>, int> numbers;  // by entity and group, in the order of their first faces
      for (size_t f = 0; f < faces; ++f)
        entity[f] = numbers
                        .try_emplace({entities ? entities->values[f] : 0, group_of(f)},
                                     static_cast<int>(numbers.size()) + 1)
                        .first->second;
    }
    for (size_t f = 0; f < faces; ++f) group[entity[f]] = group_of(f);
    std::erase_if(titles, [&](const auto& title) {
      return std::ranges::none_of(group, [&](const auto& g) { return g.second == title.first; });
    });
  }

 private:
  // Whether each of the entities is positive and has one group.
  template <typename GroupOf>
  static bool fits(const FaceChannel& entities, const GroupOf& group_of) {
    std::map<int, int> found;
    for (size_t f = 0; f < entities.values.size(); ++f)
      if (entities.values[f] < 1 ||
          found.try_emplace(entities.values[f], group_of(f)).first->second != group_of(f))
        return false;
    return true;
  }
};

void append_titles(std::string& text, const Surfaces& surfaces) {
  if (surfaces.titles.empty()) return;
  text += fmt::format("$PhysicalNames\n{}\n", surfaces.titles.size());
  for (const auto& [group, title] : surfaces.titles) text += fmt::format("2 {} \"{}\"\n", group, title);
  text += "$EndPhysicalNames\n";
}

void append_entities(std::string& text, const Eigen::Ref<const Mat3X>& points,
                     const std::vector<Triangle>& triangles, const Surfaces& surfaces) {
  std::map<int, Eigen::AlignedBox3d> boxes;
  for (size_t f = 0; f < triangles.size(); ++f)
    for (const int v : triangles[f]) boxes[surfaces.entity[f]].extend(Vec3(points.col(v)));
  text += fmt::format("$Entities\n0 0 {} 0\n", surfaces.group.size());
  for (const auto& [entity, group] : surfaces.group) {
    const Eigen::AlignedBox3d& box = boxes[entity];
    text += fmt::format("{} ", entity);
    append_three(text, box.min());
    text += ' ';
    append_three(text, box.max());
    text += group == 0 ? " 0 0\n" : fmt::format(" 1 {} 0\n", group);
  }
  text += "$EndEntities\n";
}

void append_row(std::string& text, size_t number, const Triangle& triangle) {
  append_number(text, number);
  for (const int v : triangle) {
    text += ' ';
    append_number(text, v + 1);
  }
  text += '\n';
}

std::string write_new(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      const Surfaces& surfaces) {
  std::string text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  append_titles(text, surfaces);
  append_entities(text, points, triangles, surfaces);
  const int first_entity = surfaces.entity.empty() ? 1 : surfaces.entity.front();
  text += fmt::format("$Nodes\n1 {0} 1 {0}\n2 {1} 0 {0}\n", points.cols(), first_entity);
  for (Eigen::Index v = 1; v <= points.cols(); ++v) {
    append_number(text, v);
    text += '\n';
  }
  append_vertex_rows(text, points, "");
  std::vector<size_t> ends;  // of the runs of faces of one entity, which keep the order of the faces
  for (size_t f = 1; f <= triangles.size(); ++f)
    if (f == triangles.size() || surfaces.entity[f] != surfaces.entity[f - 1]) ends.push_back(f);
  text += fmt::format("$EndNodes\n$Elements\n{0} {1} 1 {1}\n", ends.size(), triangles.size());
  size_t f = 0;
  for (const size_t end : ends) {
    text += fmt::format("2 {} {} {}\n", surfaces.entity[f], triangle_code, end - f);
    for (; f < end; ++f) append_row(text, f + 1, triangles[f]);
  }
  return text + "$EndElements\n";
}

std::string write_old(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      const Surfaces& surfaces) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  append_titles(text, surfaces);
  text += fmt::format("$Nodes\n{}\n", points.cols());
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    append_number(text, v + 1);
    text += ' ';
    append_three(text, points.col(v));
    text += '\n';
  }
  text += fmt::format("$EndNodes\n$Elements\n{}\n", triangles.size());
  for (size_t f = 0; f < triangles.size(); ++f) {
    append_number(text, f + 1);
    text += fmt::format(" {} 2 {} ", triangle_code, surfaces.group.at(surfaces.entity[f]));
    append_row(text, surfaces.entity[f], triangles[f]);
  }
  return text + "$EndElements\n";
}

}  // namespace

std::string write_msh(const Eigen::Ref<const Mat3X>& points, const std::vector<Triangle>& triangles,
                      MeshFormat version, const FaceData& data) {
  const Surfaces surfaces(triangles.size(), data);
  return version == MeshFormat::msh2 ? write_old(points, triangles, surfaces)
                                     : write_new(points, triangles, surfaces);
}

}  // namespace hooke
