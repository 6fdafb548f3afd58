#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What Mitsuba 3 renders of a scene file.

mitsuba_pixels.py SCENE.xml OUT.json --spp N --variant NAME

OUT.json: a list of [r, g, b], and alpha if the film has it, row by row from the top left.
"""
import argparse
import json

import mitsuba as mi
import numpy as np

parser = argparse.ArgumentParser(description="Renders a scene file with Mitsuba 3.")
parser.add_argument("scene")
parser.add_argument("out")
parser.add_argument("--spp", type=int, required=True)
parser.add_argument("--variant", required=True)
arguments = parser.parse_args()

mi.set_variant(arguments.variant)
picture = np.array(mi.render(mi.load_file(arguments.scene), spp=arguments.spp))
with open(arguments.out, "w") as out:
    json.dump(picture.reshape(-1, picture.shape[-1]).astype(float).tolist(), out)
