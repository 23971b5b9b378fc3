"""Writes the detections of a network as laneloom reads them without DDS: one frame a line (tools/ten-minutes.md)."""
import json, math, sys

def frame(t_s, x_m, y_m, yaw_rad, lines):  # the pose in the map frame; lines in the body frame: x forward, y left
    return json.dumps({"t": t_s, "pose": [x_m, y_m, 0, 0, 0, math.sin(yaw_rad / 2), math.cos(yaw_rad / 2)],
                       "detections": [{"type": "laneline", "score": 0.9, "points": line} for line in lines]})

with open(sys.argv[1], "w") as drive:  # 20 s at 10 Hz and 15 m/s, between two lines that lie 3.5 m apart
    for i in range(200):
        seen = [[[ahead_m, side_m, 0] for ahead_m in range(0, 31, 2)] for side_m in (-1.75, 1.75)]
        print(frame(0.1 * i, 1.5 * i, 0.0, 0.0, seen), file=drive)
