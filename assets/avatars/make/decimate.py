"""Fewer triangles where nobody looks closely: half-edge collapses by quadric error.

Garland, Heckbert, "Surface Simplification Using Quadric Error Metrics", SIGGRAPH 1997. We differ: a vertex is only ever
moved onto its neighbour, so that everything else that it carries stays true, and rims are kept as they are.
"""

import heapq

import numpy as np


def _quadrics(points, triangles):
    """(V, 4, 4) sums of the squared distances to the planes around each vertex, weighted by area."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    across = np.cross(b - a, c - a)
    area = np.linalg.norm(across, axis=1, keepdims=True)
    normal = across / np.maximum(area, 1e-15)
    plane = np.concatenate([normal, -(normal * a).sum(1, keepdims=True)], 1)
    each = plane[:, :, None] * plane[:, None, :] * area[:, :, None]
    total = np.zeros((len(points), 4, 4))
    for k in range(3):
        np.add.at(total, triangles[:, k], each)
    return total


def _rim(triangles, count):
    """(V) whether a vertex lies on an edge of one triangle alone."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    unique, times = np.unique(edges, axis=0, return_counts=True)
    rim = np.zeros(count, bool)
    rim[unique[times != 2].ravel()] = True
    return rim


def decimate(points, triangles, wanted, locked=None, price=None):
    """(F', 3) at most about `wanted` triangles on the same vertices. `locked` (V) stay; `price` (V) >= 0 multiplies the
    cost of losing a vertex."""
    if len(triangles) <= wanted:
        return triangles
    held = _rim(triangles, len(points))
    if locked is not None:
        held |= locked
    price = np.ones(len(points)) if price is None else price
    quadrics = _quadrics(points, triangles)
    faces = [tuple(face) for face in triangles.tolist()]
    alive = [True] * len(faces)
    around = [set() for _ in points]
    for f, face in enumerate(faces):
        for v in face:
            around[v].add(f)

    def neighbours(v):
        return {w for f in around[v] for w in faces[f]} - {v}

    def cheapest(v):
        best = None
        for u in sorted(neighbours(v)):
            p = np.append(points[u], 1)
            cost = float(p @ (quadrics[v] + quadrics[u]) @ p) * price[v]
            cost += 1e-9 * float(((points[u] - points[v]) ** 2).sum())
            if best is None or cost < best[0]:
                best = (cost, u)
        return best

    def keeps_shape(v, u):
        if len(neighbours(v) & neighbours(u)) != 2:
            return False
        for f in around[v]:
            if u in faces[f]:
                continue
            old = [points[w] for w in faces[f]]
            new = [points[u] if w == v else points[w] for w in faces[f]]
            before = np.cross(old[1] - old[0], old[2] - old[0])
            after = np.cross(new[1] - new[0], new[2] - new[0])
            if before @ after < 0.5 * np.linalg.norm(before) * np.linalg.norm(after) or not after.any():
                return False
        return True

    queue, stamp = [], [0] * len(points)

    def push(v):
        stamp[v] += 1
        found = None if held[v] or not around[v] else cheapest(v)
        if found:
            heapq.heappush(queue, (found[0], v, found[1], stamp[v]))

    for v in range(len(points)):
        push(v)
    left = len(faces)
    while left > wanted and queue:
        _, v, u, when = heapq.heappop(queue)
        if when != stamp[v] or not keeps_shape(v, u):
            continue
        touched = neighbours(v)
        for f in sorted(around[v]):
            if u in faces[f]:
                alive[f] = False
                left -= 1
                for w in faces[f]:
                    if w != v:
                        around[w].discard(f)
            else:
                faces[f] = tuple(u if w == v else w for w in faces[f])
                around[u].add(f)
        around[v] = set()
        stamp[v] += 1
        quadrics[u] += quadrics[v]
        for w in sorted(touched):
            push(w)
    return np.array([face for face, kept in zip(faces, alive) if kept])
