#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What Mitsuba 3's integrator `aov` gives for a scene file.

mitsuba_layers.py SCENE.xml OUT.json --spp N --seeds K

OUT.json: {channel: {"mean": [of pixels], "error": [of these means, by the scatter of K seeds]}}
"""
import argparse
import json

import mitsuba as mi
import numpy as np

parser = argparse.ArgumentParser()
parser.add_argument("scene")
parser.add_argument("out")
parser.add_argument("--spp", type=int, required=True)
parser.add_argument("--seeds", type=int, required=True)
arguments = parser.parse_args()

mi.set_variant("scalar_rgb")
scene = mi.load_file(arguments.scene)
pictures = np.stack([
    np.array(mi.render(scene, spp=arguments.spp, seed=seed)) for seed in range(arguments.seeds)
]).astype(np.float64)
names = scene.integrator().aov_names()[4:]  # the picture's own come first: R, G, B and, here or in the film, A
pictures = pictures[..., -len(names):]
error = pictures.std(axis=0, ddof=1) / np.sqrt(arguments.seeds)
answer = {}
for i, name in enumerate(names):
    answer[name] = {"mean": pictures.mean(axis=0)[..., i].ravel().tolist(), "error": error[..., i].ravel().tolist()}
with open(arguments.out, "w") as out:
    json.dump(answer, out)
