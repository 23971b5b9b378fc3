# Writes OUT, a C++ source with the FILES (of PAGE_DIR) as texts.
#   cmake -D PAGE_DIR=… -D OUT=… -D FILES=index.html,main.js -P embed.cmake
cmake_minimum_required(VERSION 3.22)

set(entries "")
string(REPLACE "," ";" files "${FILES}")
foreach(file IN LISTS files)
  file(READ ${PAGE_DIR}/${file} text)
  string(REGEX REPLACE ".*\\." "" ending ${file})
  if(ending STREQUAL "html")
    set(type "text/html; charset=utf-8")
  elseif(ending STREQUAL "css")
    set(type "text/css; charset=utf-8")
  elseif(ending STREQUAL "js")
    set(type "text/javascript; charset=utf-8")
  else()
    message(FATAL_ERROR "${file}: of an unknown type")
  endif()
  string(APPEND entries "    {\"/${file}\", {\"${type}\", R\"page(${text})page\"}},\n")
endforeach()
file(WRITE ${OUT} "#include \"view/page.hpp\"

namespace laneloom::view {

const std::map<std::string, PageFile, std::less<>>& page_files() {
  static const std::map<std::string, PageFile, std::less<>> files{
${entries}  };
  return files;
}

}  // namespace laneloom::view
")
