#include "mapping/markings/pair_history.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace laneloom::markings {
namespace {

constexpr double kMemory = 0.97;       // factor by which the counts fade per frame
constexpr double kMinFrames = 4.0;     // before a pair is judged
constexpr double kMinTogether = 1.9;   // frames; reached by two that follow one another
constexpr double kMaxTogether = 0.25;  // share of the frames, of a pair seen apart

std::pair<ElementId, ElementId> key_of(const PairHistory& history) { return {history.a, history.b}; }

PairHistory advanced(PairHistory history, const PairSighting& sighting) {
  history.together = kMemory * history.together + (sighting.together ? 1.0 : 0.0);
  history.apart = kMemory * history.apart + (sighting.apart ? 1.0 : 0.0);
  return history;
}

}  // namespace

void sort(PairHistories& histories) { std::ranges::sort(histories, {}, key_of); }

const PairHistory* find(const PairHistories& histories, ElementId a, ElementId b) {
  const std::pair<ElementId, ElementId> key = std::minmax(a, b);
  const auto found = std::ranges::lower_bound(histories, key, {}, key_of);
  return found == histories.end() || key_of(*found) != key ? nullptr : &*found;
}

PairHistory continued(const PairHistories& histories, const PairSighting& sighting) {
  const PairHistory* known = find(histories, sighting.a, sighting.b);
  return advanced(known != nullptr ? *known : PairHistory{sighting.a, sighting.b}, sighting);
}

PairHistories continued(const PairHistories& histories, const std::vector<PairSighting>& sightings) {
  PairHistories result;
  result.reserve(sightings.size());
  auto known = histories.begin();
  for (const PairSighting& sighting : sightings) {
    const std::pair key(sighting.a, sighting.b);
    while (known != histories.end() && key_of(*known) < key) ++known;
    const bool is_known = known != histories.end() && key_of(*known) == key;
    result.push_back(advanced(is_known ? *known : PairHistory{sighting.a, sighting.b}, sighting));
  }
  return result;
}

void forget(ElementId id, PairHistories& histories) {
  std::erase_if(histories, [=](const PairHistory& h) { return h.a == id || h.b == id; });
}

void rename(ElementId from, ElementId to, PairHistories& histories) {
  for (PairHistory& history : histories) {
    if (history.a != from && history.b != from) continue;
    std::tie(history.a, history.b) = std::minmax({to, history.a == from ? history.b : history.a});
  }
  std::erase_if(histories, [](const PairHistory& h) { return h.a == h.b; });
  // The one of more frames comes first, so that it stays.
  std::ranges::sort(histories, {},
                    [](const PairHistory& h) { return std::tuple(h.a, h.b, -(h.together + h.apart)); });
  const auto is_same = [](const PairHistory& h, const PairHistory& next) {
    return key_of(h) == key_of(next);
  };
  histories.erase(std::unique(histories.begin(), histories.end(), is_same), histories.end());
}

bool seen_apart(const PairHistory& history) {
  const double frames = history.together + history.apart;
  return frames >= kMinFrames && history.together < kMaxTogether * frames;
}

bool seen_together(const PairHistory& history) {
  return history.together >= kMinTogether && history.together >= history.apart;
}

}  // namespace laneloom::markings
