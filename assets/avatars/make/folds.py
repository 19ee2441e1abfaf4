"""Folds of a shirt as a normal map: rings at the elbows, rays from the armpits, drapes above the lower
edge, a seam along every edge.

The folds are heights over the cloth, as a function of the place; what is seen of them is their slope, and a little of
the dark in their furrows, which is the same wherever the light is.
Heights, lengths and reaches are ours, chosen by looking at the shirts at `upper` and `head`.
"""

import numpy as np
from scipy.ndimage import distance_transform_edt
from scipy.spatial import cKDTree

from . import hems
from .surface import in_texture, tangents_of

# [1/m] of depth that a furrow darkens, and the least that is left; ours, so that folds still read where light is flat.
FURROW, FURROW_DARKEST = 60, 0.85
# [m] from an edge of the cloth its seam lies, how wide and how deep it is drawn in, and how much thicker the cloth is
# that is folded over there; ours, so that it reads at `head` and is a hint at `upper`.
SEAM_AT, SEAM_WIDE, SEAM_DEEP, DOUBLED = 0.016, 0.0020, 0.0012, 0.0008
DELTA = 0.0015  # [m] between the places whose heights are compared


def _bump(distance, reach):
    return np.exp(-((distance / reach) ** 2))


def _wander(places, seed):
    """Smooth noise in [-1, 1], a few centimetres coarse: sums of waves in directions of their own."""
    random = np.random.RandomState(seed)
    total = 0
    for _ in range(6):
        direction = random.standard_normal(3)
        total = total + np.sin(places @ direction / np.linalg.norm(direction) * random.uniform(40, 110) + random.uniform(0, 6.28))
    return total / 6


def _ridges(phase):
    """Folds of height about 1 with narrow ridges and wide furrows, as cloth has that is pushed together."""
    return (np.exp(1.3 * np.sin(phase)) - 1.46) / 2


def heights(places, joints, edges):
    """(N) [m] of the cloth at places (N, 3) [m]; `joints` by name, `edges` a tree of places along its open edges."""
    noise, slow = _wander(places, 51), _wander(places * 0.5, 52)
    patches = np.clip(0.55 + 1.6 * slow, 0.1, 1)  # folds come in groups
    total = np.zeros(len(places))
    for side in ("left", "right"):
        shoulder, elbow = joints[f"{side}_upper_arm"], joints[f"{side}_lower_arm"]
        along = (elbow - shoulder) / np.linalg.norm(elbow - shoulder)
        beyond = (places - elbow) @ along
        off = places - elbow - beyond[:, None] * along
        near = _bump(np.linalg.norm(off, axis=1), 0.09)
        inner = 0.6 + 0.4 * np.tanh(off[:, 2] / 0.02)
        rings = _ridges(2 * np.pi * (beyond + 0.35 * off[:, 2]) / 0.036 + 2.5 * noise + 1.5 * slow)
        total += 0.0032 * near * inner * _bump(beyond, 0.08) * rings
        outward = np.array([np.sign(shoulder[0]), 0, 0])
        away = places - (shoulder + np.array([0, -0.055, 0]) + 0.06 * outward)
        angle = np.arctan2(away[:, 1], -away @ outward)
        reach = np.linalg.norm(away, axis=1)
        fan = _bump(angle + 0.25, 0.55) * _bump(reach - 0.125, 0.060) * np.clip((reach - 0.05) / 0.05, 0, 1)
        total += 0.0034 * fan * (0.7 + 0.3 * slow) * _ridges(14 * angle + 2.0 * noise)
    over = places[:, 1] - edges.mins[1]
    middle = _bump(over - 0.12, 0.10)
    slanted = places[:, 1] + 0.45 * np.abs(places[:, 0]) * np.tanh(6 * (0.4 + slow))
    total += 0.0034 * middle * patches * _ridges(2 * np.pi * slanted / 0.058 + 2.2 * noise)
    within = SEAM_AT - edges.query(places, distance_upper_bound=2 * SEAM_AT)[0]
    total += DOUBLED / 2 * (1 + np.tanh(within / SEAM_WIDE)) - SEAM_DEEP * _bump(within, SEAM_WIDE)
    return total + 0.0015 * slow * np.clip(over / 0.05, 0, 1)


def drape(cloth, joints, size):
    """(size, size) how open a cloth lies at each texel, 1 but in furrows, and (size, size, 3) its normal map, +Y up."""
    frames = np.concatenate([cloth.points, cloth.normals, tangents_of(cloth)], 1)
    frames = in_texture(frames, cloth.uvs, cloth.triangles, size)
    edges = cKDTree(hems.along_edges(cloth))
    known = np.isfinite(frames[..., 0])
    places, normals, tangents = (frames[known][:, k : k + 3] for k in (0, 3, 6))
    upward = np.cross(normals, tangents) * np.sign(frames[known][:, 9:])
    slopes = [
        (heights(places + DELTA * way, joints, edges) - heights(places - DELTA * way, joints, edges)) / (2 * DELTA)
        for way in (tangents, upward)
    ]
    bumps = np.stack([-slopes[0], -slopes[1], np.ones(len(places))], 1)
    openness = np.ones(known.shape)
    openness[known] = np.clip(1 + FURROW * heights(places, joints, edges), FURROW_DARKEST, 1)
    map_ = np.empty((*known.shape, 3))
    map_[known] = 0.5 + 0.5 * bumps / np.linalg.norm(bumps, axis=1, keepdims=True)
    # Beyond the edges of the cloth its texels go on, so that no seam shows where the map is filtered.
    nearest = distance_transform_edt(~known, return_distances=False, return_indices=True)
    return openness, map_[tuple(nearest)]
