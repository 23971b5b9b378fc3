#pragma once

#include <functional>
#include <map>
#include <string>

namespace laneloom::view {

/// One file of the page.
struct PageFile {
  std::string type;  ///< of HTTP's Content-Type
  std::string text;
};

/// The viewer's page and its modules, by path: "/index.html".
const std::map<std::string, PageFile, std::less<>>& page_files();

}  // namespace laneloom::view
