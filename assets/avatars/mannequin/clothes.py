"""Dresses the meshed half and completes the figure: lifts cloth off the skin, hems its edges, adds the right half."""

import numpy as np

from .shapes import gradient
from .skeleton import CENTRE_PARENTS
from .skin import four_largest


def normals_of(shape, points):
    """Unit normals (V, 3) of the implicit surface; on x = 0 they stay in that plane."""
    normals = gradient(shape, points)
    normals[points[:, 0] == 0, 0] = 0
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def hem_edges(faces, labels, lift):
    """Edges (low label, high label, a, b) where cloth ends, a -> b as the higher side's face runs."""
    owner = {}
    for face, label in zip(faces.tolist(), labels.tolist()):
        for i in range(3):
            owner[face[i], face[(i + 1) % 3]] = label
    return [
        (owner[b, a], label, a, b)
        for (a, b), label in sorted(owner.items())
        if (b, a) in owner and lift[owner[b, a]] < lift[label]
    ]


def hem(edges, points, normals, lift):
    """A narrow wall from the lower surface up to the cloth's edge: points, normals, sources (vertex each) and faces."""
    ring = sorted({v for _, _, a, b in edges for v in (a, b)})
    place = {v: i for i, v in enumerate(ring)}
    outward = np.zeros((len(ring), 3))
    for _, _, a, b in edges:
        for v in (a, b):
            outward[place[v]] += np.cross(points[b] - points[a], normals[v])
    outward[points[ring, 0] == 0, 0] = 0
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    low, high = edges[0][:2]
    foot = points[ring] + lift[low] * normals[ring]
    edge = points[ring] + lift[high] * normals[ring]
    rounded = outward + 0.6 * normals[ring]
    rounded /= np.linalg.norm(rounded, axis=1, keepdims=True)
    count = len(ring)
    faces = []
    for _, _, a, b in edges:
        i, j = place[a], place[b]
        faces += [(j + count, i + count, i), (j + count, i, j)]
    return np.concatenate([foot, edge]), np.concatenate([outward, rounded]), ring + ring, np.array(faces)


def dress(shape, mesh, weights, lift):
    """Patches, one a label, of the whole figure. lift: label -> height of the cloth above the skin [m]."""
    points, faces, labels = mesh
    normals = normals_of(shape, points)
    hems = hem_edges(faces, labels, lift)
    patches = []
    for label, height in sorted(lift.items()):
        used, flat = np.unique(faces[labels == label], return_inverse=True)
        parts = [(points[used] + height * normals[used], normals[used], used, flat.reshape(-1, 3))]
        for low in sorted({h[0] for h in hems if h[1] == label}):
            parts.append(hem([h for h in hems if h[:2] == (low, label)], points, normals, lift))
        patches.append(mirrored(*joined(parts), weights))
    return patches


def joined(parts):
    starts = np.cumsum([0] + [len(part[0]) for part in parts])
    faces = np.concatenate([part[3] + start for part, start in zip(parts, starts)])
    return (*(np.concatenate([part[i] for part in parts]) for i in range(3)), faces)


def mirrored(points, normals, sources, faces, weights):
    """Adds the right half. Vertices on x = 0 are shared by both halves."""
    count = len(points)
    off = np.flatnonzero(points[:, 0] != 0)
    twin = np.arange(count)
    twin[off] = count + np.arange(len(off))
    weights = weights[sources]
    weights[points[:, 0] == 0] = 0.5 * (weights + swapped(weights))[points[:, 0] == 0]
    joints, shares = four_largest(np.concatenate([weights, swapped(weights[off])]))
    flip = np.array([-1, 1, 1])
    return {
        "points": np.concatenate([points, points[off] * flip]),
        "normals": np.concatenate([normals, normals[off] * flip]),
        "joints": joints,
        "weights": shares,
        "faces": np.concatenate([faces, twin[faces][:, ::-1]]),
    }


def swapped(weights):
    """The same weights with left and right joints exchanged. Joints: centre ones, left ones, right ones."""
    centre = len(CENTRE_PARENTS)
    half = (weights.shape[1] - centre) // 2
    order = [*range(centre), *range(centre + half, centre + 2 * half), *range(centre, centre + half)]
    return weights[:, order]
