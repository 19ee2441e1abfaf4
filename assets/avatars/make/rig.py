"""The 55 human joints, where they are in a shaped body, and how they hold the base mesh.

MakeHuman's rig has 163 bones; its face, palm and twist bones are folded into the human joint that carries them.
"""

import numpy as np

from . import surface

FINGERS = ("thumb", "index", "middle", "ring", "little")


def _tree():
    """(joint, parent, the bone whose head is the joint), parents first."""
    tree = [
        ("hips", None, "root"),
        ("spine", "hips", "spine04"),
        ("chest", "spine", "spine03"),
        ("upper_chest", "chest", "spine02"),
        ("neck", "upper_chest", "neck01"),
        ("head", "neck", "head"),
        ("jaw", "head", "jaw"),
    ]
    for side, s in (("left", "L"), ("right", "R")):
        tree += [(f"{side}_eye", "head", f"eye.{s}")]
    for side, s in (("left", "L"), ("right", "R")):
        tree += [
            (f"{side}_shoulder", "upper_chest", f"clavicle.{s}"),
            (f"{side}_upper_arm", f"{side}_shoulder", f"upperarm01.{s}"),
            (f"{side}_lower_arm", f"{side}_upper_arm", f"lowerarm01.{s}"),
            (f"{side}_hand", f"{side}_lower_arm", f"wrist.{s}"),
        ]
        for f, finger in enumerate(FINGERS, 1):
            parent = f"{side}_hand"
            for k in (1, 2, 3):
                tree.append((f"{side}_{finger}_{k}", parent, f"finger{f}-{k}.{s}"))
                parent = f"{side}_{finger}_{k}"
        tree += [
            (f"{side}_upper_leg", "hips", f"upperleg01.{s}"),
            (f"{side}_lower_leg", f"{side}_upper_leg", f"lowerleg01.{s}"),
            (f"{side}_foot", f"{side}_lower_leg", f"foot.{s}"),
            (f"{side}_toes", f"{side}_foot", f"toe2-1.{s}"),
        ]
    return tree


TREE = _tree()
NAMES = [name for name, _, _ in TREE]
PARENTS = [-1 if parent is None else NAMES.index(parent) for _, parent, _ in TREE]
_JOINT_OF_BONE = {bone: NAMES.index(name) for name, _, bone in TREE}

# Bones between two joints are shared by both.
_SHARED = {
    "neck03": {"neck": 0.6, "head": 0.4},
    "neck01": {"neck": 0.8, "upper_chest": 0.2},
    "shoulder01.L": {"left_shoulder": 0.55, "left_upper_arm": 0.45},
    "shoulder01.R": {"right_shoulder": 0.55, "right_upper_arm": 0.45},
    "lowerarm02.L": {"left_lower_arm": 0.75, "left_hand": 0.25},
    "lowerarm02.R": {"right_lower_arm": 0.75, "right_hand": 0.25},
    "spine01": {"upper_chest": 1.0},
    "spine05": {"hips": 1.0},
}


def joint_points(package, points):
    """(55, 3) [m] where the joints are in the shaped base mesh `points`."""
    places = np.array([package.joint(f"{bone}____head", points) for _, _, bone in TREE])
    middle = [i for i, name in enumerate(NAMES) if not name.startswith(("left", "right"))]
    places[middle, 0] = 0
    for i, name in enumerate(NAMES):
        if name.startswith("left"):
            j = NAMES.index(name.replace("left", "right", 1))
            mean = (places[i] + places[j] * [-1, 1, 1]) / 2
            places[i], places[j] = mean, mean * [-1, 1, 1]
    return places


SOFT_REACH = 0.20  # [m] around the shoulder joint
SOFT_STEPS = 30


def softened(package, weights):
    """(V, J) weights whose change from trunk to arm is spread over the shoulder, so that it neither bulges when the
    arm hangs nor folds when it is raised."""
    links = surface.links(package.base.quads, len(weights))
    places = joint_points(package, package.base.points)
    near = np.zeros(len(weights))
    for side in ("left", "right"):
        far = np.linalg.norm(package.base.points - places[NAMES.index(f"{side}_upper_arm")], axis=1)
        near = np.maximum(near, np.clip(2 * (1 - far / SOFT_REACH), 0, 1))
    for _ in range(SOFT_STEPS):
        weights = weights + 0.7 * near[:, None] * (links @ weights - weights)
    return weights / weights.sum(1, keepdims=True)


def _shares_of_bone(package, bone):
    """{joint index: share} that a bone's weight goes to."""
    while bone not in _JOINT_OF_BONE and bone not in _SHARED:
        bone = package.parent_of_bone[bone]
    if bone in _SHARED:
        return {NAMES.index(name): share for name, share in _SHARED[bone].items()}
    return {_JOINT_OF_BONE[bone]: 1.0}


def base_weights(package):
    """(V, 55) how the joints hold the base mesh, rows sum to 1."""
    weights = np.zeros((len(package.base.points), len(NAMES)))
    fold = np.zeros((len(package.bones), len(NAMES)))
    for b, bone in enumerate(package.bones):
        if bone in package.parent_of_bone:
            for joint, share in _shares_of_bone(package, bone).items():
                fold[b, joint] = share
    for k in range(4):
        weights += package.weight_of[:, k : k + 1] * fold[package.bone_of[:, k]]
    return weights / weights.sum(1, keepdims=True)


def without(weights, joints, other):
    """(V, J) weights of which what `joints` hold is held by the `other`."""
    weights, gone = weights.copy(), [NAMES.index(joint) for joint in joints]
    weights[:, NAMES.index(other)] += weights[:, gone].sum(1)
    weights[:, gone] = 0
    return weights


def fewer(weights):
    """(V, J) weights of at most 4 joints: all less by the fifth, so that none jumps from vertex to vertex."""
    weights = np.clip(weights - np.sort(weights, axis=1)[:, -5:-4], 0, None)
    return weights / weights.sum(1, keepdims=True)


def strongest_four(weights):
    """(V, 4) joints and (V, 4) weights that sum to 1, strongest first."""
    joints = np.argsort(-weights, axis=1, kind="stable")[:, :4]
    kept = np.take_along_axis(weights, joints, 1)
    kept[kept < 0.004] = 0
    joints[kept == 0] = 0
    return joints, kept / kept.sum(1, keepdims=True)
