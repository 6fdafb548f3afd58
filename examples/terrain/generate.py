#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a mountain lake of any number of triangles as a PBRT v4 scene with binary PLY meshes.

Sample runs:
    ./generate.py -o /tmp/terrain                                        a million triangles
    ./generate.py -o /tmp/terrain --triangles 1e8 --plants none          all of them unique
    ./generate.py -o /tmp/terrain --view aerial --width 1280 --height 720
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "shared"))

import numpy as np  # noqa: E402

import trees  # noqa: E402
from heights import Land  # noqa: E402
from materials import COLOURS, all_materials, covers  # noqa: E402
from meshes import Mesh, Parts, compacted, grid_faces, level, rotations, tile  # noqa: E402
from rocks import boulder  # noqa: E402
from scene_writer import SceneWriter, numbers  # noqa: E402

LEAST, MOST = 20_000, 1_000_000_000
TILE = 320  # cells a side, at most
COARSE = 256  # cells a side of the grid on which plants and rocks are shared out
PLANT_SHARE, ROCK_SHARE, PLANT_SHAPES = 0.25, 0.08, 16
SUN_TRAVELS = (0.76, 0.30, -0.58)
SUN, SKY = (4.2, 3.75, 3.1), (0.36, 0.52, 0.86)  # irradiance across its direction; radiance


class Sites:
    """Places of things, in the order of the tiles that they stand on."""

    def __init__(self, rng, count, weight, edges):
        extent = edges[-1] - edges[0]
        """weight: (COARSE, COARSE) expected share of each cell; edges: of the tiles, along either axis."""
        share = np.cumsum(weight.ravel() / weight.sum())
        cell = np.minimum(np.searchsorted(share, rng.random(count)), COARSE**2 - 1)
        step = extent / COARSE
        self.xy = (np.stack(np.divmod(cell, COARSE), axis=1) + rng.random((count, 2))) * step + edges[0]
        tiles = [np.clip(np.searchsorted(edges, self.xy[:, k], side="right") - 1, 0, len(edges) - 2) for k in (0, 1)]
        key = tiles[0] * (len(edges) - 1) + tiles[1]
        order = np.argsort(key, kind="stable")
        self.xy, key = self.xy[order], key[order]
        self.first = np.searchsorted(key, np.arange((len(edges) - 1) ** 2 + 1))

    def on(self, tile_number):
        return self.xy[self.first[tile_number] : self.first[tile_number + 1]]


class Generator:
    def __init__(self, args):
        self.args, n = args, args.triangles
        self.extent = float(np.clip(3200 * (n / 1e6) ** 0.25, 1500, 12000))  # metres, a side
        plants = args.plants != "none"
        rock_level = 2 if n < 300_000 else 3 if n < 10_000_000 else 4
        rock_cost = 8 * 4**rock_level
        shapes = [self._plant(k, int(120 * (n / 1e5) ** 0.23)) for k in range(PLANT_SHAPES)]
        plant_count = int(PLANT_SHARE * n / shapes[0].triangles) if plants else 0
        plant_count -= plant_count % PLANT_SHAPES
        self.shapes, self.plants = shapes, plant_count
        plant_cost = plant_count // PLANT_SHAPES * sum(s.triangles for s in shapes)
        self.cells = int(np.sqrt((n * (1 - ROCK_SHARE) - plant_cost) / 2))
        rock_count = max(round((n - plant_cost - 2 * self.cells**2) / rock_cost), 0)
        self.rocks, self.rock_level = rock_count, rock_level
        self.tiles = -(-self.cells // TILE)
        self.cuts = [round(k * self.cells / self.tiles) for k in range(self.tiles + 1)]
        self.line = (np.arange(self.cells + 1) / self.cells - 0.5) * self.extent
        self.land = Land(args.seed, self.extent, self.extent / self.cells)
        self._survey()
        args.output.mkdir(parents=True, exist_ok=True)
        self.writer = SceneWriter(args.output, "terrain", self._header())

    def _plant(self, k, triangles):
        rng = np.random.default_rng([self.args.seed, 1, k])
        return trees.conifer(rng, rng.uniform(9, 17), max(triangles, 60), f"needle-{k % 3}")

    def _survey(self):
        """The lake's level, the eye, and where plants and rocks stand: from the heights of a coarse grid."""
        middle = ((np.arange(COARSE) + 0.5) / COARSE - 0.5) * self.extent
        coarse = Land(self.args.seed, self.extent, self.extent / COARSE)
        z = coarse.heights(middle, middle)
        x, y = middle[:, None], middle[None]
        basin = ((x / self.extent + 0.05) / 0.2) ** 2 + ((y / self.extent + 0.16) / 0.13) ** 2 < 1
        self.lake = float(np.quantile(z[basin], 0.62))
        self.top = float(z.max())
        eye = np.array([-0.10 * self.extent, -0.40 * self.extent])
        ground = float(coarse.heights(eye[:1], eye[1:])[0, 0])
        self.eye = (*eye, max(ground, self.lake) + 12 + 0.006 * self.extent)
        if self.args.view == "aerial":
            self.eye = (-0.12 * self.extent, -0.5 * self.extent, self.top + 0.10 * self.extent)
        slope = np.hypot(*np.gradient(z, self.extent / COARSE))
        near = 1 / (1 + ((x - eye[0]) ** 2 + (y - eye[1]) ** 2) / (0.12 * self.extent) ** 2)
        rise = (z - self.lake) / (self.top - self.lake)
        fit = (rise > 0.02) & (rise < 0.42) & (slope < 0.7)
        edges = self.line[self.cuts]
        rng = np.random.default_rng([self.args.seed, 2])
        self.plant_sites = Sites(rng, self.plants, fit * near + 1e-12, edges)
        self.rock_sites = Sites(rng, self.rocks, (rise > -0.01) * (0.1 + np.minimum(slope, 1)) * near**2 + 1e-12, edges)

    def _header(self):
        target = (0.02 * self.extent, 0.2 * self.extent, self.lake + 0.02 * self.extent)
        if self.args.view == "aerial":
            target = (0, 0.06 * self.extent, self.lake)
        width, height = self.args.width, self.args.height
        return f"""# A mountain lake. Metres, z up, right-handed. Written by generate.py; licence: Apache-2.0.

Scale -1 1 1  # pbrt's camera is left-handed: without this the picture is mirrored
LookAt {numbers(self.eye)}  {numbers(target)}  0 0 1
Camera "perspective" "float fov" [40]
Film "rgb" "string filename" "terrain.exr" "integer xresolution" [{width}] "integer yresolution" [{height}]
PixelFilter "gaussian"
Sampler "independent" "integer pixelsamples" [{self.args.spp}]
Integrator "path" "integer maxdepth" [8]

WorldBegin

# A morning's sun and a clear sky.
LightSource "distant" "point3 from" [0 0 0] "point3 to" [{numbers(SUN_TRAVELS)}] "rgb L" [{numbers(SUN)}]
LightSource "infinite" "rgb L" [{numbers(SKY)}]

""" + "".join(line + "\n" for line in all_materials())

    def _field(self, parts, x, y, z):
        nx, ny = z.shape
        p = np.empty((nx, ny, 3), np.float32)
        p[..., 0], p[..., 1], p[..., 2] = x[:, None], y[None], z
        v, f = p.reshape(-1, 3), grid_faces(nx, ny)
        cover = covers(z, x[1] - x[0], self.lake, self.top)
        for k, name in enumerate(COLOURS):
            chosen = f[cover == k]
            if len(chosen):
                parts.add(name, compacted(Mesh(v, chosen)))

    def _ground_at(self, xy, x, y, z):
        """Heights of (k,2) places on the tile."""
        s = (xy - (x[0], y[0])) / (x[1] - x[0], y[1] - y[0])
        i = np.clip(np.floor(s).astype(int), 0, np.array(z.shape) - 2)
        u, v = (s - i).T
        i, j = i.T
        return (1 - u) * ((1 - v) * z[i, j] + v * z[i, j + 1]) + u * ((1 - v) * z[i + 1, j] + v * z[i + 1, j + 1])

    def _rocks(self, rng, xy, ground):
        for (x, y), z in zip(xy, ground):
            radius = 0.9 / np.sqrt(rng.uniform(0.012, 1))
            rock = boulder(rng, radius, self.rock_level)
            parts = Parts()
            parts.add(f"rock-{rng.integers(2)}", rock)
            self.writer.add(parts, offset=np.array([x, y, z + 0.15 * radius]))

    def _plants(self, rng, xy, ground, first):
        """Shapes take turns, so that each stands equally often."""
        turns, sizes = 360 * rng.random(len(xy)), rng.uniform(0.7, 1.25, len(xy))
        at = np.column_stack([xy, ground - 0.2])
        shape = (first + np.arange(len(xy))) % PLANT_SHAPES
        if self.args.plants == "instances":
            for k, place, turn, size in zip(shape, at, turns, sizes):
                self.writer.place(f"plant-{k}", place, turn, size)
            return
        scaled = rotations(turns) * sizes[:, None, None]
        for k in range(PLANT_SHAPES):
            alike = np.nonzero(shape == k)[0]
            for some in np.split(alike, range(64, len(alike), 64)):
                parts = Parts()
                for material, meshes in self.shapes[k].by_material.items():
                    for mesh in meshes:
                        parts.add(material, tile(mesh, at[some], scaled[some]))
                self.writer.add(parts)

    def run(self):
        if self.args.plants == "instances":
            for k, parts in enumerate(self.shapes):
                self.writer.add_object(f"plant-{k}", parts)
        for i in range(self.tiles):
            order = range(self.tiles)
            for j in order if i % 2 == 0 else reversed(order):
                self._tile(i, j)
        return self.writer.close(
            asked=self.args.triangles, tiles=self.tiles**2, rocks=self.rocks, plants=self.plants, seed=self.args.seed
        )

    def _tile(self, i, j):
        x = self.line[self.cuts[i] : self.cuts[i + 1] + 1]
        y = self.line[self.cuts[j] : self.cuts[j + 1] + 1]
        z = self.land.heights(x, y)
        parts, number = Parts(), i * self.tiles + j
        self._field(parts, x, y, z)
        if z.min() < self.lake:
            parts.add("water", level(x[0], y[0], x[-1], y[-1], self.lake))
        self.writer.add(parts)
        rng = np.random.default_rng([self.args.seed, 3, i, j])
        xy = self.rock_sites.on(number)
        self._rocks(rng, xy, self._ground_at(xy, x, y, z))
        xy = self.plant_sites.on(number)
        self._plants(rng, xy, self._ground_at(xy, x, y, z), int(self.plant_sites.first[number]))
        self.writer.flush()


def triangles(text):
    count = int(float(text))
    if not LEAST <= count <= MOST:
        raise argparse.ArgumentTypeError(f"from {LEAST} to {MOST}")
    return count


def main():
    parser = argparse.ArgumentParser(description="writes terrain.pbrt, terrain.json and meshes/*.ply")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--triangles", type=triangles, default=1_000_000, metavar="N", help="as rendered (default 1e6)")
    parser.add_argument("--plants", choices=("none", "instances", "flattened"), default="instances")
    parser.add_argument("--view", choices=("lake", "aerial"), default="lake")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--width", type=int, default=960)
    parser.add_argument("--height", type=int, default=540)
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel (default 64)")
    args = parser.parse_args()
    counts = Generator(args).run()
    print(
        f"{args.output / 'terrain.pbrt'}: {counts['triangles']} triangles, {counts['unique_triangles']} of them stored,"
        f" {counts['instances']} instances of {counts['objects']} objects"
    )


if __name__ == "__main__":
    main()
