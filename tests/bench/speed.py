#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Vitrail against Mitsuba 3, Cycles and pbrt-v4, each at its best, and against its own intersector: writes docs/why/speed.md and its plots.

  tests/bench/speed.py [--bin build/release/bin] [--bpy VENV/bin/python] [--pbrt PBRT] [--out docs] [--size 96] [--spp 4 16 64] [SCENE…]
  tests/bench/speed.py --quick         smaller, fewer samples; prints, and writes a page only with --out

Needs `pip install mitsuba`, and libllvm19 for llvm_ad_spectral; for Cycles a Python that has `bpy` of PyPI. What is not given is left
out, and said. One thread each, start-up left out. A renderer's noise at a number of samples is that between two seeds: half the mean
of (a − b)²/(m² + 0.01·mean(m)²), m = (a + b)/2, without its greatest 0.1 %; its time the seconds of processors, not of the
wall, and the lesser of the two: others may use the machine. Renderers in turn, all pictures of a number of samples one after the other. time × noise says how
long it takes to a given error; the ratio, peer ÷ Vitrail, is above 1 where Vitrail is sooner there. Of a peer's ways (its scene's
sampler or another; adaptive or not) the one counts that has the least time × noise. Vitrail runs with its defaults.
"""
import argparse
import math
import os
import pathlib
import pickle
import re
import resource
import statistics
import subprocess
import tempfile
import time

import mitsuba as mi
import numpy as np

from speed_page import write_page
from speed_peers import WAYS_OF, Refused, Vitrail, start
from speed_scenes import ELSEWHERE, FOR_CYCLES, SCENES, of_file

HERE = pathlib.Path(__file__).resolve().parent
CORPUS = pathlib.Path(os.environ.get("VITRAIL_CORPUS", HERE.parents[2] / "shared/corpus"))
# What one may choose instead of path tracing with the usual samples, where it is for that.
WAYS = {name: {"photons": ["--integrator", "photon", "--photons"]} for name in ("box, diffuse", "box, spheres", "glass")}
WAYS |= {name: {"adaptive": ["--adaptive"]} for name in ("arealight", "envmap", "four lamps", "killeroo-simple")}
for scene in SCENES:
    WAYS.setdefault(scene, {})["one sequence"] = ["--one-sequence"]
for scene in ("Cornell of Tungsten", "hotel room", "city, 10⁶ triangles"):  # whose filters are wider than a pixel
    WAYS[scene] |= {"splat": ["--splat"], "splat, one sequence": ["--splat", "--one-sequence"]}


def noise(a, b):
    mean = (a + b) / 2
    errors = np.sort(((a - b) ** 2 / (mean ** 2 + 0.01 * np.mean(mean) ** 2)).ravel())
    return float(np.mean(errors[: int(0.999 * errors.size)])) / 2


def error(a, truth):
    """The same measure of what is between a picture and the truth."""
    errors = np.sort(((a - truth) ** 2 / (truth ** 2 + 0.01 * np.mean(truth) ** 2)).ravel())
    return float(np.mean(errors[: int(0.999 * errors.size)]))


def started(options, name, folder):
    """Renderers by name, "vitrail" first, and peer → why there is none."""
    ours, for_mitsuba = SCENES[name](options.bin, folder, CORPUS, options.size)
    renderers, refused = {"vitrail": Vitrail(options.bin, ours, folder)}, {}
    for peer in options.peers:
        try:
            renderers[peer] = start(peer, (ours, for_mitsuba, ours if name in FOR_CYCLES else None), options, folder)
        except (Refused, subprocess.CalledProcessError) as why:
            refused[peer] = str(why)
    return renderers, refused


def measure(options, name, folder):
    """(renderer, way) → [{spp, seconds, noise, mean}, …], and start-up seconds; Vitrail's way is ""."""
    renderers, refused = started(options, name, folder)
    rows = {(r, way): [] for r in renderers for way in WAYS_OF.get(r, ("",))}
    for spp in options.spp:
        taken = {key: [] for key in rows}
        for seed in (1, 2):
            for r, way in rows:
                if r in refused:
                    continue
                try:
                    taken[r, way].append(renderers[r].render(spp, seed, way))
                except Refused as why:
                    if spp == options.spp[-1]:
                        refused[r] = str(why)
        for key, pictures in taken.items():
            if len(pictures) == 2:
                (a, seconds_a), (b, seconds_b) = pictures
                rows[key].append({"spp": spp, "seconds": min(seconds_a, seconds_b), "noise": noise(a, b),
                                  "mean": float((a.mean() + b.mean()) / 2)})
    rows = {key: of for key, of in rows.items() if of and of[-1]["spp"] == options.spp[-1]}
    if "vitrail" in refused:
        raise Refused(f"Vitrail: {refused['vitrail']}")
    pixels = a.shape[0] * a.shape[1]
    ways = {} if options.quick else {way: of_way(renderers["vitrail"], renderers["llvm_ad_spectral"], words, options.spp[-1], pixels)
                                     for way, words in WAYS.get(name, {}).items()}
    for renderer in renderers.values():
        renderer.close()
    return {"pixels": pixels, "rows": rows, "ways": ways, "refused": refused,
            "start_s": {r: renderer.start_s for r, renderer in renderers.items()}}


def of_way(vitrail, mitsuba, words, spp, pixels):
    """Photons have a bias: their error is that to many paths of Mitsuba, less what is noise of those."""
    words = [*words, str(pixels)] if words[-1] == "--photons" else words
    pictures, seconds = zip(*(vitrail.render(spp, seed, options=words) for seed in (1, 2)))
    found = {"seconds": min(seconds), "noise": noise(*pictures), "mean": float(np.mean(pictures))}
    if "--photons" in words:
        halves = [sum(mitsuba.render(512, seed)[0] for seed in range(s, s + 4)) / 4 for s in (10, 20)]
        truth = (halves[0] + halves[1]) / 2
        found["error"] = sum(error(p, truth) for p in pictures) / 2 - noise(*halves) / 2
    return found


def cost(row):
    return row["seconds"] * row.get("error", row["noise"])


def best_way(result, peer):
    """At the most samples; None where the peer has not rendered it."""
    ways = {way: cost(rows[-1]) for (p, way), rows in result["rows"].items() if p == peer}
    return min(ways, key=ways.get) if ways else None


def ratio(result, peer, way=None):
    """(time × error) of the peer at its best over that of Vitrail, at the most samples; `way`: Vitrail's."""
    ours = result["ways"][way] if way else result["rows"]["vitrail", ""][-1]
    return cost(result["rows"][peer, best_way(result, peer)][-1]) / cost(ours)


def of_bench_render(options):
    """Ratios to the bare intersector and of 64 domains to 1, on a room of 1.06 million triangles."""
    printed = subprocess.run([str(options.bin / "bench_render"), "--spp", "4"], capture_output=True, text=True, check=True).stdout
    number = lambda label: float(re.search(rf"{label}\s+([\d.]+)", printed)[1])
    return {"bare": number(r"million room\s+[\d.]+\s+[\d.]+"), "domains": number("64 domains / 1 domain, CPU")}


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


def peers_of(options):
    """Those that are there, and why others are not."""
    missing = {}
    if not options.bpy:
        missing["cycles"] = "no Python with `bpy` was given (--bpy)"
    if not options.pbrt:
        missing["pbrt"] = "no pbrt-v4 was given (--pbrt)"
    return [p for p in WAYS_OF if p not in missing], missing


def said(name, result, peers):
    words = []
    for peer in ["vitrail", *peers]:
        way = best_way(result, peer)
        if way is None:
            words.append(f"{peer}: {result['refused'].get(peer, 'not measured')}")
            continue
        row = result["rows"][peer, way][-1]
        against = "" if peer == "vitrail" else f"{ratio(result, peer):.2f} ({way}) "
        words.append(f"{peer} {against}{1e9 * row['seconds'] / result['pixels'] / row['spp']:.0f} ns {row['noise']:.2e} mean {row['mean']:.4g}")
    for way, row in result["ways"].items():
        words.append(f"{way}: " + " ".join(f"{p} {ratio(result, p, way):.2f}" for p in peers if best_way(result, p) is not None))
    return f"{name:26} " + "; ".join(words)


def options_of_command():
    parser = argparse.ArgumentParser(description="Compares the speed of Vitrail, Mitsuba 3, Cycles and pbrt-v4; writes docs/why/speed.md.")
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="; ".join(SCENES))
    parser.add_argument("--also", action="append", default=[], metavar="NAME=FILE", help="a scene of pbrt or Mitsuba from elsewhere")
    parser.add_argument("--bin", type=pathlib.Path, default=HERE.parents[1] / "build/release/bin")
    parser.add_argument("--bpy", type=pathlib.Path, metavar="PYTHON", help="a Python that has PyPI's bpy, for Cycles")
    parser.add_argument("--pbrt", type=pathlib.Path, help="the program of pbrt-v4")
    parser.add_argument("--out", type=pathlib.Path, help="the folder of why/speed.md and images/; default: docs, and nowhere with --quick")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FILE", help="what was measured goes there, too")
    parser.add_argument("--kept", type=pathlib.Path, metavar="FILE", help="write the page of what --keep kept, and measure nothing")
    parser.add_argument("--quick", action="store_true", help="64 pixels, 4 and 16 samples, and nothing but the table")
    parser.add_argument("--size", type=int, help="of the pictures, in pixels; default 96")
    parser.add_argument("--spp", type=int, nargs="+", help="default 4 16 64; the last one decides; powers of 4 suit all samplers")
    options = parser.parse_args()
    options.bin = options.bin.resolve()
    for word in ("bpy", "pbrt"):  # a virtual environment is known by its link
        if program := getattr(options, word):
            setattr(options, word, program.absolute())
            if not program.is_file():
                parser.error(f"--{word}: there is no {program}")
    options.size = options.size or (64 if options.quick else 96)
    options.spp = options.spp or ([4, 16] if options.quick else [4, 16, 64])
    options.out = options.out or (None if options.quick else HERE.parents[1] / "docs")
    for name, file in (word.split("=", 1) for word in options.also):
        SCENES[name] = of_file(pathlib.Path(file).resolve())
    options.scenes = options.scenes or list(SCENES)
    options.peers, options.missing = peers_of(options)
    return options


def main():
    options = options_of_command()
    if options.kept:  # that of the command says where to
        of_then, *measured = pickle.loads(options.kept.read_bytes())
        of_then.out = options.out
        return write_page(of_then, *measured)
    mi.set_variant("scalar_rgb")
    began, results, absent = time.time(), {}, {name: "not in the corpus" for name in ELSEWHERE if name not in SCENES}
    for peer, why in options.missing.items():
        print(f"{peer}: left out, {why}")
    with tempfile.TemporaryDirectory() as temporary:
        for i, name in enumerate(options.scenes):
            folder = pathlib.Path(temporary) / str(i)
            folder.mkdir()
            try:
                results[name] = measure(options, name, folder)
            except (OSError, subprocess.CalledProcessError, Refused) as why:
                absent[name] = str(why)
                print(f"{name}: left out, {why}", flush=True)
                continue
            print(said(name, results[name], options.peers), flush=True)
        own = {} if options.quick else of_bench_render(options) | {
            f"start_{k}": v for k, v in start_seconds(options, pathlib.Path(temporary)).items()}
    ratios = {p: {name: ratio(result, p) for name, result in results.items() if best_way(result, p) is not None} for p in options.peers}
    by_ways = {p: {(name, way): ratio(results[name], p, way) for name in of for way in results[name]["ways"]} for p, of in ratios.items()}
    for p, of in ratios.items():
        if of:
            print(f"geometric mean, {p}: {math.prod(of.values()) ** (1 / len(of)):.2f} of {len(of)} scenes; lost: "
                  + ("; ".join(name for name, r in of.items() if r < 1) or "none"))
    seconds = time.time() - began
    print(", ".join(f"{k} {v:.3g}" for k, v in own.items()), f"{seconds:.0f} s in all")
    if options.out and results:
        best = {name: {p: best_way(result, p) for p in options.peers} for name, result in results.items()}
        found = {"results": results, "best": best, "ratios": ratios, "by_ways": by_ways, "absent": absent, "own": own}
        if options.keep:
            options.keep.write_bytes(pickle.dumps((options, found, seconds, mi.__version__)))
        write_page(options, found, seconds, mi.__version__)


if __name__ == "__main__":
    main()
