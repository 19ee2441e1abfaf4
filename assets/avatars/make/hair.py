"""Hair as cards: strips with strands on them that grow from the scalp, follow a parting and hang.

Each strip is traced like one hair: it starts at a root, keeps clear of the head by the height of its layer, and turns
to where the style combs it and to the ground. All lengths in metres, numbers ours, chosen by looking at the faces.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from .surface import Surface

STEP = 0.004  # [m] of tracing
COLUMNS = 8  # bundles of strands in the texture
HELD = 0.06  # [m] that hair of weight 1 goes as it is combed before it hangs
TURN, RISE = 0.007, 0.003  # [m] of growth in which hair turns to where it is combed, and rises to its layer
EAR_CLEAR, EAR_TOP = 0.006, 0.012  # [m] from an ear, below its top: there hair ends that is held down
EAR_LEAST = 0.5  # of its length; hair of which no more would be left is left out
RUFFLE = 0.2  # of the normals of the layer under the strips, which would shine like a cap
SUNK = 0.002  # [m] under the skin, where that layer meets the hairline
ROUGHNESS, ANISOTROPY = 0.4, 0.6  # of strands: light lies in a band round the head, wide across them and narrow along them
BUN_ROLL = 0.6  # [rad] of the strips of a knot
# The hairline that is painted on the scalp: [m] thickness and length of a hair, [m] below the hairline where hairs begin,
# and over which height they get dense in front and at the sides; how sharp a hair is, and how differently dense.
# Ours, by eye on five people at `head`, as are the numbers of partings and roots.
HAIR_THICK, HAIR_LONG = 0.0005, 0.008
EDGE_FROM, EDGE_FRONT, EDGE_SIDES, EDGE_SHARP, EDGE_SPREAD = 0.002, 0.012, 0.008, 0.7, 3.6
EDGE_FULL = 1.4  # a density where no skin is left
# How much of that density is lost along a parting, [m] half of its width; how much more there is beside it, where hair
# that is combed away would leave a notch, [m] within which distance, where the layer under the strips is sunk too.
PARTING_BARE, PARTING_WIDE, PARTING_LOW, PARTED = 1.9, 0.0013, 0.5, 0.012
ROOTS = 0.12  # [share of its length] at most, that a strand begins later than its strip, so that strips have no edges
UNDER = 0.42  # of the height of the outermost hair: where the closed layer under it lies

# The edge of the hair: [rad] around the head from the front, [m] above the eyes.
HAIRLINE = np.array([
    (0.0, 0.056), (0.40, 0.057), (0.70, 0.052), (0.95, 0.036), (1.10, 0.012), (1.22, -0.012), (1.36, -0.020), (1.50, 0.004),
    (1.95, 0.012), (2.15, -0.030), (2.45, -0.066), (2.80, -0.080), (np.pi, -0.082),
])


@dataclass
class Style:
    """How hair is combed and cut."""

    comb: str  # whorl, parted, back
    cards: int
    length: tuple  # [m] on top, at the sides, at the nape
    layer: float  # [m] height of the outermost hair above the skin
    width: float  # [m] of a strip
    parting: float = 0.0  # [m] to the figure's left of the middle
    weight: float = 0.5  # how soon hair turns to the ground, 0: it stays as it is combed
    hug: float = 1.0  # how much it is held down to the head, 0: it may stand off
    lift: float = 0.3  # of hair at its root, against how it is combed
    wave: tuple = (0.0, 0.1)  # [m] aside, and [m] a wave is long
    roll: float = 0.6  # [rad] at most, that a strip is turned about its length
    bun: float = 0.0  # [m] radius of a knot at the back
    hairline: float = 0.0  # [m] higher than others'
    bare: float = 0.0  # [m] above the hairline that only the scalp is dark, so that strips combed back end softly


STYLES = {
    "short": Style("whorl", 1700, (0.040, 0.022, 0.018), 0.009, 0.012, weight=0.2, lift=0.5),
    "receding": Style("whorl", 1550, (0.030, 0.018, 0.016), 0.006, 0.011, weight=0.2, lift=0.4, hairline=0.022),
    "swept": Style("parted", 532, (0.105, 0.036, 0.020), 0.012, 0.012, parting=0.034, weight=0.5, lift=0.5, wave=(0.0015, 0.05)),
    "bob": Style("parted", 438, (0.235, 0.160, 0.110), 0.011, 0.015, parting=0.022, weight=0.9, hug=0.2, lift=0.3, wave=(0.002, 0.09)),
    "bun": Style(
        "back", 370, (0.190, 0.150, 0.120), 0.006, 0.013, weight=0.0, lift=0.0, bun=0.034, roll=0.15, bare=0.006
    ),
}


class Head:
    """The skin around the skull, and where hair grows on it."""

    def __init__(self, points, normals, quads, joints):
        self.eyes = (joints["left_eye"] + joints["right_eye"]) / 2
        near = np.linalg.norm(points[quads].mean(1) - self.eyes, axis=1) < 0.30
        quads = quads[near]
        used = np.unique(quads)
        wide = np.abs(points[used][points[used][:, 1] > self.eyes[1] + 0.03, 0]).max()
        ear = (np.abs(points[used][:, 0]) > 1.01 * wide) & (points[used][:, 1] > self.eyes[1] - 0.07)
        self.ears = cKDTree(points[used[ear]])
        used = used[~ear]
        self.points, self.normals, self.wide = points[used], normals[used], wide
        self.tree = cKDTree(self.points)
        self.triangles = points[np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])]
        self.top = self.points[:, 1].max()
        skull = self.points[self.points[:, 1] > self.eyes[1] + 0.02]
        depth = (skull[:, 2].min() + skull[:, 2].max()) / 2
        self.middle = np.array([0, self.eyes[1] + 0.03, depth])
        self.back = skull[:, 2].min()

    def skin_at(self, places):
        """(N) [m] above the skin, (N, 3) its normal."""
        far, rows = self.tree.query(places, k=4)
        share = 1 / (far + 1e-3) ** 2
        share /= share.sum(1, keepdims=True)
        normal = np.einsum("nk,nkc->nc", share, self.normals[rows])
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        base = np.einsum("nk,nkc->nc", share, self.points[rows])
        return ((places - base) * normal).sum(1), normal

    def above_hairline(self, places, style):
        """(N) [m] negative outside of the hair."""
        around = np.arctan2(np.abs(places[:, 0]), places[:, 2] - self.middle[2])
        edge = np.interp(around, *HAIRLINE.T) + style.hairline * np.clip(1.3 - around, 0, 1)
        return places[:, 1] - self.eyes[1] - edge

    def roots(self, style, random):
        """(N, 3) spread evenly over the scalp; denser along the front edge, where one looks."""
        a, b, c = (self.triangles[:, k] for k in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        tried = 40 * style.cards
        chosen = random.choice(len(area), tried, p=area / area.sum())
        u, v = random.random_sample((2, tried))
        turned = u + v > 1
        u, v = np.where(turned, 1 - u, u), np.where(turned, 1 - v, v)
        places = a[chosen] + u[:, None] * (b - a)[chosen] + v[:, None] * (c - a)[chosen]
        above = self.above_hairline(places, style)
        grows = (above > style.bare) & (np.abs(places[:, 0]) < 1.01 * self.wide)
        places, above = places[grows], above[grows]
        kept = []
        # The place that is furthest from all others, again and again; the edge counts as if it were larger.
        far = np.full(len(places), np.inf)
        importance = 1 + 1.0 * np.exp(-above / 0.012)
        if style.comb == "parted":
            importance += 2.0 * np.exp(-np.abs(places[:, 0] - style.parting) / 0.006)
        pick = int(np.argmin(above))
        for _ in range(min(style.cards, len(places))):
            kept.append(pick)
            far = np.minimum(far, np.linalg.norm(places - places[pick], axis=1))
            pick = int(np.argmax(far * importance))
        return places[kept]


def _unit(vectors):
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-9)


def combed(style, head, places):
    """(N, 3) where hair at these places is combed to."""
    x, y, z = (places - head.middle).T
    if style.comb == "back":
        knot = np.array([0, head.middle[1] + 0.02, head.back])
        return _unit(knot - places)
    if style.comb == "parted":
        side = np.tanh((x - style.parting) / 0.006)
        back = np.clip(-z / 0.08, 0, 1)
        return _unit(np.stack([side * (1 - 0.5 * back), -0.35 - 0.8 * back, -0.60 + 0.4 * back], 1))
    crown = np.array([0.012, head.top - 0.012, head.middle[2] - 0.045])
    away = _unit(places - crown)
    return _unit(away + np.stack([0.25 * np.ones_like(x), 0 * x, 0.35 * np.clip(y / 0.08, 0, 1)], 1))


def traced(style, head, random):
    """(N, S, 3) middle lines of the strips, (N, S, 3) normals of the skin under them."""
    roots = head.roots(style, random)
    count = len(roots)
    _, normal = head.skin_at(roots)
    height = np.clip((roots[:, 1] - head.eyes[1]) / 0.06, 0, 1)
    behind = np.clip((head.middle[2] - roots[:, 2]) / 0.06, 0, 1) * (1 - height)
    top, side, nape = style.length
    length = height * top + (1 - height) * (side * (1 - behind) + nape * behind)
    length *= random.uniform(0.85, 1.1, count)
    layer = style.layer * (0.5 + 0.5 * random.uniform(0, 1, count) ** 2)  # few hairs lie on top
    edge = np.clip(head.above_hairline(roots, style) / 0.02, 0, 1)
    layer *= 0.35 + 0.65 * edge
    steps = int(np.ceil(length.max() / STEP))
    stride = length / steps
    place = roots - 0.001 * normal
    going = _unit(combed(style, head, roots) + style.lift * normal)
    lines, normals = [place], [normal]
    for k in range(steps):
        above, normal = head.skin_at(place)
        gone = (k * stride)[:, None]
        held = np.exp(-style.weight * gone / HELD)
        want = held * combed(style, head, place) + (1 - held) * np.array([0, -1, 0])
        off = (want * normal).sum(1, keepdims=True)
        want = _unit(want - np.where(off < 0, off, style.hug * off) * normal)
        going = _unit(going + stride[:, None] / TURN * want)
        place = place + stride[:, None] * going
        above, normal = head.skin_at(place)
        wanted = layer * (1 - np.exp(-((k + 1) * stride) / RISE))
        off = wanted - above
        place = place + normal * np.where(off > 0, off, style.hug * 0.5 * off)[:, None]
        if style.hug == 1:  # held in at the ears
            place[:, 0] = np.clip(place[:, 0], -head.wide - 0.5 * layer, head.wide + 0.5 * layer)
        lines.append(place)
        normals.append(normal)
    lines, normals = np.stack(lines, 1), np.stack(normals, 1)
    return _clear_of_ears(lines, normals, head) if style.hug == 1 else (lines, normals)


def _clear_of_ears(lines, normals, head):
    """The lines cut where they come to an ear; those that begin there are left out."""
    top = head.ears.data[:, 1].max()
    near = (head.ears.query(lines)[0] < EAR_CLEAR) & (lines[..., 1] < top - EAR_TOP)
    steps = lines.shape[1] - 1
    last = np.where(near.any(1), near.argmax(1), steps)
    kept = last > EAR_LEAST * steps
    at = last[kept, None] * np.arange(steps + 1) / steps
    low = np.minimum(at.astype(int), steps - 1)
    row, share = np.arange(len(at))[:, None], (at - low)[..., None]
    return tuple(v[kept][row, low] * (1 - share) + v[kept][row, low + 1] * share for v in (lines, normals))


def bun_lines(style, head, random, count):
    """(N, S, 3) lines around the knot at the back, and their normals."""
    middle = np.array([0, head.middle[1] + 0.02, head.back - 0.2 * style.bun])
    axes = _unit(random.standard_normal((count, 3)) * [1.0, 1.0, 0.25])
    start = _unit(np.cross(axes, [0, 0, 1.0]))
    beside = np.cross(axes, start)
    turn = np.linspace(-1.9, 1.9, 12)[None, :, None]
    outward = np.cos(turn) * beside[:, None] + np.sin(turn) * start[:, None]
    radius = style.bun * random.uniform(0.85, 1.03, (count, 1, 1))
    return middle + radius * outward * [1.1, 1.0, 0.85], outward


def across_strands(along, normals, sign):
    """(..., 4) tangents at right angles to strands that run along v; `sign` 1: u grows along along x normal."""
    across = np.cross(along, normals)
    across = _unit(across) * sign
    return np.concatenate([across, np.broadcast_to(-sign, (*across.shape[:-1], 1))], -1)


def strips(lines, normals, width, random, segments, roll):
    """(points, normals, uvs, tangents, triangles) of flat strips along the lines."""
    count, steps, _ = lines.shape
    at = np.round(np.linspace(0, 1, segments + 1) ** 1.4 * (steps - 1)).astype(int)  # hair bends most at its root
    along = _unit(np.gradient(lines, axis=1))[:, at]
    lines, normals = lines[:, at], normals[:, at]
    across = _unit(np.cross(along, normals))
    roll = random.uniform(-roll, roll, (count, 1, 1))
    across = _unit(np.cos(roll) * across + np.sin(roll) * normals)
    face = _unit(np.cross(across, along))
    share = np.linspace(0, 1, segments + 1)[None, :, None]
    width = width * np.clip(np.linalg.norm(lines[:, -1] - lines[:, 0], axis=1) / 0.05, 0.6, 1)[:, None, None]
    half = width * random.uniform(0.7, 1.2, (count, 1, 1)) * (1 - 0.45 * share**2) / 2
    points = np.stack([lines - half * across, lines + half * across], 2)
    face = np.stack([face - 0.5 * across, face + 0.5 * across], 2)
    shading = _unit(0.5 * normals[:, :, None] + 0.5 * _unit(face))
    column = random.randint(0, COLUMNS, count)
    flip = random.randint(0, 2, count)
    u = np.stack([flip, 1 - flip], 1)[:, None, :] * 0.96 + 0.02
    u = np.broadcast_to((column[:, None, None] + u) / COLUMNS, (count, segments + 1, 2))
    v = np.broadcast_to(share, (count, segments + 1, 2)) * 0.99 + 0.005
    first = np.arange(count)[:, None] * (segments + 1) * 2 + np.arange(segments) * 2
    quads = np.stack([first, first + 1, first + 3, first + 2], -1).reshape(-1, 4)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    tangents = across_strands(np.broadcast_to(along[:, :, None], shading.shape), shading, (1 - 2 * flip)[:, None, None, None])
    uvs = np.stack([u, v], -1)
    return points.reshape(-1, 3), shading.reshape(-1, 3), uvs.reshape(-1, 2), tangents.reshape(-1, 4), triangles


def waved(lines, normals, wave, random):
    far, long = wave
    if not far:
        return lines
    run = np.cumsum(np.linalg.norm(np.diff(lines, axis=1, prepend=lines[:, :1]), axis=2), axis=1)
    across = _unit(np.cross(_unit(np.gradient(lines, axis=1)), normals))
    phase = random.uniform(0, 6.28, (len(lines), 1))
    growing = np.clip(run / 0.04, 0, 1)
    return lines + (far * growing * np.sin(2 * np.pi * run / long + phase))[..., None] * across


def underlayer(style, head, quads, points, normals, lines, random):
    """(points, normals, uvs, tangents, triangles) of a closed layer under the strips, so that nothing shines through
    them; its strands run as the strips along `lines` do."""
    above = head.above_hairline(points[quads].reshape(-1, 3), style).reshape(-1, 4)
    near = np.linalg.norm(points[quads].mean(1) - head.eyes, axis=1) < 0.30
    ear = (np.abs(points[quads][..., 0]) > 1.01 * head.wide).any(1)
    used, corners = np.unique(quads[near & (above > 0.002).any(1) & ~ear], return_inverse=True)
    above = head.above_hairline(points[used], style)
    high = np.clip((above - 0.005) / 0.03, 0, 1)
    if style.comb == "parted":  # hair lies flat where it parts
        high *= np.clip(np.abs(points[used][:, 0] - style.parting) / 0.03, 0.15, 1)
    sunk = SUNK * np.clip(1 - (above - style.bare) / 0.004, 0, 2)  # it leaves the skin along the hairline, not along edges of the mesh
    if style.comb == "parted":
        front = np.clip((points[used][:, 2] - head.middle[2]) / 0.03, 0, 1)
        sunk = np.maximum(sunk, SUNK * front * np.clip(1.5 - np.abs(points[used][:, 0] - style.parting) / PARTED, 0, 1))
    layer = points[used] + (UNDER * style.layer * high - sunk)[:, None] * normals[used]
    quads = corners.reshape(-1, 4)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    ruffled = _unit(normals[used] + RUFFLE * random.standard_normal((len(used), 3)))
    nearest = cKDTree(lines.reshape(-1, 3)).query(layer, k=8)[1]
    along = _unit(_unit(np.gradient(lines, axis=1)).reshape(-1, 3)[nearest].mean(1))
    uvs = np.full((len(used), 2), [0.5 / COLUMNS, 0.25])
    return layer, ruffled, uvs, across_strands(along, ruffled, np.ones(1)), triangles


def grown(style, head, body, joint, joints, seed):
    """Surface of the hair, held by one joint."""
    random = np.random.RandomState(seed)
    lines, normals = traced(style, head, random)
    lines = waved(lines, normals, style.wave, random)
    segments = int(np.clip(round(max(style.length) / 0.018), 2, 7))
    parts = [
        underlayer(style, head, *body, lines, random),
        strips(lines, normals, style.width, random, segments, style.roll),
    ]
    if style.bun:
        parts.append(strips(*bun_lines(style, head, random, 60), 1.3 * style.width, random, 7, BUN_ROLL))
    total, gathered = 0, [[], [], [], [], []]
    for points, shading, uvs, tangents, triangles in parts:
        for values, more in zip(gathered, (points, shading, uvs, tangents, triangles + total)):
            values.append(more)
        total += len(points)
    points, shading, uvs, tangents, triangles = (np.concatenate(values) for values in gathered)
    weights = np.zeros((len(points), joints))
    weights[:, joint] = 1
    return Surface(points, shading, uvs, triangles, weights, tangents=tangents)


def texture(colour, seed, size=512):
    """(size, size, 4) bundles of strands side by side, roots at the top."""
    random = np.random.RandomState(seed)
    width = size // COLUMNS
    v = (np.arange(size)[:, None] + 0.5) / size
    rgb = np.ones((size, size, 3)) * np.array(colour) * 0.8
    alpha = np.zeros((size, size))
    for column in range(COLUMNS):
        x = np.arange(width)[None, :] + 0.5
        hairs = (44, 42, 40, 38, 36, 34, 30, 26)[column]
        for _ in range(hairs):
            start = width * (0.5 + 0.42 * random.uniform(-1, 1))
            bend = width * 0.06 * np.sin(v * random.uniform(2, 7) + random.uniform(0, 6.28))
            begin, end = ROOTS * random.uniform(0, 1), random.uniform(0.84, 1.0)
            thick = random.uniform(0.9, 1.9) * np.clip((end - v) / 0.15, 0, 1) ** 0.5 * np.clip((v - begin) / 0.04, 0, 1) ** 0.5
            cover = np.clip(thick - np.abs(x - start - bend - (start - width / 2) * 0.15 * v) + 0.5, 0, 1) 
            light = random.normal(1.0, 0.26) * (0.72 + 0.28 * np.clip(v / 0.3, 0, 1)) * (1 + 0.05 * v)
            warm = 1 + random.normal(0, 0.03) * np.array([1, 0, -1])
            there = slice(column * width, (column + 1) * width)
            rgb[:, there] += cover[..., None] * (np.array(colour) * light[..., None] * warm - rgb[:, there])
            alpha[:, there] = np.maximum(alpha[:, there], cover)
    return np.concatenate([np.clip(rgb, 0, 1), alpha[..., None]], -1)


def _streaks(places, along, seed):
    """(N) noise of deviation 1 at places (N, 3), smeared `along` (N, 3) unit, so that it looks like hairs.

    Cabral and Leedom, "Imaging Vector Fields Using Line Integral Convolution", SIGGRAPH 1993, along straight lines; the
    noise is a table that the cells of a grid share by the hash of Teschner et al., "Optimized Spatial Hashing for
    Collision Detection of Deformable Objects", VMV 2003."""
    table = np.random.RandomState(seed).standard_normal(4096)
    total = np.zeros(len(places))
    for far in np.arange(-HAIR_LONG / 2, HAIR_LONG / 2, HAIR_THICK):
        x, y, z = np.floor((places + far * along) / HAIR_THICK).astype(np.int64).T
        total += table[(x * 73856093 ^ y * 19349663 ^ z * 83492791) % len(table)]
    return total / total.std()


def painted_scalp(image, head, style, colour, places, seed):
    """The skin's texture with the scalp under the hair darkened, at its edge by single hairs; `places` (H, W, 6) [m] of
    its texels and their normals, nan elsewhere."""
    known = np.isfinite(places[..., 0])
    spots, normals = places[known][:, :3], places[known][:, 3:]
    along = combed(style, head, spots)
    along = _unit(along - (along * normals).sum(1, keepdims=True) * normals)
    front = np.clip((spots[:, 2] - head.middle[2]) / 0.05, 0, 1)
    dense = (head.above_hairline(spots, style) + EDGE_FROM) / (EDGE_SIDES + front * (EDGE_FRONT - EDGE_SIDES))
    if style.comb == "parted":
        aside = spots[:, 0] - style.parting
        low, bare = (np.exp(-((aside / wide) ** 2)) for wide in (PARTED, PARTING_WIDE))
        dense = np.minimum(dense, EDGE_FULL) + front * (PARTING_LOW * low - PARTING_BARE * bare)
    share = 0.92 * np.clip(0.5 + EDGE_SHARP * (EDGE_SPREAD * (dense - 0.5) + _streaks(spots, along, seed)), 0, 1)
    image = image.copy()
    image[known] += share[:, None] * (np.array(colour) * 0.75 - image[known])
    return image
