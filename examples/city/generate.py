#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a city of any number of triangles as a PBRT v4 scene with binary PLY meshes.

Sample runs:
    ./generate.py -o /tmp/city                                                  a million triangles
    ./generate.py -o /tmp/city --triangles 1e8 --trees flattened                all of them unique, 2.4 GB
    ./generate.py -o /tmp/city --triangles 1e9 --buildings instances            a library of buildings and trees
    ./generate.py -o /tmp/city --triangles 1e9 --buildings instances --nested   objects made of objects, too
    ./generate.py -o /tmp/city --view aerial --width 1280 --height 720
"""

import argparse
import sys
from collections import Counter, defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "shared"))

import numpy as np  # noqa: E402

import props  # noqa: E402
import trees  # noqa: E402
from buildings import build, design  # noqa: E402
from landscape import landscape  # noqa: E402
from layout import City, size_for  # noqa: E402
from materials import all_materials  # noqa: E402
from meshes import Parts, join, rotations, tile  # noqa: E402
from scene_writer import SceneWriter, numbers  # noqa: E402
from streets import KERB, TREE_SHAPES, ground, members, placed, standing  # noqa: E402

LEAST, MOST = 80_000, 1_000_000_000
TREE_SHARE, LEAVES = 0.32, 3
SUN_TRAVELS = (0.25, 0.60, -0.76)
SUN, SKY = (3.6, 3.25, 2.75), (0.46, 0.60, 0.86)  # irradiance across its direction; radiance


def header(city, args):
    x0, y0, x1, y1 = city.extent()
    size = max(x1 - x0, y1 - y0)
    start, _, road = city.x[city.avenue]
    avenue = start - 0.5 * road
    if args.view == "street":
        eye = (avenue - 1.5, city.y[0][0] + 4 + 0.1 * (y1 - y0), 8.5)
        target, fov = (avenue + 2.0, eye[1] + 100, 15.0), 62
    else:
        eye = (x0 + 0.05 * size, y0 - 0.20 * size, 60 + 0.30 * size)
        target, fov = (0.04 * size, 0.02 * size, 0), 48
    return f"""# A city. Metres, z up, right-handed. Written by generate.py; licence: Apache-2.0.

Scale -1 1 1  # pbrt's camera is left-handed: without this the picture is mirrored
LookAt {numbers(eye)}  {numbers(target)}  0 0 1
Camera "perspective" "float fov" [{fov}]
Film "rgb" "string filename" "city.exr" "integer xresolution" [{args.width}] "integer yresolution" [{args.height}]
PixelFilter "gaussian"
Sampler "independent" "integer pixelsamples" [{args.spp}]
Integrator "path" "integer maxdepth" [8]

WorldBegin

# An afternoon's sun and a clear sky.
LightSource "distant" "point3 from" [0 0 0] "point3 to" [{numbers(SUN_TRAVELS)}] "rgb L" [{numbers(SUN)}]
LightSource "infinite" "rgb L" [{numbers(SKY)}]

""" + "".join(line + "\n" for line in all_materials())


class Budget:
    """Shares triangles out by weight; what one got too much or too little the next make up for."""

    def __init__(self, triangles, weight):
        self.triangles, self.weight = triangles, weight

    def share(self, weight):
        return max(self.triangles / self.weight, 0) * weight

    def spend(self, triangles, weight):
        self.triangles -= triangles
        self.weight -= weight


class Generator:
    def __init__(self, args):
        self.args, self.seed = args, args.seed
        size = size_for(args.triangles)
        self.city = City(size, args.seed, args.buildings == "instances")
        self.tree_instances = args.trees == "instances"
        fine = args.triangles > 500_000
        self.groups = {}  # of what stands, around the group's origin
        self.things = {("lamp", 0): props.lamp(fine)}
        for k in range(props.CAR_SHAPES * len(props.CAR_COLOURS)):
            self.things["car", k] = props.car(*divmod(k, len(props.CAR_COLOURS)), fine)
        self.cost = {key: parts.triangles for key, parts in self.things.items()}
        self.land = landscape(self.city, args.seed)
        self._plan()
        args.output.mkdir(parents=True, exist_ok=True)
        self.writer = SceneWriter(args.output, "city", header(self.city, args))

    def _ground(self, block):
        return ground(block, block.index[0] == self.city.size.columns - 1, block.index[1] == self.city.size.rows - 1)

    def _standing(self, block):
        return standing(block, self.city.size, self.seed, self.args.nested)

    def _things(self, block):
        """All that stands there, one by one."""
        for s in self._standing(block):
            if s.kind not in ("side", "grove"):
                yield s
                continue
            key = s.kind, s.variant
            if key not in self.groups:
                self.groups[key] = members(s, self.city.size, self.seed)
            yield from (placed(s, thing) for thing in self.groups[key])

    def _plan(self):
        """Counts windows and all that does not depend on the budget."""
        fixed, tree_count, cells = self.land.triangles, 0, 0
        self.buildings = 0
        self.uses, self.cells_of = Counter(), {}
        for block in self.city.blocks():
            fixed += self._ground(block).triangles
            for s in self._things(block):
                tree_count += s.kind == "tree"
                fixed += self.cost.get((s.kind, s.variant), 0)
            for item in self.city.items(block):
                self.buildings += 1
                key = tuple(item.seed)
                if key not in self.cells_of:
                    count = design(item.seed, item.lot).cells()
                    if self.city.library:
                        self.cells_of[key] = count
                else:
                    count = self.cells_of[key]
                if self.city.library:
                    self.uses[key] += 1
                cells += count
        n = self.args.triangles
        self.tree_cost = int(np.clip(TREE_SHARE * n / max(tree_count, 1), trees.LEAST_TRIANGLES, 100_000)) // 2 * 2
        self.trees = tree_count
        self.budget = Budget(n - fixed - tree_count * self.tree_cost, cells)

    def _objects(self):
        for k in range(TREE_SHAPES):
            rng = np.random.default_rng([self.seed, 7, k])
            self.things["tree", k] = trees.broadleaf(rng, rng.uniform(7.0, 12.5), self.tree_cost, f"leaf-{k % LEAVES}")
        if self.tree_instances:
            for (kind, k), parts in self.things.items():
                self.writer.add_object(f"{kind}-{k}", parts)
            for (kind, k), things in self.groups.items():
                self.writer.add_group(
                    f"{kind}-{k}", [(f"{s.kind}-{s.variant}", (s.x, s.y, s.z), s.degrees) for s in things]
                )
        self.library = {}
        if self.city.library:
            for block in self.city.blocks():
                for item in self.city.items(block):
                    key = tuple(item.seed)
                    if key not in self.library:
                        self.library[key] = f"building-{len(self.library)}"
                        self.writer.add_object(self.library[key], self._building(item, self.uses[key]))

    def _building(self, item, uses):
        plan = design(item.seed, item.lot)
        weight = plan.cells()
        parts = build(item.seed, plan, self.budget.share(weight))
        self.budget.spend(uses * parts.triangles, uses * weight)
        return parts

    def _place_building(self, item):
        if self.city.library:
            self.writer.place(self.library[tuple(item.seed)], (item.x, item.y, KERB), 90 * item.quarters)
            return
        turn = np.round(rotations([90 * item.quarters])[0])
        self.writer.add(self._building(item, 1), turn, np.array([item.x, item.y, KERB]))

    def _place_things(self, block):
        if self.tree_instances:
            for s in self._standing(block):
                self.writer.place(f"{s.kind}-{s.variant}", (s.x, s.y, s.z), s.degrees)
            return
        alike = defaultdict(list)
        for s in self._things(block):
            alike[s.kind, s.variant].append(s)
        for key, group in alike.items():
            turns = rotations([s.degrees for s in group])
            origins = np.array([(s.x, s.y, s.z) for s in group])
            copies = Parts()
            for material, meshes in self.things[key].by_material.items():
                copies.add(material, tile(join(meshes), origins, turns))
            self.writer.add(copies)

    def run(self):
        self._objects()
        self.writer.add(self.land)
        for block in self.city.blocks():
            self.writer.add(self._ground(block))
            for item in self.city.items(block):
                self._place_building(item)
            self._place_things(block)
        size = self.city.size
        return self.writer.close(
            asked=self.args.triangles,
            blocks=size.columns * size.rows,
            buildings=self.buildings,
            trees=self.trees,
            seed=self.seed,
        )


def triangles(text):
    count = int(float(text))
    if not LEAST <= count <= MOST:
        raise argparse.ArgumentTypeError(f"from {LEAST} to {MOST}")
    return count


def main():
    parser = argparse.ArgumentParser(description="writes city.pbrt, city.json and meshes/*.ply")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--triangles", type=triangles, default=1_000_000, metavar="N", help="as rendered (default 1e6)")
    parser.add_argument("--trees", choices=("instances", "flattened"), default="instances", help="cars and lamps too")
    parser.add_argument("--buildings", choices=("unique", "instances"), default="unique")
    parser.add_argument(
        "--nested", action="store_true", help="kerbs and groves as objects made of instances, which PBRT does not have"
    )
    parser.add_argument("--view", choices=("street", "aerial"), default="street")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--width", type=int, default=960)
    parser.add_argument("--height", type=int, default=540)
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel (default 64)")
    args = parser.parse_args()
    counts = Generator(args).run()
    print(
        f"{args.output / 'city.pbrt'}: {counts['triangles']} triangles, {counts['unique_triangles']} of them stored,"
        f" {counts['instances']} instances of {counts['objects']} objects"
    )


if __name__ == "__main__":
    main()
