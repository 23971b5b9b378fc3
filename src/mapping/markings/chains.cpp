#include "mapping/markings/chains.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>

namespace laneloom::markings {
namespace {

/// The end that each end of each line is joined to.
class Joined {
 public:
  explicit Joined(std::size_t count) : ends_(count) {}
  std::optional<LineEnd>& operator[](const LineEnd& at) { return ends_[at.line][index(at.end)]; }
  const std::optional<LineEnd>& operator[](const LineEnd& at) const { return ends_[at.line][index(at.end)]; }

 private:
  std::vector<std::array<std::optional<LineEnd>, 2>> ends_;
};

Joined choose(std::vector<Join> joins, std::size_t count) {
  std::ranges::stable_sort(joins, {}, &Join::gap_m);
  Joined joined(count);
  std::vector<std::size_t> group(count);
  std::iota(group.begin(), group.end(), 0U);
  for (const auto& [gap_m, a, b] : joins) {
    if (joined[a] || joined[b] || group[a.line] == group[b.line]) continue;
    joined[a] = b;
    joined[b] = a;
    const std::size_t replaced = group[b.line], kept = group[a.line];
    std::ranges::replace(group, replaced, kept);
  }
  return joined;
}

/// The free end from which the chain runs as `line` does.
LineEnd start_of(std::size_t line, const Joined& joined) {
  LineEnd start{line, End::front};
  while (const auto& before = joined[start]) start = {before->line, opposite(before->end)};
  return start;
}

std::vector<Link> follow(const LineEnd& start, const Joined& joined) {
  std::vector<Link> chain;
  for (std::optional<LineEnd> entered = start; entered;
       entered = joined[{entered->line, opposite(entered->end)}])
    chain.push_back({entered->line, entered->end == End::back});
  return chain;
}

}  // namespace

std::vector<std::vector<Link>> chains(std::vector<Join> joins, std::size_t count) {
  const Joined joined = choose(std::move(joins), count);
  std::vector<std::vector<Link>> result;
  std::vector<bool> used(count, false);
  for (std::size_t i = 0; i < count; ++i) {
    if (used[i]) continue;
    result.push_back(follow(start_of(i, joined), joined));
    for (const Link& link : result.back()) used[link.line] = true;
  }
  return result;
}

}  // namespace laneloom::markings
