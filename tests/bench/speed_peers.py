# SPDX-License-Identifier: Apache-2.0
"""The renderers that speed.py compares, each started with one scene, in one thread. `render(spp, seed, way)` gives a picture (height ×
width × 3, linear sRGB) and the seconds of processors that its samples took, start-up left out; `start_s` is that start-up."""
import json
import pathlib
import resource
import statistics
import subprocess
import sys

import mitsuba as mi
import numpy as np

from plain_scene import with_samplers

HERE = pathlib.Path(__file__).resolve().parent
# A peer's ways: what of its own one may choose for a scene. Its best is what Vitrail is compared with.
WAYS_OF = {"llvm_ad_spectral": ("its sampler", "multijitter"), "llvm_ad_rgb": ("its sampler", "multijitter"), "scalar_spectral": ("its sampler", "multijitter"),
           "cycles": ("adaptive", "uniform"), "pbrt": ("zsobol",)}
LONGEST_START_S = 60  # of a kernel: it would be made for each number of samples and each sampler


class Refused(Exception):
    """This peer cannot be given this scene, and why."""


def of_file(picture):
    return np.array(mi.Bitmap(str(picture)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False))


def without_start(seconds, start_s, spp):
    """The seconds of a render of one sample, most of which is start-up, are left out and made up for."""
    if seconds <= start_s:
        raise Refused("its start-up hides what so few samples take")
    return (seconds - start_s) * spp / (spp - 1)


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

    def render(self, spp, seed, way="", options=()):
        seconds = without_start(self.cpu(spp, seed, options), self.start_s, spp)
        return of_file(self.folder / "vitrail.exr"), seconds

    def close(self):
        pass


class Served:
    """A process that is asked for one picture after the other: mitsuba_timing.py, cycles_timing.py."""

    def __init__(self, words):
        self.process = subprocess.Popen([str(w) for w in words], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        self.start_s = self.number()

    def number(self):
        line = self.process.stdout.readline()
        if not line:
            said = self.process.stderr.read().strip().splitlines()
            self.process.wait()
            raise Refused(said[-1] if said else f"it ended with {self.process.returncode}")
        return float(line)

    def ask(self, *words):
        try:
            print(*words, file=self.process.stdin, flush=True)
        except BrokenPipeError as why:
            raise Refused("it has died") from why
        return self.number()

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Mitsuba(Served):
    """One process for all samplers: a sensor each."""

    def __init__(self, scene, folder, variant):
        self.out, self.warm, self.ways = folder / "mitsuba.npy", set(), WAYS_OF[variant]
        both = with_samplers(scene, scene.with_name(f"{scene.stem}-samplers.xml"), self.ways[1:])
        super().__init__([sys.executable, HERE / "mitsuba_timing.py", both, variant])
        first = self.ask(0, 1, 99, self.out)
        if first > LONGEST_START_S:
            self.close()
            raise Refused(f"its first picture of one sample takes {first:.0f} s")
        self.start_s += first
        self.each_s = statistics.median(self.ask(0, 1, 99, self.out) for _ in range(5))

    def render(self, spp, seed, way="its sampler"):
        asked = (self.ways.index(way), spp)
        if asked not in self.warm:  # its kernels are made with the first picture of so many samples
            self.warm.add(asked)
            self.start_s += self.ask(*asked, 99, self.out)
        seconds = without_start(self.ask(*asked, seed, self.out), self.each_s, spp)
        return np.load(self.out), seconds


class Cycles(Served):
    def __init__(self, scene, folder, python):
        self.out = folder / "cycles.exr"
        super().__init__([python, HERE / "cycles_timing.py", scene])
        self.start_s += self.ask("adaptive", 1, 99, self.out)  # its tree of volumes, which it keeps
        self.each_s = statistics.median(self.ask("adaptive", 1, 99, self.out) for _ in range(5))

    def render(self, spp, seed, way):
        seconds = without_start(self.ask(way, spp, seed, self.out), self.each_s, spp)
        return of_file(self.out), seconds


class Pbrt:
    def __init__(self, programs, scene, folder, pbrt):
        self.pbrt, self.scene, self.out = pbrt, folder / "for-pbrt" / "scene.pbrt", folder / "pbrt.exr"
        self.scene.parent.mkdir(exist_ok=True)
        subprocess.run([str(programs / "vitrail-convert"), str(scene), str(self.scene), "--quiet"], check=True)
        self.start_s = statistics.median(self.cpu(1, 99) for _ in range(3))

    def cpu(self, spp, seed):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([str(self.pbrt), "--quiet", "--nthreads", "1", "--spp", str(spp), "--seed", str(seed), "--outfile",
                               str(self.out), str(self.scene)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            raise Refused(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"it ended with {done.returncode}")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def render(self, spp, seed, way):
        seconds = without_start(self.cpu(spp, seed), self.start_s, spp)
        return of_file(self.out), seconds

    def close(self):
        pass


def start(peer, handed, options, folder):
    """`handed`: the files for Vitrail, Mitsuba and Cycles; the last may be None. Throws Refused."""
    ours, for_mitsuba, for_cycles = handed
    if peer == "pbrt":
        return Pbrt(options.bin, ours, folder, options.pbrt)
    if peer != "cycles":
        return Mitsuba(for_mitsuba, folder, peer)
    if for_cycles is None:
        raise Refused("cycles_timing.py does not build it")
    return Cycles(for_cycles, folder, options.bpy)
