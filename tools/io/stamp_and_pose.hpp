#pragma once

#include <nlohmann/json.hpp>

#include "laneloom/types.hpp"

/// The keys that frames and maps have in common: "t", "stamp_ns" and "pose".
namespace laneloom::io {

void put_stamp_and_pose(nlohmann::json& object, std::int64_t stamp_ns, const Point& position,
                        const Eigen::Quaterniond& orientation);

/// The stamp: "stamp_ns" if it is given, or else "t". Throws JsonError.
std::int64_t read_stamp_ns(const nlohmann::json& object);

/// Position and orientation of "pose". Throws JsonError.
VehiclePose read_pose(const nlohmann::json& object);

}  // namespace laneloom::io
