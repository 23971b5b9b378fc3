#include <fmt/format.h>

#include <algorithm>

#include "base/distribution.hpp"
#include "check/findings.hpp"

namespace laneloom::check {
namespace {

constexpr double kPercentFrom = 12.0;  // log odds are not as large

}  // namespace

Findings confidence_findings(const std::vector<DetectionFrame>& frames, const PreprocessConfig& preprocess,
                             Correction& correction) {
  Distribution all, best;
  for (const DetectionFrame& frame : frames) {
    if (frame.detections.empty()) continue;
    for (const Detection& detection : frame.detections) all.add(detection.confidence);
    best.add(std::ranges::max_element(frame.detections, {}, &Detection::confidence)->confidence);
  }
  const double least = all.quantile(0.0), most = all.quantile(1.0);
  if (least < 0.0 || most > 1.0) {
    const bool percent = least >= 0.0 && all.quantile(0.9) > kPercentFrom;
    correction.confidences = percent ? ConfidenceScale::percent : ConfidenceScale::logit;
    return {
        {"confidence_scale",
         fmt::format("Confidences are from {:g} to {:g}, as {} are; the service takes shares from 0 to 1.",
                     least, most, percent ? "percentages" : "log odds"),
         ""}};
  }
  if (all.count() == 0 || best.quantile(0.5) >= preprocess.min_confidence) return {};
  return {
      {"confidence_low",
       fmt::format(
           "In half of the frames no detection is of a confidence of {:g} or more; those below are dropped.",
           preprocess.min_confidence),
       fmt::format("Set mapper.preprocess.min_confidence to {:.3f}.", 0.5 * best.quantile(0.5))}};
}

}  // namespace laneloom::check
