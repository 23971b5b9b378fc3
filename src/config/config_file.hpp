#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "laneloom/config.hpp"
#include "laneloom/error.hpp"

/// Configuration files: YAML, one map per section, the keys named as the members of Config. All functions are
/// pure, except for the file that is read, and may be called from any thread.
namespace laneloom::config {

/// The configuration in a file; a key that is missing keeps its default. Throws ConfigError for an unreadable
/// file, bad YAML, an unknown or repeated key, a wrong type, and values that validate() refuses.
Config load_config(const std::filesystem::path& path);

/// The same of a text. Errors name it `name`.
Config parse_config(const std::string& text, const std::string& name);

/// The configuration with these values, each a key ("section.key") with its value as settings() gives it; a
/// key that is missing keeps its default. Errors name it `name`. Throws ConfigError as load_config() does.
Config from_settings(const std::vector<std::pair<std::string, std::string>>& settings,
                     const std::string& name);

/// Sets one value, from "section.key=value" in the words of a file: "mapper.range.side_max_m=20".
/// Throws ConfigError as load_config() does; `config` is unchanged then.
void set_value(Config& config, std::string_view assignment);

/// Throws ConfigError for a value outside its range, or values that contradict each other.
void validate(const Config& config);

/// Sets the local range and alpha_n of one of the paper's data sets: "inhouse" or "av2". Throws ConfigError
/// for other names.
void apply_preset(Config& config, std::string_view preset);

/// The names that apply_preset() knows.
std::vector<std::string> preset_names();

/// The configuration in a file, or the default one if no file is named, with the preset applied if one is
/// named. Throws as load_config() and apply_preset().
Config resolve_config(const std::filesystem::path& file, std::string_view preset);

/// The whole configuration as a file that load_config() reads back unchanged, each key with its unit,
/// range and meaning.
std::string dump(const Config& config);

/// Every key ("section.key") with its value as set_value() takes it, in the order of the file.
std::vector<std::pair<std::string, std::string>> settings(const Config& config);

/// The keys ("section.key") whose values differ, in the order of the file.
std::vector<std::string> changed_keys(const Config& before, const Config& after);

/// Names the values of a configuration: 16 hexadecimal digits, the same on every host.
std::string config_hash(const Config& config);

}  // namespace laneloom::config
