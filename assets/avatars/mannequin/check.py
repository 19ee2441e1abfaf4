"""What must hold for the finished figure; a change of a table that breaks it stops the program."""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

TRIANGLES = (15_000, 25_000)
SMALLEST_AREA = 5e-7  # half a square millimetre [m^2]


def welded(patches):
    """Points (V, 3) and faces (F, 3) of all patches, with vertices at the same place made one."""
    starts = np.cumsum([0] + [len(patch["points"]) for patch in patches])
    faces = np.concatenate([patch["faces"] + start for patch, start in zip(patches, starts)])
    points = np.concatenate([patch["points"] for patch in patches])
    places, twin = np.unique(np.round(points * 1e7).astype(np.int64), axis=0, return_inverse=True)
    return places / 1e7, twin.reshape(-1)[faces]


def check(patches):
    """Raises ValueError if the surface is open, in pieces, unlike its mirror image, too fine or has slivers."""
    points, faces = welded(patches)
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    there, back = ({tuple(edge) for edge in pairs.tolist()} for pairs in (edges, edges[:, ::-1]))
    require(len(there) == len(edges) and there == back, "the surface is not closed, or edges have more than two faces")
    links = coo_matrix((np.ones(len(edges)), edges.T), (len(points), len(points)))
    pieces = connected_components(links)[0]
    require(pieces == 1, f"the surface has {pieces} pieces, 1 is wanted")
    a, b, c = (points[faces[:, i]] for i in range(3))
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).min()
    require(area > SMALLEST_AREA, f"a triangle of {area:.2g} m2; at least {SMALLEST_AREA:.2g} m2 is wanted")
    low, high = TRIANGLES
    require(low <= len(faces) <= high, f"{len(faces)} triangles; {low} to {high} are wanted")
    here, mirrored = ({tuple(p) for p in np.round(half * 1e4).tolist()} for half in (points, points * [-1, 1, 1]))
    require(here == mirrored, "left and right differ")


def require(holds, fault):
    if not holds:
        raise ValueError(f"mannequin: {fault}; change the tables in body.py, head.py or hand.py")
