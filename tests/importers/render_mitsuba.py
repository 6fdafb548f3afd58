#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders a scene file with Mitsuba 3.

render_mitsuba.py SCENE.xml OUT.npy|OUT.exr --spp N [--variant scalar_spectral] [--seed S]

.npy holds float32, height × width × (r, g, b), linear sRGB.
"""
import argparse

import mitsuba as mi
import numpy as np

parser = argparse.ArgumentParser(description="Renders a scene file with Mitsuba 3.")
parser.add_argument("scene")
parser.add_argument("out")
parser.add_argument("--spp", type=int, required=True)
parser.add_argument("--variant", default="scalar_spectral")
parser.add_argument("--seed", type=int, default=0)
arguments = parser.parse_args()

mi.set_variant(arguments.variant)
picture = mi.render(mi.load_file(arguments.scene), spp=arguments.spp, seed=arguments.seed)
if arguments.out.endswith(".npy"):
    np.save(arguments.out, np.array(picture).astype(np.float32))
else:
    mi.Bitmap(picture).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False).write(arguments.out)
