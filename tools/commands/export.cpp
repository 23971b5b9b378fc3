#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "commands/exit_codes.hpp"
#include "commands/given_files.hpp"
#include "commands/options.hpp"
#include "commands/read_drive.hpp"
#include "commands/read_input.hpp"
#include "config/config_file.hpp"
#include "export/geojson_file.hpp"
#include "export/lanelet2_file.hpp"
#include "export/opendrive_file.hpp"
#include "export/survey.hpp"
#include "export/weave.hpp"
#include "export/weld.hpp"
#include "io/json_text.hpp"
#include "io/text_file.hpp"
#include "laneloom/element_names.hpp"
#include "laneloom/polyline.hpp"

namespace laneloom::commands {
namespace {

struct ExportOptions {
  std::vector<std::string> in;
  std::string config, preset, lanelet2, opendrive, geojson, report;
  std::optional<exports::Origin> origin;
  bool plain = false, no_extras = false, strict = false;
};

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
  std::vector<std::string> read = options.in;
  read.push_back(options.config);
  refuse_overwriting(read, {options.lanelet2, options.opendrive, options.geojson, options.report});
}

constexpr double kTold_m = 0.1;  // a smaller bend is not told

/// A road of the drives that could be read, and what is told of them.
struct Surveyed {
  exports::Survey survey;
  std::vector<std::string> files;
  nlohmann::json drives = nlohmann::json::array(), left_out = nlohmann::json::array();
  std::string frame_id;  ///< of the first drive that tells it

  void add(const std::string& file, ReadDrive drive) {
    if (frame_id.empty()) frame_id = drive.frame_id;
    if (!drive.frame_id.empty() && drive.frame_id != frame_id)
      fmt::print(stderr, "laneloom: {}: is in the frame '{}', and the drives before in '{}'\n", file,
                 drive.frame_id, frame_id);
    const exports::Survey::Offset offset = survey.add(std::move(drive.lines));
    if (offset.loops_m >= kTold_m)
      fmt::print("{}: bent by up to {:.2f} m, so that the road to which it comes back is there once\n", file,
                 offset.loops_m);
    if (!files.empty())
      fmt::print(
          "{}: moved by {:.2f} m (at most {:.2f} m and {:.2f} deg); {:.0f} % of its lines are on the road so "
          "far\n",
          file, offset.mean_m, offset.greatest_m, offset.greatest_deg, 100.0 * offset.met_share);
    files.push_back(file);
    drives.push_back({{"file", file},
                      {"loops_m", offset.loops_m},
                      {"mean_m", offset.mean_m},
                      {"greatest_m", offset.greatest_m},
                      {"greatest_deg", offset.greatest_deg},
                      {"met_share", offset.met_share}});
  }
};

Surveyed survey(const ExportOptions& options, const Config& config) {
  Surveyed surveyed;
  for (const std::string& file : options.in) {
    try {
      surveyed.add(file, read_drive(file, config, options.strict));
    } catch (const std::runtime_error& error) {
      if (options.strict || options.in.size() == 1) throw;
      fmt::print(stderr, "laneloom: {}; the drive is left out\n", error.what());
      surveyed.left_out.push_back({{"file", file}, {"problem", error.what()}});
    }
  }
  if (surveyed.files.empty()) throw std::runtime_error("none of the drives could be read");
  return surveyed;
}

constexpr std::size_t kMostTold = 10;

void tell(const std::vector<exports::Change>& changes, const Surveyed& surveyed) {
  for (std::size_t i = 0; i < std::min(changes.size(), kMostTold); ++i) {
    const exports::Change& change = changes[i];
    const Point& at = change.points[change.points.size() / 2];
    fmt::print("{}: a {} of {:.0f} m at ({:.1f}, {:.1f}), {} seen by {}\n", change.gone ? "gone" : "new",
               name(change.type), length(change.points), at.x(), at.y(), change.gone ? "last" : "first",
               surveyed.files[change.drive]);
  }
  if (changes.size() > kMostTold)
    fmt::print("{} more changes; --report has them\n", changes.size() - kMostTold);
}

void write_report(const std::string& path, const std::vector<exports::Change>& changes,
                  const Surveyed& surveyed) {
  nlohmann::json report{
      {"drives", surveyed.drives}, {"left_out", surveyed.left_out}, {"changes", nlohmann::json::array()}};
  for (const exports::Change& change : changes) {
    nlohmann::json points = nlohmann::json::array();
    for (const Point& point : change.points) points.push_back({point.x(), point.y(), point.z()});
    report["changes"].push_back({{"gone", change.gone},
                                 {"type", name(change.type)},
                                 {"seen_by", surveyed.files[change.drive]},
                                 {"points", std::move(points)}});
  }
  io::write_text(path, io::json_text(report, 2) + "\n");
}

/// How far a map reaches from the origin of its frame.
double farthest_m(const LocalMap& map) {
  double far_m = 0.0;
  for (const Lane& lane : map.lanes)
    for (const Point& point : lane.centerline) far_m = std::max(far_m, point.head<2>().norm());
  return far_m;
}

/// The origin of the configured place, or one at 0, 0. Beyond 100 km, the tangent plane there is no picture
/// of the earth any more, as with poses in UTM: without a place, the map itself begins at 0, 0 then.
exports::Origin origin_of(const LocalMap& map, const std::optional<exports::Origin>& given) {
  const double far_m = farthest_m(map);
  if (far_m <= 1e5) return given.value_or(exports::Origin{});
  if (given)
    throw std::runtime_error(
        fmt::format("--origin: a lane is {:.0f} km from the origin of the map frame, and 100 km are the "
                    "most; poses in UTM have to be moved to an origin nearby",
                    far_m / 1000.0));
  const Point& begin = map.lanes.front().centerline.front();
  return {.of = {begin.x(), begin.y(), 0.0}};
}

void export_drives(const ExportOptions& options) {
  if (options.plain && options.lanelet2.empty() && options.opendrive.empty())
    throw CLI::ValidationError("--plain", "needs --lanelet2 or --opendrive");
  check_files(options);
  refuse_second_reading(options.in);
  const Config config = config::resolve_config(options.config, options.preset);
  const Surveyed surveyed = survey(options, config);
  const LocalMap map = weave(surveyed.survey.road(), config.mapper);
  if (map.lanes.empty()) throw std::runtime_error(surveyed.files.front() + ": has no lanes to export");
  const exports::Origin place = origin_of(map, options.origin);
  const std::vector<exports::Change> changes = surveyed.survey.changes();
  tell(changes, surveyed);
  if (!options.report.empty()) write_report(options.report, changes, surveyed);
  exports::RoadNetwork network = exports::weld(map);
  if (options.plain) network.stops.clear();  // their ways stay
  if (!options.lanelet2.empty()) write_lanelet2(options.lanelet2, network, place, !options.no_extras);
  if (!options.lanelet2.empty() && !options.origin)
    fmt::print(
        stderr,
        "laneloom: {}: latitudes and longitudes are those of {} at 0, 0; --origin gives the true ones\n",
        options.lanelet2, place.of.isZero() ? "a map frame" : "a map that begins");
  if (!options.opendrive.empty()) write_opendrive(options.opendrive, network);
  if (!options.geojson.empty()) write_geojson(options.geojson, network, place);
  fmt::print("{} lanes and {} linkages as {} lanelets, {} stop lines\n", map.lanes.size(),
             map.linkages.size(), network.lanelets.size(), map.stoplines.size());
  if (!surveyed.left_out.empty()) end_with(kFoundWrong);
}

}  // namespace

void add_export(CLI::App& app) {
  CLI::App* command = app.add_subcommand("export", "Makes one map of drives, for other programs");
  const auto options = std::make_shared<ExportOptions>();
  command
      ->add_option("--in,drives", options->in,
                   "Maps (.mcap or .jsonl), or detections and poses to map (.mcap or .frames.jsonl). Several "
                   "are made one, in the order given")
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
  add_text_output(*command, "--report", options->report,
                  "How each drive was moved, and what changed between drives (.json)");
  command->add_flag("--plain", options->plain,
                    "Leave out the stop lines' regulatory elements, which Autoware's extension of Lanelet2 "
                    "knows, and the stop lines of OpenDRIVE");
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
  command->callback([options] { export_drives(*options); });
}

}  // namespace laneloom::commands
