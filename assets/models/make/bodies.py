"""Makes up people who move: trunks that turn and lean, heads that look about, arms that gesture, swing, rest and reach.

Nobody was recorded for them. Lengths in metres, x to the left of a person who faces the camera, y up, z towards the camera,
turns in radians, 30 frames a second. A body is (T, 13, 3), its points in the order of POINTS.
"""

import numpy as np

FPS = 30
FRAMES = 240
POINTS = ["nose", "left_eye", "right_eye", "left_ear", "right_ear", "left_shoulder", "right_shoulder", "left_elbow",
          "right_elbow", "left_wrist", "right_wrist", "left_hip", "right_hip"]
MIRRORED = [0, 2, 1, 4, 3, 6, 5, 8, 7, 10, 9, 12, 11]
UPPER_ARM, FOREARM, SHOULDERS, TRUNK, HIPS = 0.285, 0.255, 0.36, 0.50, 0.20

# An arm's posture is five numbers: the upper arm's direction (x outward), the flexion, and the rotation inward of the upper arm
# about itself, which is 0 where a hanging arm's forearm comes forward.
# Ways to hold an arm: direction (mean, spread of each axis), flexion (mean, spread, degrees), rotation (mean, spread, degrees).
WAYS = [
    (([0.16, -1, -0.06], [0.12, 0, 0.20]), (16, 14), (5, 30)),  # hangs
    (([0.30, -1, 0.03], [0.25, 0, 0.38]), (82, 35), (10, 35)),  # elbow beside the trunk, forearm up
    (([0.15, -0.2, 1.0], [0.35, 0.45, 0]), (15, 30), (10, 40)),  # forward
    (([1.0, -0.1, 0.10], [0, 0.40, 0.30]), (20, 35), (-10, 45)),  # sideways
    (([0.40, 1.0, 0.12], [0.35, 0, 0.30]), (25, 35), (0, 45)),  # up
    (([0.30, -1, -0.45], [0.28, 0, 0.22]), (65, 45), (10, 40)),  # back
]
# Which of them a person likes.
MANNERS = [[0.72, 0.17, 0.04, 0.03, 0.02, 0.02], [0.12, 0.66, 0.10, 0.07, 0.03, 0.02], [0.08, 0.25, 0.50, 0.10, 0.05, 0.02],
           [0.25, 0.10, 0.08, 0.38, 0.17, 0.02], [0.18, 0.18, 0.18, 0.18, 0.18, 0.10], [0.30, 0.05, 0.05, 0.10, 0.50, 0],
           [0.02, 0.03, 0.05, 0.85, 0.05, 0],
           [0.25, 0.25, 0.03, 0.02, 0.02, 0.43]]
# Places of a wrist against its shoulder (mean, spread) and how often they are the aim.
PLACES = [
    ([-0.05, -0.30, 0.28], [0.14, 0.13, 0.10], 0.42),  # gesture space
    ([-0.18, -0.05, 0.20], [0.05, 0.12, 0.08], 0.13),  # at face or chest
    ([0.00, -0.42, 0.05], [0.04, 0.04, 0.05], 0.06),  # on the hip
    ([-0.16, -0.42, 0.16], [0.03, 0.08, 0.05], 0.12),  # folded before the belly
    ([-0.25, -0.22, 0.14], [0.06, 0.06, 0.04], 0.07),  # arms crossed
    ([0.10, -0.05, 0.15], [0.32, 0.32, 0.32], 0.20),  # anywhere
]
ON_THE_HIP = 2


def unit(v):
    return v / np.maximum(1e-9, np.linalg.norm(v, axis=-1, keepdims=True))


def turned(v, yaw):
    c, s = np.cos(yaw), np.sin(yaw)
    return np.stack([v[..., 0] * c + v[..., 2] * s, v[..., 1], v[..., 2] * c - v[..., 0] * s], -1)


def leant(v, pitch):
    c, s = np.cos(pitch), np.sin(pitch)
    return np.stack([v[..., 0], v[..., 1] * c - v[..., 2] * s, v[..., 2] * c + v[..., 1] * s], -1)


def rolled(v, roll):
    c, s = np.cos(roll), np.sin(roll)
    return np.stack([v[..., 0] * c - v[..., 1] * s, v[..., 1] * c + v[..., 0] * s, v[..., 2]], -1)


def wander(random, spread, period):
    """(FRAMES) a smooth course about 0 with a new aim every `period` seconds."""
    aims = random.normal(0, spread, int(FRAMES / (period * FPS)) + 3)
    at = np.arange(FRAMES) / (period * FPS) + random.random()
    first = np.minimum(at.astype(int), len(aims) - 2)
    share = at - at.astype(int)
    share = share * share * (3 - 2 * share)
    return aims[first] * (1 - share) + aims[first + 1] * share


def degrees(random, middle, spread, wanders, period):
    """(FRAMES) a course about an angle of the clip's own."""
    return np.radians(random.normal(middle, spread) + wander(random, wanders, period))


def forward_of(upper):
    """Where the forearm of an arm that points along `upper` bends to at rotation 0: forward, carried along the shortest arc."""
    down, forward = np.array([0, -1.0, 0]), np.array([0, 0, 1.0])
    axis = np.cross(down, upper)
    carried = forward + np.cross(axis, forward) + np.cross(axis, np.cross(axis, forward)) / np.maximum(
        0.05, 1 + upper @ down)[..., None]
    return unit(carried - upper * (carried * upper).sum(-1, keepdims=True))


def held(random, manner):
    """A posture of one of the ways that this manner likes."""
    (aim, spread), flexion, rotation = WAYS[random.choice(len(WAYS), p=MANNERS[manner])]
    upper = np.array(aim) + random.normal(0, 1, 3) * spread
    return np.concatenate([unit(upper), [np.radians(min(150, abs(random.normal(*flexion)))),
                                         np.radians(np.clip(random.normal(*rotation), -85, 95))]])


def reaching(random, place, bones, hangs):
    """A posture with the wrist near a place; the elbow hangs to where `hangs` points, more or less."""
    upper_arm, forearm, shoulders = bones
    while True:
        wrist = np.array(PLACES[place][0]) + random.normal(0, 1, 3) * PLACES[place][1]
        reach = np.linalg.norm(wrist)
        in_trunk = abs(wrist[0] + shoulders / 2) < 0.4 * shoulders and -0.5 < wrist[1] < 0.03 and wrist[2] < 0.28 * shoulders
        if max(0.12, abs(upper_arm - forearm) + 0.05) < reach < 0.98 * (upper_arm + forearm) and not in_trunk:
            break
    along = wrist / reach
    ahead = (upper_arm**2 - forearm**2 + reach**2) / (2 * reach)
    hangs = unit(hangs - along * (hangs @ along))
    side = np.cross(along, hangs)
    swivel = np.radians(random.normal(0, 25))
    if place == ON_THE_HIP:
        swivel = np.radians(random.normal(60, 20)) * np.sign(side[0])
    elbow = along * ahead + np.sqrt(max(0, upper_arm**2 - ahead**2)) * (hangs * np.cos(swivel) + side * np.sin(swivel))
    upper, lower = unit(elbow), unit(wrist - elbow)
    forward = forward_of(upper)
    return np.concatenate([upper, [np.arccos(np.clip(upper @ lower, -1, 1)),
                                   np.arctan2(lower @ np.cross(upper, forward), lower @ forward)]])


def course(random, posture, shortest, longest, hold):
    """(FRAMES, 5) from posture to posture at minimal jerk, with rests between; strokes last `shortest` to `longest` seconds."""
    postures = np.empty((FRAMES, 5))
    at, now = 0, posture()
    while at < FRAMES:
        following = posture()
        frames = max(3, int(random.uniform(shortest, longest) * FPS))
        share = np.linspace(0, 1, frames)[:, None]
        share = 10 * share**3 - 15 * share**4 + 6 * share**5
        stroke = (now * (1 - share) + following * share)[:FRAMES - at]
        postures[at:at + len(stroke)] = stroke
        at += len(stroke)
        rest = int(max(0, random.normal(hold, 0.6)) * FPS)
        postures[at:at + rest] = following
        at += rest
        now = following
    return postures


def arm_course(random, manner, bones):
    pace = random.choice([0.5, 1, 1, 2])
    place = random.choice(len(PLACES), p=[often for _, _, often in PLACES])
    hangs = np.array([max(0.05, random.normal(0.42, 0.22)), -1, random.normal(-0.32, 0.38)])

    def posture():
        chance = random.random()
        if chance < 0.2:
            return held(random, 0)
        return reaching(random, place if chance < 0.75 else 0, bones, hangs)

    if random.random() < 0.45:
        posture = lambda: held(random, manner)
    arm = course(random, posture, 0.2 * pace, 1.2 * pace, random.choice([0, 0.2, 0.8]))
    if random.random() < 0.3:  # waves, beats, claps, shakes
        phase = 2 * np.pi * random.uniform(0.5, 2.8) * np.arange(FRAMES) / FPS + random.uniform(0, 6)
        lasting = np.clip(wander(random, 1, 1), 0, 1)
        size = random.normal(0, 1, 5) * [0.12, 0.12, 0.12, 0.35, 0.30] * random.uniform(0.2, 1.5)
        arm = arm + (np.sin(phase) * lasting)[:, None] * size
    return arm


def alike(random, arm, how_much):
    """An arm that does the same as the other, but for the size of `how_much`."""
    return arm + np.stack([wander(random, spread * how_much, 0.8) for spread in (0.08, 0.08, 0.08, 0.12, 0.15)], -1)


def both_arms(random, bones):
    manner = random.integers(len(MANNERS))
    arm = arm_course(random, manner, bones)
    kind = random.random()
    if kind < 0.40:
        other = alike(random, arm, random.choice([0.2, 1, 2]))
    elif kind < 0.55:
        other = course(random, lambda: held(random, 0), 1, 3, 1)
    elif kind < 0.62:
        late = random.integers(3, 25)
        other = alike(random, arm, 1)
        other = np.concatenate([np.repeat(other[:1], late, 0), other])[:FRAMES]
    else:
        other = arm_course(random, manner if random.random() < 0.6 else random.integers(len(MANNERS)), bones)
    arms = [arm, other] if random.random() < 0.5 else [other, arm]
    if random.random() < 0.06:  # as figures are shown: arms held out at an angle, straight
        rise = np.radians(random.choice([0, 10, 45, 60, 80, random.uniform(-30, 80)]))
        ahead = random.choice([0, 0, random.uniform(0, 1)]) * np.pi / 2
        out = [np.cos(rise) * np.cos(ahead), -np.sin(rise), np.cos(rise) * np.sin(ahead)]
        still = np.tile([*out, abs(random.normal(0, 0.16)), random.normal(0, 0.5)], (FRAMES, 1))
        arms = [still, still.copy()]
    return arms


def walk(random, arms, twist, yaw, lean):
    """Arms that swing, and a trunk that goes along, of people who walk or run."""
    runs = random.random() < 0.4
    phase = 2 * np.pi * random.uniform(*((1.1, 1.7) if runs else (0.6, 1.1))) * np.arange(FRAMES) / FPS + random.uniform(0, 6)
    swing = random.uniform(0.08, 0.8)
    bent = np.radians(random.uniform(*((60, 100) if runs else (5, 30))))
    only_one = random.random() < 0.25
    for arm, side in zip(arms, (1, -1)):
        if only_one and side == 1:
            continue
        angle = swing * np.sin(phase) * side + random.normal(0, 0.1)
        outward = np.full(FRAMES, abs(random.normal(0.15, 0.08)))
        arm[:, :3] = np.stack([outward, -np.cos(angle), np.sin(angle)], -1)
        arm[:, 3] = bent + random.uniform(0.1, 0.8) * swing * np.maximum(-0.3, np.sin(phase) * side)
        arm[:, 4] = random.normal(0.2, 0.3)
    return (twist - random.uniform(0, 0.25) * swing * np.sin(phase), yaw + random.normal(0, 0.08) * swing * np.sin(phase),
            lean + 0.05 * swing * np.sin(2 * phase))


def bone_directions(arm):
    upper = unit(arm[:, :3])
    forward = forward_of(upper)
    bend = forward * np.cos(arm[:, 4:]) + np.cross(upper, forward) * np.sin(arm[:, 4:])
    flexion = np.clip(arm[:, 3:4], 0, 2.65)
    return upper, upper * np.cos(flexion) + bend * np.sin(flexion)


def head_course(random, shoulders_yaw):
    """The head goes along with the trunk, looks about, or keeps to where it looked."""
    away = degrees(random, 0, 7, random.choice([4, 10, 20, 35], p=[0.3, 0.3, 0.25, 0.15]), random.uniform(0.4, 3))
    keeps = random.choice([0, 0.5, 1], p=[0.5, 0.3, 0.2])
    if random.random() < 0.35:
        keeps, away = 0, degrees(random, 0, 2, random.choice([0.5, 2, 5]), random.uniform(0.4, 3))
    yaw = shoulders_yaw - keeps * (shoulders_yaw - shoulders_yaw.mean()) + away
    return yaw, degrees(random, 0, 12, random.choice([4, 12]), 1), degrees(random, 0, 4, 6, 1.2)


def made_up_body(random):
    """(FRAMES, 13, 3) one person for eight seconds, who faces the camera more or less."""
    width, trunk, hips, upper_arm, forearm = (
        usual * np.exp(random.normal(0, spread)) for usual, spread in ((SHOULDERS, 0.10), (TRUNK, 0.09), (HIPS, 0.25),
                                                                       (UPPER_ARM, 0.10), (FOREARM, 0.10)))
    yaw = degrees(random, 0, 6, random.choice([3, 8, 20, 35], p=[0.35, 0.30, 0.25, 0.10]), random.uniform(0.7, 4))
    kind = random.random()
    if kind < 0.10:  # turns round
        yaw = yaw + np.cumsum(wander(random, 1, 1.5)) * random.uniform(0.01, 0.06)
    elif kind < 0.16:
        yaw = yaw + random.uniform(-np.pi, np.pi)
    twist = degrees(random, 0, 5, random.choice([2, 8, 18]), random.uniform(0.3, 2))
    lean = degrees(random, 4, 7, random.choice([2, 6, 18]), random.uniform(0.5, 2))
    roll = degrees(random, 0, 2, random.choice([1, 4, 9]), random.uniform(0.5, 2))
    arms = both_arms(random, (upper_arm, forearm, width))
    if random.random() < 0.5:  # trunks go along with arms that reach forward or aside
        twist = twist + random.uniform(0, 0.45) * (arms[1][:, 2] - arms[0][:, 2])
        twist = twist + random.uniform(-0.1, 0.4) * (arms[0][:, 0] - arms[1][:, 0])
    if random.random() < 0.22:
        twist, yaw, lean = walk(random, arms, twist, yaw, lean)
    shoulders_yaw = yaw + twist

    body = np.zeros((FRAMES, 13, 3))
    thorax = turned(leant(rolled(np.tile([0, trunk, 0], (FRAMES, 1)), roll), lean), yaw)
    lean_of_arms = random.uniform(0.3, 1)
    for arm, left in zip(arms, (True, False)):
        outward = np.array([1 if left else -1, 1, 1])
        upper, lower = bone_directions(arm)
        stands = lambda v: turned(leant(rolled(v * outward, roll), lean * lean_of_arms), shoulders_yaw)
        raised = np.maximum(0, upper[:, 1])  # shoulders rise and come forward with their arms
        shoulder = thorax + stands(width * np.stack(
            [0.5 * (1 - 0.08 * raised + wander(random, 0.02, 0.8)),
             0.14 * raised * random.uniform(0.3, 1.5) + wander(random, 0.04, 0.8),
             0.14 * upper[:, 2] * random.uniform(0, 1.5) + wander(random, 0.05, 0.8)], -1))
        elbow = shoulder + upper_arm * stands(upper)
        side = 0 if left else 1
        body[:, 5 + side], body[:, 7 + side], body[:, 9 + side] = shoulder, elbow, elbow + forearm * stands(lower)
        body[:, 11 + side] = turned(np.tile(outward * [hips / 2, 0, 0], (FRAMES, 1)), yaw)
    set_head(random, body, thorax, shoulders_yaw, lean)
    return body * np.exp(random.normal(0, 0.05))


def set_head(random, body, thorax, shoulders_yaw, lean):
    yaw, pitch, roll = head_course(random, shoulders_yaw)
    size = np.exp(random.normal(0, 0.12))
    middle = thorax + turned(leant(np.stack(
        [wander(random, 0.015, 1) + random.normal(0, 0.008), random.uniform(0.14, 0.30) + wander(random, 0.01, 1),
         random.normal(0.05, 0.04) + wander(random, 0.02, 1)], -1), lean), shoulders_yaw)
    eyes, nose = random.normal(0.034, 0.012), 0.125 * np.exp(random.normal(0, 0.15))
    places = [(0, random.normal(0, 0.012), nose), (0.032, eyes, 0.095), (-0.032, eyes, 0.095), (0.074, 0, 0), (-0.074, 0, 0)]
    for point, place in enumerate(places):
        body[:, point] = middle + turned(leant(rolled(np.tile(np.array(place) * size, (FRAMES, 1)), roll), pitch), yaw)
