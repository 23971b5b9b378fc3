# Precompiled headers: two thirds of the time to compile a file here goes into headers that all files share.
# A source still includes all that it uses: tools/tidy looks at each without them.
set(standard <algorithm> <array> <chrono> <cmath> <cstdint> <deque> <filesystem> <fstream> <functional> <limits> <map>
  <memory> <mutex> <numbers> <optional> <set> <span> <sstream> <stdexcept> <string> <string_view> <thread> <utility>
  <variant> <vector> <Eigen/Core> <Eigen/Geometry>)

# With the options of a folder: g++ takes those of the precompiled headers for what includes them, too.
function(precompile name folder links)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled/${name}.cpp CONTENT "")
  add_library(laneloom_precompiled_${name} OBJECT ${PROJECT_BINARY_DIR}/precompiled/${name}.cpp)
  target_link_libraries(laneloom_precompiled_${name} PRIVATE laneloom_types ${links})
  target_precompile_headers(laneloom_precompiled_${name} PRIVATE ${standard} ${ARGN})
  get_property(options DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} PROPERTY COMPILE_OPTIONS)
  set_target_properties(laneloom_precompiled_${name} PROPERTIES COMPILE_OPTIONS "${options}")
endfunction()

# Has all targets of a folder, and of the folders in it, use the precompiled headers, but those that use others, or that
# do not link what those headers need.
function(use_precompiled name folder needs)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(sources ${target} SOURCES)
    get_target_property(others ${target} PRECOMPILE_HEADERS_REUSE_FROM)
    get_target_property(links ${target} LINK_LIBRARIES)
    if(NOT others AND links MATCHES "${needs}" AND sources MATCHES "[.]cpp" AND NOT sources MATCHES "[.]c(;|$)")
      target_precompile_headers(${target} REUSE_FROM laneloom_precompiled_${name})
    endif()
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(inner IN LISTS folders)
    use_precompiled(${name} ${inner} "${needs}")
  endforeach()
endfunction()

precompile(mapping src/mapping "")
use_precompiled(mapping ${PROJECT_SOURCE_DIR}/src/mapping .)
precompile(service src "")
use_precompiled(service ${PROJECT_SOURCE_DIR}/src .)
if(LANELOOM_BUILD_PYTHON)
  precompile(python tools/python "pybind11::module;fmt::fmt" <fmt/format.h> <pybind11/numpy.h> <pybind11/pybind11.h>)
  # False alarms of g++ 12 within pybind11's headers.
  set_source_files_properties(${PROJECT_BINARY_DIR}/precompiled/python.cpp PROPERTIES COMPILE_OPTIONS -Wno-null-dereference)
  use_precompiled(python ${PROJECT_SOURCE_DIR}/tools/python .)
endif()
if(LANELOOM_BUILD_TOOLS)
  precompile(tools tools nlohmann_json::nlohmann_json <nlohmann/json.hpp>)
  use_precompiled(service ${PROJECT_SOURCE_DIR}/tools/evaluation .)  # optimised as src
  use_precompiled(tools ${PROJECT_SOURCE_DIR}/tools .)
endif()
if(LANELOOM_BUILD_TESTS)
  precompile(tests tests GTest::gmock <gmock/gmock.h> <gtest/gtest.h> <nlohmann/json.hpp>)
  use_precompiled(tests ${PROJECT_SOURCE_DIR}/tests GTest)
  use_precompiled(service ${PROJECT_SOURCE_DIR}/tests/fuzz .)
endif()
