"""Quads with texture corners become triangles with one vertex list; what is not seen is dropped."""

from dataclasses import dataclass, field

import numpy as np

from scipy.sparse import coo_matrix, diags

from .decimate import decimate

LEAST_RISE = 0.0006  # [m] ours: under a pixel in a picture of 720 rows that shows head and shoulders


@dataclass
class Surface:
    """One primitive: everything per vertex, moves per morph."""

    points: np.ndarray  # (V, 3) [m]
    normals: np.ndarray  # (V, 3) unit
    uvs: np.ndarray | None  # (V, 2) v down, as glTF has it
    triangles: np.ndarray  # (F, 3)
    weights: np.ndarray  # (V, J)
    moves: dict = field(default_factory=dict)  # morph: (V, 3) [m]
    normal_moves: dict = field(default_factory=dict)  # morph: (V, 3)
    tangents: np.ndarray | None = None  # (V, 4) unit, along growing u; w: handedness as glTF has it
    colours: np.ndarray | None = None  # (V, 3 or 4) 0..1 linear, times the material's; with opacity


def normals_of(points, quads):
    """(V, 3) unit normals, mean of the faces around weighted by area; quads may repeat a vertex."""
    a, b, c, d = (points[quads[:, k]] for k in range(4))
    across = np.cross(c - a, d - b)
    normals = np.zeros_like(points)
    for k in range(4):
        np.add.at(normals, quads[:, k], across)
    size = np.linalg.norm(normals, axis=1, keepdims=True)
    return normals / np.maximum(size, 1e-12)


def links(quads, count):
    """(V, V) the mean over the neighbours along the edges; a vertex without any stays as it is."""
    a = np.concatenate([quads[:, k] for k in range(4)] + [quads[:, (k + 1) % 4] for k in range(4)])
    b = np.concatenate([quads[:, (k + 1) % 4] for k in range(4)] + [quads[:, k] for k in range(4)])
    apart = a != b
    a, b = a[apart], b[apart]
    matrix = coo_matrix((np.ones(len(a)), (a, b)), shape=(count, count)).tocsr()
    matrix.data[:] = 1
    degree = np.asarray(matrix.sum(1)).ravel()
    return (diags(1 / np.maximum(degree, 1)) @ matrix + diags((degree == 0).astype(float))).tocsr()


def triangles_of(quads):
    """(F, 3) two triangles a quad, one where a corner is repeated."""
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    order = np.argsort(np.tile(np.arange(len(quads)), 2), kind="stable")
    triangles = triangles[order]
    a, b, c = triangles.T
    return triangles[(a != b) & (b != c) & (c != a)]


def build(mesh_points, normals, quads, uvs, uv_quads, weights, moves=None, normal_moves=None):
    """A Surface of the given quads; a vertex is split where its texture coordinates differ. `uvs` None: without."""
    uv_quads = np.zeros_like(quads) if uvs is None else uv_quads
    pairs = np.stack([quads.ravel(), uv_quads.ravel()], 1)
    unique, corner = np.unique(pairs, axis=0, return_inverse=True)
    vertex, uv = unique.T
    return Surface(
        points=mesh_points[vertex],
        normals=normals[vertex],
        uvs=None if uvs is None else uvs[uv] * [1, -1] + [0, 1],
        triangles=triangles_of(corner.reshape(-1, 4)),
        weights=weights[vertex],
        moves={name: move[vertex] for name, move in (moves or {}).items()},
        normal_moves={name: move[vertex] for name, move in (normal_moves or {}).items()},
    )


def rounded(surface, share):
    """A Surface whose longest arcs are split, with new vertices where the normals say that it is round.

    Boubekeur and Alexa, "Phong Tessellation", SIGGRAPH Asia 2008, with one new vertex on each edge that would rise by
    LEAST_RISE, and their alpha of 3/4 where `share` (V) is 1, none where it is 0. The ends of a split edge are drawn in
    by 3/4 of its rise, so that the volume stays: of a flat triangle that is split into four, the new corners lie at 1/4
    of the rise and the old ones at -3/4. Surfaces with moves are not rounded."""
    edges = np.sort(np.concatenate([surface.triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    unique, edge = np.unique(edges, axis=0, return_inverse=True)
    a, b = unique.T
    middle = (surface.points[a] + surface.points[b]) / 2
    above = [((surface.points[v] - middle) * surface.normals[v]).sum(1, keepdims=True) * surface.normals[v]
             for v in (a, b)]
    rise = 0.75 * (share[a] + share[b])[:, None] / 2 * (above[0] + above[1]) / 2
    split = np.linalg.norm(rise, axis=1) > LEAST_RISE
    new = np.where(split, len(surface.points) + np.cumsum(split) - 1, -1)[edge].reshape(3, -1).T
    a, b, middle, rise = a[split], b[split], middle[split], rise[split]
    place = np.unique(surface.points, axis=0, return_inverse=True)[1]  # the same on both sides of a seam
    ends = coo_matrix((np.ones(2 * len(a)), (place[np.concatenate([a, b])], np.tile(np.arange(len(a)), 2))),
                      shape=(place.max() + 1, len(a))).tocsr()
    drawn_in = ((diags(0.75 / np.maximum(np.asarray(ends.sum(1)).ravel(), 1)) @ ends) @ rise)[place]
    part = divided(surface, a, b, middle + 0.25 * rise, new)
    part.points[: len(drawn_in)] -= drawn_in
    return part


def divided(surface, a, b, middles, new):
    """A Surface without moves, with more vertices at `middles` (N, 3), between the vertices a and b (N). `new` (F, 3):
    which of them lies on the edge from a corner of a triangle to the next one, or -1."""
    normals = surface.normals[a] + surface.normals[b]
    return Surface(
        np.concatenate([surface.points, middles]),
        np.concatenate([surface.normals, normals / np.linalg.norm(normals, axis=1, keepdims=True)]),
        np.concatenate([surface.uvs, (surface.uvs[a] + surface.uvs[b]) / 2]),
        np.array([part for old, on_edges in zip(surface.triangles, new) for part in _split(old, on_edges)]),
        np.concatenate([surface.weights, (surface.weights[a] + surface.weights[b]) / 2]),
    )


def _split(old, new):
    """Triangles of one with a new vertex on the edge from corner k to the next one, or -1."""
    missing = int((new < 0).sum())
    if missing == 3:
        return [old]
    # Turned so that the last edge is the one without a new vertex, or the first the one with it.
    turn = {0: 0, 1: int(np.argmin(new)) + 1, 2: int(np.argmax(new))}[missing]
    a, b, c = np.roll(old, -turn)
    ab, bc, ca = np.roll(new, -turn)
    if missing == 2:
        return [(a, ab, c), (ab, b, c)]
    if missing == 1:
        return [(a, ab, c), (ab, bc, c), (ab, b, bc)]
    return [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]


def thinned(surface, wanted, price=None):
    """A Surface of about `wanted` triangles, without the vertices that are no longer used."""
    triangles = decimate(surface.points, surface.triangles, wanted, price=price)
    used, corners = np.unique(triangles, return_inverse=True)
    return Surface(
        surface.points[used],
        surface.normals[used],
        surface.uvs[used] if surface.uvs is not None else None,
        corners.reshape(-1, 3),
        surface.weights[used],
        {name: move[used] for name, move in surface.moves.items()},
        {name: move[used] for name, move in surface.normal_moves.items()},
    )


def tangents_of(surface):
    """(V, 4) tangents of a Surface as renderers derive them: sums over the triangles of a vertex.

    Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", Terathon Software, 2001."""
    a, b, c = (surface.triangles[:, k] for k in range(3))
    ab, ac = surface.points[b] - surface.points[a], surface.points[c] - surface.points[a]
    ab_uv, ac_uv = surface.uvs[b] - surface.uvs[a], surface.uvs[c] - surface.uvs[a]
    area = ab_uv[:, :1] * ac_uv[:, 1:] - ac_uv[:, :1] * ab_uv[:, 1:]
    area = np.where(np.abs(area) < 1e-12, np.inf, area)
    along_u, along_v = np.zeros_like(surface.points), np.zeros_like(surface.points)
    for corner in (a, b, c):
        np.add.at(along_u, corner, (ab * ac_uv[:, 1:] - ac * ab_uv[:, 1:]) / area)
        np.add.at(along_v, corner, (ac * ab_uv[:, :1] - ab * ac_uv[:, :1]) / area)
    along_u -= (along_u * surface.normals).sum(1, keepdims=True) * surface.normals
    tangents = along_u / np.maximum(np.linalg.norm(along_u, axis=1, keepdims=True), 1e-12)
    down = (np.cross(surface.normals, tangents) * along_v).sum(1, keepdims=True) > 0
    return np.concatenate([tangents, np.where(down, -1.0, 1.0)], 1)


def in_texture(values, uvs, triangles, size):
    """(size, size, C) values (V, C) of vertices spread over their texels; nan where nothing is. `uvs` v down."""
    texels = np.full((size, size, values.shape[1]), np.nan)
    for texel, value in zip(uvs[triangles] * size, values[triangles]):
        low, high = np.floor(texel.min(0)).astype(int) - 1, np.ceil(texel.max(0)).astype(int) + 2
        (left, top), (right, bottom) = np.clip(low, 0, size), np.clip(high, 0, size)
        sides = np.stack([texel[1] - texel[0], texel[2] - texel[0]], 1)
        if abs(np.linalg.det(sides)) < 1e-9:
            continue
        y, x = np.mgrid[top:bottom, left:right] + 0.5
        u, v = np.linalg.solve(sides, np.stack([x.ravel() - texel[0, 0], y.ravel() - texel[0, 1]]))
        inside = ((u > -0.1) & (v > -0.1) & (u + v < 1.1)).reshape(y.shape)
        spot = value[0] + u[:, None] * (value[1] - value[0]) + v[:, None] * (value[2] - value[0])
        texels[top:bottom, left:right][inside] = spot.reshape(*y.shape, -1)[inside]
    return texels
