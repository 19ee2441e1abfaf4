"""What lies between the lids and an eyeball: the shadow of the upper lid and the tears along the lower one.

Both are strips that begin on the edge of a lid, move as it does, and reach over the ball. The edges are found by looking
out of the middle of the eye. Sizes and strengths are ours, chosen by looking at five people at `head`.
"""

import numpy as np

from . import glb
from .surface import Surface, triangles_of

COLUMNS = 14  # of a strip
SIDE, STEP = np.radians(60), np.radians(0.5)  # how far to the sides edges are looked for, and how finely
LEAST_OPEN = np.radians(3)  # between the lids, at the corners
NEAR = 0.03  # [m] from the middle of an eye: skin that may be a lid
INWARD = 0.0003  # [m] that a strip begins inside of its lid
# Each row of a strip: [m] from the lid's edge along the ball, [m] above the ball, opacity. The cornea bulges by 1.1 mm.
SHADOW = ((0, None, 0.48), (0.0012, 0.0007, 0.26), (0.0030, 0.0011, 0))
TEARS = ((0, None, 0.0), (0.0005, 0.0003, 0.75), (0.0010, 0.0002, 0))
SHADOW_COLOUR, TEARS_COLOUR = (0.10, 0.04, 0.03), (0.93, 0.84, 0.80)  # sRGB


def _hits(directions, corners):
    """(N) distance along each ray from the origin to the first triangle (F, 3, 3), inf if none, and which triangle."""
    a, ab, ac = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    across = np.cross(directions[:, None], ac)
    size = (across * ab).sum(-1)
    size[np.abs(size) < 1e-15] = 1e-15
    u = -(across * a).sum(-1) / size
    side = np.cross(-a, ab)
    v = directions @ side.T / size
    far = (ac * side).sum(-1) / size
    far = np.where((u >= 0) & (v >= 0) & (u + v <= 1) & (far > 0), far, np.inf)
    return far.min(1), far.argmin(1)


def _edges(points, triangles, centre):
    """(2, COLUMNS, 3) vertices and their shares of the edges of the upper and the lower lid, from side to side."""
    triangles = triangles[np.linalg.norm(points[triangles].mean(1) - centre, axis=1) < NEAR]
    corners = points[triangles] - centre
    up = np.arange(-SIDE, SIDE, STEP)

    def ways(aside):
        return np.stack([np.sin(aside) * np.cos(up), np.sin(up), np.cos(aside) * np.cos(up)], 1)

    def opening(aside):
        far, which = _hits(ways(aside), corners)
        rows = np.flatnonzero(np.isinf(far))
        return (rows[0] - 1, rows[-1] + 1, which) if len(rows) * STEP > LEAST_OPEN else None

    open_ = [aside for aside in np.arange(-SIDE, SIDE, 2 * STEP) if opening(aside)]
    found = [[], []]
    for aside in np.linspace(open_[0], open_[-1], COLUMNS):
        low, high, which = opening(aside)
        for edge, row in zip(found, (high, low)):
            shares = np.linalg.solve(corners[which[row]].T, ways(aside)[row])
            edge.append((triangles[which[row]], shares / shares.sum()))
    return [[np.array(part) for part in zip(*edge)] for edge in found]


def _strip(rows, edge, over, centre, radius):
    """(R, COLUMNS, 3) a strip that begins at the edge of a lid; `over` is the edge of the other lid."""
    outward = edge - centre
    far = np.linalg.norm(outward, axis=1, keepdims=True)
    outward = outward / far
    down = (over - edge) - ((over - edge) * outward).sum(1, keepdims=True) * outward
    down /= np.linalg.norm(down, axis=1, keepdims=True)
    lines = []
    for along, above, _ in rows:
        way = outward + along / radius * down
        way /= np.linalg.norm(way, axis=1, keepdims=True)
        lines.append(centre + way * (far - INWARD if above is None else radius + above))
    return np.stack(lines)


def strips(points, triangles, weights, moves, eyes):
    """[(material, Surface)] of both eyes. `moves` {morph: (V, 3)} of the skin, `eyes` [(middle, radius)]."""
    edges = [_edges(points, triangles, centre) for centre, _ in eyes]
    made = []
    for name, rows, colour, lid in (("eye_shadow", SHADOW, SHADOW_COLOUR, 0), ("eye_wet", TEARS, TEARS_COLOUR, 1)):
        parts, joints, moved = [], [], {morph: [] for morph in moves}
        for (centre, radius), both in zip(eyes, edges):
            def hung(values, which):
                vertices, shares = both[which]
                return np.einsum("ck,ck...->c...", shares, values[vertices])

            edge, over = hung(points, lid), hung(points, 1 - lid)
            rest = _strip(rows, edge, over, centre, radius)
            parts.append(rest)
            joints.append(np.tile(hung(weights, lid), (len(rows), 1)))
            gap = np.linalg.norm(over - edge, axis=1)
            for morph, move in moves.items():
                # A strip moves with its lid, and is gone where the lids meet.
                now = np.linalg.norm(over + hung(move, 1 - lid) - edge - hung(move, lid), axis=1)
                lost = 1 - np.clip(now / gap, 0, 1)
                moved[morph].append(hung(move, lid) - lost[:, None] * (rest - rest[0]))
        places = np.concatenate(parts).reshape(-1, 3)
        ways = np.concatenate([part - centre for part, (centre, _) in zip(parts, eyes)]).reshape(-1, 3)
        row, column = (grid.ravel() for grid in np.mgrid[: len(rows) - 1, : COLUMNS - 1])
        first = row * COLUMNS + column
        quads = np.stack([first, first + COLUMNS, first + COLUMNS + 1, first + 1], 1)
        quads = quads if lid == 0 else quads[:, ::-1]
        opacity = np.tile(np.repeat([opaque for _, _, opaque in rows], COLUMNS), len(eyes))
        surface = Surface(
            places,
            ways / np.linalg.norm(ways, axis=1, keepdims=True),
            None,
            triangles_of(np.concatenate([quads + k * len(rows) * COLUMNS for k in range(len(eyes))])),
            np.concatenate(joints),
            {morph: np.concatenate(part).reshape(-1, 3) for morph, part in moved.items()},
            colours=np.concatenate([np.tile(np.array(colour) ** 2.2, (len(places), 1)), opacity[:, None]], 1),
        )
        surface.moves = {m: move for m, move in surface.moves.items()
                         if np.linalg.norm(move, axis=1).max() > 10 * glb.LEAST_MOVE}
        surface.normal_moves = {m: np.zeros_like(places) for m in surface.moves}
        made.append((name, surface))
    return made
