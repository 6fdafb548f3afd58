#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One process of Mitsuba 3: renders a scene twice with different seeds and says what each took.

mitsuba_timing.py SCENE.xml OUT.npy --spp N --variant V --seed S --threads T --began TIME

The first picture includes all that a process starts with, kernels too where the disk does not have them yet; the
second, which is written to OUT.npy (float32, height × width × (r, g, b), linear sRGB), does not.
Prints one JSON object: first_wall_s and first_cpu_s from TIME (of the parent's time.time()) until the picture is
there, next_wall_s and next_cpu_s of the second.
"""
import argparse
import json
import os
import time

import drjit as dr
import mitsuba as mi
import numpy as np


def cpu_seconds():
    times = os.times()
    return times.user + times.system


parser = argparse.ArgumentParser(description="Times Mitsuba 3.")
parser.add_argument("scene")
parser.add_argument("out")
parser.add_argument("--spp", type=int, required=True)
parser.add_argument("--variant", required=True)
parser.add_argument("--seed", type=int, default=0)
parser.add_argument("--threads", type=int, required=True)
parser.add_argument("--began", type=float, required=True)
parser.add_argument("--once", action="store_true", help="the first picture only, and written")
arguments = parser.parse_args()

mi.set_variant(arguments.variant)
dr.set_thread_count(arguments.threads)
scene = mi.load_file(arguments.scene)


def render(seed):
    return np.array(mi.render(scene, spp=arguments.spp, seed=seed)).astype(np.float32)


picture = render(arguments.seed)
first_cpu, first_wall = cpu_seconds(), time.time() - arguments.began
start = time.perf_counter()
if not arguments.once:
    picture = render(arguments.seed + 1)
np.save(arguments.out, picture[..., :3])
print(json.dumps({"first_wall_s": first_wall, "first_cpu_s": first_cpu,
                  "next_wall_s": time.perf_counter() - start, "next_cpu_s": cpu_seconds() - first_cpu}))
