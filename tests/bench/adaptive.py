#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What samples where they are needed gain, and whether --target-error keeps what it says.

  adaptive.py gain   [--seeds 30] [--spp 64]     --adaptive against uniform: errors, cost, means
  adaptive.py target [--seeds 50]                the true error against the one asked for
  adaptive.py target --short                     of two scenes and 12 seeds
  adaptive.py presets [--seeds 2]                what root mean square the presets of --quality are to ask for
  adaptive.py quality [--seeds 3]                what they take and give

Errors are of luminance, (Y - Y')²/(Y'² + 0.01), against the mean of the other seeds' films.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from noise_scenes import SCENES


def luminance(film, imaging_ratio_at=40):
    """Y of each pixel and its samples, of a film without layers, bins or clamp."""
    data = film.read_bytes()
    header = np.frombuffer(data[:184], dtype="<i4")
    width, height = header[6] - header[5], header[8] - header[7]
    ratio = np.frombuffer(data[imaging_ratio_at:imaging_ratio_at + 8], dtype="<f8")[0]
    items, exponent = np.frombuffer(data[80:88], dtype="<u8")[0], header[33]
    ends, about = header[40], header[41]
    of_photons = header[2] == 7
    at = 184 + (32 if of_photons else 0) + 4 * ends + 8 + about + 8 + 8 * ((int(items) + 63) // 64) + 8
    pixels = width * height
    halves = np.frombuffer(data[at:at + 4 * pixels * 16], dtype="<u8").reshape(4, pixels, 2).astype(np.float64)
    signed = np.where(halves[..., 1] >= 2.0**63, halves[..., 1] - 2.0**64, halves[..., 1])
    sums = (halves[..., 0] + signed * 2.0**64) * 2.0**float(exponent)
    at += 4 * pixels * 16 + (64 * 16 if of_photons else 0) + 8
    counts = np.frombuffer(data[at:at + 2 * pixels * 4], dtype="<u4").reshape(2, pixels).sum(axis=0)
    return ratio * (sums[2] + sums[3]) / counts, counts


class Bench:
    def __init__(self, program, folder):
        self.vitrail, self.folder = program, pathlib.Path(folder)

    def bundle(self, name):
        scene, bundle = self.folder / f"{name}.pbrt", self.folder / f"{name}.vit"
        scene.write_text(SCENES[name]())
        subprocess.run([self.vitrail, "partition", scene, "-o", bundle, "--quiet", "--domains", "1"], check=True)
        return bundle

    def render(self, bundle, seed, *options):
        film, stats = self.folder / "a.film", self.folder / "a.json"
        subprocess.run([self.vitrail, "render", bundle, "-o", film, "--force", "--quiet", "--threads", "1", "--seed",
                        str(seed), "--stats", stats, *options], check=True)
        y, counts = luminance(film)
        return y, counts, json.loads(stats.read_text())


def errors_of(films):
    """Of each film against the mean of the others."""
    films = np.array(films)
    total, n = films.sum(axis=0), len(films)
    return np.array([np.mean((f - r) ** 2 / (r * r + 0.01)) for f in films for r in [(total - f) / (n - 1)]])


def gain(bench, names, seeds, spp):
    print("| scene | relMSE uniform | adaptive | error ratio | rays, adaptive/uniform | efficiency by rays | by seconds "
          "of tracing | means: adaptive/uniform | z | worst block's z |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name in names:
        bundle = bench.bundle(name)
        films, rays, seconds = {False: [], True: []}, {False: 0, True: 0}, {False: 0.0, True: 0.0}
        for seed in range(seeds):
            for adaptive in (False, True):
                y, _, s = bench.render(bundle, seed + (1000 if adaptive else 0), "--spp", str(spp),
                                       *(["--adaptive"] if adaptive else []))
                films[adaptive].append(y)
                rays[adaptive] += s["rays_camera"] + s["rays_indirect"] + s["rays_shadow"]
                seconds[adaptive] += s["trace_s"]
        error = {a: errors_of(films[a]).mean() for a in films}
        means = {a: np.array(films[a]).mean(axis=1) for a in films}
        difference = means[True].mean() - means[False].mean()
        z = difference / math.sqrt(sum(m.var(ddof=1) / seeds for m in means.values()))
        blocks = [np.array(films[a]).reshape(seeds, 6, 8, 8, 8).mean(axis=(2, 4)).reshape(seeds, 48) for a in (True, False)]
        scatter = np.sqrt(sum(b.var(axis=0, ddof=1) for b in blocks) / seeds)
        known = scatter > 0
        block_z = np.abs((blocks[0].mean(axis=0) - blocks[1].mean(axis=0))[known] / scatter[known]).max()
        ratio, cost, time = error[False] / error[True], rays[True] / rays[False], seconds[True] / seconds[False]
        print(f"| {name} | {error[False]:.3g} | {error[True]:.3g} | {ratio:.2f} | {cost:.2f} | **{ratio / cost:.2f}** | "
              f"{ratio / time:.2f} | {means[True].mean() / means[False].mean():.4f} | {z:+.1f} | {block_z:.1f} |", flush=True)


# Targets that take some tens of samples a pixel.
TARGETS = {"toy": 6e-5, "sky": 2e-4, "glossy": 2e-5, "room": 1.5e-2, "hall": 6e-2, "caustic": 1e-2, "lamp": 3e-4,
           "defocus": 1.0}


def target(bench, names, seeds, options):
    print("| scene | E | samples a pixel | true error/E: median | least | greatest | below E | above E/3 |")
    print("|---|---|---|---|---|---|---|---|")
    within = True
    for name in names:
        bundle, asked = bench.bundle(name), TARGETS[name]
        films, samples = [], []
        for seed in range(seeds):
            y, counts, s = bench.render(bundle, seed, "--target-error", str(asked), *options)
            films.append(y), samples.append(counts.mean())
        # The reference has a variance of its own, 1/(n - 1) of a film's.
        ratio = errors_of(films) / asked * (1 - 1 / seeds)
        below, above = np.mean(ratio < 1), np.mean(ratio > 1 / 3)
        within &= below >= 0.9 and above >= 0.9
        print(f"| {name} | {asked:g} | {np.mean(samples):.0f} | {np.median(ratio):.2f} | {ratio.min():.2f} | "
              f"{ratio.max():.2f} | {100 * below:.0f} % | {100 * above:.0f} % |", flush=True)
    return within


def lightness(y):
    y = np.clip(y, 0, 1)
    return np.where(y > 216 / 24389, 116 * np.cbrt(y) - 16, y * 24389 / 27)


# What a quality promises: this share of the pixels is within so many just noticeable differences.
PROMISES = {"draft": (0.75, 4), "good": (0.95, 2), "final": (0.99, 1)}


def rms_of_promise(seen, share, most):
    """The greatest root mean square at which `share` of the pixels keeps within `most`; inf where any. `seen`: the differences of each
    rung. Where none of them keeps it, all differences of the last are scaled until they do."""
    rms = [math.sqrt(np.mean(np.square(s))) for s in seen]
    needed = [r * most / max(np.quantile(s, share), 1e-9) for r, s in zip(rms, seen)]
    kept = [i for i, (r, n) in enumerate(zip(rms, needed)) if r <= n]
    if not kept:
        return needed[-1]
    # Between the two rungs about it, on logarithms, where the excess r/n is 1.
    first = kept[0]
    if first == 0:
        return math.inf
    over, under = (math.log(rms[i] / needed[i]) for i in (first - 1, first))
    return math.exp(math.log(rms[first - 1]) + over / (over - under) * math.log(rms[first] / rms[first - 1]))


def presets(bench, names, seeds):
    """Of uniform films of 2 to 512 samples a pixel, against one of 2048, whose own noise is taken off as the share that it has."""
    rungs, most_samples = (2, 4, 8, 16, 32, 64, 128, 256, 512), 2048
    print("| scene | rms of 2 samples | of 512 | " + " | ".join(f"{q}: {100 * s:.0f} % within {d}" for q, (s, d) in PROMISES.items()) + " |")
    print("|---" * (len(PROMISES) + 3) + "|", flush=True)
    found = {q: [] for q in PROMISES}
    for name in names:
        bundle = bench.bundle(name)
        reference = lightness(bench.render(bundle, 9999, "--spp", str(most_samples))[0])
        seen = [[np.abs(lightness(bench.render(bundle, seed, "--spp", str(n))[0]) - reference) / 2.3 / math.sqrt(1 + n / most_samples)
                 for seed in range(seeds)] for n in rungs]
        for q, (share, most) in PROMISES.items():
            found[q].append(rms_of_promise(seen, share, most))
        first, last = (math.sqrt(np.mean(np.square(seen[i]))) for i in (0, -1))
        print(f"| {name} | {first:.2f} | {last:.2f} | " + " | ".join(f"{found[q][-1]:.2f}" for q in PROMISES) + " |", flush=True)
    # Of the scenes where noise breaks a promise at all.
    broken = {q: sorted(f for f in found[q] if f < math.inf) or [math.inf] for q in PROMISES}
    print("| **kept in three of four** | | | " + " | ".join(f"**{b[len(b) // 4]:.2f}**" for b in broken.values()) + " |")


def quality(bench, names, seeds):
    print("| scene | quality | samples a pixel | seconds of tracing | relMSE | just noticeable differences, rms | of pixels above 2 |")
    print("|---|---|---|---|---|---|---|")
    for name in names:
        bundle = bench.bundle(name)
        films = {q: [bench.render(bundle, seed, "--quality", q) for seed in range(seeds)] for q in ("draft", "good", "final")}
        for q, runs in films.items():
            others = films["final"]
            relative, seen, much = [], [], []
            for i, (y, _, _) in enumerate(runs):
                reference = np.mean([o[0] for j, o in enumerate(others) if j != i], axis=0)
                differences = np.abs(lightness(y) - lightness(reference)) / 2.3
                relative.append(np.mean((y - reference) ** 2 / (reference**2 + 0.01)))
                seen.append(np.sqrt(np.mean(differences**2)))
                much.append(np.mean(differences > 2))
            samples = np.mean([c.mean() for _, c, _ in runs])
            seconds = np.mean([s["trace_s"] for _, _, s in runs])
            print(f"| {name} | {q} | {samples:.0f} | {seconds:.2f} | {np.mean(relative):.2g} | {np.mean(seen):.2f} | "
                  f"{100 * np.mean(much):.1f} % |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("gain", "target", "presets", "quality"))
    parser.add_argument("--vitrail", default=str(pathlib.Path(__file__).parents[2] / "build/release/bin/vitrail"))
    parser.add_argument("--scenes", help="names, separated by commas")
    parser.add_argument("--seeds", type=int)
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--adaptive", action="store_true", help="target: with adaptive rounds")
    parser.add_argument("--short", action="store_true")
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(a.vitrail, folder)
        if a.what == "gain":
            gain(bench, a.scenes.split(",") if a.scenes else SCENES, a.seeds or 30, a.spp)
            return 0
        if a.what == "presets":
            presets(bench, a.scenes.split(",") if a.scenes else SCENES, a.seeds or 2)
            return 0
        if a.what == "quality":
            quality(bench, a.scenes.split(",") if a.scenes else SCENES, a.seeds or 3)
            return 0
        names = a.scenes.split(",") if a.scenes else ("toy", "sky") if a.short else TARGETS
        within = target(bench, names, a.seeds or (12 if a.short else 50), ["--adaptive"] if a.adaptive else [])
        return 0 if within else 1


if __name__ == "__main__":
    sys.exit(main())
