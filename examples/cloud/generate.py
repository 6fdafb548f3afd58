#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a cumulus over a meadow, a grid of densities as a PBRT v4 scene.

Sample runs:
    ./generate.py -o /tmp/cloud
    ./generate.py -o /tmp/cloud --cells 48 --density 0.06
"""

import argparse
from pathlib import Path

import numpy as np

LOWER, UPPER = (-320, -200, 260), (320, 200, 580)  # metres, z up
SKY = "48.86,2.35,2026-06-21T15:30+02:00,turbidity=2.5"


def noise(shape, cells, random):
    """Values in [−1, 1] at random on a lattice of so many cells along x, and smoothly between."""
    counts = [max(1, round(cells * n / shape[0])) for n in shape]
    values = random.uniform(-1, 1, [c + 2 for c in counts])
    for axis, (n, count) in enumerate(zip(shape, counts)):
        at = (np.arange(n) + 0.5) / n * count
        low = at.astype(int)
        t = at - low
        t = t * t * (3 - 2 * t)
        t = t.reshape([-1 if k == axis else 1 for k in range(3)])
        values = values.take(low, axis) * (1 - t) + values.take(low + 1, axis) * t
    return values


def densities(cells, seed):
    """Of z, y, x: 0 to 1. Balls side by side on a flat base, whose edges octaves of noise fray."""
    random = np.random.default_rng(seed)
    size = np.subtract(UPPER, LOWER)
    shape = tuple(max(4, round(cells * s / size[0])) for s in size)
    x, y, z = np.meshgrid(*(LOWER[k] + size[k] * (np.arange(n) + 0.5) / n for k, n in enumerate(shape)), indexing="ij")
    inside = np.full(shape, -1.0)
    for _ in range(22):
        centre = random.uniform((-190, -90, 330), (190, 90, 400))
        radius = random.uniform(60, 120) * (1 - abs(centre[0]) / 500)
        distance = np.sqrt((x - centre[0]) ** 2 + (y - centre[1]) ** 2 + (z - centre[2]) ** 2)
        inside = np.maximum(inside, 1 - distance / radius)
    frayed = sum(0.6**k * noise(shape, 6 * 2**k, random) for k in range(5))
    base = np.clip((z - 300) / 25, 0, 1)
    return (np.clip(4 * (inside + 0.5 * frayed), 0, 1) * base).transpose(2, 1, 0)


def scene(grid, density, width):
    depth, rows, columns = grid.shape
    (x0, y0, z0), (x1, y1, z1) = LOWER, UPPER
    return f"""# A cloud over a meadow. Metres, z up, y north. Written by generate.py; licence: Apache-2.0.

Scale -1 1 1  # pbrt's camera is left-handed
LookAt 0 -900 90  0 0 330  0 0 1
Camera "perspective" "float fov" [32]
Film "rgb" "string filename" "cloud.exr" "integer xresolution" [{width}] "integer yresolution" [{width * 3 // 4}]
Sampler "independent" "integer pixelsamples" [64]
Integrator "volpath" "integer maxdepth" [64]

WorldBegin
# A form that pbrt reads past: its sky is one of a single radiance.
LightSource "infinite" "string sky" "{SKY}"

Material "diffuse" "spectrum reflectance" [360 0.03  500 0.06  550 0.14  600 0.09  670 0.06  720 0.35  830 0.4]
Shape "disk" "float radius" [300000]

MakeNamedMedium "cloud" "string type" "uniformgrid" "point3 p0" [{x0} {y0} {z0}] "point3 p1" [{x1} {y1} {z1}]
  "integer nx" {columns} "integer ny" {rows} "integer nz" {depth} "float g" [0.6]
  "rgb sigma_a" [0 0 0] "rgb sigma_s" [1 1 1] "float scale" [{density}]
  "float density" [
{chr(10).join(" ".join(f"{v:.3g}" for v in row) for row in grid.reshape(-1, columns))}
  ]
AttributeBegin
  Material "interface"
  MediumInterface "cloud" ""
  Shape "trianglemesh" "point3 P" [{corners(x0, y0, z0, x1, y1, z1)}]
    "integer indices" [0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 6  3 0 4 3 4 7]
AttributeEnd
"""


def corners(x0, y0, z0, x1, y1, z1):
    return "  ".join(f"{x} {y} {z}" for z in (z0, z1) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1)))


def main():
    parser = argparse.ArgumentParser(description="writes cloud.pbrt")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--cells", type=int, default=96, help="of the grid along x (default 96)")
    parser.add_argument("--density", type=float, default=0.12, help="scattering where it is densest, 1/m (default 0.12)")
    parser.add_argument("--seed", type=int, default=3, help="another number is another cloud")
    parser.add_argument("--width", type=int, default=640, help="of the picture, 4:3")
    args = parser.parse_args()
    args.output.mkdir(parents=True, exist_ok=True)
    grid = densities(args.cells, args.seed)
    (args.output / "cloud.pbrt").write_text(scene(grid, args.density, args.width))
    print(f"{args.output / 'cloud.pbrt'}: {' × '.join(map(str, grid.shape[::-1]))} densities")


if __name__ == "__main__":
    main()
