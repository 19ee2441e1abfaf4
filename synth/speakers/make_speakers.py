#!/usr/bin/env python3
"""Makes the JSON files of the 22 speakers of known style: 16 seen, 4 inside their convex hull, 2 beyond it.

Usage: make_speakers.py [OUT_DIR]
Same program, same bytes. Needs nothing but Python.

The seen are the first 16 points of a Sobol sequence in 12 dimensions with the direction numbers of Joe and Kuo
(new-joe-kuo-6), each dimension scrambled by nested random flips of its digits (Owen). So every sixteenth of the range of
every dimension holds exactly one speaker. Which of ours is which of Sobol's is drawn too. Of many drawings the one is kept whose closest two speakers lie farthest
apart in manner, among those in which no two dimensions of manner go together.
"""

import itertools
import json
import math
import random
import sys
from pathlib import Path

SEEN = 16
DRAWINGS = 6000

# Name in the file, group, least and most of the seen speakers, least and most that are allowed.
DIMENSIONS = [
    ("oac", "expressivity", 0.2, 1, 0, 1),
    ("spc", "expressivity", -0.9, 0.9, -1, 1),
    ("tmp", "expressivity", -0.9, 0.9, -1, 1),
    ("flt", "expressivity", -0.9, 0.9, -1, 1),
    ("pwr", "expressivity", -0.9, 0.9, -1, 1),
    ("rep", "expressivity", -0.9, 0.9, -1, 1),
    ("handedness", "habits", -1, 1, -1, 1),
    ("lean_deg", "habits", -6, 9, -17, 17),
    ("turn_deg", "habits", -20, 20, -25, 25),
    ("height", "habits", -0.1, 0.15, -0.2, 0.2),
    ("brow_gain", "habits", 0.4, 1.6, 0, 2),
    ("nod_gain", "habits", 0.4, 1.6, 0, 2),
]
MANNER = 6
OAC, PWR = 0, 4

# Direction numbers m_i of the second to the twelfth dimension; 16 points need the first four bits alone.
# (degree, coefficients, m)
JOE_KUO = [
    (1, 0, [1]),
    (2, 1, [1, 3]),
    (3, 1, [1, 3, 1]),
    (3, 2, [1, 1, 1]),
    (4, 1, [1, 1, 3, 3]),
    (4, 4, [1, 3, 5, 13]),
    (5, 2, [1, 1, 5, 5]),
    (5, 4, [1, 1, 5, 5]),
    (5, 7, [1, 1, 7, 11]),
    (5, 11, [1, 1, 5, 1]),
    (5, 13, [1, 1, 1, 3]),
]
BITS = 4

NAMES = {
    "seen": ["adrian", "beth", "carl", "doris", "edgar", "fiona", "gordon", "hilda",
             "ian", "jane", "keith", "laura", "martin", "nora", "oliver", "paula"],
    "inside": ["quentin", "rosa", "simon", "tessa"],
    "outside": ["victor", "wendy"],
}
LANGUAGES = ["en-us", "en-gb", "en-gb-scotland"]


def direction_numbers(dimension):
    if dimension == 0:
        return [1 << (BITS - 1 - i) for i in range(BITS)]
    degree, coefficients, first = JOE_KUO[dimension - 1]
    m = list(first)
    for i in range(degree, BITS):
        new = m[i - degree] ^ (m[i - degree] << degree)
        for k in range(1, degree):
            if coefficients >> (degree - 1 - k) & 1:
                new ^= m[i - k] << k
        m.append(new)
    return [m[i] << (BITS - 1 - i) for i in range(BITS)]


def sobol(dimension):
    numbers = direction_numbers(dimension)
    points = []
    for i in range(SEEN):
        x = 0
        for bit in range(BITS):
            if i >> bit & 1:
                x ^= numbers[bit]
        points.append(x)
    return points


def scramble(column, chance):
    """Flips each digit by a coin that is tossed once for all points with the same digits before it."""
    coins = {}
    scrambled = []
    for x in column:
        y = 0
        for bit in range(BITS):
            key = (bit, x >> (BITS - bit))
            if key not in coins:
                coins[key] = chance.getrandbits(1)
            y = y << 1 | ((x >> (BITS - 1 - bit) & 1) ^ coins[key])
        scrambled.append((y + chance.uniform(0.1, 0.9)) / SEEN)
    return scrambled


def correlation(a, b):
    mean_a, mean_b = sum(a) / len(a), sum(b) / len(b)
    cov = sum((x - mean_a) * (y - mean_b) for x, y in zip(a, b))
    return cov / math.sqrt(sum((x - mean_a) ** 2 for x in a) * sum((y - mean_b) ** 2 for y in b))


def closest(points, dimensions):
    return min(math.dist(a[:dimensions], b[:dimensions]) for a, b in itertools.combinations(points, 2))


def seen_points():
    columns = [sobol(d) for d in range(len(DIMENSIONS))]
    best, best_distance = [], 0
    for seed in range(DRAWINGS):
        chance = random.Random(seed)
        chance.shuffle(columns)
        scrambled = [scramble(column, chance) for column in columns]
        points = list(zip(*scrambled))
        distance = min(closest(points, MANNER), closest(points, len(DIMENSIONS)) - 0.35)
        if distance <= best_distance:
            continue
        if max(abs(correlation(a, b)) for a, b in itertools.combinations(scrambled[:MANNER], 2)) > 0.3:
            continue
        best, best_distance = points, distance
    return best


def mean_of(points):
    return [sum(p[d] for p in points) / len(points) for d in range(len(DIMENSIONS))]


def away_from_hull(points, target, steps=3000):
    """The distance of a point from the convex hull of others (Frank and Wolfe, with steps away)."""
    weights = [1 / len(points)] * len(points)
    at = mean_of(points)
    for _ in range(steps):
        off = [a - t for a, t in zip(at, target)]
        downhill = [sum(o * x for o, x in zip(off, p)) for p in points]
        to = min(range(len(points)), key=lambda i: downhill[i])
        fro = max((i for i in range(len(points)) if weights[i] > 0), key=lambda i: downhill[i])
        way = [a - b for a, b in zip(points[to], points[fro])]
        square = sum(w * w for w in way)
        if square == 0 or downhill[fro] - downhill[to] < 1e-12:
            break
        step = min(weights[fro], -sum(o * w for o, w in zip(off, way)) / square)
        weights[to] += step
        weights[fro] -= step
        at = [a + step * w for a, w in zip(at, way)]
    return math.dist(at, target)


def inside_points(seen):
    """Mixtures, mostly of three, that are as far from everybody as they can be."""
    chosen = []
    for turn in range(4):
        chance = random.Random(100 + turn)
        best, best_distance = None, 0
        for _ in range(4000):
            weights = [0.01] * SEEN
            for i, share in zip(chance.sample(range(SEEN), 3), (0.36, 0.27, 0.21)):
                weights[i] += share
            point = [sum(w * p[d] for w, p in zip(weights, seen)) for d in range(len(DIMENSIONS))]
            distance = min(math.dist(point[:MANNER], p[:MANNER]) for p in list(seen) + chosen)
            if distance > best_distance:
                best, best_distance = point, distance
        chosen.append(best)
    return chosen


def allowed(point):
    for share, (_, _, least, most, lowest, highest) in zip(point, DIMENSIONS):
        if not lowest <= least + share * (most - least) <= highest:
            return False
    return True


def outside_points(seen, inside):
    """A fifth beyond the edges of the hull, seen from its middle."""
    middle = mean_of(seen)
    candidates = []
    for a, b in itertools.combinations(seen, 2):
        edge = [(x + y) / 2 for x, y in zip(a, b)]
        point = [m + 1.2 * (e - m) for m, e in zip(middle, edge)]
        just_beyond = [m + 1.01 * (e - m) for m, e in zip(middle, edge)]
        if allowed(point) and away_from_hull(seen, just_beyond) > 1e-3:
            candidates.append(point)
    others = list(seen) + inside
    first = max(candidates, key=lambda p: min(math.dist(p[:MANNER], o[:MANNER]) for o in others))
    second = max(candidates, key=lambda p: min(math.dist(p[:MANNER], o[:MANNER]) for o in others + [first]))
    return [first, second]


def standardised(values):
    mean = sum(values) / len(values)
    spread = math.sqrt(sum((v - mean) ** 2 for v in values) / len(values))
    return [(v - mean) / spread for v in values]


def going_with(values, least, most, seed):
    """Whole numbers spread over a range that go with the values at a correlation of about a half."""
    target = standardised(values)
    while True:
        chance = random.Random(seed)
        ranks = list(range(len(values)))
        chance.shuffle(ranks)
        noise = standardised(ranks)
        mixed = [0.5 * t + math.sqrt(0.75) * n for t, n in zip(target, noise)]
        order = sorted(range(len(values)), key=lambda i: mixed[i])
        spread = [0] * len(values)
        for rank, i in enumerate(order):
            spread[i] = round(least + (most - least) * rank / (len(values) - 1))
        if abs(correlation(values, spread) - 0.5) < 0.02:
            return spread
        seed += 1


def voices(points):
    oac, pwr = [p[OAC] for p in points], [p[PWR] for p in points]
    both = [a + b for a, b in zip(standardised(oac), standardised(pwr))]
    pitch, rate, spread = going_with(both, 25, 75, 1), going_with(oac, 130, 200, 1001), going_with(pwr, 20, 80, 2001)
    men = [f"m{i}" for i in range(1, 9)] * 2
    women = [f"f{i}" for i in range(1, 6)] * 3
    made = []
    for i in range(len(points)):
        variants = men if i % 2 == 0 else women  # by the names
        made.append({"language": LANGUAGES[(i * 5 + i // 3) % 3], "variant": variants[i // 2],
                     "pitch": pitch[i], "rate": rate[i], "range": spread[i]})
    return made


def described(point, voice):
    speaker = {"$schema": "speaker.schema.json", "expressivity": {}, "habits": {}}
    for share, (name, group, least, most, _, _) in zip(point, DIMENSIONS):
        value = round(least + share * (most - least), 1 if name.endswith("_deg") else 3)
        speaker[group][name] = value
    return speaker | {"voice": voice}


def main():
    out = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent
    seen = seen_points()
    inside = inside_points(seen)
    points = list(seen) + inside + outside_points(seen, inside)
    names = NAMES["seen"] + NAMES["inside"] + NAMES["outside"]
    for name, point, voice in zip(names, points, voices(points)):
        text = ",\n".join(f"  {json.dumps(key)}: {json.dumps(value)}" for key, value in described(point, voice).items())
        (out / f"{name}.json").write_text("{\n" + text + "\n}\n")
    print(f"{len(points)} speakers; the closest two lie {closest(points, MANNER):.3f} apart in manner, "
          f"{closest(points, len(DIMENSIONS)):.3f} in all")


if __name__ == "__main__":
    main()
