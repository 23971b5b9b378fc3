#pragma once

#include <utility>

#include "cdr/layout.hpp"
#include "laneloom/messages.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"

/// Maps each plain type to its message type. The functions are only declared.
namespace laneloom::dds {

msg::Detections message_of(const DetectionFrame&);
msg::VehiclePose message_of(const VehiclePose&);
msg::Objects message_of(const TrackedObjects&);
msg::NextTurn message_of(const NextTurn&);
msg::LaneMap message_of(const PublishedMap&);
msg::RoadMarkings message_of(const RoadMarkings&);
msg::ServiceStatus message_of(const ServiceStatus&);

template <class T>
using MessageOf = decltype(message_of(std::declval<const T&>()));

}  // namespace laneloom::dds
