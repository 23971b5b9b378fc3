#include "commands/noise_option.hpp"

#include <stdexcept>
#include <utility>

#include "simulation/traffic.hpp"

namespace laneloom::commands {

CLI::Validator noise_name() {
  const auto complaint = [](const std::string& name) {
    try {
      simulation::noise_profile(name);
      return std::string();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
  };
  return {complaint, "none|inhouse|av2|shaken|random:SEED"};
}

simulation::NoiseProfile NoiseOption::profile() const {
  simulation::NoiseProfile profile = simulation::noise_profile(name);
  if (without_view) profile.tells_view = false;
  return profile;
}

void add_without_view(CLI::App& command, bool& without_view) {
  command.add_flag("--no-field-of-view", without_view,
                   "Frames do not tell the field of view and what is occluded, as real networks' do not");
}

void add_traffic(CLI::App& command, std::string& traffic, const std::vector<std::string>& others) {
  std::vector<std::string> names = simulation::traffic_profile_names();
  names.insert(names.end(), others.begin(), others.end());
  command
      .add_option("--traffic", traffic, "Other vehicles, as a tracker of this profile tells; default: none")
      ->check(CLI::IsMember(std::move(names)));
}

void add_noise(CLI::App& command, NoiseOption& noise) {
  command.add_option("--noise", noise.name, "Noise profile of the detections")
      ->check(noise_name())
      ->capture_default_str();
  add_without_view(command, noise.without_view);
}

}  // namespace laneloom::commands
