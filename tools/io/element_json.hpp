#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/fields.hpp"
#include "io/json_fields.hpp"
#include "laneloom/element_names.hpp"
#include "laneloom/next_turn.hpp"
#include "laneloom/objects.hpp"

/// Detections and the elements of maps as JSON, by their tables of fields.
namespace laneloom::io {

/// A value as JSON.
struct ToJson {
  template <class Number>
  requires std::is_arithmetic_v<Number>
  static nlohmann::json of(Number value) { return value; }
  template <class Enum>
  requires std::is_enum_v<Enum>
  static nlohmann::json of(Enum value) { return name(value); }
  static nlohmann::json of(Evidence evidence) { return names(evidence); }
  static nlohmann::json of(const Stretch& range) { return {range.from_m, range.to_m}; }
  static nlohmann::json of(const Point& point) { return {point.x(), point.y(), point.z()}; }
  template <class Value>
  static nlohmann::json of(const std::vector<Value>& values) {
    nlohmann::json list = nlohmann::json::array();
    for (const Value& value : values) list.push_back(of(value));
    return list;
  }
  /// One list of all values, that of the range among them: [from, to, style].
  static nlohmann::json of(const StyleRange& style_range) {
    nlohmann::json list = nlohmann::json::array();
    for_each_field<StyleRange>([&](const auto& field) {
      const nlohmann::json value = of(style_range.*field.member);
      if (value.is_array())
        list.insert(list.end(), value.begin(), value.end());
      else
        list.push_back(value);
    });
    return list;
  }
  template <HasFields Struct>
  static nlohmann::json of(const Struct& element) {
    nlohmann::json object;
    for_each_field<Struct>([&](const auto& field) {
      if (field.key != nullptr) object[field.key] = of(element.*field.member);
    });
    return object;
  }
};

/// Reads a value.
struct FromJson {
  static void read(const nlohmann::json& value, double& to) { to = number(value); }
  static void read(const nlohmann::json& value, std::int64_t& to) { to = integer(value); }
  static void read(const nlohmann::json& value, std::uint64_t& to) { to = count(value); }
  static void read(const nlohmann::json& value, std::uint32_t& to) {
    const std::uint64_t whole = count(value);
    if (whole > UINT32_MAX) throw JsonError("is too large");
    to = static_cast<std::uint32_t>(whole);
  }
  static void read(const nlohmann::json& value, MarkingType& to) { to = marking_type(value); }
  static void read(const nlohmann::json& value, MarkingStyle& to) { to = marking_style(value); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  static void read(const nlohmann::json& value, Enum& to) {
    const std::string word = text(value);
    for (std::size_t i = 0; i <= static_cast<std::size_t>(kLast<Enum>); ++i) {
      to = static_cast<Enum>(i);
      if (name(to) == word) return;
    }
    throw JsonError("'" + word + "' is not known");
  }
  /// Trackers have more classes than laneloom.
  static void read(const nlohmann::json& value, ObjectKind& to) {
    const auto* const known = std::ranges::find(kObjectKindNames, text(value));
    to = known == kObjectKindNames.end() ? ObjectKind::unknown
                                         : static_cast<ObjectKind>(known - kObjectKindNames.begin());
  }
  static void read(const nlohmann::json& value, bool& to) { to = boolean(value); }
  static void read(const nlohmann::json& value, Evidence& to) {
    to = Evidence::none;
    for (const std::string& word : list(value, text)) {
      const auto is_named = [&](Evidence kind) { return word == names(kind).front(); };
      const auto kind = std::ranges::find_if(kEvidenceKinds, is_named);
      if (kind == kEvidenceKinds.end()) throw JsonError("'" + word + "' is not known");
      to |= *kind;
    }
  }
  static void read(const nlohmann::json& value, Stretch& to) {
    if (!value.is_array() || value.size() != 2) throw JsonError("must be [from, to]");
    to = {number(value[0]), number(value[1])};
  }
  static void read(const nlohmann::json& value, Point& to) { to = point(value); }
  template <class Value>
  static void read(const nlohmann::json& value, std::vector<Value>& to) {
    to = list(value, element<Value>);
  }
  static void read(const nlohmann::json& value, StyleRange& to) {
    if (!value.is_array() || value.size() != 1 + kFieldCount<StyleRange>)
      throw JsonError("must be [from, to, style]");
    auto next = value.begin();
    for_each_field<StyleRange>([&]<class Member, class Of>(const Field<StyleRange, Member, Of>& field) {
      if constexpr (std::is_same_v<Member, Stretch>)
        to.*field.member = {number(*next++), number(*next++)};
      else
        read(*next++, to.*field.member);
    });
  }
  template <HasFields Struct>
  static void read(const nlohmann::json& object, Struct& to) {
    for_each_field<Struct>([&]<class Member, class Of>(const Field<Struct, Member, Of>& field) {
      if (field.key == nullptr) return;
      auto value = optional(object, field.key, element<Member>);
      if (!value && field.is_needed) throw JsonError(field.key, "is missing");
      if (!value) return;
      if constexpr (std::is_same_v<Member, double>) check_share(field, *value);
      to.*field.member = *std::move(value);
    });
  }
  template <class Value>
  static Value element(const nlohmann::json& value) {
    Value to{};
    read(value, to);
    return to;
  }

 private:
  static void check_share(const auto& field, double value) {
    const bool is_unknown = field.may_be_unknown && value == -1.0;
    if (!field.is_share || is_unknown || (value >= 0.0 && value <= 1.0)) return;
    throw JsonError(field.key, std::string("must be from 0 to 1") + (field.may_be_unknown ? ", or -1" : ""));
  }
};

}  // namespace laneloom::io
