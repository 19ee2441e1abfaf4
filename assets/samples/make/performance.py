"""A gesture score -> the motion of the whole body.

A score is a list of moves. Each move takes some channels from where they are to new values with
the bell-shaped speed of minimum jerk; moves of one hand overlap, and the sum of overlapping moves
gives the rounded, asymmetric paths of a human hand. On top lie layers that no score would write
down: the settling after a stroke, the wrist and the fingers that follow late, breathing, sway,
clavicles and spine that go with the hands.

Places are metres seen from the body: x outward to the hand's own side, y up from the floor, z
forward. Angles in scores are degrees, inside radians.
"""

from dataclasses import dataclass, field

import numpy as np

import body

HAND_CHANNELS = ("x", "y", "z", "swivel", "turn", "flex", "dev")
SHAPE_CHANNELS = (
    "index_base", "middle_base", "ring_base", "pinky_base",
    "index_mid", "middle_mid", "ring_mid", "pinky_mid",
    "spread", "thumb_in", "thumb_base", "thumb_mid",
)  # fmt: skip
BODY_CHANNELS = (
    "hips_x", "hips_z", "hips_yaw", "hips_roll", "spine_pitch", "spine_yaw", "spine_roll",
    "head_pitch", "head_yaw", "head_roll", "shrug",
)  # fmt: skip

# Flexion of the base joints (index to pinky) and of the middle joints, spread; thumb across, base, tip [degrees].
SHAPES = {
    "rest": (16, 22, 27, 31, 26, 31, 34, 36, 3, 12, 12, 16),
    "loose": (12, 17, 22, 27, 18, 22, 26, 28, 5, 6, 8, 12),
    "offer": (4, 9, 15, 20, 9, 12, 15, 18, 7, -4, 2, 4),
    "open": (-3, 0, 2, 4, 6, 7, 8, 9, 12, -12, 0, 2),
    "flat": (5, 6, 7, 8, 5, 5, 6, 8, 2, 4, 4, 6),
    "hold": (24, 27, 30, 32, 22, 24, 26, 28, 7, 22, 4, 10),
    "pinch": (42, 40, 34, 28, 34, 36, 38, 36, 4, 34, 14, 22),
    "one": (0, 62, 68, 72, 4, 82, 86, 84, 0, 30, 30, 42),
    "two": (-2, 0, 66, 70, 4, 5, 86, 84, 13, 34, 32, 44),
    "cup": (20, 18, 18, 20, 16, 16, 16, 18, 1, 6, 6, 10),
    "curl": (38, 44, 50, 54, 48, 54, 58, 58, 2, 20, 20, 28),
}

# Palm directions seen from the body: (outward to the own side, up, forward).
PALMS = {
    "up": (0, 1, 0), "down": (0, -1, 0), "in": (-1, 0, 0), "front": (0, 0, 1), "back": (0, 0, -1),
    "in_up": (-0.6, 0.8, 0), "in_down": (-0.75, -0.65, 0), "up_front": (0, 0.7, 0.7),
    "in_back": (-0.8, 0, -0.6), "belly": (-0.75, -0.2, -0.63), "front_down": (0, -0.5, 0.85), "in_front": (-0.6, 0, 0.8),
    "up_back": (-0.2, 0.85, -0.5), "in_up_back": (-0.55, 0.5, -0.67),
}  # fmt: skip

REST = {
    "sides": dict(at=(0.232, 0.893, 0.045), palm="in_back", swivel=14, flex=4, dev=0, shape="rest"),
    "waist": dict(at=(0.158, 1.090, 0.225), palm="belly", swivel=16, flex=8, dev=2, shape="rest"),
}

LAG = {"turn": 0.03, "flex": 0.045, "dev": 0.045}  # behind the wrist's way [s]
SHAPE_LAG = 0.05
FLEX_RANGE, DEV_RANGE = (-65, 65), (-28, 20)  # of the wrist [degrees]
HIPS_DROP = 0.013  # knees are not locked [m]


@dataclass
class Move:
    """Arrive at `end` [s] after `duration` [s]; what is not given stays as it is."""

    end: float
    duration: float
    at: tuple = None
    palm: str = None
    shape: str = None
    swivel: float = None
    flex: float = None
    dev: float = None
    arc: tuple = (0.0, 0.0, 0.0)  # how far the path bows, at its middle
    settle: float = 0.0  # share of the way that swings on after arrival


@dataclass
class Shift:
    """The same for the trunk and the head; metres and degrees."""

    end: float
    duration: float
    values: dict = field(default_factory=dict)


@dataclass
class Score:
    start: str
    right: list
    left: list
    trunk: list
    nods: list  # (time [s], depth [degrees])
    liveliness: float = 1.0
    follow: float = 1.0  # how much the trunk goes with the hands


def ease(t, start, end):
    """0 before `start`, 1 after `end`, minimum jerk between."""
    s = np.clip((t - start) / (end - start), 0, 1)
    return s**3 * (10 - 15 * s + 6 * s * s)


def drift(generator, t, low, high, count=9):
    """Band-limited wandering of unit variance: sines of random phase between low and high [Hz]."""
    rates = low * (high / low) ** ((np.arange(count) + generator.random(count)) / count)
    weights = 1 / np.sqrt(rates)
    phases = 2 * np.pi * generator.random(count)
    wave = (weights[:, None] * np.sin(2 * np.pi * rates[:, None] * t + phases[:, None])).sum(0)
    return wave * np.sqrt(2) / np.sqrt((weights**2).sum())


def smooth(signal, sigma, fps):
    """Gaussian mean over time, ends held. signal (T,) or (T, C), sigma [s]."""
    reach = int(np.ceil(4 * sigma * fps))
    kernel = np.exp(-0.5 * (np.arange(-reach, reach + 1) / (sigma * fps)) ** 2)
    kernel /= kernel.sum()
    columns = signal.reshape(len(signal), -1)
    padded = np.pad(columns, ((reach, reach), (0, 0)), mode="edge")
    out = np.stack([np.convolve(column, kernel, "valid") for column in padded.T], -1)
    return out.reshape(signal.shape)


def follow_late(signal, rate, damping, fps):
    """A mass on a spring that is pulled along: lags, and swings a little past. rate [Hz]."""
    steps, omega = 8, 2 * np.pi * rate
    dt = 1 / (fps * steps)
    place, speed = signal[0].copy(), np.zeros_like(signal[0])
    out = np.empty_like(signal)
    for k, goal in enumerate(signal):
        for _ in range(steps):
            speed = speed + dt * (omega**2 * (goal - place) - 2 * damping * omega * speed)
            place = place + dt * speed
        out[k] = place
    return out


def _settle(t, end):
    """The way a hand swings on after a stroke and comes back; peak about 0.5."""
    s = np.clip(t - end + 0.03, 0, None)
    return (1 - np.exp(-s / 0.045)) * np.exp(-s / 0.13) * np.sin(2 * np.pi * 2.1 * s) * 1.6


def _palm_turn(sign, at, swivel, palm):
    """Forearm turn (0 thumb up, + palm up) that brings the palm nearest to a direction [rad]."""
    place = np.array([[sign * at[0], at[1], at[2]]])
    shoulder = body.rest_position("LeftArm" if sign > 0 else "RightArm")[None]
    bend = body.solve_arm(sign, shoulder, place, np.array([swivel]))
    fore = bend.upper @ body.turn("y", -sign * bend.flexion)
    wish = np.array(PALMS[palm], float) * (sign, 1, 1)
    down = np.array([0.0, -1.0, 0.0])
    zero, quarter = (body.rotate(fore @ body.turn("x", -a), down)[0] for a in (0, np.pi / 2))
    angle = np.arctan2(wish @ quarter, wish @ zero)
    if angle < np.radians(-140):
        angle += 2 * np.pi
    return float(np.clip(angle, np.radians(-82), np.radians(86)))


def _default_swivel(at):
    """Elbow out the more, the wider and the higher the hand is [degrees]."""
    x, y, _ = at
    return 15 + 15 * np.clip((x - 0.12) / 0.30, 0, 1) + 14 * np.clip((y - 1.15) / 0.30, 0, 1)


def hand_track(sign, start, moves, t):
    """All channels of one hand over time: dict of (T,)."""
    state = {}
    first = Move(end=0, duration=1, **REST[start])
    _apply(state, first, sign)
    names = HAND_CHANNELS + SHAPE_CHANNELS
    track = {name: np.full(len(t), float(state[name])) for name in names}
    for move in sorted(moves, key=lambda m: m.end):
        before = dict(state)
        _apply(state, move, sign)
        for name in names:
            lag = LAG.get(name, SHAPE_LAG if name in SHAPE_CHANNELS else 0.0)
            step = state[name] - before[name]
            way = ease(t, move.end - move.duration + lag, move.end + lag)
            swing = move.settle * _settle(t, move.end) if name in "xyz" else 0
            track[name] += step * (way + swing)
        bow = ease(t, move.end - move.duration, move.end)
        for name, size in zip("xyz", move.arc):
            track[name] += size * 4 * bow * (1 - bow)
    return track


def _apply(state, move, sign):
    if move.at is not None:
        state.update(zip("xyz", move.at))
        state["swivel"] = np.radians(_default_swivel(move.at))
    if move.swivel is not None:
        state["swivel"] = np.radians(move.swivel)
    for name in ("flex", "dev"):
        if getattr(move, name) is not None:
            state[name] = np.radians(getattr(move, name))
    if move.palm is not None:
        state["palm"] = move.palm
    if move.at is not None or move.palm is not None or move.swivel is not None:
        state["turn"] = _palm_turn(sign, [state[c] for c in "xyz"], state["swivel"], state["palm"])
    if move.shape is not None:
        state.update(zip(SHAPE_CHANNELS, np.radians(SHAPES[move.shape])))


def trunk_track(score, hands, t, fps, generator):
    """Channels of hips, spine and head: the score, what follows the hands, and life."""
    track = {name: np.zeros(len(t)) for name in BODY_CHANNELS}
    state = dict.fromkeys(BODY_CHANNELS, 0.0)
    for shift in sorted(score.trunk, key=lambda s: s.end):
        way = ease(t, shift.end - shift.duration, shift.end)
        for name, value in shift.values.items():
            goal = value if name.startswith("hips_") and name[-1] in "xz" else np.radians(value)
            track[name] += (goal - state[name]) * way
            state[name] = goal
    _follow_hands(track, score, hands, fps)
    for time, depth in score.nods:
        bump = ease(t, time - 0.20, time + 0.04) - ease(t, time + 0.06, time + 0.52)
        track["head_pitch"] += np.radians(depth) * bump
        track["spine_pitch"] += np.radians(0.22 * depth) * bump
    _live(track, score.liveliness, t, generator)
    return track


def _follow_hands(track, score, hands, fps):
    left, right = hands
    side = smooth((left["x"] - right["x"]) / 2, 0.14, fps)
    height = smooth((left["y"] + right["y"]) / 2, 0.16, fps)
    uneven = smooth(left["y"] - right["y"], 0.18, fps)
    reach = smooth((left["z"] - right["z"]) / 2, 0.14, fps)
    share = score.follow
    track["spine_yaw"] += share * (0.32 * side - 0.55 * reach)
    track["spine_roll"] += share * (-0.10 * side + 0.10 * uneven)
    track["spine_pitch"] += share * -0.10 * (height - height[0])
    track["hips_x"] += share * 0.05 * smooth(side, 0.2, fps)
    track["hips_yaw"] += share * 0.08 * smooth(side, 0.2, fps)
    track["head_yaw"] += share * 0.22 * smooth(side, 0.1, fps)


def _live(track, amount, t, generator):
    """Breath, sway and a head that is never quite still."""
    track["hips_x"] += 0.0045 * amount * drift(generator, t, 0.12, 0.45)
    track["hips_z"] += 0.0035 * amount * drift(generator, t, 0.15, 0.5)
    track["hips_yaw"] += np.radians(0.5) * amount * drift(generator, t, 0.1, 0.4)
    track["spine_pitch"] += np.radians(0.6) * amount * drift(generator, t, 0.15, 0.7)
    track["spine_roll"] += np.radians(0.5) * amount * drift(generator, t, 0.15, 0.6)
    for name, size in (("head_pitch", 1.3), ("head_yaw", 1.6), ("head_roll", 1.0)):
        slow, quick = drift(generator, t, 0.2, 0.9), drift(generator, t, 1.2, 2.6)
        track[name] += np.radians(size) * amount * (slow + 0.16 * quick)
    breath = np.sin(2 * np.pi * (0.27 * t + generator.random()))
    track["spine_pitch"] -= np.radians(0.45) * breath
    track["shrug"] += np.radians(0.9) * breath


def perform(score, count, fps, seed):
    """Local joint rotations (T, 3, 3) by name and root positions (T, 3) of a score."""
    generator = np.random.Generator(np.random.PCG64(seed))
    t = np.arange(count) / fps
    hands = [hand_track(1, score.start, score.left, t), hand_track(-1, score.start, score.right, t)]
    for hand in hands:
        _tremble(hand, score.liveliness, t, generator)
    trunk = trunk_track(score, hands, t, fps, generator)
    local, root = _pose_trunk(trunk)
    for sign, name, hand in ((1, "Left", hands[0]), (-1, "Right", hands[1])):
        _pose_clavicle(local, sign, name, hand, trunk["shrug"], fps)
        _pose_arm(local, root, sign, name, hand, fps)
        _pose_fingers(local, sign, name, hand)
        _pose_leg(local, root, sign, name)
    return local, root


def _tremble(hand, amount, t, generator):
    """A held hand floats by some millimetres, its wrist and fingers by some degrees."""
    for name in "xyz":
        hand[name] += 0.0040 * amount * drift(generator, t, 0.25, 1.3)
    for name in ("turn", "flex", "dev", "swivel"):
        hand[name] += np.radians(1.6) * amount * drift(generator, t, 0.25, 1.2)
    common = drift(generator, t, 0.2, 1.0)
    for name in SHAPE_CHANNELS[:8]:
        hand[name] += np.radians(1.8) * amount * (common + 0.5 * drift(generator, t, 0.3, 1.4))


def _pose_trunk(trunk):
    """Hips to head; the spine shares its turn over three joints, the head keeps its gaze."""
    drop = np.full_like(trunk["hips_x"], -HIPS_DROP)
    root = body.OFFSET["Hips"] + np.stack([trunk["hips_x"], drop, trunk["hips_z"]], -1)
    local = {"Hips": body.turn("y", trunk["hips_yaw"]) @ body.turn("z", trunk["hips_roll"])}
    for joint, share in (("Spine", 0.28), ("Spine1", 0.34), ("Spine2", 0.38)):
        local[joint] = (
            body.turn("y", share * trunk["spine_yaw"])
            @ body.turn("z", share * trunk["spine_roll"])
            @ body.turn("x", share * trunk["spine_pitch"])
        )
    yaw = trunk["head_yaw"] - 0.85 * (trunk["hips_yaw"] + trunk["spine_yaw"])
    roll = trunk["head_roll"] - 0.7 * (trunk["hips_roll"] + trunk["spine_roll"])
    pitch = trunk["head_pitch"] - 0.75 * trunk["spine_pitch"]
    for joint, share in (("Neck", 0.4), ("Head", 0.6)):
        sideways = body.turn("y", share * yaw) @ body.turn("z", share * roll)
        local[joint] = sideways @ body.turn("x", share * pitch)
    return local, root


def _pose_clavicle(local, sign, name, hand, shrug, fps):
    """The shoulder rises and comes forward with the hand, a moment later."""
    height = 0.06 * np.logaddexp(0, (hand["y"] - 1.20) / 0.06)
    wide = np.clip(hand["x"] - 0.2, 0, None)
    rise = smooth(0.75 * height + 0.25 * wide, 0.07, fps) + shrug
    forward = smooth(0.42 * (hand["z"] - 0.22) - 0.30 * wide, 0.07, fps)
    local[name + "Shoulder"] = body.turn("y", -sign * forward) @ body.turn("z", sign * rise)


def _pose_arm(local, root, sign, name, hand, fps):
    rotation, position = body.forward_kinematics(local, root)
    shoulder, chest = position[name + "Arm"], rotation[name + "Shoulder"]
    moved = shoulder - body.rest_position(name + "Arm")
    wrist = np.stack([sign * hand["x"], hand["y"], hand["z"]], -1) + 0.6 * moved
    bend = body.solve_arm(sign, shoulder, wrist, hand["swivel"])
    fore = bend.upper @ body.turn("y", -sign * bend.flexion)
    flex, dev = _drag(sign, hand, wrist, fore, fps)
    local[name + "Arm"] = np.swapaxes(chest, -1, -2) @ bend.upper
    local[name + "ForeArm"] = body.turn("y", -sign * bend.flexion) @ body.turn("x", -0.6 * hand["turn"])
    bent = body.turn("y", -sign * dev) @ body.turn("z", -sign * flex)
    local[name + "Hand"] = body.turn("x", -0.4 * hand["turn"]) @ bent


def _drag(sign, hand, wrist, fore, fps):
    """Wrist flexion and deviation: as scored, plus the hand hanging behind the moving forearm."""
    palm = fore @ body.turn("x", -hand["turn"])
    speed = np.gradient(wrist, 1 / fps, axis=0)
    along_palm = np.sum(speed * body.rotate(palm, np.array([0.0, -1.0, 0.0])), -1)
    along_thumb = np.sum(speed * body.rotate(palm, np.array([0.0, 0.0, 1.0])), -1)
    late = follow_late(np.stack([along_palm, along_thumb], -1), 3.6, 0.55, fps)
    flex = hand["flex"] - 0.42 * np.tanh(0.42 * late[:, 0])
    dev = hand["dev"] - 0.26 * np.tanh(0.34 * late[:, 1])
    return np.clip(flex, *np.radians(FLEX_RANGE)), np.clip(dev, *np.radians(DEV_RANGE))


def _pose_fingers(local, sign, name, hand):
    fan = {"index": 1.0, "middle": 0.15, "ring": -0.65, "pinky": -1.4}
    for finger, share in fan.items():
        base, mid = hand[finger + "_base"], hand[finger + "_mid"]
        joint = f"{name}Hand{finger.title()}"
        local[joint + "1"] = body.turn("y", -sign * share * hand["spread"]) @ body.turn("z", -sign * base)
        local[joint + "2"] = body.turn("z", -sign * mid)
        local[joint + "3"] = body.turn("z", -sign * 0.6 * mid)
    _pose_thumb(local, sign, name, hand)


def _pose_thumb(local, sign, name, hand):
    """Across: the base joint swings under the palm; base, mid: the thumb bends towards the fingers."""
    joint = name + "HandThumb"
    along = body.unit(body.OFFSET[joint + "2"])
    across = body.unit(np.cross(along, np.array([0.0, -1.0, 0.0])))
    inward = body.unit(np.cross(along, np.array([0.0, -0.35, -0.94])))
    local[joint + "1"] = body.turn(across, hand["thumb_in"]) @ body.turn(inward, 0.5 * hand["thumb_base"])
    local[joint + "2"] = body.turn(inward, hand["thumb_base"])
    local[joint + "3"] = body.turn(inward, hand["thumb_mid"])


def _pose_leg(local, root, sign, name):
    """Feet stay planted, a little turned out; the knees give way."""
    rotation, position = body.forward_kinematics(local, root)
    outward = np.radians(9) * sign
    ankle = body.rest_position(name + "Foot") + np.array([sign * 0.018, 0, -0.005 * sign])
    hip = position[name + "UpLeg"]
    knee_forward = np.array([np.sin(outward), 0, np.cos(outward)])
    upper, flexion = body.solve_leg(hip, np.broadcast_to(ankle, hip.shape), knee_forward)
    lower = upper @ body.turn("x", flexion)
    hips = rotation["Hips"]
    local[name + "UpLeg"] = np.swapaxes(hips, -1, -2) @ upper
    local[name + "Leg"] = body.turn("x", flexion)
    local[name + "Foot"] = np.swapaxes(lower, -1, -2) @ body.turn("y", outward)
