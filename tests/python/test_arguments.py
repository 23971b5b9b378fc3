"""What is wrong with an argument is an error whose text begins with the argument's name."""
import numpy as np
import pytest

import laneloom
from laneloom import Config, Detection, Frame, Mapper, NextTurn, Objects, Pose, TrackedObject, Truth, TruthLane, TruthMarking

LINE = np.array([[0.0, 1.0, 0.0], [5.0, 1.0, 0.0]])
LONG = np.zeros((1025, 3))
LANE = dict(id=1, left=LINE, right=LINE, centerline=LINE)
LEVEL = [0, 0, 0, 1]


def frame(**arguments):
    return Frame(**{"stamp_ns": 1, "detections": [], **arguments})


WRONG = [
    (lambda: Detection("kerb", LINE), ValueError, "type: must be one of laneline, roadedge, stopline, not 'kerb'"),
    (lambda: Detection(1, LINE), TypeError, "type: must be a str, not int"),
    (lambda: Detection("laneline", LINE[:, :2]), ValueError, "points: must have the shape (N, 3), not (2, 2)"),
    (lambda: Detection("laneline", LINE[0]), ValueError, "points: must have the shape (N, 3), not (3,)"),
    (lambda: Detection("laneline", LINE[:1]), ValueError, "points: must have at least two points"),
    (lambda: Detection("laneline", []), ValueError, "points: must have at least two points"),
    (lambda: Detection("laneline", "a line"), TypeError, "points: must be an array of numbers, not str"),
    (lambda: Detection("laneline", LINE > 0), TypeError, "points: must be an array of numbers, not ndarray"),
    (lambda: Detection("laneline", LINE * 1j), TypeError, "points: must be an array of numbers, not ndarray"),
    (lambda: Detection("laneline", [[0, 0, 0], [1, 0]]), TypeError, "points: must be an array of numbers, not list"),
    (lambda: Detection("laneline", LINE * np.nan), ValueError, "points: must be finite"),
    (lambda: Detection("laneline", LINE, 1.5), ValueError, "confidence: must be 0..1"),
    (lambda: Detection("laneline", LINE, "high"), TypeError, "confidence: must be a number, not str"),
    (lambda: Detection("laneline", LINE, True), TypeError, "confidence: must be a number, not bool"),
    (lambda: Detection("laneline", LINE, style="dotted"), ValueError, "style: must be one of unknown, solid, dashed"),
    (lambda: Detection("laneline", LINE, stddev=[0.1]), ValueError, "stddev: must have the shape (2,), not (1,)"),
    (lambda: Detection("laneline", LINE, stddev=[0.1, -0.1]), ValueError, "stddev: must not be negative"),
    (lambda: frame(stamp_ns=1.5), TypeError, "stamp_ns: must be an integer, not float"),
    (lambda: frame(stamp_ns=2**70), ValueError, "stamp_ns: must fit into 64 bits"),
    (lambda: frame(stamp_ns=0), ValueError, "Frame: the service would refuse it: stamp"),
    (lambda: frame(detections=[LINE]), TypeError, "detections[0]: must be Detection, not ndarray"),
    (lambda: frame(detections=3), TypeError, "detections: must be a list, not int"),
    (lambda: frame(detected_types="laneline"), TypeError, "detected_types: must be a list, not str"),
    (lambda: frame(field_of_view=LINE[0]), ValueError, "field_of_view: must have the shape (N, 3), not (3,)"),
    (lambda: frame(occluded_areas=[LINE[0]]), ValueError, "occluded_areas[0]: must have the shape (N, 3), not (3,)"),
    (lambda: frame(sequence=-1), ValueError, "sequence: must not be negative"),
    (lambda: Detection("laneline", LONG), ValueError, "points: must be at most 1024 long, not 1025"),
    (lambda: Detection("laneline", LINE, 10**400), ValueError, "confidence: must be finite"),
    (lambda: frame(detections=513 * [Detection("laneline", LINE)]), ValueError,
     "detections: must be at most 512 long, not 513"),
    (lambda: frame(detected_types=9 * ["laneline"]), ValueError, "detected_types: must be at most 8 long, not 9"),
    (lambda: frame(field_of_view=LONG), ValueError, "field_of_view: must be at most 1024 long, not 1025"),
    (lambda: frame(occluded_areas=65 * [LINE]), ValueError, "occluded_areas: must be at most 64 long, not 65"),
    (lambda: frame(occluded_areas=[LONG]), ValueError, "occluded_areas[0]: must be at most 1024 long, not 1025"),
    (lambda: frame(source=33 * "ä"), ValueError, "source: must be at most 64 bytes of UTF-8, not 66"),
    (lambda: frame(source="a\0b"), ValueError, "source: must have no zero character"),
    (lambda: frame(source="\ud800"), ValueError, "source: must be text that UTF-8 can hold"),
    (lambda: TrackedObject(-1, [0, 0, 0]), ValueError, "id: must not be negative"),
    (lambda: TrackedObject(1, [0, 0]), ValueError, "position: must have the shape (3,), not (2,)"),
    (lambda: TrackedObject(1, [0, 0, 0], kind="tank"), ValueError, "kind: must be one of unknown, car, truck, bus, "),
    (lambda: TrackedObject(1, [0, 0, 0], speed="fast"), TypeError, "speed: must be a number, not str"),
    (lambda: Objects(1, [LINE]), TypeError, "objects[0]: must be TrackedObject, not ndarray"),
    (lambda: Objects(1, [TrackedObject(i, [0, 0, 0]) for i in range(257)]), ValueError,
     "objects: must be at most 256 long, not 257"),
    (lambda: Objects(0, []), ValueError, "Objects: the service would refuse it: stamp"),
    (lambda: Objects(1, [TrackedObject(1, [0, 0, 0], [2, 0, 0])]), ValueError,
     "Objects: the service would refuse it: heading"),
    (lambda: Objects(1, 2 * [TrackedObject(1, [0, 0, 0])]), ValueError,
     "Objects: the service would refuse it: repeated_id"),
    (lambda: Objects(1, [], in_map_frame=1), TypeError, "in_map_frame: must be a bool, not int"),
    (lambda: NextTurn(1, "back", 3), ValueError, "turn: must be one of unknown, straight, left, right, u_turn"),
    (lambda: NextTurn(1, "left", -3), ValueError, "NextTurn: the service would refuse it: distance"),
    (lambda: Pose([0, 0], LEVEL), ValueError, "position: must have the shape (3,), not (2,)"),
    (lambda: Pose([0, 0, 0], [0, 0, 0, 2]), ValueError, "Pose: the service would refuse it: not_a_rotation"),
    (lambda: Pose([1e9, 0, 0], LEVEL), ValueError, "Pose: the service would refuse it: coordinate"),
    (lambda: Pose.from_matrix(np.eye(3)), ValueError, "matrix: must have the shape (4, 4), not (3, 3)"),
    (lambda: Pose.from_matrix(2 * np.eye(4)), ValueError, "matrix: must be a rotation and a translation"),
    (lambda: Pose.from_matrix(np.diag([1, 1, -1, 1])), ValueError, "matrix: must be a rotation and a translation"),
    (lambda: Mapper({"range": 1}), TypeError, "config: must be Config, not dict"),
    (lambda: Mapper().update(LINE, Pose([0, 0, 0], LEVEL)), TypeError, "frame: must be Frame, not ndarray"),
    (lambda: Mapper().update(frame(), np.eye(4)), TypeError, "pose: must be Pose, not ndarray"),
    (lambda: Mapper().add(frame(), Pose([0, 0, 0], LEVEL)), TypeError, "objects: must be Objects, not Frame"),
    (lambda: Config(3), TypeError, "preset: must be a str, not int"),
    (lambda: Truth(lanes=[TruthLane(**LANE, successors=[7])]), ValueError,
     "lanes: lane 1 refers to the unknown id 7"),
    (lambda: Truth(markings=2 * [TruthMarking(3, "laneline", LINE)]), ValueError, "markings: the id 3 is given twice"),
    (lambda: TruthMarking(0, "laneline", LINE), ValueError, "id: must be above 0"),
    (lambda: TruthLane(**LANE, in_intersection=1), TypeError, "in_intersection: must be a bool, not int"),
    (lambda: laneloom.read_frames(3), TypeError, "path: must be a str or an os.PathLike, not int"),
    (lambda: laneloom.read_frames("a\0b"), ValueError, "path: cannot be the name of a file"),
    (lambda: laneloom.write_frames("x.jsonl", [frame()]), TypeError, "frames[0]: must be a pair (Frame, Pose)"),
    (lambda: laneloom.write_frames("x.jsonl", [], [Objects(1, [])]), TypeError,
     "objects[0]: must be a pair (Objects, Pose)"),
    (lambda: laneloom.write_frames("x.jsonl", [], [(Objects(1, []), Pose([0, 0, 0], LEVEL))]), ValueError,
     "objects[0]: no frame has its stamp"),
    (lambda: laneloom.write_maps("x.mcap", []), ValueError, "path: maps are written as JSON lines"),
    (lambda: laneloom.evaluate(Truth()), TypeError, "maps, frames: exactly one of the two must be given"),
    (lambda: laneloom.evaluate(Truth(), maps=[LINE]), TypeError, "maps[0]: must be LocalMap, not ndarray"),
    (lambda: laneloom.evaluate("town", maps=[]), TypeError, "truth: must be Truth, not str"),
    (lambda: laneloom.evaluate_later([], 3), TypeError, "maps: must be a list, not int"),
    (lambda: laneloom.evaluate_later([], []), RuntimeError, "frames, maps: too short to be rated"),
    (lambda: laneloom.render("x.png"), TypeError, "map, frame: one of the two must be given"),
]


@pytest.mark.parametrize("call, error, text", WRONG, ids=[text for _, _, text in WRONG])
def test_the_error_names_the_argument(call, error, text):
    with pytest.raises(error) as raised:
        call()
    assert str(raised.value).startswith(text)


def test_what_fills_the_bounds_is_taken():
    line = Detection("laneline", LONG[:-1])
    full = frame(detections=512 * [line], source=32 * "ä", field_of_view=LONG[:-1], occluded_areas=64 * [LINE])
    assert len(full.detections) == 512 and full.source == 32 * "ä"
    assert len(Objects(1, [TrackedObject(i, [0, 0, 0]) for i in range(256)]).objects) == 256


def test_an_error_within_an_argument_is_passed_on():
    class Broken:
        def __index__(self):
            raise ZeroDivisionError

    for argument in ("stamp_ns", "sequence"):
        with pytest.raises(ZeroDivisionError):
            frame(**{argument: Broken()})
    with pytest.raises(OSError, match="too long"):
        laneloom.read_frames(5000 * "a")


def test_what_numpy_makes_numbers_of_is_taken():
    for points in (LINE, LINE.tolist(), LINE.astype(np.float32), LINE.astype(int), np.asfortranarray(LINE), LINE[::-1]):
        assert np.array_equal(Detection("laneline", points, np.float32(0.5)).points, np.asarray(points, float))
    assert Frame(np.int64(7), []).stamp_ns == 7
    assert Frame(1, [], session_id=2**64 - 1).session_id == 2**64 - 1


def test_what_is_given_back_cannot_change_the_object():
    detection = Detection("laneline", LINE)
    with pytest.raises(ValueError, match="read-only"):
        detection.points[:] = 9
    assert np.array_equal(detection.points, LINE)
    pose = Pose([1, 2, 3], [0, 0, 0, 1])
    pose.position[:] = 9  # a copy
    assert np.array_equal(pose.position, [1, 2, 3])
    with pytest.raises(AttributeError):
        Frame(1, []).detections.append(detection)
    with pytest.raises(AttributeError):
        detection.confidence = 0.5


def test_poses_by_quaternion_and_matrix_agree():
    pose = Pose([1, 2, 3], [0, 0, np.sqrt(0.5), np.sqrt(0.5)], stamp_ns=5)
    assert np.allclose(pose.matrix @ [1, 0, 0, 1], [1, 3, 3, 1])
    again = Pose.from_matrix(pose.matrix, 5)
    assert np.allclose(again.orientation, pose.orientation)
    assert np.allclose(again.position, pose.position)


def test_a_quaternion_of_nearly_unit_length_is_normalised():
    pose = Pose([1, 2, 3], 1.0009 * np.array([0, 0, 0.6, 0.8]))
    assert np.allclose(pose.orientation, [0, 0, 0.6, 0.8], atol=1e-12)
    assert np.allclose(pose.matrix[:3, :3] @ pose.matrix[:3, :3].T, np.eye(3), atol=1e-12)


def test_configurations(tmp_path):
    config = Config("av2")
    config["mapper.range.side_max_m"] = 20
    config["mapper.method"] = "voxels"
    config["mapper.preprocess.reject_zigzag"] = False
    assert config["mapper.range.side_max_m"] == 20.0
    assert config["mapper.preprocess.reject_zigzag"] is False
    (tmp_path / "a.yaml").write_text(config.dump())
    again = Config.load(tmp_path / "a.yaml")
    assert [again[key] for key in again.keys()] == [config[key] for key in config.keys()]
    with pytest.raises(laneloom.ConfigError, match="mapper.range.side_max_m"):
        config["mapper.range.side_max_m"] = -1
    with pytest.raises(laneloom.ConfigError, match="colour"):
        config["mapper.colour"] = 1
    with pytest.raises(KeyError):
        config["mapper.colour"]
    assert "mapper.method" in config and "mapper.colour" not in config and 1 not in config
    assert list(config) == config.keys() and len(config) == len(config.keys())
    with pytest.raises(FileNotFoundError, match="nowhere.yaml"):
        Config.load("nowhere.yaml")
