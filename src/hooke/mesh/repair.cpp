#include "hooke/mesh/repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>
#include <queue>
#include <unordered_set>
#include <utility>

#include "hooke/geometry/triangle.h"
#include "hooke/mesh/adjacency.h"
#include "hooke/mesh/extent.h"
#include "hooke/mesh/flaps.h"
#include "hooke/mesh/hole_filling.h"
#include "hooke/mesh/sheets.h"
#include "hooke/mesh/tiny_edges.h"
#include "hooke/mesh/touching_solids.h"
#include "hooke/mesh/vertex_welding.h"

namespace hooke {
namespace {

Triangle sorted(Triangle t) {
  std::ranges::sort(t);
  return t;
}

/// Have the triangles the same corners in the same direction?
bool are_same(const Triangle& t, const Triangle& other) {
  const auto& [a, b, c] = t;
  return other == t || other == Triangle{b, c, a} || other == Triangle{c, a, b};
}

/// The components of a manifold: of each face the smallest face that it hangs together with.
std::vector<int> components_of(const std::vector<Triangle>& triangles, size_t vertices) {
  std::vector<int> parent(vertices);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Triangle& t : triangles)
    for (size_t k = 1; k < 3; ++k) parent[root(t[k])] = root(t[0]);
  std::vector<int> first(vertices, -1), component(triangles.size());
  for (size_t f = 0; f < triangles.size(); ++f) {
    int& smallest = first[root(triangles[f][0])];
    if (smallest < 0) smallest = static_cast<int>(f);
    component[f] = smallest;
  }
  return component;
}

struct Boundary {
  std::vector<int> next;  // the vertex after each on its boundary, as a face has them; -1 off boundaries
  std::vector<int> face;  // with the edge to the next
  std::unordered_set<std::uint64_t> edges;  // keys of all edges of the mesh
};

Boundary find_boundary(const std::vector<Triangle>& triangles, size_t vertices) {
  Boundary b;
  b.next.assign(vertices, -1);
  b.face.assign(vertices, -1);
  std::unordered_set<std::uint64_t> twice;
  for (const Triangle& t : triangles)
    for (size_t k = 0; k < 3; ++k)
      if (const std::uint64_t key = edge_key(t[k], t[(k + 1) % 3]); !b.edges.insert(key).second)
        twice.insert(key);
  for (size_t f = 0; f < triangles.size(); ++f)
    for (size_t k = 0; k < 3; ++k) {
      const int from = triangles[f][k], to = triangles[f][(k + 1) % 3];
      if (twice.contains(edge_key(from, to))) continue;
      b.next[from] = to;
      b.face[from] = static_cast<int>(f);
    }
  return b;
}

double area_of(const Mat3X& points, const Triangle& t) {
  return .5 * doubled_area_vector(points, t).norm();
}

/// Over the longest edge.
double height_of(const Mat3X& points, const Triangle& t) {
  double longest = 0;
  for (size_t k = 0; k < 3; ++k)
    longest = std::max(longest, (points.col(t[k]) - points.col(t[(k + 1) % 3])).norm());
  return longest > 0 ? 2 * area_of(points, t) / longest : 0;
}

/// How often the faces wind around the point, by the solid angles of A. Van Oosterom, J. Strackee, "The solid
/// angle of a plane triangle", IEEE Transactions on Biomedical Engineering 30 (1983).
double winding_number(const Mat3X& points, const std::vector<Triangle>& faces, const Vec3& x) {
  double sum = 0;
  for (const Triangle& t : faces) {
    const Vec3 a = points.col(t[0]) - x, b = points.col(t[1]) - x, c = points.col(t[2]) - x;
    const double u = a.norm(), v = b.norm(), w = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), u * v * w + a.dot(b) * w + b.dot(c) * u + c.dot(a) * v);
  }
  return sum / (4 * std::numbers::pi);
}

/// In a foam with more tests than that, a component in the box of another is taken to be in the other.
constexpr size_t most_faces_tested = 100'000'000;

class Repair {
 public:
  Repair(const Mat3X& points, std::vector<Triangle> triangles, const RepairOptions& options,
         const MeshSource& source)
      : options_(options), source_(source) {
    r_.points = points;
    r_.triangles = std::move(triangles);
    r_.origin.vertex.resize(points.cols());
    std::iota(r_.origin.vertex.begin(), r_.origin.vertex.end(), 0);
    r_.origin.merged = r_.origin.vertex;
    r_.origin.face.resize(r_.triangles.size());
    std::iota(r_.origin.face.begin(), r_.origin.face.end(), 0);
    r_.origin.flipped.assign(r_.triangles.size(), 0);
  }

  Repaired make() {
    if (options_.drop_strays) drop_faces_that_repeat_a_vertex();
    if (options_.weld >= 0 || options_.weld_share >= 0) weld_all();
    if (options_.separate) separate_solids();
    if (options_.repair) {
      weld_boundaries();
      drop_faces_that_repeat_a_vertex();
      drop_flaps_and_duplicates();
      make_manifold();
      drop_small_components();
      fill_holes();
      turn_outward();
    }
    if (options_.collapse) collapse_edges_without_length();
    drop_unused_vertices();
    if (options_.keep_junctions) cut_at_junctions();
    if (r_.changes.empty() && r_.origin.joined.empty()) r_.origin = {};
    return std::move(r_);
  }

 private:
  // Telling. Places are old ids.

  static constexpr size_t places_told = 5;
  static constexpr char turned_over[] = "faces turned over to be oriented like their neighbours";

  void tell(const char* code, size_t count, const std::string& what, std::string places) {
    if (count == 0) return;
    if (count > places_told) places += " ...";
    r_.changes.push_back(
        {code, count,
         fmt::format("{}: {} {}{}{}", source_.name, count, what, places.empty() ? "" : ": ", places)});
  }

  /// "vertices 3, 5" of ids in the present mesh.
  std::string vertex_places(const std::vector<int>& vertices) const {
    std::string text;
    for (size_t k = 0; k < std::min(places_told, vertices.size()); ++k)
      text += (k == 0 ? "vertices " : ", ") + std::to_string(r_.origin.vertex[vertices[k]]);
    return text;
  }

  std::string edge_places(const std::vector<Edge>& edges) const {
    std::string text;
    for (size_t k = 0; k < std::min(places_told, edges.size()); ++k)
      text += fmt::format("{}{}-{}", k == 0 ? "edges " : ", ", r_.origin.vertex[edges[k][0]],
                          r_.origin.vertex[edges[k][1]]);
    return text;
  }

  std::string face_places(const std::vector<int>& faces) const {
    std::string text;
    for (size_t k = 0; k < std::min(places_told, faces.size()); ++k)
      text += (k == 0 ? "faces " : ", ") + face_text(r_.origin.face[faces[k]], source_);
    return text;
  }

  // Welding.

  void merge(const std::vector<double>& reach) {
    const std::vector<int> into = weld_vertices(r_.points, reach);
    std::vector<int> merged;
    for (size_t v = 0; v < into.size(); ++v)
      if (into[v] != static_cast<int>(v)) merged.push_back(static_cast<int>(v));
    for (Triangle& t : r_.triangles)
      for (int& v : t) v = into[v];
    for (int& v : r_.origin.merged) v = into[v];
    tell("vertices_welded", merged.size(), "vertices merged with others that lie where they do",
         vertex_places(merged));
  }

  void weld_all() {
    if (options_.repair) note_unwelded();
    const double distance =
        options_.weld >= 0 ? options_.weld
                           : options_.weld_share * box_of_faces(r_.points, r_.triangles).diagonal().norm();
    merge(std::vector<double>(r_.origin.vertex.size(), distance));
    drop_faces_that_repeat_a_vertex();
  }

  void note_unwelded() {
    unwelded_.resize(r_.origin.face.empty() ? 0 : r_.origin.face.back() + 1);
    const std::vector<int> in_place = weld_vertices(r_.points, std::vector(r_.points.cols(), 0.));
    for (size_t f = 0; f < r_.triangles.size(); ++f)
      for (size_t k = 0; k < 3; ++k) unwelded_[r_.origin.face[f]][k] = in_place[r_.triangles[f][k]];
  }

  void weld_boundaries() { merge(reach_of_boundary(r_.points, r_.triangles)); }

  // Collapsing.

  void collapse_edges_without_length() {
    const double longest = rounding_share * box_of_faces(r_.points, r_.triangles).diagonal().norm();
    const TinyEdges tiny = collapse_tiny_edges(r_.points, r_.triangles, longest);
    tell("edges_collapsed", tiny.collapsed.size(), "edges without length collapsed",
         edge_places(tiny.collapsed));
    if (tiny.collapsed.empty()) return;
    r_.triangles = tiny.triangles;
    // Old ids are the first of the present ones: copies come last.
    for (int& v : r_.origin.merged) v = r_.origin.vertex[tiny.into[v]];
    const auto over_holes = static_cast<int>(r_.triangles.size() - r_.origin.filled);
    r_.origin.filled -= std::ranges::count_if(tiny.removed, [&](int f) { return f >= over_holes; });
    remove(tiny.removed);
  }

  // Dropping.

  template <typename Drop>
  void drop_faces(const char* code, const std::string& what, const Drop& drop) {
    std::vector<int> dropped;
    for (int f = 0; f < static_cast<int>(r_.triangles.size()); ++f)
      if (drop(f)) dropped.push_back(f);
    if (dropped.empty()) return;
    tell(code, dropped.size(), what, face_places(dropped));
    remove(dropped);
  }

  /// Removes these faces, ascending.
  void remove(const std::vector<int>& faces) {
    size_t kept = 0, next = 0;
    for (size_t f = 0; f < r_.triangles.size(); ++f) {
      if (next < faces.size() && faces[next] == static_cast<int>(f)) {
        ++next;
        continue;
      }
      r_.triangles[kept] = r_.triangles[f];
      r_.origin.face[kept] = r_.origin.face[f];
      r_.origin.flipped[kept++] = r_.origin.flipped[f];
    }
    r_.triangles.resize(kept);
    r_.origin.face.resize(kept);
    r_.origin.flipped.resize(kept);
  }

  void drop_faces_that_repeat_a_vertex() {
    drop_faces("faces_dropped", "faces dropped that use a vertex twice",
               [&](int f) { return uses_a_vertex_twice(r_.triangles[f]); });
  }

  void drop_flaps_and_duplicates() {
    if (faces_of_same_vertices(r_.triangles).empty()) return;
    // With junctions, flaps may be two walls that come together, of which one stays.
    if (!options_.keep_junctions) {
      drop_duplicates("duplicate_faces_dropped", "faces dropped whose vertices another face has",
                      [&](int f, int g) { return are_same(r_.triangles[f], r_.triangles[g]); });
      drop_flaps(faces_of_same_vertices(r_.triangles));
      separate_solids();
    }
    const auto are_alike = [](int, int) { return true; };
    if (options_.keep_junctions)
      drop_duplicates("duplicate_faces_dropped", "faces dropped whose vertices another face has", are_alike);
    else
      drop_duplicates("opposite_faces_dropped", "faces dropped that lie back to back with another",
                      are_alike);
  }

  /// Of faces of the same vertices those that are like an earlier one.
  template <typename AreAlike>
  void drop_duplicates(const char* code, const char* what, const AreAlike& are_alike) {
    std::vector<char> is_duplicate(r_.triangles.size(), 0);
    for (const std::vector<int>& group : faces_of_same_vertices(r_.triangles))
      for (size_t i = 1; i < group.size(); ++i)
        is_duplicate[group[i]] = std::any_of(group.begin(), group.begin() + static_cast<std::ptrdiff_t>(i),
                                             [&](int earlier) { return are_alike(group[i], earlier); });
    drop_faces(code, what, [&](int f) { return is_duplicate[f] != 0; });
  }

  /// Of faces back to back those with nothing between them, because they are too thin, or because they
  /// bounded one body before it was welded: others may be the wall between two bodies, or the sides of a
  /// sheet.
  void drop_flaps(const std::vector<std::vector<int>>& groups) {
    constexpr double rounding = 10 * rounding_share;
    std::vector<int> bodies;
    const auto were_one_body = [&](int f, int g) {
      if (unwelded_.empty()) return false;
      if (bodies.empty()) bodies = closed_bodies(unwelded_);
      const int first = r_.origin.face[f], second = r_.origin.face[g];
      return bodies[first] >= 0 && bodies[first] == bodies[second] &&
             !std::ranges::is_permutation(unwelded_[first], unwelded_[second]);
    };
    std::vector<std::array<int, 2>> pairs = faces_back_to_back(r_.triangles, groups);
    const std::vector<double> sizes = sizes_of_components();
    std::erase_if(pairs, [&](const std::array<int, 2>& pair) {
      return height_of(r_.points, r_.triangles[pair[0]]) > rounding * sizes[pair[0]] &&
             !were_one_body(pair[0], pair[1]);
    });
    const std::vector<int> flaps = find_flaps(r_.triangles, pairs);
    drop_faces("flaps_dropped", "faces dropped that lie back to back with nothing between them",
               [&](int f) { return std::ranges::binary_search(flaps, f); });
  }

  /// The diagonal of the box of the component of each face.
  std::vector<double> sizes_of_components() const {
    const std::vector<int> component = components_of(r_.triangles, r_.points.cols());
    std::vector<Eigen::AlignedBox3d> boxes(component.size());
    for (size_t f = 0; f < component.size(); ++f)
      for (const int v : r_.triangles[f]) boxes[component[f]].extend(Vec3(r_.points.col(v)));
    std::vector<double> sizes;
    for (const int c : component) sizes.push_back(boxes[c].diagonal().norm());
    return sizes;
  }

  void drop_small_components() {
    if (options_.drop_components <= 0 || r_.triangles.empty()) return;
    const std::vector<int> component = components_of(r_.triangles, r_.points.cols());
    std::vector<double> area(component.size(), 0);
    double total = 0;
    for (size_t f = 0; f < component.size(); ++f) {
      const double own = area_of(r_.points, r_.triangles[f]);
      area[component[f]] += own;
      total += own;
    }
    std::vector<int> faces, firsts;
    for (int f = 0; f < static_cast<int>(component.size()); ++f) {
      if (area[component[f]] >= options_.drop_components * total) continue;
      faces.push_back(f);
      if (component[f] == f) firsts.push_back(f);
    }
    tell("components_dropped", firsts.size(),
         fmt::format("components dropped, {} faces, with less than {:.4g} % of the area each", faces.size(),
                     100 * options_.drop_components),
         face_places(firsts));
    remove(faces);
  }

  void drop_unused_vertices() {
    std::vector<char> used(r_.origin.vertex.size(), 0);
    for (const Triangle& t : r_.triangles)
      for (const int v : t) used[v] = 1;
    const bool keeps_loose = !options_.repair && !options_.drop_strays;
    if (keeps_loose)  // but for those that were merged; copies of split ones come after these
      for (size_t v = 0; v < r_.origin.merged.size(); ++v)
        used[v] |= r_.origin.merged[v] == static_cast<int>(v);
    std::vector<int> fresh(used.size(), -1), loose, source;
    for (int v = 0; v < static_cast<int>(used.size()); ++v) {
      if (used[v]) {
        fresh[v] = static_cast<int>(source.size());
        source.push_back(v);
      } else if (v < static_cast<int>(r_.origin.merged.size()) && r_.origin.merged[v] == v) {
        loose.push_back(v);
      }
    }
    if (source.size() == used.size()) return;
    tell("vertices_dropped", loose.size(), "vertices in no face dropped", vertex_places(loose));
    Mat3X points(3, static_cast<Eigen::Index>(source.size()));
    std::vector<int> origin;
    for (const int v : source) {
      points.col(static_cast<Eigen::Index>(origin.size())) = r_.points.col(v);
      origin.push_back(r_.origin.vertex[v]);
    }
    r_.points = std::move(points);
    r_.origin.vertex = std::move(origin);
    for (Triangle& t : r_.triangles)
      for (int& v : t) v = fresh[v];
  }

  // Cutting and orienting.

  void orient() {
    const Sheets sheets = make_sheets(r_.points, r_.triangles, ManyFaces::apart);
    tell("faces_flipped", sheets.flipped_faces.size(), turned_over, face_places(sheets.flipped_faces));
    for (const int f : sheets.flipped_faces) {
      r_.origin.flipped[f] ^= 1;
      std::swap(r_.triangles[f][1], r_.triangles[f][2]);
    }
  }

  /// Is the mesh an oriented manifold but for what can be kept?
  bool has_junctions() const {
    bool found = false;
    for (const Problem& problem : find_problems(r_.points, r_.triangles)) {
      if (is_acceptable(problem.kind)) continue;
      const bool is_one_sided = problem.kind == ProblemKind::inconsistent_orientation && options_.repair;
      if (!is_junction(problem.kind) && !is_one_sided) return false;
      found = true;
    }
    return found;
  }

  void cut_at_junctions() {
    if (!has_junctions()) return;
    Sheets sheets = make_sheets(r_.points, r_.triangles, ManyFaces::apart);
    replace_by(sheets);
    r_.origin.joined = std::move(sheets.source);
  }

  void separate_solids() {
    std::optional<Sheets> sheets = separate_touching_solids(r_.points, r_.triangles);
    if (!sheets) return;
    tell("edges_cut", sheets->cut_edges.size(), "edges in which solids touch taken apart",
         edge_places(sheets->cut_edges));
    tell("vertices_split", sheets->split_vertices.size(), "vertices in which solids touch taken apart",
         vertex_places(sheets->split_vertices));
    replace_by(*sheets);
  }

  void make_manifold() {
    if (options_.keep_junctions) return orient();
    Sheets sheets = make_sheets(r_.points, r_.triangles);
    const char* const hint =
        sheets.guessed_edges.empty() ? "" : " (--keep non-manifold leaves walls between bodies joined)";
    tell("edges_cut", sheets.cut_edges.size(),
         fmt::format("edges with three or more faces cut into sheets{}", hint),
         edge_places(sheets.cut_edges));
    tell("surface_opened", sheets.opened_edges.size(),
         "edges cut open, as the surface there has only one side", edge_places(sheets.opened_edges));
    tell("vertices_split", sheets.split_vertices.size(),
         "vertices split in which separate parts only touched", vertex_places(sheets.split_vertices));
    tell("faces_flipped", sheets.flipped_faces.size(), turned_over, face_places(sheets.flipped_faces));
    for (const int f : sheets.flipped_faces) r_.origin.flipped[f] ^= 1;
    replace_by(sheets);
  }

  void replace_by(Sheets& sheets) {
    Mat3X points(3, static_cast<Eigen::Index>(sheets.source.size()));
    std::vector<int> origin;
    for (const int v : sheets.source) {
      points.col(static_cast<Eigen::Index>(origin.size())) = r_.points.col(v);
      origin.push_back(r_.origin.vertex[v]);
    }
    r_.points = std::move(points);
    r_.origin.vertex = std::move(origin);
    r_.triangles = std::move(sheets.triangles);
  }

  /// Marks the vertices where sheets meet that are kept; empty if none are.
  std::vector<char> at_junctions() const {
    if (!options_.keep_junctions) return {};
    const Sheets sheets = make_sheets(r_.points, r_.triangles, ManyFaces::apart);
    std::vector<char> marks(r_.origin.vertex.size(), 0);
    for (size_t v = marks.size(); v < sheets.source.size(); ++v) marks[sheets.source[v]] = 1;
    for (const Edge& edge : sheets.cut_edges)
      for (const int v : edge) marks[v] = 1;
    return marks;
  }

  /// Holes that end at junctions are left, as it is not known which boundary goes on there.
  void fill_holes() {
    if (options_.fill_holes <= 0) return;
    Boundary boundary = find_boundary(r_.triangles, r_.origin.vertex.size());
    const std::vector<char> junction = at_junctions();
    std::vector<char> seen(boundary.next.size(), 0);
    std::vector<int> filled, left;  // a vertex of each hole
    size_t faces = 0;
    for (int start = 0; start < static_cast<int>(seen.size()); ++start) {
      if (seen[start] || boundary.next[start] < 0) continue;
      std::vector<int> loop;
      for (int v = start; v >= 0 && !seen[v]; v = boundary.next[v]) {
        seen[v] = 1;
        loop.push_back(v);
      }
      if (std::ssize(loop) > options_.fill_holes) continue;
      const bool is_open =
          !junction.empty() && std::ranges::any_of(loop, [&](int v) { return junction[v] != 0; });
      const size_t added = is_open ? 0 : fill(loop, boundary);
      (added > 0 ? filled : left).push_back(start);
      faces += added;
    }
    tell("holes_filled", filled.size(), fmt::format("holes filled with {} faces", faces),
         vertex_places(filled));
    tell("holes_left", left.size(), "holes left, as no triangles fit in", vertex_places(left));
    r_.origin.filled = faces;
  }

  /// Fills the hole inside a boundary. Returns the number of new faces.
  size_t fill(std::vector<int> loop, Boundary& boundary) {
    const int neighbour = boundary.face[loop.front()];
    if (loop.size() == 3 && sorted({loop[0], loop[1], loop[2]}) == sorted(r_.triangles[neighbour]))
      return 0;  // the outer edges of a single triangle
    if (loop.size() < 3) return 0;
    std::ranges::reverse(loop);
    const auto triangles =
        fill_polygon(r_.points, loop, [&](int a, int b) { return boundary.edges.contains(edge_key(a, b)); });
    if (!triangles) return 0;
    for (const Triangle& t : *triangles) {
      for (size_t k = 0; k < 3; ++k) boundary.edges.insert(edge_key(t[k], t[(k + 1) % 3]));
      r_.triangles.push_back(t);
      r_.origin.face.push_back(r_.origin.face[neighbour]);
      r_.origin.flipped.push_back(0);
    }
    return triangles->size();
  }

  struct Component {
    std::vector<int> faces;
    std::vector<Triangle> triangles;
    Eigen::AlignedBox3d box;
    double volume = 0;
    bool closed = true;
  };

  std::vector<Component> closed_components() const {
    const std::vector<int> component = components_of(r_.triangles, r_.origin.vertex.size());
    const Boundary boundary = find_boundary(r_.triangles, r_.origin.vertex.size());
    const std::vector<char> junction = at_junctions();
    std::vector<int> number(component.size(), -1);
    std::vector<Component> found;
    for (int f = 0; f < static_cast<int>(component.size()); ++f) {
      int& n = number[component[f]];
      if (n < 0) {
        n = static_cast<int>(found.size());
        found.emplace_back();
      }
      Component& c = found[n];
      const Triangle& t = r_.triangles[f];
      c.faces.push_back(f);
      c.triangles.push_back(t);
      const Vec3 origin = r_.points.col(c.triangles.front()[0]);
      c.volume += (r_.points.col(t[0]) - origin)
                      .dot((r_.points.col(t[1]) - origin).cross(r_.points.col(t[2]) - origin)) /
                  6;
      for (const int v : t) {
        c.box.extend(Vec3(r_.points.col(v)));
        c.closed &= boundary.next[v] < 0 && (junction.empty() || !junction[v]);
      }
    }
    std::erase_if(found, [](const Component& c) { return !c.closed; });
    return found;
  }

  /// A component in another may be meant to be inside out: a cavity.
  void turn_outward() {
    const std::vector<Component> components = closed_components();
    std::vector<int> turned, firsts, left;
    size_t faces_tested = 0;
    for (const Component& c : components) {
      const Vec3 x = r_.points.col(c.triangles.front()[0]);
      const auto holds_it = [&](const Component& other) {
        if (&other == &c || !other.box.contains(c.box)) return false;
        faces_tested += other.triangles.size();
        return std::abs(winding_number(r_.points, other.triangles, x)) > .5;
      };
      if (c.volume >= 0) continue;
      if (faces_tested > most_faces_tested) {
        left.push_back(c.faces.front());
        continue;
      }
      if (std::ranges::any_of(components, holds_it)) continue;
      firsts.push_back(c.faces.front());
      turned.insert(turned.end(), c.faces.begin(), c.faces.end());
    }
    tell("components_turned", firsts.size(),
         fmt::format("components turned outward, {} faces", turned.size()), face_places(firsts));
    tell("components_left", left.size(),
         "components are inside out, and too many to tell whether they are cavities: left as they are",
         face_places(left));
    for (const int f : turned) {
      std::swap(r_.triangles[f][1], r_.triangles[f][2]);
      r_.origin.flipped[f] ^= 1;
    }
  }

  const RepairOptions& options_;
  const MeshSource& source_;
  Repaired r_;
  std::vector<Triangle> unwelded_;  // by old face, as they were before more than places were welded
};

}  // namespace

Repaired repair(const Mat3X& points, std::vector<Triangle> triangles, const RepairOptions& options,
                const MeshSource& source) {
  return Repair(points, std::move(triangles), options, source).make();
}

std::vector<int> vertices_from(const MeshOrigin& origin, const std::vector<int>& old, int* lost) {
  std::vector<char> wanted(origin.merged.size(), 0), found(origin.merged.size(), 0);
  for (const int v : old) wanted[origin.merged[v]] = 1;
  std::vector<int> vertices;
  for (size_t v = 0; v < origin.vertex.size(); ++v) {
    if (!wanted[origin.vertex[v]]) continue;
    found[origin.vertex[v]] = 1;
    vertices.push_back(static_cast<int>(v));
  }
  const auto gone = std::ranges::find_if(old, [&](int v) { return !found[origin.merged[v]]; });
  if (lost) *lost = gone == old.end() ? -1 : *gone;
  return vertices;
}

std::vector<MapEntry> map_to_old(std::vector<MapEntry> map, const MeshOrigin& origin) {
  if (origin.vertex.empty()) return map;
  const size_t over_holes = origin.face.size() - origin.filled;
  for (MapEntry& entry : map) {
    if (entry.vertex >= 0) entry.vertex = origin.vertex[entry.vertex];
    SurfacePoint& point = entry.position;
    if (point.face < 0) continue;
    if (std::cmp_greater_equal(point.face, over_holes)) {
      point = {};
      continue;
    }
    if (origin.flipped[point.face]) std::swap(point.weights[1], point.weights[2]);
    point.face = origin.face[point.face];
  }
  return map;
}

}  // namespace hooke
