#include "io/json_stream.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/json_fields.hpp"
#include "io/json_not_finite.hpp"
#include "io/share_read.hpp"

namespace laneloom::io {
namespace {

using nlohmann::json;
using Event = json::parse_event_t;

using Visit = std::function<void(const std::string& name, const json& value)>;

/// The kind of the container that holds the elements.
enum class Container : std::uint8_t { array, object };

/// Follows the parser: hands on the container's elements, and keeps nothing of the file.
class ElementVisitor {
 public:
  ElementVisitor(const std::string& key, Container container, const Visit& visit)
      : key_(key),
        container_(container),
        visit_(visit),
        depth_(key.empty() ? 0 : 1),
        in_member_(key.empty()) {}

  /// Takes an event of the parser. Returns whether the parser should keep the value.
  bool operator()(int depth, Event event, const json& value) {
    if (depth > kMaxJsonDepth) throw JsonError("is nested too deeply");
    if (event == Event::key && depth == 1 && depth_ == 1) return in_member_ = value == key_;
    if (!in_member_) return depth == 0;
    if (depth == depth_) check_container(event);
    if (depth == depth_ + 1) return on_element(event, value);
    return true;
  }

  bool found() const { return found_; }
  /// The element that is read.
  std::string where() const {
    return key_ + (container_ == Container::array ? "[" + std::to_string(index_) + "]" : "." + name_);
  }
  const char* expected() const {
    return container_ == Container::array ? "must be an array" : "must be an object";
  }

 private:
  void check_container(Event event) {
    const bool array = event == Event::array_start || event == Event::array_end;
    const bool object = event == Event::object_start || event == Event::object_end;
    if (container_ == Container::array ? !array : !object) throw JsonError(key_, expected());
    found_ = true;
  }

  bool on_element(Event event, const json& value) {
    if (event == Event::key) name_ = value.get<std::string>();
    if (event == Event::object_start || event == Event::array_start || event == Event::key) return true;
    try {
      visit_(name_, value);
    } catch (const JsonError& error) {
      throw error.inside(where());
    }
    ++index_;
    return false;
  }

  std::string key_;
  Container container_;
  const Visit& visit_;
  int depth_;  ///< depth of the container, as the parser counts
  bool in_member_;
  bool found_ = false;
  std::size_t index_ = 0;
  std::string name_;  ///< name of the element, if the container is an object
};

void for_each_element(const std::filesystem::path& path, const std::string& key, Container container,
                      const Visit& visit, const std::function<void(double share)>& on_step) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  const ShareRead share(file, path);
  NotFiniteQuoter quoter(*file.rdbuf());
  std::istream in(&quoter);
  const Visit visit_and_tell = [&](const std::string& name, const json& value) {
    visit(name, value);
    on_step(share.now());
  };
  ElementVisitor visitor(key, container, visit_and_tell);
  try {
    const json rest = json::parse(
        in, [&](int depth, Event event, const json& value) { return visitor(depth, event, value); });
    if (!visitor.found()) throw JsonError(key, key.empty() ? visitor.expected() : "is missing");
  } catch (const JsonError& error) {
    const std::string complaint = path.string() + ": " + error.what();
    if (!visitor.found()) throw OtherJson(complaint);
    throw std::runtime_error(complaint);
  } catch (const json::exception& error) {
    throw DamagedJson(path.string() + ": is not JSON: " + complaint_of(error), visitor.where());
  }
}

}  // namespace

void for_each_json_element(const std::filesystem::path& path, const std::string& key,
                           const std::function<void(const json&)>& visit,
                           const std::function<void(double share)>& on_step) {
  for_each_element(
      path, key, Container::array, [&](const std::string& /*name*/, const json& value) { visit(value); },
      on_step);
}

void for_each_json_member(const std::filesystem::path& path, const std::string& key,
                          const std::function<void(const std::string&, const json&)>& visit,
                          const std::function<void(double share)>& on_step) {
  for_each_element(path, key, Container::object, visit, on_step);
}

}  // namespace laneloom::io
