"""Maps, their figures and pictures are those of the program."""
import gc
import heapq
import json
import sys
import threading

import numpy as np
import pytest

import laneloom
from conftest import run


def same_map(a, b):
    return (
        a.stamp_ns == b.stamp_ns
        and [m.id for m in a.boundaries] == [m.id for m in b.boundaries]
        and all(np.array_equal(m.points, n.points) for m, n in zip(a.boundaries, b.boundaries))
        and [lane.id for lane in a.lanes] == [lane.id for lane in b.lanes]
        and all(np.array_equal(m.centerline, n.centerline) for m, n in zip(a.lanes, b.lanes))
    )


def test_a_map_is_made_of_arrays(maps):
    last = maps[-1]
    lane = last.lanes[0]
    assert lane.left.shape[1] == lane.right.shape[1] == lane.centerline.shape[1] == 3
    assert lane.centerline.dtype == np.float64
    assert last.pose.shape == (4, 4)
    boundaries = {boundary.id: boundary for boundary in last.boundaries}
    border = lane.left_borders[0]
    left = boundaries[border.boundary]
    assert left.lateral_stddev.shape == (len(left.points),)
    assert 0 <= border.on_boundary[0] < border.on_boundary[1]
    assert border.range[0] == pytest.approx(0, abs=1e-6)
    assert (lane.use, lane.use_probability) == ("lane", -1)
    assert set(lane.evidence) & {"markings", "edges"}
    assert {linkage.from_lane for linkage in last.linkages} <= {lane.id for lane in last.lanes}
    assert any(event.kind == "born" and event.element == "lane" for m in maps for event in m.lineage)


def test_lines_are_views_that_keep_their_map(frames):
    mapper = laneloom.Mapper()
    for frame, pose in frames:
        last = mapper.update(frame, pose)
    line = last.lanes[0].centerline
    stddev = last.boundaries[0].lateral_stddev
    points = frames[-1][0].detections[0].points
    for view in (line, stddev, points):
        assert not view.flags.owndata and not view.flags.writeable
        with pytest.raises(ValueError, match="read-only"):
            view[0] = 1
        with pytest.raises(ValueError):
            view.flags.writeable = True
    assert np.shares_memory(line, last.lanes[0].centerline), "nothing is copied"
    assert np.shares_memory(points, frames[-1][0].detections[0].points)
    copies = [view.copy() for view in (line, stddev)]
    del last, mapper
    gc.collect()
    others = [np.full_like(line, i) for i in range(1000)]  # which would take memory that was given back
    assert len(others) and np.array_equal(line, copies[0]) and np.array_equal(stddev, copies[1])
    own = np.array(line)
    own[0] = 1
    assert laneloom.Detection("laneline", line).points.flags.owndata is False


def test_what_has_no_points_is_an_empty_array():
    assert laneloom.Frame(1, []).field_of_view.shape == (0, 3)
    assert laneloom.Detection("laneline", [[0, 0, 0], [1, 0, 0]]).stddev.shape == (0,)


def test_a_map_has_the_own_way(maps):
    assert maps[0].way is None
    way = maps[-1].way
    assert 0 < way.confirmed <= way.known <= 60
    assert way.stations[0].lane == way.lanes[0].id
    steps = np.diff([station.point[:2] for station in way.stations], axis=0)
    assert np.allclose(np.hypot(*steps.T), way.step, atol=0.02)
    assert np.allclose(np.arctan2(*steps[0][::-1]), way.stations[0].heading, atol=0.05)


def test_a_way_is_made_as_it_is_wished(maps):
    last = maps[-1]
    way = laneloom.way_ahead(last, reach=10)
    assert way.known == pytest.approx(10)
    assert way.lanes[0].id == last.way.lanes[0].id
    assert np.allclose(way.to_map(5, 0), way.stations[5].point)
    assert way.to_way(way.to_map(7.3, -1)) == pytest.approx((7.3, -1), abs=1e-3)
    assert laneloom.way_ahead(last, "left", before=way, reach=10).known == pytest.approx(10)
    assert (way.wish, way.change) == ("straight", None)
    assert laneloom.way_ahead(maps[0]) is None
    with pytest.raises(ValueError, match="^wish: must be one of straight, left, "):
        laneloom.way_ahead(last, "up")
    with pytest.raises(ValueError, match="^reach"):
        laneloom.way_ahead(last, reach=0.5)
    with pytest.raises(ValueError, match="^point"):
        way.to_way([1, 2])


def test_a_way_begins_where_the_vehicle_is_now(maps):
    ahead = maps[-1].pose.copy()
    ahead[:3, 3] += 5 * ahead[:3, 0]
    way = laneloom.way_ahead(maps[-1], pose=laneloom.Pose.from_matrix(ahead))
    assert way.to_way(ahead[:3, 3])[0] == pytest.approx(0, abs=0.1)
    assert laneloom.way_ahead(maps[-1]).to_way(ahead[:3, 3])[0] == pytest.approx(5, abs=0.1)
    with pytest.raises(TypeError, match="^pose: must be Pose, not ndarray"):
        laneloom.way_ahead(maps[-1], pose=ahead)


def test_a_way_tells_of_its_lanes_and_of_the_turns_into_them(turning):
    assert turning.wish == "left"
    first, *_, last = turning.lanes
    assert (first.entry, first.range[0], first.against) == ("unknown", 0, False)
    assert last.id == turning.stations[-1].lane and last.range[1] == pytest.approx(turning.known, abs=1)
    assert {lane.id for lane in turning.lanes} == {station.lane for station in turning.stations} - {0}


def test_a_way_tells_of_its_change_of_lanes(changing):
    change = changing.change
    assert (changing.lanes[0].id, changing.stations[-1].lane) == (change.from_, change.to)
    assert change.length > 10
    s, d = changing.to_way(change.begin)
    assert s == pytest.approx(0, abs=1) and d == pytest.approx(0, abs=0.2)


def test_a_map_stays_as_it_was(frames):
    mapper = laneloom.Mapper()
    first = mapper.update(*frames[0])
    count = len(first.boundaries)
    for frame, pose in frames[1:20]:
        mapper.update(frame, pose)
    assert len(first.boundaries) == count
    assert same_map(mapper.map, mapper.map)
    assert not same_map(mapper.map, first)
    assert mapper.learned(frames[0][0].source) and mapper.learned("another") == {}
    mapper.reset()
    assert mapper.map.boundaries == ()


def test_maps_are_those_of_the_program(drive, maps):
    out = drive.folder / "replayed.jsonl"
    run("replay", "--in", drive.frames, "--out", out)
    replayed = laneloom.read_maps(out)
    assert len(replayed) == len(maps) > 50
    for ours, theirs in zip(maps, replayed):
        assert [m.id for m in ours.boundaries] == [m.id for m in theirs.boundaries]
        assert [lane.id for lane in ours.lanes] == [lane.id for lane in theirs.lanes]


def test_maps_with_objects_are_those_of_the_program(tmp_path):
    road, out = tmp_path / "road.frames.jsonl", tmp_path / "maps.jsonl"
    run("simulate", "--scenario", "straight", "--traffic", "usual", "--duration", 8, "--frames", road)
    run("replay", "--in", road, "--out", out)
    frames, objects = laneloom.read_frames(road), laneloom.read_objects(road)
    assert len(objects) == len(frames)

    def told(maps):
        return [[(lane.id, lane.direction_evidence) for lane in m.lanes] for m in maps]

    def mapped(objects):
        mapper, maps = laneloom.Mapper(), []
        for seen, pose in heapq.merge(objects, frames, key=lambda pair: pair[0].stamp_ns):
            if isinstance(seen, laneloom.Objects):
                mapper.add(seen, pose)
            else:
                maps.append(mapper.update(seen, pose))
        return told(maps)

    assert any("traffic" in evidence for lanes in mapped(objects) for _, evidence in lanes)
    assert mapped(objects) == told(laneloom.read_maps(out))
    assert mapped([]) != mapped(objects)


def test_the_way_makes_the_next_turn(tmp_path):
    road = tmp_path / "road.frames.jsonl"
    run("simulate", "--scenario", "straight", "--duration", 3, "--frames", road)
    mapper = laneloom.Mapper()
    for frame, pose in laneloom.read_frames(road):
        mapper.update(frame, pose)
    assert mapper.map.way.wish == "straight"
    lines = road.read_text().splitlines()
    told = json.loads(lines[-1]) | {"next_turn": {"turn": "left", "distance": 80}}
    road.write_text("\n".join(lines[:-1] + [json.dumps(told)]))
    (turn, at), = laneloom.read_next_turns(road)
    assert (turn.stamp_ns, turn.turn, turn.distance) == (frame.stamp_ns, "left", 80)
    mapper.add(turn, at)
    mapper.update(frame, pose)
    assert mapper.map.way.wish == "left"


def test_figures_are_those_of_the_program(drive, truth, frames, maps):
    laneloom.write_maps(drive.folder / "maps.jsonl", maps)
    run("evaluate", "--truth", drive.truth, "--frames", drive.frames, "--map", drive.folder / "maps.jsonl",
        "--json", drive.folder / "figures.json")
    figures = json.loads((drive.folder / "figures.json").read_text())
    for who, ours in (("fused", laneloom.evaluate(truth, maps)), ("raw", laneloom.evaluate(truth, frames=frames))):
        assert ours.frames == len(maps)
        for kind in ("laneline", "roadedge", "stopline"):
            score = getattr(ours, kind)
            assert score.f1 == pytest.approx(figures[who][kind]["f1"])
            assert score.acd_m == pytest.approx(figures[who][kind]["acd_m"])
    assert laneloom.evaluate(truth, maps).markings.f1 > laneloom.evaluate(truth, frames=frames).markings.f1 > 0.3


def test_the_range_and_the_confidence_count(truth, frames, maps):
    near = laneloom.Config()
    near["mapper.range.forward_max_m"] = 10
    assert laneloom.evaluate(truth, maps, config=near).markings.truths < laneloom.evaluate(truth, maps).markings.truths
    sure = laneloom.evaluate(truth, frames=frames, min_confidence=0.9).markings.predictions
    assert 0 < sure < laneloom.evaluate(truth, frames=frames).markings.predictions
    with pytest.raises(ValueError, match=r"^maps\[1\]: stamps must ascend"):
        laneloom.evaluate(truth, [maps[1], maps[0]])


def test_figures_without_truth_are_those_of_the_program(drive, frames, maps):
    laneloom.write_maps(drive.folder / "later.jsonl", maps)
    run("evaluate", "--later", "--frames", drive.frames, "--map", drive.folder / "later.jsonl", "--json",
        drive.folder / "later.json")
    figures = json.loads((drive.folder / "later.json").read_text())
    rated = laneloom.evaluate_later(frames, maps)
    assert rated.frames == figures["frames"] > 20
    assert rated.driven_m == pytest.approx(figures["driven_m"])
    assert rated.lanes_per_frame == pytest.approx(figures["lanes_per_frame"])
    assert rated.own_lane_share == pytest.approx(figures["own_lane"]["share"])
    assert rated.own_lane_id_changes == figures["own_lane"]["id_changes"]
    for type in ("laneline", "roadedge"):
        for distance_m in (12, 20, 28):
            score, expected = rated.score(type, distance_m), figures[type][str(distance_m)]
            assert score.seen_later == expected["seen_later"]
            for who in ("single", "map"):
                for name, value in expected[who].items():
                    assert getattr(getattr(score, who), name) == (value if value is None else pytest.approx(value))
    assert rated.score("laneline", 20).map.recall > 0.5


def test_a_truth_of_ones_own(truth, maps):
    """Rated by a truth that is what the map says, a map is right."""
    last = maps[-1]
    markings = [laneloom.TruthMarking(m.id, m.type, m.points) for m in last.boundaries if m.status != "inferred"]
    markings += [laneloom.TruthMarking(s.marking.id, "stopline", s.marking.points) for s in last.stoplines]
    rated = laneloom.evaluate(laneloom.Truth("own", markings), [last])
    assert rated.markings.f1 == 1.0
    assert rated.markings.acd_m == pytest.approx(0.0, abs=1e-9)


def test_pictures(tmp_path, truth, frames, maps):
    laneloom.render(tmp_path / "a.png", maps[-1], frame=frames[-1], truth=truth, title="a road")
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    laneloom.render(tmp_path / "a.svg", frame=frames[-1])
    assert "<svg" in (tmp_path / "a.svg").read_text()
    with pytest.raises(ValueError, match="^path: "):
        laneloom.render(tmp_path / "a.bmp", maps[-1])


@pytest.mark.parametrize("work", ["update", "evaluate"])
def test_other_threads_run_meanwhile(work, truth, frames, maps):
    """With a long switch interval, another thread only runs where the GIL is released."""
    begun, ended, seen = threading.Event(), [], []
    points = [[x, 0.01 * (x % 2), 0] for x in np.linspace(0, 30, 1000)]
    large = laneloom.Frame(1, [laneloom.Detection("laneline", points)] * 400)
    mapper, pose = laneloom.Mapper(), laneloom.Pose([0, 0, 0], [0, 0, 0, 1])

    def watch():
        begun.wait()
        seen.append(not ended)

    watcher = threading.Thread(target=watch)
    interval = sys.getswitchinterval()
    watcher.start()
    sys.setswitchinterval(60)
    try:
        begun.set()
        mapper.update(large, pose) if work == "update" else laneloom.evaluate(truth, maps)
        ended.append(True)
    finally:
        sys.setswitchinterval(interval)
    watcher.join()
    assert seen == [True]


def test_threads_may_share_a_mapper_or_have_their_own(frames, maps):
    shared, results = laneloom.Mapper(), {}

    def drive(number):
        own = laneloom.Mapper()
        for frame, pose in frames[:40]:
            shared.update(frame, pose)
            results[number] = own.update(frame, pose)

    threads = [threading.Thread(target=drive, args=(number,)) for number in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(same_map(results[number], maps[39]) for number in range(3))
    assert len(shared.map.boundaries) > 0
