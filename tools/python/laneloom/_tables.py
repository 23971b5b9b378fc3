"""Tables for pandas, which is needed only where a table is asked for."""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np

from ._core import Evaluation, Lane, LaneGraph, LocalMap, Marking

KINDS = ("markings", "laneline", "roadedge", "stopline", "lane")


def _pandas() -> Any:
    return importlib.import_module("pandas")


def _length(points: Any) -> float:
    return float(np.linalg.norm(np.diff(points[:, :2], axis=0), axis=1).sum())


def _marking(element: str, marking: Marking) -> dict[str, Any]:
    return {"element": element, "id": marking.id, "type": marking.type, "status": marking.status,
            "existence_probability": marking.existence_probability, "length_m": _length(marking.points),
            "points": marking.points}


def _lane(lane: Lane, own: bool) -> dict[str, Any]:
    return {"element": "lane", "id": lane.id, "type": lane.use, "status": lane.status,
            "existence_probability": lane.existence_probability, "length_m": _length(lane.centerline),
            "points": lane.centerline, "width_m": lane.width, "direction": lane.direction, "own": own}


def map_to_pandas(self: LocalMap) -> Any:
    """One row for each boundary, stop line and lane of a map."""
    own = LaneGraph(self).own_lane()
    rows = [_marking("boundary", marking) for marking in self.boundaries]
    rows += [_marking("stopline", stopline.marking) for stopline in self.stoplines]
    rows += [_lane(lane, own is not None and own[0].id == lane.id) for lane in self.lanes]
    columns = ["element", "id", "type", "status", "existence_probability", "length_m", "width_m", "direction", "own", "points"]
    return _pandas().DataFrame(rows, columns=columns)


def evaluation_to_pandas(self: Evaluation) -> Any:
    """One row for each kind of line."""
    scores = [getattr(self, kind) for kind in KINDS]
    names = ("precision", "recall", "f1", "acd_m", "truths", "predictions", "matches")
    return _pandas().DataFrame({name: [getattr(score, name) for score in scores] for name in names}, index=list(KINDS))


def evaluation_to_html(self: Evaluation) -> str:
    """What notebooks show of an Evaluation."""
    head = "".join(f"<th>{name}</th>" for name in ("", "precision", "recall", "F1", "ACD"))
    rows = ""
    for kind in KINDS:
        score = getattr(self, kind)
        cells = "".join(f"<td>{value}</td>" for value in (
            f"{score.precision:.1%}", f"{score.recall:.1%}", f"{score.f1:.1%}", f"{score.acd_m:.3f} m"))
        rows += f"<tr><th>{kind}</th>{cells}</tr>"
    return f"<table><caption>{self.frames} frames</caption><tr>{head}</tr>{rows}</table>"
