#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <utility>
#include <vector>

#include "base/fnv.hpp"
#include "config/config_file.hpp"
#include "schema.hpp"
#include "text.hpp"

namespace laneloom::config {
namespace {

/// A text as lines of a comment.
std::string comment(const std::string& text, std::size_t indent) {
  constexpr std::size_t kColumns = 110;
  const std::string begin = std::string(indent, ' ') + "#";
  std::string lines, line = begin;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (line.size() + 1 + word.size() > kColumns) lines += std::exchange(line, begin) + "\n";
    line += " " + word;
  }
  return lines + line + "\n";
}

/// Writes the tables as YAML, each key below its meaning.
class Dump {
 public:
  template <class C>
  void section(const char* key, const C& child, const char* meaning) {
    text += "\n" + comment(meaning, indent_) + std::string(indent_, ' ') + key + ":\n";
    indent_ += 2;
    visit(*this, child);
    indent_ -= 2;
  }
  void number(const char* key, double value, const Limits& limits, const char* meaning) {
    const std::string unit = *limits.unit ? std::string(limits.unit) + ", " : "";
    line(key, to_text(value), unit + range_text(limits.min, limits.max), meaning);
  }
  void flag(const char* key, bool value, const char* meaning) {
    line(key, value ? "true" : "false", "true or false", meaning);
  }
  void choice(const char* key, const std::string& value, const char* choices, const char* meaning) {
    line(key, value, choices, meaning);
  }
  void identifier(const char* key, const std::string& value, const char* meaning) {
    line(key, quoted(value), "a name", meaning);
  }
  void path(const char* key, const std::string& value, const char* meaning) {
    line(key, quoted(value), "may be empty", meaning);
  }

  std::string text;

 private:
  static std::string quoted(const std::string& value) {
    std::string result = "'";
    for (const char c : value) result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
  }
  void line(const char* key, const std::string& value, const std::string& limits, const char* meaning) {
    text += comment(meaning, indent_);
    text += std::string(indent_, ' ') + key + ": " + value + "  # " + limits + "\n";
  }

  std::size_t indent_ = 0;
};

/// Every key with its value.
class List {
 public:
  template <class C>
  void section(const char* key, const C& child, const char* /*meaning*/) {
    const auto outer = std::exchange(prefix_, prefix_ + key + ".");
    visit(*this, child);
    prefix_ = outer;
  }
  void number(const char* key, double number, const Limits& /*limits*/, const char* /*meaning*/) {
    add(key, to_text(number));
  }
  void flag(const char* key, bool flag, const char* /*meaning*/) { add(key, flag ? "true" : "false"); }
  void choice(const char* key, const std::string& content, const char* /*choices*/, const char* /*meaning*/) {
    add(key, content);
  }
  void identifier(const char* key, const std::string& content, const char* /*meaning*/) { add(key, content); }
  void path(const char* key, const std::string& content, const char* /*meaning*/) { add(key, content); }

  std::vector<std::pair<std::string, std::string>> values;

 private:
  void add(const char* key, std::string value) { values.emplace_back(prefix_ + key, std::move(value)); }

  std::string prefix_;
};

List list(const Config& config) {
  List result;
  visit(result, config);
  return result;
}

}  // namespace

std::string dump(const Config& config) {
  Dump result;
  visit(result, config);
  return result.text;
}

std::vector<std::pair<std::string, std::string>> settings(const Config& config) {
  return list(config).values;
}

std::vector<std::string> changed_keys(const Config& before, const Config& after) {
  const auto old_values = list(before).values;
  auto new_values = list(after).values;
  std::vector<std::string> result;
  for (std::size_t i = 0; i < new_values.size(); ++i) {
    if (new_values[i] != old_values[i]) result.push_back(std::move(new_values[i].first));
  }
  return result;
}

std::string config_hash(const Config& config) {
  std::string bytes;
  for (const auto& [key, value] : settings(config))
    bytes.append(key).append(1, '\0').append(value).append(1, '\0');
  std::ostringstream text;
  text << std::hex << std::setfill('0') << std::setw(16) << fnv1a(bytes);
  return text.str();
}

}  // namespace laneloom::config
