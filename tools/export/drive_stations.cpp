#include "export/drive_stations.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "laneloom/polyline.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::exports {
namespace {

constexpr double kSample_m = 2.0;  // between samples of a line

}  // namespace

std::vector<DriveStation::Sample> samples_of(const Marking& line) {
  const MeasuredPolyline course(line.points);
  const std::vector<double> arcs_m = arc_lengths(line.points);
  const Polyline points = course.resample(kSample_m);
  std::vector<DriveStation::Sample> samples;
  samples.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double arc_m = course.length() * static_cast<double>(i) / static_cast<double>(points.size() - 1);
    const double stddev_m = line.lateral_stddev_m.empty()
                                ? kUnknownStddev_m
                                : markings::deviation_at(arcs_m, line.lateral_stddev_m, arc_m);
    samples.push_back({line.type, points[i], course.direction(arc_m), stddev_m});
  }
  return samples;
}

std::vector<double> driven_to(const DriveLines& drive) {
  std::vector<double> driven_m(drive.poses.size(), 0.0);
  for (std::size_t i = 1; i < drive.poses.size(); ++i)
    driven_m[i] = driven_m[i - 1] + (drive.poses[i].translation() - drive.poses[i - 1].translation()).norm();
  return driven_m;
}

std::vector<DriveStation> stations_of(const DriveLines& drive) {
  std::vector<DriveStation> stations;
  auto piece = drive.pieces.begin();
  const std::vector<double> driven_m = driven_to(drive);
  std::vector<DriveStation::Sample> samples;
  for (std::size_t i = 0; i < drive.poses.size(); ++i) {
    const bool is_last = i + 1 == drive.poses.size();
    for (; piece != drive.pieces.end() && piece->pose <= i; ++piece)
      std::ranges::move(samples_of(piece->marking), std::back_inserter(samples));
    if (!stations.empty() && !is_last && driven_m[i] < stations.back().driven_m + kStation_m) continue;
    stations.push_back({drive.poses[i], driven_m[i], std::exchange(samples, {})});
  }
  return stations;
}

}  // namespace laneloom::exports
