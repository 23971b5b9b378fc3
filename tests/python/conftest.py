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


def ways(folder, scenario, duration, wish):
    """The ways along a road that is seen without noise."""
    file, mapper = folder / "road.frames.jsonl", laneloom.Mapper()
    run("simulate", "--scenario", scenario, "--duration", duration, "--frames", file)
    made = (laneloom.way_ahead(mapper.update(frame, pose), wish) for frame, pose in laneloom.read_frames(file))
    return [way for way in made if way]


@pytest.fixture(scope="session")
def changing(tmp_path_factory):
    """A way that changes to the lane on the left."""
    return next(way for way in ways(tmp_path_factory.mktemp("changing"), "motorway", 5, "change_left") if way.change)


@pytest.fixture(scope="session")
def turning(tmp_path_factory):
    """A way that turns left at an intersection."""
    made = ways(tmp_path_factory.mktemp("turning"), "intersection", 12, "left")
    return next(way for way in made if any(lane.entry == "left" for lane in way.lanes))
