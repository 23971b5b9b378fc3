"""Packs the sources as a source distribution of the Python package: make_sdist.py SOURCE OUT_DIR. Needs Python's standard library alone.

The archive has a pyproject.toml, which this script writes. It prints the archive's path."""
import gzip
import io
import pathlib
import re
import sys
import tarfile

PARTS = ["CMakeLists.txt", "README.md", "config", "deploy", "idl", "include", "src", "tools"]
PYPROJECT = """# pip builds with CMake and the libraries of the system, and asks no registry for tools.
[build-system]
requires = []
build-backend = "build_backend"
backend-path = ["tools/python"]

[project]
name = "laneloom"
version = "{version}"
description = "Fuses road-marking detections into a lane map, and rates both"
requires-python = ">=3.11"
dependencies = ["numpy"]
"""
PKG_INFO = """Metadata-Version: 2.1
Name: laneloom
Version: {version}
"""


def version(source: pathlib.Path) -> str:
    """The version that CMake gives the project."""
    return re.search(r"project\(laneloom VERSION ([0-9.]+)", (source / "CMakeLists.txt").read_text())[1]


def files_of(source: pathlib.Path) -> dict[str, pathlib.Path]:
    parts = [source / part for part in PARTS]
    files = [file for part in parts for file in ([part] if part.is_file() else part.rglob("*"))]
    return {str(file.relative_to(source)): file for file in sorted(files) if file.is_file() and "__pycache__" not in file.parts}


def pack(source: pathlib.Path, out: pathlib.Path) -> pathlib.Path:
    """Writes the archive. The same sources give the same bytes."""
    root = f"laneloom-{version(source)}"
    texts = {"pyproject.toml": PYPROJECT, "PKG-INFO": PKG_INFO}
    contents = {name: (text.format(version=version(source)).encode(), 0o644) for name, text in texts.items()}
    for name, file in files_of(source).items():
        contents[name] = (file.read_bytes(), 0o755 if file.stat().st_mode & 0o100 else 0o644)
    out.mkdir(parents=True, exist_ok=True)
    path = out / f"{root}.tar.gz"
    with open(path, "wb") as raw, gzip.GzipFile("", "wb", mtime=0, fileobj=raw) as packed, tarfile.open(fileobj=packed, mode="w") as archive:
        for name, (content, mode) in contents.items():
            entry = tarfile.TarInfo(f"{root}/{name}")
            entry.size, entry.mode = len(content), mode
            archive.addfile(entry, io.BytesIO(content))
    return path


if __name__ == "__main__":
    print(pack(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])))
