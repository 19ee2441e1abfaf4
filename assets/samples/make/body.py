"""The body of the samples: a skeleton of normal proportions, arm and leg IK, and its files.

Metres, radians, y up, the body faces +z and its left is +x. At rest it stands in a T pose with
palms down and every joint is aligned with the world, so all rest rotations are the identity.
Rotation matrices are (T, 3, 3), positions (T, 3), scalars (T,): T frames at once.
"""

from dataclasses import dataclass

import numpy as np

FINGERS = ("Index", "Middle", "Ring", "Pinky")
UPPER_ARM, FOREARM = 0.282, 0.252
THIGH, SHIN = 0.420, 0.405
ANKLE_HEIGHT = 0.085


def _hand(side):
    """Joints of one hand: (name, parent, offset of the left hand)."""
    hand = "Hand"
    rows = {
        "Thumb": [
            (0.026, -0.012, 0.024),
            (0.033, -0.014, 0.026),
            (0.025, -0.008, 0.016),
            (0.021, -0.006, 0.010),
        ],
        "Index": [(0.090, -0.002, 0.026), (0.042, 0, 0.002), (0.025, 0, 0), (0.021, 0, 0)],
        "Middle": [(0.092, 0.001, 0.004), (0.046, 0, 0), (0.029, 0, 0), (0.022, 0, 0)],
        "Ring": [(0.087, -0.001, -0.016), (0.042, 0, -0.001), (0.027, 0, 0), (0.022, 0, 0)],
        "Pinky": [(0.079, -0.005, -0.033), (0.033, 0, -0.002), (0.020, 0, 0), (0.020, 0, 0)],
    }
    joints = []
    for finger, offsets in rows.items():
        parent = hand
        for index, offset in enumerate(offsets, start=1):
            name = f"Hand{finger}{index}"
            joints.append((name, parent, offset))
            parent = name
    return [(side + name, side + parent, offset) for name, parent, offset in joints]


def _limbs(side):
    arm = [
        (side + "Shoulder", "Spine2", (0.028, 0.118, 0.012)),
        (side + "Arm", side + "Shoulder", (0.148, -0.006, -0.026)),
        (side + "ForeArm", side + "Arm", (UPPER_ARM, 0, 0)),
        (side + "Hand", side + "ForeArm", (FOREARM, 0, 0)),
    ]
    leg = [
        (side + "UpLeg", "Hips", (0.090, -0.035, 0.005)),
        (side + "Leg", side + "UpLeg", (0, -THIGH, 0)),
        (side + "Foot", side + "Leg", (0, -SHIN, 0)),
        (side + "ToeBase", side + "Foot", (0, -0.062, 0.135)),
        (side + "ToeEnd", side + "ToeBase", (0, -0.008, 0.070)),
    ]
    return arm, leg


def _skeleton():
    trunk = [
        ("Hips", None, (0, 0.945, 0)),
        ("Spine", "Hips", (0, 0.095, -0.012)),
        ("Spine1", "Spine", (0, 0.118, -0.008)),
        ("Spine2", "Spine1", (0, 0.130, 0.002)),
        ("Neck", "Spine2", (0, 0.168, -0.012)),
        ("Head", "Neck", (0, 0.092, 0.022)),
        ("HeadEnd", "Head", (0, 0.178, 0.012)),
    ]
    joints = list(trunk)
    for side, sign in (("Left", 1), ("Right", -1)):
        arm, leg = _limbs(side)
        for name, parent, (x, y, z) in arm + _hand(side) + leg:
            joints.append((name, parent, (sign * x, y, z)))
    return joints


SKELETON = _skeleton()
PARENT = {name: parent for name, parent, _ in SKELETON}
OFFSET = {name: np.array(offset, float) for name, _, offset in SKELETON}
# The tips close a chain: they carry no rotation and become End Sites.
TIPS = {name for name in PARENT if name.endswith(("End", "4"))}


def rest_position(joint):
    return OFFSET[joint] + (rest_position(PARENT[joint]) if PARENT[joint] else 0)


def turn(axis, angle):
    """Rotation matrices about one axis. axis: 'x', 'y', 'z' or (3,) unit; angle (T,) or float."""
    named = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}
    a = np.array(named[axis] if isinstance(axis, str) else axis, float)
    angle = np.atleast_1d(np.asarray(angle, float))[:, None, None]
    cross = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * (cross @ cross)


def rotate(matrices, vectors):
    return np.einsum("...ij,...j->...i", matrices, vectors)


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def frame(primary, secondary):
    """Rotation matrices whose columns are `primary`, `secondary` made orthogonal, and their cross."""
    a = unit(primary)
    b = unit(secondary - np.sum(secondary * a, -1, keepdims=True) * a)
    return np.stack([a, b, np.cross(a, b)], -1)


@dataclass
class Bend:
    upper: np.ndarray  # (T, 3, 3) world rotation of the upper bone
    flexion: np.ndarray  # (T,) bend of the middle joint
    forward: np.ndarray  # (T, 3) unit, direction of the lower bone, world


def _reach(root, target, lengths, soft_from):
    """Angle between the reach line and the upper bone, the line itself, and the flexion.

    soft_from: share of the full length from where the limb slows down instead of stopping, so
    that the elbow does not pop at full stretch.
    """
    first, second = lengths
    line = target - root
    distance = np.linalg.norm(line, axis=-1)
    near, far = soft_from * (first + second), (first + second) * (1 + soft_from) / 2
    over = np.maximum(distance - near, 0)
    soft = np.where(distance > near, near + (far - near) * (1 - np.exp(-over / (far - near))), distance)
    alpha = np.arccos((first**2 + soft**2 - second**2) / (2 * first * soft))
    inner = np.arccos(np.clip((first**2 + second**2 - soft**2) / (2 * first * second), -1, 1))
    return alpha, unit(line), np.pi - inner


def solve_arm(sign, shoulder, wrist, swivel):
    """Two-bone arm with the elbow on its circle: swivel 0 down and back, pi/2 out to the side.

    sign: +1 left, -1 right. Tolani, Goswami, Badler's analytic solution; the reference direction
    leans back so that a hanging arm, too, has a defined elbow.
    """
    alpha, line, flexion = _reach(shoulder, wrist, (UPPER_ARM, FOREARM), soft_from=0.95)
    down_back = np.array([0.0, -0.80, -0.60])
    u = unit(down_back - np.sum(down_back * line, -1, keepdims=True) * line)
    v = sign * np.cross(line, u)
    swivel = np.asarray(swivel)[..., None]
    outward = np.cos(swivel) * u + np.sin(swivel) * v
    upper_direction = np.cos(alpha)[..., None] * line + np.sin(alpha)[..., None] * outward
    hinge = np.cross(outward, line)  # the forearm flexes about it
    rest = frame(np.array([sign, 0.0, 0.0]), np.array([0.0, -sign, 0.0]))
    upper = frame(upper_direction, hinge) @ rest.T
    elbow = shoulder + UPPER_ARM * upper_direction
    reached = shoulder + line * np.sqrt(
        UPPER_ARM**2 + FOREARM**2 + 2 * UPPER_ARM * FOREARM * np.cos(flexion)
    )[..., None]
    return Bend(upper, flexion, unit(reached - elbow))


def solve_leg(hip, ankle, knee_forward):
    """Two-bone leg whose knee points to `knee_forward`; returns the world rotation and the flexion."""
    alpha, line, flexion = _reach(hip, ankle, (THIGH, SHIN), soft_from=0.999)
    outward = unit(knee_forward - np.sum(knee_forward * line, -1, keepdims=True) * line)
    direction = np.cos(alpha)[..., None] * line + np.sin(alpha)[..., None] * outward
    hinge = np.cross(outward, line)
    rest = frame(np.array([0.0, -1.0, 0.0]), np.array([1.0, 0.0, 0.0]))
    return frame(direction, hinge) @ rest.T, flexion


def forward_kinematics(local, root):
    """World rotations and positions of all joints from local rotations; root (T, 3)."""
    count = len(root)
    rotation, position = {}, {}
    for name, parent, _ in SKELETON:
        own = local.get(name, np.broadcast_to(np.eye(3), (count, 3, 3)))
        if parent is None:
            rotation[name], position[name] = own, root
            continue
        rotation[name] = rotation[parent] @ own
        position[name] = position[parent] + rotate(rotation[parent], OFFSET[name])
    return rotation, position


def euler_zxy(matrices):
    """Angles (T, 3) in degrees, order z, x, y, continuous in time."""
    z = np.arctan2(-matrices[:, 0, 1], matrices[:, 1, 1])
    x = np.arcsin(np.clip(matrices[:, 2, 1], -1, 1))
    y = np.arctan2(-matrices[:, 2, 0], matrices[:, 2, 2])
    return np.degrees(np.stack([np.unwrap(z), x, np.unwrap(y)], -1))


def write_bvh(path, local, root, fps):
    """Centimetres and degrees, rotations in z, x, y order, position channels at the root alone."""
    lines, order = ["HIERARCHY"], []
    _write_joint(lines, order, "Hips", 0)
    count = len(root)
    still = np.broadcast_to(np.eye(3), (count, 3, 3))
    columns = [100 * root] + [euler_zxy(local.get(name, still)) for name in order]
    table = np.concatenate(columns, axis=1)
    table[np.abs(table) < 5e-4] = 0
    lines += ["MOTION", f"Frames: {count}", f"Frame Time: {1 / fps:.8f}"]
    lines += [" ".join(f"{value:.3f}" for value in row) for row in table]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def _write_joint(lines, order, name, depth):
    tab, inner = "\t" * depth, "\t" * (depth + 1)
    offset = 100 * OFFSET[name] if depth else np.zeros(3)
    numbers = " ".join(f"{value:.3f}" for value in offset + 0.0)
    if name in TIPS:
        lines += [f"{tab}End Site", f"{tab}{{", f"{inner}OFFSET {numbers}", f"{tab}}}"]
        return
    order.append(name)
    channels = "3 Zrotation Xrotation Yrotation"
    if depth == 0:
        channels = "6 Xposition Yposition Zposition Zrotation Xrotation Yrotation"
    head = "JOINT" if depth else "ROOT"
    lines += [f"{tab}{head} {name}", f"{tab}{{", f"{inner}OFFSET {numbers}", f"{inner}CHANNELS {channels}"]
    for child in [n for n, parent in PARENT.items() if parent == name]:
        _write_joint(lines, order, child, depth + 1)
    lines.append(f"{tab}}}")


# Keypoints: (name, joint of this skeleton). Names are those of skinning/body/keypoint_layout.h.
def _keypoints():
    points = [
        ("pelvis", "Hips"), ("spine", "Spine"), ("chest", "Spine1"), ("upper_chest", "Spine2"),
        ("neck", "Neck"), ("head", "Head"), ("head_top", "HeadEnd"),
    ]  # fmt: skip
    limbs = [
        ("collar", "Shoulder"), ("shoulder", "Arm"), ("elbow", "ForeArm"), ("wrist", "Hand"),
        ("hip", "UpLeg"), ("knee", "Leg"), ("ankle", "Foot"), ("toe", "ToeBase"),
    ]  # fmt: skip
    for side in ("left", "right"):
        points += [(f"{side}_{name}", side.title() + joint) for name, joint in limbs]
        for name, finger in (("thumb", "Thumb"), *((f.lower().replace("pinky", "little"), f) for f in FINGERS)):
            points += [(f"{side}_{name}_{k}", f"{side.title()}Hand{finger}{k}") for k in (1, 2, 3, 4)]
    return points


KEYPOINTS = _keypoints()
# On the skin of the head, from the head joint [m].
FACE_POINTS = {
    "nose": (0, 0.048, 0.118),
    "left_eye": (0.032, 0.082, 0.092), "right_eye": (-0.032, 0.082, 0.092),
    "left_ear": (0.074, 0.066, 0.012), "right_ear": (-0.074, 0.066, 0.012),
}  # fmt: skip


def write_keypoints(path, local, root, fps):
    """npz: keypoints (T, K, 3) float32 metres, names (K,), fps."""
    rotation, position = forward_kinematics(local, root)
    names = [name for name, _ in KEYPOINTS] + list(FACE_POINTS)
    points = [position[joint] for _, joint in KEYPOINTS]
    points += [position["Head"] + rotate(rotation["Head"], np.array(at)) for at in FACE_POINTS.values()]
    keypoints = np.stack(points, 1).round(5).astype(np.float32)
    np.savez_compressed(path, keypoints=keypoints, names=np.array(names), fps=np.float64(fps))
