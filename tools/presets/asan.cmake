# Address and undefined-behaviour sanitizers.
#   cmake -C tools/presets/asan.cmake -S . -B build-asan -G Ninja
set(LANELOOM_SANITIZE address,undefined CACHE STRING "")
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
# gcc 12 warns of uninitialised variables within its own std::regex where sanitizers are on.
set(CMAKE_CXX_FLAGS "-O1 -Wno-maybe-uninitialized" CACHE STRING "")
