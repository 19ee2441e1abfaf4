"""Two eyeballs with a raised cornea, and their texture: clear white, an iris with fibres, a dark pupil."""

import numpy as np

from .surface import Surface, triangles_of

RINGS, SPOKES = 13, 20
REACH = 1.75  # [rad] angle from the gaze to the last ring; the back is never seen
IRIS = 0.455  # [rad] angle from the gaze to the rim of the iris
BULGE = 0.075  # height of the cornea, in radii
IRIS_COLOURS = {
    "brown_eye": ((0.30, 0.17, 0.09), (0.45, 0.28, 0.15)),
    "brownlight_eye": ((0.24, 0.13, 0.07), (0.36, 0.21, 0.11)),
    "grey_eye": ((0.34, 0.40, 0.42), (0.50, 0.53, 0.48)),
}


def _ring_angles():
    """(RINGS + 1) [rad] from the gaze outwards, finer over the iris."""
    return REACH * (np.arange(RINGS + 1) / RINGS) ** 1.35


def eyeball(centre, radius, joint, joints):
    """Surface of one eye that looks along +z."""
    angles = _ring_angles()
    spokes = np.arange(SPOKES + 1) / SPOKES * 2 * np.pi
    angle, spoke = (grid.ravel() for grid in np.meshgrid(angles, spokes, indexing="ij"))
    ratio = np.clip(1 - (angle / (IRIS * 1.15)) ** 2, 0, 1)
    far = radius * (1 + BULGE * ratio**1.5)
    outward = np.stack([np.sin(angle) * np.cos(spoke), np.sin(angle) * np.sin(spoke), np.cos(angle)], 1)
    points = outward * far[:, None]
    normals = _normals(points.reshape(RINGS + 1, SPOKES + 1, 3)).reshape(-1, 3)
    i, k = (grid.ravel() for grid in np.meshgrid(np.arange(RINGS), np.arange(SPOKES), indexing="ij"))
    first = i * (SPOKES + 1) + k
    quads = np.stack([first, first + SPOKES + 1, first + SPOKES + 2, first + 1], 1)
    reach = angle / REACH / 2
    uvs = np.stack([0.5 + reach * np.cos(spoke), 0.5 - reach * np.sin(spoke)], 1)
    weights = np.zeros((len(points), joints))
    weights[:, joint] = 1
    triangles = triangles_of(quads)
    triangles = triangles[_area(points, triangles) > 1e-12]
    return Surface(points + centre, normals, uvs, triangles, weights)


def _area(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1)


def _normals(grid):
    along = np.gradient(grid, axis=0)
    around = np.roll(grid[:, :-1], -1, 1) - np.roll(grid[:, :-1], 1, 1)
    around = np.concatenate([around, around[:, :1]], 1)
    normals = np.cross(along, around)
    normals[0] = [0, 0, 1]
    return normals / np.linalg.norm(normals, axis=2, keepdims=True)


def texture(size, iris, seed):
    """(size, size, 3) sRGB in [0, 1]."""
    random = np.random.RandomState(seed)
    y, x = (np.mgrid[:size, :size] + 0.5) / size * 2 - 1
    angle = np.hypot(x, y) * REACH
    spoke = np.arctan2(y, x)
    part = angle / IRIS  # 0 in the pupil, 1 at the rim
    # White that turns warmer and a little darker to the back.
    back = np.clip((angle - IRIS) / 0.8, 0, 1)[..., None]
    colour = (1 - back) * np.array([0.84, 0.83, 0.82]) + back * np.array([0.74, 0.66, 0.62])
    # Fibres: sums of waves around the iris, a darker rim, a lighter ring about the pupil.
    fibres = np.zeros_like(angle)
    for waves in (7, 13, 29, 47, 61, 83):
        fibres += np.sin(waves * spoke + random.uniform(0, 6.28) + 3 * part) / 6
    dark, light = (np.array(c) for c in IRIS_COLOURS[iris])
    mix = np.clip(0.45 + 0.35 * fibres + 0.55 * (0.75 - part), 0, 1)[..., None]
    inside = dark * (1 - mix) + light * mix
    inside *= 1 - 0.55 * np.clip((part - 0.78) / 0.22, 0, 1)[..., None]
    blend = np.clip((1.06 - part) / 0.14, 0, 1)[..., None]
    colour = colour * (1 - blend) + inside * blend
    pupil = np.clip((0.40 - part) / 0.05, 0, 1)[..., None]
    return colour * (1 - pupil) + 0.015 * pupil
