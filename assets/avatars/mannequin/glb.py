"""Writes a skinned figure as a binary glTF 2.0 file."""

import json
import struct

import numpy as np

COMPONENT = {"float32": 5126, "uint8": 5121, "uint16": 5123, "uint32": 5125}
SHAPE = {1: "SCALAR", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963


class Binary:
    """Collects arrays as the views and accessors of one glTF buffer."""

    def __init__(self):
        self.data, self.views, self.accessors = bytearray(), [], []

    def add(self, array, target=None, limits=False):
        """Index of the accessor of `array` (N,) or (N, C)."""
        array = np.ascontiguousarray(array)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": array.nbytes}
        if target:
            view["target"] = target
        accessor = {
            "bufferView": len(self.views),
            "componentType": COMPONENT[array.dtype.name],
            "count": len(array),
            "type": SHAPE[array[0].size],
        }
        if limits:
            accessor["min"], accessor["max"] = array.min(axis=0).tolist(), array.max(axis=0).tolist()
        if target == ARRAY_BUFFER and array.dtype == np.uint16:
            accessor["normalized"] = True
        self.data += array.tobytes() + bytes(-array.nbytes % 4)
        self.views.append(view)
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def add_patch(binary, patch, material):
    """A primitive of the vertices and triangles in `patch`."""
    attributes = {
        "POSITION": binary.add(patch["points"].astype(np.float32), ARRAY_BUFFER, limits=True),
        "NORMAL": binary.add(patch["normals"].astype(np.float32), ARRAY_BUFFER),
        "JOINTS_0": binary.add(patch["joints"], ARRAY_BUFFER),
        "WEIGHTS_0": binary.add(patch["weights"], ARRAY_BUFFER),
    }
    indices = binary.add(patch["faces"].astype(np.uint16).ravel(), ELEMENT_ARRAY_BUFFER)
    return {"attributes": attributes, "indices": indices, "material": material}


def joint_nodes(parents, points):
    """One node a joint, untwisted, placed from its parent's point."""
    names = list(parents)
    nodes = []
    for name, parent in parents.items():
        offset = np.float64(points[name]) - (points[parent] if parent else 0)
        node = {"name": name, "translation": np.round(offset, 6).tolist()}
        children = [names.index(other) for other in names if parents[other] == name]
        if children:
            node["children"] = children
        nodes.append(node)
    return nodes


def rest_points(nodes):
    """World points (J, 3) of the joint nodes, from their rounded translations."""
    points = [np.zeros(3)] * len(nodes)
    points[0] = np.array(nodes[0]["translation"])
    for number, node in enumerate(nodes):
        for child in node.get("children", ()):
            points[child] = points[number] + nodes[child]["translation"]
    return np.array(points)


def inverse_binds(points):
    """Column-major matrices (J, 16) that move each joint's point (J, 3) to the origin."""
    matrices = np.tile(np.eye(4, dtype=np.float32), (len(points), 1, 1))
    matrices[:, 3, :3] = -points
    return matrices.reshape(-1, 16)


def material(name, srgb, roughness):
    linear = [((c / 255 + 0.055) / 1.055) ** 2.4 if c > 10 else c / 255 / 12.92 for c in srgb]
    colour = [round(c, 5) for c in linear] + [1.0]
    surface = {"baseColorFactor": colour, "metallicFactor": 0.0, "roughnessFactor": roughness}
    return {"name": name, "pbrMetallicRoughness": surface}


def write_glb(path, name, patches, materials, skeleton):
    """patches: one dict per material; skeleton: (parents, points) by joint name."""
    binary = Binary()
    primitives = [add_patch(binary, patch, number) for number, patch in enumerate(patches)]
    nodes = joint_nodes(*skeleton)
    binds = binary.add(inverse_binds(rest_points(nodes)))
    document = {
        "asset": {"version": "2.0", "generator": "make_mannequin.py", "copyright": "CC0-1.0"},
        "scene": 0,
        "scenes": [{"name": name, "nodes": [len(nodes), 0]}],
        "nodes": nodes + [{"name": name, "mesh": 0, "skin": 0}],
        "meshes": [{"name": name, "primitives": primitives}],
        "skins": [{"name": name, "inverseBindMatrices": binds, "skeleton": 0, "joints": list(range(len(nodes)))}],
        "materials": materials,
        "accessors": binary.accessors,
        "bufferViews": binary.views,
        "buffers": [{"byteLength": len(binary.data)}],
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(binary.data)
    with open(path, "wb") as file:
        file.write(struct.pack("<4sII", b"glTF", 2, total))
        file.write(struct.pack("<I4s", len(text), b"JSON") + text)
        file.write(struct.pack("<I4s", len(binary.data), b"BIN\0") + bytes(binary.data))
