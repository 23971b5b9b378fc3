# clang, with warnings as errors.
#   cmake -C tools/presets/clang.cmake -S . -B build-clang -G Ninja
set(CMAKE_CXX_COMPILER clang++ CACHE STRING "")
