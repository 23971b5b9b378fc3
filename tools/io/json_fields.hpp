#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/left_out.hpp"
#include "laneloom/element_names.hpp"
#include "laneloom/types.hpp"

/// Checked reading of JSON. A value that is missing, of another type, or not finite is an error that names
/// the key.
namespace laneloom::io {

/// An error in JSON. what() reads "detections[3].points: must be an array".
class JsonError : public std::runtime_error {
 public:
  /// `detail` is what differs between errors of one kind.
  JsonError(const std::string& key, const std::string& complaint, const std::string& detail = {});
  explicit JsonError(const std::string& complaint) : JsonError("", complaint) {}
  /// The same error, seen from the object or array around it.
  JsonError inside(const std::string& key) const;
  /// The kind of the error, the same for all elements of an array: "detections[].points: must be an array".
  std::string reason() const;

 private:
  std::string key_, complaint_, detail_;
};

/// Does `work`. What is wrong is left out, with `around` and `key` as its place. A JsonError of `work` passes
/// through if `left_out` is strict, as one inside of `key`. Returns whether `work` succeeded.
template <typename Work>
bool take_or_leave_out(LeftOut& left_out, const std::string& around, const std::string& key, Work work) {
  try {
    work();
    return true;
  } catch (const JsonError& error) {
    const JsonError inside = key.empty() ? error : error.inside(key);
    if (left_out.strict()) throw inside;
    left_out.add(inside.reason(), around + key);
    return false;
  }
}

constexpr int kMaxJsonDepth = 16;

/// Where a text is no JSON and why, in the words of the parser: "line 2, column 1: syntax error …".
std::string complaint_of(const nlohmann::json::exception& error);

/// Parses a text. Throws JsonError if it is not JSON, or is nested deeper than any of our formats.
nlohmann::json parse_json(std::string_view text);

/// Parses a file. Throws std::runtime_error naming the file if it cannot be read, or else as parse_json().
nlohmann::json load_json(const std::filesystem::path& path);

double number(const nlohmann::json& value);      ///< finite
double coordinate(const nlohmann::json& value);  ///< within 10 000 km, so that samples fit into memory
std::int64_t integer(const nlohmann::json& value);
std::uint64_t count(const nlohmann::json& value);  ///< an integer, not negative
bool boolean(const nlohmann::json& value);
std::string text(const nlohmann::json& value);
const nlohmann::json* array(const nlohmann::json& value);  ///< the value itself, never null
Point point(const nlohmann::json& value);                  ///< [x, y, z]
Polyline polyline(const nlohmann::json& value);            ///< [[x, y, z], …], possibly empty
Polyline line(const nlohmann::json& value);                ///< a polyline of at least two points
MarkingType marking_type(const nlohmann::json& value);
MarkingStyle marking_style(const nlohmann::json& value);
std::vector<double> numbers(const nlohmann::json& value);
/// x, y, z, w, from index `first` on.
Eigen::Quaterniond quaternion(const nlohmann::json& value, std::size_t first);

nlohmann::json polyline_json(const Polyline& points);

/// The elements of an array, each read by `read`.
template <typename Read>
auto list(const nlohmann::json& value, Read read) {
  if (!value.is_array()) throw JsonError("must be an array");
  std::vector<std::invoke_result_t<Read, const nlohmann::json&>> out;
  out.reserve(value.size());
  for (std::size_t i = 0; i < value.size(); ++i) {
    try {
      out.push_back(read(value[i]));
    } catch (const JsonError& error) {
      throw error.inside("[" + std::to_string(i) + "]");
    }
  }
  return out;
}

/// A member of an object, read by `read`. None: it is absent or null.
template <typename Read>
auto optional(const nlohmann::json& object, const char* key, Read read)
    -> std::optional<std::invoke_result_t<Read, const nlohmann::json&>> {
  if (!object.is_object()) throw JsonError("must be an object");
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return std::nullopt;
  try {
    return read(*found);
  } catch (const JsonError& error) {
    throw error.inside(key);
  }
}

/// A member of an object, which must be there.
template <typename Read>
auto required(const nlohmann::json& object, const char* key, Read read) {
  auto value = optional(object, key, read);
  if (!value) throw JsonError(key, "is missing");
  return *std::move(value);
}

}  // namespace laneloom::io
