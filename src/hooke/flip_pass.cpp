#include "hooke/flip_pass.h"

#include <algorithm>
#include <cmath>

#include "hooke/local_newton.h"

namespace hooke {
namespace {

/// The neighbourhood of an edge as a small mesh of its own, in which a flip is tried.
struct Patch {
  std::vector<int> vertices;    // sides of the whole mesh; those that may move come first
  size_t movable = 0;           // vertices on creases among them, which do not
  std::vector<Triangle> faces;  // all faces about the movable vertices, in patch ids
  Placement placement;
  std::vector<double> vertex_length;
  Constraints constraints;
};

/// Cuts patches out of a mesh, each within the creases around it.
class PatchCutter {
 public:
  explicit PatchCutter(const FlippingMesh& mesh)
      : m_(mesh), local_(mesh.corner_valences.size(), -1), seen_(mesh.triangulation.faces().size(), 0) {}

  Patch cut(int half_edge, int rings) {
    Patch patch;
    add(patch, m_.triangulation.side(half_edge));
    add(patch, m_.triangulation.side(Triangulation::next(half_edge)));
    for (size_t begin = 0; rings > 0; --rings) {
      const size_t end = patch.vertices.size();
      for (; begin < end; ++begin) add_neighbours(patch, patch.vertices[begin]);
    }
    patch.movable = patch.vertices.size();
    std::vector<int> faces;
    for (size_t i = 0; i < patch.movable; ++i)
      for (int h : outgoing(patch.vertices[i])) {
        char& seen = seen_[static_cast<size_t>(h / 3)];
        if (!seen) faces.push_back(h / 3);
        seen = 1;
      }
    for (int f : faces) {
      seen_[static_cast<size_t>(f)] = 0;
      Triangle t = m_.triangulation.sides()[static_cast<size_t>(f)];
      for (int& v : t) v = add(patch, v);
      patch.faces.push_back(t);
    }
    copy_vertices(patch);
    for (int v : patch.vertices) local_[static_cast<size_t>(v)] = -1;
    return patch;
  }

 private:
  /// The vertex that a side is of.
  int vertex_of(int side) const {
    const auto vertices = static_cast<int>(m_.vertex_length.size());
    return side < vertices ? side : m_.constraints.further_sides[static_cast<size_t>(side - vertices)];
  }

  std::vector<int> outgoing(int side) const {
    std::vector<int> spokes = m_.triangulation.outgoing(vertex_of(side));
    std::erase_if(spokes, [&](int h) { return m_.triangulation.side(h) != side; });
    return spokes;
  }

  int add(Patch& patch, int v) {
    int& id = local_[static_cast<size_t>(v)];
    if (id < 0) {
      id = static_cast<int>(patch.vertices.size());
      patch.vertices.push_back(v);
    }
    return id;
  }

  void add_neighbours(Patch& patch, int v) {
    for (int h : outgoing(v)) {
      add(patch, m_.triangulation.side(Triangulation::next(h)));
      add(patch, m_.triangulation.side(Triangulation::previous(h)));
    }
  }

  void copy_vertices(Patch& patch) const {
    const size_t n = patch.vertices.size();
    Placement& p = patch.placement;
    p.points.resize(3, static_cast<Eigen::Index>(n));
    p.normals.resize(3, static_cast<Eigen::Index>(n));
    p.anchors.resize(n);
    p.segments.resize(n);
    p.drift.resize(n);
    for (size_t i = 0; i < n; ++i) {
      const int side = patch.vertices[i], vertex = vertex_of(side);
      const auto v = static_cast<size_t>(vertex);
      VertexPlace place(m_.placement, vertex);
      place.normal = m_.placement.normals.col(side);
      place.anchor = m_.placement.anchors[static_cast<size_t>(side)];
      place.other_side = -1;
      place.write_to(p, static_cast<int>(i));
      const bool on_crease = !m_.constraints.creases.empty() && m_.triangulation.on_crease(vertex);
      patch.vertex_length.push_back(m_.vertex_length[v]);
      patch.constraints.freedom.push_back(on_crease ? Freedom::fixed : m_.constraints.freedom[v]);
      patch.constraints.segment.push_back(m_.constraints.segment[v]);
      patch.constraints.curve.push_back(local_curve(patch, m_.constraints.curve[v]));
    }
  }

  /// Index of the curve in the patch, which gets a copy of it.
  int local_curve(Patch& patch, int curve) const {
    if (curve < 0) return -1;
    for (size_t i = 0; i < patch_curves_.size() && i < patch.constraints.curves.size(); ++i)
      if (patch_curves_[i] == curve) return static_cast<int>(i);
    patch_curves_.resize(patch.constraints.curves.size());
    patch_curves_.push_back(curve);
    patch.constraints.curves.push_back(m_.constraints.curves[static_cast<size_t>(curve)]);
    return static_cast<int>(patch_curves_.size()) - 1;
  }

  const FlippingMesh& m_;
  std::vector<int> local_;
  std::vector<char> seen_;
  mutable std::vector<int> patch_curves_;
};

/// Of the corner where h leaves.
int irregularity(const FlippingMesh& m, int h) {
  const CornerValence corner = corner_valence(m, h);
  if (corner.wanted > 0) return corner.has - corner.wanted;
  return corner.has - (m.triangulation.on_boundary(m.triangulation.from(h)) ? 4 : 6);
}

/// Two or more irregular vertices about the edge, and no more irregularity after the flip.
bool worth_a_try(const FlippingMesh& m, int h) {
  const Triangulation& t = m.triangulation;
  const int g = t.twin(h);
  const int ends[] = {irregularity(m, h), irregularity(m, g)};
  const int apexes[] = {irregularity(m, Triangulation::previous(h)),
                        irregularity(m, Triangulation::previous(g))};
  int irregular = 0, before = 0, after = 0;
  for (int i : ends) {
    irregular += i != 0;
    before += i * i;
    after += (i - 1) * (i - 1);
  }
  for (int i : apexes) {
    irregular += i != 0;
    before += i * i;
    after += (i + 1) * (i + 1);
  }
  return irregular >= 2 && after <= before;
}

/// Flips and settles the patch; returns how much its energy falls.
double try_flip(Patch& patch, const FlippingMesh& m, const EnergyTerms& terms, const FlipPassOptions& options,
                const GuardOptions& guard_options) {
  const int n = static_cast<int>(patch.vertices.size());
  const Connectivity before = make_connectivity(n, patch.faces);
  const TargetLengths targets_before = spread_target_lengths(before, patch.vertex_length);
  const double energy_before = Energy(before, targets_before, terms)(patch.placement, nullptr);

  Triangulation t(before);
  for (int h : t.outgoing(0))  // the ends of the edge are the first vertices of the patch
    if (t.to(h) == 1) {
      t.flip(h);
      break;
    }
  const Connectivity after = make_connectivity(n, t.faces());
  const TargetLengths targets = spread_target_lengths(after, patch.vertex_length);
  Energy energy(after, targets, terms);
  Guards guards(after, targets, guard_options);
  Retraction retraction(m.retraction.surface(), patch.constraints, m.retraction.options());
  const SweepPlan sweeps = plan_sweeps(after);
  Relaxation r{after, sweeps, patch.vertex_length, energy, retraction, guards, patch.placement};
  std::vector<char> active(patch.vertices.size(), 0);
  std::fill_n(active.begin(), patch.movable, 1);
  for (int sweep = 0; sweep < options.sweeps; ++sweep) local_newton_sweep(r, active, {});
  return energy_before - energy(patch.placement, nullptr);
}

}  // namespace

int flip_irregular_edges(FlippingMesh& m, const EnergyTerms& terms, const FlipPassOptions& options,
                         const FlipGuardOptions& flip_guard, const GuardOptions& guards) {
  PatchCutter cutter(m);
  int flips = 0;
  for (int h = 0; h < m.triangulation.half_edge_count(); ++h) {
    if (m.triangulation.twin(h) < h || m.triangulation.is_constrained(h) || !worth_a_try(m, h) ||
        !may_flip(m, h, flip_guard))
      continue;
    Patch patch = cutter.cut(h, options.rings);
    if (try_flip(patch, m, terms, options, guards) < options.gain) continue;
    m.triangulation.flip(h);
    for (size_t i = 0; i < patch.movable; ++i)
      if (patch.constraints.freedom[i] != Freedom::fixed)
        VertexPlace(patch.placement, static_cast<int>(i)).write_to(m.placement, patch.vertices[i]);
    ++flips;
  }
  return flips;
}

}  // namespace hooke
