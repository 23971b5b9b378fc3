# The compile commands that clang-tidy reads: of each source by itself.
#   cmake -C tools/presets/tidy.cmake -S . -B build-tidy -G Ninja
set(CMAKE_CXX_COMPILER clang++ CACHE STRING "")
set(LANELOOM_UNITY OFF CACHE BOOL "")
