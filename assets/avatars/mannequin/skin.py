"""Which joints move which vertex.

Every joint splits the vertices of its parent: 0 stays with the parent, 1 goes to the joint and what hangs on it.
A vertex's weight for a joint is the product of the splits on the way to it, less what its children take.
"""

import numpy as np
from scipy.sparse import coo_matrix, diags
from scipy.sparse.linalg import spsolve

from . import skeleton
from .shapes import unit


def ramp(x, low, high):
    """0 below `low`, 1 above `high`, smooth between."""
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def segment_distance(points, a, b):
    """Distance (N,) of `points` to the segment a-b."""
    along = np.clip((points - a) @ (b - a) / np.dot(b - a, b - a), 0, 1)
    return np.linalg.norm(points - a - along[:, None] * (b - a), axis=1)


def chain_distance(points, joints):
    return np.min([segment_distance(points, a, b) for a, b in zip(joints, joints[1:])], axis=0)


def bend(points, before, joint, after):
    """Signed distance [m] of `points` to the plane that halves the angle at `joint`."""
    return (points - joint) @ unit(unit(joint - before) + unit(after - joint))


def spread(vertices, faces, ones, zeros):
    """Harmonic function (V,) on the mesh that is 1 on `ones` and 0 on `zeros` (boolean (V,))."""
    rows, cols, values = [], [], []
    for i in range(3):
        a, b, c = (faces[:, (i + k) % 3] for k in range(3))
        u, v = vertices[b] - vertices[a], vertices[c] - vertices[a]
        cotangent = (u * v).sum(axis=1) / np.linalg.norm(np.cross(u, v), axis=1)
        weight = np.clip(cotangent, 0.01, 10)
        rows += [b, c]
        cols += [c, b]
        values += [weight, weight]
    count = len(vertices)
    weights = coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(cols))), (count, count)).tocsr()
    laplacian = (diags(np.asarray(weights.sum(axis=1)).ravel()) - weights).tocsr()
    free = ~(ones | zeros)
    result = ones.astype(float)
    result[free] = spsolve(laplacian[free][:, free].tocsc(), -laplacian[free][:, ones] @ result[ones])
    return result


def trunk_splits(points):
    x, y, z = points.T
    arm = (x > 0.20) & (y > 0.70)
    neck_height = (points - skeleton.CENTRE_JOINTS["neck"]) @ unit([0, 1, 0.23])
    head_height = (points - skeleton.CENTRE_JOINTS["head"]) @ unit([0, 0.878, 0.479])
    return {
        "spine": np.where(arm, 1, ramp(y, 0.950, 1.105)),
        "chest": np.where(arm, 1, ramp(y, 1.055, 1.225)),
        "upper_chest": np.where(arm, 1, ramp(y, 1.155, 1.300)),
        "neck": ramp(neck_height, -0.030, 0.055) * (1 - ramp(x, 0.060, 0.115)),
        "head": ramp(head_height, -0.042, 0.014),
    }


def leg_splits(points):
    x, y, z = points.T
    joints = skeleton.left_joints()
    groin = (points - joints["upper_leg"]) @ unit([0.42, -0.90, 0.0])
    below_arm = (x < 0.215) | (y < 0.70)
    ankle = joints["foot"][1] - y + 0.35 * (z - joints["foot"][2])
    return {
        "upper_leg": np.where(below_arm, ramp(groin, -0.075, 0.080), 0) * (0.5 + 0.5 * ramp(x, -0.02, 0.02)),
        "lower_leg": ramp(joints["lower_leg"][1] - y, -0.055, 0.055),
        "foot": ramp(ankle, -0.035, 0.030),
        "toes": ramp(skeleton.FOOT.local(points)[0], 0.108, 0.148),
    }


def arm_splits(points, faces):
    x, y, _ = points.T
    joints = skeleton.left_joints()
    along = skeleton.UPPER_ARM.local(points)[0]
    far = (along > 0.085) & (x > 0.2) & (y > 0.70)
    wall = (x < 0.2) & (y < 1.268)
    near = wall | (x < 0.115)
    # The tip of the elbow belongs to the forearm's bone, so behind the joint the forearm starts higher.
    elbow = bend(points, joints["upper_arm"], joints["lower_arm"], joints["hand"])
    behind = np.clip(-skeleton.FOREARM.local(points)[2] / 0.035, 0, 1)
    wrist = skeleton.FOREARM.local(points)[0]
    return {
        "shoulder": ramp(
            spread(points, faces, far | ((along > 0.0) & (x > 0.15) & (y > 1.33)), (x < 0.025) | wall), 0, 1
        ),
        "upper_arm": ramp(spread(points, faces, far, near), 0.05, 0.97),
        "lower_arm": ramp(elbow + 0.016 * behind, -0.040 + 0.012 * behind, 0.040 - 0.012 * behind),
        # The last two fifths of the forearm follow the hand a little, so that a turned wrist twists it evenly.
        "hand": 0.34 * ramp(wrist, 0.150, 0.240) + 0.66 * ramp(wrist, 0.226, 0.270),
    }


def finger_splits(points):
    palm = skeleton.HAND.local(points)[0]
    chains = {spec.name: [*spec.joints(), spec.frame.point(spec.lengths.sum())] for spec in skeleton.FINGERS}
    reach = {name: chain_distance(points, chain) for name, chain in chains.items()}
    nearest = np.min(list(reach.values()), axis=0)
    bones = np.min([segment_distance(points, skeleton.HAND.origin, chain[0]) for chain in chains.values()], axis=0)
    thumb = skeleton.THUMB_POINTS
    splits = {
        "thumb_1": ramp(np.minimum(bones, nearest) - chain_distance(points, thumb), -0.014, 0.010)
        * ramp((points - thumb[0]) @ unit(thumb[1] - thumb[0]), -0.010, 0.030)
        * (palm > -0.01),
        "thumb_2": ramp(bend(points, *thumb[:3]), -0.010, 0.009),
        "thumb_3": ramp(bend(points, *thumb[1:4]), -0.008, 0.007),
    }
    for name, chain in chains.items():
        mine = (reach[name] <= nearest) & (reach[name] < chain_distance(points, thumb)) & (palm > 0.05)
        splits[f"{name}_1"] = ramp((points - chain[0]) @ unit(chain[1] - chain[0]), -0.013, 0.011) * mine
        splits[f"{name}_2"] = ramp(bend(points, *chain[:3]), -0.0075, 0.0065)
        splits[f"{name}_3"] = ramp(bend(points, *chain[1:4]), -0.0065, 0.0055)
    return splits


def joint_parents():
    """Joint name -> parent name (None for the root), parents first, left limbs before right ones."""
    parents = dict(skeleton.CENTRE_PARENTS)
    for side in ("left", "right"):
        for name, parent in skeleton.LIMB_PARENTS.items():
            parents[f"{side}_{name}"] = parent if parent in skeleton.CENTRE_PARENTS else f"{side}_{parent}"
        for finger in ("thumb", *(spec.name for spec in skeleton.FINGERS)):
            for number in (1, 2, 3):
                parents[f"{side}_{finger}_{number}"] = (
                    f"{side}_hand" if number == 1 else f"{side}_{finger}_{number - 1}"
                )
    return parents


def joint_points():
    """Joint name -> point (3,)."""
    points = dict(skeleton.CENTRE_JOINTS)
    for name, point in skeleton.left_joints().items():
        points[f"left_{name}"] = point
        points[f"right_{name}"] = point * [-1, 1, 1]
    return points


def weigh(points, faces):
    """Weights (V, J) of the left half, in the order of joint_parents()."""
    parents = joint_parents()
    left = {**leg_splits(points), **arm_splits(points, faces), **finger_splits(points)}
    splits = {**trunk_splits(points), **{f"left_{name}": split for name, split in left.items()}}
    # At x = 0 both legs pull alike; their shares are each other's mirror image.
    share = 0.5 + 0.5 * ramp(points[:, 0], -0.02, 0.02)
    splits["right_upper_leg"] = splits["left_upper_leg"] / share * (1 - share)
    return soften(shares(parents, splits, len(points)), faces)


def shares(parents, splits, count):
    """Weights (V, J) from the splits: what a joint and all that hangs on it hold, less what its children hold."""
    names = list(parents)
    held = {names[0]: np.ones(count)}
    weights = np.zeros((count, len(names)))
    for number, name in enumerate(names):
        children = [other for other in names if parents[other] == name]
        wanted = {child: held[name] * splits.get(child, 0) for child in children}
        total = sum(wanted.values(), np.zeros(count))
        # Children that together ask for more than there is share it in proportion.
        scale = np.where(total > held[name], held[name] / np.maximum(total, 1e-12), 1)
        held.update({child: value * scale for child, value in wanted.items()})
        weights[:, number] = held[name] - total * scale
    return np.maximum(weights, 0)


def soften(weights, faces):
    """Evens the weights out along the surface: a few rounds of averaging with the neighbours."""
    ends = np.concatenate([faces, faces[:, ::-1]])
    pairs = np.concatenate([ends[:, [0, 1]], ends[:, [1, 2]], ends[:, [2, 0]]])
    links = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), (len(weights), len(weights))).tocsr()
    links.data[:] = 1
    mean = diags(1 / np.asarray(links.sum(axis=1)).ravel()) @ links
    for _ in range(4):
        weights = 0.5 * weights + 0.5 * (mean @ weights)
    return weights


def four_largest(weights):
    """The four largest weights of each vertex: joints (V, 4) u8 and weights (V, 4) u16 that sum to 65535."""
    joints = np.argsort(-weights, axis=1, kind="stable")[:, :4]
    values = np.take_along_axis(weights, joints, axis=1)
    values[values < 0.004] = 0
    values = values / values.sum(axis=1, keepdims=True)
    whole = np.round(values * 65535).astype(np.int64)
    whole[:, 0] += 65535 - whole.sum(axis=1)
    return np.where(whole > 0, joints, 0).astype(np.uint8), whole.astype(np.uint16)
