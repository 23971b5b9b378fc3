#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <utility>
#include <vector>

#include "export/stopline_archive.hpp"
#include "laneloom/polyline.hpp"
#include "laneloom/types.hpp"
#include "mapping/markings/markings.hpp"

namespace laneloom::exports {

/// A stretch of a line of a map.
struct ArchivedPiece {
  Marking marking;                ///< map frame, with two points or more
  std::uint64_t pass = 0;         ///< the pass within which ids are valid
  std::vector<ElementId> beside;  ///< other lines of its type that the same map has within kSameLine_m of it
};

/// Pieces of lines that are nearer to one another are one line, unless a map shows both.
inline constexpr double kSameLine_m = 1.0;

/// Joins pieces of lines that were seen at different times, by geometry. A piece that lies along a line of
/// its type, at most kSameLine_m beside it and on its level, is the same line, unless one map has both side
/// by side. Where both lie, the place is their mean, weighed by their deviations. Where the piece reaches
/// beyond the line's end, the line grows. A piece that lies along no line is a new line. No piece is moved as
/// a whole, so that poses which disagree by more give a line twice. Not thread-safe.
class LineArchive {
 public:
  void add(const ArchivedPiece& piece);

  /// The markings, with ids from 1 on: first the lines of 2 m or more that are no longer in doubt and no
  /// shadows of others, in the order in which they were first seen, and then the stoplines.
  std::vector<Marking> markings() const;

 private:
  using Source = std::pair<std::uint64_t, ElementId>;  ///< pass and id of a line of a map
  /// The knowledge of one place on a line.
  struct Vertex {
    Source source;  ///< the last line that had it
    Point position = Point::Zero();
    double weight = 0.0;  ///< 1 / m^2, of the position
    double stddev_m = 0.0;
    double existence = -1.0;
    bool confirmed = false;
    int as_double = 0;  ///< maps that had another line beside it minus maps that had none
    markings::StyleVotes styles{};
  };
  struct Line {
    MarkingType type = MarkingType::laneline;
    std::vector<Vertex> vertices;
    MeasuredPolyline course;
    Eigen::AlignedBox2d box;
    std::uint64_t observations = 0;
    std::int64_t first_seen_ns = 0, last_seen_ns = 0;
  };
  /// A vertex of a piece on a line.
  struct Match {
    std::size_t line = 0;
    double arc_m = 0.0;
  };
  using Vertices = std::vector<Vertex>;

  static constexpr std::size_t kNoLine = static_cast<std::size_t>(-1);
  static Vertices vertices_of(const ArchivedPiece& archived);
  static void measure(Line& line);
  std::vector<std::size_t> shadows() const;
  static Marking marking_of(const Line& line);
  std::vector<Match> match(const ArchivedPiece& piece, const Vertices& vertices) const;
  static void fuse(const Vertices& piece, Line& line);
  static void credit(const ArchivedPiece& piece, Line& line);
  void add_unmatched(const ArchivedPiece& piece, const Vertices& vertices, const std::vector<Match>& matches);
  bool extend(const Match& beside, const Vertices& beyond);

  std::vector<Line> lines_;
  StoplineArchive stoplines_;
};

}  // namespace laneloom::exports
