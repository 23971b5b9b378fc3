#include "cdr/layout.hpp"

#include <type_traits>
#include <vector>

#include "base/fields.hpp"

namespace laneloom::dds {
namespace {

constexpr std::size_t kEnum = 4;
constexpr std::size_t kLong = 4;
constexpr std::size_t kLongLong = 8;
constexpr std::size_t kDouble = 8;
constexpr std::size_t kTextBound = std::remove_cvref_t<decltype(msg::Header().frame_id())>::max_size;
constexpr std::size_t kValueBound = std::remove_cvref_t<decltype(msg::Setting().value())>::max_size;

void header(CdrScanner& cdr) {
  cdr.numbers(kLongLong);
  cdr.numbers(kLong);
  cdr.numbers(kLongLong, 3);
  cdr.text(kTextBound);
}

void polyline(CdrScanner& cdr) { cdr.double_sequence(3, msg::MAX_POINTS); }
void point_values(CdrScanner& cdr) { cdr.double_sequence(1, msg::MAX_POINTS); }
void pose(CdrScanner& cdr) { cdr.numbers(kDouble, 7); }

void detection(CdrScanner& cdr) {
  cdr.numbers(kEnum, 2);
  cdr.numbers(kDouble);
  polyline(cdr);
  point_values(cdr);
}

void marking(CdrScanner& cdr) {
  cdr.numbers(kLongLong);
  cdr.numbers(kEnum, 2);
  polyline(cdr);
  cdr.sequence(msg::MAX_STYLES, [](CdrScanner& style_range) {
    style_range.numbers(kDouble, 2);
    style_range.numbers(kEnum);
  });
  point_values(cdr);
  cdr.numbers(kDouble);
  cdr.numbers(kLongLong);
  cdr.numbers(kDouble, 2);
}

/// The layout in CDR of a member of this type.
template <class Value>
struct Layout {
  static void scan(CdrScanner& cdr) {
    if constexpr (HasFields<Value>)
      for_each_field<Value>([&]<class Struct, class Member, class Of>(const Field<Struct, Member, Of>&) {
        Layout<Member>::scan(cdr);
      });
    else
      cdr.numbers(std::is_enum_v<Value> ? kEnum : sizeof(Value));
  }
};
template <>
struct Layout<Stretch> {
  static void scan(CdrScanner& cdr) { cdr.numbers(kDouble, 2); }
};
template <>
struct Layout<Polyline> {
  static void scan(CdrScanner& cdr) { polyline(cdr); }
};
template <>
struct Layout<std::vector<Stretch>> {
  static void scan(CdrScanner& cdr) { cdr.double_sequence(2, msg::MAX_RANGES); }
};
template <>
struct Layout<std::vector<Neighbour>> {
  static void scan(CdrScanner& cdr) { cdr.sequence(msg::MAX_NEIGHBOURS, Layout<Neighbour>::scan); }
};

void stopline(CdrScanner& cdr) {
  marking(cdr);
  cdr.number_sequence(kLongLong, msg::MAX_STOPLINE_LANES);
  cdr.numbers(kDouble, 3);
}

void lineage_event(CdrScanner& cdr) {
  cdr.numbers(kEnum);
  cdr.numbers(kLongLong, 2);
}

void counter(CdrScanner& cdr) {
  cdr.text(kTextBound);
  cdr.numbers(kLongLong);
}

void source(CdrScanner& cdr) {
  cdr.text(kTextBound);
  cdr.numbers(kLongLong, 5);
  cdr.numbers(kDouble);
  cdr.sequence(msg::MAX_VALUES, [](CdrScanner& value) {
    value.text(kTextBound);
    value.numbers(kDouble);
  });
}

void setting(CdrScanner& cdr) {
  cdr.text(kTextBound);
  cdr.text(kValueBound);
}

}  // namespace

void scan(CdrScanner& cdr, const msg::Detections* /*type*/) {
  header(cdr);
  cdr.text(kTextBound);
  cdr.number_sequence(kEnum, msg::MAX_TYPES);
  polyline(cdr);
  cdr.sequence(msg::MAX_AREAS, polyline);
  cdr.sequence(msg::MAX_MARKINGS, detection);
}

void scan(CdrScanner& cdr, const msg::VehiclePose* /*type*/) {
  header(cdr);
  pose(cdr);
  cdr.number_sequence(kDouble, 36);
}

void scan(CdrScanner& cdr, const msg::LaneMap* /*type*/) {
  header(cdr);
  cdr.numbers(kLongLong, 2);
  cdr.numbers(kDouble, 2);
  cdr.numbers(kEnum);
  cdr.number_sequence(kEnum, msg::MAX_REASONS);
  pose(cdr);
  cdr.sequence(msg::MAX_FRAMES, [](CdrScanner& frame) {
    frame.text(kTextBound);
    frame.numbers(kLongLong, 3);
  });
  cdr.sequence(msg::MAX_MARKINGS, marking);
  cdr.sequence(msg::MAX_LANES, Layout<Lane>::scan);
  cdr.sequence(msg::MAX_MARKINGS, stopline);
  cdr.sequence(msg::MAX_LINKAGES, Layout<Linkage>::scan);
  cdr.sequence(msg::MAX_LINKAGES, lineage_event);
}

void scan(CdrScanner& cdr, const msg::RoadMarkings* /*type*/) {
  header(cdr);
  cdr.sequence(msg::MAX_MARKINGS, marking);
}

void scan(CdrScanner& cdr, const msg::ServiceStatus* /*type*/) {
  header(cdr);
  cdr.numbers(kEnum);
  cdr.number_sequence(kEnum, msg::MAX_REASONS);
  cdr.numbers(kDouble, 11);
  cdr.numbers(kLong);
  cdr.sequence(msg::MAX_COUNTERS, counter);
  cdr.sequence(msg::MAX_SOURCES, source);
  cdr.text(kTextBound);
  cdr.text(kTextBound);
  cdr.sequence(msg::MAX_SETTINGS, setting);
}

}  // namespace laneloom::dds
