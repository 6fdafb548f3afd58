#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Vitrail against Mitsuba 3, and against its own intersector: writes docs/speed.md and its plots.

  tests/bench/speed.py [--bin build/release/bin] [--out docs] [--size 192] [SCENE…] [--spp 4 16 64]

Needs `pip install mitsuba`, and libllvm19 for llvm_ad_spectral. One thread each, start-up left out. A renderer's noise at a number
of samples is that between two seeds: half the mean of (a − b)²/(m² + 0.01·mean(m)²), m = (a + b)/2, without its greatest
0.1 %; its time the seconds of processors, not of the wall: others may use the machine. Renderers in turn, all pictures of a
number of samples one after the other. time × noise says how long it takes to a given error; the ratio, peer ÷
Vitrail, is above 1 where Vitrail is sooner there.
"""
import argparse
import json
import math
import os
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time

import mitsuba as mi
import numpy as np

from speed_page import write_page
from speed_scenes import SCENES

HERE = pathlib.Path(__file__).resolve().parent
CORPUS = pathlib.Path(os.environ.get("VITRAIL_CORPUS", HERE.parents[2] / "shared/corpus"))
PEERS = ["llvm_ad_spectral", "scalar_spectral"]
# What one may choose instead of path tracing with the usual samples, where it is for that.
WAYS = {name: {"photons": ["--integrator", "photon", "--photons"]} for name in ("box, diffuse", "box, spheres", "glass")}
WAYS |= {name: {"adaptive": ["--adaptive"]} for name in ("arealight", "envmap", "four lamps", "killeroo-simple")}
WAYS["hotel room"] = {"splat": ["--splat"]}


def noise(a, b):
    mean = (a + b) / 2
    errors = np.sort(((a - b) ** 2 / (mean ** 2 + 0.01 * np.mean(mean) ** 2)).ravel())
    return float(np.mean(errors[: int(0.999 * errors.size)])) / 2


def error(a, truth):
    """The same measure of what is between a picture and the truth."""
    errors = np.sort(((a - truth) ** 2 / (truth ** 2 + 0.01 * np.mean(truth) ** 2)).ravel())
    return float(np.mean(errors[: int(0.999 * errors.size)]))


class Vitrail:
    def __init__(self, programs, scene, folder):
        self.programs, self.folder, self.bundle = programs, folder, folder / "scene.vit"
        subprocess.run([str(programs / "vitrail-partition"), str(scene), "-o", str(self.bundle), "--quiet", "--force"], check=True)
        self.start_s = statistics.median(self.cpu(1, 0) for _ in range(3))

    def cpu(self, spp, seed, options=()):
        picture, stats = self.folder / "vitrail.exr", self.folder / "stats.json"
        subprocess.run([str(self.programs / "vitrail-render"), str(self.bundle), "-o", str(picture), "--force", "--spp", str(spp),
                        "--seed", str(seed), "--threads", "1", "--progress", "none", "--quiet", "--stats", str(stats), *options], check=True)
        return json.loads(stats.read_text())["cpu_s"]

    def render(self, spp, seed, options=()):
        """The seconds of a render of one sample, most of which is start-up, are left out and made up for."""
        seconds = (self.cpu(spp, seed, options) - self.start_s) * spp / (spp - 1)
        bitmap = mi.Bitmap(str(self.folder / "vitrail.exr")).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
        return np.array(bitmap), seconds

    def close(self):
        pass


class Mitsuba:
    def __init__(self, scene, folder, variant):
        self.folder = folder
        self.process = subprocess.Popen([sys.executable, str(HERE / "mitsuba_timing.py"), str(scene), variant],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.start_s = float(self.process.stdout.readline())
        self.warm = set()

    def render(self, spp, seed):
        out = self.folder / "mitsuba.npy"

        def ask(seed):
            print(spp, seed, out, file=self.process.stdin, flush=True)
            return float(self.process.stdout.readline())
        if spp not in self.warm:
            self.warm.add(spp)
            self.start_s += ask(99)
        seconds = ask(seed)
        return np.load(out), seconds

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def measure(options, name, folder):
    """Renderer → [{spp, seconds, noise, mean}, …], and start-up seconds."""
    ours, theirs = SCENES[name](options.bin, folder, CORPUS, options.size)
    renderers = {"vitrail": Vitrail(options.bin, ours, folder)} | {v: Mitsuba(theirs, folder, v) for v in PEERS}
    rows = {r: [] for r in renderers}
    for spp in options.spp:
        taken = {r: [] for r in renderers}
        for seed in (1, 2):
            for r, renderer in renderers.items():
                taken[r].append(renderer.render(spp, seed))
        for r, ((a, seconds_a), (b, seconds_b)) in taken.items():
            rows[r].append({"spp": spp, "seconds": (seconds_a + seconds_b) / 2, "noise": noise(a, b),
                            "mean": float((a.mean() + b.mean()) / 2)})
    pixels = a.shape[0] * a.shape[1]
    ways = {way: of_way(renderers, words, options.spp[-1], pixels) for way, words in WAYS.get(name, {}).items()}
    for renderer in renderers.values():
        renderer.close()
    return {"pixels": pixels, "rows": rows, "ways": ways, "start_s": {r: renderer.start_s for r, renderer in renderers.items()}}


def of_way(renderers, words, spp, pixels):
    """Photons have a bias: their error is that to many paths of Mitsuba, less what is noise of those."""
    words = [*words, str(pixels)] if words[-1] == "--photons" else words
    pictures, seconds = zip(*(renderers["vitrail"].render(spp, seed, words) for seed in (1, 2)))
    found = {"seconds": sum(seconds) / 2, "noise": noise(*pictures), "mean": float(np.mean(pictures))}
    if "--photons" in words:
        halves = [sum(renderers["llvm_ad_spectral"].render(512, seed)[0] for seed in range(s, s + 4)) / 4 for s in (10, 20)]
        truth = (halves[0] + halves[1]) / 2
        found["error"] = sum(error(p, truth) for p in pictures) / 2 - noise(*halves) / 2
    return found


def ratio(result, peer, way=None):
    """(time × error) of the peer over that of Vitrail, at the most samples."""
    cost = lambda row: row["seconds"] * row.get("error", row["noise"])
    return cost(result["rows"][peer][-1]) / cost(result["ways"][way] if way else result["rows"]["vitrail"][-1])


def of_bench_render(options):
    """Ratios to the bare intersector and of 64 domains to 1, on a room of 1.06 million triangles."""
    printed = subprocess.run([str(options.bin / "bench_render"), "--spp", "4"], capture_output=True, text=True, check=True).stdout
    number = lambda label: float(re.search(rf"{label}\s+([\d.]+)", printed)[1])
    return {"bare": number("ratio"), "domains": number("64 domains / 1 domain, CPU")}


def start_seconds(options, folder):
    """Of processors: a render of one pixel, from the scene file and from its bundle."""
    source, _ = SCENES["box, diffuse"](options.bin, folder, CORPUS, options.size)
    program = lambda verb, *more: subprocess.run([str(options.bin / f"vitrail-{verb}"), *map(str, more), "--quiet"], check=True)
    program("partition", source, "-o", folder / "start.vit", "--force")

    def once(what):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        program("render", what, "-o", folder / "start.film", "--force", "--spp", 1, "--crop", "0,1,0,1", "--threads", 1,
                "--progress", "none")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {kind: statistics.median(once(what) for _ in range(5))
            for kind, what in (("scene", source), ("bundle", folder / "start.vit"))}


def main():
    parser = argparse.ArgumentParser(description="Compares the speed of Vitrail and Mitsuba 3; writes docs/speed.md.")
    parser.add_argument("scenes", nargs="*", default=list(SCENES), metavar="SCENE", help=", ".join(SCENES))
    parser.add_argument("--bin", type=pathlib.Path, default=HERE.parents[1] / "build/release/bin")
    parser.add_argument("--out", type=pathlib.Path, default=HERE.parents[1] / "docs")
    parser.add_argument("--size", type=int, default=96, help="of the pictures, in pixels")
    parser.add_argument("--spp", type=int, nargs="+", default=[4, 16, 64], help="the last one decides")
    options = parser.parse_args()
    options.bin = options.bin.resolve()
    mi.set_variant("scalar_rgb")
    began, results = time.time(), {}
    with tempfile.TemporaryDirectory() as temporary:
        for i, name in enumerate(options.scenes):
            folder = pathlib.Path(temporary) / str(i)
            folder.mkdir()
            results[name] = measure(options, name, folder)
            last = {r: rows[-1] for r, rows in results[name]["rows"].items()}
            for way, row in results[name]["ways"].items():
                print(f"{name}, {way}:" + "".join(f"  {p} {ratio(results[name], p, way):5.2f}" for p in PEERS)
                      + f"  {1e9 * row['seconds'] / results[name]['pixels'] / last['vitrail']['spp']:.0f} ns {row}", flush=True)
            print(f"{name:26}" + "".join(f"  {p} {ratio(results[name], p):5.2f}" for p in PEERS) + "  "
                  + "  ".join(f"{r} {1e9 * row['seconds'] / results[name]['pixels'] / row['spp']:.0f} ns {row['noise']:.2e}"
                              f" mean {row['mean']:.4g}" for r, row in last.items()), flush=True)
        own = of_bench_render(options) | {f"start_{k}": v for k, v in start_seconds(options, pathlib.Path(temporary)).items()}
    ratios = {p: {name: ratio(result, p) for name, result in results.items()} for p in PEERS}
    by_ways = {p: {(name, way): ratio(result, p, way) for name, result in results.items() for way in result["ways"]} for p in PEERS}
    for p in PEERS:
        print(f"geometric mean, {p}: {math.prod(ratios[p].values()) ** (1 / len(results)):.2f}")
    seconds = time.time() - began
    print(", ".join(f"{k} {v:.3g}" for k, v in own.items()), f"; {seconds:.0f} s in all")
    write_page(options.out, options, results, ratios, by_ways, own, seconds, mi.__version__)


if __name__ == "__main__":
    main()
