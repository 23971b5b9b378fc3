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
  const std::string place = "byte " + std::to_string(result.offset);
  if (!is_whole_ && (!root_ || left_out.strict()))
    throw std::runtime_error(std::string(result.description()) + " at " + place);
  if (!root_) throw std::runtime_error(std::string("has no element ") + root + "; " + needed + " is needed");
  if (!is_whole_) left_out.add("the rest of the file, which is damaged or cut off", place);
}

}  // namespace laneloom::simulation
