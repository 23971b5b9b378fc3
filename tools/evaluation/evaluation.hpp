#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/types.hpp"

/// The quality of a map (paper, Sec. IV-B "Map Quality Metrics").
///
/// Per frame, truth and predictions are clipped to the map's range box in the body frame and sampled every
/// 0.1 m. A predicted sample matches a truth line of its kind if the nearest sample of that line is less than
/// 0.5 m away. A prediction is a true positive if more of its samples match than 75 % of the truth line's
/// samples. Precision, recall and F1 come from the counts over all frames; the ACD is the mean, over the true
/// positives, of the mean distance of their matched samples.
///
/// The paper leaves these open. Here they are:
/// - Clipping: a line that leaves the box and comes back is several lines, in truth and prediction alike.
/// - Minimum length: what is shorter than 1 m after clipping is left out, in truth and prediction alike.
/// - Height: the box reaches 3 m up and down from the body's plane; matching distances are horizontal.
/// - Assignment: pairs are taken by descending number of matched samples, then by ascending mean distance,
///   then in the order given; a truth line and a prediction are each used once.
/// - Overlong lines: what a prediction has beyond the truth line costs nothing, as the paper has it.
namespace laneloom::evaluation {

/// A sample matches a line that has one closer than this.
inline constexpr double kMatchDistance_m = 0.5;
/// A line is found if more than this share of its samples match.
inline constexpr double kMatchShare = 0.75;

enum class LineKind : std::uint8_t { laneline, roadedge, stopline, lane };
inline constexpr std::size_t kLineKindCount = 4;
constexpr std::size_t index(LineKind kind) { return static_cast<std::size_t>(kind); }
constexpr LineKind line_kind(MarkingType type) { return static_cast<LineKind>(type); }
const char* name(LineKind kind);

/// A marking, or the centerline of a lane.
struct KindLine {
  LineKind kind = LineKind::laneline;
  Polyline points = {};                       ///< map frame
  ElementId id = kNoElement;                  ///< kNoElement: no identity from frame to frame
  double confidence = -1.0;                   ///< 0..1, that it exists; -1: not given
  std::vector<StyleRange> styles = {};        ///< along the points; empty: unknown
  std::vector<double> lateral_stddev_m = {};  ///< per point; empty: not given
};

/// A piece of a line within the range.
struct LinePiece {
  std::size_t line = 0;  ///< index among the lines that were compared
  Polyline points;       ///< body frame
  Polyline samples;      ///< the same every 0.1 m
};

/// The pieces of `points` (map frame) within the range that are long enough to count.
std::vector<LinePiece> pieces_in_range(const Polyline& points, std::size_t line,
                                       const Eigen::Isometry3d& T_body_map, const RangeConfig& range);

/// The longest of these pieces. Empty: there is none.
std::optional<LinePiece> longest_piece_in_range(const Polyline& points, std::size_t line,
                                                const Eigen::Isometry3d& T_body_map,
                                                const RangeConfig& range);

/// A prediction and the truth that it matches.
struct TruePositive {
  std::size_t truth = 0;       ///< index of its piece
  std::size_t prediction = 0;  ///< likewise
  double chamfer_m = 0.0;      ///< mean distance of the matched samples
};

/// The pieces of one kind of line that are in range, and their matches.
struct KindComparison {
  std::vector<LinePiece> truths, predictions;
  std::vector<TruePositive> matches;
};

/// The comparison of one frame: which predictions are true positives of which truth lines.
struct FrameComparison {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_map_body = Eigen::Isometry3d::Identity();
  std::array<KindComparison, kLineKindCount> by_kind;

  const KindComparison& of(LineKind kind) const { return by_kind[index(kind)]; }
};

/// Counts of one kind of line, summed over frames.
struct Score {
  std::uint64_t truths = 0;
  std::uint64_t predictions = 0;
  std::uint64_t matches = 0;         ///< true positives
  double chamfer_distances_m = 0.0;  ///< summed over the matches

  double precision() const;  ///< 0..1; 0 where nothing was predicted
  double recall() const;     ///< 0..1; 0 where there was nothing to find
  double f1() const;
  double acd_m() const;  ///< 0 where nothing matched
  Score& operator+=(const Score& other);
};

/// The scores of all kinds of lines over a number of frames.
struct MapScore {
  std::size_t frames = 0;
  std::array<Score, kLineKindCount> by_kind;

  const Score& of(LineKind kind) const { return by_kind[index(kind)]; }
  Score markings() const;  ///< all but the lanes: the paper's "total"
};

/// The stretches of the body-frame line `line` within the range box (without its margins) that are long
/// enough to count.
std::vector<Polyline> clip(const Polyline& line, const RangeConfig& range);

/// Whether a point of the body frame is within the range box.
bool in_range(const Point& point_body, const RangeConfig& range);

/// Compares truth and predictions, seen from T_map_body.
FrameComparison compare(const std::vector<KindLine>& truth, const std::vector<KindLine>& predictions,
                        const Eigen::Isometry3d& T_map_body, const RangeConfig& range);

void add(const FrameComparison& frame, MapScore& score);

/// The outcome of one truth line in one frame, told by its longest piece within the range.
struct TruthOutcome {
  std::size_t truth = 0;                  ///< index of the line
  const LinePiece* prediction = nullptr;  ///< its true positive; null: it was not found
};

/// The outcomes of the truth lines in range, by ascending index. They point into `comparison`.
std::vector<TruthOutcome> truth_outcomes(const KindComparison& comparison);

}  // namespace laneloom::evaluation
