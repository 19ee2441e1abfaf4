"""Implicit surfaces. A shape maps points (N, 3) [m] to a distance-like value (N,) [m], negative inside."""

import numpy as np
from scipy.interpolate import CubicSpline

UP = np.array([0.0, 1.0, 0.0])
FRONT = np.array([0.0, 0.0, 1.0])
FAR = 1.0  # what a shape answers outside its bounds; larger than any blend radius [m]


def unit(vector):
    """`vector` (3,) scaled to length 1."""
    vector = np.asarray(vector, float)
    return vector / np.linalg.norm(vector)


def across(axis, hint):
    """The unit vector nearest to `hint` that is perpendicular to the unit vector `axis`."""
    return unit(hint - np.dot(hint, axis) * np.asarray(axis))


class Frame:
    """A right-angled frame: `along`, `side` and `front` are unit vectors, `origin` a point [m]."""

    def __init__(self, origin, along, front):
        self.origin = np.asarray(origin, float)
        self.along = unit(along)
        self.front = across(self.along, np.asarray(front, float))
        self.side = np.cross(self.along, self.front)

    def local(self, points):
        """Coordinates (N,) along, to the side and to the front of `points` (N, 3)."""
        offset = points - self.origin
        return offset @ self.along, offset @ self.side, offset @ self.front

    def point(self, along, side=0.0, front=0.0):
        """The point (3,) with these coordinates."""
        return self.origin + along * self.along + side * self.side + front * self.front


class Shape:
    """Evaluates `distance` inside the bounds only, and answers FAR elsewhere."""

    low = np.full(3, -np.inf)
    high = np.full(3, np.inf)

    def __call__(self, points):
        inside = np.all((points > self.low) & (points < self.high), axis=1)
        result = np.full(len(points), FAR)
        if inside.any():
            result[inside] = self.distance(points[inside])
        return result

    def bound(self, corners, margin):
        self.low = np.min(corners, axis=0) - margin
        self.high = np.max(corners, axis=0) + margin


class Loft(Shape):
    """A limb: cross sections of four radii, strung along a straight axis whose centre may wander.

    rows (R, 7): along, centre side, centre front, radius to +side, -side, +front, -front   [m]
    power: 2 = elliptic cross sections, more = boxier.   caps: lengths of the two round ends [m]
    """

    def __init__(self, frame, rows, power=2.0, caps=(0.02, 0.02), margin=0.14):
        rows = np.asarray(rows, float)
        self.frame, self.power, self.caps = frame, power, caps
        self.start, self.end = rows[0, 0], rows[-1, 0]
        self.steps = np.linspace(self.start, self.end, 400)
        self.columns = CubicSpline(rows[:, 0], rows[:, 1:], bc_type="natural")(self.steps).T
        reach = np.abs(rows[:, 3:]).max() + max(caps)
        self.bound([frame.point(*row[:3]) for row in rows], reach + margin)

    def distance(self, points):
        along, side, front = self.frame.local(points)
        inner = np.clip(along, self.start, self.end)
        c_side, c_front, right, left, fore, aft = (np.interp(inner, self.steps, c) for c in self.columns)
        side, front, over = side - c_side, front - c_front, along - inner
        ratio_side = np.abs(side) / np.where(side > 0, right, left)
        ratio_front = np.abs(front) / np.where(front > 0, fore, aft)
        section = (ratio_side**self.power + ratio_front**self.power) ** (1 / self.power)
        cap = over / np.where(over < 0, self.caps[0], self.caps[1])
        return radial(np.sqrt(side**2 + front**2 + over**2), np.sqrt(section**2 + cap**2))


class Ellipsoid(Shape):
    """radii (3,) [m] along the frame's along, side and front; power 2 = ellipsoid, more = boxier."""

    def __init__(self, frame, radii, power=2.0, margin=0.14):
        self.frame, self.radii, self.power = frame, np.asarray(radii, float), power
        self.bound([frame.origin], max(radii) + margin)

    def distance(self, points):
        local = np.stack(self.frame.local(points), axis=1)
        ratio = (np.abs(local / self.radii) ** self.power).sum(axis=1) ** (1 / self.power)
        return radial(np.linalg.norm(local, axis=1), ratio)


class HalfSpace(Shape):
    """Everything below the plane through `origin` with the outward unit normal `normal`."""

    def __init__(self, origin, normal):
        self.origin, self.normal = np.asarray(origin, float), unit(normal)

    def distance(self, points):
        return (points - self.origin) @ self.normal


def radial(length, ratio):
    """Distance to a surface that lies at `length / ratio` from the centre on the same ray."""
    ratio = np.maximum(ratio, 1e-4)
    return np.maximum(length, 1e-6) * (1 - 1 / ratio)


def smooth_min(a, b, radius):
    """Union whose seam is rounded over `radius` [m]."""
    if radius <= 0:
        return np.minimum(a, b)
    overlap = np.maximum(radius - np.abs(a - b), 0) / radius
    return np.minimum(a, b) - overlap**2 * radius / 4


class Blend(Shape):
    """Parts put together in order. A part is made by add, carve or keep."""

    def __init__(self, *parts):
        self.parts = parts

    def distance(self, points):
        result = np.full(len(points), FAR)
        for combine, shape, rounding in self.parts:
            result = combine(result, shape(points), rounding)
        return result


def add(shape, rounding=0.0):
    """The part of a Blend that joins `shape`; `rounding` [m] fills the seam."""
    return smooth_min, shape, rounding


def carve(shape, rounding):
    """The part of a Blend that takes `shape` away."""
    return lambda solid, value, radius: -smooth_min(-solid, value, radius), shape, rounding


def keep(shape, rounding):
    """The part of a Blend that takes all but `shape` away."""
    return lambda solid, value, radius: -smooth_min(-solid, -value, radius), shape, rounding


class Paired(Shape):
    """`shape`, which lies at x > 0, together with its mirror image; `rounding` [m] smooths the fold at x = 0."""

    def __init__(self, shape, rounding):
        self.shape, self.rounding = shape, rounding

    def distance(self, points):
        folded = points.copy()
        folded[:, 0] = np.sqrt(points[:, 0] ** 2 + self.rounding**2)
        return self.shape(folded)


def gradient(shape, points, step=2e-4):
    """Central differences of `shape` at `points` (N, 3) -> (N, 3)."""
    result = np.empty_like(points)
    for axis in range(3):
        offset = np.zeros(3)
        offset[axis] = step
        result[:, axis] = (shape(points + offset) - shape(points - offset)) / (2 * step)
    return result


# ---- Common shapes
def upright(point):
    """A frame whose `along` is +y, `side` +x, `front` +z."""
    return Frame(point, UP, FRONT)


def ball(point, radii, along=UP, front=FRONT):
    """An ellipsoid with `radii` along `along`, sideways and along `front`."""
    return Ellipsoid(Frame(point, along, front), radii)


def strand(*knots):
    """A round band along a nearly straight row of knots (point, radius)."""
    points = [np.asarray(point, float) for point, _ in knots]
    direction = unit(points[-1] - points[0])
    frame = Frame(points[0], direction, FRONT if abs(direction[2]) < 0.9 else UP)
    rows = [(*np.ravel(frame.local(point)), r, r, r, r) for point, (_, r) in zip(points, knots)]
    return Loft(frame, rows, caps=(knots[0][1], knots[-1][1]))
