"""What is said, and what the body does with it: two texts, each in two manners, and three shots without speech.

`expressive` is large and varied; `restrained` says the same words at the same times with small,
few gestures near the waist. A stroke ends on the vowel of the word that it goes with.
"""

from performance import Move, Score, Shift

CONDITIONS = ("expressive", "restrained")


def two_ways_expressive(say):
    two, ways, either, small = say("two"), say("ways"), say("either"), say("small")
    quick, take, time, make, big = say("quick"), say("take"), say("time"), say("make"), say("big")
    it, build = say("it"), say("build")
    right = [
        # two ways: two fingers, a beat on each word
        Move(two - 0.13, 0.44, at=(0.235, 1.262, 0.245), palm="in_front", shape="two", flex=-8, dev=-6, swivel=20, arc=(0.02, 0, 0.03)),
        Move(two + 0.06, 0.24, at=(0.250, 1.345, 0.205), palm="front", flex=-30, swivel=20, settle=0.12),
        Move(ways - 0.13, 0.26, at=(0.256, 1.372, 0.190), flex=-20, swivel=22),
        Move(ways + 0.05, 0.22, at=(0.240, 1.318, 0.240), flex=-32, swivel=20, settle=0.18),
        Move(it - 0.02, 0.34, at=(0.215, 1.215, 0.330), palm="in_front", shape="loose", flex=6),
        Move(it + 0.52, 0.62, at=(0.165, 1.090, 0.270), palm="in_up", flex=10, arc=(0.015, 0, 0)),
        # either ... small: both hands go to the left and close round a little thing
        Move(either + 0.06, 0.50, at=(-0.005, 1.190, 0.315), palm="in_up", shape="hold", flex=-4, dev=6, swivel=30, arc=(0, 0.05, 0.02)),
        Move(build - 0.12, 0.26, at=(0.006, 1.218, 0.308), flex=4),
        Move(build + 0.06, 0.25, at=(0.024, 1.165, 0.350), flex=-10, settle=0.14),
        Move(small - 0.16, 0.36, at=(0.055, 1.235, 0.315), palm="in", shape="loose", flex=-12),
        Move(small + 0.05, 0.26, at=(-0.012, 1.190, 0.340), shape="pinch", flex=-6, settle=0.10),
        Move(small + 0.34, 0.30, at=(-0.008, 1.180, 0.336), flex=-8),
        # quick: a flick away
        Move(quick - 0.15, 0.28, at=(-0.005, 1.245, 0.285), palm="in_up", shape="curl", flex=22, dev=6),
        Move(quick + 0.05, 0.22, at=(0.150, 1.220, 0.370), palm="up_front", shape="open", flex=-14, dev=-6, settle=0.16, arc=(0, 0.035, 0)),
        # or we take our time: an open palm on the other side, a slow round way
        Move(take - 0.12, 0.46, at=(0.225, 1.120, 0.300), palm="up", shape="offer", flex=4, dev=0),
        Move(take + 0.08, 0.30, at=(0.270, 1.165, 0.355), flex=-8, settle=0.08),
        Move(time + 0.16, 0.66, at=(0.388, 1.190, 0.235), palm="up", shape="open", flex=-12, arc=(0.02, 0.075, 0.065)),
        # make it really big: gather, then wide
        Move(make + 0.02, 0.52, at=(0.150, 1.110, 0.310), palm="in_up", shape="hold", flex=-4, dev=2, swivel=26, arc=(0.03, -0.05, 0)),
        Move(big - 0.17, 0.34, at=(0.136, 1.150, 0.296), flex=2, swivel=30),
        Move(big + 0.07, 0.42, at=(0.368, 1.335, 0.318), palm="in_front", shape="open", flex=-16, dev=2, settle=0.07, arc=(-0.02, 0.075, 0.07)),
        Move(big + 0.42, 0.30, at=(0.378, 1.310, 0.316), flex=-10),
        Move(big + 1.04, 0.80, shape="rest", at=(0.162, 1.085, 0.240), palm="belly", swivel=16, flex=8, dev=4, arc=(0.05, 0.01, 0.05)),
    ]  # fmt: skip
    left = [
        Move(two + 0.02, 0.46, at=(0.159, 1.107, 0.225), flex=4),
        Move(it + 0.30, 0.60, at=(0.150, 1.095, 0.240), palm="in", flex=8),
        Move(either + 0.02, 0.46, at=(0.315, 1.165, 0.300), palm="in_up", shape="hold", flex=-6, dev=9, swivel=24, arc=(0, 0.045, 0.02)),
        Move(build - 0.09, 0.26, at=(0.312, 1.196, 0.300), flex=0),
        Move(build + 0.09, 0.25, at=(0.296, 1.142, 0.334), flex=-14, settle=0.14),
        Move(small - 0.12, 0.34, at=(0.345, 1.222, 0.305), palm="in", shape="loose", flex=-12),
        Move(small + 0.08, 0.26, at=(0.276, 1.182, 0.330), shape="pinch", flex=-6, settle=0.10),
        Move(small + 0.36, 0.30, at=(0.280, 1.170, 0.325), flex=-8),
        Move(quick + 0.08, 0.34, at=(0.262, 1.145, 0.310), shape="loose", flex=-2),
        Move(take + 0.10, 0.66, at=(0.145, 1.090, 0.235), palm="belly", shape="rest", flex=10, swivel=18, arc=(0.03, 0, 0.02)),
        Move(time + 0.10, 0.40, at=(0.165, 1.075, 0.255), palm="in", flex=2),
        Move(make + 0.06, 0.48, at=(0.150, 1.095, 0.300), palm="in_up", shape="hold", flex=-4, swivel=26, arc=(0.02, -0.02, 0)),
        Move(big - 0.15, 0.34, at=(0.172, 1.130, 0.288), flex=2, swivel=30),
        Move(big + 0.11, 0.43, at=(0.352, 1.288, 0.328), palm="in_front", shape="open", flex=-14, dev=2, settle=0.07, arc=(-0.02, 0.065, 0.06)),
        Move(big + 0.44, 0.30, at=(0.358, 1.262, 0.324), flex=-8),
        Move(big + 1.00, 0.82, shape="rest", at=(0.152, 1.075, 0.232), palm="belly", swivel=16, flex=8, dev=4, arc=(0.06, 0, 0.05)),
    ]  # fmt: skip
    trunk = [
        Shift(two + 0.1, 0.6, {"head_pitch": -3, "hips_x": -0.012, "hips_roll": -0.8}),
        Shift(it + 0.4, 0.6, {"head_pitch": 1, "head_roll": -2.5, "hips_x": 0.0}),
        Shift(either + 0.15, 0.6, {"hips_x": 0.022, "hips_roll": 1.6, "head_yaw": 9, "head_roll": -4, "spine_yaw": 3}),
        Shift(small + 0.05, 0.4, {"head_pitch": 6, "spine_pitch": 3.5, "shrug": 4}),
        Shift(quick + 0.1, 0.3, {"head_pitch": -1, "spine_pitch": 1, "shrug": 0, "head_yaw": 3}),
        Shift(take + 0.1, 0.7, {"hips_x": -0.024, "hips_roll": -1.7, "head_yaw": -9, "head_roll": 5, "spine_yaw": -4}),
        Shift(time + 0.3, 0.6, {"head_pitch": -3}),
        Shift(make + 0.1, 0.5, {"head_pitch": 5, "head_yaw": 0, "head_roll": 0, "spine_yaw": 0, "spine_pitch": 4, "hips_x": 0.0, "hips_roll": 0}),
        Shift(big + 0.10, 0.5, {"head_pitch": -6, "spine_pitch": -3, "shrug": 4, "hips_z": -0.012}),
        Shift(big + 1.0, 0.8, {"head_pitch": 0, "spine_pitch": 0, "shrug": 0, "hips_z": 0.0, "hips_x": -0.006}),
    ]
    nods = [(two, 6), (ways, 5), (build, 5), (small, 6), (quick, 7), (take, 4), (time, 4), (say("really"), 4), (big, 7)]
    return Score("waist", right, left, trunk, nods, follow=1.3)


def two_ways_restrained(say):
    two, ways, small, quick = say("two"), say("ways"), say("small"), say("quick")
    take, time, really, big, either = say("take"), say("time"), say("really"), say("big"), say("either")
    right = [
        Move(two + 0.05, 0.40, at=(0.174, 1.120, 0.262), palm="in", shape="loose", flex=0, settle=0.1),
        Move(ways + 0.42, 0.60, at=(0.154, 1.085, 0.238), palm="belly", shape="rest", flex=8),
        Move(small - 0.16, 0.40, at=(0.162, 1.120, 0.252), palm="in", shape="loose", flex=6),
        Move(small + 0.05, 0.24, at=(0.126, 1.102, 0.272), shape="hold", flex=2, settle=0.1),
        Move(quick + 0.05, 0.26, at=(0.149, 1.103, 0.272), flex=-4, settle=0.1),
        Move(quick + 0.70, 0.60, at=(0.154, 1.081, 0.236), palm="belly", shape="rest", flex=8),
        Move(time + 0.05, 0.46, at=(0.168, 1.102, 0.262), palm="in_up", shape="loose", flex=0),
        Move(really - 0.04, 0.52, at=(0.164, 1.095, 0.250), palm="in", flex=8),
        Move(big - 0.16, 0.30, at=(0.156, 1.120, 0.246), flex=10),
        Move(big + 0.06, 0.28, at=(0.205, 1.133, 0.278), palm="in_up", shape="offer", flex=-4, settle=0.08),
        Move(big + 1.00, 0.70, at=(0.153, 1.081, 0.236), palm="belly", shape="rest", swivel=16, flex=8, dev=4),
    ]  # fmt: skip
    left = [
        Move(two + 0.10, 0.44, at=(0.156, 1.091, 0.238), flex=4),
        Move(ways + 0.50, 0.60, at=(0.152, 1.079, 0.234), flex=8),
        Move(small + 0.08, 0.34, at=(0.136, 1.097, 0.258), palm="in", shape="hold", flex=4, settle=0.1),
        Move(quick + 0.74, 0.70, at=(0.154, 1.077, 0.234), palm="belly", shape="rest", flex=8),
        Move(big - 0.12, 0.34, at=(0.154, 1.102, 0.244), palm="in", flex=10),
        Move(big + 0.10, 0.30, at=(0.188, 1.112, 0.272), palm="in_up", shape="loose", flex=-2, settle=0.08),
        Move(big + 1.02, 0.74, at=(0.152, 1.077, 0.234), palm="belly", shape="rest", swivel=16, flex=8, dev=4),
    ]  # fmt: skip
    trunk = [
        Shift(either + 0.3, 0.8, {"head_yaw": 3, "head_roll": -1.5, "hips_x": 0.008}),
        Shift(take + 0.1, 0.8, {"head_yaw": -3, "head_roll": 1.5, "hips_x": -0.006}),
        Shift(big + 0.3, 0.7, {"head_yaw": 0, "head_roll": 0, "hips_x": 0.0}),
    ]
    nods = [(two, 2), (small, 2.2), (time, 1.5), (big, 2.5)]
    return Score("waist", right, left, trunk, nods, liveliness=0.75, follow=0.6)


def simple_idea_expressive(say):
    look, idea, simple, first, listen = say("look"), say("idea", 1), say("simple"), say("first"), say("listen")
    second, ask, then, together = say("second"), say("ask"), say("then"), say("together", 1)
    change, everything = say("change"), say("everything")
    right = [
        # look: up from the side; the idea: both palms offer it; simple: let it go
        Move(look + 0.30, 0.55, at=(0.200, 1.120, 0.270), palm="in_up", shape="loose", flex=12, dev=4, swivel=24, arc=(0.03, 0, 0.02)),
        Move(idea - 0.15, 0.36, at=(0.160, 1.205, 0.270), flex=16, shape="hold"),
        Move(idea + 0.06, 0.27, at=(0.190, 1.165, 0.390), palm="up", shape="offer", flex=-8, settle=0.10, arc=(0, 0.03, 0)),
        Move(simple - 0.14, 0.28, at=(0.215, 1.215, 0.345), flex=4),
        Move(simple + 0.06, 0.26, at=(0.300, 1.140, 0.345), palm="up", shape="open", flex=-10, settle=0.12, arc=(0, 0.02, 0)),
        # first: one finger
        Move(first - 0.16, 0.60, at=(0.225, 1.265, 0.235), palm="in_front", shape="one", flex=-6, dev=-6, swivel=20, arc=(0, -0.02, 0)),
        Move(first + 0.06, 0.25, at=(0.245, 1.362, 0.200), palm="front", flex=-28, swivel=22, settle=0.12),
        # listen: the hand behind the ear
        Move(listen + 0.07, 0.52, at=(0.214, 1.482, 0.118), palm="in_front", shape="cup", flex=-12, dev=-20, swivel=26, arc=(0.05, -0.01, 0.02)),
        Move(listen + 0.44, 0.34, at=(0.204, 1.496, 0.106), swivel=28, flex=-14),
        # second: two fingers
        Move(second - 0.15, 0.52, at=(0.250, 1.375, 0.185), palm="in_front", shape="two", flex=-14, dev=-8, swivel=22, arc=(0.04, 0, 0.02)),
        Move(second + 0.06, 0.25, at=(0.238, 1.318, 0.245), palm="front", flex=-32, swivel=20, settle=0.14),
        # ask: an open palm to the one who is asked
        Move(ask - 0.17, 0.42, at=(0.150, 1.190, 0.290), palm="in_up", shape="loose", flex=16, swivel=22),
        Move(ask + 0.07, 0.30, at=(0.175, 1.215, 0.445), palm="up", shape="offer", flex=-6, dev=0, settle=0.08, arc=(0, -0.03, 0)),
        Move(ask + 0.42, 0.30, at=(0.182, 1.200, 0.440), flex=-2),
        # and then together: from far apart to one
        Move(then + 0.05, 0.50, at=(0.365, 1.215, 0.295), palm="in_up", shape="open", flex=-8, dev=0, arc=(0.02, 0.04, 0.01)),
        Move(together - 0.20, 0.40, at=(0.375, 1.265, 0.290), palm="in", flex=-12),
        Move(together + 0.06, 0.32, at=(0.132, 1.190, 0.340), palm="in", shape="hold", flex=-14, swivel=30, settle=0.06, arc=(0, 0.02, 0.05)),
        # change: the held thing is turned; everything: and opened over all the room
        Move(change - 0.12, 0.30, at=(0.146, 1.255, 0.322), flex=-4, swivel=34),
        Move(change + 0.06, 0.25, at=(0.142, 1.165, 0.358), palm="in_down", flex=-18, swivel=30, settle=0.10),
        Move(everything - 0.14, 0.32, at=(0.130, 1.230, 0.312), palm="in", flex=-2, swivel=33),
        Move(everything + 0.26, 0.52, at=(0.368, 1.312, 0.312), palm="up_front", shape="open", flex=-14, dev=-6, settle=0.06, arc=(-0.03, 0.10, 0.10)),
        Move(everything + 0.62, 0.40, at=(0.398, 1.236, 0.272), palm="up", flex=-8),
        Move(everything + 1.42, 0.92, shape="rest", at=(0.232, 0.893, 0.045), palm="in_back", swivel=14, flex=4, dev=0, arc=(0.03, 0, 0.05)),
    ]  # fmt: skip
    left = [
        Move(look + 0.38, 0.58, at=(0.205, 1.085, 0.260), palm="in_up", shape="loose", flex=12, swivel=22, arc=(0.03, 0, 0.02)),
        Move(idea - 0.12, 0.34, at=(0.170, 1.165, 0.270), flex=14, shape="hold"),
        Move(idea + 0.10, 0.28, at=(0.200, 1.130, 0.375), palm="up", shape="offer", flex=-6, settle=0.10, arc=(0, 0.025, 0)),
        Move(simple - 0.10, 0.28, at=(0.220, 1.165, 0.335), flex=4),
        Move(simple + 0.10, 0.27, at=(0.285, 1.105, 0.330), shape="open", flex=-8, settle=0.12),
        Move(first + 0.02, 0.78, at=(0.159, 1.095, 0.238), palm="belly", shape="rest", flex=8, dev=4, swivel=16, arc=(0.02, 0, 0.02)),
        Move(listen + 0.25, 0.60, at=(0.166, 1.085, 0.232), flex=10),
        Move(second + 0.10, 0.36, at=(0.169, 1.113, 0.245), flex=4, settle=0.1),
        Move(ask + 0.12, 0.46, at=(0.150, 1.082, 0.268), palm="in", shape="loose", flex=0),
        Move(then + 0.02, 0.48, at=(0.345, 1.185, 0.300), palm="in_up", shape="open", flex=-6, dev=0, arc=(0.02, 0.05, 0.01)),
        Move(together - 0.17, 0.40, at=(0.358, 1.235, 0.295), palm="in", flex=-10),
        Move(together + 0.09, 0.32, at=(0.126, 1.170, 0.330), palm="in", shape="hold", flex=-12, swivel=30, settle=0.06, arc=(0, 0.02, 0.05)),
        Move(change - 0.09, 0.30, at=(0.138, 1.225, 0.318), flex=-4, swivel=33),
        Move(change + 0.09, 0.25, at=(0.136, 1.145, 0.346), palm="in_down", flex=-16, swivel=30, settle=0.10),
        Move(everything - 0.11, 0.32, at=(0.126, 1.205, 0.306), palm="in", flex=-2, swivel=33),
        Move(everything + 0.31, 0.53, at=(0.350, 1.270, 0.318), palm="up_front", shape="open", flex=-12, dev=-4, settle=0.06, arc=(-0.03, 0.09, 0.09)),
        Move(everything + 0.66, 0.40, at=(0.376, 1.198, 0.284), palm="up", flex=-6),
        Move(everything + 1.42, 0.90, shape="rest", at=(0.230, 0.894, 0.050), palm="in_back", swivel=14, flex=4, dev=0, arc=(0.04, 0, 0.05)),
    ]  # fmt: skip
    trunk = [
        Shift(look + 0.1, 0.4, {"head_pitch": -3, "hips_z": 0.008}),
        Shift(idea + 0.1, 0.5, {"head_pitch": 2, "head_roll": 3, "spine_pitch": 2.5}),
        Shift(simple + 0.2, 0.4, {"head_roll": -3, "shrug": 4, "spine_pitch": 0}),
        Shift(first + 0.05, 0.6, {"head_roll": 0, "head_pitch": -2, "shrug": 0, "hips_x": -0.012, "hips_roll": -1}),
        Shift(listen + 0.15, 0.6, {"head_yaw": 9, "head_roll": 8, "spine_roll": 2, "hips_x": -0.024, "hips_roll": -1.8}),
        Shift(second + 0.05, 0.55, {"head_yaw": 0, "head_roll": 0, "spine_roll": 0, "hips_x": -0.004, "hips_roll": 0}),
        Shift(ask + 0.1, 0.5, {"head_pitch": 3, "spine_pitch": 4, "head_roll": 4, "hips_z": 0.02}),
        Shift(then + 0.2, 0.6, {"head_pitch": -2, "spine_pitch": -1, "head_roll": -2, "hips_z": 0.0, "hips_x": 0.008}),
        Shift(together + 0.1, 0.45, {"head_pitch": 4, "spine_pitch": 3, "head_roll": 0}),
        Shift(everything - 0.1, 0.4, {"head_pitch": 3, "hips_x": 0.0}),
        Shift(everything + 0.35, 0.55, {"head_pitch": -5, "spine_pitch": -2.5, "shrug": 3, "head_roll": 2}),
        Shift(everything + 1.3, 0.8, {"head_pitch": 0, "spine_pitch": 0, "shrug": 0, "head_roll": 0, "hips_x": -0.008}),
    ]
    nods = [(look, 7), (idea, 5), (simple, 6), (first, 7), (second, 7), (ask, 5), (together, 6), (change, 5), (everything, 6)]
    return Score("sides", right, left, trunk, nods, follow=1.3)


def simple_idea_restrained(say):
    idea, simple, first, listen, second = say("idea", 1), say("simple"), say("first"), say("listen"), say("second")
    ask, then, together, everything = say("ask"), say("then"), say("together", 1), say("everything")
    right = [
        Move(idea - 0.16, 0.70, at=(0.175, 1.095, 0.225), palm="in", shape="loose", flex=8, swivel=18, arc=(0.02, 0, 0.02)),
        Move(idea + 0.06, 0.28, at=(0.172, 1.102, 0.272), palm="in_up", flex=-2, settle=0.1),
        Move(simple + 0.60, 0.70, at=(0.164, 1.075, 0.232), palm="belly", shape="rest", flex=8, dev=4, swivel=16),
        Move(first + 0.05, 0.34, at=(0.150, 1.108, 0.262), palm="in", shape="loose", flex=0, settle=0.1),
        Move(listen + 0.30, 0.60, at=(0.166, 1.079, 0.236), palm="belly", shape="rest", flex=8),
        Move(second + 0.05, 0.34, at=(0.158, 1.114, 0.266), palm="in", shape="loose", flex=-2, settle=0.1),
        Move(ask + 0.06, 0.40, at=(0.172, 1.112, 0.286), palm="in_up", shape="offer", flex=-4),
        Move(then + 0.30, 0.60, at=(0.169, 1.079, 0.238), palm="belly", shape="rest", flex=8),
        Move(together + 0.06, 0.36, at=(0.149, 1.100, 0.262), palm="in", flex=2, settle=0.08),
        Move(everything - 0.14, 0.34, at=(0.162, 1.120, 0.252), flex=8),
        Move(everything + 0.10, 0.34, at=(0.212, 1.118, 0.275), palm="in_up", shape="offer", flex=-4, settle=0.08),
        Move(everything + 1.36, 0.90, shape="rest", at=(0.231, 0.893, 0.045), palm="in_back", swivel=14, flex=4, dev=0, arc=(0.02, 0, 0.03)),
    ]  # fmt: skip
    left = [
        Move(idea + 0.10, 0.50, at=(0.228, 0.898, 0.060), flex=0),
        Move(simple + 0.50, 0.60, at=(0.232, 0.893, 0.046), flex=4),
        Move(everything + 0.10, 0.50, at=(0.236, 0.902, 0.062), palm="in", shape="loose", flex=0),
        Move(everything + 0.95, 0.70, at=(0.232, 0.893, 0.046), palm="in_back", shape="rest", flex=4),
    ]  # fmt: skip
    trunk = [
        Shift(idea + 0.2, 0.7, {"head_roll": 1.5, "hips_x": 0.005}),
        Shift(listen + 0.2, 0.7, {"head_roll": -2, "head_yaw": 2, "hips_x": -0.008}),
        Shift(ask + 0.2, 0.6, {"head_roll": 1, "head_yaw": 0}),
        Shift(everything + 0.2, 0.7, {"head_roll": 0, "hips_x": 0.0}),
    ]
    nods = [(idea, 2), (first, 2), (second, 2), (ask, 1.5), (everything, 2.2)]
    return Score("sides", right, left, trunk, nods, liveliness=0.75, follow=0.6)


def right_arm():
    right = [
        Move(0.95, 0.60, at=(0.235, 1.262, 0.245), palm="in_front", shape="loose", flex=-8, swivel=20, arc=(0.02, 0, 0.03)),
        Move(1.35, 0.34, at=(0.300, 1.345, 0.265), palm="front", shape="open", flex=-24, swivel=22, settle=0.10),
        Move(1.95, 0.44, at=(0.190, 1.190, 0.360), palm="in_up", shape="offer", flex=-6, arc=(0.03, 0.03, 0)),
        Move(2.70, 0.60, at=(0.232, 0.893, 0.045), palm="in_back", shape="rest", swivel=14, flex=4, dev=0, arc=(0.03, 0, 0.05)),
    ]  # fmt: skip
    return Score("sides", right, [], [], [], liveliness=0.5, follow=0.0)


def left_arm():
    mirrored = right_arm()
    return Score("sides", [], mirrored.right, [], [], liveliness=0.5, follow=0.0)


def turned():
    trunk = [
        Shift(1.05, 0.75, {"hips_yaw": 22, "spine_yaw": 28, "head_yaw": 44}),
        Shift(2.70, 0.90, {"hips_yaw": -22, "spine_yaw": -28, "head_yaw": -44}),
    ]
    return Score("sides", [], [], trunk, [], liveliness=0.5, follow=0.0)


# What the training of a study shows before its questions: each arm alone, and where the body is turned. Nobody speaks.
SHOTS = {"right-arm": right_arm, "left-arm": left_arm, "turned": turned}
SHOT_SECONDS = 3.0
SHOT_SEED = 31

CLIPS = {
    "two-ways": {
        "text": "There are two ways to do it. Either we build something small and quick, "
        "or we take our time, and make it really big.",
        "lead_in": 0.30,
        "tail": 0.85,
        "seed": 11,
        "expressive": two_ways_expressive,
        "restrained": two_ways_restrained,
    },
    "simple-idea": {
        "text": "Look, the idea is simple. First, you listen. Second, you ask. "
        "And then, together, you change everything.",
        "lead_in": 0.30,
        "tail": 0.80,
        "seed": 23,
        "expressive": simple_idea_expressive,
        "restrained": simple_idea_restrained,
    },
}
