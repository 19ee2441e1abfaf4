"""The figure: its left half as implicit shapes, its clothes, and how fine its mesh is. All lengths in metres.

A table row of a limb: along, centre to the side, centre to the front, radius to +side, -side, +front, -front.
"""

import numpy as np

from .hand import hand
from .head import head, neck
from .shapes import Blend, HalfSpace, Loft, Paired, add, ball, keep, strand, upright
from .skeleton import FINGERS, FOOT, FOREARM, HAND, THUMB_POINTS, UPPER_ARM


def trunk():
    rows = [
        (0.880, 0, -0.006, 0.1370, 0.1370, 0.0905, 0.0945),
        (0.905, 0, -0.006, 0.1385, 0.1385, 0.0915, 0.0955),
        (0.940, 0, -0.005, 0.1430, 0.1430, 0.0955, 0.0970),
        (0.985, 0, -0.004, 0.1440, 0.1440, 0.098, 0.093),
        (1.040, 0, -0.002, 0.1400, 0.1400, 0.098, 0.085),
        (1.090, 0, -0.002, 0.136, 0.136, 0.095, 0.081),
        (1.140, 0, -0.006, 0.137, 0.137, 0.096, 0.084),
        (1.200, 0, -0.013, 0.1445, 0.1445, 0.101, 0.089),
        (1.260, 0, -0.020, 0.153, 0.153, 0.105, 0.092),
        (1.300, 0, -0.024, 0.155, 0.155, 0.099, 0.092),
        (1.330, 0, -0.026, 0.154, 0.154, 0.092, 0.091),
        (1.340, 0, -0.0265, 0.1535, 0.1535, 0.0905, 0.0910),
    ]
    neck_slope = strand(((0, 1.496, -0.034), 0.026), ((0.090, 1.432, -0.034), 0.027), ((0.160, 1.402, -0.024), 0.026))
    breast = ball([0.074, 1.290, 0.034], (0.080, 0.078, 0.042), along=(0.30, 1, -0.22))
    shoulder_blade = ball([0.088, 1.310, -0.089], (0.085, 0.058, 0.026), along=(-0.15, 1, 0.15))
    flank = ball([0.126, 1.245, -0.045], (0.100, 0.030, 0.052), along=(0.28, 1, 0))
    spine_muscle = strand(
        ((0.034, 0.99, -0.066), 0.022), ((0.034, 1.10, -0.064), 0.024), ((0.036, 1.25, -0.092), 0.020)
    )
    collar_bone = strand(
        ((0.014, 1.400, 0.006), 0.009), ((0.075, 1.407, 0.006), 0.008), ((0.150, 1.408, -0.012), 0.008)
    )
    return Blend(
        add(Loft(upright([0, 0, 0]), rows, power=2.3, caps=(0.070, 0.098))),
        add(Paired(neck_slope, 0.012), 0.07),
        add(Paired(breast, 0.045), 0.10),
        add(Paired(shoulder_blade, 0.03), 0.07),
        add(flank, 0.07),
        add(Paired(spine_muscle, 0.012), 0.05),
        add(Paired(collar_bone, 0.02), 0.035),
    )


def leg():
    rows = [
        (0.060, 0.104, -0.017, 0.031, 0.031, 0.034, 0.035),
        (0.090, 0.104, -0.016, 0.0325, 0.033, 0.034, 0.036),
        (0.130, 0.103, -0.015, 0.0325, 0.031, 0.034, 0.035),
        (0.200, 0.102, -0.015, 0.0395, 0.036, 0.038, 0.043),
        (0.270, 0.101, -0.014, 0.0480, 0.046, 0.042, 0.058),
        (0.325, 0.100, -0.013, 0.0525, 0.051, 0.044, 0.067),
        (0.375, 0.099, -0.012, 0.0525, 0.052, 0.045, 0.066),
        (0.430, 0.098, -0.007, 0.0490, 0.051, 0.047, 0.056),
        (0.485, 0.097, -0.002, 0.0500, 0.053, 0.052, 0.051),
        (0.540, 0.096, 0.004, 0.0540, 0.056, 0.058, 0.056),
        (0.610, 0.096, 0.006, 0.0605, 0.061, 0.068, 0.063),
        (0.700, 0.096, 0.004, 0.0685, 0.0735, 0.077, 0.074),
        (0.780, 0.095, 0.000, 0.0730, 0.0825, 0.081, 0.082),
        (0.840, 0.0925, -0.003, 0.0760, 0.0860, 0.0815, 0.0865),
        (0.890, 0.091, -0.006, 0.0750, 0.0860, 0.0800, 0.0870),
    ]
    kneecap = ball([0.097, 0.497, 0.036], (0.030, 0.024, 0.018))
    inner_calf = ball([0.084, 0.350, -0.046], (0.085, 0.026, 0.030))
    outer_calf = ball([0.116, 0.365, -0.044], (0.075, 0.024, 0.028))
    return Blend(
        add(Loft(upright([0, 0, 0]), rows, power=2.1, caps=(0.03, 0.11))),
        add(kneecap, 0.03),
        add(inner_calf, 0.04),
        add(outer_calf, 0.04),
    )


def buttock():
    return ball([0.080, 0.895, -0.068], (0.080, 0.074, 0.062), along=(0.1, 1, 0.12))


def foot():
    rows = [  # the sole is cut flat, so the lower radii reach below the floor
        (-0.036, 0, 0.032, 0.0250, 0.0260, 0.034, 0.055),
        (-0.010, 0, 0.032, 0.0310, 0.0320, 0.045, 0.055),
        (0.030, 0, 0.032, 0.0335, 0.0345, 0.050, 0.055),
        (0.070, 0, 0.031, 0.0370, 0.0385, 0.038, 0.054),
        (0.110, 0, 0.028, 0.0425, 0.0435, 0.026, 0.051),
        (0.145, 0.001, 0.025, 0.0445, 0.0455, 0.019, 0.048),
        (0.170, 0.002, 0.024, 0.0415, 0.0440, 0.016, 0.047),
    ]
    above_sole = HalfSpace([0, 0.0035, 0], [0, -1, 0])
    return Blend(add(Loft(FOOT, rows, power=2.3, caps=(0.030, 0.036))), keep(above_sole, 0.020))


def arm():
    upper = [
        (-0.030, 0.002, 0.000, 0.044, 0.034, 0.043, 0.045),
        (0.030, 0.000, 0.000, 0.045, 0.0415, 0.047, 0.048),
        (0.080, 0.000, 0.000, 0.045, 0.0440, 0.0465, 0.0485),
        (0.130, 0.000, 0.000, 0.0425, 0.0420, 0.0450, 0.0465),
        (0.180, 0.000, 0.000, 0.0395, 0.0395, 0.0440, 0.0435),
        (0.235, 0.000, 0.000, 0.0365, 0.0365, 0.0395, 0.0400),
        (0.288, 0.000, 0.000, 0.0350, 0.0345, 0.0360, 0.0385),
    ]
    lower = [
        (0.000, 0.000, 0.000, 0.0350, 0.0345, 0.0360, 0.0380),
        (0.035, 0.000, 0.001, 0.0370, 0.0360, 0.0400, 0.0360),
        (0.070, 0.000, 0.002, 0.0380, 0.0365, 0.0410, 0.0345),
        (0.110, 0.000, 0.001, 0.0350, 0.0335, 0.0385, 0.0325),
        (0.155, 0.000, 0.000, 0.0290, 0.0280, 0.0330, 0.0290),
        (0.200, 0.000, 0.000, 0.0230, 0.0225, 0.0285, 0.0265),
        (0.235, 0.000, 0.000, 0.0198, 0.0192, 0.0270, 0.0260),
        (0.262, 0.000, 0.000, 0.0190, 0.0182, 0.0265, 0.0258),
    ]
    deltoid = ball(UPPER_ARM.point(0.068, -0.003, 0.002), (0.072, 0.0405, 0.045), along=UPPER_ARM.along)
    biceps = ball(UPPER_ARM.point(0.165, 0.0, 0.018), (0.075, 0.030, 0.030), along=UPPER_ARM.along)
    triceps = ball(UPPER_ARM.point(0.135, 0.004, -0.020), (0.080, 0.033, 0.030), along=UPPER_ARM.along)
    elbow_tip = ball(FOREARM.point(-0.004, 0.0, -0.0245), (0.022, 0.0145, 0.0145), along=FOREARM.along)
    wrist_bone = ball(FOREARM.point(0.234, -0.011, -0.017), (0.016, 0.009, 0.009), along=FOREARM.along)
    return Blend(
        add(Loft(UPPER_ARM, upper, caps=(0.04, 0.04))),
        add(Loft(FOREARM, lower, power=2.15, caps=(0.04, 0.020)), 0.012),
        add(deltoid, 0.03),
        add(biceps, 0.03),
        add(triceps, 0.03),
        add(elbow_tip, 0.02),
        add(wrist_bone, 0.014),
    )


def figure():
    """The surface for x >= 0. What touches x = 0 is even in x, so the mirror image continues it smoothly."""
    return Blend(
        add(trunk()),
        add(Paired(leg(), 0.010), 0.050),
        add(Paired(buttock(), 0.014), 0.050),
        add(neck(), 0.045),
        add(head(), 0.021),
        add(arm(), 0.045),
        add(foot(), 0.030),
        add(hand(), 0.014),
    )


# ---- Clothes: a body suit with short sleeves, and shoes. Positive on the far side of each border.
def bare_skin(points):
    """[m] above 0 where the skin is bare: past the sleeve's hem and above the collar."""
    x, y, z = points.T
    along = UPPER_ARM.local(points)[0] - 0.205
    arm_side = np.where((x > 0.215) & (y > 0.70), along, -1.0)
    collar = np.where(y > 1.30, y - 1.447 + 0.34 * (z + 0.02) - 3.0 * x**2, -1.0)
    return np.maximum(arm_side, collar)


def shoe(points):
    """[m] above 0 where the shoe covers the foot."""
    x, y, z = points.T
    return 0.088 - y - 0.25 * (z + 0.016)


# ---- How fine the mesh is: near a bone (from, to, reach) edges are `size` long, growing with distance.
def mesh_spots():
    knee, ankle = np.array([0.097, 0.488, 0.0]), np.array([0.103, 0.083, -0.016])
    spots = [
        (HAND.point(0.01), HAND.point(0.09), 0.025, 0.0062),
        (UPPER_ARM.origin, UPPER_ARM.point(0.25), 0.05, 0.0170),
        (FOREARM.point(-0.02), FOREARM.point(0.02), 0.03, 0.0125),
        (FOREARM.point(0.04), FOREARM.point(0.20), 0.04, 0.0150),
        (np.array([0, 1.60, 0.095]), np.array([0, 1.53, 0.090]), 0.045, 0.0064),
        (np.array([0.015, 1.625, 0.100]), np.array([0, 1.585, 0.110]), 0.014, 0.0046),
        (np.array([0.078, 1.60, 0.0]), np.array([0.080, 1.61, 0.0]), 0.025, 0.0046),
        (np.array([0, 1.62, 0.0]), np.array([0, 1.63, 0.0]), 0.10, 0.0105),
        (np.array([0, 1.44, -0.03]), np.array([0, 1.50, -0.01]), 0.055, 0.0130),
        (knee, knee, 0.06, 0.019),
        (ankle, FOOT.point(0.15, 0, 0.01), 0.035, 0.0105),
    ]
    for spec in FINGERS:
        spots.append((spec.root, spec.frame.point(spec.lengths.sum() - 0.01), 0.010, 0.0042))
        spots.append((spec.frame.point(spec.lengths.sum()), spec.frame.point(spec.lengths.sum()), 0.009, 0.0034))
    spots.append((THUMB_POINTS[1], THUMB_POINTS[3], 0.012, 0.0046))
    return spots


SPOTS = mesh_spots()
COARSEST = 0.0225  # [m]


def edge_length(points):
    """The edge length [m] wanted at `points` (N, 3)."""
    sizes = [size + 0.22 * np.maximum(near(points, a, b) - reach, 0) for a, b, reach, size in SPOTS]
    return np.minimum(np.min(sizes, axis=0), COARSEST)


def near(points, a, b):
    """Distance (N,) of `points` to the segment a-b."""
    span = b - a
    share = np.clip((points - a) @ span / max(np.dot(span, span), 1e-12), 0, 1)
    return np.linalg.norm(points - a - share[:, None] * span, axis=1)
