#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A ball of bent hair, one cubic curve each, as a scene of PBRT. README.md has the options."""

import argparse
from pathlib import Path

import numpy as np

HEAD = """LookAt 0 -4 1.2  0 0 0  0 0 1
Camera "perspective" "float fov" [ 40 ]
Film "rgb" "integer xresolution" [ {size} ] "integer yresolution" [ {size} ]
Sampler "independent" "integer pixelsamples" [ {spp} ]
PixelFilter "box"
Integrator "path" "integer maxdepth" [ 12 ]
WorldBegin
LightSource "infinite" "rgb L" [ .3 .3 .35 ]
LightSource "distant" "point3 from" [ 2 -3 4 ] "point3 to" [ 0 0 0 ] "rgb L" [ 2 2 1.8 ]
Material "diffuse" "rgb reflectance" [ .2 .15 .1 ]
Shape "sphere" "float radius" [ 0.8 ]
Material "hair" "rgb reflectance" [ .5 .3 .1 ] "float beta_m" [ .3 ] "float beta_n" [ .3 ]
"""
BLOCK = 1 << 14


def control_points(count, random):
    """(count, 4, 3): roots on the ball, tips that hang and stray."""
    out = random.normal(size=(count, 1, 3))
    out /= np.linalg.norm(out, axis=2, keepdims=True)
    points = out * np.array([0.8, 0.95, 1.1, 1.2])[:, None]
    points += random.normal(scale=0.12, size=(count, 4, 3)) * np.array([0, 0.3, 0.6, 0.9])[:, None]
    points[:, :, 2] -= np.array([0, 0, 0.05, 0.2])
    return points


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-o", type=Path, required=True, metavar="DIR")
    parser.add_argument("--hairs", type=float, default=1e5)
    parser.add_argument("--type", default="cylinder", choices=("cylinder", "flat"))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--size", type=int, default=400)
    parser.add_argument("--spp", type=int, default=16)
    a = parser.parse_args()
    count, random = int(a.hairs), np.random.default_rng(a.seed)
    width = 0.004 * (1e5 / count) ** 0.5
    line = (f'Shape "curve" "string type" "{a.type}" "point3 P" [' + " %.6g" * 12 +
            f' ] "float width0" {width:.6g} "float width1" {0.3 * width:.6g}\n')
    a.o.mkdir(parents=True, exist_ok=True)
    with open(a.o / "hair.pbrt", "w") as file:
        file.write(HEAD.format(size=a.size, spp=a.spp))
        for first in range(0, count, BLOCK):
            points = control_points(min(BLOCK, count - first), random).reshape(-1, 12)
            file.write("".join(line % tuple(p) for p in points))


if __name__ == "__main__":
    main()
