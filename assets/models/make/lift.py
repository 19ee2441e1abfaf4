#!/usr/bin/env python3
"""Trains the network that predicts for skinning/lift how trunks are turned and where arms point: assets/models/lift.h5.

    python3 assets/models/make/lift.py              (Debian's python3-torch and python3-h5py; about 50 minutes of one core)
    python3 assets/models/make/lift.py example      (writes what the network predicts of one body, for tests/skinning/lift)

It learns from bodies that bodies.py makes up, filmed from all sides; no recorded motion is in it. The same machine gives the
same bytes every time.
"""

import json
import sys
from pathlib import Path

import h5py
import numpy as np
import torch
from torch.nn import Linear, ModuleList
from torch.nn import functional

import picture
from bodies import FPS, MIRRORED, made_up_body

STEPS = 15_000
BATCH = 48  # clips
BODIES = 2400  # that are known at once; the oldest go as new ones come
FIRST, NEW = 60, 3  # bodies made up each step, until so many are known and then
FASTEST = 2e-3
WIDTH = 128
REACHES = [1, 2, 4, 8, 16]  # how far layers look before and after, in steps of picture.STEP
TURN, TOWARDS, WAYS = slice(0, 3), slice(3, 7), [slice(7, 11), slice(11, 15)]  # what is predicted
CLEARLY_OUT = 0.34  # sine of 20 degrees


class Network(torch.nn.Module):
    """Each frame is read by itself; then layers look ever farther before and after it and add what they find.

    It predicts of the turn sine, cosine and the logarithm of its spread, of each bone how far it points to the camera,
    and of each arm the logarithms of how likely its ways are; bit 0 of a way: the forearm points to the camera, bit 1: the upper arm.
    """

    def __init__(self):
        super().__init__()
        self.first = Linear(picture.INPUTS, WIDTH)
        self.around = ModuleList(Linear(3 * WIDTH, WIDTH) for _ in REACHES)
        self.middle = Linear(WIDTH, WIDTH)
        self.last = Linear(WIDTH, WAYS[-1].stop)

    def forward(self, read, neighbours):
        codes = functional.relu(self.first(read))
        for layer, (before, after) in zip(self.around, neighbours):
            codes = codes + functional.relu(layer(torch.cat([codes[before], codes, codes[after]], 1)))
        return self.last(functional.relu(self.middle(codes)))


def neighbours(frames, steps=1):
    """By layer, of clips of so many frames, one after the other: which frame is its reach before, and after, each of them.

    Where a clip has none it is its first or last one. `steps` is how many frames a reach of 1 is.
    """
    def frames_at(reach):
        begins = np.cumsum([0, *frames])
        return torch.from_numpy(np.concatenate(
            [begin + np.clip(np.arange(count) + reach, 0, count - 1) for begin, count in zip(begins, frames)]))
    reaches = [int(np.floor(reach * steps + 0.5)) for reach in REACHES]
    return [(frames_at(-reach), frames_at(reach)) for reach in reaches]


def turn_error(predicted, true):
    off = torch.atan2(predicted[:, 0], predicted[:, 1]) - true[:, 0]
    return torch.remainder(off + np.pi, 2 * np.pi) - np.pi


def loss_of(predicted, true):
    """The turn as of a Laplace distribution, the depths by their distance, the ways by their odds; a bone that lies flat has
    both sides in part."""
    spread = predicted[:, 2].clamp(-4, 1)
    turn = ((turn_error(predicted, true).abs() + 0.01) / spread.exp() + spread).mean()
    on_the_circle = ((predicted[:, 0]**2 + predicted[:, 1]**2 - 1)**2).mean()
    depths = functional.smooth_l1_loss(predicted[:, TOWARDS], true[:, 1:], beta=0.1)
    to_camera = (0.5 + 0.5 * true[:, 1:] / CLEARLY_OUT).clamp(0, 1)
    unlikely = 0
    for ways, arm in zip(WAYS, (slice(0, 2), slice(2, 4))):
        upper, lower = to_camera[:, arm].unbind(1)
        share = torch.stack([(1 - upper) * (1 - lower), (1 - upper) * lower, upper * (1 - lower), upper * lower], 1)
        unlikely = unlikely - (share * functional.log_softmax(predicted[:, ways], 1)).sum(1).mean()
    return turn + 0.02 * on_the_circle + 4 * depths + 0.6 * unlikely


def sides(predicted):
    """(T, 4) the logarithm of the odds that each bone points to the camera."""
    odds = []
    for ways in WAYS:
        logs = predicted[:, ways]
        odds.append(torch.logsumexp(logs[:, 2:], 1) - torch.logsumexp(logs[:, :2], 1))
        odds.append(torch.logsumexp(logs[:, 1::2], 1) - torch.logsumexp(logs[:, ::2], 1))
    return torch.stack(odds, 1)


def batch_of(random, bodies):
    """What is read, what is true, and the neighbours of each frame."""
    made = [picture.example(random, body) for body in bodies]
    read, true = (torch.from_numpy(np.concatenate([each[part] for each in made])) for part in (0, 1))
    return read, true, neighbours([len(each[0]) for each in made])


def batches(random):
    bodies = []
    while True:
        new = NEW if len(bodies) >= BODIES else FIRST
        bodies = (bodies + [made_up_body(random).astype(np.float32) for _ in range(new)])[-BODIES:]
        yield batch_of(random, [bodies[i] for i in random.integers(0, len(bodies), BATCH)])


def trained():
    torch.manual_seed(1)
    torch.set_num_threads(1)
    network = Network()
    optimiser = torch.optim.AdamW(network.parameters(), FASTEST, weight_decay=1e-3)
    pace = torch.optim.lr_scheduler.OneCycleLR(optimiser, FASTEST, total_steps=STEPS + 1, pct_start=0.05, final_div_factor=200)
    unknown = np.random.default_rng(2)
    test_read, test_true, test_neighbours = batch_of(unknown, [made_up_body(unknown) for _ in range(120)])
    for step, (read, true, around) in zip(range(1, STEPS + 1), batches(np.random.default_rng(1))):
        loss = loss_of(network(read, around), true)
        optimiser.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(network.parameters(), 1)
        optimiser.step()
        pace.step()
        if step % 500 == 0:
            with torch.no_grad():
                predicted = network(test_read, test_neighbours)
                loss = loss_of(predicted, test_true).item()
            turn = np.degrees(turn_error(predicted, test_true).abs().mean().item())
            far = test_true[:, 1:].abs() > CLEARLY_OUT
            wrong = ((sides(predicted) > 0) != (test_true[:, 1:] > 0))[far].float().mean().item()
            print(f"{step} of {STEPS}: loss {loss:.3f}, turn off by {turn:.2f} degrees, {100 * wrong:.2f} % of bones on the "
                  "wrong side", flush=True)
    return network


def layers(network):
    """The layers by their names in the file."""
    return {"first": network.first, "middle": network.middle, "last": network.last,
            **{f"around/{number}": layer for number, layer in enumerate(network.around)}}


def write(network, file):
    with h5py.File(file, "w") as out:
        for name, layer in layers(network).items():
            out[f"{name}/weights"] = layer.weight.detach().numpy()
            out[f"{name}/offsets"] = layer.bias.detach().numpy()


def read(file):
    network = Network()
    with h5py.File(file) as arrays, torch.no_grad():
        for name, layer in layers(network).items():
            layer.weight.copy_(torch.from_numpy(arrays[f"{name}/weights"][()]))
            layer.bias.copy_(torch.from_numpy(arrays[f"{name}/offsets"][()]))
    return network


def prediction_of(network, points, seen):
    """(T, 14) the mean over the picture and its mirror image: turn, spread, how far bones point to the camera, how unlikely
    ways are."""
    def one_side(points, seen):
        around = neighbours([len(points)], picture.STEP)
        out = network(torch.from_numpy(picture.features(points, seen, FPS)), around)
        return torch.cat([out[:, :WAYS[0].start], *(functional.log_softmax(out[:, ways], 1) for ways in WAYS)], 1).numpy()
    with torch.no_grad():
        here, there = one_side(points, seen), one_side((points * [-1, 1])[:, MIRRORED], seen[:, MIRRORED])
    there = there[:, [0, 1, 2, 5, 6, 3, 4, 11, 12, 13, 14, 7, 8, 9, 10]] * [-1, *[1] * 14]
    mean = (here + there) / 2
    spread = np.exp(mean[:, 2].clip(-4, 1))
    return np.column_stack([np.arctan2(mean[:, 0], mean[:, 1]), spread, mean[:, TOWARDS].clip(-1, 1), -mean[:, WAYS[0].start:]])


def write_example(network, file):
    """A body of one second, of which elbow, wrist and hips are hidden for a while."""
    random = np.random.default_rng(3)
    _, points = picture.filmed(made_up_body(random)[:FPS], 0.4, 0, 4)
    seen = np.ones((FPS, 13), bool)
    seen[10:20, picture.HIPS], seen[15:, 7], seen[15:, 9], seen[:5, 3] = False, False, False, False
    points = points.round(4)
    example = {"points": points.tolist(), "seen": seen.astype(int).tolist(),
               "outputs": prediction_of(network, points, seen).tolist()}
    file.write_text(json.dumps(example, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    models = Path(__file__).resolve().parent.parent
    if sys.argv[1:] == ["example"]:
        write_example(read(models / "lift.h5"), models.parent.parent / "tests/fixtures/lift/learned_depth.json")
    else:
        write(trained(), models / "lift.h5")
