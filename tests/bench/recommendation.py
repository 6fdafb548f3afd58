#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Is what `vitrail measure` recommends nearly the best? On scenes that nothing else was tuned on, it recommends from few samples for
errors and times; then every combination of the same axes is measured with other seeds, more of them, more samples and a longer
reference, and says what the best would have been, whatever its bias. Prints a line a goal, and fails where one is worse than --within times the best.

    tests/bench/recommendation.py --bin build/release/bin            # minutes
    tests/bench/recommendation.py --bin build/release/bin --short    # seconds: only that it recommends what the truth knows

CPU seconds are part of every ratio, so that a busy machine spoils them: --short says them and does not judge them.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import speed_scenes

SCENES = {"box, diffuse": speed_scenes.cornell_diffuse, "glass": speed_scenes.glass, "four lamps": speed_scenes.four_lamps}


def measure(options, scene, folder, *words):
    subprocess.run([options.bin / "vitrail", "measure", scene, "-o", folder, "--width", str(options.size), "--axes", options.axes,
                    "--quiet", "--ranks", "0", "--bias", "10", *map(str, words)], check=True, stderr=subprocess.DEVNULL)
    return json.loads((folder / "measure.json").read_text())


class Truth:
    """What the exhaustive search knows: error and time of each setting at any count of samples."""

    def __init__(self, page):
        self.slope, self.start = page["noise_slope"], page["start_cpu_s"]
        self.known = {tuple(s["setting"]): s for s in page["settings"] if not s["failure"]}

    def bias(self, s):
        return s["bias"]["value"] if s["biased"] else 0

    def cost(self, s, error):
        left = error - self.bias(s)
        if left <= 0:
            return float("inf")
        return self.start + s["cpu_s_per_sample"] * max(1, s["spp"] * (max(s["noise"]["value"], 0) / left) ** (1 / self.slope))

    def error(self, s, seconds=None, spp=None):
        spp = spp or (seconds - self.start) / s["cpu_s_per_sample"]
        return self.bias(s) + max(s["noise"]["value"], 0) * (spp / s["spp"]) ** -self.slope if spp >= 1 else float("inf")


def setting_of(page, recommendation):
    return next(tuple(s["setting"]) for s in page["settings"] if s["name"] == recommendation["name"])


def goals(page):
    """Errors from what a picture of the scene's own setting has to a tenth of it; times of 8 and 64 samples of it."""
    own = page["settings"][0]
    error, each = own["relmse"]["value"], own["cpu_s_per_sample"]
    return [("--error", error / 2), ("--error", error / 10), *[("--seconds", (page["start_cpu_s"] + n * each)) for n in (8, 64)]]


def judged(options, name, make, folder):
    scene = folder / "scene.xml"
    scene.write_text(make(folder, options.size))
    few = ["--seeds", 4, "--spp", 4, "--reference-spp", 64]
    page = measure(options, scene, folder / "few", *few)
    truth = Truth(measure(options, scene, folder / "all", "--every-combination", "--first-seed", 101, "--seeds", options.seeds,
                          "--spp", options.spp, "--reference-spp", 8 * options.seeds * options.spp))
    worst = 1
    for option, goal in goals(page):
        # --seconds are of the clock: as many as there are CPU seconds at the rate that was measured.
        given = goal if option == "--error" else goal / page["parallelism"]
        answer = measure(options, scene, folder / "few", *few, option, given)
        recommended = answer["recommendations"][0]
        mine = truth.known.get(setting_of(answer, recommended)) if recommended["found"] else None
        if mine is None:
            sys.exit(f"{name}: {option} {goal:.3g}: nothing is recommended that the truth knows: {recommended['words']}")
        if option == "--error":
            best = min(truth.known.values(), key=lambda s: truth.cost(s, goal))
            ratio = truth.cost(mine, goal) / truth.cost(best, goal)
            reached = truth.error(mine, spp=recommended["spp"]) / goal
        else:
            best = min(truth.known.values(), key=lambda s: truth.error(s, goal))
            ratio = truth.error(mine, goal) / truth.error(best, goal)
            reached = truth.error(mine, spp=recommended["spp"]) / recommended["relmse"]
        worst = max(worst, ratio)
        print(f"{name:14}{option} {goal:<9.3g} recommended {recommended['name']:28} best {best['name']:28} {ratio:5.2f} times the best; "
              f"error {reached:.2f} times what was said", flush=True)
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--axes", default="depth,clamp")
    parser.add_argument("--size", type=int, default=64)
    parser.add_argument("--seeds", type=int, default=6)
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--within", type=float, default=1.3)
    parser.add_argument("--short", action="store_true", help="one scene, small, not judged")
    options = parser.parse_args()
    scenes = dict(SCENES)
    if options.short:
        options.size, options.axes = 24, "integrator"
        scenes = {"box, diffuse": speed_scenes.cornell_diffuse}
    worst = 1
    for name, make in scenes.items():
        with tempfile.TemporaryDirectory() as folder:
            worst = max(worst, judged(options, name, make, pathlib.Path(folder)))
    print(f"at worst {worst:.2f} times the best")
    sys.exit(0 if options.short or worst <= options.within else 1)


if __name__ == "__main__":
    main()
