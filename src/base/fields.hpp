#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "laneloom/types.hpp"

/// The members of map elements, each named once, in the order of the IDL. Conversion to and from messages,
/// the check of a message's bytes and bounds, JSON and the bytes of a mapper's state follow from these
/// tables.
namespace laneloom {

/// One member that is published. `OfMessage` gives the member of the same name of the IDL's type.
template <class Struct, class Value, class OfMessage>
struct Field {
  constexpr Field(const char* its_name, Value Struct::*its_member, OfMessage its_of_message)
      : name(its_name), key(its_name), member(its_member), of_message(its_of_message) {}
  /// Sets the key in JSON, if it differs from the name.
  constexpr Field as(const char* json_key) const {
    Field field = *this;
    field.key = json_key;
    return field;
  }
  /// An element that is read from JSON must have this member.
  constexpr Field needed() const {
    Field field = *this;
    field.is_needed = true;
    return field;
  }

  const char* name;  ///< of the member of the struct
  const char* key;   ///< in JSON
  Value Struct::*member;
  OfMessage of_message;    ///< returns the message's member
  bool is_needed = false;  ///< in JSON
};

#define LANELOOM_FIELD_AS(Struct, member, name) \
  Field(#name, &Struct::member, [](auto& message) -> decltype(auto) { return (message.name()); })
#define LANELOOM_FIELD(Struct, name) LANELOOM_FIELD_AS(Struct, name, name)

template <class Struct>
inline constexpr std::nullptr_t kFields = nullptr;

template <>
inline constexpr auto kFields<Neighbour> = std::tuple(LANELOOM_FIELD(Neighbour, lane).needed(),
                                                      LANELOOM_FIELD(Neighbour, range).needed(),
                                                      LANELOOM_FIELD(Neighbour, crossable).needed());

template <>
inline constexpr auto kFields<Lane> = std::tuple(
    LANELOOM_FIELD(Lane, id).needed(), LANELOOM_FIELD(Lane, left_boundary),
    LANELOOM_FIELD(Lane, right_boundary), LANELOOM_FIELD(Lane, left_range), LANELOOM_FIELD(Lane, right_range),
    LANELOOM_FIELD(Lane, left).needed(), LANELOOM_FIELD(Lane, right).needed(),
    LANELOOM_FIELD(Lane, centerline).needed(), LANELOOM_FIELD(Lane, width_m).as("width"),
    LANELOOM_FIELD(Lane, left_neighbours), LANELOOM_FIELD(Lane, right_neighbours),
    LANELOOM_FIELD(Lane, direction), LANELOOM_FIELD(Lane, section), LANELOOM_FIELD(Lane, status),
    LANELOOM_FIELD(Lane, existence_probability).as("existence"), LANELOOM_FIELD(Lane, inferred_ranges));

template <>
inline constexpr auto kFields<Linkage> = std::tuple(
    LANELOOM_FIELD_AS(Linkage, from, from_lane).as("from").needed(),
    LANELOOM_FIELD_AS(Linkage, to, to_lane).as("to").needed(), LANELOOM_FIELD(Linkage, kind),
    LANELOOM_FIELD(Linkage, turn), LANELOOM_FIELD(Linkage, confidence), LANELOOM_FIELD(Linkage, path));

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
inline constexpr auto kLast<ElementStatus> = ElementStatus::inferred;
template <>
inline constexpr auto kLast<Lane::Direction> = Lane::Direction::against_centerline;
template <>
inline constexpr auto kLast<Linkage::Kind> = Linkage::Kind::ego_track;
template <>
inline constexpr auto kLast<Linkage::Turn> = Linkage::Turn::u_turn;

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
inline constexpr std::size_t kUnpublishedMembers =
    count_members<Struct>() - std::tuple_size_v<std::remove_cv_t<decltype(kFields<Struct>)>>;

static_assert(kUnpublishedMembers<Neighbour> == 0);
static_assert(kUnpublishedMembers<Lane> == 2, "the reversed flags alone are not published");
static_assert(kUnpublishedMembers<Linkage> == 0);

}  // namespace laneloom
