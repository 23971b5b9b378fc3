#include "mapping/lines/line_room.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "mapping/lines/line_evidence.hpp"

namespace laneloom::lines {
namespace {

constexpr std::size_t kMostLines = 256, kMostStations = 20000;
constexpr std::size_t kMostInPlace = 4;  // lines in a square metre

/// A line in a square metre that it passes, seen from above: the place in the upper bits, then the rank of
/// the line. Ranks begin with the line that is believed most. Places 16 000 km apart are not told apart.
using LineInPlace = std::uint64_t;
constexpr int kRankBits = 16;  // a frame adds some hundred lines to the 256 at most

LineInPlace in_place(const Point& point, std::size_t rank) {
  const auto number = [](double at_m) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(at_m))) & 0xFFFFFFU;
  };
  return number(point.x()) << (kRankBits + 24) | number(point.y()) << kRankBits | rank;
}

/// The indices of the lines, by falling belief.
std::vector<std::size_t> by_belief(const std::vector<Line>& lines) {
  std::vector<std::pair<double, std::size_t>> disbelief;
  disbelief.reserve(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
    disbelief.emplace_back(-existence(lines[i].stations, lines[i].beliefs), i);
  std::ranges::sort(disbelief);
  std::vector<std::size_t> order;
  order.reserve(lines.size());
  for (const auto& [_, i] : disbelief) order.push_back(i);
  return order;
}

/// Per rank, whether so many better lines lie in some square metre of the line that it is one too many.
std::vector<bool> crowded_out(const std::vector<Line>& lines, const std::vector<std::size_t>& order) {
  std::size_t stations = 0;
  for (const Line& line : lines) stations += line.stations.size();
  std::vector<LineInPlace> all;
  all.reserve(stations);
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    for (const Station& station : lines[order[rank]].stations)
      all.push_back(in_place(station.position, rank));
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::vector<bool> out(order.size());
  std::size_t better = 0;  // lines in the same place
  for (std::size_t i = 1; i < all.size(); ++i) {
    better = all[i] >> kRankBits == all[i - 1] >> kRankBits ? better + 1 : 0;
    if (better >= kMostInPlace) out[all[i] & ((1U << kRankBits) - 1)] = true;
  }
  return out;
}

}  // namespace

std::size_t keep_within_room(std::vector<Line>& lines) {
  if (lines.size() <= kMostInPlace) return 0;
  const std::vector<std::size_t> order = by_belief(lines);
  const std::vector<bool> out = crowded_out(lines, order);
  std::vector<bool> kept(lines.size());
  std::size_t count = 0, stations = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const std::size_t size = lines[order[rank]].stations.size();
    if (out[rank] || count == kMostLines || stations + size > kMostStations) continue;
    kept[order[rank]] = true;
    ++count;
    stations += size;
  }
  std::size_t index = 0;
  return std::erase_if(lines, [&](const Line&) { return !kept[index++]; });
}

}  // namespace laneloom::lines
