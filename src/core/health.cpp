#include "core/health.hpp"

#include "base/seconds.hpp"

namespace laneloom::core {
namespace {

constexpr double kRecent_s = 1.0;

}  // namespace

double age_s(std::int64_t now_ns, const std::optional<std::int64_t>& arrival_ns) {
  return arrival_ns ? seconds(now_ns - *arrival_ns) : -1.0;
}

Verdict Health::assess(std::int64_t now_ns, const HealthInputs& inputs) const {
  const auto older = [](double age, double limit_s) { return age < 0.0 || age > limit_s; };
  const auto recent = [&](const std::optional<std::int64_t>& incident_ns) {
    return !older(age_s(now_ns, incident_ns), kRecent_s);
  };
  Verdict verdict;
  const auto add_if = [&](bool condition, StateReason reason) {
    if (condition) verdict.reasons.push_back(reason);
  };
  const bool detections_come = !older(inputs.detections_age_s, config_.degraded_after_s);
  add_if(!detections_come, StateReason::no_detections);
  add_if(older(inputs.poses_age_s, config_.degraded_after_s), StateReason::no_poses);
  add_if(recent(unsynchronised_ns_), StateReason::unsynchronised);
  add_if(inputs.fused_age_s < 0.0 && !recent(reset_ns_), StateReason::starting);
  add_if(recent(reset_ns_), StateReason::reset);
  add_if(recent(overload_ns_), StateReason::overloaded);
  add_if(inputs.sources_disagree && detections_come, StateReason::sources_disagree);
  add_if(recent(pose_jump_ns_), StateReason::poses_jumped);
  // The other service may miss one of its status messages.
  add_if(!older(inputs.other_service_age_s, 2.5 * config_.status_period_s), StateReason::another_service);

  const bool silent = older(inputs.fused_age_s, config_.stale_after_s);
  // Both inputs come, yet nothing is fused: no pose matches, or all frames are refused.
  add_if(silent && verdict.reasons.empty(), StateReason::unsynchronised);
  const auto lags = [&](double limit_s) { return inputs.lag_s && *inputs.lag_s > limit_s; };
  add_if(lags(config_.degraded_lag_s), StateReason::outdated);
  add_if(inputs.source_not_fused && !silent, StateReason::source_not_fused);
  add_if(inputs.driving_side_contradicted && !silent, StateReason::driving_side_contradicted);
  const bool stale = silent || lags(config_.stale_lag_s);
  verdict.state = stale ? MapState::stale : verdict.reasons.empty() ? MapState::ok : MapState::degraded;
  return verdict;
}

}  // namespace laneloom::core
