#!/usr/bin/python3
"""Make the sample study: two spoken texts, each with gestures in two manners, and three shots for a training.

    make_samples.py [--out DIR]

Needs the Debian packages espeak-ng and python3-numpy. Same versions, same bytes.
"""

import argparse
import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "make"))

import body  # noqa: E402
import performance  # noqa: E402
import scores  # noqa: E402
import speech  # noqa: E402

FPS = 30
KEYPOINT_CLIP = ("two-ways", "expressive")


def main():
    parser = argparse.ArgumentParser(description="Make the sample study: speech, words, motion, plan.")
    parser.add_argument("--out", type=Path, default=HERE, help="folder to write to (default: this one)")
    out = parser.parse_args().out
    for name, clip in scores.CLIPS.items():
        make_clip(out, name, clip)
    for name, shot in scores.SHOTS.items():
        make_shot(out, name, shot)
    (out / "plan.json").write_text(plan_text(), encoding="utf-8")


def make_clip(out, name, clip):
    spoken = speech.speak(clip["text"], speech.Voice(), clip["lead_in"], clip["tail"])
    folder = out / "speech"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.txt").write_text(clip["text"] + "\n", encoding="utf-8")
    speech.write_wav(folder / f"{name}.wav", spoken)
    speech.write_words(folder / f"{name}.words.csv", spoken)
    for condition in scores.CONDITIONS:
        score = clip[condition](spoken.accent)
        local, root = performance.perform(score, round(spoken.duration * FPS), FPS, clip["seed"])
        (out / condition).mkdir(exist_ok=True)
        body.write_bvh(out / condition / f"{name}.bvh", local, root, FPS)
        if (name, condition) == KEYPOINT_CLIP:
            (out / "keypoints").mkdir(exist_ok=True)
            body.write_keypoints(out / "keypoints" / f"{name}.npz", local, root, FPS)


def make_shot(out, name, shot):
    count = round(scores.SHOT_SECONDS * FPS)
    local, root = performance.perform(shot(), count, FPS, scores.SHOT_SEED)
    (out / "shots").mkdir(exist_ok=True)
    body.write_bvh(out / "shots" / f"{name}.bvh", local, root, FPS)


def plan_text():
    plan = {
        "title": "Two manners of speaking with the hands",
        "layout": "pair",
        "conditions": list(scores.CONDITIONS),
        "render": {"avatar": "neutral", "scene": "upper", "size": [1280, 720], "fps": FPS},
        "clips": [
            {
                "id": name,
                "audio": f"speech/{name}.wav",
                "motion": {condition: f"{condition}/{name}.bvh" for condition in scores.CONDITIONS},
            }
            for name in scores.CLIPS
        ],
    }
    return json.dumps(plan, indent=2) + "\n"


if __name__ == "__main__":
    main()
