#!/usr/bin/env python3
"""Makes mannequin.glb, the project's own avatar, from its description in mannequin/body.py.

Usage: make_mannequin.py [OUT.glb]
Needs numpy, scipy and scikit-image. Same program, same bytes.
"""

import sys
from pathlib import Path

import numpy as np

from mannequin import body, check, clothes, glb, skin, surface

SKIN, SUIT, SHOES = 0, 1, 2
LIFT = {SKIN: 0.0, SUIT: 0.0016, SHOES: 0.0034}  # height above the skin [m]
MATERIALS = [
    glb.material("skin", (216, 190, 169), 0.62),
    glb.material("suit", (84, 99, 116), 0.78),
    glb.material("shoes", (46, 52, 62), 0.70),
]


def grid(*spans):
    """Grid lines from spans (start, stop, step) [m]."""
    return np.unique(np.round(np.concatenate([np.arange(*span) for span in spans]), 6))


def mesh_half(shape):
    """Vertices, faces and labels of the half x >= 0."""
    axes = (
        grid((0, 0.10, 0.006), (0.10, 0.50, 0.009), (0.50, 0.80, 0.0035)),
        grid((-0.02, 0.82, 0.009), (0.82, 1.10, 0.004), (1.10, 1.46, 0.009), (1.46, 1.75, 0.005)),
        grid((-0.17, 0.0, 0.008), (0.0, 0.14, 0.004), (0.14, 0.25, 0.006)),
    )
    half = surface.Surface(*surface.polygonise(shape, axes))
    surface.remesh(half, shape, body.edge_length, (), 3)
    points, faces, _ = half.arrays()
    half = surface.Surface(points, faces, [SUIT] * len(faces))
    surface.cut(half, body.bare_skin, SKIN)
    surface.cut(half, body.shoe, SHOES)
    surface.remesh(half, shape, body.edge_length, (body.bare_skin, body.shoe), 7)
    return half.arrays()


def main():
    here = Path(__file__).resolve().parent
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else here / "mannequin.glb"
    shape = body.figure()
    points, faces, labels = mesh_half(shape)
    weights = skin.weigh(points, faces)
    patches = clothes.dress(shape, (points, faces, labels), weights, LIFT)
    check.check(patches)
    glb.write_glb(path, "mannequin", patches, MATERIALS, (skin.joint_parents(), skin.joint_points()))
    triangles = sum(len(patch["faces"]) for patch in patches)
    print(f"{path}: {triangles} triangles, {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()
