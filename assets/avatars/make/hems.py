"""Hems of a shirt: its open edges made round, and the lower one folded inward, so that it looks as thick as cloth is.

MakeHuman's sleeves and collars are folded inward already."""

import numpy as np

from .surface import Surface, divided

# Rows of the lower hem after the edge: [m] beyond the edge, [m] inward, and how far the normal is turned: 0 as the
# cloth's, 1 over the edge, 2 inward. Ours: a doubled hem of knitted cloth, chosen by looking at `upper`.
ROWS = ((0.0012, 0.0015, 1.0), (-0.0060, 0.0030, 1.9))
LOWER = 0.05  # [m] above its lowest point the lower edge of a shirt ends; sleeves end higher; ours
STEPS = 12  # of places along an edge, which are 3 mm or less apart; ours
LEAST_BEND = 0.0005  # [m] an edge is split whose middle would leave the straight line by more; ours, a pixel at `head`


def _open_edges(cloth):
    """Triangle and corner that open edges start at, and the place (V) of a vertex, which its copies at seams share."""
    place = np.unique(cloth.points, axis=0, return_inverse=True)[1]
    triangles = place[cloth.triangles]
    edges = np.stack([triangles, np.roll(triangles, -1, 1)], -1).reshape(-1, 2)
    _, edge, times = np.unique(np.sort(edges, axis=1), axis=0, return_inverse=True, return_counts=True)
    triangle, corner = np.divmod(np.flatnonzero(times[edge] == 1), 3)
    return triangle, corner, place


def _ends(cloth, triangle, corner):
    """Vertices of edges, in the order of their triangles, and the ones opposite."""
    return (cloth.triangles[triangle, (corner + k) % 3] for k in range(3))


def along_edges(cloth):
    """(N, 3) [m] places along the open edges."""
    a, b, _ = _ends(cloth, *_open_edges(cloth)[:2])
    share = np.linspace(0, 1, STEPS)[:, None, None]
    return (cloth.points[a] + share * (cloth.points[b] - cloth.points[a])).reshape(-1, 3)


def _finer(cloth):
    """The cloth with its open edges split where they bend: the four-point scheme.

    Dyn, Levin and Gregory, "A 4-point interpolatory subdivision scheme for curve design", CAGD 4, 1987."""
    triangle, corner, place = _open_edges(cloth)
    a, b, _ = _ends(cloth, triangle, corner)
    after, before = np.zeros((2, len(place)), int)
    after[place[a]], before[place[b]] = b, a
    points = cloth.points
    bend = (points[a] + points[b] - points[before[place[a]]] - points[after[place[b]]]) / 16
    split = np.linalg.norm(bend, axis=1) > LEAST_BEND
    new = np.full(cloth.triangles.shape, -1)
    new[triangle[split], corner[split]] = len(points) + np.arange(split.sum())
    a, b = a[split], b[split]
    return divided(cloth, a, b, (points[a] + points[b]) / 2 + bend[split], new)


def hemmed(cloth):
    """A Surface whose open edges bend smoothly, with a hem at the lower one that moves as it does."""
    cloth = _finer(cloth)
    triangle, corner, place = _open_edges(cloth)
    height = cloth.points[cloth.triangles[triangle, corner], 1]
    low = height < height.min() + LOWER
    triangle, corner = triangle[low], corner[low]
    a, b, c = _ends(cloth, triangle, corner)
    ab, ac = cloth.points[b] - cloth.points[a], cloth.points[c] - cloth.points[a]
    out = np.cross(ab, np.cross(ab, ac))
    out /= np.linalg.norm(out, axis=1, keepdims=True)
    outward = np.zeros_like(cloth.points)
    for end in (a, b):
        np.add.at(outward, place[end], out)
    outward = outward[place]
    # The texture of a hem is that of the cloth beside it, mirrored at the edge.
    along = (out * ac).sum(1, keepdims=True)
    aside = (ac * ab).sum(1, keepdims=True) / (ab * ab).sum(1, keepdims=True)
    slope = (cloth.uvs[c] - cloth.uvs[a] - aside * (cloth.uvs[b] - cloth.uvs[a])) / -along
    rim, ends = np.unique(np.concatenate([a, b]), return_inverse=True)
    inner = np.zeros((len(rim), 2))
    np.add.at(inner, ends, np.tile(slope, (2, 1)))
    inner /= np.bincount(ends)[:, None]
    normal, outward = cloth.normals[rim], outward[rim]
    outward -= (outward * normal).sum(1, keepdims=True) * normal
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    first, second = ends.reshape(2, -1)
    count = len(cloth.points)
    rows = [rim, *(count + k * len(rim) + np.arange(len(rim)) for k in range(len(ROWS)))]
    points, normals, uvs, run = [cloth.points], [cloth.normals], [cloth.uvs], 0
    last = np.zeros(2)
    for beyond, inward, turn in ROWS:
        run += np.hypot(*(np.array([beyond, inward]) - last))
        last = np.array([beyond, inward])
        angle = turn * np.pi / 2
        points.append(cloth.points[rim] + beyond * outward - inward * normal)
        normals.append(np.cos(angle) * normal + np.sin(angle) * outward)
        uvs.append(cloth.uvs[rim] + run * inner)
    triangles = [cloth.triangles]
    for upper, lower in zip(rows, rows[1:]):
        triangles += [np.stack([upper[second], upper[first], lower[first]], 1)]
        triangles += [np.stack([upper[second], lower[first], lower[second]], 1)]
    return Surface(
        np.concatenate(points), np.concatenate(normals), np.concatenate(uvs), np.concatenate(triangles),
        np.concatenate([cloth.weights] + [cloth.weights[rim]] * len(ROWS)),
    )
