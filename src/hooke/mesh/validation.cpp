#include "hooke/mesh/validation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "hooke/core/error.h"
#include "hooke/core/lists.h"
#include "hooke/core/parallel.h"
#include "hooke/mesh/extent.h"

namespace hooke {
namespace {

constexpr size_t validation_block = 1024;

// Collects the problems, each kind once.
class Findings {
 public:
  void add(ProblemKind kind, std::initializer_list<int> faces, std::initializer_list<int> vertices) {
    auto known =
        std::find_if(problems_.begin(), problems_.end(), [&](const Problem& p) { return p.kind == kind; });
    if (known == problems_.end()) known = problems_.insert(known, Problem{kind, 0, {}, {}});
    Problem& problem = *known;
    if (++problem.count > max_locations) return;
    problem.faces.insert(problem.faces.end(), faces);
    problem.vertices.insert(problem.vertices.end(), vertices);
  }
  bool empty() const { return problems_.empty(); }
  std::vector<Problem> sorted() {
    std::sort(problems_.begin(), problems_.end(),
              [](const Problem& a, const Problem& b) { return a.kind < b.kind; });
    return problems_;
  }

 private:
  std::vector<Problem> problems_;
};

// An edge of a face, stored with the smaller of its two vertices.
struct FaceEdge {
  int to;  // the larger vertex
  int face;
  int opposite;  // third vertex of the face
  bool upward;   // runs from the smaller to the larger vertex
};

// One list of items per vertex, stored end to end.
template <typename Item>
struct Buckets {
  std::vector<size_t> first;
  std::vector<Item> items;
  Item* begin(size_t i) { return items.data() + first[i]; }
  Item* end(size_t i) { return items.data() + first[i + 1]; }
};

// Fills buckets in face order: each(face, add) calls add(vertex, item) for every item of the face.
template <typename Item, typename Each>
Buckets<Item> fill_buckets(size_t vertices, size_t faces, const Each& each) {
  Buckets<Item> buckets;
  buckets.first.assign(vertices + 1, 0);
  for (size_t f = 0; f < faces; ++f) each(f, [&](int v, const Item&) { ++buckets.first[v + 1]; });
  for (size_t v = 0; v < vertices; ++v) buckets.first[v + 1] += buckets.first[v];
  buckets.items.resize(buckets.first[vertices]);
  std::vector<size_t> next(buckets.first.begin(), buckets.first.end() - 1);
  for (size_t f = 0; f < faces; ++f)
    each(f, [&](int v, const Item& item) { buckets.items[next[v]++] = item; });
  return buckets;
}

void find_bad_corners(const Mat3X& points, const std::vector<Triangle>& triangles, Findings& findings) {
  for (size_t f = 0; f < triangles.size(); ++f) {
    const int face = static_cast<int>(f);
    const auto& [a, b, c] = triangles[f];
    for (const int v : triangles[f])
      if (v < 0 || v >= points.cols()) findings.add(ProblemKind::index_out_of_range, {face}, {v});
    if (a == b || a == c)
      findings.add(ProblemKind::repeated_index, {face}, {a});
    else if (b == c)
      findings.add(ProblemKind::repeated_index, {face}, {b});
  }
  for (int v = 0; v < points.cols(); ++v)
    if (!points.col(v).allFinite()) findings.add(ProblemKind::not_finite, {}, {v});
}

// Reports what is wrong with the faces [begin, end) on the edge from `from`, sorted by their opposite vertex.
void check_edge(int from, const FaceEdge* begin, const FaceEdge* end, Findings& findings) {
  bool duplicates = false;
  for (const FaceEdge* edge = begin + 1; edge < end; ++edge) {
    if (edge->opposite != edge[-1].opposite) continue;
    duplicates = true;
    // Each duplicate shares three edges; it is reported at the one with the two smallest vertices.
    if (edge->opposite > edge->to)
      findings.add(ProblemKind::duplicate_face, {edge[-1].face, edge->face},
                   {from, edge->to, edge->opposite});
  }
  if (duplicates) return;
  if (end - begin > 2)
    findings.add(ProblemKind::non_manifold_edge, {begin[0].face, begin[1].face, begin[2].face},
                 {from, begin->to});
  else if (end - begin == 2 && begin[0].upward == begin[1].upward)
    findings.add(ProblemKind::inconsistent_orientation, {begin[0].face, begin[1].face}, {from, begin->to});
}

void find_bad_edges(size_t vertices, const std::vector<Triangle>& triangles, Findings& findings) {
  auto edges = fill_buckets<FaceEdge>(vertices, triangles.size(), [&](size_t f, const auto& add) {
    for (size_t k = 0; k < 3; ++k) {
      const int a = triangles[f][k], b = triangles[f][(k + 1) % 3];
      add(std::min(a, b), FaceEdge{std::max(a, b), static_cast<int>(f), triangles[f][(k + 2) % 3], a < b});
    }
  });
  parallel_for(vertices, validation_block, [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v)
      std::sort(edges.begin(v), edges.end(v), [](const FaceEdge& a, const FaceEdge& b) {
        return std::tie(a.to, a.opposite, a.face) < std::tie(b.to, b.opposite, b.face);
      });
  });
  for (size_t v = 0; v < vertices; ++v) {
    const FaceEdge* const end = edges.end(v);
    for (const FaceEdge *edge = edges.begin(v), *last; edge < end; edge = last) {
      last = std::find_if(edge, end, [&](const FaceEdge& other) { return other.to != edge->to; });
      check_edge(static_cast<int>(v), edge, last, findings);
    }
  }
}

// Number of connected components of a graph with these edges.
int count_parts(const Edge* begin, const Edge* end, std::vector<int>& nodes, std::vector<size_t>& parent) {
  nodes.clear();
  for (const Edge* e = begin; e < end; ++e) nodes.insert(nodes.end(), e->begin(), e->end());
  sort_unique(nodes);
  parent.resize(nodes.size());
  for (size_t i = 0; i < parent.size(); ++i) parent[i] = i;
  const auto root = [&](int id) {
    size_t i = std::lower_bound(nodes.begin(), nodes.end(), id) - nodes.begin();
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  int parts = static_cast<int>(nodes.size());
  for (const Edge* e = begin; e < end; ++e) {
    const size_t a = root((*e)[0]), b = root((*e)[1]);
    if (a == b) continue;
    parent[a] = b;
    --parts;
  }
  return parts;
}

// The faces around a manifold vertex form one fan: the edges opposite to it are one chain.
void find_bad_vertices(size_t vertices, const std::vector<Triangle>& triangles, Findings& findings) {
  auto links = fill_buckets<Edge>(vertices, triangles.size(), [&](size_t f, const auto& add) {
    const auto& [a, b, c] = triangles[f];
    add(a, Edge{b, c});
    add(b, Edge{c, a});
    add(c, Edge{a, b});
  });
  std::vector<int> parts(vertices);
  parallel_for(vertices, validation_block, [&](size_t begin, size_t end) {
    std::vector<int> nodes;
    std::vector<size_t> parent;
    for (size_t v = begin; v < end; ++v) parts[v] = count_parts(links.begin(v), links.end(v), nodes, parent);
  });
  for (size_t v = 0; v < vertices; ++v)
    if (parts[v] > 1) findings.add(ProblemKind::non_manifold_vertex, {}, {static_cast<int>(v)});
}

void find_lone_parts(const IntLists& vertex_faces, size_t faces, Findings& findings) {
  bool shared = false;
  for (int v = 0; v < static_cast<int>(vertex_faces.first.size()) - 1; ++v) {
    if (vertex_faces[v].empty()) findings.add(ProblemKind::isolated_vertices, {}, {v});
    shared |= vertex_faces[v].size() > 1;
  }
  if (!shared && faces > 1) findings.add(ProblemKind::unconnected_triangles, {}, {});
}

// Fast test; if it is false, has_no_area() decides.
bool surely_has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  const double size = std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
  const double longest2 = std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
  // Squared height over the longest edge, relative to the size; far from underflow and overflow.
  return size > 1e-50 && size < 1e50 && u.cross(v).squaredNorm() > 1e-26 * longest2 * size * size;
}

// Zero up to the rounding of the coordinates. Lengths are taken relative to the size of the coordinates,
// heights relative to lengths: no product underflows or overflows.
bool has_no_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double size = std::max({a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff(), c.cwiseAbs().maxCoeff()});
  if (size == 0) return true;
  const Vec3 p = a / size, u = b / size - p, v = c / size - p;
  const double longest = std::max({u.norm(), v.norm(), (v - u).norm()});
  if (longest == 0) return true;
  const double height = (u / longest).cross(v / longest).norm() * longest;
  return height <= 4 * std::numeric_limits<double>::epsilon();
}

void find_zero_areas(const Mat3X& points, const std::vector<Triangle>& triangles, Findings& findings) {
  std::vector<char> flat(triangles.size());
  parallel_for(triangles.size(), validation_block, [&](size_t begin, size_t end) {
    for (size_t f = begin; f < end; ++f) {
      const auto& [a, b, c] = triangles[f];
      const Vec3 p = points.col(a), q = points.col(b), r = points.col(c);
      flat[f] = !surely_has_area(p, q, r) && has_no_area(p, q, r);
    }
  });
  if (std::find(flat.begin(), flat.end(), 0) == flat.end()) return findings.add(ProblemKind::no_area, {}, {});
  for (size_t f = 0; f < flat.size(); ++f)
    if (flat[f]) findings.add(ProblemKind::zero_area_faces, {static_cast<int>(f)}, {});
}

}  // namespace

std::vector<Problem> find_problems(const Mat3X& points, const std::vector<Triangle>& triangles,
                                   VertexFans* fans) {
  Findings findings;
  if (triangles.empty()) findings.add(ProblemKind::no_faces, {}, {});
  find_bad_corners(points, triangles, findings);
  if (!findings.empty()) return findings.sorted();
  const size_t vertices = points.cols();
  VertexFans own_fans = examine_fans(static_cast<int>(vertices), triangles);
  if (first_broken(own_fans) >= 0) {  // find out what and where
    find_bad_edges(vertices, triangles, findings);
    find_bad_vertices(vertices, triangles, findings);
  }
  find_lone_parts(own_fans.faces, triangles.size(), findings);
  find_zero_areas(points, triangles, findings);
  if (fans) *fans = std::move(own_fans);
  return findings.sorted();
}

namespace {

struct Explanation {
  ProblemKind kind;
  const char* name;
  const char* what;  // in the plural
  const char* help;  // of acceptable problems: by a repair
  bool repairable = false;
};

constexpr Explanation explanations[] = {
    {ProblemKind::no_faces, "no_faces", "no faces", "give a surface mesh, not a point cloud or curves"},
    {ProblemKind::index_out_of_range, "index_out_of_range", "face corners that are not vertices",
     "correct the indices"},
    {ProblemKind::repeated_index, "repeated_index", "faces that use a vertex twice", "remove these faces",
     true},
    {ProblemKind::not_finite, "not_finite", "vertices that are not finite", "correct their coordinates"},
    {ProblemKind::duplicate_face, "duplicate_face", "faces listed twice", "remove the duplicates", true},
    {ProblemKind::non_manifold_edge, "non_manifold_edge", "edges with three or more faces",
     "remove or separate the extra faces", true},
    {ProblemKind::inconsistent_orientation, "inconsistent_orientation",
     "edges whose two faces are oriented against each other", "orient the faces alike", true},
    {ProblemKind::non_manifold_vertex, "non_manifold_vertex", "vertices in which separate parts only touch",
     "give each part its own vertex", true},
    {ProblemKind::no_area, "no_area", "no face with an area", "check the coordinates"},
    {ProblemKind::zero_area_faces, "zero_area_faces", "faces without area", ""},
    {ProblemKind::isolated_vertices, "isolated_vertices", "vertices in no face, kept where they are", ""},
    {ProblemKind::unconnected_triangles, "unconnected_triangles",
     "no two triangles share a vertex: every one is on its own", "; --repair joins them"},
};

const Explanation& explain(ProblemKind kind) {
  return explanations[static_cast<size_t>(kind)];
}

bool is_about_the_whole(ProblemKind kind) {
  return kind == ProblemKind::no_faces || kind == ProblemKind::no_area ||
         kind == ProblemKind::unconnected_triangles;
}

// The locations of a problem: "edges 3-5, 5-9; faces 1, 2, 7".
std::string locations_text(const Problem& problem, const MeshSource& source) {
  const bool edges =
      problem.kind == ProblemKind::non_manifold_edge || problem.kind == ProblemKind::inconsistent_orientation;
  std::string vertices, faces;
  for (size_t k = 0; k < problem.vertices.size(); ++k) {
    if (k > 0) vertices += edges && k % 2 == 1 ? "-" : ", ";
    vertices += std::to_string(problem.vertices[k]);
  }
  for (const int face : problem.faces) faces += (faces.empty() ? "" : ", ") + face_text(face, source);
  const std::string more = problem.count > max_locations ? " ..." : "";
  if (problem.faces.empty()) return "vertices " + vertices + more;
  if (problem.vertices.empty()) return "faces " + faces + more;
  return fmt::format("{} {}{}, faces {}{}", edges ? "edges" : "vertices", vertices, more, faces, more);
}

std::string problem_text(const Problem& problem, const MeshSource& source) {
  const Explanation& explanation = explain(problem.kind);
  if (is_about_the_whole(problem.kind)) return explanation.what;
  return fmt::format("{} ({}): {}", explanation.what, problem.count, locations_text(problem, source));
}

}  // namespace

std::string face_text(int triangle, const MeshSource& source) {
  const int face = source.face.empty() ? triangle : source.face[triangle];
  return source.line.empty() ? std::to_string(face) : fmt::format("{} (line {})", face, source.line[face]);
}

std::string name_of(ProblemKind kind) {
  return explain(kind).name;
}

bool is_acceptable(ProblemKind kind) {
  return kind >= ProblemKind::zero_area_faces;
}

bool is_junction(ProblemKind kind) {
  return kind == ProblemKind::non_manifold_edge || kind == ProblemKind::non_manifold_vertex;
}

Warnings require_valid(const Mat3X& points, const std::vector<Triangle>& triangles,
                       const MeshSource& source) {
  std::string errors, help;
  bool repairable = true, keepable = true;
  Warnings warnings;
  for (const Problem& problem : find_problems(points, triangles)) {
    if (source.keeps_junctions && is_junction(problem.kind)) continue;
    const std::string text = problem_text(problem, source);
    if (is_acceptable(problem.kind)) {
      const char* help_by_repair = source.repaired ? "" : explain(problem.kind).help;
      warnings.push_back({name_of(problem.kind), fmt::format("{}: {}{}", source.name, text, help_by_repair)});
    } else {
      errors += (errors.empty() ? "" : "; ") + text;
      help += (help.empty() ? "" : ", ") + std::string(explain(problem.kind).help);
      repairable &= explain(problem.kind).repairable;
      keepable &= is_junction(problem.kind);
    }
  }
  if (!errors.empty())
    throw MeshError(fmt::format("{}: {}; expected an oriented manifold surface with area; {}{}", source.name,
                                errors, help,
                                source.repaired || !repairable ? ""
                                : keepable ? ", or use --repair, which cuts the sheets apart, or "
                                             "--keep non-manifold, which keeps them joined"
                                           : ", or use --repair"));
  return warnings;
}

void require_workable_size(const Mat3X& points, const std::string& name) {
  constexpr double smallest = 1e-50, largest = 1e50;
  const double diagonal = box_diagonal(points);
  if (!(diagonal >= smallest && diagonal <= largest))
    throw MeshError(fmt::format(
        "{}: the diagonal of its box is {:.3g}; expected {:.0e} to {:.0e}; scale the mesh, or use "
        "another unit",
        name, diagonal, smallest, largest));
}

}  // namespace hooke
