"""The action units of a face as moves of the base mesh.

A unit is a sum of MakeHuman's expression targets with gains, and of small sculpted moves. Units with sides are made
mirror-symmetric and split by a smooth mask over the middle of the face. Each unit fades out at the edge of its region.
"""

import numpy as np

from . import rig, surface
from .person import ORIGINS

SIDED = (1, 2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 16, 20, 45)
MIDDLE = (17, 18, 19, 22, 23, 24, 25, 26, 28, 29, 34)
SIDEWAYS = 30  # its sides are directions
JAW_UNITS = (19, 26, 29, 30)  # these move teeth and tongue
TONGUE_UNITS = (19, 26)  # here the tongue lies on a jaw that drops
# A tongue that is shown: [m] how far it slides out, how far its tip bends down and over which length from the tip; how
# much it rises over the lower teeth, how far behind the tip and how wide that is; how far the corners of the tip are
# drawn back, and half of how wide it is; shares that it gets thinner and narrower. Ours, by eye on five people with the
# jaw dropped and not.
TONGUE_OUT, TONGUE_BEND, TONGUE_BENT = 0.034, 0.010, 0.022
TONGUE_OVER, TONGUE_OVER_AT, TONGUE_OVER_WIDE = 0.0045, 0.020, 0.018
TONGUE_ROUND, TONGUE_TIP = 0.005, 0.011
TONGUE_THIN, TONGUE_NARROW = 0.3, 0.2

# Unit: [(target, gain, part of the face that it is taken from)]. "*" stands for both sides; a name with a slash is a
# modelling target. Parts: whole, upper (what the skull holds), lower (what the jaw holds).
TARGETS = {
    1: [("eyebrows-*-inner-up", 1.9, "whole")],
    2: [("eyebrows-*-extern-up", 1.6, "whole")],
    4: [("eyebrows-*-down", 0.8, "whole")],
    5: [("eye-*-opened-up", 1.0, "whole")],
    6: [("eye-*-slit", 0.42, "whole"), ("cheek/*-cheek-trans-vert-up", 0.8, "whole"), ("cheek/*-cheek-inner-inflate", 0.8, "whole")],
    7: [("eye-*-slit", 0.72, "whole")],
    9: [
        ("nose-*-elevation", 1.6, "whole"),
        ("nose-compression", 0.6, "whole"),
        ("eyebrows-*-down", 0.3, "whole"),
        ("mouth-elevation", 0.3, "upper"),
    ],
    10: [("mouth-elevation", 0.8, "upper"), ("mouth-upward-retraction", 0.35, "upper")],
    12: [("mouth-corner-puller", 0.85, "whole"), ("cheek/*-cheek-trans-vert-up", 0.3, "whole")],
    14: [("mouth-retraction", 0.5, "whole"), ("mouth/mouth-dimples-in", 1.4, "whole"), ("mouth-compression", 0.25, "whole")],
    15: [("mouth-depression", 0.8, "whole")],
    16: [("mouth-part-later", 0.75, "lower")],
    17: [("mouth-eversion", 0.85, "whole")],
    18: [("mouth-pursing", 1.0, "whole")],
    19: [("mouth-open", 0.42, "whole"), ("mouth-parling", 0.4, "whole")],
    20: [("mouth-retraction", 1.15, "whole"), ("mouth/mouth-scale-horiz-incr", 0.35, "whole")],
    22: [("mouth-protusion", 0.55, "whole")],
    23: [
        ("mouth/mouth-upperlip-height-min", 0.7, "whole"),
        ("mouth/mouth-lowerlip-height-min", 0.7, "whole"),
        ("mouth/mouth-scale-horiz-decr", 0.4, "whole"),
    ],
    24: [
        ("mouth/mouth-upperlip-height-min", 1.0, "whole"),
        ("mouth/mouth-lowerlip-height-min", 1.0, "whole"),
        ("mouth/mouth-upperlip-volume-deflate", 0.6, "whole"),
        ("mouth/mouth-lowerlip-volume-deflate", 0.6, "whole"),
    ],
    25: [("mouth-parling", 1.15, "whole")],
    26: [("mouth-open", 0.62, "whole")],
    28: [
        ("mouth/mouth-upperlip-height-min", 1.5, "whole"),
        ("mouth/mouth-lowerlip-height-min", 1.5, "whole"),
        ("mouth/mouth-upperlip-volume-deflate", 1.2, "whole"),
        ("mouth/mouth-lowerlip-volume-deflate", 1.2, "whole"),
    ],
    29: [("mouth-parling", -0.15, "whole")],
    34: [("cheek/*-cheek-volume-inflate", 1.1, "whole"), ("mouth-compression", 0.2, "whole")],
    45: [("eye-*-closure", 1.0, "whole")],
}

# Unit: height [m, base mesh] below and above which it fades: (low, high), over FADE.
FADE = 0.014
BROWS = (0.728, 1.0)
LIDS = (0.700, 0.775)
MOUTH = (-1.0, 0.712)
REGIONS = {
    **{unit: BROWS for unit in (1, 2, 4)},
    **{unit: LIDS for unit in (5, 7, 45)},
    6: (0.672, 0.775),
    9: (0.660, 0.800),
    12: (-1.0, 0.722),
    34: (-1.0, 0.722),
    **{unit: MOUTH for unit in (10, 14, 15, 16, 17, 18, 19, 20, 22, 23, 24, 25, 26, 28)},
    **{unit: (0.580, 0.712) for unit in (29, 30)},
}
SMOOTHINGS = {1: 3, 2: 5, 4: 2, 15: 3, 12: 6, 14: 4, 10: 2, 16: 2, 9: 2, 6: 4, 34: 3, 20: 3}


def ramp(value, start, stop):
    """0 at start, 1 at stop, smooth between."""
    t = np.clip((value - start) / (stop - start), 0, 1)
    return t * t * (3 - 2 * t)


def rigid(places, moves, others):
    """(N, 3) moves of the `others` (N, 3) as one body with `places` (M, 3), which move by `moves` (M, 3).

    Kabsch, "A solution for the best rotation to relate two sets of vectors", Acta Crystallographica A32, 1976."""
    middle = places.mean(0)
    left, _, right = np.linalg.svd((places - middle).T @ (places + moves - middle - moves.mean(0)))
    upright = np.diag([1, 1, np.sign(np.linalg.det(left @ right))])
    return (others - middle) @ (left @ upright @ right) + middle + moves.mean(0) - others


class FaceMoves:
    """Moves of the base mesh (V, 3) [m] of one person."""

    def __init__(self, package, person):
        self.package, self.person = package, person
        self.rest = package.base.points
        self.jaw = rig.base_weights(package)[:, rig.NAMES.index("jaw")]
        self.jaw = (self.jaw + self.jaw[package.mirror]) / 2
        body = package.base.quads[package.base.groups == 0]
        self.links = surface.links(body, len(self.rest))
        self.tongue, self.lower_teeth = (self.rows(f"helper-{part}") for part in ("tongue", "lower-teeth"))

    def rows(self, group):
        """Vertices of a group of the base mesh."""
        base = self.package.base
        return np.unique(base.quads[base.groups == base.group_names.index(group)])

    def target(self, name):
        """(V, 3) an expression target, mixed over the person's origins, or a modelling target."""
        if "/" in name:
            return self.package.target(name)
        return sum(
            self.person.origins.get(origin, 0) * self.package.target(f"expression/units/{origin}/{name}")
            for origin in ORIGINS
        )

    def both(self, name):
        """(V, 3) a target mirror-symmetric; "*" is made of its left side."""
        if "*" in name:
            left = self.target(name.replace("*", "l" if "/" in name else "left"))
            return left + self.package.mirrored(left)
        moves = self.target(name)
        return (moves + self.package.mirrored(moves)) / 2

    def part(self, name):
        """(V, 1) share of a part of the face."""
        lower = ramp(self.jaw, 0.2, 0.8)[:, None]
        return {"whole": 1.0, "upper": 1 - lower, "lower": lower}[name]

    def unit(self, number):
        moves = sum((gain * self.part(part) * self.both(name) for name, gain, part in TARGETS[number]), np.zeros_like(self.rest))
        if number in TONGUE_UNITS:  # the targets leave the tongue where it is
            moves[self.tongue] = rigid(self.rest[self.lower_teeth], moves[self.lower_teeth], self.rest[self.tongue])
        moves += self.sculpted(number)
        for _ in range(SMOOTHINGS.get(number, 0)):
            moves = (moves + self.links @ moves) / 2
        if number not in JAW_UNITS:
            moves[self.mouth_parts()] = 0
        return moves * self.region(number)

    def mouth_parts(self):
        """Vertices of the teeth and the tongue."""
        return np.concatenate([self.tongue, self.lower_teeth, self.rows("helper-upper-teeth")])

    def region(self, number):
        """(V, 1) 1 inside the region of a unit, 0 outside."""
        low, high = REGIONS[number]
        y = self.rest[:, 1]
        inside = ramp(y, low - FADE, low + FADE) * (1 - ramp(y, high - FADE, high + FADE))
        return np.where(self.is_skin(), inside, 1)[:, None]

    def is_skin(self):
        return np.arange(len(self.rest)) < 13380

    def sculpted(self, number):
        """(V, 3) moves of a unit that no target has."""
        moves = np.zeros_like(self.rest)
        if number == 4:  # the brows are drawn together, which stays when unit 1 lifts them
            x, y = self.rest[:, 0], self.rest[:, 1]
            near = np.exp(-(((np.abs(x) - 0.020) / 0.014) ** 2) - ((y - 0.757) / 0.010) ** 2)
            moves[:, 0] = -0.0035 * np.tanh(x / 0.006) * near * (self.rest[:, 2] > 0.10)
        if number == 29:
            moves[:, 2] = 0.009 * self.jaw
            moves[:, 1] = -0.002 * self.jaw
        if number == 19:
            moves[self.tongue] = self.tongue_out()
        return moves

    def tongue_out(self):
        """(N, 3) the tongue slides over the lower teeth, gets thinner, and its tip bends onto the lower lip."""
        x, y, z = self.rest[self.tongue].T
        behind = z.max() - z
        out = 1 - ramp(behind, 0, z.max() - z.min())
        middle = (y.min() + y.max()) / 2
        tip = np.clip(1 - behind / TONGUE_BENT, 0, 1)
        back = TONGUE_ROUND * tip * np.minimum((x / TONGUE_TIP) ** 2, 1)
        rise = TONGUE_OVER * np.exp(-(((behind - TONGUE_OVER_AT) / TONGUE_OVER_WIDE) ** 2)) - TONGUE_BEND * tip**2
        return np.stack([-TONGUE_NARROW * x * out**3, rise - TONGUE_THIN * (y - middle) * out, TONGUE_OUT * out - back], 1)

    def sideways(self):
        """(V, 3) the jaw moved to the figure's left."""
        moves = np.zeros_like(self.rest)
        moves[:, 0] = 0.008 * self.jaw
        for _ in range(4):
            moves = (moves + self.links @ moves) / 2
        return moves * self.region(SIDEWAYS)

    def left_share(self, width):
        """(V, 1) 1 on the figure's left, 0 on its right, smooth over +-width [m]."""
        x = np.clip(self.rest[:, 0] / width, -1, 1)
        return (0.5 + 0.75 * x - 0.25 * x**3)[:, None]

    def all(self):
        """{morph name: (V, 3) moves}"""
        moves = {}
        left = self.left_share(0.012)
        for number in sorted(SIDED + MIDDLE + (SIDEWAYS,)):
            if number == SIDEWAYS:
                moves["AU30_L"] = self.sideways()
                moves["AU30_R"] = self.package.mirrored(moves["AU30_L"])
            elif number in SIDED:
                whole = self.unit(number)
                moves[f"AU{number}_L"] = whole * left
                moves[f"AU{number}_R"] = self.package.mirrored(moves[f"AU{number}_L"])
            else:
                moves[f"AU{number}"] = self.unit(number)
        return moves
