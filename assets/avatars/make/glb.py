"""Writes a skinned figure with morphs as binary glTF 2.0; the same bytes for the same figure.

Morphs are sparse and quantised: moves as normalised 16-bit numbers of a metre (KHR_mesh_quantization), normal moves
as normalised bytes.
"""

import json
import struct

import numpy as np

BYTE, UBYTE, SHORT, USHORT, FLOAT = 5120, 5121, 5122, 5123, 5126
LEAST_MOVE = 0.00004  # [m] smaller moves are left out


class Glb:
    def __init__(self):
        self.views, self.accessors, self.blob = [], [], b""

    def view(self, data, **more):
        self.blob += b"\0" * (-len(self.blob) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(data), **more})
        self.blob += data
        return len(self.views) - 1

    def accessor(self, array, kind, component, dtype, limits=False, target=None, normalized=False):
        array = np.ascontiguousarray(array, dtype)
        more = {"target": target} if target else {}
        pad = -array.dtype.itemsize * (array.shape[1] if array.ndim == 2 else 1) % 4
        data = array
        if target == 34962 and pad:
            data = np.zeros((len(array), array.shape[1] + pad // array.dtype.itemsize), dtype)
            data[:, : array.shape[1]] = array
            more["byteStride"] = data.shape[1] * array.dtype.itemsize
        entry = {
            "bufferView": self.view(data.tobytes(), **more),
            "componentType": component,
            "count": len(array),
            "type": kind,
        }
        if normalized:
            entry["normalized"] = True
        if limits:
            entry["min"] = [float(x) for x in array.min(0)]
            entry["max"] = [float(x) for x in array.max(0)]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def sparse(self, rows, values, count, component, dtype, limits):
        """A normalised VEC3 accessor that is 0 but for `rows`."""
        values = np.ascontiguousarray(values, dtype)
        entry = {
            "componentType": component,
            "count": count,
            "type": "VEC3",
            "normalized": True,
            "sparse": {
                "count": len(rows),
                "indices": {"bufferView": self.view(rows.astype("<u2").tobytes()), "componentType": USHORT},
                "values": {"bufferView": self.view(values.tobytes())},
            },
        }
        if limits:
            every = values if len(rows) == count else np.concatenate([values, np.zeros((1, 3), dtype)])
            entry["min"] = [int(x) for x in every.min(0)]
            entry["max"] = [int(x) for x in every.max(0)]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def morph(self, move, normal_move):
        rows = np.flatnonzero(np.linalg.norm(move, axis=1) > LEAST_MOVE)
        if not len(rows):
            rows = np.array([0])
        steps = np.round(move[rows] * 32767)
        turns = np.round(np.clip(normal_move[rows], -1, 1) * 127)
        return {
            "POSITION": self.sparse(rows, steps, len(move), SHORT, "<i2", True),
            "NORMAL": self.sparse(rows, turns, len(move), BYTE, "i1", False),
        }


def _weights_bytes(weights):
    """(V, 4) bytes that sum to 255."""
    whole = np.floor(weights * 255 + 0.5).astype(int)
    whole[:, 0] += 255 - whole.sum(1)
    return whole


def _primitive(glb, surface, material, strongest):
    joints, weights = strongest
    attributes = {
        "POSITION": glb.accessor(surface.points, "VEC3", FLOAT, "<f4", True, 34962),
        "NORMAL": glb.accessor(np.round(surface.normals * 32767), "VEC3", SHORT, "<i2", False, 34962, True),
        "JOINTS_0": glb.accessor(joints, "VEC4", UBYTE, "u1", False, 34962),
        "WEIGHTS_0": glb.accessor(_weights_bytes(weights), "VEC4", UBYTE, "u1", False, 34962, True),
    }
    if surface.tangents is not None:
        attributes["TANGENT"] = glb.accessor(np.round(surface.tangents * 127), "VEC4", BYTE, "i1", False, 34962, True)
    if surface.uvs is not None:
        attributes["TEXCOORD_0"] = glb.accessor(surface.uvs, "VEC2", FLOAT, "<f4", False, 34962)
    if surface.colours is not None:
        attributes["COLOR_0"] = glb.accessor(
            np.round(surface.colours * 255), f"VEC{surface.colours.shape[1]}", UBYTE, "u1", False, 34962, True
        )
    assert len(surface.points) < 65536
    primitive = {
        "attributes": attributes,
        "indices": glb.accessor(surface.triangles.ravel(), "SCALAR", USHORT, "<u2", False, 34963),
        "material": material,
    }
    if surface.moves:
        primitive["targets"] = [
            glb.morph(surface.moves[name], surface.normal_moves[name]) for name in surface.moves
        ]
    return primitive


def write_glb(path, name, surfaces, materials, images, skeleton, strongest_four):
    """surfaces: [(material name, Surface)]; materials: [dict]; images: [(name, mime, bytes)];
    skeleton: (names, parents, (J, 3) places)."""
    glb = Glb()
    names, parents, places = skeleton
    nodes = [{"name": name, "children": []}]
    for j, joint in enumerate(names):
        origin = places[parents[j]] if parents[j] >= 0 else np.zeros(3)
        nodes.append({"name": joint, "translation": [round(float(x), 6) for x in places[j] - origin]})
        nodes[parents[j] + 1].setdefault("children", []).append(j + 1)
    # The places that the rounded translations give, so that the bind pose is the rest pose.
    world = np.zeros((len(names), 3))
    for j in range(len(names)):
        world[j] = np.array(nodes[j + 1]["translation"]) + (world[parents[j]] if parents[j] >= 0 else 0)
    inverse = np.tile(np.eye(4), (len(names), 1, 1))
    inverse[:, 3, :3] = -world
    meshes, roots = [], [0]
    index = {material["name"]: i for i, material in enumerate(materials)}
    for material, surface in surfaces:
        mesh = {"name": material, "primitives": [_primitive(glb, surface, index[material], strongest_four(surface.weights))]}
        if surface.moves:
            mesh["weights"] = [0.0] * len(surface.moves)
            mesh["extras"] = {"targetNames": list(surface.moves)}
        meshes.append(mesh)
        roots.append(len(nodes))
        nodes.append({"name": f"{material}_surface", "mesh": len(meshes) - 1, "skin": 0})
    skin = {
        "inverseBindMatrices": glb.accessor(inverse.reshape(-1, 16), "MAT4", FLOAT, "<f4"),
        "joints": list(range(1, len(names) + 1)),
        "skeleton": 1,
    }
    entries = []
    for image, mime, data in images:
        entries.append({"name": image, "mimeType": mime, "bufferView": glb.view(data)})
    document = {
        "asset": {"version": "2.0", "generator": "make_avatars.py", "copyright": "CC0 1.0"},
        "extensionsUsed": ["KHR_mesh_quantization", *sorted({name for m in materials for name in m.get("extensions", {})})],
        "extensionsRequired": ["KHR_mesh_quantization"],
        "scene": 0,
        "scenes": [{"nodes": roots}],
        "nodes": nodes,
        "meshes": meshes,
        "skins": [skin],
        "materials": materials,
        "textures": [{"sampler": 0, "source": i} for i in range(len(images))],
        "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}],
        "images": entries,
        "accessors": glb.accessors,
        "bufferViews": glb.views,
    }
    blob = glb.blob + b"\0" * (-len(glb.blob) % 4)
    document["buffers"] = [{"byteLength": len(blob)}]
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(blob))
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(blob), b"BIN\0") + blob
    path.write_bytes(head + chunks)
