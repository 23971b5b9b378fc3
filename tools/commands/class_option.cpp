#include "commands/class_option.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "laneloom/element_names.hpp"

namespace laneloom::commands {
namespace {

void set_class(const std::string& word, io::Classes& classes) {
  const std::size_t equals = word.rfind('=');
  const std::string type = equals == std::string::npos ? "" : word.substr(equals + 1);
  const auto* const known = std::ranges::find(kTypeNames, type);
  if (equals == 0 || (known == kTypeNames.end() && type != "none"))
    throw CLI::ValidationError("--class", word + ": needs NAME=laneline, roadedge, stopline or none");
  std::optional<MarkingType>& becomes = classes[word.substr(0, equals)];
  becomes.reset();
  if (type != "none") becomes = static_cast<MarkingType>(known - kTypeNames.begin());
}

}  // namespace

CLI::Option* add_classes(CLI::App& command, io::Classes& classes) {
  const auto set = [&classes](const std::vector<std::string>& words) {
    for (const std::string& word : words) set_class(word, classes);
  };
  return command
      .add_option_function<std::vector<std::string>>(
          "--class", set,
          "Type that lines of a class become: laneline, roadedge, stopline or none; once for each class")
      ->type_name("NAME=TYPE");
}

}  // namespace laneloom::commands
