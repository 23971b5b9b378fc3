#include "mapping/lanes/unmarked_roads.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "laneloom/polyline.hpp"

namespace laneloom::lanes {
namespace {

constexpr double kReach_m = 6.0;  // beyond a run, where the divider may continue a line
constexpr double kReachStep_m = 2.0;
constexpr double kFlare_m = 0.3;  // a road that is this much wider than usual opens into an intersection
constexpr double kBeyondEdge_m =
    boundaries::kAlongEdge_m + 1.2;  // in the middle of a lane, beside a line along the edge

/// The share of the width at which a line lies beyond the last cross-section of a run. Empty: there is none.
std::optional<double> line_beyond(const CrossSection& last, const CrossSection& before,
                                  const boundaries::BoundaryPair& pair,
                                  const boundaries::Boundaries& boundaries) {
  const Point onwards = (last.middle() - before.middle()).normalized();
  for (double ahead_m = kReachStep_m; ahead_m <= kReach_m; ahead_m += kReachStep_m) {
    CrossSection section = last;
    section.left += ahead_m * onwards;
    section.right += ahead_m * onwards;
    const auto between = find_between(section, pair, boundaries);
    if (between) return between->is_edge ? std::nullopt : std::optional(between->share);
  }
  return std::nullopt;
}

/// A run without its flared ends, where edges turn off round the corners of an intersection.
std::span<const CrossSection> without_flares(std::span<const CrossSection> run) {
  std::vector<double> widths_m;
  for (const CrossSection& section : run) widths_m.push_back(section.width_m);
  const auto middle = widths_m.begin() + static_cast<std::ptrdiff_t>(widths_m.size() / 2);
  std::ranges::nth_element(widths_m, middle);
  const double usual_m = *middle;
  while (run.front().width_m > usual_m + kFlare_m) run = run.subspan(1);
  while (run.back().width_m > usual_m + kFlare_m) run = run.first(run.size() - 1);
  return run;
}

/// The greatest widths of the lanes on the left and on the right of a divider.
struct MaxWidths {
  double left_m, right_m;
};

/// The two halves of a run, divided at a share of its width that changes evenly.
struct Halves {
  std::vector<CrossSection> left, right;
  Polyline divider;
};

/// Divides a run. Empty: a lane would be too narrow or too wide.
std::optional<Halves> divide(std::span<const CrossSection> run, double share_at_begin, double share_at_end,
                             double min_width_m, const MaxWidths& max_width) {
  Halves halves;
  for (std::size_t i = 0; i < run.size(); ++i) {
    const double along = static_cast<double>(i) / static_cast<double>(run.size() - 1);
    const double share = share_at_begin + along * (share_at_end - share_at_begin);
    CrossSection left = run[i], right = run[i];
    left.right = right.left = run[i].left + share * (run[i].right - run[i].left);
    left.width_m *= share;
    right.width_m *= 1.0 - share;
    if (std::min(left.width_m, right.width_m) < min_width_m) return std::nullopt;
    if (left.width_m > max_width.left_m || right.width_m > max_width.right_m) return std::nullopt;
    halves.divider.push_back(left.right);
    halves.left.push_back(left);
    halves.right.push_back(right);
  }
  return halves;
}

/// Divides the roads between one pair of boundaries after the other.
class Divisions {
 public:
  Divisions(const boundaries::Boundaries& boundaries, const LaneConfig& config, TakenSpace& taken)
      : boundaries_(boundaries), config_(config), lanes_(taken), taken_(taken) {}

  void add(const boundaries::BoundaryPair& pair) {
    if ((!pair.left_kerb && !pair.right_kerb) || pair.crosses_kerb) return;
    if (boundaries_[pair.left].is_tentative() || boundaries_[pair.right].is_tentative()) return;
    Occupied& left_taken = taken_.beside({boundaries_[pair.left].marking.id, pair.inner(Side::left)});
    Occupied& right_taken = taken_.beside({boundaries_[pair.right].marking.id, pair.inner(Side::right)});
    const LaneBorder left(boundaries_[pair.left], pair.left_reversed, left_taken);
    const LaneBorder right(boundaries_[pair.right], pair.right_reversed, right_taken);
    const std::vector<CrossSection> sections = unmarked(pair, left, right);
    const double max_variation_m = 2.0 * config_.max_width_variation_m;  // of both lanes
    for (std::size_t begin = 0; begin < sections.size();) {
      auto run = next_run(sections, begin, max_variation_m);
      if (length_of(run) < kMinInferredLength_m) continue;
      run = without_flares(run);
      if (length_of(run) < kMinInferredLength_m) continue;
      auto halves = divide(run, pair);
      if (!halves) continue;
      left_taken.push_back(left.own({run.front().left_arc_m, run.back().left_arc_m}));
      right_taken.push_back(right.own({run.front().right_arc_m, run.back().right_arc_m}));
      taken_.add(halves->divider, config_.min_width_m);
      found_.push_back({.marking = inferred_marking(halves->divider),
                        .on_left = {{pair.left, pair.left_reversed, std::move(halves->left)}},
                        .on_right = {{pair.right, pair.right_reversed, std::move(halves->right)}},
                        .two_way = pair.left_kerb && pair.right_kerb,
                        .section = pair.section});
    }
  }

  std::vector<InferredBoundary> take() { return std::move(found_); }

 private:
  /// Cross-sections of a pair. They are valid where no edge, confirmed line or lane lies in them and they are
  /// not a verge.
  std::vector<CrossSection> unmarked(const boundaries::BoundaryPair& pair, const LaneBorder& left,
                                     const LaneBorder& right) const {
    const bool two_kerbs = pair.left_kerb && pair.right_kerb;
    const double max_width_m = 2.0 * (two_kerbs ? config_.max_kerb_width_m : config_.max_width_m);
    auto sections = cross_sections(left, right, {config_.min_divided_width_m, max_width_m}, config_);
    for (CrossSection& section : sections) {
      section.valid = section.valid && !find_between(section, pair, boundaries_) &&
                      !taken_.contains(section.middle()) && !(two_kerbs && is_beside_lanes(section));
    }
    return sections;
  }

  /// Whether lanes lie beyond a border: then the section is a verge, a pavement or a cycle track.
  bool is_beside_lanes(const CrossSection& section) const {
    const Point out = kBeyondEdge_m * (section.right - section.left).normalized();
    return lanes_.contains(section.left - out) || lanes_.contains(section.right + out);
  }

  /// Divides a run at the lines that the divider continues, or in the middle.
  std::optional<Halves> divide(std::span<const CrossSection> run,
                               const boundaries::BoundaryPair& pair) const {
    const auto before = line_beyond(run.front(), run[1], pair, boundaries_);
    const auto after = line_beyond(run.back(), run[run.size() - 2], pair, boundaries_);
    const double at_begin = before ? *before : after.value_or(0.5);
    const auto max_width_m = [&](bool kerb) { return kerb ? config_.max_kerb_width_m : config_.max_width_m; };
    return lanes::divide(run, at_begin, after.value_or(at_begin), config_.min_width_m,
                         {max_width_m(pair.left_kerb), max_width_m(pair.right_kerb)});
  }

  const boundaries::Boundaries& boundaries_;
  const LaneConfig& config_;
  const TakenSpace lanes_;  ///< the lanes between detected boundaries
  TakenSpace& taken_;
  std::vector<InferredBoundary> found_;
};

}  // namespace

std::vector<InferredBoundary> divide_unmarked(const std::vector<boundaries::BoundaryPair>& pairs,
                                              const boundaries::Boundaries& boundaries,
                                              const LaneConfig& config, TakenSpace& taken) {
  if (!config.unmarked_roads) return {};
  Divisions divisions(boundaries, config, taken);
  for (const boundaries::BoundaryPair& pair : pairs) divisions.add(pair);
  return divisions.take();
}

}  // namespace laneloom::lanes
