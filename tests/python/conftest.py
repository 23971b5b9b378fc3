"""Files of a simulated drive, which all tests share."""
import os
import subprocess
from types import SimpleNamespace

import pytest

import laneloom


def run(*arguments):
    """Runs the program `laneloom`."""
    return subprocess.run([os.environ["LANELOOM"], *map(str, arguments)], check=True, capture_output=True, text=True)


@pytest.fixture(scope="session")
def drive(tmp_path_factory):
    folder = tmp_path_factory.mktemp("drive")
    files = SimpleNamespace(folder=folder, frames=folder / "road.frames.jsonl", truth=folder / "road.truth.json")
    run("simulate", "--scenario", "intersection", "--noise", "inhouse", "--duration", 8, "--frames", files.frames,
        "--truth", files.truth)
    return files


@pytest.fixture(scope="session")
def frames(drive):
    return laneloom.read_frames(drive.frames)


@pytest.fixture(scope="session")
def truth(drive):
    return laneloom.Truth.load(drive.truth)


@pytest.fixture(scope="session")
def maps(frames):
    mapper = laneloom.Mapper()
    return [mapper.update(frame, pose) for frame, pose in frames]
