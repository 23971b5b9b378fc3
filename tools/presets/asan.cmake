# Address and undefined-behaviour sanitizers.
#   cmake -C tools/presets/asan.cmake -S . -B build-asan -G Ninja
set(LANELOOM_SANITIZE address,undefined CACHE STRING "")
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
set(CMAKE_CXX_FLAGS -O1 CACHE STRING "")
