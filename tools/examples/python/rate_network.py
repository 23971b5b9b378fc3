#!/usr/bin/python3
"""Rates a network: how good its single frames are, and how good the map is that laneloom makes of them.

    rate_network.py road.truth.json road.frames.jsonl [picture.png]

Files to try it with: laneloom simulate --scenario town --truth town.truth.json --frames town.frames.jsonl
The cells begin with # %%, as notebooks of many editors know them.
"""
# %%
import sys

import laneloom

# %% The truth of the road, and what the network saw of it. Frames can be made of arrays as well: see Frame, Detection.
truth = laneloom.Truth.load(sys.argv[1])
frames = laneloom.read_frames(sys.argv[2])

# %% The maps, one per frame
mapper = laneloom.Mapper()
maps = [mapper.update(frame, pose) for frame, pose in frames]

# %% What a planner drives on: the own way of the last map
if maps[-1].way:
    print(f"way: {maps[-1].way.known:.0f} m known, {maps[-1].way.confirmed:.0f} m confirmed, begins with")
    for station in maps[-1].way.stations[:3]:
        x, y, _ = station.point
        print(f"  x {x:.2f} m, y {y:.2f} m, heading {station.heading:.3f} rad, curvature {station.curvature:.4f}/m")

# %% The figures
raw, fused = laneloom.evaluate(truth, frames=frames), laneloom.evaluate(truth, maps)
print(f"single frames: F1 {raw.markings.f1:.3f}, mAP {raw.mean_ap:.3f}")
print(f"fused maps:    F1 {fused.markings.f1:.3f}, mAP {fused.mean_ap:.3f}, lanes F1 {fused.lane.f1:.3f}")

# %% A picture of the last moment
if len(sys.argv) > 3:
    laneloom.render(sys.argv[3], maps[-1], frame=frames[-1], truth=truth, title=truth.name)
