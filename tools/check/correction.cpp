#include "check/correction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/degree.hpp"
#include "io/axes.hpp"

namespace laneloom::check {
namespace {

double share_of(double confidence, ConfidenceScale scale) {
  if (scale == ConfidenceScale::percent) return confidence / 100.0;
  if (scale == ConfidenceScale::logit) return 1.0 / (1.0 + std::exp(-confidence));
  return confidence;
}

}  // namespace

std::string options(const Correction& correction) {
  const Correction none;
  std::string text;
  const auto add = [&](bool needed, const std::string& option) {
    if (needed) text += (text.empty() ? "" : " ") + option;
  };
  add(correction.axes != none.axes, "--axes " + correction.axes);
  add(correction.point_scale != 1.0, fmt::format("--point-scale {:g}", correction.point_scale));
  add(correction.points_in_map, "--points-in-map");
  add(correction.sensor_left_m != 0.0, fmt::format("--sensor-left {:.2f}", correction.sensor_left_m));
  add(correction.sensor_yaw_deg != 0.0, fmt::format("--sensor-yaw {:.1f}", correction.sensor_yaw_deg));
  add(correction.pose_scale != 1.0, fmt::format("--pose-scale {:g}", correction.pose_scale));
  add(correction.scalar_first, "--quaternion wxyz");
  add(correction.pose_time_s != 0.0, fmt::format("--pose-time {:.2f}", correction.pose_time_s));
  add(correction.confidences == ConfidenceScale::percent, "--confidence percent");
  add(correction.confidences == ConfidenceScale::logit, "--confidence logit");
  return text;
}

VehiclePose corrected(VehiclePose pose, const Correction& correction) {
  pose.stamp_ns += std::llround(correction.pose_time_s * 1e9);
  pose.position *= correction.pose_scale;
  const Eigen::Quaterniond& read = pose.orientation;
  if (correction.scalar_first) pose.orientation = Eigen::Quaterniond(read.x(), read.y(), read.z(), read.w());
  return pose;
}

Eigen::Affine3d body_from_points(const Correction& correction, const Eigen::Isometry3d& T_map_body) {
  Eigen::Affine3d transform(io::axes_named(correction.axes) * correction.point_scale);
  if (correction.points_in_map) transform = T_map_body.inverse() * transform;
  const Eigen::AngleAxisd turn(correction.sensor_yaw_deg * kDegree, Point::UnitZ());
  return Eigen::Translation3d(0.0, correction.sensor_left_m, 0.0) * turn * transform;
}

DetectionFrame corrected(DetectionFrame frame, const Correction& correction,
                         const Eigen::Isometry3d& T_map_body) {
  const Eigen::Affine3d T_body_points = body_from_points(correction, T_map_body);
  const auto correct = [&](Polyline& points) {
    for (Point& point : points) point = T_body_points * point;
  };
  correct(frame.field_of_view);
  std::ranges::for_each(frame.occluded_areas, correct);
  for (Detection& detection : frame.detections) {
    correct(detection.points);
    for (double& stddev_m : detection.stddev_m) stddev_m *= correction.point_scale;
    detection.confidence = share_of(detection.confidence, correction.confidences);
  }
  return frame;
}

TrackedObjects corrected(TrackedObjects objects, Correction correction, const Eigen::Isometry3d& T_map_body) {
  correction.points_in_map = correction.points_in_map || objects.in_map_frame;
  const Eigen::Affine3d T_body_points = body_from_points(correction, T_map_body);
  for (TrackedObject& object : objects.objects) {
    object.position = T_body_points * object.position;
    object.heading = (T_body_points.linear() * object.heading).normalized();
    object.speed_mps *= correction.point_scale;
    for (double* length_m : {&object.position_stddev_m, &object.length_m, &object.width_m})
      if (*length_m >= 0.0) *length_m *= correction.point_scale;
  }
  objects.in_map_frame = false;
  return objects;
}

}  // namespace laneloom::check
