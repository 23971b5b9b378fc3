"""Objects that leave the process, and files that are read one item after the other."""
import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import laneloom


def same(one, other):
    """Whether two objects of the module have the same values, all the way down."""
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other)
    if isinstance(one, (tuple, list)):
        return len(one) == len(other) and all(same(a, b) for a, b in zip(one, other))
    if type(one).__module__.startswith("laneloom"):
        names = [name for name in dir(type(one)) if isinstance(getattr(type(one), name), property)]
        return type(one) is type(other) and all(same(getattr(one, name), getattr(other, name)) for name in names)
    return one == other


def objects(frames, maps, truth, changing):
    frame, pose = frames[-1]
    car = laneloom.TrackedObject(7, [1, 2, 3], [0, 1, 0], "bus", 4, existence=0.5, stddev=0.25, length=9, width=2.5)
    yield from (car, laneloom.Objects(5, [car], in_map_frame=True, sequence=3, session_id=4))
    yield laneloom.NextTurn(5, "left", 80)
    yield from (frame, pose, frame.detections[0], truth, truth.lanes[0], truth.markings[0], maps[-1])
    for parts in ("lanes", "boundaries", "markings", "lineage"):
        yield next(getattr(m, parts)[0] for m in maps if getattr(m, parts))
    yield from [part for m in maps for part in (*m.linkages, *m.stoplines)][:3]
    way = next(m.way for m in reversed(maps) if m.way)
    yield from (changing, changing.change, way, way.stations[0], way.lanes[0], next(m.lanes[0].left_borders[0] for m in maps if m.lanes))


def test_everything_that_maps_are_made_of_pickles_and_copies(frames, maps, truth, changing):
    for value in objects(frames, maps, truth, changing):
        assert same(pickle.loads(pickle.dumps(value)), value), value
        assert same(copy.deepcopy(value), value), value


def test_a_way_that_was_pickled_goes_on_as_the_way_does(maps):
    of_map = next(m for m in reversed(maps) if m.way)
    kept = pickle.loads(pickle.dumps(of_map.way))
    assert same(laneloom.way_ahead(of_map, before=kept), laneloom.way_ahead(of_map, before=of_map.way))


def test_a_configuration_pickles():
    config = laneloom.Config()
    config["mapper.range.side_max_m"] = 21.5
    assert pickle.loads(pickle.dumps(config)).dump() == config.dump()


def test_a_mapper_that_was_pickled_makes_the_same_maps(frames):
    mapper = laneloom.Mapper()
    for frame, pose in frames[:40]:
        mapper.update(frame, pose)
    other = pickle.loads(pickle.dumps(mapper))
    for frame, pose in frames[40:60]:
        assert same(mapper.update(frame, pose), other.update(frame, pose))


def test_a_pickle_of_another_version_is_refused(frames):
    state = list(frames[0][1].__reduce_ex__(2))
    pose = laneloom.Pose.__new__(laneloom.Pose)
    with pytest.raises(ValueError, match="another version"):
        pose.__setstate__(("0.0.0", state[2][1]))
    with pytest.raises(ValueError, match="damaged"):
        pose.__setstate__((laneloom.__version__, b"x"))


def lanes_of(pair):
    return len(laneloom.Mapper().update(*pair).boundaries)


def test_frames_go_to_other_processes(frames):
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.map(lanes_of, frames[:3]) == [lanes_of(pair) for pair in frames[:3]]


def test_iterators_give_what_lists_have(drive, frames, maps, tmp_path):
    for (frame, pose), (wanted, wanted_pose) in zip(laneloom.iter_frames(drive.frames), frames, strict=True):
        assert same(frame, wanted) and same(pose, wanted_pose)
    file = tmp_path / "maps.jsonl"
    laneloom.write_maps(file, maps)
    assert sum(1 for _ in laneloom.iter_maps(file)) == len(laneloom.read_maps(file))
    stream = laneloom.iter_frames(drive.frames)
    next(stream)
    del stream  # the rest is not read


@pytest.mark.parametrize("read", [laneloom.read_frames, laneloom.iter_frames, laneloom.read_maps, laneloom.iter_maps,
                                  laneloom.Truth.load, laneloom.Config.load])
def test_a_missing_file_is_not_found(read, tmp_path):
    with pytest.raises(FileNotFoundError) as raised:
        read(tmp_path / "nothing.jsonl")
    assert raised.value.filename.endswith("nothing.jsonl")


def test_a_wrong_file_is_an_error_of_the_iterator(tmp_path):
    file = tmp_path / "wrong.jsonl"
    file.write_text('{"t": 1}\n')
    with pytest.raises(RuntimeError, match="wrong.jsonl"):
        list(laneloom.iter_maps(file))
