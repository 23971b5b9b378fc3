#include "simulation/map_file.hpp"

#include <stdexcept>

#include "io/file_kind.hpp"

namespace laneloom::simulation {

MapFile::MapFile(const std::filesystem::path& file, const char* root, const std::string& needed,
                 LeftOut& left_out) {
  if (const std::string kind = io::file_kind(file); !kind.empty() && kind != io::kXml && kind != io::kUtf16)
    throw std::runtime_error(kind + "; " + needed + " is needed");
  const pugi::xml_parse_result result = document_.load_file(file.c_str());
  root_ = document_.child(root);
  is_whole_ = result;
  const auto leave_out = [&](const std::string& what, const std::string& complaint, std::ptrdiff_t offset) {
    const std::string place = "byte " + std::to_string(offset);
    if (!root_ || left_out.strict()) throw std::runtime_error(complaint + " at " + place);
    left_out.add(what, place);
  };
  if (!is_whole_)
    leave_out("the rest of the file, which is damaged or cut off", result.description(), result.offset);
  if (!root_) throw std::runtime_error(std::string("has no element ") + root + "; " + needed + " is needed");
  if (const pugi::xml_node second = root_.next_sibling(root))
    leave_out("the rest of the file, which is a second map", "has a second map", second.offset_debug());
}

}  // namespace laneloom::simulation
