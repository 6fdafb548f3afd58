#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What 10⁵ emissive triangles cost: seconds a sample, relative to one emissive quad of the same power.

  tests/bench/many_lights.py [--bin build/release/bin] [--spp 32]

Three rooms that differ in their lamp alone: a quad under the ceiling; the same quad in 10⁵ triangles; 10⁵ small
triangles scattered over the ceiling and the walls, of the same area and radiance in all. Seconds of processors of
the render, less those of a render of one sample; in turn, medians.
"""
import argparse
import json
import math
import pathlib
import random
import statistics
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
HEAD = """LookAt 0 1 -2.9  0 1 0  0 1 0
Camera "perspective" "float fov" 65
Film "rgb" "integer xresolution" 192 "integer yresolution" 192 "string filename" "room.exr"
PixelFilter "box" "float xradius" .5 "float yradius" .5
Integrator "path" "integer maxdepth" 4
WorldBegin
Material "diffuse" "rgb reflectance" [.6 .6 .6]
"""
SIDE = 224  # 2·224² = 100352 triangles


def shape(points, triangles):
    numbers = lambda values: " ".join(f"{v:.7g}" for row in values for v in row)
    return f'Shape "trianglemesh" "point3 P" [{numbers(points)}] "integer indices" [{numbers(triangles)}]\n'


def quad(a, b, c, d):
    return shape([a, b, c, d], [(0, 1, 2), (0, 2, 3)])


def box(low, high, outwards):
    (x0, y0, z0), (x1, y1, z1) = low, high
    faces = [((x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)), ((x0, y1, z0), (x0, y1, z1), (x1, y1, z1), (x1, y1, z0)),
             ((x0, y0, z0), (x0, y1, z0), (x1, y1, z0), (x1, y0, z0)), ((x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)),
             ((x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)), ((x1, y0, z0), (x1, y1, z0), (x1, y1, z1), (x1, y0, z1))]
    return "".join(quad(*(face if outwards else face[::-1])) for face in faces)


def lamp(text):
    return f'AttributeBegin\nAreaLightSource "diffuse" "rgb L" [10 10 10]\n{text}AttributeEnd\n'


def one_quad():
    return quad((-.5, 2.4, -.5), (.5, 2.4, -.5), (.5, 2.4, .5), (-.5, 2.4, .5))


def cut_quad():
    n = SIDE + 1
    points = [(-.5 + i / SIDE, 2.4, -.5 + j / SIDE) for j in range(n) for i in range(n)]
    corner = [(j * n + i, j * n + i + 1, (j + 1) * n + i + 1, (j + 1) * n + i) for j in range(SIDE) for i in range(SIDE)]
    return shape(points, [t for a, b, c, d in corner for t in ((a, b, c), (a, c, d))])


def scattered():
    """Triangles of area 1/100352 a little before the ceiling and the four walls, facing the room."""
    random.seed(1)
    count = 2 * SIDE * SIDE
    side = math.sqrt(4 / (count * math.sqrt(3)))
    walls = [((0, 2.49, 0), (1, 0, 0), (0, 0, 1)), ((2.99, 1, 0), (0, 0, 1), (0, 1, 0)),
             ((-2.99, 1, 0), (0, 1, 0), (0, 0, 1)), ((0, 1, 2.99), (0, 1, 0), (1, 0, 0)),
             ((0, 1, -2.99), (1, 0, 0), (0, 1, 0))]
    points = []
    for _ in range(count):
        o, u, v = random.choice(walls)
        s, t = random.uniform(-1.4, 1.4), random.uniform(-1.4, 1.4)
        turn = random.uniform(0, 2 * math.pi)
        for k in range(3):
            a = turn + 2 * math.pi * k / 3
            p, q = s + side / math.sqrt(3) * math.cos(a), t + side / math.sqrt(3) * math.sin(a)
            points.append(tuple(o[i] + u[i] * p + v[i] * q for i in range(3)))
    return shape(points, [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(count)])


def seconds(options, bundle, spp, folder):
    stats = folder / "stats.json"
    subprocess.run([options.bin / "vitrail-render", bundle, "-o", folder / "room.film", "--force", "--spp", str(spp), "--threads",
                    str(options.threads), "--progress", "none", "--stats", stats], check=True)
    return json.loads(stats.read_text())


def main():
    parser = argparse.ArgumentParser(description="Measures what many lights cost.")
    parser.add_argument("--bin", type=pathlib.Path, default=HERE.parents[1] / "build/release/bin")
    parser.add_argument("--spp", type=int, default=32)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--keep", type=pathlib.Path, help="keep scenes and bundles here")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        room = box((-3, -.5, -3), (3, 2.5, 3), False) + box((-1.5, -.5, .5), (-.5, .8, 1.5), True) + box((.4, -.5, 0), (1.4, .3, 1), True)
        rooms = {"quad": one_quad(), "cut quad": cut_quad(), "scattered": scattered()}
        taken = {name: [] for name in rooms}
        bundles = {}
        for name, text in rooms.items():
            scene = folder / (name.replace(" ", "_") + ".pbrt")
            scene.write_text(HEAD + room + lamp(text))
            bundles[name] = scene.with_suffix(".vit")
            subprocess.run([options.bin / "vitrail-partition", scene, "-o", bundles[name], "--quiet"], check=True)
        for _ in range(options.repetitions):
            for name, bundle in bundles.items():
                full, least = seconds(options, bundle, options.spp, folder), seconds(options, bundle, 1, folder)
                samples = full["samples"] - least["samples"]
                rays = sum(full[k] for k in ("rays_camera", "rays_indirect", "rays_shadow")) / full["samples"]
                taken[name].append(((full["cpu_s"] - least["cpu_s"]) / samples * 1e6, least["cpu_s"], rays))
        base = statistics.median(t[0] for t in taken["quad"])
        for name, values in taken.items():
            each, start, rays = (statistics.median(v) for v in zip(*values))
            print(f"{name:10} {each:6.3f} µs a sample, {rays:.2f} rays a sample, {each / base:.2f}× (target ≤ 1.5); start-up {start:.2f} s")


if __name__ == "__main__":
    main()
