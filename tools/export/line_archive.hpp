#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "export/archived_line.hpp"
#include "export/driven_places.hpp"
#include "export/line_tiles.hpp"
#include "export/stopline_archive.hpp"
#include "laneloom/types.hpp"

namespace laneloom::exports {

/// A stretch of road that the drives past it do not agree on.
struct Change {
  bool gone = false;  ///< or new
  MarkingType type = MarkingType::laneline;
  Polyline points;  ///< map frame
  std::size_t drive =
      0;  ///< counted from 0: the last one that saw what is gone, or the first one that saw what is new
};

/// Joins pieces of lines that were seen at different times, by geometry. A piece that lies along a line of
/// its type, at most kSameLine_m beside it and on its level, is the same line, unless one map has both side
/// by side. Where both lie, the place is their mean, weighed by their deviations. Where the piece reaches
/// beyond the line's end, the line grows. A piece that lies along no line is a new line. No piece is moved as
/// a whole, so that pieces which disagree by more give a line twice. Not thread-safe.
class LineArchive {
 public:
  /// Adds a piece of the current drive.
  void add(const ArchivedPiece& piece);
  /// Ends the current drive, which went along `poses` (T_map_body): what it passed and did not see is
  /// believed less.
  void end_drive(const std::vector<Eigen::Isometry3d>& poses);

  bool empty() const { return lines_.empty() && stoplines_.entries().empty(); }
  /// The place of a line that is nearest to a point.
  struct Place {
    Point foot = Point::Zero();
    Eigen::Vector2d along = Eigen::Vector2d::Zero();  ///< unit direction of the line, either way
    double stddev_m = 0.0;
  };
  /// The nearest place of a line of a type that runs along `along` (unit, either way), at most `within_m`
  /// (up to LineTiles::kReach_m) away, on its level.
  std::optional<Place> nearest(MarkingType type, const Point& point, const Eigen::Vector2d& along,
                               double within_m) const;

  /// The markings, with ids from 1 on: first the lines of 2 m or more that are no longer in doubt, in the
  /// order in which they were first seen, and then the stoplines. What most of the drives past it did not see
  /// is left out, and so is what lies along a longer line, unless most maps had both.
  std::vector<Marking> markings() const;
  /// Stretches of 10 m or more, and stoplines, that three drives or more saw and the last ones did not, or
  /// that three or more did not see and the last ones did. Another line of the type beside it hides a change.
  std::vector<Change> changes() const;

 private:
  /// A vertex of a piece on a line.
  struct Match {
    std::size_t line = 0;
    double arc_m = 0.0;
  };
  using Vertices = std::vector<ArchivedVertex>;

  static constexpr std::size_t kNoLine = static_cast<std::size_t>(-1);
  void add_to_tiles(std::size_t line, const Vertices& vertices);
  std::size_t lines_at(const ArchivedVertex& vertex, const ArchivedLine& of, double longer_than_m) const;
  bool is_covered(const ArchivedVertex& vertex, const ArchivedLine& of) const;
  std::vector<bool> kept_vertices(const ArchivedLine& line) const;
  std::vector<Match> match(const ArchivedPiece& piece, const Vertices& vertices) const;
  void fuse(const Vertices& piece, std::size_t line);
  static void credit(const ArchivedPiece& piece, ArchivedLine& line);
  void add_unmatched(const ArchivedPiece& piece, const Vertices& vertices, const std::vector<Match>& matches);
  bool extend(const Match& beside, const Vertices& beyond);

  std::vector<ArchivedLine> lines_;
  LineTiles tiles_;
  StoplineArchive stoplines_;
  DrivenPlaces places_;
  std::size_t drive_ = 0;
};

}  // namespace laneloom::exports
