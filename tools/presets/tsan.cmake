# Thread sanitizer.
#   cmake -C tools/presets/tsan.cmake -S . -B build-tsan -G Ninja
set(LANELOOM_SANITIZE thread CACHE STRING "")
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
# gcc 12 warns of uninitialised variables within its own std::regex where sanitizers are on.
# It also warns that its thread sanitizer does not follow fences, of which Boost.Asio has some.
set(CMAKE_CXX_FLAGS "-O1 -Wno-maybe-uninitialized -Wno-tsan" CACHE STRING "")
