#!/usr/bin/env python3
"""Trains the network by which skinning/lift tells how trunks are turned and where arms point, and writes assets/models/lift.h5.

    python3 assets/models/make/lift.py              (Debian's python3-torch and python3-h5py; about 40 minutes of one core)
    python3 assets/models/make/lift.py example      (writes what the network tells of one body, for tests/skinning/lift)

It learns from bodies that bodies.py makes up, filmed from all sides; no recorded motion is in it. The same machine gives the
same bytes every time.
"""

import json
import sys
from pathlib import Path

import h5py
import numpy as np
import torch
from torch.nn import Linear, ReLU, Sequential
from torch.nn import functional

import picture
from bodies import FPS, MIRRORED, made_up_body

STEPS = 70_000
BATCH = 512
CLIPS = 2400  # that are known at once; the oldest go as new ones come
NEW, DRAWN = 60, 240  # clips made up, and clips filmed, each round
HIDDEN = {"frame": (64, 48), "all": (256, 128)}
OUTPUTS = 11  # sine and cosine of the turn, log of its spread; of each bone how far it points to the camera; its sides' log odds


class Network(torch.nn.Module):
    """Each frame is read by itself first, by the same layers, then all together."""

    def __init__(self):
        super().__init__()
        first, second = HIDDEN["frame"]
        self.frame = Sequential(Linear(picture.ROW, first), ReLU(), Linear(first, second), ReLU())
        self.rows = len(picture.OFFSETS) * picture.ROW
        around = len(picture.USUAL) + 2 * picture.ROW
        third, fourth = HIDDEN["all"]
        self.all = Sequential(Linear(len(picture.OFFSETS) * second + around, third), ReLU(), Linear(third, fourth), ReLU(),
                              Linear(fourth, OUTPUTS))

    def forward(self, read):
        frames = self.frame(read[:, :self.rows].reshape(-1, picture.ROW))
        return self.all(torch.cat([frames.reshape(len(read), -1), read[:, self.rows:]], 1))


def turn_error(told, true):
    off = torch.atan2(told[:, 0], told[:, 1]) - true[:, 0]
    return torch.remainder(off + np.pi, 2 * np.pi) - np.pi


def loss_of(told, true):
    """The turn as of a Laplace distribution, the depths by their distance, the sides by their odds, where it is far from flat."""
    spread = told[:, 2].clamp(-4, 1)
    turn = ((turn_error(told, true).abs() + 0.01) / spread.exp() + spread).mean()
    on_the_circle = ((told[:, 0]**2 + told[:, 1]**2 - 1)**2).mean()
    depths = functional.smooth_l1_loss(told[:, 3:7], true[:, 1:], beta=0.1)
    matters = (true[:, 1:].abs() / 0.34).clamp(max=1)
    sides = functional.binary_cross_entropy_with_logits(told[:, 7:], (true[:, 1:] > 0).float(), reduction="none")
    return turn + 0.02 * on_the_circle + 4 * depths + 1.5 * (sides * matters).mean()


def examples(random, bodies):
    made = [picture.example(random, body) for body in bodies]
    return (torch.from_numpy(np.concatenate([each[part] for each in made])) for part in (0, 1))


def batches(random):
    bodies = []
    while True:
        bodies = (bodies + [made_up_body(random).astype(np.float32) for _ in range(NEW)])[-CLIPS:]
        read, true = examples(random, [bodies[i] for i in random.integers(0, len(bodies), DRAWN)])
        order = torch.from_numpy(random.permutation(len(read)))
        for part in order.split(BATCH)[:-1]:
            yield read[part], true[part]


def trained():
    torch.manual_seed(1)
    torch.set_num_threads(1)
    network = Network()
    optimiser = torch.optim.AdamW(network.parameters(), 2e-3, weight_decay=1e-4)
    slower = torch.optim.lr_scheduler.CosineAnnealingLR(optimiser, STEPS, 1e-5)
    unknown = np.random.default_rng(2)
    test_read, test_true = examples(unknown, [made_up_body(unknown) for _ in range(100)])
    for step, (read, true) in zip(range(1, STEPS + 1), batches(np.random.default_rng(1))):
        loss = loss_of(network(read), true)
        optimiser.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(network.parameters(), 1)
        optimiser.step()
        slower.step()
        if step % 2000 == 0:
            with torch.no_grad():
                told = network(test_read)
            turn = np.degrees(turn_error(told, test_true).abs().mean().item())
            far = test_true[:, 1:].abs() > 0.34
            wrong = ((told[:, 7:] > 0) != (test_true[:, 1:] > 0))[far].float().mean().item()
            print(f"{step} of {STEPS}: turn off by {turn:.1f} degrees, {100 * wrong:.1f} % of bones on the wrong side", flush=True)
    return network


def layers(network):
    """The linear layers by their names in the file."""
    for part in ("frame", "all"):
        linear = [layer for layer in getattr(network, part) if isinstance(layer, Linear)]
        for number, layer in enumerate(linear):
            yield f"{part}/{number}", layer


def write(network, file):
    with h5py.File(file, "w") as out:
        for name, layer in layers(network):
            out[f"{name}/weights"] = layer.weight.detach().numpy()
            out[f"{name}/offsets"] = layer.bias.detach().numpy()


def read(file):
    network = Network()
    with h5py.File(file) as arrays, torch.no_grad():
        for name, layer in layers(network):
            layer.weight.copy_(torch.from_numpy(arrays[f"{name}/weights"][()]))
            layer.bias.copy_(torch.from_numpy(arrays[f"{name}/offsets"][()]))
    return network


def told_of(network, points, seen):
    """(T, 10) the mean over the picture and its mirror image: turn, spread, and of each bone towards and odds."""
    with torch.no_grad():
        here = network(torch.from_numpy(picture.features(points, seen, FPS))).numpy()
        there = network(torch.from_numpy(picture.features((points * [-1, 1])[:, MIRRORED], seen[:, MIRRORED], FPS))).numpy()
    there = there[:, [0, 1, 2, 5, 6, 3, 4, 9, 10, 7, 8]] * [-1, *[1] * 10]
    mean = (here + there) / 2
    spread = np.exp(mean[:, 2].clip(-4, 1))
    return np.column_stack([np.arctan2(mean[:, 0], mean[:, 1]), spread, mean[:, 3:7].clip(-1, 1), mean[:, 7:]])


def write_example(network, file):
    """A body of one second, of which elbow, wrist and hips are hidden for a while."""
    random = np.random.default_rng(3)
    _, points = picture.filmed(made_up_body(random)[:FPS], 0.4, 0, 4)
    seen = np.ones((FPS, 13), bool)
    seen[10:20, picture.HIPS], seen[15:, 7], seen[15:, 9], seen[:5, 3] = False, False, False, False
    points = points.round(4)
    example = {"points": points.tolist(), "seen": seen.astype(int).tolist(), "told": told_of(network, points, seen).tolist()}
    file.write_text(json.dumps(example, separators=(",", ":")) + "\n")


if __name__ == "__main__":
    models = Path(__file__).resolve().parent.parent
    if sys.argv[1:] == ["example"]:
        write_example(read(models / "lift.h5"), models.parent.parent / "tests/fixtures/lift/learned_depth.json")
    else:
        write(trained(), models / "lift.h5")
