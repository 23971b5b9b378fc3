#include "mapping/markings/pair_history.hpp"

#include <algorithm>
#include <utility>

namespace laneloom {
namespace {

constexpr double kMemory = 0.97;       // of the counts, per frame
constexpr double kMinFrames = 4.0;     // before a pair is judged
constexpr double kMinTogether = 1.9;   // frames: two, one after the other
constexpr double kMaxTogether = 0.25;  // share of the frames

std::pair<ElementId, ElementId> key_of(const PairHistory& history) { return {history.a, history.b}; }

}  // namespace

void sort(PairHistories& histories) { std::ranges::sort(histories, {}, key_of); }

const PairHistory* find(const PairHistories& histories, ElementId a, ElementId b) {
  const std::pair<ElementId, ElementId> key = std::minmax(a, b);
  const auto found = std::ranges::lower_bound(histories, key, {}, key_of);
  return found == histories.end() || key_of(*found) != key ? nullptr : &*found;
}

PairHistory continued(const PairHistories& histories, ElementId a, ElementId b, bool together, bool apart) {
  const PairHistory* known = find(histories, a, b);
  PairHistory history = known != nullptr ? *known : PairHistory{std::min(a, b), std::max(a, b)};
  history.together = kMemory * history.together + (together ? 1.0 : 0.0);
  history.apart = kMemory * history.apart + (apart ? 1.0 : 0.0);
  return history;
}

bool seen_apart(const PairHistory& history) {
  const double frames = history.together + history.apart;
  return frames >= kMinFrames && history.together < kMaxTogether * frames;
}

bool seen_together(const PairHistory& history) {
  return history.together >= kMinTogether && history.together >= history.apart;
}

}  // namespace laneloom
