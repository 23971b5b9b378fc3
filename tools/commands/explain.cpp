#include "commands/explain.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <optional>
#include <stdexcept>

#include "base/seconds.hpp"
#include "replay/message_source.hpp"
#include "replay/replay.hpp"
#include "why/reason_history.hpp"

namespace laneloom::commands {
namespace {

struct Wanted {
  bool detection = false;
  std::uint64_t id = 0;
  double time_s = 0.0;
};

template <class Number>
bool read(std::string_view text, Number& to) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), to);
  return error == std::errc() && end == text.data() + text.size();
}

Wanted parsed(const std::string& text) {
  Wanted wanted{.detection = text.starts_with('d')};
  const std::string_view whole = std::string_view(text).substr(wanted.detection ? 1 : 0);
  const std::size_t at = whole.find('@');
  if (at == std::string_view::npos || !read(whole.substr(0, at), wanted.id) ||
      !read(whole.substr(at + 1), wanted.time_s))
    throw CLI::ValidationError(
        "--explain",
        fmt::format("{}: must be ID@TIME, as 23@12.5, or d2@12.5 for the detection of number 2", text));
  return wanted;
}

}  // namespace

void explain(const std::string& drive, const Config& config, const std::string& wanted) {
  const Wanted what = parsed(wanted);
  why::ReasonHistory reasons;
  std::optional<std::int64_t> first_ns;
  std::optional<LocalMap> asked;
  std::vector<std::string> text;
  const auto take = [&](const PublishedMap& map, std::int64_t) {
    if (!first_ns) first_ns = map.map.stamp_ns;
    if (asked || seconds(map.map.stamp_ns - *first_ns) < what.time_s - 1e-6) return;
    asked = map.map;
    text = what.detection ? std::vector<std::string>{reasons.of_detection(what.id)}
                          : reasons.of(what.id, map.map);
  };
  replay::Replay replay(config, take, &reasons);
  const auto source = replay::open_messages(drive, config.dds.map_frame_id);
  while (!asked) {
    auto message = source->next_input();
    if (!message) break;
    replay.add(std::move(*message));
  }
  if (!asked)
    throw std::runtime_error(fmt::format("{}: has no map {:g} s after its first", drive, what.time_s));
  if (text.empty() || text.front().empty())
    throw std::runtime_error(fmt::format(
        "{}: at {:g} s, {} {}", drive, what.time_s,
        what.detection ? "the frame has no detection of the number" : "nothing was followed of the id",
        what.id));
  for (const std::string& sentence : text) fmt::print("{}\n", sentence);
}

}  // namespace laneloom::commands
