"""The figure: where its joints are and which shapes make its left half (x > 0). All lengths in metres.

1.72 m tall, +y up, facing +z, standing on y = 0. The right half is the mirror image.
"""

import numpy as np

from .shapes import Blend, Ellipsoid, Frame, HalfSpace, Loft, Paired, unit

FRONT = np.array([0.0, 0.0, 1.0])
UP = np.array([0.0, 1.0, 0.0])


def sloped(degrees, forward):
    """Unit vector to the left, `degrees` below the horizon and a little `forward`."""
    angle = np.radians(degrees)
    return unit([np.cos(angle), -np.sin(angle), forward])


# ---- Frames of the limbs: `along` points away from the trunk, `front` to +z (the thumb's side),
# ---- and so `side` of an arm or a hand points to the palm.
SHOULDER = np.array([0.164, 1.387, -0.015])
UPPER_ARM = Frame(SHOULDER, sloped(44, 0.05), FRONT)
UPPER_ARM_LENGTH = 0.288
FOREARM = Frame(UPPER_ARM.point(UPPER_ARM_LENGTH), sloped(42, 0.21), FRONT)
FOREARM_LENGTH = 0.250
HAND = Frame(FOREARM.point(FOREARM_LENGTH), sloped(44, 0.17), FRONT)
FOOT = Frame([0.103, 0.0, -0.016], unit([0.13, 0.0, 1.0]), UP)


class Finger:
    """A chain of three bones. `knuckle` is (along, palm, thumb side) in the hand's frame."""

    def __init__(self, name, knuckle, lengths, spread, curl, radius):
        self.name, self.lengths, self.radius = name, np.asarray(lengths), radius
        self.root = HAND.point(*knuckle)
        turn, bend = np.radians(spread), np.radians(curl)
        aim = np.cos(turn) * HAND.along + np.sin(turn) * HAND.front
        aim = np.cos(bend) * aim + np.sin(bend) * HAND.side
        self.frame = Frame(self.root, aim, HAND.front)

    def sag(self, along):
        """How far the slightly bent finger leaves its straight axis towards the palm."""
        total = self.lengths.sum()
        return -0.0045 * np.sin(np.pi * np.clip(along / total, 0, 1))

    def joints(self):
        """Points (3, 3): the near ends of the three bones."""
        starts = np.concatenate([[0], np.cumsum(self.lengths)[:2]])
        return [self.frame.point(s, self.sag(s)) for s in starts]


FINGERS = [
    Finger("index", (0.0900, -0.002, 0.0255), (0.0430, 0.0250, 0.0215), 5.5, 7, 0.00885),
    Finger("middle", (0.0920, -0.003, 0.0045), (0.0475, 0.0285, 0.0225), 0.5, 6, 0.0090),
    Finger("ring", (0.0870, -0.002, -0.0155), (0.0435, 0.0265, 0.0220), -4.5, 7, 0.0085),
    Finger("little", (0.0785, 0.000, -0.0330), (0.0345, 0.0200, 0.0195), -11.0, 9, 0.0076),
]
THUMB_POINTS = [HAND.point(*p) for p in ((0.018, 0.009, 0.020), (0.050, 0.021, 0.043), (0.077, 0.026, 0.060), (0.103, 0.028, 0.070))]


def left_joints():
    """Name -> point (3,) of the joints of the left limbs."""
    joints = {
        "shoulder": np.array([0.022, 1.412, 0.012]),
        "upper_arm": SHOULDER,
        "lower_arm": FOREARM.origin,
        "hand": HAND.origin,
        "upper_leg": np.array([0.088, 0.912, -0.002]),
        "lower_leg": np.array([0.097, 0.488, -0.004]),
        "foot": np.array([0.103, 0.083, -0.016]),
        "toes": FOOT.point(0.128, 0.0, 0.022),
    }
    for number in range(3):
        joints[f"thumb_{number + 1}"] = THUMB_POINTS[number]
        for finger in FINGERS:
            joints[f"{finger.name}_{number + 1}"] = finger.joints()[number]
    return joints


CENTRE_JOINTS = {
    "hips": np.array([0.0, 0.945, -0.004]),
    "spine": np.array([0.0, 1.035, -0.012]),
    "chest": np.array([0.0, 1.145, -0.020]),
    "upper_chest": np.array([0.0, 1.265, -0.030]),
    "neck": np.array([0.0, 1.440, -0.034]),
    "head": np.array([0.0, 1.542, -0.006]),
}

LIMB_PARENTS = {
    "shoulder": "upper_chest",
    "upper_arm": "shoulder",
    "lower_arm": "upper_arm",
    "hand": "lower_arm",
    "upper_leg": "hips",
    "lower_leg": "upper_leg",
    "foot": "lower_leg",
    "toes": "foot",
}
CENTRE_PARENTS = {"hips": None, "spine": "hips", "chest": "spine", "upper_chest": "chest", "neck": "upper_chest", "head": "neck"}


# ---- Shapes. A table row: along, centre side, centre front, radius +side, -side, +front, -front.
def upright(point):
    """A frame whose `along` is +y, `side` +x, `front` +z."""
    return Frame(point, UP, FRONT)


def ball(point, radii, along=UP, front=FRONT):
    """An ellipsoid with `radii` along `along`, sideways and along `front`."""
    return Ellipsoid(Frame(point, along, front), np.asarray(radii, float))


def strand(points, radii):
    """A round, tapering band through `points` (straight between the first and the last)."""
    points = [np.asarray(p, float) for p in points]
    frame = Frame(points[0], points[-1] - points[0], FRONT if abs(unit(points[-1] - points[0])[2]) < 0.9 else UP)
    rows = [(*np.ravel(frame.local(p)), r, r, r, r) for p, r in zip(points, radii)]
    return Loft(frame, rows, caps=(radii[0], radii[-1]))


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
    return Blend([
        (Loft(upright([0, 0, 0]), rows, power=2.3, caps=(0.070, 0.098)), "add", 0),
        (Paired(strand([(0, 1.496, -0.034), (0.090, 1.432, -0.034), (0.160, 1.402, -0.024)], (0.026, 0.027, 0.026)), 0.012), "add", 0.07),
        (Paired(ball([0.074, 1.290, 0.034], (0.080, 0.078, 0.042), along=(0.30, 1, -0.22)), 0.045), "add", 0.10),  # breast muscle
        (Paired(ball([0.088, 1.310, -0.089], (0.085, 0.058, 0.026), along=(-0.15, 1, 0.15)), 0.03), "add", 0.07),  # shoulder blade
        (ball([0.126, 1.245, -0.045], (0.100, 0.030, 0.052), along=(0.28, 1, 0)), "add", 0.07),  # broad back muscle
        (Paired(strand([(0.034, 0.99, -0.066), (0.034, 1.10, -0.064), (0.036, 1.25, -0.092)], (0.022, 0.024, 0.020)), 0.012), "add", 0.05),
        (Paired(strand([(0.014, 1.400, 0.006), (0.075, 1.407, 0.006), (0.150, 1.408, -0.012)], (0.009, 0.008, 0.008)), 0.02), "add", 0.035),  # collar bone
    ])


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
    return Blend([
        (Loft(upright([0, 0, 0]), rows, power=2.1, caps=(0.03, 0.11)), "add", 0),
        (ball([0.097, 0.497, 0.036], (0.030, 0.024, 0.018)), "add", 0.03),  # kneecap
        (ball([0.084, 0.350, -0.046], (0.085, 0.026, 0.030)), "add", 0.04),  # calf, inner head
        (ball([0.116, 0.365, -0.044], (0.075, 0.024, 0.028)), "add", 0.04),  # calf, outer head
    ])


def buttock():
    return ball([0.080, 0.895, -0.068], (0.080, 0.074, 0.062), along=(0.1, 1, 0.12))


def foot():
    rows = [  # the sole is cut flat below the tables' lower radius
        (-0.040, 0, 0.030, 0.024, 0.025, 0.034, 0.045),
        (-0.010, 0, 0.030, 0.031, 0.032, 0.046, 0.045),
        (0.030, 0, 0.030, 0.033, 0.034, 0.052, 0.045),
        (0.070, 0, 0.030, 0.036, 0.038, 0.040, 0.045),
        (0.110, 0, 0.028, 0.043, 0.044, 0.025, 0.043),
        (0.140, 0, 0.024, 0.046, 0.046, 0.017, 0.039),
        (0.165, 0.002, 0.021, 0.042, 0.044, 0.012, 0.036),
        (0.180, 0.005, 0.020, 0.034, 0.040, 0.010, 0.035),
    ]
    return Blend([
        (Loft(FOOT, rows, power=2.3, caps=(0.026, 0.026)), "add", 0),
        (HalfSpace([0, 0.0034, 0], [0, -1, 0]), "keep", 0.012),
    ])


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
    return Blend([
        (Loft(UPPER_ARM, upper, caps=(0.04, 0.04)), "add", 0),
        (Loft(FOREARM, lower, power=2.15, caps=(0.04, 0.020)), "add", 0.012),
        (ball(UPPER_ARM.point(0.068, -0.003, 0.002), (0.072, 0.0405, 0.045), along=UPPER_ARM.along), "add", 0.03),  # deltoid
        (ball(UPPER_ARM.point(0.165, 0.0, 0.018), (0.075, 0.030, 0.030), along=UPPER_ARM.along), "add", 0.03),  # biceps
        (ball(UPPER_ARM.point(0.135, 0.004, -0.020), (0.080, 0.033, 0.030), along=UPPER_ARM.along), "add", 0.03),  # triceps
        (ball(FOREARM.point(-0.005, 0.0, -0.027), (0.020, 0.014, 0.0145), along=FOREARM.along), "add", 0.02),  # elbow tip
        (ball(FOREARM.point(0.234, -0.011, -0.017), (0.016, 0.009, 0.009), along=FOREARM.along), "add", 0.014),  # ulna
    ])


def finger(spec):
    """Rows at the bone ends and between: knuckles bulge to the back, pads to the palm."""
    a, b, c = np.cumsum(spec.lengths)
    r = spec.radius
    rows = [  # along, palm, back, half width; in finger radii but for the first
        (-0.014, 0.85, 0.80, 0.88),
        (0.000, 0.95, 0.92, 1.00),
        (0.45 * a, 1.02, 0.86, 0.98),
        (a - 0.004, 0.90, 0.95, 1.02),
        (a + 0.003, 0.88, 0.95, 1.01),
        (0.5 * (a + b), 0.96, 0.78, 0.91),
        (b, 0.82, 0.80, 0.91),
        (0.45 * b + 0.55 * c, 0.90, 0.68, 0.85),
        (c - 0.006, 0.74, 0.58, 0.74),
    ]
    table = [(s, spec.sag(s), 0, p * r, d * r, w * r, w * r) for s, p, d, w in rows]
    return Loft(spec.frame, table, power=2.15, caps=(0.008, 0.007), margin=0.03)


def thumb():
    base, middle, last, tip = THUMB_POINTS
    frame = Frame(base, tip - base, HAND.side + 0.5 * HAND.front)
    s1, side1, front1 = frame.local(middle)
    s2, side2, front2 = frame.local(last)
    end = np.linalg.norm(tip - base)
    rows = [
        (0.000, 0, 0, 0.0125, 0.0125, 0.0130, 0.0110),
        (0.5 * s1, 0.5 * side1, 0.5 * front1, 0.0125, 0.0125, 0.0140, 0.0110),
        (s1, side1, front1, 0.0112, 0.0112, 0.0112, 0.0110),
        (0.5 * (s1 + s2), 0.55 * (side1 + side2), 0.55 * (front1 + front2), 0.0100, 0.0100, 0.0105, 0.0090),
        (s2, side2, front2, 0.0100, 0.0100, 0.0095, 0.0098),
        (0.45 * s2 + 0.55 * end, 0.4 * side2, 0.4 * front2, 0.0102, 0.0102, 0.0100, 0.0074),
        (end - 0.007, 0, 0, 0.0082, 0.0082, 0.0078, 0.0058),
    ]
    return Loft(frame, rows, power=2.1, caps=(0.010, 0.0075), margin=0.03)


def palm():
    rows = [  # along, palm centre, thumb centre, to the palm, to the back, thumb side, little side
        (-0.020, 0.000, 0.000, 0.0150, 0.0145, 0.0215, 0.0210),
        (0.004, 0.000, 0.000, 0.0180, 0.0168, 0.0270, 0.0265),
        (0.025, 0.000, 0.000, 0.0180, 0.0165, 0.0310, 0.0310),
        (0.048, 0.000, 0.000, 0.0160, 0.0145, 0.0350, 0.0380),
        (0.070, 0.000, -0.001, 0.0140, 0.0130, 0.0365, 0.0395),
        (0.086, 0.000, -0.002, 0.0118, 0.0112, 0.0350, 0.0370),
    ]
    base, middle = THUMB_POINTS[0], THUMB_POINTS[1]
    parts = [
        (Loft(HAND, rows, power=2.5, caps=(0.01, 0.012), margin=0.03), "add", 0),
        (ball(base + 0.45 * (middle - base), (0.030, 0.016, 0.0150), along=middle - base), "add", 0.014),
        (ball(HAND.point(0.038, 0.0085, -0.0240), (0.034, 0.0120, 0.0135), along=HAND.along), "add", 0.014),
        (ball(HAND.point(0.058, 0.0270, -0.0020), (0.026, 0.0130, 0.0170), along=HAND.along), "cut", 0.012),
    ]
    for spec in FINGERS:
        parts.append((ball(spec.root - 0.0035 * HAND.side, (0.011, 0.0085, 0.0085), along=HAND.along), "add", 0.010))
    return Blend(parts)


def web(first, second):
    """The fold of skin between two fingers."""
    middle = 0.5 * (first.frame.point(0.006, 0.002) + second.frame.point(0.006, 0.002))
    return ball(middle, (0.0125, 0.0050, 0.0075), along=first.frame.along + second.frame.along, front=HAND.front)


def hand():
    fingers = Blend([(finger(spec), "add", 0.003) for spec in FINGERS])
    webs = [(web(*pair), "add", 0.009) for pair in zip(FINGERS, FINGERS[1:])]
    return Blend([(palm(), "add", 0), *webs, (fingers, "add", 0.008), (thumb(), "add", 0.012)])


def neck():
    frame = Frame([0, 1.395, -0.040], [0, 1, 0.23], FRONT)
    rows = [
        (0.000, 0, 0, 0.068, 0.068, 0.058, 0.058),
        (0.045, 0, 0, 0.0535, 0.0535, 0.0545, 0.0550),
        (0.090, 0, 0, 0.0500, 0.0500, 0.0535, 0.0530),
        (0.140, 0, 0, 0.0495, 0.0495, 0.0535, 0.0520),
        (0.200, 0, 0, 0.0500, 0.0500, 0.0500, 0.0540),
    ]
    return Blend([
        (Loft(frame, rows, caps=(0.03, 0.03)), "add", 0),
        (Paired(strand([(0.054, 1.572, -0.016), (0.036, 1.495, 0.008), (0.012, 1.410, 0.018)], (0.012, 0.011, 0.009)), 0.008), "add", 0.026),
    ])


def nose():
    frame = Frame([0, 1.640, 0.080], [0, -1, 0.27], FRONT)
    rows = [
        (0.000, 0, 0, 0.0080, 0.0080, 0.0095, 0.02),
        (0.020, 0, 0, 0.0075, 0.0075, 0.0115, 0.02),
        (0.038, 0, 0, 0.0100, 0.0100, 0.0145, 0.02),
        (0.044, 0, 0, 0.0118, 0.0118, 0.0148, 0.02),
    ]
    return Loft(frame, rows, power=1.8, caps=(0.030, 0.019))


def ear():
    frame = Frame([0.0725, 1.600, -0.006], [0.12, 1, -0.20], [-0.42, 0, 1])
    tilted = Frame([0.0820, 1.603, 0.001], [0.12, 1, -0.20], [-0.42, 0, 1])
    return Blend([
        (Ellipsoid(frame, (0.0300, 0.0070, 0.0175)), "add", 0),
        (Ellipsoid(tilted, (0.0180, 0.0055, 0.0090)), "cut", 0.006),
    ])


def head():
    cranium = Ellipsoid(upright([0, 1.6320, 0.002]), (0.0880, 0.0750, 0.0950), power=2.1)
    face = Ellipsoid(Frame([0, 1.5790, 0.0315], (0, 1, -0.05), FRONT), (0.0800, 0.0580, 0.0640), power=2.15)
    jaw = strand([(0.014, 1.518, 0.056), (0.040, 1.540, 0.012), (0.048, 1.570, -0.004)], (0.013, 0.011, 0.012))
    return Blend([
        (cranium, "add", 0),
        (face, "add", 0.022),
        (Paired(ball([0.038, 1.592, 0.036], (0.026, 0.024, 0.030)), 0.012), "add", 0.035),  # cheekbone
        (Paired(jaw, 0.010), "add", 0.030),
        (ball([0, 1.521, 0.070], (0.015, 0.015, 0.015)), "add", 0.032),  # chin
        (ball([0, 1.550, 0.072], (0.022, 0.030, 0.016)), "add", 0.034),  # the volume of the mouth
        (Paired(ball([0.034, 1.617, 0.1235], (0.018, 0.032, 0.027)), 0.004), "cut", 0.020),  # eye socket
        (nose(), "add", 0.012),
        (ear(), "add", 0.013),
    ])


def figure():
    """The surface for x >= 0. What touches x = 0 is even in x, so the mirror image continues it smoothly."""
    return Blend([
        (trunk(), "add", 0),
        (Paired(leg(), 0.010), "add", 0.050),
        (Paired(buttock(), 0.014), "add", 0.050),
        (neck(), "add", 0.045),
        (head(), "add", 0.021),
        (arm(), "add", 0.045),
        (foot(), "add", 0.030),
        (hand(), "add", 0.014),
    ])


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
        (np.array([0.078, 1.60, 0.0]), np.array([0.080, 1.61, 0.0]), 0.025, 0.0058),
        (np.array([0, 1.62, 0.0]), np.array([0, 1.63, 0.0]), 0.10, 0.0105),
        (np.array([0, 1.44, -0.03]), np.array([0, 1.50, -0.01]), 0.055, 0.0130),
        (knee, knee, 0.06, 0.019),
        (ankle, FOOT.point(0.15), 0.03, 0.0135),
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
