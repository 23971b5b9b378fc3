#pragma once

#include <filesystem>
#include <pugixml.hpp>
#include <string>

#include "base/left_out.hpp"

namespace laneloom::simulation {

/// A map in XML, read up to the place where the file is damaged. What follows is left out.
class MapFile {
 public:
  /// `needed` tells which kind of file is needed. Throws std::runtime_error if the file is of another kind,
  /// if it has no element `root`, and if it is not whole and `left_out` is strict.
  MapFile(const std::filesystem::path& file, const char* root, const std::string& needed, LeftOut& left_out);

  const pugi::xml_node& root() const { return root_; }
  /// False: the file is damaged or cut off.
  bool is_whole() const { return is_whole_; }

 private:
  pugi::xml_document document_;
  pugi::xml_node root_;
  bool is_whole_ = true;
};

}  // namespace laneloom::simulation
