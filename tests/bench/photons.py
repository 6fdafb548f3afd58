#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Photon mapping against path tracing.

  photons.py radius [--seeds 8]       what is left of the bias as the first radius shrinks, and who errs by how much
  photons.py time   [--seeds 4]       error times time of both on curved glass and in the hotel room

The error of a mean is told by films of independent seeds: the pixels of a film share photons and wavelengths.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from adaptive import luminance
from noise_scenes import GLASS, LAMP, head, room, sphere

ROOT = pathlib.Path(__file__).resolve().parents[2]


def box():
    """A diffuse room with a ball in it."""
    return room() + sphere(-0.6, 0.6, 0.6, 0.6, 'Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]')


def glass_ball():
    """The same with a ball of glass, whose caustic of a small lamp lies on the floor."""
    return room().replace(LAMP.format(x=0.8, y=2.6, z=0.5, r=0.15, l=40), LAMP.format(x=0.8, y=2.6, z=0.5, r=0.05, l=360)) \
        + sphere(0.3, 0.9, 0.6, 0.5, GLASS)


class Bench:
    def __init__(self, folder, program):
        self.folder, self.vitrail = pathlib.Path(folder), program

    def partition(self, name, scene):
        bundle = self.folder / f"{name}.vit"
        subprocess.run([self.vitrail, "partition", scene, "-o", bundle, "--quiet", "--domains", "1"], check=True)
        return bundle

    def own(self, name, text):
        scene = self.folder / f"{name}.pbrt"
        scene.write_text(text)
        return self.partition(name, scene)

    def render(self, bundle, seed, *options):
        """Y of the pixels, seconds of processor time, and the error of the mean that the film tells of itself."""
        film, stats = self.folder / "a.film", self.folder / "a.json"
        subprocess.run([self.vitrail, "render", bundle, "-o", film, "--force", "--quiet", "--threads", "1", "--seed",
                        str(seed), "--stats", stats, *map(str, options)], check=True)
        told = json.loads(subprocess.run([self.vitrail, "inspect", film, "--json"], check=True,
                                         capture_output=True).stdout).get("shared_error", 0)
        return luminance(film)[0], json.loads(stats.read_text())["cpu_s"], told


def relmse(y, reference):
    return np.mean((y - reference) ** 2 / (reference**2 + 0.01))


def photons_of(n, radius, spp):
    return ["--integrator", "photon", "--photons", n, "--photon-radius", radius, "--spp", spp]


def radius(bench, seeds, size):
    bundle = bench.own("box", box())
    crop = ["--width", size, "--max-depth", 6]
    photons, iterations, samples = 4000, 64, 512
    paths = np.array([bench.render(bundle, 500 + s, *crop, "--spp", samples)[0] for s in range(seeds)])
    truth, truth_error = paths.mean(), paths.mean(axis=1).std(ddof=1) / math.sqrt(seeds)
    print(f"paths: mean luminance {truth:.5f} ± {100 * 1.96 * truth_error / truth:.2f} % (95 %), {seeds} films of "
          f"{samples} samples; photons: films of {iterations} × {photons}\n")
    print("| first radius | bias of the mean | ± (95 %, by seeds) | z | ± that a film tells of itself | blocks of 8×8 beyond 3 | relMSE of a film |")
    print("|---|---|---|---|---|---|---|")
    for r in (0.4, 0.2, 0.1, 0.05, 0.025):
        runs = [bench.render(bundle, s, *crop, *photons_of(photons, r, iterations)) for s in range(seeds)]
        films = np.array([y for y, _, _ in runs])
        means = films.mean(axis=1)
        bias, error = means.mean() - truth, math.hypot(means.std(ddof=1) / math.sqrt(seeds), truth_error)
        told = math.sqrt(np.mean([t * t for _, _, t in runs]) / seeds)
        print(f"| {r:g} | {100 * bias / truth:+.3f} % | {100 * 1.96 * error / truth:.3f} % | {bias / error:+.1f} | "
              f"{100 * 1.96 * math.hypot(told, truth_error / truth):.3f} % | {blocks_beyond(films, paths, size)} | "
              f"{np.mean([relmse(f, paths.mean(axis=0)) for f in films]):.2g} |", flush=True)


def blocks_beyond(films, paths, size, side=8):
    """Of blocks of pixels: how many means differ by more than chance lets 1 in 370, by films."""
    def means(all_):
        n, pixels = all_.shape
        height = pixels // size // side * side
        width = size // side * side
        cut = all_.reshape(n, pixels // size, size)[:, :height, :width]
        return cut.reshape(n, height // side, side, width // side, side).mean(axis=(2, 4)).reshape(n, -1)
    a, b = means(films), means(paths)
    error = np.sqrt(a.var(axis=0, ddof=1) / len(a) + b.var(axis=0, ddof=1) / len(b))
    t = np.abs(a.mean(axis=0) - b.mean(axis=0)) / error
    # Student's t of as many degrees of freedom as both have; its quantile by simulation, seeded.
    random = np.random.default_rng(1)
    n = len(a)
    draws = random.standard_normal((200000, 2, n))
    noise = np.abs(draws[:, 0].mean(axis=1) - draws[:, 1].mean(axis=1)) / np.sqrt(
        draws.var(axis=2, ddof=1).sum(axis=1) / n)
    return f"{int((t > np.quantile(noise, 0.9973)).sum())} of {t.size}"


def compare_time(bench, seeds, names):
    print("| scene | integrator | relMSE of a film | seconds | error × time, ratio to paths | mean luminance, of the reference's |")
    print("|---|---|---|---|---|---|")
    for name in names:
        bundle, reference_options, rows = SETUPS[name](bench)
        references = np.array([bench.render(bundle, 900 + s, *reference_options)[0] for s in range(seeds)])
        reference = references.mean(axis=0)
        own = relmse(references[0], references[1:].mean(axis=0)) * (1 - 1 / seeds) / seeds
        base = None
        for label, options in rows:
            runs = [bench.render(bundle, s, *options) for s in range(seeds)]
            films, seconds = np.array([y for y, _, _ in runs]), np.mean([t for _, t, _ in runs])
            error = max(np.mean([relmse(f, reference) for f in films]) - own, 0)
            means = films.mean(axis=1) / reference.mean()
            base = base or error * seconds
            print(f"| {name} | {label} | {error:.3g} | {seconds:.1f} | {error * seconds / base:.3g} | {means.mean():.4f} ± "
                  f"{1.96 * means.std(ddof=1) / math.sqrt(seeds):.4f} |", flush=True)


def glass_setup(bench):
    bundle = bench.own("glass ball", glass_ball())
    size = ["--width", 32, "--max-depth", 8]
    return bundle, size + photons_of(20000, 0.05, 128), [
        ("paths, 256", size + ["--spp", 256]), ("paths, 2048", size + ["--spp", 2048]),
        ("photons, 16 × 20000, radius 0.1", size + photons_of(20000, 0.1, 16)),
        ("photons, 64 × 20000, radius 0.1", size + photons_of(20000, 0.1, 64)),
        ("photons, 64 × 20000, radius 0.05", size + photons_of(20000, 0.05, 64))]


def room_setup(bench):
    folder = bench.folder / "hotel"
    subprocess.run([sys.executable, ROOT / "examples/hotel-room/generate.py", "-o", folder, "--detail", "0.1"], check=True,
                   capture_output=True)
    bundle = bench.partition("hotel room", folder / "hotel-room.pbrt")
    size = ["--width", 48]
    return bundle, size + ["--spp", 1024], [
        ("paths, 16", size + ["--spp", 16]), ("paths, 64", size + ["--spp", 64]),
        ("photons, 16 × 100000, radius 0.1", size + photons_of(100000, 0.1, 16)),
        ("photons, 64 × 100000, radius 0.1", size + photons_of(100000, 0.1, 64))]


SETUPS = {"glass ball": glass_setup, "hotel room": room_setup}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=["radius", "time"])
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--size", type=int, default=24)
    parser.add_argument("--scenes", default=",".join(SETUPS))
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(folder, a.bin / "vitrail")
        if a.what == "radius":
            radius(bench, a.seeds, a.size)
        else:
            compare_time(bench, a.seeds, a.scenes.split(","))


if __name__ == "__main__":
    main()
