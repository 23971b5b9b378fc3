# The compile commands that clang-tidy reads.
#   cmake -C tools/presets/tidy.cmake -S . -B build-tidy -G Ninja
set(CMAKE_CXX_COMPILER clang++ CACHE STRING "")
