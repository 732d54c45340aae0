#include "hooke/report/parameters_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace hooke {

using Json = nlohmann::ordered_json;

namespace {

const char* name_of(FilterKind kind) {
  switch (kind) {
    case FilterKind::local:
      return "local";
    case FilterKind::global:
      return "global";
    case FilterKind::closest:
      return "closest";
    case FilterKind::none:
      return "none";
  }
  return "";
}

const char* name_of(BoundaryRule rule) {
  switch (rule) {
    case BoundaryRule::slide:
      return "slide";
    case BoundaryRule::fixed:
      return "fixed";
    case BoundaryRule::free:
      return "free";
  }
  return "";
}

const char* name_of(ConnectivityMode mode) {
  switch (mode) {
    case ConnectivityMode::fixed:
      return "fixed";
    case ConnectivityMode::flip:
      return "flip";
    case ConnectivityMode::adapt:
      return "adapt";
  }
  return "";
}

const char* name_of(Effort effort) {
  switch (effort) {
    case Effort::fast:
      return "fast";
    case Effort::standard:
      return "default";
    case Effort::thorough:
      return "thorough";
  }
  return "";
}

/// The value where it has an effect.
template <typename Value>
Json where(bool effective, const Value& value) {
  return effective ? Json(value) : Json();
}

bool has_splines(FilterKind kind) {
  return kind == FilterKind::local || kind == FilterKind::global;
}

void add_filter(Json& j, const FilterOptions& filter) {
  const bool splines = has_splines(filter.kind);
  j["filter"] = name_of(filter.kind);
  j["kernel"] = where(splines, filter.kernel == Kernel::r3 ? "r3" : "r2logr");
  j["rho"] = where(splines, filter.offset);
  j["reach"] = where(splines && std::isfinite(filter.reach), filter.reach);
}

void add_polish(Json& j, const RemeshOptions& o) {
  const PolishOptions& polish = o.connectivity == ConnectivityMode::fixed ? o.polish : o.flips.polish;
  const bool on = o.polish_angles;
  j["polish"] = on;
  j["polish_from"] = where(on, polish.first_threshold);
  j["polish_margin"] = where(on, polish.margin);
  j["polish_step"] = where(on, polish.threshold_step);
  j["polish_up_to"] = where(on, polish.last_threshold);
  j["polish_sweeps"] = where(on, polish.sweeps);
  j["polish_edge_limit"] = where(on, polish.edge_error_limit);
}

/// Of a mesh that is near-regular already.
void add_harm(Json& j, const RemeshOptions& o) {
  const bool fixed = o.connectivity == ConnectivityMode::fixed;
  j["near_regular_angle"] = where(fixed, o.harm.angle);
  j["near_regular_deviation"] = where(fixed, o.harm.deviation);
  j["near_regular_reach"] = where(fixed, o.harm.reach);
}

}  // namespace

Json parameters_json(const RemeshOptions& o, const AttemptOptions& attempts, Effort effort) {
  const bool adapts = o.connectivity == ConnectivityMode::adapt;
  const bool damped = o.integrator == IntegratorKind::damped;
  const bool fixed = o.connectivity == ConnectivityMode::fixed;
  Json j;
  j["paper"] = false;
  j["connectivity"] = name_of(o.connectivity);
  j["effort"] = name_of(effort);
  j["most_attempts"] = fixed ? 1 : attempts.most;
  j["flow_rounds"] = fixed ? 0 : o.flips.flow.rounds;
  j["adapt_rounds"] = adapts ? o.adaptation.rounds : 0;
  j["coarse_levels"] = adapts ? o.adaptation.coarse.levels : 0;
  j["last_outer"] = where(adapts && o.polish_angles, o.adaptation.last_outer);
  j["last_steps"] = where(adapts && o.polish_angles && !damped && o.adaptation.last_steps,
                          o.adaptation.last_steps.value_or(0));
  j["coarse_flow_rounds"] = adapts ? o.adaptation.coarse_flow : 0;  // of what follows where there are any
  j["last_flow_rounds"] = adapts ? o.adaptation.last_flow : 0;
  j["integrator"] = damped ? "damped" : "lbfgs";
  add_polish(j, o);
  add_harm(j, o);
  add_filter(j, o.filter);
  j["refit"] = where(has_splines(o.filter.kind), o.refit == Refit::each && !adapts ? "each" : "once");
  j["altitude"] = o.altitude;
  j["string"] = where(damped, o.damped.string);
  j["torque"] = where(damped, o.damped.torque);
  j["friction"] = where(damped, o.damped.friction);
  j["tolerance"] = o.tolerance;
  j["max_outer"] = o.max_outer;
  j["outer_drop"] = o.outer_drop;
  j["energy_drop"] = fixed ? o.integration.energy_drop : o.flips.energy_drop;
  j["hindered"] = where(!damped, o.hindered);
  j["max_steps"] = o.integration.max_steps;
  j["boundary"] = name_of(o.constraints.boundary);
  j["corner_angle"] = o.constraints.corner_angle;
  j["feature_angle"] = where(o.constraints.features.angle < 180, o.constraints.features.angle);
  j["fixed_vertices"] = o.constraints.fixed_vertices.size();
  j["guard_area_ratio"] = o.guards.area_ratio;
  j["guard_alignment"] = o.guards.alignment;
  j["guard_fold"] = o.guards.fold;
  j["guard_sagitta"] = o.guards.sagitta;
  j["search_sagitta"] = where(o.polish_angles, o.search.sagitta);
  const bool mends = o.polish_angles && !fixed;
  j["sliver_angles"] = where(mends, o.mend.trials.sliver_angles);
  j["sliver_passes"] = where(mends, o.mend.passes);
  j["sliver_sagitta"] = where(mends, o.mend.trials.change.sagitta);
  return j;
}

Json parameters_json(const PaperOptions& o) {
  Json j;
  j["paper"] = true;
  add_filter(j, o.filter);
  j["string"] = o.evolution.damped.string;
  j["torque"] = o.evolution.damped.torque;
  j["friction"] = o.evolution.damped.friction;
  j["step_angle"] = o.evolution.time_step.angle;
  j["step_expansion"] = o.evolution.time_step.expansion;
  j["step_displacement"] = o.evolution.time_step.displacement;
  j["step_area"] = o.evolution.time_step.area_bound;
  j["tolerance"] = o.evolution.tolerance;
  j["max_outer"] = o.max_outer;
  j["max_steps"] = o.evolution.max_steps;
  j["boundary"] = name_of(o.constraints.boundary);
  j["fixed_vertices"] = o.constraints.fixed_vertices.size();
  return j;
}

}  // namespace hooke
