"""Where the joints of the figure are, and the frames of its limbs. All lengths in metres.

1.72 m tall, +y up, facing +z, standing on y = 0. Only the left half (x > 0) is described,
the right one is its mirror image.
"""

import numpy as np

from .shapes import FRONT, UP, Frame, unit


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
THUMB_POINTS = [
    HAND.point(*p) for p in ((0.018, 0.009, 0.020), (0.050, 0.021, 0.043), (0.077, 0.026, 0.060), (0.103, 0.028, 0.070))
]


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
CENTRE_PARENTS = {
    "hips": None,
    "spine": "hips",
    "chest": "spine",
    "upper_chest": "chest",
    "neck": "upper_chest",
    "head": "neck",
}
