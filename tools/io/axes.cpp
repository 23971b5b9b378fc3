#include "io/axes.hpp"

#include <map>
#include <sstream>
#include <stdexcept>

namespace laneloom::io {

Eigen::Matrix3d axes_named(const std::string& name) {
  static const std::map<std::string, Eigen::Vector3d> kDirections{
      {"forward", Eigen::Vector3d::UnitX()}, {"backward", -Eigen::Vector3d::UnitX()},
      {"left", Eigen::Vector3d::UnitY()},    {"right", -Eigen::Vector3d::UnitY()},
      {"up", Eigen::Vector3d::UnitZ()},      {"down", -Eigen::Vector3d::UnitZ()}};
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  std::istringstream words(name);
  Eigen::Index count = 0;
  for (std::string word; count < 3 && std::getline(words, word, '-'); ++count) {
    const auto direction = kDirections.find(word);
    if (direction == kDirections.end()) throw std::invalid_argument("'" + word + "' is no direction");
    axes.col(count) = direction->second;
  }
  if (count == 2) axes.col(2) = Eigen::Vector3d::UnitZ();
  if (!words.eof() || name.ends_with('-') || count < 2 || axes.determinant() == 0.0)
    throw std::invalid_argument("'" + name + "' names no axes: such are forward-left or right-down-forward");
  return axes;
}

const std::vector<std::string>& axes_names() {
  static const std::vector<std::string> kNames{"forward-left",  "right-forward",  "forward-right",
                                               "left-forward",  "backward-right", "backward-left",
                                               "left-backward", "right-backward", "right-down-forward"};
  return kNames;
}

}  // namespace laneloom::io
