#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One process of Mitsuba 3 that renders one scene again and again, in one thread.

mitsuba_timing.py SCENE.xml VARIANT

Reads lines "SENSOR SPP SEED OUT.npy", SENSOR counting from 0; writes the picture (float32, height × width × (r, g, b), linear sRGB)
and prints the seconds of processors that it took. Before the first line it prints those that it took to start, the scene included.
The first picture of a sensor and a number of samples includes its kernels: ask for one that is not counted.
"""
import os
import sys
import time

# An LLVM that knows the processor: Debian's 14 and 15, which would be taken, crash on recent ones.
if os.path.exists("/usr/lib/x86_64-linux-gnu/libLLVM-19.so"):
    os.environ.setdefault("DRJIT_LIBLLVM_PATH", "/usr/lib/x86_64-linux-gnu/libLLVM-19.so")
import drjit as dr  # noqa: E402
import mitsuba as mi  # noqa: E402
import numpy as np  # noqa: E402


mi.set_variant(sys.argv[2])
mi.set_log_level(mi.LogLevel.Error)
scene = mi.load_file(sys.argv[1])
dr.set_thread_count(1)  # with one, loading an image waits for ever
print(time.process_time(), flush=True)

for line in sys.stdin:
    sensor, spp, seed, out = line.split()
    start = time.process_time()
    picture = np.array(mi.render(scene, sensor=int(sensor), spp=int(spp), seed=int(seed)))
    seconds = time.process_time() - start
    np.save(out, picture[..., :3].astype(np.float32))
    print(seconds, flush=True)
