#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <variant>

#include "commands/commands.hpp"
#include "commands/options.hpp"
#include "commands/read_input.hpp"
#include "commands/warn_of.hpp"
#include "config/config_file.hpp"
#include "export/accumulate.hpp"
#include "export/geojson_file.hpp"
#include "export/lanelet2_file.hpp"
#include "export/opendrive_file.hpp"
#include "export/weave.hpp"
#include "export/weld.hpp"
#include "recording/damage.hpp"
#include "recording/recording.hpp"
#include "replay/replay.hpp"
#include "support/progress_bar.hpp"

namespace laneloom::commands {
namespace {

struct ExportOptions {
  std::string in, config, preset, lanelet2, opendrive, geojson;
  std::optional<exports::Origin> origin;
  bool plain = false, no_extras = false, strict = false;
};

/// Joins published maps to one drive.
class DriveReader {
 public:
  explicit DriveReader(const RangeConfig& range) : accumulator_(range) {}

  void take(const PublishedMap& published) {
    if (published.map.stamp_ns == 0 || published.map.stamp_ns < stamp_ns_) return;
    if (maps_ > 0 && published.map_id != map_id_) accumulator_.begin_anew();
    map_id_ = published.map_id;
    stamp_ns_ = published.map.stamp_ns;
    accumulator_.add(published.map);
    ++maps_;
  }
  std::size_t maps() const { return maps_; }
  exports::DriveAccumulator::Drive finish() { return accumulator_.finish(); }

 private:
  exports::DriveAccumulator accumulator_;
  std::size_t maps_ = 0;
  std::uint64_t map_id_ = 0;
  std::int64_t stamp_ns_ = 0;
};

/// Whether the first line of JSON lines is a map.
bool holds_json_maps(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  while (line.empty() && std::getline(in, line)) {
  }
  const auto json = nlohmann::json::parse(line, nullptr, false);
  return json.is_object() && json.contains("instances");
}

void take_json_maps(const std::string& path, bool strict, DriveReader& taker) {
  for_each_map(path, strict, [&](const LocalMap& map) {
    PublishedMap published;
    published.map = map;
    taker.take(published);
  });
}

void take_recorded_maps(const std::string& path, bool strict, DriveReader& taker) {
  recording::RecordingReader reader(path);
  LeftOut left_out(strict);
  support::ProgressBar bar;
  while (const auto recorded = recording::next_or_leave_out(left_out, [&] { return reader.next(); })) {
    bar.step(reader.progress());
    if (const auto* published = std::get_if<PublishedMap>(&recorded->message)) taker.take(*published);
  }
  bar.clear();
  if (taker.maps() == 0) return;
  warn_of(path, reader.refused(), reader.cut_off());
  warn_of(path, left_out);
}

void map_frames(const std::string& path, const Config& config, bool strict, DriveReader& taker) {
  replay::Replay replay(config,
                        [&](const PublishedMap& map, std::int64_t /*log_time_ns*/) { taker.take(map); });
  replay_input(path, config, strict, replay);
}

exports::DriveAccumulator::Drive read_drive(const ExportOptions& options, const Config& config) {
  DriveReader taker(config.mapper.range);
  const bool recorded = recording::is_recording(options.in);
  if (recorded) take_recorded_maps(options.in, options.strict, taker);
  if (!recorded && holds_json_maps(options.in)) take_json_maps(options.in, options.strict, taker);
  const bool has_maps = taker.maps() > 0;
  if (!has_maps) map_frames(options.in, config, options.strict, taker);
  if (taker.maps() == 0)
    throw std::runtime_error(options.in + ": has no maps, and no detections with poses to make them of");
  fmt::print("{} maps {}\n", taker.maps(), has_maps ? "read" : "made of the detections");
  return taker.finish();
}

exports::Origin origin(const std::string& text) {
  const std::size_t comma = text.find(',');
  const auto degrees = [&](const std::string& number, double limit) {
    double value = 0.0;
    if (!CLI::detail::lexical_cast(number, value) || !(std::abs(value) <= limit))
      throw CLI::ValidationError("--origin", text + ": needs LAT,LON in degrees, such as 48.137,11.575");
    return value;
  };
  if (comma == std::string::npos) degrees("", 0.0);
  return {degrees(text.substr(0, comma), 90.0), degrees(text.substr(comma + 1), 180.0)};
}

void check_files(const ExportOptions& options) {
  std::set<std::string> written;
  for (const std::string& out : {options.lanelet2, options.opendrive, options.geojson}) {
    refuse_same_file(out, options.in);
    if (!out.empty() && !written.insert(out).second) throw std::runtime_error(out + ": is given twice");
  }
}

void export_drive(const ExportOptions& options) {
  check_files(options);
  const Config config = config::resolve_config(options.config, options.preset);
  const LocalMap map = weave(read_drive(options, config), config.mapper);
  if (map.lanes.empty()) throw std::runtime_error(options.in + ": has no lanes to export");
  exports::RoadNetwork network = exports::weld(map);
  if (options.plain) network.stops.clear();  // their ways stay
  if (!options.lanelet2.empty())
    write_lanelet2(options.lanelet2, network, options.origin.value_or(exports::Origin{}), !options.no_extras);
  if (!options.lanelet2.empty() && !options.origin)
    fmt::print(
        stderr,
        "laneloom: {}: latitudes and longitudes are those of a place at 0, 0; --origin gives the true ones\n",
        options.lanelet2);
  if (!options.opendrive.empty()) write_opendrive(options.opendrive, network);
  if (!options.geojson.empty()) write_geojson(options.geojson, network, *options.origin);
  fmt::print("{} lanes and {} linkages as {} lanelets, {} stop lines\n", map.lanes.size(),
             map.linkages.size(), network.lanelets.size(), map.stoplines.size());
}

}  // namespace

void add_export(CLI::App& app) {
  CLI::App* command = app.add_subcommand("export", "Makes one map of a drive, for other programs");
  const auto options = std::make_shared<ExportOptions>();
  command
      ->add_option("--in,drive", options->in,
                   "Maps (.mcap or .jsonl), or detections and poses to map (.mcap or .frames.jsonl)")
      ->required();
  command->add_option("--config", options->config, "Configuration that the maps are made with (.yaml)");
  command->add_option("--preset", options->preset, "Range and alpha_n of a data set of the paper")
      ->check(CLI::IsMember(config::preset_names()));
  CLI::Option_group* outputs = command->add_option_group("Outputs", "one or more");
  CLI::Option* lanelet2 =
      add_text_output(*outputs, "--lanelet2", options->lanelet2, "Lanelet2 map to write (.osm)");
  add_text_output(*outputs, "--opendrive", options->opendrive, "Road network of OpenDRIVE to write (.xodr)");
  CLI::Option* geojson =
      add_text_output(*outputs, "--geojson", options->geojson, "GeoJSON (RFC 7946) to write; needs --origin");
  outputs->require_option(1, 3);
  command
      ->add_flag(
          "--plain", options->plain,
          "Leave out the stop lines' regulatory elements, which Autoware's extension of Lanelet2 knows")
      ->needs(lanelet2);
  command
      ->add_flag("--no-extras", options->no_extras,
                 "Leave out the tags that Lanelet2 itself does not know: local_x, local_y, turn_direction, "
                 "laneloom:*")
      ->needs(lanelet2);
  add_strict(*command, options->strict);
  CLI::Option* place = command->add_option_function<std::string>(
      "--origin", [options](const std::string& text) { options->origin = origin(text); },
      "Place of the map frame's origin in degrees (WGS84); x points east, y north");
  place->type_name("LAT,LON");
  geojson->needs(place);
  command->callback([options] { export_drive(*options); });
}

}  // namespace laneloom::commands
