#include "ros2/names.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/fnv.hpp"
#include "base/ros_name.hpp"
#include "ros2_type_hashes.hpp"

namespace laneloom::ros2 {
namespace {

constexpr std::string_view kInfix = "/msg/";

}  // namespace

std::string full_namespace(const Ros2Config& config) {
  return (config.ros_namespace.starts_with('/') ? "" : "/") + config.ros_namespace;
}

std::string full_node_name(const Ros2Config& config) { return full_ros_name(config, kNodeName); }

std::string dds_topic(const Ros2Config& config, const std::string& name) {
  return "rt" + full_ros_name(config, name);
}

std::string dds_type(std::string_view ros_type) {
  const auto infix = ros_type.find(kInfix);
  return std::string(ros_type.substr(0, infix)) +
         "::msg::dds_::" + std::string(ros_type.substr(infix + kInfix.size())) + "_";
}

std::string user_data(std::string_view ros_type) {
  const auto* const found =
      std::ranges::find(kTypeHashes, ros_type, [](const auto& entry) { return entry.first; });
  if (found == kTypeHashes.end()) throw std::out_of_range("no hash of " + std::string(ros_type));
  return "typehash=" + std::string(found->second) + ";";
}

std::uint64_t session_of(const dds::WriterId& writer) { return std::max<std::uint64_t>(fnv1a(writer), 1); }

}  // namespace laneloom::ros2
