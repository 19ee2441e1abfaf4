"""Folds of a shirt as light and dark: rings at the elbows, rays from the armpits, drapes above the hem.

The folds are heights over the cloth, as a function of the place; what is seen of them is their slope towards the light.
Heights, lengths and reaches are ours, chosen by looking at the shirts at `upper` and `head`.
"""

import numpy as np

LIGHT = np.array([0.35, 0.80, 0.48])  # from above, from the figure's left and from the front
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


def heights(places, joints, hem):
    """(N) [m] of the cloth at places (N, 3) [m]; `joints` by name, `hem` [m] the lower edge."""
    noise, slow = _wander(places, 51), _wander(places * 0.5, 52)
    total = np.zeros(len(places))
    for side in ("left", "right"):
        shoulder, elbow = joints[f"{side}_upper_arm"], joints[f"{side}_lower_arm"]
        along = (elbow - shoulder) / np.linalg.norm(elbow - shoulder)
        beyond = (places - elbow) @ along
        off = places - elbow - beyond[:, None] * along
        near = _bump(np.linalg.norm(off, axis=1), 0.09)
        inner = 0.6 + 0.4 * np.tanh(off[:, 2] / 0.02)
        total += 0.0016 * near * inner * _bump(beyond, 0.07) * np.sin(2 * np.pi * beyond / 0.026 + 2.5 * noise + 1.5 * slow)
        outward = np.array([np.sign(shoulder[0]), 0, 0])
        away = places - (shoulder + np.array([0, -0.055, 0]) + 0.06 * outward)
        angle = np.arctan2(away[:, 1], -away @ outward)
        reach = np.linalg.norm(away, axis=1)
        fan = _bump(angle + 0.25, 0.45) * _bump(reach - 0.125, 0.045) * np.clip((reach - 0.05) / 0.05, 0, 1)
        total += 0.0016 * fan * (0.6 + 0.4 * slow) * np.sin(20 * angle + 2.0 * noise)
    over = places[:, 1] - hem
    middle = _bump(over - 0.11, 0.09)
    slanted = places[:, 1] + 0.30 * np.abs(places[:, 0]) * np.tanh(6 * (0.4 + slow))
    total += 0.0018 * middle * (0.55 + 0.45 * slow) * np.sin(2 * np.pi * slanted / 0.042 + 3.0 * noise)
    return total + 0.0012 * slow * np.clip(over / 0.05, 0, 1)


def light_on(places, joints, hem):
    """(H, W) light and dark about 1 of the texels at `places` (H, W, 3) [m]; 1 where nothing is."""
    light = LIGHT / np.linalg.norm(LIGHT)
    known = np.isfinite(places[..., 0])
    there = places[known]
    slope = (heights(there - DELTA * light, joints, hem) - heights(there + DELTA * light, joints, hem)) / (2 * DELTA)
    shade = np.ones(places.shape[:2])
    shade[known] = np.clip(1 + 0.55 * slope, 0.72, 1.18)
    return shade
