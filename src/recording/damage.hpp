#pragma once

#include <stdexcept>
#include <string>

#include "base/left_out.hpp"

namespace laneloom::recording {

/// A part of a recording cannot be read. Reading may go on behind it.
class Damage : public std::runtime_error {
 public:
  Damage(const std::string& file, const std::string& place, const std::string& reason)
      : std::runtime_error(file + ": at " + place + ": " + reason), place_(place), reason_(reason) {}
  const std::string& place() const { return place_; }
  const std::string& reason() const { return reason_; }

 private:
  std::string place_, reason_;
};

/// Calls `next` of a reader until it is not Damage that comes. That is left out, and passes through if
/// `left_out` is strict.
template <typename Next>
auto next_or_leave_out(LeftOut& left_out, Next next) {
  for (;;) {
    try {
      return next();
    } catch (const Damage& damage) {
      if (left_out.strict()) throw;
      left_out.add(damage.reason(), damage.place());
    }
  }
}

}  // namespace laneloom::recording
