#pragma once

#include <string>
#include <vector>

#include "RoadMarkings.h"
#include "cdr/intake.hpp"
#include "laneloom/types.hpp"

/// Parts that several messages share.
namespace laneloom::dds {

msg::Point to_msg(const Point& from);
std::vector<msg::Point> to_msg(const Polyline& from);
msg::Range to_msg(const laneloom::Stretch& from);
msg::Pose pose_to_msg(const Point& position, const Eigen::Quaterniond& orientation);
msg::Header header_to_msg(std::int64_t stamp_ns, std::uint64_t sequence, std::uint64_t session_id,
                          const std::string& frame_id);

/// `stamp_ns` is the stamp of the message. Times of the marking are sent as ages at that stamp.
msg::Marking to_msg(const Marking& from, std::int64_t stamp_ns);
Marking from_msg(const msg::Marking& from, std::int64_t stamp_ns, Intake& intake);

/// Converts all elements of a vector.
template <class To, class From, class Convert>
std::vector<To> convert_all(const std::vector<From>& from, Convert convert) {
  std::vector<To> to;
  to.reserve(from.size());
  for (const auto& element : from) to.push_back(convert(element));
  return to;
}

/// Converts an enumerator to the IDL's enumeration, which lists the same values in the same order.
template <class To, class From>
To enum_to_msg(From value) {
  return static_cast<To>(static_cast<std::uint32_t>(value));
}

}  // namespace laneloom::dds
