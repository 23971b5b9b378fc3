"""What is written is read back, by this module and by the program."""
import numpy as np
import pytest

import laneloom
from conftest import run
from laneloom import Detection, Frame, Objects, Pose, TrackedObject


def made_frames():
    line = np.array([[0.0, 1.5, 0.1], [7.0, 1.6, 0.2], [20.0, 2.0, 0.3]])
    frames = []
    for i in range(1, 6):
        detection = Detection("roadedge", line, 0.75, "solid", [0.1, 0.2, 0.3])
        frame = Frame(i * 100_000_000, [detection], "camera", detected_types=["roadedge"], field_of_view=line * 2,
                      occluded_areas=[line], sequence=i, session_id=9)
        frames.append((frame, Pose([float(i), 2, 3], [0, 0, 0.6, 0.8], i * 100_000_000)))
    return frames


@pytest.mark.parametrize("name", ["a.frames.jsonl", "a.mcap"])
def test_frames(tmp_path, name):
    written = made_frames()
    laneloom.write_frames(tmp_path / name, written)
    read = laneloom.read_frames(str(tmp_path / name))
    if name.endswith(".mcap"):
        written = written[: len(read)]  # a service fuses a frame when the pose after it is there
        assert len(read) >= 4
    assert len(read) == len(written)
    for (frame, pose), (frame_read, pose_read) in zip(written, read):
        ours, theirs = frame.detections[0], frame_read.detections[0]
        assert frame_read.stamp_ns == frame.stamp_ns
        assert frame_read.source == "camera"
        assert frame_read.detected_types == ("roadedge",)
        assert np.allclose(frame_read.field_of_view, frame.field_of_view)
        assert np.allclose(frame_read.occluded_areas[0], frame.occluded_areas[0])
        assert (theirs.type, theirs.style, theirs.confidence) == ("roadedge", "solid", 0.75)
        assert np.allclose(theirs.points, ours.points)
        assert np.allclose(theirs.stddev, ours.stddev, atol=1e-6)
        assert np.allclose(pose_read.matrix, pose.matrix)


def made_objects(frames):
    """A car ahead, which drives at the speed of the vehicle, and another one whose place is all that is known."""
    car = TrackedObject(7, [20, 0, 0.1], [1, 0, 0], "truck", 10, existence=0.5, stddev=0.25, length=9, width=2.5)
    return [(Objects(frame.stamp_ns, [car, TrackedObject(8, [i, 2, 3])]), pose) for i, (frame, pose) in enumerate(frames)]


@pytest.mark.parametrize("name", ["a.frames.jsonl", "a.mcap"])
def test_objects(tmp_path, name):
    frames = made_frames()
    written = made_objects(frames)
    laneloom.write_frames(tmp_path / name, frames, written)
    read = laneloom.read_objects(tmp_path / name)
    assert len(read) == len(written)
    for (ours, pose), (theirs, pose_read) in zip(written, read):
        assert theirs.stamp_ns == ours.stamp_ns
        assert not theirs.in_map_frame
        assert np.allclose(pose_read.matrix, pose.matrix)
        for a, b in zip(ours.objects, theirs.objects, strict=True):
            assert (a.id, a.kind, a.speed) == (b.id, b.kind, b.speed)
            assert (a.existence, a.stddev, a.length, a.width) == (b.existence, b.stddev, b.length, b.width)
            assert np.allclose(a.position, b.position) and np.allclose(a.heading, b.heading)
    assert [o.stamp_ns for o, _ in laneloom.iter_objects(tmp_path / name)] == [o.stamp_ns for o, _ in read]


def test_objects_may_be_in_the_map_frame(tmp_path):
    frames = made_frames()
    frame, pose = frames[1]
    place = pose.matrix @ [20, 0, 0, 1]
    ahead = Objects(frame.stamp_ns, [TrackedObject(7, place[:3], pose.matrix[:3, 0])], in_map_frame=True)
    for name in ("a.mcap", "a.jsonl"):
        laneloom.write_frames(tmp_path / name, frames, [(ahead, pose)])
    [(recorded, _)], [(line, _)] = laneloom.read_objects(tmp_path / "a.mcap"), laneloom.read_objects(tmp_path / "a.jsonl")
    assert recorded.in_map_frame and np.allclose(recorded.objects[0].position, place[:3])
    assert not line.in_map_frame  # JSON lines have no map frame
    assert np.allclose(line.objects[0].position, [20, 0, 0])
    assert np.allclose(line.objects[0].heading, [1, 0, 0])


def test_a_file_may_have_no_objects(tmp_path):
    laneloom.write_frames(tmp_path / "a.jsonl", made_frames())
    assert laneloom.read_objects(tmp_path / "a.jsonl") == []


def test_recordings_are_those_of_the_program(drive, frames):
    recording = drive.folder / "ours.mcap"
    laneloom.write_frames(recording, frames)
    maps = drive.folder / "maps.mcap"
    run("replay", "--in", recording, "--out", maps)
    read = laneloom.read_maps(maps)
    assert len(read) >= len(frames) - 1
    assert any(m.lanes for m in read)
    with pytest.raises(RuntimeError, match="ours.mcap"):
        laneloom.write_frames(recording, frames)  # it exists


def test_maps(tmp_path, maps):
    laneloom.write_maps(tmp_path / "a.jsonl", maps[-3:])
    read = laneloom.read_maps(tmp_path / "a.jsonl")
    assert [m.stamp_ns for m in read] == [m.stamp_ns for m in maps[-3:]]
    for ours, theirs in zip(maps[-1].lanes, read[-1].lanes):
        assert np.allclose(ours.centerline, theirs.centerline)
        assert ours.left_borders[0].boundary == theirs.left_borders[0].boundary
    assert read[-1].way.known == maps[-1].way.known


def test_truth(tmp_path, truth):
    truth.save(tmp_path / "a.json")
    again = laneloom.Truth.load(tmp_path / "a.json")
    assert (again.name, again.driving_side) == (truth.name, truth.driving_side)
    assert len(again.markings) == len(truth.markings) > 5
    assert [lane.successors for lane in again.lanes] == [lane.successors for lane in truth.lanes]
    assert np.array_equal(again.markings[0].points, truth.markings[0].points)
    assert len(again.poses) == len(truth.poses) > 10


@pytest.mark.parametrize("read", [laneloom.read_frames, laneloom.read_objects, laneloom.read_maps, laneloom.Truth.load])
def test_a_file_that_is_not_there_is_named(tmp_path, read):
    with pytest.raises(FileNotFoundError, match="nowhere"):
        read(tmp_path / "nowhere")


@pytest.mark.parametrize("read", [laneloom.read_maps, laneloom.Truth.load])
def test_what_cannot_be_read_is_named(tmp_path, read):
    (tmp_path / "broken").write_text('{"t": 1}\n')
    with pytest.raises(RuntimeError, match="broken"):
        read(tmp_path / "broken")


def test_a_line_that_is_no_frame_is_left_out_with_a_warning(tmp_path):
    laneloom.write_frames(tmp_path / "a.jsonl", made_frames())
    with open(tmp_path / "a.jsonl", "a") as file:
        file.write('{"t": 1}\n')
    with pytest.warns(RuntimeWarning, match="a.jsonl: left out: 1 x pose"):
        assert len(laneloom.read_frames(tmp_path / "a.jsonl")) == len(made_frames())


def test_a_recording_that_is_cut_off_is_a_warning(tmp_path):
    laneloom.write_frames(tmp_path / "a.mcap", made_frames())
    whole = (tmp_path / "a.mcap").read_bytes()
    (tmp_path / "b.mcap").write_bytes(whole[:-40])
    with pytest.warns(RuntimeWarning, match="b.mcap: left out: 1 x the recording is cut off"):
        laneloom.read_frames(tmp_path / "b.mcap")
