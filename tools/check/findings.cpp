#include "check/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace laneloom::check {
namespace {

void append(Findings& to, Findings more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// The conventions of one source. They are put into `correction`.
Findings source_findings(std::vector<DetectionFrame> frames, const PoseTrack& poses,
                         const MapperConfig& mapper, Correction& correction) {
  std::ranges::stable_sort(frames, {}, &DetectionFrame::stamp_ns);
  Findings found = confidence_findings(frames, mapper.preprocess, correction);
  append(found, convention_findings(frames, poses, correction));
  append(found, lane_findings(frames, poses, mapper.lane, correction));
  for (Finding& finding : found)
    if (finding.remedy.empty())
      finding.remedy =
          fmt::format("Mend it where it is written, or let `laneloom import frames {}` write the drive anew.",
                      options(correction));
  return found;
}

}  // namespace

Findings findings(const Drive& drive, const Config& config) {
  if (drive.frames.empty())
    return {{"no_detections", "There are no detections.",
             "Record the topic of detections, or see laneloom doctor."}};
  if (drive.poses.empty())
    return {{"no_poses", "There are no poses.", "Record the topic of poses, or see laneloom doctor."}};
  const PoseTrack poses(drive.poses);
  Correction correction;
  Findings stamps, conventions;
  for (const auto& [source, frames] : drive.frames) {
    const auto add = [&, &name = source](Findings& to, Findings found) {
      for (Finding& finding : found)
        if (drive.frames.size() > 1) finding.found = fmt::format("\"{}\": {}", name, finding.found);
      append(to, std::move(found));
    };
    correction = {};
    add(stamps, frame_stamp_findings(frames, drive.poses, config.sync));
    add(conventions, source_findings(frames, poses, config.mapper, correction));
  }
  append(stamps, pose_stamp_findings(drive.poses));
  append(stamps, jump_findings(poses, correction));
  append(stamps, std::move(conventions));
  return stamps;
}

}  // namespace laneloom::check
