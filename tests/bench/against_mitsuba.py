#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Vitrail against Mitsuba 3: seconds to equal error, as a ratio, on scenes of the corpus.

  tests/bench/against_mitsuba.py [--bin build/release/bin] [--spp 64] [--size 256] [SCENE.xml…]

Needs `pip install mitsuba`. llvm_ad_spectral needs an LLVM that knows the processor: Debian's 14 and 15 crash on
recent ones, `apt install libllvm19` and DRJIT_LIBLLVM_PATH=/usr/lib/x86_64-linux-gnu/libLLVM-19.so do not.

Each renderer takes T seconds for a picture whose error against a long render *of its own*, with another seed, is E:
so small differences of models do not count as errors. E falls as 1/T (or faster, with a sequence), so that
1/(T·E) measures a renderer; the ratios are printed. E is the relative mean square error
mean((a − b)²/(b² + 0.01·mean(b)²)) without its greatest 0.1 %. All in one sitting, renderers in turn, medians.
Seconds of processors, not only of the wall: others may use the machine.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import mitsuba as mi
import numpy as np

from plain_scene import plain_scene

HERE = pathlib.Path(__file__).resolve().parent
CORPUS = pathlib.Path(os.environ.get("VITRAIL_CORPUS", HERE.parents[2] / "shared/corpus"))
SCENES = ["bsdf_spheres/test_arealight_path.xml", "bsdf_spheres/test_envmap_path.xml",
          "various_shapes/test_various_shapes_path.xml"]
PEERS = ["scalar_spectral", "llvm_ad_spectral"]


def relative_error(picture, reference):
    b2 = reference ** 2
    errors = np.sort(((picture - reference) ** 2 / (b2 + 0.01 * np.mean(reference) ** 2)).ravel())
    return float(np.mean(errors[: int(0.999 * errors.size)]))


def run(command):
    """Wall and processor seconds of a command and what it printed."""
    before, start = os.times(), time.time()
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    wall, after = time.time() - start, os.times()
    if done.returncode != 0:
        sys.exit(f"{command[0]}: {done.stderr}")
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    return wall, cpu, done.stdout


class Vitrail:
    name = "vitrail"

    def __init__(self, options, scene, folder):
        self.options, self.scene, self.folder = options, scene, folder
        self.bundle = folder / (scene.stem + ".vit")
        run([options.bin / "vitrail-partition", scene, "-o", self.bundle, "--quiet"])

    def render(self, source, spp, seed):
        picture, stats = self.folder / "vitrail.exr", self.folder / "stats.json"
        wall, cpu, _ = run([self.options.bin / "vitrail-render", source, "-o", picture, "--force", "--spp", spp, "--seed", seed,
                            "--threads", self.options.threads, "--progress", "none", "--stats", stats])
        bitmap = mi.Bitmap(str(picture)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False)
        return np.array(bitmap), wall, cpu, json.loads(stats.read_text())

    def reference(self, spp):
        return self.render(self.bundle, spp, 1000)[0]

    def measure(self, spp, seed):
        """From the scene file to the picture; and of the render alone, less what a render of one sample costs."""
        picture, wall, cpu, _ = self.render(self.scene, spp, seed)
        alone, least = self.render(self.bundle, spp, seed)[3], self.render(self.bundle, 1, seed)[3]
        busy = (alone["trace_s"] + alone["idle_s"]) / self.options.threads
        return picture, {"whole wall": wall, "whole cpu": cpu, "render wall": busy,
                         "render cpu": (alone["cpu_s"] - least["cpu_s"]) * spp / (spp - 1)}


class Mitsuba:
    def __init__(self, options, scene, folder, variant):
        self.options, self.scene, self.folder, self.name = options, scene, folder, variant

    def render(self, variant, spp, seed, *more):
        out = self.folder / "mitsuba.npy"
        printed = run([sys.executable, HERE / "mitsuba_timing.py", self.scene, out, "--spp", spp, "--seed", seed,
                       "--variant", variant, "--threads", self.options.threads, "--began", repr(time.time()), *more])[2]
        return np.load(out), json.loads(printed.splitlines()[-1])

    # The variants share their models; the vectorised one gets there sooner.
    def reference(self, spp):
        passes = max(1, spp // 256)
        return sum(self.render("llvm_ad_spectral", spp // passes, 1000 + i, "--once")[0] for i in range(passes)) / passes

    def measure(self, spp, seed):
        picture, t = self.render(self.name, spp, seed)
        return picture, {"whole wall": t["first_wall_s"], "whole cpu": t["first_cpu_s"],
                         "render wall": t["next_wall_s"], "render cpu": t["next_cpu_s"]}


def compare(options, source, folder):
    scene = folder / (pathlib.Path(source).stem + ".xml")
    plain_scene(source, scene, options.size, options.max_depth)
    renderers = [Vitrail(options, scene, folder)] + [Mitsuba(options, scene, folder, v) for v in options.variants]
    long = options.reference * options.spp
    own = renderers[0].reference(long)
    theirs = renderers[1].reference(long)
    print(f"\n{scene.stem}, {options.size}², {options.spp} spp, {options.threads} threads; references {long} spp, "
          f"relMSE between them {relative_error(own, theirs):.2e}")
    taken = {r.name: {} for r in renderers}
    for repetition in range(options.repetitions):
        for r in renderers:
            picture, seconds = r.measure(options.spp, 2 * repetition)
            error = relative_error(picture, own if r.name == "vitrail" else theirs)
            for key, value in {"relMSE": error, **seconds}.items():
                taken[r.name].setdefault(key, []).append(value)
    median = {name: {key: statistics.median(v) for key, v in values.items()} for name, values in taken.items()}
    for name, m in median.items():
        print(f"  {name:17}" + "".join(f" {k} {v:.3g}" for k, v in m.items()))
    for v in options.variants:
        m, ours = median[v], median["vitrail"]
        print(f"  vitrail : {v:17} error {m['relMSE'] / ours['relMSE']:.2f}×;  efficiency"
              + "".join(f" {k} {m[k] * m['relMSE'] / (ours[k] * ours['relMSE']):.2f}×" for k in ours if k != "relMSE"),
              flush=True)


def main():
    parser = argparse.ArgumentParser(description="Compares the speed of Vitrail and Mitsuba 3.")
    parser.add_argument("scenes", nargs="*", default=[CORPUS / "mitsuba-data/tests/scenes" / s for s in SCENES])
    parser.add_argument("--bin", type=pathlib.Path, default=HERE.parents[1] / "build/release/bin")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--max-depth", type=int, help="in Mitsuba's count; default as the scene says")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--reference", type=int, default=32, help="samples of the references, relative to --spp")
    parser.add_argument("--variants", nargs="+", default=PEERS)
    options = parser.parse_args()
    mi.set_variant("scalar_rgb")
    with tempfile.TemporaryDirectory() as folder:
        for source in options.scenes:
            compare(options, source, pathlib.Path(folder))


if __name__ == "__main__":
    main()
