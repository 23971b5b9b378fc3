#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "laneloom/messages.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"

/// The members of map elements and detections, each named once, in the order of the IDL. Conversion to and
/// from messages, the check of a message's bytes and bounds, JSON and the bytes of a mapper's state follow
/// from these tables.
namespace laneloom {

/// One member that is published. `OfMessage` gives the member of the IDL's type that holds it. A stamp whose
/// member there is a double is sent as an age in seconds, at the stamp of the message.
template <class Struct, class Value, class OfMessage>
struct Field {
  constexpr Field(const char* its_name, Value Struct::*its_member, OfMessage its_of_message)
      : name(its_name), key(its_name), member(its_member), of_message(its_of_message) {}
  /// Sets the key in JSON, if it differs from the name.
  constexpr Field as(const char* json_key) const { return with(&Field::key, json_key); }
  /// An element that is read from JSON must have this member.
  constexpr Field needed() const { return with(&Field::is_needed, true); }
  /// The elements' JSON leaves this member out.
  constexpr Field not_in_json() const { return as(nullptr); }
  /// The number is read from JSON only if it is from 0 to 1.
  constexpr Field share() const { return with(&Field::is_share, true); }
  /// The value may be unknown: a share of -1, or a stamp of 0, whose age is sent as -1.
  constexpr Field or_unknown() const { return with(&Field::may_be_unknown, true); }

  const char* name;  ///< of the message's member
  const char* key;   ///< in JSON; null: it is not there
  Value Struct::*member;
  OfMessage of_message;    ///< returns the message's member
  bool is_needed = false;  ///< in JSON
  bool is_share = false;
  bool may_be_unknown = false;

 private:
  template <class Attribute>
  constexpr Field with(Attribute Field::*attribute, Attribute value) const {
    Field field = *this;
    field.*attribute = value;
    return field;
  }
};

#define LANELOOM_FIELD_AS(Struct, member, name) \
  Field(#name, &Struct::member, [](auto& message) -> decltype(auto) { return (message.name()); })
#define LANELOOM_FIELD(Struct, name) LANELOOM_FIELD_AS(Struct, name, name)

template <class Struct>
inline constexpr std::nullptr_t kFields = nullptr;

template <>
inline constexpr auto kFields<Stretch> = std::tuple(LANELOOM_FIELD(Stretch, from_m),
                                                    LANELOOM_FIELD(Stretch, to_m));

template <>
inline constexpr auto kFields<Detection> =
    std::tuple(LANELOOM_FIELD(Detection, type).needed(), LANELOOM_FIELD(Detection, style),
               LANELOOM_FIELD(Detection, confidence).as("score").needed().share(),
               LANELOOM_FIELD(Detection, points).needed(), LANELOOM_FIELD(Detection, stddev_m).as("stddev"));

template <>
inline constexpr auto kFields<StyleRange> = std::tuple(LANELOOM_FIELD(StyleRange, range),
                                                       LANELOOM_FIELD(StyleRange, style));

template <>
inline constexpr auto kFields<Marking> = std::tuple(
    LANELOOM_FIELD(Marking, id).needed(), LANELOOM_FIELD(Marking, type).needed(),
    LANELOOM_FIELD(Marking, status), LANELOOM_FIELD(Marking, points).needed(),
    LANELOOM_FIELD(Marking, styles), LANELOOM_FIELD(Marking, lateral_stddev_m).as("lateral_stddev"),
    LANELOOM_FIELD(Marking, existence_probability).as("existence").share().or_unknown(),
    LANELOOM_FIELD(Marking, observations),
    LANELOOM_FIELD_AS(Marking, first_seen_ns, age_s).as("first_seen_ns"),
    LANELOOM_FIELD_AS(Marking, last_seen_ns, unseen_s).as("last_seen_ns").or_unknown());

template <>
inline constexpr auto kFields<LineageEvent> = std::tuple(LANELOOM_FIELD(LineageEvent, kind),
                                                         LANELOOM_FIELD(LineageEvent, element),
                                                         LANELOOM_FIELD(LineageEvent, id),
                                                         LANELOOM_FIELD(LineageEvent, other));

template <>
inline constexpr auto kFields<Neighbour> = std::tuple(LANELOOM_FIELD(Neighbour, lane).needed(),
                                                      LANELOOM_FIELD(Neighbour, range).needed(),
                                                      LANELOOM_FIELD(Neighbour, crossable).needed());

template <>
inline constexpr auto kFields<Border> = std::tuple(LANELOOM_FIELD(Border, boundary).needed(),
                                                   LANELOOM_FIELD(Border, range).needed(),
                                                   LANELOOM_FIELD(Border, on_boundary).needed());

template <>
inline constexpr auto kFields<Lane> =
    std::tuple(LANELOOM_FIELD(Lane, id).needed(), LANELOOM_FIELD(Lane, left_borders),
               LANELOOM_FIELD(Lane, right_borders), LANELOOM_FIELD(Lane, left).needed(),
               LANELOOM_FIELD(Lane, right).needed(), LANELOOM_FIELD(Lane, centerline).needed(),
               LANELOOM_FIELD(Lane, width_m).as("width"), LANELOOM_FIELD(Lane, left_neighbours),
               LANELOOM_FIELD(Lane, right_neighbours), LANELOOM_FIELD(Lane, direction),
               LANELOOM_FIELD(Lane, direction_probability).share().or_unknown(),
               LANELOOM_FIELD(Lane, direction_evidence), LANELOOM_FIELD(Lane, use),
               LANELOOM_FIELD(Lane, use_probability).share().or_unknown(), LANELOOM_FIELD(Lane, section),
               LANELOOM_FIELD(Lane, status),
               LANELOOM_FIELD(Lane, existence_probability).as("existence").share().or_unknown(),
               LANELOOM_FIELD(Lane, evidence), LANELOOM_FIELD(Lane, inferred_ranges));

// In JSON, the marking is in the list of all markings.
template <>
inline constexpr auto kFields<Stopline> = std::tuple(LANELOOM_FIELD(Stopline, marking).not_in_json(),
                                                     LANELOOM_FIELD(Stopline, lanes),
                                                     LANELOOM_FIELD(Stopline, heading));

template <>
inline constexpr auto kFields<Linkage> =
    std::tuple(LANELOOM_FIELD_AS(Linkage, from, from_lane).as("from").needed(),
               LANELOOM_FIELD_AS(Linkage, to, to_lane).as("to").needed(), LANELOOM_FIELD(Linkage, kind),
               LANELOOM_FIELD(Linkage, turn), LANELOOM_FIELD(Linkage, probability).share(),
               LANELOOM_FIELD(Linkage, evidence), LANELOOM_FIELD(Linkage, path));

template <>
inline constexpr auto kFields<WayStation> = std::tuple(
    LANELOOM_FIELD(WayStation, point).needed(),
    LANELOOM_FIELD(WayStation, heading_rad).as("heading").needed(),
    LANELOOM_FIELD(WayStation, curvature_per_m).as("curvature"), LANELOOM_FIELD(WayStation, lane),
    LANELOOM_FIELD(WayStation, left_m).as("left"), LANELOOM_FIELD(WayStation, right_m).as("right"),
    LANELOOM_FIELD(WayStation, width_m).as("width"),
    LANELOOM_FIELD(WayStation, lateral_stddev_m).as("lateral_stddev"), LANELOOM_FIELD(WayStation, status),
    LANELOOM_FIELD(WayStation, may_change_left), LANELOOM_FIELD(WayStation, may_change_right));

template <>
inline constexpr auto kFields<WayLane> = std::tuple(LANELOOM_FIELD_AS(WayLane, id, lane).as("lane").needed(),
                                                    LANELOOM_FIELD(WayLane, against),
                                                    LANELOOM_FIELD(WayLane, entry),
                                                    LANELOOM_FIELD(WayLane, range));

template <>
inline constexpr auto kFields<Way> = std::tuple(LANELOOM_FIELD(Way, step_m).as("step").needed(),
                                                LANELOOM_FIELD(Way, stations).needed(),
                                                LANELOOM_FIELD(Way, lanes),
                                                LANELOOM_FIELD(Way, known_m).as("known"),
                                                LANELOOM_FIELD(Way, confirmed_m).as("confirmed"));

template <>
inline constexpr auto kFields<DrivenPath> =
    std::tuple(LANELOOM_FIELD(DrivenPath, id).needed(), LANELOOM_FIELD(DrivenPath, points).needed(),
               LANELOOM_FIELD(DrivenPath, lateral_stddev_m).as("lateral_stddev"),
               LANELOOM_FIELD(DrivenPath, probability).share());

template <>
inline constexpr auto kFields<TrackedObject> = std::tuple(
    LANELOOM_FIELD(TrackedObject, id).needed(), LANELOOM_FIELD(TrackedObject, kind),
    LANELOOM_FIELD(TrackedObject, existence_probability).as("existence").share().or_unknown(),
    LANELOOM_FIELD(TrackedObject, position).needed(), LANELOOM_FIELD(TrackedObject, heading),
    LANELOOM_FIELD(TrackedObject, speed_mps).as("speed"),
    LANELOOM_FIELD(TrackedObject, position_stddev_m).as("stddev"),
    LANELOOM_FIELD(TrackedObject, length_m).as("length"), LANELOOM_FIELD(TrackedObject, width_m).as("width"));

template <>
inline constexpr auto kFields<NextTurn> = std::tuple(
    LANELOOM_FIELD(NextTurn, turn).needed(), LANELOOM_FIELD(NextTurn, distance_m).as("distance").needed());

template <>
inline constexpr auto kFields<FusedFrame> = std::tuple(
    LANELOOM_FIELD(FusedFrame, source), LANELOOM_FIELD(FusedFrame, session_id),
    LANELOOM_FIELD_AS(FusedFrame, sequence, sequence_number), LANELOOM_FIELD(FusedFrame, stamp_ns));

#undef LANELOOM_FIELD
#undef LANELOOM_FIELD_AS

/// Types that have a table.
template <class Struct>
concept HasFields = !std::is_same_v<std::remove_cv_t<decltype(kFields<Struct>)>, std::nullptr_t>;

template <HasFields Struct, class Visit>
constexpr void for_each_field(Visit visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, kFields<Struct>);
}

/// The largest enumerator. A message with a larger value is refused.
template <class Enum>
inline constexpr Enum kLast = Enum{};
template <>
inline constexpr auto kLast<MarkingType> = MarkingType::stopline;
template <>
inline constexpr auto kLast<MarkingStyle> = MarkingStyle::dashed;
template <>
inline constexpr auto kLast<ObjectKind> = ObjectKind::pedestrian;
template <>
inline constexpr auto kLast<ElementStatus> = ElementStatus::inferred;
template <>
inline constexpr auto kLast<Lane::Direction> = Lane::Direction::both;
template <>
inline constexpr auto kLast<Lane::Use> = Lane::Use::cycle;
template <>
inline constexpr auto kLast<Evidence> = Evidence{31};  // every kind
template <>
inline constexpr auto kLast<Linkage::Kind> = Linkage::Kind::traffic;
template <>
inline constexpr auto kLast<Linkage::Turn> = Linkage::Turn::u_turn;
template <>
inline constexpr auto kLast<LineageEvent::Kind> = LineageEvent::Kind::retired;
template <>
inline constexpr auto kLast<LineageEvent::Element> = LineageEvent::Element::lane;
template <>
inline constexpr auto kLast<MapState> = MapState::stale;
template <>
inline constexpr auto kLast<StateReason> = StateReason::driving_side_contradicted;

/// Converts to the type of any member of an aggregate.
struct AnyMember {
  template <class Value>
  operator Value() const;  // NOLINT(google-explicit-constructor): that is its purpose
};

/// The number of members of an aggregate, published or not. By it, a table that lacks a member is an error of
/// the compiler.
template <class Struct, class... Members>
constexpr std::size_t count_members() {
  if constexpr (requires { Struct{Members{}..., AnyMember{}}; })
    return count_members<Struct, Members..., AnyMember>();
  else
    return sizeof...(Members);
}
template <HasFields Struct>
inline constexpr std::size_t kFieldCount = std::tuple_size_v<std::remove_cv_t<decltype(kFields<Struct>)>>;
template <HasFields Struct>
inline constexpr std::size_t kUnpublishedMembers = count_members<Struct>() - kFieldCount<Struct>;

static_assert(kUnpublishedMembers<Stretch> == 0);
static_assert(kUnpublishedMembers<Detection> == 0);
static_assert(kUnpublishedMembers<StyleRange> == 0);
static_assert(kUnpublishedMembers<Marking> == 0);
static_assert(kUnpublishedMembers<LineageEvent> == 0);
static_assert(kUnpublishedMembers<Neighbour> == 0);
static_assert(kUnpublishedMembers<Border> == 1, "`reversed` alone is not published");
static_assert(kUnpublishedMembers<Lane> == 0);
static_assert(kUnpublishedMembers<Stopline> == 0);
static_assert(kUnpublishedMembers<Linkage> == 0);
static_assert(kUnpublishedMembers<WayStation> == 0);
static_assert(kUnpublishedMembers<WayLane> == 0);
static_assert(
    kUnpublishedMembers<Way> == 2,
    "wish and change alone are not published: the wish is what the service was told, and there is no change");
static_assert(kUnpublishedMembers<DrivenPath> == 0);
static_assert(kUnpublishedMembers<TrackedObject> == 0);
static_assert(kUnpublishedMembers<NextTurn> == 3, "stamp_ns, sequence and session_id: they are the header's");
static_assert(kUnpublishedMembers<FusedFrame> == 0);

}  // namespace laneloom
