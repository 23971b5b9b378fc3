#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "evaluation/evaluation.hpp"

/// The places and times at which a map is right, sample by sample.
///
/// The samples are those of evaluation.hpp: every 0.1 m of the lines in range, of all markings. A truth
/// sample is found where a prediction of its kind has a sample less than 0.5 m away, and a predicted sample
/// is right where a truth line of its kind has one; no line need be a true positive for that. The lateral
/// error of a right sample is its horizontal distance from the nearest such truth line. Its distance is the
/// forward coordinate in the body frame.
namespace laneloom::evaluation {

/// Numbers of samples of truth and map, summed over frames.
struct SampleScore {
  std::size_t truths = 0;
  std::size_t found = 0;
  std::size_t predictions = 0;
  std::size_t right = 0;
  double lateral_errors_m = 0.0;  ///< summed over the right samples

  double recall() const;           ///< 0..1; 0 where there was nothing to find
  double precision() const;        ///< 0..1; 0 where nothing was predicted
  double lateral_error_m() const;  ///< mean; 0 where nothing is right
};

/// Lateral errors (0 to the matching distance), rounded to millimetres and counted, so that memory does not
/// grow.
class LateralErrors {
 public:
  void add(double error_m);
  std::size_t count() const { return count_; }
  /// The smallest value in metres that at least the `share` (0..1) of all errors do not exceed; 0 without
  /// errors.
  double quantile(double share) const;

 private:
  static constexpr std::size_t kMillimetres = 501;
  std::array<std::size_t, kMillimetres> by_millimetre_{};
  std::size_t count_ = 0;
};

inline constexpr double kRangeBin_m = 5.0;
inline constexpr std::size_t kErrorBands = 3;
inline constexpr double kErrorBand_m = 10.0;  ///< 0..10, 10..20, 20..30 m ahead

/// Not thread-safe.
class ProfileMeter {
 public:
  /// Frames are compared within `range`.
  explicit ProfileMeter(const RangeConfig& range);
  void add(const FrameComparison& frame);

  struct Moment {
    std::int64_t stamp_ns = 0;
    SampleScore score;
  };
  /// All markings, frame by frame.
  const std::vector<Moment>& over_time() const { return over_time_; }
  /// All markings, by bin: bin n is from n to n + 1 times kRangeBin_m ahead. The range's far end belongs to
  /// its last bin.
  const std::map<int, SampleScore>& over_range() const { return over_range_; }
  /// The errors of a marking type, in each band of distance.
  const std::array<LateralErrors, kErrorBands>& errors(MarkingType type) const {
    return errors_[index(type)];
  }

 private:
  void add_truths(const KindComparison& comparison, SampleScore& moment);
  void add_predictions(const KindComparison& comparison, MarkingType type, SampleScore& moment);

  int range_bin(const Point& sample) const;

  int last_bin_;
  std::vector<Moment> over_time_;
  std::map<int, SampleScore> over_range_;
  std::array<std::array<LateralErrors, kErrorBands>, kMarkingTypeCount> errors_;
};

}  // namespace laneloom::evaluation
