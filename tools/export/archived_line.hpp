#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <utility>
#include <vector>

#include "export/votes.hpp"
#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::exports {

/// A stretch of a line of a map.
struct ArchivedPiece {
  Marking marking;                ///< two points or more
  std::uint64_t pass = 0;         ///< the pass within which ids are valid
  std::vector<ElementId> beside;  ///< other lines of its type that the same map has within kSameLine_m of it
  std::size_t pose = 0;           ///< index of the drive's pose at which the piece left the map
};

/// Pieces of lines that are nearer to one another are one line, unless a map shows both.
inline constexpr double kSameLine_m = 1.0;
inline constexpr double kUnknownStddev_m = 0.3;  ///< lateral, of a line that has no deviations

/// The knowledge of one place on a line.
struct ArchivedVertex {
  using Source = std::pair<std::uint64_t, ElementId>;  ///< pass and id of a line of a map
  Source source;                                       ///< the last line that had it
  Point position = Point::Zero();
  double weight = 0.0;  ///< 1 / m^2, of the position
  double stddev_m = 0.0;
  double existence = -1.0;
  bool confirmed = false;
  std::size_t maps = 1, beside = 0;  ///< maps that had it, and the lines that they had beside it, in all
  markings::StyleVotes styles{};
  Votes votes;
};

/// The vertices of a piece, every metre.
std::vector<ArchivedVertex> vertices_of(const ArchivedPiece& piece);

/// A line of several pieces.
struct ArchivedLine {
  MarkingType type = MarkingType::laneline;
  std::vector<ArchivedVertex> vertices;
  MeasuredPolyline course;  ///< through the vertices
  Eigen::AlignedBox2d box;  ///< around the vertices, kSameLine_m larger
  std::uint64_t observations = 0;
  std::int64_t first_seen_ns = 0, last_seen_ns = 0;

  /// Brings course and box up to date with the vertices, of which there are one or more.
  void measure();
  /// The stretches of 2 m or more of the vertices that are kept, as markings without ids.
  std::vector<Marking> markings(const std::vector<bool>& kept) const;
};

}  // namespace laneloom::exports
