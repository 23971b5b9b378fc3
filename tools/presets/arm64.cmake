# For arm64, on a Debian of another processor (tools/setup arm64). What is built prints its own completions and manual
# pages: under qemu.
#   cmake -C tools/presets/arm64.cmake -S . -B build-packages-arm64 -G Ninja
set(CMAKE_SYSTEM_NAME Linux CACHE STRING "")
set(CMAKE_SYSTEM_PROCESSOR aarch64 CACHE STRING "")
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc CACHE STRING "")
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++ CACHE STRING "")
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 CACHE STRING "")
set(PKG_CONFIG_EXECUTABLE aarch64-linux-gnu-pkg-config CACHE STRING "")
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64 CACHE STRING "")
set(LANELOOM_BUILD_TESTS OFF CACHE BOOL "")
set(LANELOOM_BUILD_PYTHON OFF CACHE BOOL "")
