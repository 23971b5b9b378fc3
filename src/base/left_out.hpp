#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace laneloom {

/// What is wrong in an input and was left out of it: how often, by reason, and where first. A reader that is
/// strict leaves nothing out: what is wrong is an error. Not thread-safe.
class LeftOut {
 public:
  explicit LeftOut(bool strict = false) : strict_(strict) {}

  bool strict() const { return strict_; }
  bool empty() const { return reasons_.empty(); }
  std::uint64_t count() const { return count_; }

  /// Counts what is wrong at `place`.
  void add(std::string_view reason, std::string_view place, std::uint64_t count = 1) {
    count_ += count;
    auto found = std::ranges::find(reasons_, reason, &Reason::text);
    if (found == reasons_.end() && reasons_.size() == kMaxReasons) {
      // Damage at random has ever new reasons.
      reason = kOthers;
      found = std::ranges::find(reasons_, reason, &Reason::text);
    }
    if (found == reasons_.end())
      reasons_.push_back({std::string(reason), std::string(place), count});
    else
      found->count += count;
  }

  /// All reasons in the order in which they came: "2 x <reason> (first: <place>), 1 x …". Empty: nothing was
  /// left out.
  std::string summary() const {
    std::string text;
    for (const Reason& reason : reasons_)
      text += (text.empty() ? "" : ", ") + std::to_string(reason.count) + " x " + reason.text +
              " (first: " + reason.first_place + ")";
    return text;
  }

 private:
  static constexpr std::size_t kMaxReasons = 20;
  static constexpr std::string_view kOthers = "for other reasons";

  struct Reason {
    std::string text, first_place;
    std::uint64_t count = 0;
  };

  bool strict_;
  std::uint64_t count_ = 0;
  std::vector<Reason> reasons_;
};

}  // namespace laneloom
