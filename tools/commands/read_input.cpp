#include "commands/read_input.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <utility>

#include "base/seconds.hpp"
#include "commands/warn_of.hpp"
#include "evaluation/inputs.hpp"
#include "support/progress_bar.hpp"

namespace laneloom::commands {
namespace {

/// Reads with a progress bar. `read` takes how it is to read, and returns the account.
template <typename Read>
std::size_t read_with_bar(const std::string& path, bool strict, Read read) {
  support::ProgressBar bar;
  const evaluation::InputAccount account =
      read(evaluation::InputReading{.strict = strict, .on_step = [&](double share) { bar.step(share); }});
  bar.clear();
  warn_of(path, account.refused, account.left_out);
  return account.count;
}

constexpr double kOneDrive_m = 20.0;  // between the poses of one moment of one drive

}  // namespace

void for_each_input(const std::string& path, const Config& config, bool strict,
                    const std::function<void(recording::RecordedMessage&&)>& visit) {
  const auto source = replay::open_messages(path, config.dds.map_frame_id, {.strict = strict});
  support::ProgressBar bar;
  while (std::optional<recording::RecordedMessage> message = source->next_input()) {
    visit(std::move(*message));
    bar.step(source->progress());
  }
  bar.clear();
  warn_of(path, source->refused(), source->left_out());
}

check::Drive read_inputs(replay::MessageSource& source) {
  support::ProgressBar bar;
  return check::read_drive(source, [&](double share) { bar.step(share); });
}

void replay_input(const std::string& path, const Config& config, bool strict, replay::Replay& replay) {
  for_each_input(path, config, strict,
                 [&](recording::RecordedMessage&& message) { replay.add(std::move(message)); });
}

std::size_t for_each_frame(
    const std::string& path, bool strict,
    const std::function<void(const DetectionFrame&, const Eigen::Isometry3d&)>& visit) {
  return read_with_bar(path, strict, [&](const evaluation::InputReading& reading) {
    return evaluation::for_each_frame(path, visit, reading);
  });
}

std::size_t for_each_map(const std::string& path, bool strict,
                         const std::function<void(const LocalMap&)>& visit) {
  return read_with_bar(path, strict, [&](const evaluation::InputReading& reading) {
    return evaluation::for_each_map(path, visit, reading);
  });
}

void check_one_drive(const Eigen::Isometry3d& T_map_body, const LocalMap& map, const std::string& frames,
                     const std::string& maps) {
  const double apart_m = (T_map_body.translation() - map.T_map_body.translation()).norm();
  if (apart_m < kOneDrive_m) return;
  throw std::runtime_error(
      fmt::format("{} and {}: are of two drives; at the stamp {:.3f} s, their poses are {:.0f} m apart",
                  frames, maps, seconds(map.stamp_ns), apart_m));
}

}  // namespace laneloom::commands
