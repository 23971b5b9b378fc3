#include "config/network_profile.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "read_text.hpp"

namespace laneloom::config {
namespace {

// Far beyond what is ever learned, and small enough that the mapper's sums and squares stay finite.
constexpr double kMaxNumber = 1e9;

/// Reads a profile. Its errors name the file and the line.
class ProfileReader {
 public:
  explicit ProfileReader(std::string file) : file_(std::move(file)) {}

  NetworkProfiles profiles(const YAML::Node& root) const {
    NetworkProfiles profiles;
    each(root, "the profile", [&](const std::string& source, const YAML::Node& values) {
      each(values, source, [&](const std::string& name, const YAML::Node& learned) {
        profiles[source][name] = learned_value(learned, source + "." + name);
      });
    });
    return profiles;
  }

 private:
  [[noreturn]] void fail(const YAML::Node& node, const std::string& what) const {
    const int line = std::max(node.Mark().line, 0);  // an empty file has none
    throw ConfigError(file_ + ":" + std::to_string(line + 1) + ": " + what);
  }

  /// Visits the entries of a map. Each key may be given once.
  void each(const YAML::Node& node, const std::string& what, const auto& visit) const {
    if (!node.IsMap()) fail(node, what + " is not a map of keys and values");
    std::set<std::string> keys;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) fail(entry.first, what + " has a key that is not a plain word");
      const std::string& key = entry.first.Scalar();
      if (!keys.insert(key).second)
        fail(entry.first, std::string(key).append(" is given twice in ").append(what));
      visit(key, entry.second);
    }
  }

  LearnedValue learned_value(const YAML::Node& node, const std::string& name) const {
    LearnedValue learned;
    each(node, name, [&](const std::string& key, const YAML::Node& number) {
      if (key != "value" && key != "weight") fail(number, name + "." + key + " is not a known key");
      (key == "value" ? learned.value : learned.weight) = number_in(number, name + "." + key);
    });
    if (learned.weight <= 0.0) fail(node, name + ".weight is not above 0");
    return learned;
  }

  double number_in(const YAML::Node& node, const std::string& name) const {
    double number = 0.0;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, number) || !std::isfinite(number))
      fail(node, name + " is not a finite number");
    if (std::abs(number) > kMaxNumber) fail(node, name + " is beyond 1e9");
    return number;
  }

  std::string file_;
};

}  // namespace

NetworkProfiles load_network_profiles(const std::filesystem::path& path) {
  if (path.empty()) return {};
  try {
    return ProfileReader(path.string()).profiles(YAML::Load(config::read_text(path)));
  } catch (const YAML::Exception& error) {
    throw ConfigError(path.string() + ":" + std::to_string(error.mark.line + 1) + ": bad YAML: " + error.msg);
  }
}

NetworkProfiles merged(std::span<const NetworkProfiles> of_drives) {
  NetworkProfiles sum;
  for (const NetworkProfiles& drive : of_drives) {
    for (const auto& [source, profile] : drive) {
      for (const auto& [name, learned] : profile) {
        LearnedValue& all = sum[source][name];
        all.weight += learned.weight;
        all.value += (learned.value - all.value) * learned.weight / all.weight;
      }
    }
  }
  for (auto& [source, profile] : sum)
    for (auto& [name, all] : profile) all.weight = std::min(all.weight, kMaxNumber);
  return sum;
}

std::string dump(const NetworkProfiles& profiles) {
  YAML::Emitter yaml;
  yaml.SetDoublePrecision(9);
  yaml << YAML::BeginMap;
  for (const auto& [source, profile] : profiles) {
    yaml << YAML::Key << YAML::DoubleQuoted << source << YAML::Value << YAML::BeginMap;
    for (const auto& [name, learned] : profile)
      yaml << YAML::Key << name << YAML::Value << YAML::Flow << YAML::BeginMap << YAML::Key << "value"
           << YAML::Value << learned.value << YAML::Key << "weight" << YAML::Value << learned.weight
           << YAML::EndMap;
    yaml << YAML::EndMap;
  }
  yaml << YAML::EndMap;
  return std::string(yaml.c_str()) + "\n";
}

}  // namespace laneloom::config
