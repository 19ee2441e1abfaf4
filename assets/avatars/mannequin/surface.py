"""From an implicit surface to a triangle mesh whose edges have the lengths asked for.

Marching cubes on a grid that is fine where it must be, then rounds of splitting, collapsing, flipping
and relaxing edges (Botsch and Kobbelt's remeshing), each round ending with the vertices back on the surface.
Faces carry a label; the lines between labels, and the open edge at x = 0, are kept as lines.
"""

import numpy as np
from skimage.measure import marching_cubes

from .shapes import gradient


def polygonise(shape, axes, block=4):
    """Marching cubes on the grid `axes` (three rising arrays) -> vertices, faces.

    `shape` is evaluated on every `block`-th line first, and then only in the blocks near its surface.
    """
    coarse = [np.unique(np.append(np.arange(0, len(a), block), len(a) - 1)) for a in axes]
    rough = shape(lattice([a[c] for a, c in zip(axes, coarse)])).reshape([len(c) for c in coarse])
    values = np.ones([len(a) for a in axes])
    wanted = np.zeros(values.shape, bool)
    for corner in np.ndindex(*[len(c) - 1 for c in coarse]):
        near = rough[tuple(slice(i, i + 2) for i in corner)]
        ends = [(c[i], c[i + 1]) for c, i in zip(coarse, corner)]
        span = tuple(slice(a, b + 1) for a, b in ends)
        values[span] = np.sign(near.flat[0])
        diagonal = np.linalg.norm([a[e[1]] - a[e[0]] for a, e in zip(axes, ends)])
        wanted[span] |= np.abs(near).min() < 1.2 * diagonal
    points = lattice(axes)[wanted.ravel()]
    values[wanted] = np.concatenate([shape(part) for part in np.array_split(points, 1 + len(points) // 200000)])
    vertices, faces, _, _ = marching_cubes(values, 0.0, gradient_direction="descent")
    vertices = [np.interp(vertices[:, i], np.arange(len(a)), a) for i, a in enumerate(axes)]
    return np.stack(vertices, axis=1), faces


def lattice(axes):
    """All points (N, 3) of the grid `axes`."""
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


class Surface:
    """A triangle mesh that can be edited edge by edge."""

    def __init__(self, vertices, faces, labels=None):
        self.points = [tuple(v) for v in vertices.tolist()]
        self.faces = [tuple(f) for f in faces.tolist()]
        self.labels = [0] * len(self.faces) if labels is None else list(labels)
        self.around = [set() for _ in self.points]  # faces of each vertex
        for number, face in enumerate(self.faces):
            for vertex in face:
                self.around[vertex].add(number)

    # ---- Looking
    def edges(self):
        """Sorted list of the edges (a, b), a < b."""
        found = set()
        for face in self.faces:
            if face is not None:
                for i in range(3):
                    a, b = face[i], face[i - 1]
                    found.add((a, b) if a < b else (b, a))
        return sorted(found)

    def beside(self, a, b):
        """The faces on the edge a-b, in order."""
        return sorted(self.around[a] & self.around[b])

    def neighbours(self, vertex):
        found = set()
        for number in self.around[vertex]:
            found.update(self.faces[number])
        found.discard(vertex)
        return found

    def is_line(self, a, b):
        """Does the edge lie on the border of the mesh or of a label?"""
        faces = self.beside(a, b)
        return len(faces) == 1 or self.labels[faces[0]] != self.labels[faces[1]]

    def kinds(self):
        """Per vertex: 0 inside, 1 on a line, 2 where lines meet."""
        border, lines = line_vertices(self)
        return [(v in border) + (v in lines) for v in range(len(self.points))]

    def length(self, a, b):
        p, q = self.points[a], self.points[b]
        return ((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 + (p[2] - q[2]) ** 2) ** 0.5

    def normal(self, face):
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (self.points[v] for v in face)
        ux, uy, uz, vx, vy, vz = bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az
        return (uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx)

    def arrays(self):
        """Vertices (V, 3), faces (F, 3) and labels (F,), without what was removed."""
        kept = [i for i, face in enumerate(self.faces) if face is not None]
        faces = np.array([self.faces[i] for i in kept])
        used, flat = np.unique(faces, return_inverse=True)
        return np.array(self.points)[used], flat.reshape(-1, 3), np.array([self.labels[i] for i in kept])

    # ---- Editing
    def set_face(self, number, face):
        for vertex in self.faces[number] or ():
            self.around[vertex].discard(number)
        self.faces[number] = face
        for vertex in face or ():
            self.around[vertex].add(number)

    def add_face(self, face, label):
        self.faces.append(None)
        self.labels.append(label)
        self.set_face(len(self.faces) - 1, face)

    def split(self, a, b, share=0.5):
        """Puts a vertex on the edge, `share` of the way from a to b, and returns it."""
        p, q = self.points[a], self.points[b]
        middle = len(self.points)
        self.points.append(tuple(p[i] + share * (q[i] - p[i]) for i in range(3)))
        self.around.append(set())
        for number in self.beside(a, b):
            face = self.faces[number]
            self.set_face(number, tuple(middle if v == b else v for v in face))
            self.add_face(tuple(middle if v == a else v for v in face), self.labels[number])
        return middle

    def can_collapse(self, gone, kept, kinds, longest):
        if kinds[gone] > kinds[kept] or kinds[gone] == 2 or (kinds[gone] == 1 and not self.is_line(gone, kept)):
            return False
        shared = self.neighbours(gone) & self.neighbours(kept)
        if len(shared) != len(self.beside(gone, kept)):
            return False
        if any(self.length(kept, v) > longest for v in self.neighbours(gone)):
            return False
        return all(self.stays_upright(number, gone, kept) for number in self.around[gone] - self.around[kept])

    def stays_upright(self, number, gone, kept):
        face = self.faces[number]
        old, new = self.normal(face), self.normal(tuple(kept if v == gone else v for v in face))
        dot = sum(a * b for a, b in zip(old, new))
        return dot > 0.3 * (sum(a * a for a in old) * sum(b * b for b in new)) ** 0.5

    def collapse(self, gone, kept):
        for number in self.beside(gone, kept):
            self.set_face(number, None)
        for number in sorted(self.around[gone]):
            self.set_face(number, tuple(kept if v == gone else v for v in self.faces[number]))

    def flip(self, a, b):
        """Turns the edge a-b inside its two faces, unless that folds the surface. Says whether it did."""
        first, second = self.beside(a, b)
        face = self.faces[first]
        if face[face.index(a) - 2] != b:
            first, second = second, first
        c = next(v for v in self.faces[first] if v not in (a, b))
        d = next(v for v in self.faces[second] if v not in (a, b))
        if self.around[c] & self.around[d]:
            return False
        one, two = (a, d, c), (d, b, c)
        old = self.normal(self.faces[first]), self.normal(self.faces[second])
        new = self.normal(one), self.normal(two)
        if min(cosine(o, n) for o in old for n in new) < 0.5:
            return False
        self.set_face(first, one)
        self.set_face(second, two)
        return True


def cosine(a, b):
    sizes = (sum(x * x for x in a) * sum(x * x for x in b)) ** 0.5
    return sum(x * y for x, y in zip(a, b)) / max(sizes, 1e-30)


def cut(surface, side, label):
    """Splits the faces along side = 0 and gives `label` to those with side > 0. `side`: points -> (N,)."""
    value = side(np.array(surface.points)).tolist()
    for a, b in surface.edges():
        if value[a] * value[b] < 0:
            surface.split(a, b, value[a] / (value[a] - value[b]))
            value.append(0.0)
    for number, face in enumerate(surface.faces):
        if face is not None and sum(value[v] for v in face) > 0:
            surface.labels[number] = label


def split_long(surface, size):
    for length, a, b in sorted(((surface.length(a, b), a, b) for a, b in surface.edges()), reverse=True):
        if length > 4 / 3 * 0.5 * (size[a] + size[b]):
            surface.split(a, b)


def collapse_short(surface, size):
    kinds = surface.kinds()
    order = sorted((surface.length(a, b), a, b) for a, b in surface.edges())
    for _, a, b in order:
        target = 0.5 * (size[a] + size[b])
        if not surface.around[a] & surface.around[b] or surface.length(a, b) > 0.8 * target:
            continue
        for gone, kept in ((a, b), (b, a)):
            if surface.can_collapse(gone, kept, kinds, 4 / 3 * target):
                surface.collapse(gone, kept)
                break


def flip_edges(surface):
    """Flips the edges that thereby bring their corners nearer to 6 edges, or 4 on the open border."""
    border, _ = line_vertices(surface)
    goal = [4 if v in border else 6 for v in range(len(surface.points))]
    valence = [len(surface.neighbours(v)) for v in range(len(surface.points))]
    for a, b in surface.edges():
        faces = surface.beside(a, b)
        if surface.is_line(a, b):
            continue
        c, d = (next(v for v in surface.faces[f] if v not in (a, b)) for f in faces)
        changes = ((a, -1), (b, -1), (c, 1), (d, 1))
        before = sum(abs(valence[v] - goal[v]) for v, _ in changes)
        after = sum(abs(valence[v] + change - goal[v]) for v, change in changes)
        if after < before and surface.flip(a, b):
            for v, change in changes:
                valence[v] += change


def line_vertices(surface):
    """The vertices on the open border, and those on the lines between labels."""
    border, lines = set(), set()
    for a, b in surface.edges():
        if surface.is_line(a, b):
            (border if len(surface.beside(a, b)) == 1 else lines).update((a, b))
    return border, lines


def relax(surface, lines):
    """Moves every vertex towards the middle of its neighbours; on a line, of its neighbours on the line."""
    kinds = surface.kinds()
    near = [[] for _ in surface.points]
    for a, b in surface.edges():
        line = surface.is_line(a, b)
        for v, w in ((a, b), (b, a)):
            if kinds[v] == 0 or (kinds[v] == 1 and line):
                near[v].append(w)
    points = np.array(surface.points)
    moved = points.copy()
    for v, others in enumerate(near):
        if others:
            moved[v] = 0.4 * points[v] + 0.6 * points[others].mean(axis=0)
    project(surface, moved, lines)


def project(surface, points, lines):
    """Puts `points` back on the shape, those of a line back on the line, and x = 0 stays x = 0."""
    shape, sides = lines
    border, marked = (np.array(sorted(found), int) for found in line_vertices(surface))
    used = np.array([i for i, faces in enumerate(surface.around) if faces], int)
    for _ in range(3):
        if len(marked):
            step_to_zero(points, marked, lambda p: nearest_side(sides, p), border)
        step_to_zero(points, used, shape, border)
    surface.points = [tuple(p) for p in points.tolist()]


def nearest_side(sides, points):
    """The value of that border function which is closest to zero."""
    values = np.stack([side(points) for side in sides])
    return values[np.abs(values).argmin(axis=0), np.arange(len(points))]


def step_to_zero(points, which, function, flat):
    """One Newton step of points[which] along the gradient of `function`; points[flat] stay at x = 0."""
    part = points[which]
    slope = gradient(function, part)
    slope[np.isin(which, flat), 0] = 0
    step = slope * (function(part) / np.maximum((slope**2).sum(axis=1), 0.05))[:, None]
    length = np.linalg.norm(step, axis=1, keepdims=True)
    points[which] = part - step * np.minimum(1, 0.01 / np.maximum(length, 1e-12))
    points[flat, 0] = 0


def remesh(surface, shape, size, sides, rounds):
    """`rounds` of remeshing to the edge lengths size(points) [m]."""
    for _ in range(rounds):
        split_long(surface, size(np.array(surface.points)))
        collapse_short(surface, size(np.array(surface.points)))
        flip_edges(surface)
        relax(surface, (shape, sides))
    return surface
