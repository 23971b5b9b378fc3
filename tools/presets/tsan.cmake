# Thread sanitizer.
#   cmake -C tools/presets/tsan.cmake -S . -B build-tsan -G Ninja
set(LANELOOM_SANITIZE thread CACHE STRING "")
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
set(CMAKE_CXX_FLAGS -O1 CACHE STRING "")
