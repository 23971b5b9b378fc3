"""What notebooks show, tables, and the graph of lanes."""
import re
import sys

import numpy as np
import pytest

import laneloom


@pytest.fixture
def lane_map(maps):
    return next(m for m in reversed(maps) if m.lanes and m.way)


def test_a_map_is_shown_as_svg(lane_map):
    picture = lane_map._repr_svg_()
    assert picture.lstrip().startswith("<?xml") and picture.count("<path") > 20


def test_a_picture_can_be_an_array(lane_map, truth, tmp_path):
    picture = laneloom.render(None, lane_map, truth=truth)
    assert picture.dtype == np.uint8 and picture.ndim == 3 and picture.shape[2] == 3
    assert tuple(picture[2, 2]) == (255, 255, 255)
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 20, "it has colours"
    laneloom.render(tmp_path / "map.png", lane_map, truth=truth)
    width, height = np.frombuffer((tmp_path / "map.png").read_bytes()[16:24], ">u4")
    assert picture.shape[:2] == (height, width)


def test_an_evaluation_is_a_table(truth, maps):
    evaluation = laneloom.evaluate(truth, maps)
    html = evaluation._repr_html_()
    assert f"{evaluation.markings.f1:.1%}" in html and html.count("<tr>") == 6
    assert re.match(r"<Evaluation of \d+ frames", repr(evaluation))
    assert 0 < evaluation.stability["jitter_mean_m"] < 0.5
    assert 0 < evaluation.trust["within_2_sigma"] <= 1
    assert 0 < evaluation.styles["accuracy"] <= 1
    assert 0 <= evaluation.top_ll <= 1
    assert 0.3 < evaluation.steadiness["own_lane"] <= 1
    assert set(evaluation.steadiness["jump_p99_m"]) == {0.0, 10.0, 20.0}


def test_tables_are_for_pandas(truth, maps, lane_map):
    pytest.importorskip("pandas")
    table = lane_map.to_pandas()
    assert len(table) == len(lane_map.boundaries) + len(lane_map.stoplines) + len(lane_map.lanes)
    assert (table["own"] == True).sum() == 1  # noqa: E712
    scores = laneloom.evaluate(truth, maps).to_pandas()
    assert scores.loc["lane", "f1"] == laneloom.evaluate(truth, maps).lane.f1


def test_pandas_is_needed_only_for_tables(lane_map, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ModuleNotFoundError, match="pandas"):
        lane_map.to_pandas()


def test_the_graph_knows_the_own_lane_and_what_follows(lane_map):
    graph = laneloom.LaneGraph(lane_map)
    lane, arc, offset, against = graph.own_lane()
    assert lane.id in [other.id for other in lane_map.lanes]
    assert 0 <= arc <= 200 and abs(offset) < lane.width and isinstance(against, bool)
    assert graph[lane.id].id == lane.id
    assert graph.at(lane_map.pose[:3, 3]).id == lane.id
    followed = {(link.from_lane, link.to_lane) for link in lane_map.linkages}
    for first, then in followed:
        assert (then, False) in graph.successors(first)
    with pytest.raises(KeyError):
        graph[10**9]
    assert lane.id in graph and 10**9 not in graph and "lane" not in graph
    assert list(graph) == [other.id for other in lane_map.lanes] and len(graph) == len(lane_map.lanes)


def test_a_mapper_tells_why(frames):
    mapper = laneloom.Mapper(explain=True)
    for frame, pose in frames[:60]:
        lane_map = mapper.update(frame, pose)
    line = next(m for m in lane_map.boundaries if m.status == "confirmed")
    assert re.match(rf"\w+ {line.id} is confirmed, with log odds of", mapper.why(line.id)[0])
    assert any("side" in sentence for sentence in mapper.why(lane_map.lanes[0].id))
    fates = [mapper.why(detection=i)[0] for i in range(len(frames[59][0].detections))]
    assert any("taken: it observes" in fate for fate in fates)
    with pytest.raises(ValueError, match="explain"):
        laneloom.Mapper().why(1)
    with pytest.raises(TypeError):
        mapper.why()
