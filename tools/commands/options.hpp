#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/dds_values.hpp"
#include "io/axes.hpp"
#include "io/text_file.hpp"
#include "laneloom/config.hpp"
#include "recording/recording.hpp"

/// Options that several commands share.
namespace laneloom::commands {

/// Checks for a number from `min` to `max`. CLI::Range would let NaN pass.
inline CLI::Validator within(double min, double max) {
  const auto complaint = [min, max](const std::string& input) {
    double value = 0.0;
    const bool good = CLI::detail::lexical_cast(input, value) && value >= min && value <= max;
    return good ? std::string() : fmt::format("{} is not in the range {:g} to {:g}", input, min, max);
  };
  return {complaint, fmt::format("FLOAT in [{:g} - {:g}]", min, max)};
}

/// Checks for seconds above 0 that fit into nanoseconds.
inline CLI::Validator positive_seconds() { return within(1e-6, 1e9); }

/// Adds --range x0,x1,y0,y1: the map's range box. The box is symmetric: y0 = -y1.
inline CLI::Option* add_range(CLI::App& command, RangeConfig& range) {
  const auto set = [&range](const std::vector<double>& values) {
    if (!(values[0] < values[1] && values[3] > 0.0 && values[2] == -values[3]))
      throw CLI::ValidationError("--range", "needs x0 < x1 and y0 = -y1 < 0");
    range.forward_min_m = values[0];
    range.forward_max_m = values[1];
    range.side_max_m = values[3];
  };
  return command.add_option_function<std::vector<double>>("--range", set, "Map range in metres, body frame")
      ->type_name("X0,X1,Y0,Y1")
      ->delimiter(',')
      ->expected(4);
}

/// Adds --strict.
inline CLI::Option* add_strict(CLI::App& command, bool& strict) {
  return command.add_flag("--strict", strict,
                          "Fail at the first thing that is wrong, instead of leaving it out");
}

/// Lets all that the command reports go to standard error, since standard output is a file that it writes.
inline void write_to_standard_output(const std::string& option) {
  if (stdout == stderr) throw CLI::ValidationError(option, "standard output is another file already");
  stdout = stderr;  // std::cout, which the file goes to, stays as it is
}

/// Adds an option with text files to write, of which one may be "-", standard output.
template <typename Paths>
CLI::Option* add_text_output(CLI::App& command, const std::string& name, Paths& paths,
                             const std::string& description) {
  return command.add_option(name, paths, description)->each([name](const std::string& path) {
    if (path == io::kStandard) write_to_standard_output(name);
  });
}

/// Adds --out, of a recording to write. Its ending need not be given.
inline CLI::Option* add_recording_output(CLI::App& command, std::string& path) {
  const auto complete = [](std::string& given) -> std::string {
    if (given == io::kStandard) return "a recording is a file, and no standard output";
    if (!given.ends_with(".mcap")) given += ".mcap";
    return {};
  };
  return command.add_option("--out", path, "Recording to write (.mcap)")
      ->transform(CLI::Validator(complete, ""));
}

/// Adds --axes, of points: see io/axes.hpp.
inline CLI::Option* add_axes(CLI::App& command, std::string& axes) {
  const auto complaint = [](const std::string& name) -> std::string {
    try {
      io::axes_named(name);
      return {};
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  return command
      .add_option("--axes", axes, "Where x and y of the points lead, such as right-forward; z is up")
      ->check(CLI::Validator(complaint, "AXES"))
      ->capture_default_str();
}

/// A reader that a writer knows already may need this much longer to know the writer. Messages sent before
/// are lost.
inline constexpr std::chrono::seconds kDiscovery{1};

/// A reader lets go of what it has not taken yet when it hears that the writer has ended. A process that
/// wrote lives on for this long, so that its last messages are taken.
inline constexpr std::chrono::milliseconds kDelivery{500};

/// Adds the options that tell which service is meant, and how it is reached. Returns them.
inline std::vector<CLI::Option*> add_dds(CLI::App& command, DdsConfig& dds) {
  auto* domain = command.add_option("--domain", dds.domain, "DDS domain")
                     ->check(CLI::Range(0, kLastDomain))
                     ->capture_default_str();
  auto* vehicle = command.add_option("--vehicle-id", dds.vehicle_id, "Names the vehicle's DDS partition")
                      ->check(CLI::Validator(identifier_problem, "NAME"))
                      ->capture_default_str();
  auto* transport = command.add_option("--transport", dds.transport, "udp+shm: among processes of one user")
                        ->check(CLI::IsMember({"udp", "udp+shm"}))
                        ->capture_default_str();
  auto* file = command.add_option("--profile-file", dds.profile_file,
                                  "Fast DDS XML profiles, for other networks; as dds.profile_file");
  auto* name = command.add_option("--profile-name", dds.profile_name, "Name of the participant in that file")
                   ->needs(file);
  auto* security = command.add_option("--security", dds.security_directory,
                                      "Folder with the identity for DDS-Security; as dds.security_directory");
  return {domain, vehicle, transport, file, name, security};
}

inline const std::map<std::string, recording::Compression> kCompressions{
    {"zstd", recording::Compression::zstd},
    {"lz4", recording::Compression::lz4},
    {"none", recording::Compression::none}};

/// Adds --compression, of a recording that is written: a key of kCompressions.
inline CLI::Option* add_compression(CLI::App& command, std::string& compression) {
  return command.add_option("--compression", compression, "Compression of a recording: zstd, lz4 or none")
      ->check(CLI::IsMember(kCompressions))
      ->capture_default_str();
}

}  // namespace laneloom::commands
