"""Builds the Python package for pip (PEP 517), in the folder of an unpacked source distribution: with CMake, Ninja and Debian's libraries."""
import pathlib
import subprocess
import sys

import make_sdist
import make_wheel

SOURCE = pathlib.Path(".")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    build = SOURCE / "build"
    options = ["-DLANELOOM_BUILD_TESTS=OFF", "-DLANELOOM_BUILD_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}"]
    subprocess.run(["cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", *options], check=True)
    subprocess.run(["cmake", "--build", build, "--target", "laneloom_python"], check=True)
    return make_wheel.pack(build / "tools/python/laneloom", make_sdist.version(SOURCE), pathlib.Path(wheel_directory)).name


def build_sdist(sdist_directory, config_settings=None):
    return make_sdist.pack(SOURCE, pathlib.Path(sdist_directory)).name
