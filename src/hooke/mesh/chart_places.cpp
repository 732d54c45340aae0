#include "hooke/mesh/chart_places.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "hooke/core/parallel.h"
#include "hooke/geometry/aabb_tree.h"
#include "hooke/geometry/triangle.h"
#include "hooke/mesh/wedges.h"

namespace hooke {
namespace {

Vec3 centre_of(const ChartedSurface& surface, int face) {
  const Triangle& t = surface.adjacency.faces[face];
  return (surface.points.col(t[0]) + surface.points.col(t[1]) + surface.points.col(t[2])) / 3;
}

/// Calls use(neighbour) for the faces across the edges of a face that are no features.
template <typename Use>
void for_neighbours(const Adjacency& c, int face, const Use& use) {
  for (const int e : c.face_edges[face]) {
    if (c.is_feature_edge(e)) continue;
    const auto& [left, right] = c.edge_faces[e];
    use(left == face ? right : left);
  }
}

struct Charts {
  std::vector<int> of_faces;
  int count = 0;
};

Charts charts_of(const Adjacency& c) {
  Charts charts{std::vector<int>(c.faces.size(), -1)};
  std::vector<int> front;
  for (std::size_t f = 0; f < c.faces.size(); ++f) {
    if (charts.of_faces[f] >= 0) continue;
    charts.of_faces[f] = charts.count;
    front = {static_cast<int>(f)};
    while (!front.empty()) {
      const int face = front.back();
      front.pop_back();
      for_neighbours(c, face, [&](int next) {
        if (charts.of_faces[next] >= 0) return;
        charts.of_faces[next] = charts.count;
        front.push_back(next);
      });
    }
    ++charts.count;
  }
  return charts;
}

class PlaceSearch {
 public:
  PlaceSearch(const ChartedSurface& input, const ChartedSurface& result, const std::vector<int>& near)
      : input_(input),
        result_(result),
        near_(near),
        cut_(input.adjacency.creases.empty() ? input.adjacency : cut_open(input.adjacency)),
        cut_points_(input.adjacency.creases.empty() ? input.points
                                                    : wedge_points(input.points, input.adjacency)),
        tree_(input.points, input.adjacency.faces) {}

  ChartPlaces run() {
    const Adjacency& c = result_.adjacency;
    places_.resize(c.faces.size());
    for (const int seed : find_seeds()) flood(seed);
    ChartPlaces found;
    found.faces.reserve(places_.size());
    for (const SurfacePoint& place : places_) found.faces.push_back(place.face);
    found.wedges = places_of_wedges();
    return found;
  }

 private:
  /// The largest face of each chart that lies in the chart of the input in which most of its larger faces do,
  /// by area. Its place is set.
  std::vector<int> find_seeds() {
    constexpr std::size_t max_votes = 64;
    const Charts charts = charts_of(result_.adjacency), input_charts = charts_of(input_.adjacency);
    std::vector<double> areas(charts.of_faces.size());
    std::vector<std::vector<int>> faces(charts.count);
    for (std::size_t f = 0; f < areas.size(); ++f) {
      areas[f] = doubled_area_vector(result_.points, result_.adjacency.faces[f]).norm();
      faces[charts.of_faces[f]].push_back(static_cast<int>(f));
    }
    std::vector<int> seeds(faces.size());
    parallel_for(faces.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t chart = begin; chart < end; ++chart) {
        std::vector<int>& larger = faces[chart];
        const auto last = larger.begin() + static_cast<std::ptrdiff_t>(std::min(larger.size(), max_votes));
        std::ranges::partial_sort(
            larger, last, [&](int f, int g) { return std::pair(-areas[f], f) < std::pair(-areas[g], g); });
        larger.resize(std::min(larger.size(), max_votes));
        std::map<int, double> votes;
        std::vector<int> chart_of;
        for (const int f : larger) {
          places_[f] = closest(f);
          chart_of.push_back(input_charts.of_faces[places_[f].face]);
          votes[chart_of.back()] += areas[f];
        }
        const int winner =
            std::ranges::max_element(votes, {}, [](const auto& vote) { return vote.second; })->first;
        seeds[chart] = larger[std::ranges::find(chart_of, winner) - chart_of.begin()];
      }
    });
    is_found_.assign(places_.size(), 0);
    return seeds;
  }

  /// The place of the centre of a face, found from the faces of the input near its corners or else in space.
  SurfacePoint closest(int face) const {
    const Vec3 x = centre_of(result_, face);
    SurfacePoint best;
    double least = std::numeric_limits<double>::infinity();
    for (const int v : result_.adjacency.faces[face]) {
      const int hint = near_.empty() ? -1 : near_[v];
      if (hint < 0) continue;
      const SurfacePoint place = locate(input_.points, input_.adjacency, x, input_.adjacency.faces[hint][0]);
      const double distance = squared_distance(place, x);
      if (distance >= least) continue;
      least = distance;
      best = place;
    }
    return best.face >= 0 ? best : closest_in_space(face, x);
  }

  SurfacePoint closest_in_space(int face, const Vec3& x) const {
    const Vec3 normal = doubled_area_vector(result_.points, result_.adjacency.faces[face]);
    const auto same_side = [&](int f) {  // the other side of a thin wall may be nearer
      return doubled_area_vector(input_.points, input_.adjacency.faces[f]).dot(normal) > 0;
    };
    const ClosestPoint there = tree_.closest(x, same_side);
    return place_of(there.face < 0 ? tree_.closest(x) : there);
  }

  SurfacePoint place_of(const ClosestPoint& point) const {
    return on_face(point, input_.points, input_.adjacency);
  }

  SurfacePoint place_on(int face, const Vec3& x) const {
    const auto& [a, b, c] = input_.adjacency.faces[face];
    ClosestPoint closest = closest_point(x, input_.points.col(a), input_.points.col(b), input_.points.col(c));
    closest.face = face;
    return place_of(closest);
  }

  /// The place of x in the chart of a place near it, on the same side of all feature edges.
  SurfacePoint from(const SurfacePoint& near, const Vec3& x) const {
    return locate(cut_points_, cut_, x, nearest_corner(near, cut_));
  }

  /// Finds the places of the faces of a chart, from that of one of them.
  void flood(int seed) {
    is_found_[seed] = 1;
    std::vector<int> front = {seed};
    for (std::size_t i = 0; i < front.size(); ++i)
      for_neighbours(result_.adjacency, front[i], [&](int next) {
        if (std::exchange(is_found_[next], 1)) return;
        places_[next] = from(places_[front[i]], centre_of(result_, next));
        front.push_back(next);
      });
  }

  double squared_distance(const SurfacePoint& place, const Vec3& x) const {
    const Triangle& t = input_.adjacency.faces[place.face];
    Vec3 point = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k)
      point += place.weights[static_cast<Eigen::Index>(k)] * input_.points.col(t[k]);
    return (point - x).squaredNorm();
  }

  /// The place of a vertex on a feature edge, on the side of a face of the result with a place of its own.
  /// The search starts inside the face, and goes on over few edges: not around the end of a feature edge,
  /// where both its sides meet.
  SurfacePoint beside_feature(int face, const Vec3& x) const {
    constexpr double inside = .02;  // of the way to the centre
    constexpr int max_edges = 3;
    const SurfacePoint start = from(places_[face], x + inside * (centre_of(result_, face) - x));
    SurfacePoint best = place_on(start.face, x);
    double least = squared_distance(best, x);
    std::vector<int> reached = {start.face};
    std::size_t begin = 0;
    for (int step = 0; step < max_edges; ++step) {
      const std::size_t end = reached.size();
      for (; begin < end; ++begin)
        for_neighbours(cut_, reached[begin], [&](int next) {
          if (std::ranges::find(reached, next) == reached.end()) reached.push_back(next);
        });
    }
    for (const int next : reached) {
      const SurfacePoint place = place_on(next, x);
      const double distance = squared_distance(place, x);
      if (distance >= least) continue;
      least = distance;
      best = place;
    }
    return best;
  }

  /// The places of the wedges, found from those of their faces; at feature edges the nearest of these.
  std::vector<SurfacePoint> places_of_wedges() const {
    const Adjacency& c = result_.adjacency;
    const IntLists faces = faces_of_wedges();
    std::vector<SurfacePoint> places(c.wedge_count());
    parallel_for(places.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t wedge = begin; wedge < end; ++wedge) {
        const int v = c.vertex_of_wedge(static_cast<int>(wedge));
        const Vec3 x = result_.points.col(v);
        const auto here = faces[static_cast<int>(wedge)];
        if (here.empty()) continue;
        if (std::ranges::none_of(c.vertex_edges[v], [&](int e) { return c.is_crease(e); })) {
          places[wedge] = from(places_[here[0]], x);
          continue;
        }
        double least = std::numeric_limits<double>::infinity();
        for (const int f : here) {
          const SurfacePoint place = beside_feature(f, x);
          const double distance = squared_distance(place, x);
          if (distance >= least) continue;
          least = distance;
          places[wedge] = place;
        }
      }
    });
    return places;
  }

  IntLists faces_of_wedges() const {
    return inverse(result_.adjacency.wedge_count(), result_.adjacency.wedges_of_faces());
  }

  const ChartedSurface& input_;
  const ChartedSurface& result_;
  const std::vector<int>& near_;
  const Adjacency cut_;
  const Mat3X cut_points_;
  const AabbTree tree_;
  std::vector<SurfacePoint> places_;  // of the faces' centres
  std::vector<char> is_found_;
};

}  // namespace

ChartPlaces find_chart_places(const ChartedSurface& input, const ChartedSurface& result,
                              const std::vector<int>& near) {
  return PlaceSearch(input, result, near).run();
}

}  // namespace hooke
