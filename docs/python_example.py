#!/usr/bin/python3
"""A lake, what its mesh is like, and a picture: python_example.py [LAKE] [PICTURE.png]."""
import sys

import numpy as np

import coastmesh

lake = sys.argv[1] if len(sys.argv) > 1 else "data/lake_superior.geojson"
picture = sys.argv[2] if len(sys.argv) > 2 else "python_example.png"


def show(phase, share):
    print(f"\r{phase} {share:4.0%}", end="", flush=True)


mesh = coastmesh.mesh(lake, min_angle=34, size_max=10000, progress=show)
print(f"\r{mesh}, {mesh.area.sum() / 1e6:,.0f} km²")

# How long edges are, from the arrays alone.
a, b = mesh.points[mesh.triangles], mesh.points[np.roll(mesh.triangles, 1, axis=1)]
middle = np.radians((a[..., 1] + b[..., 1]) / 2)
degree = 111_195  # metres along a meridian
lengths = np.hypot((a[..., 0] - b[..., 0]) * np.cos(middle), a[..., 1] - b[..., 1]) * degree
print("edges, metres: least {:.0f}, median {:.0f}, most {:.0f}".format(lengths.min(), np.median(lengths), lengths.max()))

# How the smallest angles are spread.
counts, steps = np.histogram(mesh.min_angle, bins=np.arange(10, 61, 5))
for low, count in zip(steps, counts):
    print(f"{low:3d}° {'#' * int(60 * count / counts.max())} {count}")

islands = [chain for chain in mesh.boundaries if chain["role"] == "island"]
print(f"{len(islands)} islands, the longest shore has {max(len(i['nodes']) for i in islands)} points")
mesh.plot(picture, color="size", size=1200, overwrite=True)
