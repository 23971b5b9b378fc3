#include "io/json_fields.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "base/unit_rotation.hpp"
#include "io/file_kind.hpp"
#include "io/json_not_finite.hpp"

namespace laneloom::io {
namespace {

using nlohmann::json;

constexpr double kMaxCoordinate_m = 1e7;

template <typename Enum, std::size_t N>
Enum named(const json& value, const std::array<const char*, N>& names) {
  const std::string word = text(value);
  for (std::size_t i = 0; i < N; ++i) {
    if (word == names[i]) return static_cast<Enum>(i);
  }
  std::string known;
  for (const char* candidate : names) known += (known.empty() ? "" : ", ") + std::string(candidate);
  throw JsonError("must be one of " + known);
}

}  // namespace

JsonError::JsonError(const std::string& key, const std::string& complaint, const std::string& detail)
    : std::runtime_error((key.empty() ? "" : key + ": ") + complaint + detail),
      key_(key),
      complaint_(complaint),
      detail_(detail) {}

JsonError JsonError::inside(const std::string& key) const {
  const bool joined = key_.empty() || key_.front() == '[';
  return {key + (joined ? "" : ".") + key_, complaint_, detail_};
}

std::string JsonError::reason() const {
  std::string reason;
  bool within_index = false;
  for (const char c : key_) {
    if (c == ']') within_index = false;
    if (!within_index) reason += c;
    if (c == '[') within_index = true;
  }
  return reason.empty() ? complaint_ : reason + ": " + complaint_;
}

std::string complaint_of(const json::exception& error) {
  std::string_view words = error.what();
  words = words.substr(0, words.find("; last read"));  // may be as long as the file
  for (const std::string_view before : {"] ", "parse error at "})
    if (const std::size_t at = words.find(before); at != std::string_view::npos)
      words.remove_prefix(at + before.size());
  return std::string(words);
}

json parse_json(std::string_view text) {
  const auto limit_depth = [](int depth, json::parse_event_t, const json&) {
    if (depth > kMaxJsonDepth) throw JsonError("is nested too deeply");
    return true;
  };
  const auto parse = [&](std::string_view written) {
    return json::parse(written.begin(), written.end(), limit_depth);
  };
  try {
    return parse(text);
  } catch (const json::exception&) {
    // It may be that a number that is not finite is all that is wrong.
  }
  try {
    return parse(quote_not_finite(text));
  } catch (const json::exception& error) {
    throw JsonError("", "is not JSON", ": " + complaint_of(error));
  }
}

json load_json(const std::filesystem::path& path) {
  if (const std::string kind = file_kind(path); !kind.empty())
    throw std::runtime_error(path.string() + ": " + kind + "; JSON is needed");
  std::ifstream in(path);
  std::ostringstream content;
  content << in.rdbuf();
  if (!in || !content) throw std::runtime_error(path.string() + ": cannot be read");
  return parse_json(content.view());
}

double number(const json& value) {
  if (value.is_string() && is_not_finite(value.get_ref<const std::string&>()))
    throw JsonError("must be finite");
  if (!value.is_number()) throw JsonError("must be a number");
  const auto result = value.get<double>();
  if (!std::isfinite(result)) throw JsonError("must be finite");
  return result;
}

double coordinate(const json& value) {
  const double result_m = number(value);
  if (!(std::abs(result_m) <= kMaxCoordinate_m)) throw JsonError("is too far away");
  return result_m;
}

std::int64_t integer(const json& value) {
  if (!value.is_number_integer()) throw JsonError("must be an integer");
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX) throw JsonError("is too large");
  return value.get<std::int64_t>();
}

std::uint64_t count(const json& value) {
  if (!value.is_number_unsigned()) throw JsonError("must be an integer that is not negative");
  return value.get<std::uint64_t>();
}

bool boolean(const json& value) {
  if (!value.is_boolean()) throw JsonError("must be true or false");
  return value.get<bool>();
}

std::string text(const json& value) {
  if (!value.is_string()) throw JsonError("must be a string");
  return value.get<std::string>();
}

const json* array(const json& value) {
  if (!value.is_array()) throw JsonError("must be an array");
  return &value;
}

Point point(const json& value) {
  if (!value.is_array() || value.size() != 3) throw JsonError("must be [x, y, z]");
  return {coordinate(value[0]), coordinate(value[1]), coordinate(value[2])};
}

Polyline polyline(const json& value) { return list(value, point); }

Polyline line(const json& value) {
  Polyline points = polyline(value);
  if (points.size() < 2) throw JsonError("must have at least two points");
  return points;
}

MarkingType marking_type(const json& value) { return named<MarkingType>(value, kTypeNames); }
MarkingStyle marking_style(const json& value) { return named<MarkingStyle>(value, kStyleNames); }
std::vector<double> numbers(const json& value) { return list(value, number); }

Eigen::Quaterniond quaternion(const json& value, std::size_t first) {
  const Eigen::Quaterniond q(number(value[first + 3]), number(value[first]), number(value[first + 1]),
                             number(value[first + 2]));
  if (!is_unit(q)) throw JsonError("must have a quaternion of unit length");
  return q.normalized();
}

json polyline_json(const Polyline& points) {
  json out = json::array();
  for (const Point& p : points) out.push_back({p.x(), p.y(), p.z()});
  return out;
}

}  // namespace laneloom::io
