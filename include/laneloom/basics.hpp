#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/// Points, lines and words of which the plain data of laneloom are made (types.hpp).
namespace laneloom {

/// A place, in metres. Its frame is said where the point is used.
using Point = Eigen::Vector3d;
/// Points in the order in which they are joined.
using Polyline = std::vector<Point>;

/// Identifies an element of the map. No other element gets the same id in a session; an element that was lost
/// for a moment may come back by its id. 0 is no element.
using ElementId = std::uint64_t;
inline constexpr ElementId kNoElement = 0;

/// The side of something that has a direction, such as a lane or a line.
enum class Side : std::uint8_t { left, right };
inline constexpr std::array kSides{Side::left, Side::right};
/// The other side.
constexpr Side opposite(Side side) { return side == Side::left ? Side::right : Side::left; }
/// The side as something sees it that runs the other way, if `reversed`.
constexpr Side as_seen(Side side, bool reversed) { return reversed ? opposite(side) : side; }

/// The end of a polyline: `front` at its first point, `back` at its last one.
enum class End : std::uint8_t { front, back };
inline constexpr std::array kEnds{End::front, End::back};
/// The other end.
constexpr End opposite(End end) { return end == End::front ? End::back : End::front; }

/// A laneline bounds a lane, a roadedge bounds the road, and traffic waits at a stopline.
enum class MarkingType : std::uint8_t { laneline, roadedge, stopline };
inline constexpr std::size_t kMarkingTypeCount = 3;
inline constexpr std::array<MarkingType, kMarkingTypeCount> kMarkingTypes{
    MarkingType::laneline, MarkingType::roadedge, MarkingType::stopline};

/// The paint of a line. Unknown: no detection told it.
enum class MarkingStyle : std::uint8_t { unknown, solid, dashed };
inline constexpr std::size_t kMarkingStyleCount = 3;

/// The place of an enumerator in an array that has one entry for each.
///@{
constexpr std::size_t index(MarkingType type) { return static_cast<std::size_t>(type); }
constexpr std::size_t index(MarkingStyle style) { return static_cast<std::size_t>(style); }
constexpr std::size_t index(Side side) { return static_cast<std::size_t>(side); }
constexpr std::size_t index(End end) { return static_cast<std::size_t>(end); }
///@}

/// A stretch of a polyline, by arc length from its first point.
struct Stretch {
  double from_m = 0.0;                             ///< arc length of its beginning
  double to_m = 0.0;                               ///< arc length of its end
  double length() const { return to_m - from_m; }  ///< metres
};

}  // namespace laneloom
