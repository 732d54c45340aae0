#include "hooke/report/quality_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace hooke {
namespace {

using Json = nlohmann::ordered_json;

Json number(double x) {
  return std::isfinite(x) ? Json(x) : Json(nullptr);
}
Json number(std::optional<double> x) {
  return x ? number(*x) : Json(nullptr);
}

Json vector(const Vec3& v) {
  return {number(v.x()), number(v.y()), number(v.z())};
}

Json range(const Range& r) {
  return {{"min", number(r.min)}, {"mean", number(r.mean)}, {"max", number(r.max)}};
}

/// {"5": vertices with five edges, ...}
Json valence_counts(const std::vector<int>& counts) {
  Json json = Json::object();
  for (size_t k = 0; k < counts.size(); ++k)
    if (counts[k] > 0) json[std::to_string(k)] = counts[k];
  return json;
}

Json worst_faces(const std::vector<WorstFace>& faces) {
  Json json = Json::array();
  for (const WorstFace& w : faces)
    json.push_back({{"face", w.face},
                    {"min_angle", number(w.min_angle)},
                    {"vertices", w.vertices},
                    {"centre", vector(w.centre)},
                    {"bound", number(w.bound.degrees)},
                    {"bound_vertices", w.bound.vertices},
                    {"reasons", w.reasons}});
  return json;
}

Json distance(const MaxRms& d, double diagonal) {
  return {{"max", number(d.max)},
          {"rms", number(d.rms)},
          {"max_over_diagonal", number(d.max / diagonal)},
          {"rms_over_diagonal", number(d.rms / diagonal)}};
}

Json max_rms(const std::optional<MaxRms>& x) {
  if (!x) return nullptr;
  return {{"max", number(x->max)}, {"rms", number(x->rms)}};
}

}  // namespace

Json to_json(const Statistics& s) {
  Json json = {{"min", number(s.min)},       {"p01", number(s.p01)},   {"p05", number(s.p05)},
               {"median", number(s.median)}, {"mean", number(s.mean)}, {"p95", number(s.p95)},
               {"max", number(s.max)},       {"std", number(s.std)},   {"histogram", nullptr},
               {"non_finite", s.non_finite}};
  if (s.count > 0) json["histogram"] = {{"edges", s.histogram.edges}, {"counts", s.histogram.counts}};
  return json;
}

Json to_json(const Quality& q) {
  Json json;
  json["min_angle"] = to_json(q.min_angle);
  json["max_angle"] = to_json(q.max_angle);
  json["shape"] = to_json(q.shape);
  json["radius_ratio"] = to_json(q.radius_ratio);
  json["aspect_ratio"] = to_json(q.aspect_ratio);
  json["edge_ratio"] = to_json(q.edge_ratio);
  json["edge_length"] = to_json(q.edge_length);
  json["length_error"] = to_json(q.length_error);
  json["folded_edges"] = q.folded_edges;
  json["self_intersections"] = q.self_intersections ? Json(*q.self_intersections) : Json(nullptr);
  json["degenerate_faces"] = q.degenerate_faces;
  json["valence"] = {{"interior", valence_counts(q.valence.interior)},
                     {"boundary", valence_counts(q.valence.boundary)}};
  json["mean_curvature"] = range(q.mean_curvature);
  json["gaussian_curvature"] = range(q.gaussian_curvature);
  json["worst_faces"] = worst_faces(q.worst_faces);
  return json;
}

Json to_json(const Deviation& d) {
  Json json;
  json["displacement"] = max_rms(d.displacement);
  json["distance_to_input"] = distance(d.to_reference, d.diagonal);
  json["distance_from_input"] = distance(d.from_reference, d.diagonal);
  json["normal_deviation"] = max_rms(d.normal_deviation);
  json["area_change"] = number(d.area_change);
  json["volume_change"] = number(d.volume_change);
  json["flipped_faces"] = d.flipped_faces;
  json["boundary_distance"] = {{"to_input", number(d.boundary_to_reference)},
                               {"from_input", number(d.boundary_from_reference)}};
  return json;
}

Json to_json(const Topology& t, const Extent& e) {
  Json json;
  json["vertices"] = t.vertices;
  json["faces"] = t.faces;
  json["edges"] = t.edges;
  json["components"] = t.components;
  json["boundary_loops"] = t.boundary_loops;
  json["euler"] = t.euler;
  json["isolated_vertices"] = t.isolated_vertices;
  json["bbox"] = {{"min", vector(e.lower)}, {"max", vector(e.upper)}};
  json["bbox_diagonal"] = number(e.diagonal);
  json["area"] = number(e.area);
  json["volume"] = number(e.volume);
  return json;
}

}  // namespace hooke
