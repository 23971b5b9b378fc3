#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace laneloom::io {

/// A file that is not JSON, or is cut off.
class DamagedJson : public std::runtime_error {
 public:
  DamagedJson(const std::string& complaint, std::string where)
      : std::runtime_error(complaint), where_(std::move(where)) {}
  const std::string& where() const { return where_; }  ///< the element that could not be read

 private:
  std::string where_;
};

/// JSON without the array or the object that is looked for.
class OtherJson : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Calls visit(element) for every element of an array in a JSON file, one after the other, so that a large
/// array need not fit into memory. The array is the whole file, or with a `key` the root object's member of
/// that name. NaN and Infinity, or nan and inf, are read as texts. Throws std::runtime_error naming the file
/// if it cannot be read, OtherJson if it has no such array, and DamagedJson if it is not JSON. Adds file and
/// index of the element to a JsonError that visit() throws. Calls on_step() after each element with the share
/// of the file that was read, 0..1.
void for_each_json_element(
    const std::filesystem::path& path, const std::string& key,
    const std::function<void(const nlohmann::json&)>& visit,
    const std::function<void(double share)>& on_step = [](double /*share*/) {});

/// Does the same for an object, which is the root object's member `key`: calls visit(name, value) for its
/// members.
void for_each_json_member(
    const std::filesystem::path& path, const std::string& key,
    const std::function<void(const std::string&, const nlohmann::json&)>& visit,
    const std::function<void(double share)>& on_step = [](double /*share*/) {});

}  // namespace laneloom::io
