"""Closes the lips of a shaped body: MakeHuman's stand a little open towards the corners of the mouth."""

import numpy as np
from scipy.spatial import cKDTree

from . import rig, surface

BOX = ((-0.033, 0.033), (0.650, 0.672), (0.128, 0.160))  # where the slit is in the base mesh [m]
OVERLAP = 0.0007  # [m] lips press into each other by this
SPREAD = 0.004  # [m] how far the closing reaches into the lips


def closed(package, points):
    """(V, 3) [m] the same body with lips that touch all along."""
    base = package.base
    body = base.quads[base.groups == 0]
    held = rig.base_weights(package)[:, rig.NAMES.index("jaw")] > 0.5
    inside = np.arange(len(points)) <= body.max()
    for axis, (low, high) in enumerate(BOX):
        inside &= (base.points[:, axis] > low) & (base.points[:, axis] < high)
    for _ in range(3):
        up = surface.normals_of(points, body)[:, 1]
        upper = np.flatnonzero(inside & ~held & (up < -0.45))
        lower = np.flatnonzero(inside & held & (up > 0.45))
        points = points + _shift(points, upper, lower, inside & ~held, -1)
        points = points + _shift(points, lower, upper, inside & held, 1)
    return points


def _shift(points, lip, other, region, sign):
    """(V, 3) moves of one lip half of the way to the other."""
    flat = [0, 2]
    far, near = cKDTree(points[other][:, flat]).query(points[lip][:, flat], k=3)
    share = 1 / (far + 1e-4)
    height = (points[other][near][..., 1] * share).sum(1) / share.sum(1)
    gap = sign * (height - points[lip][:, 1]) + OVERLAP
    need = np.where(far[:, 0] < 0.003, np.clip(gap, 0, 0.004), 0) / 2
    beside = np.abs(points[lip][:, 0]) / np.abs(points[lip][:, 0]).max()
    need *= np.clip((1 - beside) / 0.15, 0, 1)  # the corners are closed as they are
    moves = np.zeros_like(points)
    rows = np.flatnonzero(region)
    apart = np.linalg.norm(points[rows][:, None] - points[lip][None], axis=2)
    weight = np.exp(-((apart / SPREAD) ** 2))
    moves[rows, 1] = sign * (weight * need).sum(1) / np.maximum(weight.sum(1), 1.0)
    return moves
