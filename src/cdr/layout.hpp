#pragma once

#include "Detections.h"
#include "LaneMap.h"
#include "RoadMarkings.h"
#include "ServiceStatus.h"
#include "VehiclePose.h"
#include "cdr/cdr_scanner.hpp"

/// What each message of idl/ looks like in CDR.
namespace laneloom::dds {

void scan(CdrScanner& cdr, const msg::Detections*);
void scan(CdrScanner& cdr, const msg::VehiclePose*);
void scan(CdrScanner& cdr, const msg::LaneMap*);
void scan(CdrScanner& cdr, const msg::RoadMarkings*);
void scan(CdrScanner& cdr, const msg::ServiceStatus*);

/// Whether `payload` can be a Message: every length is within its bound and within the payload.
template <class Message>
bool well_formed(std::span<const std::uint8_t> payload) {
  CdrScanner cdr(payload);
  scan(cdr, static_cast<const Message*>(nullptr));
  return cdr.complete();
}

}  // namespace laneloom::dds
