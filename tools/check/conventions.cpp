#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/distribution.hpp"
#include "base/seconds.hpp"
#include "check/agreement.hpp"
#include "check/findings.hpp"
#include "io/axes.hpp"

namespace laneloom::check {
namespace {

constexpr int kMostCauses = 3;
// A cause is believed if frames disagree by this much less with its correction, which is so many standard
// deviations of the mean.
constexpr double kLeastGain_m = 0.004, kLeastGainShare = 0.02, kLeastSigmas = 4.0;

// Sound drives of the noisiest networks disagree by 0.47 m; with the detections of other frames, by 0.55 m at
// least.
constexpr double kUnexplained_m = 0.52;

// Of causes that are as good, the one that is met more often is believed.
constexpr double kTie_m = 0.05;

/// A correction that may be the right one, and how well frames agree with it.
struct Hypothesis {
  std::string id, found;
  Correction correction;
  std::vector<double> disagreements{};
};

double mean(const std::vector<double>& values) { return Distribution(values).mean(); }

/// How much less frames disagree by a hypothesis. 0: it can be chance.
double gain(const std::vector<double>& before, const std::vector<double>& after) {
  std::vector<double> gains(before.size());
  std::ranges::transform(before, after, gains.begin(), std::minus<>());
  const double gain = mean(gains);
  for (double& value : gains) value -= gain;
  const double sigma = Distribution(gains).root_mean_square() / std::sqrt(static_cast<double>(gains.size()));
  const bool certain =
      gain > kLeastSigmas * sigma && gain > kLeastGain_m && gain > kLeastGainShare * mean(before);
  return certain ? gain : 0.0;
}

/// A value of a correction that is not one of a few, and the range and step in which it is searched for.
struct Scale {
  double Correction::*value;
  double farthest, step, least;  ///< smaller values are not told from none
};

constexpr Scale kTime{&Correction::pose_time_s, 1.0, 0.1, 0.03};
constexpr Scale kYaw{&Correction::sensor_yaw_deg, 8.0, 1.0, 0.4};
constexpr Scale kLeft{&Correction::sensor_left_m, 2.0, 0.25, 0.15};

constexpr double kFewTurns_deg = 45.0;
constexpr double kSlowest_mps = 0.5, kQuickest_mps = 90.0;

/// The unit in metres of a value that is usually about 10 m, or 10 m/s.
double unit_of(double value) {
  return value < 0.1 ? 1000.0 : value < 300.0 ? 1.0 : value < 3500.0 ? 0.01 : 0.001;
}
const char* unit_name(double scale) {
  return scale == 1000.0 ? "kilometres" : scale == 0.01 ? "centimetres" : "millimetres";
}

/// The speed of the vehicle where it does not stand, in units of the positions.
double usual_speed(const PoseTrack& poses) {
  Distribution speeds;
  const auto& all = poses.poses();
  for (std::size_t i = 1; i < all.size(); ++i)
    speeds.add((all[i].position - all[i - 1].position).norm() /
               seconds(all[i].stamp_ns - all[i - 1].stamp_ns));
  return speeds.quantile(0.9);
}

/// The correction with the best value.
Correction fitted(const Agreement& agreement, Correction correction, const Scale& scale) {
  double& value = correction.*scale.value;
  const double before = value;
  double best = before, least = mean(agreement.disagreements(correction));
  const auto search = [&](double centre, double reach, double step) {
    for (int i = 1; i <= std::lround(reach / step); ++i)
      for (const double side : {-1.0, 1.0}) {
        value = centre + side * i * step;
        const double disagreement = mean(agreement.disagreements(correction));
        if (disagreement < least) {
          least = disagreement;
          best = value;
        }
      }
  };
  search(before, scale.farthest, scale.step);
  search(best, scale.step, 0.2 * scale.step);
  search(best, 0.2 * scale.step, 0.1 * scale.step);
  value = std::abs(best - before) < scale.least ? before : best;
  return correction;
}

/// What a value was found to be, by its sign.
std::string signed_text(double value, const char* unit, const char* if_positive, const char* if_negative) {
  return fmt::format(fmt::runtime(unit), std::abs(value)) + (value > 0.0 ? if_positive : if_negative);
}

std::vector<Hypothesis> fitted_hypotheses(const Agreement& agreement, const Correction& base) {
  const Correction time = fitted(agreement, base, kTime), yaw = fitted(agreement, base, kYaw),
                   left = fitted(agreement, base, kLeft);
  return {
      {"pose_time",
       signed_text(time.pose_time_s * 1e3, "The stamps of the poses are {:.0f} ms too ", "early", "late"),
       time},
      {"sensor_yaw",
       signed_text(yaw.sensor_yaw_deg, "The points are turned by {:.1f} degrees to the ", "right", "left"),
       yaw},
      {"sensor_left",
       signed_text(left.sensor_left_m, "The points lie {:.2f} m too far to the ", "right", "left"), left}};
}

std::vector<Hypothesis> hypotheses(const Agreement& agreement, const Correction& base) {
  std::vector<Hypothesis> result;
  const auto add = [&](const std::string& id, const std::string& found, auto Correction::*member,
                       auto value) {
    Correction correction = base;
    correction.*member = std::move(value);
    result.push_back({id, found, correction});
  };
  add("quaternion_order", "The orientations of the poses are written with w first", &Correction::scalar_first,
      !base.scalar_first);
  add("points_in_map_frame", "The points are in the map frame, and not in the body frame",
      &Correction::points_in_map, !base.points_in_map);
  for (const std::string& axes : io::axes_names())
    add("axes", "The axes of the points are " + axes, &Correction::axes, axes);
  if (const double scale = unit_of(agreement.size()); scale != 1.0)
    add("point_unit", fmt::format("The points are in {}", unit_name(scale)), &Correction::point_scale, scale);
  // A fit to what is wrong as a whole would tell nothing.
  if (agreement.plausible(base))
    std::ranges::move(fitted_hypotheses(agreement, base), std::back_inserter(result));
  return result;
}

std::vector<double> disagreements(const Agreement& agreement, const Correction& correction) {
  std::vector<double> result = agreement.disagreements(correction);
  if (!agreement.plausible(correction)) std::ranges::fill(result, 1.0);
  return result;
}

/// The unit of positions by which frames agree best, among those by which the vehicle is as quick as one.
double pose_unit(const std::vector<DetectionFrame>& frames, const PoseTrack& poses) {
  const double speed = usual_speed(poses);
  double best = 1.0, least = std::numeric_limits<double>::infinity();
  if (speed < kQuickest_mps) return best;
  for (const double scale : {unit_of(speed), 0.01, 0.001}) {
    if (speed * scale > kQuickest_mps || speed * scale < kSlowest_mps) continue;
    const Agreement agreement(frames, poses, scale);
    const double disagreement = mean(disagreements(agreement, {.pose_scale = scale}));
    if (disagreement >= least - kLeastGain_m) continue;
    least = disagreement;
    best = scale;
  }
  return best;
}

/// The findings of a drive in which no known cause is at fault. `disagreement_m` is that of the frames.
Findings unknown_causes(const Agreement& agreement, const Correction& correction, double disagreement_m) {
  if (!agreement.drives_forward(correction))
    return {{"pose_orientation", "The vehicle does not drive to where the orientations of its poses point.",
             "A pose is T_map_body: see the fields of VehiclePose in idl/README.md."}};
  if (!agreement.lines_lie_well(correction))
    return {{"points", "The lines do not lie around the vehicle, level and along its way.",
             "Points are metres in the body frame: see the fields of DetectionFrame in idl/README.md."}};
  if (disagreement_m > kUnexplained_m)
    return {
        {"disagreement",
         fmt::format("Frames disagree by {:.2f} m, and no mistake that is known explains it.",
                     disagreement_m),
         "See whether each frame has the detections, the stamp and the pose of one instant, and whether its "
         "points are metres."}};
  return {};
}

/// The hypothesis that makes frames agree best, if one does for certain.
std::optional<Hypothesis> best_cause(const Agreement& agreement, const Correction& base,
                                     const std::vector<double>& before) {
  std::optional<Hypothesis> best;
  double most = 0.0;
  for (Hypothesis& hypothesis : hypotheses(agreement, base)) {
    hypothesis.disagreements = disagreements(agreement, hypothesis.correction);
    const double better = gain(before, hypothesis.disagreements);
    if (better <= most + (best ? kTie_m : 0.0)) continue;
    most = better;
    best = std::move(hypothesis);
  }
  return best;
}

}  // namespace

Findings convention_findings(const std::vector<DetectionFrame>& frames, const PoseTrack& poses,
                             Correction& correction) {
  Findings found;
  correction.pose_scale = pose_unit(frames, poses);
  if (correction.pose_scale != 1.0)
    found.push_back({"pose_unit",
                     fmt::format("The positions of the poses are in {}.", unit_name(correction.pose_scale)),
                     {}});
  const Agreement agreement(frames, poses, correction.pose_scale);
  if (!agreement.can_tell()) {
    found.push_back(
        {kTooLittle,
         "Too little is seen, or the vehicle drives too little, to tell whether frames fit together.",
         "Check a drive of 50 m or more, with bends.", true});
    return found;
  }
  std::vector<double> before = disagreements(agreement, correction);
  for (int i = 0; i < kMostCauses; ++i) {
    std::optional<Hypothesis> cause = best_cause(agreement, correction, before);
    if (!cause) break;
    correction = cause->correction;
    found.push_back({cause->id,
                     fmt::format("{}: frames then disagree by {:.2f} instead of {:.2f} m.", cause->found,
                                 mean(cause->disagreements), mean(before)),
                     {}});
    before = std::move(cause->disagreements);
  }
  if (found.empty()) found = unknown_causes(agreement, correction, mean(before));
  if (found.empty() && agreement.turned_deg() < kFewTurns_deg)
    found.push_back(
        {"few_turns",
         fmt::format("The vehicle turns by {:.0f} degrees in all: mirrored axes, or poses that are late by "
                     "a few tenths of a second, do not show on so straight a way.",
                     agreement.turned_deg()),
         "Check a drive with bends, too.", true});
  return found;
}

}  // namespace laneloom::check
