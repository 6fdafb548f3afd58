#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a bed of spheres and a felt of fibres above it as a PBRT v4 scene: every one a Shape of its own.

Sample runs:
    ./generate.py -o /tmp/particles                                  10⁵ of each
    ./generate.py -o /tmp/particles --spheres 1e7 --fibres 1e7       2.7 GB of text
"""

import argparse
from pathlib import Path

import numpy as np

BLOCK = 1 << 16

HEADER = """# Particles. Written by generate.py; licence: Apache-2.0.

Scale -1 1 1  # pbrt's camera is left-handed: without this the picture is mirrored
LookAt 1.9 -2.3 1.5  0.02 0.05 -0.02  0 0 1
Camera "perspective" "float fov" [30]
Film "rgb" "string filename" "particles.exr" "integer xresolution" [{width}] "integer yresolution" [{height}]
Sampler "independent" "integer pixelsamples" [{spp}]
Integrator "path" "integer maxdepth" [8]

WorldBegin

LightSource "infinite" "rgb L" [0.35 0.42 0.55]
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [30 27 22]
  Translate 1.5 -1 2.5
  Shape "sphere" "float radius" [0.4]
AttributeEnd
"""


def cells(count, random, lower, upper):
    """One point in each of `count` cells of a grid over a box, row by row; and the width of a cell."""
    size = np.subtract(upper, lower)
    width = (np.prod(size) / count) ** (1 / 3)
    n = np.maximum(1, np.ceil(size / width)).astype(np.int64)
    for first in range(0, count, BLOCK):
        i = np.arange(first, min(count, first + BLOCK))
        at = np.stack([i % n[0], i // n[0] % n[1], i // (n[0] * n[1])], axis=1)
        yield (at + 0.15 + 0.7 * random.random((len(i), 3))) * width + lower, width


def write_spheres(out, count, random):
    out.write('\nMaterial "diffuse" "rgb reflectance" [0.62 0.5 0.36]\n')
    for points, width in cells(count, random, (-1, -1, -0.5), (1, 1, 0)):
        radii = width * (0.3 + 0.25 * random.random(len(points)))
        out.write("".join(
            f'AttributeBegin Translate {x:.7g} {y:.7g} {z:.7g} Shape "sphere" "float radius" {r:.6g} AttributeEnd\n'
            for (x, y, z), r in zip(points.tolist(), radii.tolist())))


def write_fibres(out, count, random):
    out.write('\nMaterial "diffuse" "rgb reflectance" [0.25 0.36 0.55]\n')
    for points, width in cells(count, random, (-0.9, -0.9, 0.05), (0.9, 0.9, 0.3)):
        axes = random.normal(size=(len(points), 3))
        angles = 360 * random.random(len(points))
        out.write("".join(
            f'AttributeBegin Translate {x:.7g} {y:.7g} {z:.7g} Rotate {t:.6g} {a:.4g} {b:.4g} {c:.4g} '
            f'Shape "cylinder" "float radius" {0.06 * width:.6g} "float zmin" {-1.2 * width:.6g} '
            f'"float zmax" {1.2 * width:.6g} AttributeEnd\n'
            for (x, y, z), (a, b, c), t in zip(points.tolist(), axes.tolist(), angles.tolist())))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True, help="receives particles.pbrt")
    parser.add_argument("--spheres", type=float, default=1e5)
    parser.add_argument("--fibres", type=float, default=1e5, help="open cylinders")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--width", type=int, default=640)
    parser.add_argument("--height", type=int, default=480)
    parser.add_argument("--spp", type=int, default=64)
    args = parser.parse_args()
    args.output.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(args.seed)
    with open(args.output / "particles.pbrt", "w", encoding="ascii") as out:
        out.write(HEADER.format(**vars(args)))
        if args.spheres >= 1:
            write_spheres(out, int(args.spheres), random)
        if args.fibres >= 1:
            write_fibres(out, int(args.fibres), random)


if __name__ == "__main__":
    main()
