#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <sstream>
#include <utility>

#include "config/config_file.hpp"
#include "read_text.hpp"
#include "schema.hpp"
#include "validate.hpp"

namespace laneloom::config {
namespace {

/// A problem, with its line in the file. Line 0: it is not known.
struct LocatedProblem {
  int line = 0;
  Problem problem;
};

int line_of(const YAML::Node& node) { return node.Mark().line + 1; }

/// Fills a table from one YAML map. Throws LocatedProblem.
class Parser {
 public:
  using Lines = std::map<std::string, int>;

  /// Notes the line of each key in `lines`.
  Parser(const YAML::Node& node, std::string prefix, Lines& lines)
      : prefix_(std::move(prefix)), lines_(lines) {
    if (!node.IsMap()) fail(line_of(node), prefix_, "is not a map of keys and values");
    for (const auto& entry : node) {
      const int line = line_of(entry.first);
      if (!entry.first.IsScalar()) fail(line, prefix_, "has a key that is not a plain word");
      const auto& key = entry.first.Scalar();
      if (!values_.emplace(key, entry.second).second) fail(line, prefix_ + key, "is given twice");
      lines_[prefix_ + key] = line;
    }
  }

  template <class C>
  void section(const char* key, C& child, const char* /*meaning*/) {
    if (const auto value = take(key)) {
      Parser inner(value, prefix_ + key + ".", lines_);
      visit(inner, child);
      inner.finish();
    }
  }
  template <class T>
  void number(const char* key, T& value, const Limits& limits, const char* /*meaning*/) {
    const bool whole = std::same_as<T, int>;
    read(key, value,
         std::string(whole ? "a whole number" : "a number") +
             (*limits.unit ? std::string(" in ") + limits.unit : ""));
  }
  void flag(const char* key, bool& value, const char* /*meaning*/) { read(key, value, "true or false"); }
  void choice(const char* key, std::string& value, const char* choices, const char* /*meaning*/) {
    read(key, value, std::string("one of ") + choices);
    if (!is_choice(choices, value))
      fail(line_at(key), prefix_ + key, "\"" + value + "\" is none of " + choices);
  }
  void identifier(const char* key, std::string& value, const char* /*meaning*/) {
    read(key, value, "a name");
  }
  void path(const char* key, std::string& value, const char* /*meaning*/) { read(key, value, "a text"); }

  /// Is to be called after every known key was visited. Refuses keys that are left.
  void finish() const {
    if (values_.empty()) return;
    const auto key = prefix_ + values_.begin()->first;
    fail(lines_.at(key), key, "is not a known key");
  }

 private:
  [[noreturn]] static void fail(int line, const std::string& key, const std::string& what) {
    throw LocatedProblem{line, {key.ends_with('.') ? key.substr(0, key.size() - 1) : key, what}};
  }

  /// The line of a key. 0: the key is missing.
  int line_at(const std::string& key) const {
    const auto line = lines_.find(prefix_ + key);
    return line == lines_.end() ? 0 : line->second;
  }

  /// Takes out the value of a key. Undefined: the key is missing.
  YAML::Node take(const std::string& key) {
    const auto entry = values_.extract(key);
    return entry ? entry.mapped() : YAML::Node(YAML::NodeType::Undefined);
  }

  template <class T>
  void read(const std::string& key, T& value, const std::string& expected) {
    const auto node = take(key);
    if (!node) return;
    try {
      if (!node.IsScalar()) throw YAML::Exception(node.Mark(), "");
      value = node.as<T>();
    } catch (const YAML::Exception&) {
      fail(lines_.at(prefix_ + key), prefix_ + key, "is not " + expected);
    }
  }

  std::string prefix_;
  Lines& lines_;
  std::map<std::string, YAML::Node> values_;
};

/// Throws LocatedProblem where a second document has something in it.
class OneDocument : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {}
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override { take(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                const std::string& /*value*/) override {
    take(mark);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                       YAML::EmitterStyle::value /*style*/) override {
    take(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override {
    take(mark);
  }
  void OnMapEnd() override {}

  bool is_empty() const { return is_empty_; }
  void next() {
    ++documents_;
    is_empty_ = true;
  }

 private:
  void take(const YAML::Mark& mark) {
    if (documents_ > 1)
      throw LocatedProblem{mark.line + 1, {"", "begins a second document, and there may be one"}};
    is_empty_ = false;
  }

  int documents_ = 0;
  bool is_empty_ = true;
};

/// YAML::LoadAll() would tell of the second document, but of some damaged texts it makes documents without
/// end.
void refuse_second_document(const std::string& text) {
  std::istringstream in(text);
  YAML::Parser parser(in);
  OneDocument handler;
  for (handler.next(); parser.HandleNextDocument(handler); handler.next())
    if (handler.is_empty() && parser)
      throw LocatedProblem{0, {"", "bad YAML: something stands outside of its document"}};
}

/// The values of a tree, on top of `config`.
Config read_tree(const YAML::Node& root, Config config = {}) {
  Parser::Lines lines;
  if (!root.IsNull()) {
    Parser parser(root, "", lines);
    visit(parser, config);
    parser.finish();
  }
  if (const auto problem = find_problem(config)) {
    const auto line = lines.find(problem->key);
    throw LocatedProblem{line == lines.end() ? 0 : line->second, *problem};
  }
  return config;
}

/// The values of `text`, on top of `config`.
Config parse(const std::string& text, Config config = {}) {
  try {
    refuse_second_document(text);
    return read_tree(YAML::Load(text), std::move(config));
  } catch (const YAML::Exception& error) {
    throw LocatedProblem{error.mark.is_null() ? 0 : error.mark.line + 1, {"", "bad YAML: " + error.msg}};
  }
}

/// Puts a value into a tree, at a key with dots.
void put(YAML::Node at, std::string_view key, const std::string& value) {
  for (auto dot = key.find('.'); dot != std::string_view::npos; dot = key.find('.')) {
    at.reset(at[std::string(key.substr(0, dot))]);
    key.remove_prefix(dot + 1);
  }
  at[std::string(key)] = value;
}

/// Calls `make`. What it finds wrong is told with the name of the place where the text is from.
template <class Make>
Config located_in(std::string where, const Make& make) {
  try {
    return make();
  } catch (const LocatedProblem& error) {
    if (error.line > 0) where += ":" + std::to_string(error.line);
    if (!error.problem.key.empty()) where += ": " + error.problem.key;
    throw ConfigError(where + ": " + error.problem.what);
  }
}

}  // namespace

Config load_config(const std::filesystem::path& path) {
  return located_in(path.string(), [&] { return parse(read_text(path)); });
}

Config parse_config(const std::string& text, const std::string& name) {
  return located_in(name, [&] { return parse(text); });
}

Config from_settings(const std::vector<std::pair<std::string, std::string>>& settings,
                     const std::string& name) {
  return located_in(name, [&] {
    YAML::Node root(YAML::NodeType::Map);
    for (const auto& [key, value] : settings) {
      try {
        put(root, key, value);
      } catch (const YAML::Exception&) {
        throw LocatedProblem{0, {key, "is both a value and a section"}};
      }
    }
    return read_tree(root);
  });
}

Config resolve_config(const std::filesystem::path& file, std::string_view preset) {
  Config config = file.empty() ? Config{} : load_config(file);
  if (!preset.empty()) apply_preset(config, preset);
  return config;
}

void set_value(Config& config, std::string_view assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string_view::npos)
    throw ConfigError(std::string(assignment) + ": is not of the form section.key=value");
  std::string text(assignment.substr(equals + 1));
  for (std::string_view key = assignment.substr(0, equals);;) {
    const auto dot = key.rfind('.');
    std::string map = "{";
    map.append(key.substr(dot == std::string_view::npos ? 0 : dot + 1)).append(": ").append(text).append("}");
    text = std::move(map);
    if (dot == std::string_view::npos) break;
    key = key.substr(0, dot);
  }
  try {
    config = parse(text, config);
  } catch (const LocatedProblem& error) {
    throw ConfigError(std::string(assignment) + ": " + error.problem.key + " " + error.problem.what);
  }
}

}  // namespace laneloom::config
