#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include "commands/commands.hpp"
#include "commands/given_files.hpp"
#include "commands/options.hpp"
#include "commands/read_input.hpp"
#include "drawing/frame_elements.hpp"
#include "drawing/map_elements.hpp"
#include "drawing/truth.hpp"
#include "render/figure.hpp"

namespace laneloom::commands {
namespace {

struct RenderOptions {
  std::string frames, map, truth, out, title;
  std::vector<double> at_s;
  std::size_t sequence = 0;
  RangeConfig range;
  bool strict = false;
};

struct SeenFrame {
  DetectionFrame frame;
  Eigen::Isometry3d T_map_body;
};

struct Inputs {
  std::vector<SeenFrame> frames;
  std::vector<LocalMap> maps;
  std::optional<simulation::Road> truth;
};

std::int64_t stamp(const SeenFrame& seen) { return seen.frame.stamp_ns; }
std::int64_t stamp(const LocalMap& map) { return map.stamp_ns; }

template <class T>
const T& nearest(const std::vector<T>& items, std::int64_t stamp_ns) {
  return *std::min_element(items.begin(), items.end(), [&](const T& a, const T& b) {
    return std::abs(stamp(a) - stamp_ns) < std::abs(stamp(b) - stamp_ns);
  });
}

Inputs read(const RenderOptions& options) {
  Inputs inputs;
  if (!options.truth.empty()) inputs.truth = simulation::load_truth(options.truth);
  if (!options.frames.empty()) {
    for_each_frame(options.frames, options.strict,
                   [&](const DetectionFrame& frame, const Eigen::Isometry3d& T_map_body) {
                     inputs.frames.push_back({frame, T_map_body});
                   });
    if (inputs.frames.empty())
      throw std::runtime_error(fmt::format("{}: holds no frame with a pose", options.frames));
  }
  if (!options.map.empty()) {
    for_each_map(options.map, options.strict, [&](const LocalMap& map) { inputs.maps.push_back(map); });
    if (inputs.maps.empty()) throw std::runtime_error(options.map + ": holds no map");
  }
  for (const SeenFrame& seen : inputs.frames) {
    const auto map = std::ranges::find(inputs.maps, seen.frame.stamp_ns, &LocalMap::stamp_ns);
    if (map == inputs.maps.end()) continue;
    check_one_drive(seen.T_map_body, *map, options.frames, options.map);
    break;
  }
  return inputs;
}

/// First and last stamp of the things to draw: of the maps, or else the detections, or else the drive.
std::pair<std::int64_t, std::int64_t> time_span(const Inputs& inputs) {
  if (!inputs.maps.empty()) return {stamp(inputs.maps.front()), stamp(inputs.maps.back())};
  if (!inputs.frames.empty()) return {stamp(inputs.frames.front()), stamp(inputs.frames.back())};
  return {0, std::llround(inputs.truth->drive.duration_s() * 1e9)};
}

std::vector<std::int64_t> moments(const RenderOptions& options, const Inputs& inputs) {
  const auto [first_ns, last_ns] = time_span(inputs);
  std::vector<std::int64_t> stamps_ns;
  const auto span_ns = static_cast<double>(last_ns - first_ns);
  for (const double at_s : options.at_s) {
    // Checked before it is rounded, because it may be any number.
    if (!(at_s >= 0.0 && at_s * 1e9 < span_ns + 0.5))
      throw std::runtime_error(
          fmt::format("--at {:g} s is beyond the {:.1f} s that there are", at_s, 1e-9 * span_ns));
    stamps_ns.push_back(first_ns + std::llround(at_s * 1e9));
  }
  const auto count = static_cast<std::int64_t>(options.sequence);
  for (std::int64_t i = 1; i <= count; ++i)
    stamps_ns.push_back(first_ns + (last_ns - first_ns) / (count + 1) * i);
  if (stamps_ns.empty()) stamps_ns.push_back(last_ns);
  return stamps_ns;
}

/// The things that every panel of a moment shows.
drawing::Drawing surroundings(const RenderOptions& options, const Eigen::Isometry3d& T_map_body) {
  drawing::Drawing drawing;
  add_range(options.range, T_map_body, drawing);
  add_vehicle(T_map_body, drawing);
  return drawing;
}

Eigen::Isometry3d pose_at(const Inputs& inputs, std::int64_t stamp_ns) {
  if (!inputs.maps.empty()) return nearest(inputs.maps, stamp_ns).T_map_body;
  if (!inputs.frames.empty()) return nearest(inputs.frames, stamp_ns).T_map_body;
  return transform(inputs.truth->drive.pose_at(static_cast<double>(stamp_ns) * 1e-9));
}

render::Moment draw_moment(const RenderOptions& options, const Inputs& inputs, std::int64_t stamp_ns) {
  render::Moment moment;
  moment.T_map_body = pose_at(inputs, stamp_ns);
  moment.label = fmt::format("t = {:.1f} s", static_cast<double>(stamp_ns - time_span(inputs).first) * 1e-9);
  const drawing::Drawing around = surroundings(options, moment.T_map_body);
  drawing::Drawing over_truth = around;
  if (inputs.truth) add_truth(*inputs.truth, over_truth);
  if (!inputs.frames.empty()) {
    const SeenFrame& seen = nearest(inputs.frames, stamp_ns);
    add_detections(seen.frame, seen.T_map_body,
                   moment.panels.emplace_back(render::Panel{"Detections (one frame)", over_truth}).drawing);
  }
  if (!inputs.maps.empty())
    add_map(nearest(inputs.maps, stamp_ns),
            moment.panels.emplace_back(render::Panel{"Fused map", over_truth}).drawing);
  if (inputs.truth)
    add_map(drawing::map_of(*inputs.truth, moment.T_map_body),
            moment.panels.emplace_back(render::Panel{"Ground truth", around}).drawing);
  return moment;
}

void render(const RenderOptions& options) {
  refuse_second_reading({options.frames, options.map});
  refuse_overwriting({options.frames, options.map, options.truth}, {options.out});
  const Inputs inputs = read(options);
  render::Figure figure{options.title, options.range, {}};
  if (figure.title.empty()) figure.title = inputs.truth ? inputs.truth->name : "laneloom";
  for (const std::int64_t stamp_ns : moments(options, inputs))
    figure.moments.push_back(draw_moment(options, inputs, stamp_ns));
  draw_figure(figure, options.out);
}

}  // namespace

void add_render(CLI::App& app) {
  CLI::App* command = app.add_subcommand("render", "Draws detections, maps and truth side by side");
  const auto options = std::make_shared<RenderOptions>();
  CLI::Option_group* inputs = command->add_option_group("Inputs", "any of");
  inputs->add_option("--frames", options->frames, "Single detections (.frames.jsonl or .mcap)");
  inputs->add_option("--map", options->map, "Fused maps (.jsonl or .mcap)");
  inputs->add_option("--truth", options->truth, "Truth of the road (.json)");
  inputs->require_option(1, 3);
  CLI::Option* at =
      command->add_option("--at", options->at_s, "Moments, in seconds since the first; default: the last")
          ->type_name("SECONDS")
          ->delimiter(',');
  command->add_option("--sequence", options->sequence, "Number of moments, evenly spread")
      ->check(CLI::Range(1, 50))
      ->excludes(at);
  add_range(*command, options->range);
  command->add_option("--title", options->title, "Default: the road's name");
  command->add_option("--out", options->out, "Picture to write (.png or .svg)")
      ->required()
      ->check([](const std::string& path) {
        return path.ends_with(".png") || path.ends_with(".svg") ? "" : "pictures are .png or .svg";
      });
  add_strict(*command, options->strict);
  command->callback([options] { render(*options); });
}

}  // namespace laneloom::commands
