#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace laneloom {

/// Makes damaged bytes of valid ones. The same seed makes the same.
class Mutation {
 public:
  using Bytes = std::vector<std::uint8_t>;

  explicit Mutation(std::vector<Bytes> originals, std::uint64_t seed = std::mt19937_64::default_seed)
      : originals_(std::move(originals)), random_(seed) {}

  const std::vector<Bytes>& originals() const { return originals_; }
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : random_() % limit; }

  /// Changes some places of `bytes`: bits, numbers, what is there at all.
  void damage(Bytes& bytes) {
    for (std::size_t changes = 1 + below(kMaxChanges); changes > 0 && !bytes.empty(); --changes)
      change(bytes);
  }

 private:
  static constexpr std::size_t kMaxChanges = 8;  // at once
  static constexpr std::size_t kMaxSpan = 32;    // bytes that one change concerns

  void change(Bytes& bytes) {
    const std::size_t at = below(bytes.size());
    const std::size_t span = std::min(1 + below(kMaxSpan), bytes.size() - at);
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const auto end = begin + static_cast<std::ptrdiff_t>(span);
    switch (below(5)) {
      case 0:
        *begin = static_cast<std::uint8_t>(*begin ^ (1U << below(8)));
        break;
      case 1:
        *begin = static_cast<std::uint8_t>(below(256));
        break;
      case 2:  // as lengths and numbers, the least and the greatest
        std::fill(begin, begin + static_cast<std::ptrdiff_t>(std::min<std::size_t>(span, 8)),
                  std::array<std::uint8_t, 4>{0x00, 0x7f, 0x80, 0xff}.at(below(4)));
        break;
      case 3:
        bytes.erase(begin, end);
        break;
      default: {
        const Bytes& other = originals_[below(originals_.size())];
        const std::size_t from = below(other.size());
        const auto piece = other.begin() + static_cast<std::ptrdiff_t>(from);
        bytes.insert(begin, piece,
                     piece + static_cast<std::ptrdiff_t>(std::min(1 + below(kMaxSpan), other.size() - from)));
      }
    }
  }

  std::vector<Bytes> originals_;
  std::mt19937_64 random_;
};

}  // namespace laneloom
