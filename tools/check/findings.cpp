#include "check/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace laneloom::check {
namespace {

constexpr std::uint64_t kTolerated = 20;  // one in so many may be left out

void append(Findings& to, Findings more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// The conventions of one source. They are put into `correction`.
Findings source_findings(std::vector<DetectionFrame> frames, const PoseTrack& poses,
                         const MapperConfig& mapper, const CommandFor& command_for, Correction& correction) {
  std::ranges::stable_sort(frames, {}, &DetectionFrame::stamp_ns);
  Findings found = confidence_findings(frames, mapper.preprocess, correction);
  append(found, convention_findings(frames, poses, correction));
  append(found, lane_findings(frames, poses, mapper.lane, correction));
  for (Finding& finding : found)
    if (finding.remedy.empty())
      finding.remedy = fmt::format("Mend it where it is written, or let `{}` write the drive anew.",
                                   command_for(correction));
  return found;
}

/// Calls `visit` for each source with what is found of it, and with its correction.
template <typename Visit>
void for_each_source(const Drive& drive, const PoseTrack& poses, const MapperConfig& mapper,
                     const CommandFor& command_for, Visit visit) {
  for (const auto& [source, frames] : drive.frames) {
    Correction correction;
    Findings found = source_findings(frames, poses, mapper, command_for, correction);
    visit(source, std::move(found), correction);
  }
}

/// Names the source if there are several.
Findings named(Findings found, const Drive& drive, const std::string& source) {
  if (drive.frames.size() > 1)
    for (Finding& finding : found) finding.found = fmt::format("\"{}\": {}", source, finding.found);
  return found;
}

}  // namespace

std::string import_frames_command(const Correction& correction) {
  return "laneloom import frames " + options(correction);
}

Findings fit_findings(const Drive& drive, const MapperConfig& mapper) {
  if (drive.poses.empty()) return {};
  Findings all;
  for_each_source(drive, PoseTrack(drive.poses), mapper, import_frames_command,
                  [&](const std::string& source, Findings found, const Correction& /*correction*/) {
                    append(all, named(std::move(found), drive, source));
                  });
  return all;
}

std::map<std::string, double> sensor_offsets(const Drive& drive, const MapperConfig& mapper) {
  std::map<std::string, double> offsets;
  if (drive.poses.empty()) return offsets;
  for_each_source(drive, PoseTrack(drive.poses), mapper, import_frames_command,
                  [&](const std::string& source, const Findings& /*found*/, const Correction& correction) {
                    const double left_m = correction.sensor_left_m;
                    if (left_m != 0.0 && options(correction) == options({.sensor_left_m = left_m}))
                      offsets[source] = left_m;
                  });
  return offsets;
}

Findings left_out_findings(const Drive& drive, const LeftOut& left_out) {
  std::uint64_t frames = 0;
  for (const auto& [source, of_source] : drive.frames) frames += of_source.size();
  if (kTolerated * left_out.count() <= frames + left_out.count()) return {};
  return {{"left_out", fmt::format("Beside {} frames, this cannot be read: {}.", frames, left_out.summary()),
           "Mend it where it is written: all commands leave it out."}};
}

Findings findings(const Drive& drive, const Config& config, const CommandFor& command_for) {
  if (drive.frames.empty())
    return {{"no_detections", "There are no detections.",
             "Record the topic of detections, or see laneloom doctor."}};
  if (drive.poses.empty())
    return {{"no_poses", "There are no poses.", "Record the topic of poses, or see laneloom doctor."}};
  if (const auto runs = later_runs(drive.poses); !runs.empty())
    return {{"several_runs",
             fmt::format("There are {} runs, one behind the other: stamps begin anew at pose {}.",
                         runs.size() + 1, runs.front() + 1),
             "Make a file of each run: the frames of one would be taken for those of the other."}};
  const PoseTrack poses(drive.poses);
  Correction correction;  // of the last source: that of the poses is the same for all
  Findings stamps, conventions;
  for (const auto& [source, frames] : drive.frames)
    append(stamps, named(frame_stamp_findings(frames, drive.poses, config.sync), drive, source));
  for_each_source(drive, poses, config.mapper, command_for,
                  [&](const std::string& source, Findings found, const Correction& of_source) {
                    append(conventions, named(std::move(found), drive, source));
                    correction = of_source;
                  });
  append(stamps, pose_stamp_findings(drive.poses));
  append(stamps, jump_findings(poses, correction));
  append(stamps, std::move(conventions));
  append(stamps, object_findings(drive.objects, config.gate));
  return stamps;
}

}  // namespace laneloom::check
