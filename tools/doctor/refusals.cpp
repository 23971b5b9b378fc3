#include "doctor/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>

namespace laneloom::doctor {
namespace {

constexpr std::string_view kWriter = "Mend what writes them.";
constexpr std::string_view kGate =
    "If they are right, the section `gate` of the configuration has the limit.";
constexpr std::string_view kIdl =
    "Generate its types from this version's IDL, as plain XCDR1; the bounds are part of it.";

constexpr std::array kRefusals{
    Refusal{"crc", "their bytes are not those that their writer protected (Header.crc)",
            "Something on the way damages them, or the writer computes the CRC otherwise than idl/Common.idl "
            "says."},
    Refusal{"data_id", "they are protected as messages of another topic (Header.data_id)",
            "Give them the data id that idl/Common.idl has for the topic."},
    Refusal{"malformed", "their bytes are no message of the topic's type", kIdl},
    Refusal{"unknown_enum", "an enumeration has a value that the IDL does not know", kIdl},
    Refusal{"not_text", "their source or frame_id is not UTF-8", "Write names as UTF-8, or as plain ASCII."},
    Refusal{"not_finite", "they hold a NaN or an infinity", kWriter},
    Refusal{"not_a_rotation", "their quaternion is not of length one",
            "Normalise it where they are written."},
    Refusal{"detections_wrong_frame", "their frame_id is the map frame, but they are given in the body frame",
            "Name the body frame in them, as in base_link. See whether dds.map_frame_id is that by mistake."},
    Refusal{
        "poses_wrong_frame", "their frame_id is not the map frame",
        "Set dds.map_frame_id to the frame that poses are given in, or the frame_id of the poses to that."},
    Refusal{"objects_wrong_frame", "their frame_id is neither the map frame nor base_link",
            "Give them in the body frame as base_link, or in the frame that dds.map_frame_id names."},
    Refusal{"wrong_size", "lists that belong together differ in length", kWriter},
    Refusal{"stamp", "their stamp is zero, negative or absurd", "Stamp them in nanoseconds, at measurement."},
    Refusal{"coordinate", "a coordinate is further out than gate.max_coordinate_m", kGate},
    Refusal{"too_few_points", "a polyline has less than two points, or a field of view less than three",
            "Leave such lines out where they are written. A field of view is a polygon, or empty."},
    Refusal{"confidence", "a confidence is not within 0..1", kWriter},
    Refusal{"stddev", "a standard deviation is negative", kWriter},
    Refusal{"repeated", "their stamp is that of the one before",
            "See whether two writers send the same data, or one sends it twice."},
    Refusal{"late", "their stamp is before one that was taken already",
            "Write poses in the order of their stamps; see whether two writers take turns."},
    Refusal{"outlier",
            "their stamp or position jumped (gate.max_stamp_step_s, max_speed_mps, max_pose_jump_m)",
            "See whether two writers take turns, or a clock or localisation jumps. Three in a row that agree "
            "are believed, and begin a new map."},
    Refusal{"unsynchronised", "no poses around their stamp came in time",
            "See whether both use one clock, poses come at 20 Hz or more (sync.max_pose_gap_s), and no later "
            "than sync.max_wait_s after the frame."},
    Refusal{"reset", "they waited for poses when the map began anew",
            "See why it did: pose or stamp jumped."},
    Refusal{
        "contradictory", "their source sees the lines elsewhere than a source that was there before it",
        "See how the sensors of both are calibrated, and whether both stamp by one clock; what is found of "
        "sources_disagree names them."},
    Refusal{"heading", "the heading of an object is neither zero nor of length one",
            "Normalise it; zero tells that it is not known, or known up to its sign."},
    Refusal{"speed", "the speed of an object is beyond gate.max_speed_mps", kGate},
    Refusal{"existence", "the existence probability of an object is neither within 0..1 nor -1", kWriter},
    Refusal{"length", "a length of an object is negative, but not -1", kWriter},
    Refusal{"distance", "the distance of a turn is negative or absurd",
            "Give it in metres along the road, from the vehicle to the middle of the intersection."},
    Refusal{"repeated_id", "two objects of one message have one id",
            "Give each object an id of its own for as long as it is followed."},
    Refusal{"too_many_sources", "eight other sources of detections are heard",
            "Give each perception stack one name of its own for the field `source`, and run at most eight."}};

constexpr std::string_view kStranger =
    "Someone on the network damages datagrams, attacks, or has a DDS that the guard does not know. Capture "
    "the ports from "
    "7400 + 250 · domain on; config/security/README.md tells what the guard lets through.";

constexpr std::array kRefusedDatagrams{
    Refusal{"header", "they are no RTPS of version 2",
            "Another program sends to the ports of DDS: give it others, or the vehicle another domain."},
    Refusal{"length", "a part is longer than the datagram, or shorter than what it holds", kStranger},
    Refusal{"kind", "they have a submessage that RTPS does not know", kStranger},
    Refusal{"vendor", "a submessage of Fast DDS is where it would end the process", kStranger},
    Refusal{"clear", "they are neither encrypted nor signed, though the governance wants all protected",
            "Give the sender an identity (dds.security_directory), or keep it off the domain."},
    Refusal{"writer", "they have a sample of no writer", kStranger},
    Refusal{"fragments", "fragments do not fit to their sample, or are of more than 16 MiB", kStranger},
    Refusal{"sequence", "they have sequence numbers that no writer has", kStranger},
    Refusal{"leap", "sequence numbers are far beyond those that the writer has sent", kStranger},
    Refusal{"bitmap", "a set has more numbers than RTPS allows", kStranger},
    Refusal{"parameters", "a list of parameters or a handshake is not as long as it says", kStranger}};

/// The explanation of the first of `names` that has one.
template <std::size_t count>
Refusal find_refusal(const std::array<Refusal, count>& all, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    const auto* const known = std::ranges::find(all, name, &Refusal::reason);
    if (known != all.end()) return *known;
  }
  return {"unknown", "they are not what the service takes", "See the log of the service."};
}

}  // namespace

Refusal explain_refused_datagrams(std::string_view reason) {
  return find_refusal(kRefusedDatagrams, {reason});
}

Refusal explain_refusal(std::string_view subject, std::string_view reason) {
  return find_refusal(kRefusals, {fmt::format("{}_{}", subject, reason), reason});
}

}  // namespace laneloom::doctor
