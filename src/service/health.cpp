#include "service/health.hpp"

namespace laneloom {
namespace {

constexpr double kRecent_s = 1.0;

}  // namespace

double age_s(std::int64_t now_ns, const std::optional<std::int64_t>& arrival_ns) {
  return arrival_ns ? static_cast<double>(now_ns - *arrival_ns) / 1e9 : -1.0;
}

Verdict Health::assess(std::int64_t now_ns, const Arrivals& arrivals) const {
  const auto older = [&](const std::optional<std::int64_t>& time_ns, double limit_s) {
    return !time_ns || age_s(now_ns, time_ns) > limit_s;
  };
  Verdict verdict;
  const auto add_if = [&](bool condition, StateReason reason) {
    if (condition) verdict.reasons.push_back(reason);
  };
  add_if(older(arrivals.detections_ns, config_.degraded_after_s), StateReason::no_detections);
  add_if(older(arrivals.poses_ns, config_.degraded_after_s), StateReason::no_poses);
  add_if(!older(unsynchronised_ns_, kRecent_s), StateReason::unsynchronised);
  add_if(!arrivals.fused_ns && older(reset_ns_, kRecent_s), StateReason::starting);
  add_if(!older(reset_ns_, kRecent_s), StateReason::reset);
  add_if(!older(overload_ns_, kRecent_s), StateReason::overloaded);
  // It may miss one of its times.
  add_if(!older(arrivals.other_service_ns, 2.5 * config_.status_period_s), StateReason::another_service);

  const auto lags = [&](double limit_s) { return arrivals.lag_s && *arrivals.lag_s > limit_s; };
  add_if(lags(config_.degraded_lag_s), StateReason::outdated);
  const bool silent = older(arrivals.fused_ns, config_.stale_after_s);
  add_if(arrivals.source_not_fused && !silent, StateReason::source_not_fused);
  const bool stale = silent || lags(config_.stale_lag_s);
  // Both inputs come, yet nothing is fused: no pose matches, or frames are refused for what they are.
  add_if(silent && verdict.reasons.empty(), StateReason::unsynchronised);
  verdict.state = stale ? MapState::stale : verdict.reasons.empty() ? MapState::ok : MapState::degraded;
  return verdict;
}

}  // namespace laneloom
