"""What a camera sees of a body, and what the network of lift.py reads of that; skinning/lift/learned_depth.cpp reads the same."""

import numpy as np

from bodies import FPS, FRAMES, MIRRORED, turned, leant

NOSE, EARS, SHOULDERS, ELBOWS, WRISTS, HIPS = 0, (3, 4), (5, 6), (7, 8), (9, 10), (11, 12)
READ = [NOSE, *EARS, *SHOULDERS, *ELBOWS, *WRISTS, *HIPS]
FLAGS = [NOSE, *EARS, *ELBOWS, *WRISTS]  # each has a flag, whether it is seen; hips share one
BONES = [(5, 7), (7, 9), (6, 8), (8, 10)]  # whose depth is predicted
USUAL = {"shoulders": 0.36, "trunk": 0.50, "upper_arm": 0.285, "forearm": 0.255, "hips": 0.21, "ears": 0.148}  # [m]
CONTEXT = 3  # mean and spread of this long before and after are read as well [s]
STEP = 2  # frames of 30 a second from one that is read to the next
ROW = 2 * len(READ) + 6 + len(FLAGS) + 1  # numbers read of a frame
INPUTS = 3 * ROW + len(USUAL)
LONGEST = 1.15  # what a bone looks like against its own length, at most


def mirrored(body):
    return (body * [-1, 1, 1])[:, MIRRORED]


def filmed(body, yaw, pitch, distance):
    """The body in the axes of a camera that looks at its middle, (T, 13, 3), and its picture, (T, 13, 2), y up."""
    body = turned(body, yaw)
    middle = (body[:, SHOULDERS].mean(1) + body[:, HIPS].mean(1)) / 2
    body = body - middle[:, None] * [1, 0, 1] - [0, middle[:, 1].mean(), 0]
    body = leant(body, pitch)
    return body, body[..., :2] * (distance / (distance - body[..., 2:]))


def hidden(random, seen, points, frames):
    """Hides some points for the whole clip, or for one stretch of it."""
    if random.random() < 0.6:
        seen[:, points] = False
    else:
        begin, end = sorted(random.integers(0, frames + 1, 2))
        seen[begin:end, points] = False


def seen_points(random, body):
    """(T, 13) which points a detector finds: not those that are out of the picture or, at times, behind the head."""
    frames = len(body)
    seen = np.ones((frames, 13), bool)
    if random.random() < 0.5:
        across = body[:, EARS[0]] - body[:, EARS[1]]
        yaw = np.arctan2(-across[:, 2], across[:, 0])
        seen[:, EARS[0]] &= yaw < np.radians(35)  # the ear on the far side
        seen[:, EARS[1]] &= yaw > -np.radians(35)
        seen[:, NOSE] &= np.abs(yaw) < np.radians(100)
    for points, often in ((list(EARS), 0.05), ([NOSE], 0.02), (list(HIPS), 0.12), (list(WRISTS), 0.03), ([WRISTS[0]], 0.03),
                          ([WRISTS[1]], 0.03), ([ELBOWS[0], WRISTS[0]], 0.02), ([ELBOWS[1], WRISTS[1]], 0.02)):
        if random.random() < often:
            hidden(random, seen, points, frames)
    return seen


def part_lengths(points, seen):
    """By part: for each of its sides, the seen length in each frame and where it is seen."""
    shoulders, hips = points[:, SHOULDERS].mean(1), points[:, HIPS].mean(1)
    def side(a, b):
        return np.linalg.norm(points[:, a] - points[:, b], axis=-1), seen[:, a] & seen[:, b]
    sees_hips = seen[:, HIPS[0]] & seen[:, HIPS[1]]
    return {"shoulders": [side(*SHOULDERS)], "trunk": [(np.linalg.norm(shoulders - hips, axis=-1), sees_hips)],
            "upper_arm": [side(5, 7), side(6, 8)], "forearm": [side(7, 9), side(8, 10)], "hips": [side(*HIPS)],
            "ears": [side(*EARS)]}


def longest(sides):
    """The length that nine tenths of the frames do not pass, of the longer side; 0 where it is never seen."""
    lengths = [np.sort(length[where]) for length, where in sides if where.any()]
    return max((each[int(0.9 * (len(each) - 1))] for each in lengths), default=0)


def unit_of(lengths):
    """Of the picture, per metre, as if the person were of average size."""
    logs = [(np.log(lengths["shoulders"] / USUAL["shoulders"]), 1)]
    if lengths["trunk"] > 0:
        logs.append((np.log(lengths["trunk"] / USUAL["trunk"]), 1.5))
    if lengths["upper_arm"] > 0 and lengths["forearm"] > 0:
        arms = [sum(of[part] for part in ("upper_arm", "forearm")) for of in (lengths, USUAL)]
        logs.append((np.log(arms[0] / arms[1]), 1))
    return np.exp(sum(log * weight for log, weight in logs) / sum(weight for _, weight in logs))


def rows_of(points, seen):
    """(T, ROW) of each frame by itself, and the six lengths of the clip."""
    parts = part_lengths(points, seen)
    lengths = {part: longest(sides) for part, sides in parts.items()}
    unit = unit_of(lengths)
    places = 2 * (points - points[:, SHOULDERS].mean(1, keepdims=True))[:, READ] / unit
    sees_hips = seen[:, HIPS].all(1)
    there = seen[:, READ].copy()
    there[:, -2:] = sees_hips[:, None]
    ratios = []
    for part in ("upper_arm", "forearm", "shoulders", "trunk"):
        for length, where in parts[part]:
            ratio = 2 * np.minimum(LONGEST, length / max(1e-9, lengths[part])) - 1
            ratios.append(np.where(where, ratio, 0))
    rows = np.concatenate([(places * there[..., None]).reshape(len(points), -1), np.stack(ratios, 1), seen[:, FLAGS],
                           sees_hips[:, None]], 1)
    logs = [4 * np.log(lengths[part] / unit / usual) if lengths[part] > 0 else 0 for part, usual in USUAL.items()]
    return rows, logs


def features(points, seen, fps):
    """(T, INPUTS) all that the network reads of each frame: its row, the clip's lengths, mean and spread of the rows around."""
    rows, logs = rows_of(points, seen)
    frames = len(rows)
    reach = int(round(CONTEXT * fps))
    begin = np.maximum(0, np.arange(frames) - reach)
    end = np.minimum(frames, np.arange(frames) + reach + 1)

    def mean(values):
        sums = np.concatenate([np.zeros((1, ROW)), np.cumsum(values, 0)])
        return (sums[end] - sums[begin]) / (end - begin)[:, None]

    means = mean(rows)
    spreads = np.sqrt(np.maximum(0, mean(rows * rows) - means * means))
    return np.concatenate([rows, np.tile(logs, (frames, 1)), means, spreads], 1).astype(np.float32)


def truths(body):
    """(T, 5) the turn of the shoulders [rad] and how far each of BONES points to the camera, -1 to 1."""
    across = body[:, SHOULDERS[0]] - body[:, SHOULDERS[1]]
    towards = []
    for root, tip in BONES:
        bone = body[:, tip] - body[:, root]
        towards.append(bone[:, 2] / np.maximum(1e-6, np.linalg.norm(bone, axis=1)))
    return np.stack([np.arctan2(-across[:, 2], across[:, 0]), *towards], 1).astype(np.float32)


def example(random, body):
    """A stretch of a body, seen from somewhere by a detector, every other frame: what the network reads, and what is true."""
    if random.random() < 0.5:
        body = mirrored(body)
    frames = FRAMES
    kind = random.random()
    if kind < 0.07:
        frames = 1
    elif kind < 0.25:
        frames = int(random.integers(8, 90))
    begin = random.integers(FRAMES - frames + 1)
    yaw = random.uniform(-50, 50) if random.random() < 0.7 else random.normal(0, 8)
    pitch = random.normal(0, 4) if random.random() < 0.4 else 0
    distance = np.exp(random.uniform(np.log(2.5), np.log(12))) if random.random() < 0.6 else 4
    body, points = filmed(body[begin:begin + frames], np.radians(yaw), np.radians(pitch), distance)
    if random.random() < 0.5:
        points = points + random.normal(0, 0.004 * random.random(), points.shape)  # [m]
    if random.random() < 0.5:
        points = points + random.normal(0, 0.006, (1, *points.shape[1:]))
    first = 0 if frames < STEP else int(random.integers(STEP))
    return features(points, seen_points(random, body), FPS)[first::STEP], truths(body)[first::STEP]
