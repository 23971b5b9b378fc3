"""Fuses the road markings that a network detects into a lane map, and rates both.

>>> import laneloom
>>> truth = laneloom.Truth.load("road.truth.json")
>>> frames = laneloom.read_frames("road.frames.jsonl")
>>> mapper = laneloom.Mapper()
>>> maps = [mapper.update(frame, pose) for frame, pose in frames]
>>> laneloom.evaluate(truth, maps).markings.f1
>>> laneloom.evaluate(truth, frames=frames).markings.f1
>>> laneloom.evaluate_later(frames, maps).score("laneline", 20).map.recall

Metres, radians, nanoseconds. The body frame is the vehicle's: x forward, y left, z up. The map frame is the fixed one
that poses are given in. Lines and the numbers along them are views that cannot be written; other arrays are copies.
Objects cannot be changed once they are made, but for Config and Mapper.
What is wrong with an argument is a TypeError or a ValueError whose text begins with the argument's name.
"""

from ._core import (
    Border,
    Config,
    ConfigError,
    Detection,
    DrivenPath,
    Evaluation,
    Frame,
    Lane,
    LaneChange,
    LaneGraph,
    LaterEvaluation,
    LaterFigures,
    LaterScore,
    LineageEvent,
    Linkage,
    LocalMap,
    Mapper,
    Marking,
    Neighbour,
    NextTurn,
    Objects,
    PairScore,
    Pose,
    Score,
    Stopline,
    TrackedObject,
    Truth,
    TruthLane,
    TruthMarking,
    Way,
    WayLane,
    WayStation,
    __version__,
    evaluate,
    evaluate_later,
    iter_frames,
    iter_maps,
    iter_objects,
    read_frames,
    read_maps,
    read_next_turns,
    read_objects,
    render,
    way_ahead,
    write_frames,
    write_maps,
)
from ._tables import evaluation_to_html, evaluation_to_pandas, map_to_pandas

setattr(LocalMap, "to_pandas", map_to_pandas)
setattr(Evaluation, "to_pandas", evaluation_to_pandas)
setattr(Evaluation, "_repr_html_", evaluation_to_html)

__all__ = [
    "Border",
    "Config",
    "ConfigError",
    "Detection",
    "DrivenPath",
    "Evaluation",
    "Frame",
    "Lane",
    "LaneChange",
    "LaneGraph",
    "LaterEvaluation",
    "LaterFigures",
    "LaterScore",
    "LineageEvent",
    "Linkage",
    "LocalMap",
    "Mapper",
    "Marking",
    "Neighbour",
    "NextTurn",
    "Objects",
    "PairScore",
    "Pose",
    "Score",
    "Stopline",
    "TrackedObject",
    "Truth",
    "TruthLane",
    "TruthMarking",
    "Way",
    "WayLane",
    "WayStation",
    "__version__",
    "evaluate",
    "evaluate_later",
    "iter_frames",
    "iter_maps",
    "iter_objects",
    "read_frames",
    "read_maps",
    "read_next_turns",
    "read_objects",
    "render",
    "way_ahead",
    "write_frames",
    "write_maps",
]
