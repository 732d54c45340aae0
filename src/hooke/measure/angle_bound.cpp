#include "hooke/measure/angle_bound.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "hooke/core/lists.h"
#include "hooke/geometry/triangle.h"
#include "hooke/measure/measured_surface.h"
#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

/// The bound is found as a transport of degrees from faces to vertices: what remains of the angle sums once
/// every angle has its t. Integer units of this size keep the flow exact.
constexpr double units_per_degree = 1e6;

using Amount = std::int64_t;

/// Rings do not spread over vertices with more faces: at the hub of a fan they would take in all of it, and
/// the flow through a hub takes quadratic time. Its angle sum bounds the faces of the patch all the same.
constexpr size_t max_faces_to_spread = 64;

/// Faces around a face, with their vertices.
struct Patch {
  std::vector<int> faces, vertices;            // ascending
  std::vector<std::array<size_t, 3>> corners;  // per face: indices in `vertices`
  std::vector<double> angle_sum;               // per vertex, degrees, over all its faces
  std::vector<int> face_count;                 // per vertex, in the mesh
  std::vector<char> enclosed;                  // per vertex: all its faces are in the patch
};

double corner_angle(const Mat3X& points, const Triangle& t, size_t k) {
  const Vec3 p = points.col(t[k]);
  const Vec3 a = points.col(t[(k + 1) % 3]) - p, b = points.col(t[(k + 2) % 3]) - p;
  return angle_between(a, b);
}

std::vector<int> corners_of(const Adjacency& c, const std::vector<int>& faces) {
  std::vector<int> vertices;
  for (int f : faces)
    for (int v : c.faces[f]) vertices.push_back(v);
  sort_unique(vertices);
  return vertices;
}

Patch patch_around(const Mat3X& points, const Adjacency& c, int face, int rings) {
  Patch patch;
  patch.faces = {face};
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<int> vertices = corners_of(c, patch.faces);
    for (int v : vertices)
      if (const std::span<const int> around = c.vertex_faces[v]; around.size() <= max_faces_to_spread)
        patch.faces.insert(patch.faces.end(), around.begin(), around.end());
    sort_unique(patch.faces);
  }
  patch.vertices = corners_of(c, patch.faces);
  const auto index_of = [](const std::vector<int>& ids, int id) -> size_t {
    return std::ranges::lower_bound(ids, id) - ids.begin();
  };
  for (int f : patch.faces) {
    const Triangle& t = c.faces[f];
    patch.corners.push_back(
        {index_of(patch.vertices, t[0]), index_of(patch.vertices, t[1]), index_of(patch.vertices, t[2])});
  }
  for (int v : patch.vertices) {
    double sum = 0;
    bool enclosed = true;
    for (int f : c.vertex_faces[v]) {
      const Triangle& t = c.faces[f];
      sum += corner_angle(points, t, t[0] == v ? 0 : t[1] == v ? 1 : 2);
      enclosed = enclosed && std::ranges::binary_search(patch.faces, f);
    }
    patch.angle_sum.push_back(sum);
    patch.face_count.push_back(static_cast<int>(c.vertex_faces[v].size()));
    patch.enclosed.push_back(enclosed);
  }
  return patch;
}

/// A flow network with a source 0 and a sink 1.
class Network {
 public:
  explicit Network(size_t nodes) : graph_(nodes + 2) {}

  void connect(size_t from, size_t to, Amount capacity) {
    const auto forth = boost::add_edge(from, to, graph_).first;
    const auto back = boost::add_edge(to, from, graph_).first;
    boost::put(boost::edge_capacity, graph_, forth, capacity);
    boost::put(boost::edge_capacity, graph_, back, Amount{0});
    boost::put(boost::edge_reverse, graph_, forth, back);
    boost::put(boost::edge_reverse, graph_, back, forth);
  }

  Amount max_flow() { return boost::boykov_kolmogorov_max_flow(graph_, size_t{0}, size_t{1}); }

  /// After max_flow(): is the node on the source's side of the minimum cut?
  bool on_source_side(size_t node) const {
    return boost::get(boost::vertex_color, graph_, node) ==
           boost::get(boost::vertex_color, graph_, size_t{0});
  }

 private:
  using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
  using Nodes =
      boost::property<boost::vertex_color_t, boost::default_color_type,
                      boost::property<boost::vertex_distance_t, long,
                                      boost::property<boost::vertex_predecessor_t, Traits::edge_descriptor>>>;
  using Arcs =
      boost::property<boost::edge_capacity_t, Amount,
                      boost::property<boost::edge_residual_capacity_t, Amount,
                                      boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>;
  boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, Nodes, Arcs> graph_;
};

Amount amount(double degrees) {
  return static_cast<Amount>(std::llround(std::max(degrees, 0.) * units_per_degree));
}

/// Whether the sending side can transport all its degrees; if not, the vertices of the minimum cut.
struct TransportResult {
  bool possible = true;
  std::vector<int> vertices;
};

/// Either the faces must send 180 - 3 t each (`faces_send`), or the enclosed vertices must receive all of
/// their remaining sum. If each is possible with the other side's amounts as limits, both are possible at
/// once (Mendelsohn and Dulmage, "Some generalizations of the problem of distinct representatives", 1958).
TransportResult solve_transport(const Patch& p, double t, bool faces_send) {
  const size_t faces = p.faces.size(), vertices = p.vertices.size();
  const auto face_node = [](size_t f) { return 2 + f; };
  const auto vertex_node = [faces](size_t v) { return 2 + faces + v; };
  Network network(faces + vertices);
  Amount demand = 0;
  for (size_t f = 0; f < faces; ++f) {
    const Amount share = amount(180 - 3 * t);
    if (faces_send) demand += share;
    faces_send ? network.connect(0, face_node(f), share) : network.connect(face_node(f), 1, share);
    for (size_t v : p.corners[f])
      faces_send ? network.connect(face_node(f), vertex_node(v), share)
                 : network.connect(vertex_node(v), face_node(f), share);
  }
  for (size_t v = 0; v < vertices; ++v) {
    const double room = p.angle_sum[v] - p.face_count[v] * t;
    if (room < -.5 / units_per_degree) return {false, {p.vertices[v]}};
    if (faces_send) {
      network.connect(vertex_node(v), 1, amount(room));
    } else if (p.enclosed[v]) {
      network.connect(0, vertex_node(v), amount(room));
      demand += amount(room);
    }
  }
  const Amount slack = static_cast<Amount>(faces + vertices);  // for rounding
  if (network.max_flow() >= demand - slack) return {};
  TransportResult result{.possible = false, .vertices = {}};
  for (size_t v = 0; v < vertices; ++v)
    if (network.on_source_side(vertex_node(v))) result.vertices.push_back(p.vertices[v]);
  return result;
}

TransportResult solve_transport(const Patch& p, double t) {
  const TransportResult sent = solve_transport(p, t, true);
  return sent.possible ? solve_transport(p, t, false) : sent;
}

/// The vertex's angle sum per face.
double share_of(const Patch& p, size_t vertex) {
  return p.angle_sum[vertex] / p.face_count[vertex];
}

/// The vertex with the smallest angle sum per face.
size_t tightest_vertex(const Patch& p) {
  size_t tightest = 0;
  for (size_t v = 1; v < p.vertices.size(); ++v)
    if (share_of(p, v) < share_of(p, tightest)) tightest = v;
  return tightest;
}

}  // namespace

AngleBound bound_min_angle(const Mat3X& points, const Adjacency& adjacency, int face, int rings) {
  const Patch patch = patch_around(points, adjacency, face, rings);
  AngleBound bound;
  const auto unknown = [](double sum) { return !std::isfinite(sum); };
  if (std::ranges::any_of(patch.angle_sum, unknown)) return bound;
  double possible = 0, impossible = 60;
  const size_t tightest = tightest_vertex(patch);
  if (const double share = share_of(patch, tightest); share < impossible) {
    impossible = share;
    bound.vertices = {patch.vertices[tightest]};
  }
  TransportResult at_most = solve_transport(patch, impossible);
  if (at_most.possible) {  // the usual case
    bound.degrees = impossible;
    return bound;
  }
  bound.vertices = std::move(at_most.vertices);
  while (impossible - possible > 1e-3) {
    const double t = .5 * (possible + impossible);
    TransportResult result = solve_transport(patch, t);
    (result.possible ? possible : impossible) = t;
    if (!result.possible) bound.vertices = std::move(result.vertices);
  }
  bound.degrees = possible;
  return bound;
}

namespace {

constexpr int rings = 2;  // around the face for which a bound is computed

/// All faces around the vertices of those rings, as a mesh of its own.
struct SubMesh {
  std::vector<int> vertices;  // ids in the mesh, ascending
  std::vector<Triangle> faces;
  int face = 0;  // index of the face for which a bound is computed

  int local_index(int vertex) const {
    const auto found = std::ranges::lower_bound(vertices, vertex);
    return found != vertices.end() && *found == vertex ? static_cast<int>(found - vertices.begin()) : -1;
  }
};

SubMesh cut_out(const Adjacency& c, int face) {
  const Triangle& t = c.faces[face];
  const std::vector<int> faces = sorted_union(c.vertex_faces, with_rings(c, {t.begin(), t.end()}, rings));
  SubMesh part;
  part.face = static_cast<int>(std::ranges::lower_bound(faces, face) - faces.begin());
  for (int f : faces) part.faces.push_back(c.faces[f]);
  for (const Triangle& corners : part.faces)
    part.vertices.insert(part.vertices.end(), corners.begin(), corners.end());
  sort_unique(part.vertices);
  for (Triangle& corners : part.faces)
    for (int& v : corners) v = part.local_index(v);
  return part;
}

AngleBound bound_in_submesh(const MeasuredSurface& surface, int face, const std::vector<Edge>& creases) {
  const SubMesh part = cut_out(surface.adjacency, face);
  std::vector<Edge> here;
  for (const Edge& crease : creases) {
    const Edge e = {part.local_index(crease[0]), part.local_index(crease[1])};
    if (std::min(e[0], e[1]) >= 0) here.push_back(e);
  }
  Adjacency c = make_adjacency(static_cast<int>(part.vertices.size()), part.faces);
  split_wedges(c, here);
  const Mat3X points = surface.points(Eigen::all, part.vertices);
  AngleBound bound = bound_min_angle(wedge_points(points, c), cut_open(c), part.face, rings);
  for (int& v : bound.vertices) v = surface.ids.vertex(part.vertices[c.vertex_of_wedge(v)]);
  sort_unique(bound.vertices);
  return bound;
}

/// The inverse of a list of ids: the index of each id.
std::vector<int> inverse_of(std::span<const int> ids, size_t count) {
  std::vector<int> inverse(count);
  for (size_t i = 0; i < count; ++i) inverse[ids.empty() ? i : ids[i]] = static_cast<int>(i);
  return inverse;
}

}  // namespace

std::vector<AngleBound> bound_min_angles(const MeasuredSurface& surface, const std::vector<int>& faces,
                                         const std::vector<Edge>& creases) {
  const Adjacency& c = surface.adjacency;
  const std::vector<int> face_at = inverse_of(surface.ids.faces, c.faces.size());
  std::vector<AngleBound> bounds;
  for (int f : faces) bounds.push_back(bound_in_submesh(surface, face_at[f], creases));
  return bounds;
}

}  // namespace hooke
