"""The left hand. A hand's frame points from the wrist to the fingers, its side to the palm, its front to the thumb."""

import numpy as np

from .shapes import Blend, Frame, Loft, add, ball, carve
from .skeleton import FINGERS, HAND, THUMB_POINTS


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
    base, middle = THUMB_POINTS[:2]
    thumb_ball = ball(base + 0.45 * (middle - base), (0.030, 0.016, 0.0150), along=middle - base)
    little_ball = ball(HAND.point(0.038, 0.0085, -0.0240), (0.034, 0.0120, 0.0135), along=HAND.along)
    hollow = ball(HAND.point(0.058, 0.0270, -0.0020), (0.026, 0.0130, 0.0170), along=HAND.along)
    return Blend(
        add(Loft(HAND, rows, power=2.5, caps=(0.01, 0.012), margin=0.03)),
        add(thumb_ball, 0.014),
        add(little_ball, 0.014),
        carve(hollow, 0.012),
        *(add(knuckle(spec), 0.010) for spec in FINGERS),
    )


def knuckle(spec):
    return ball(spec.root - 0.0035 * HAND.side, (0.011, 0.0085, 0.0085), along=HAND.along)


def web(first, second):
    """The fold of skin between two fingers."""
    middle = 0.5 * (first.frame.point(0.006, 0.002) + second.frame.point(0.006, 0.002))
    return ball(middle, (0.0125, 0.0050, 0.0075), along=first.frame.along + second.frame.along, front=HAND.front)


def hand():
    fingers = Blend(*(add(finger(spec), 0.003) for spec in FINGERS))
    webs = (add(web(*pair), 0.009) for pair in zip(FINGERS, FINGERS[1:]))
    return Blend(add(palm()), *webs, add(fingers, 0.008), add(thumb(), 0.012))
