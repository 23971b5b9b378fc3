// perception DOMAIN VEHICLE_ID: publishes what a network sees and where the car is, on a straight road with
// two lanes.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "laneloom/dds/writer.hpp"
#include "laneloom/types.hpp"

namespace {

using Clock = std::chrono::system_clock;
using laneloom::Detection;
using laneloom::DetectionFrame;
using laneloom::VehiclePose;

constexpr auto kPosePeriod = std::chrono::milliseconds(10);
constexpr std::uint64_t kPosesPerFrame = 10;
constexpr double kSpeed_mps = 10.0;

std::int64_t nanoseconds(Clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

/// A line beside the car in the body frame (x forward, y left, z up); the network trusts far points less.
Detection laneline(double left_m, laneloom::MarkingStyle style) {
  Detection line{.type = laneloom::MarkingType::laneline, .style = style, .confidence = 0.9};
  for (double forward_m = -5.0; forward_m <= 30.0; forward_m += 5.0) {
    line.points.emplace_back(forward_m, left_m, 0.0);
    line.stddev_m.push_back(0.05 + 0.003 * std::abs(forward_m));
  }
  return line;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: perception DOMAIN VEHICLE_ID\n";
    return EXIT_FAILURE;
  }
  laneloom::DdsConfig dds;
  dds.domain = std::atoi(argv[1]);
  dds.vehicle_id = argv[2];
  const laneloom::dds::Participant participant(dds, "example of a perception");
  laneloom::dds::Writer<VehiclePose> poses(participant);
  laneloom::dds::Writer<DetectionFrame> frames(participant);

  const auto start = Clock::now();
  const auto session = static_cast<std::uint64_t>(nanoseconds(start));  // another value after a restart
  for (std::uint64_t number = 1;; ++number) {
    const auto elapsed = kPosePeriod * number;
    std::this_thread::sleep_until(start + elapsed);
    VehiclePose pose{.stamp_ns = nanoseconds(start + elapsed), .sequence = number, .session_id = session};
    pose.position.x() = kSpeed_mps * std::chrono::duration<double>(elapsed).count();
    if (!poses.write(pose)) std::cerr << "DDS did not take a pose\n";
    if (number % kPosesPerFrame != 0) continue;
    DetectionFrame frame{
        .stamp_ns = pose.stamp_ns, .sequence = number / kPosesPerFrame, .session_id = session};
    frame.source = "example";
    frame.detected_types = {laneloom::MarkingType::laneline};  // it does not look for other types
    frame.detections = {laneline(1.75, laneloom::MarkingStyle::dashed),
                        laneline(-1.75, laneloom::MarkingStyle::solid),
                        laneline(5.25, laneloom::MarkingStyle::solid)};
    if (!frames.write(frame)) std::cerr << "DDS did not take a frame\n";
  }
}
