#pragma once

#include "Detections.hpp"
#include "LaneMap.hpp"
#include "NextTurn.hpp"
#include "Objects.hpp"
#include "RoadMarkings.hpp"
#include "ServiceStatus.hpp"
#include "VehiclePose.hpp"
#include "cdr/cdr_scanner.hpp"

/// The layout of each message of idl/ in CDR.
namespace laneloom::dds {

void scan(CdrScanner& cdr, const msg::Detections*);
void scan(CdrScanner& cdr, const msg::VehiclePose*);
void scan(CdrScanner& cdr, const msg::Objects*);
void scan(CdrScanner& cdr, const msg::NextTurn*);
void scan(CdrScanner& cdr, const msg::LaneMap*);
void scan(CdrScanner& cdr, const msg::RoadMarkings*);
void scan(CdrScanner& cdr, const msg::ServiceStatus*);

/// The number that tells the messages of one topic from others (Header.data_id).
constexpr std::uint32_t data_id(const msg::Detections* /*type*/) { return msg::DATA_ID_DETECTIONS; }
constexpr std::uint32_t data_id(const msg::VehiclePose* /*type*/) { return msg::DATA_ID_VEHICLE_POSE; }
constexpr std::uint32_t data_id(const msg::Objects* /*type*/) { return msg::DATA_ID_OBJECTS; }
constexpr std::uint32_t data_id(const msg::NextTurn* /*type*/) { return msg::DATA_ID_NEXT_TURN; }
constexpr std::uint32_t data_id(const msg::LaneMap* /*type*/) { return msg::DATA_ID_LANE_MAP; }
constexpr std::uint32_t data_id(const msg::RoadMarkings* /*type*/) { return msg::DATA_ID_ROAD_MARKINGS; }
constexpr std::uint32_t data_id(const msg::ServiceStatus* /*type*/) { return msg::DATA_ID_STATUS; }
template <class Message>
inline constexpr std::uint32_t kDataId = data_id(static_cast<const Message*>(nullptr));

/// Whether `payload` can be a Message: every length is within its bound and within the payload.
template <class Message>
bool well_formed(std::span<const std::uint8_t> payload) {
  CdrScanner cdr(payload);
  scan(cdr, static_cast<const Message*>(nullptr));
  return cdr.complete();
}

}  // namespace laneloom::dds
