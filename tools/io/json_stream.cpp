#include "io/json_stream.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/json_fields.hpp"

namespace laneloom {
namespace {

using nlohmann::json;
using Event = json::parse_event_t;

constexpr int kMaxDepth = 16;

/// Follows the parser: hands on the array's elements, and keeps nothing of the file.
class ElementVisitor {
 public:
  ElementVisitor(const std::string& key, const std::function<void(const json&)>& visit)
      : key_(key), visit_(visit), array_depth_(key.empty() ? 0 : 1), in_member_(key.empty()) {}

  /// Whether the parser is to keep the value.
  bool operator()(int depth, Event event, const json& value) {
    if (depth > kMaxDepth) throw JsonError("is nested too deeply");
    if (event == Event::key && depth == 1 && array_depth_ == 1) return in_member_ = value == key_;
    if (!in_member_) return depth == 0;
    if (depth == array_depth_) check_array(event);
    if (depth == array_depth_ + 1) return on_element(event, value);
    return true;
  }

  bool found() const { return found_; }

 private:
  void check_array(Event event) {
    if (event != Event::array_start && event != Event::array_end)
      throw JsonError(key_, "must be an array of objects");
    found_ = true;
  }

  bool on_element(Event event, const json& value) {
    if (event == Event::object_start) return true;
    if (event != Event::object_end) throw JsonError(key_, "must be an array of objects");
    try {
      visit_(value);
    } catch (const JsonError& error) {
      throw error.inside(key_ + "[" + std::to_string(index_) + "]");
    }
    ++index_;
    return false;
  }

  std::string key_;
  const std::function<void(const json&)>& visit_;
  int array_depth_;  ///< as the parser counts
  bool in_member_;
  bool found_ = false;
  std::size_t index_ = 0;
};

}  // namespace

void for_each_json_object(const std::filesystem::path& path, const std::string& key,
                          const std::function<void(const json&)>& visit) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path.string() + ": cannot be read");
  ElementVisitor visitor(key, visit);
  try {
    const json rest = json::parse(
        in, [&](int depth, Event event, const json& value) { return visitor(depth, event, value); });
    if (!visitor.found()) throw JsonError(key, key.empty() ? "must be an array of objects" : "is missing");
  } catch (const JsonError& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  } catch (const json::exception& error) {
    throw std::runtime_error(path.string() + ": is not JSON: " + error.what());
  }
}

}  // namespace laneloom
