#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a PBRT v4 scene that is built to break domain decomposition.

Everything lies in the cube [-8, 8]³, whose centre and quarter planes are likely interfaces; coordinates that are meant
to lie on them are multiples of powers of two, so they lie on them exactly.

Sample runs:
    ./generate.py -o /tmp/adversarial
    ./generate.py -o /tmp/adversarial --detail 0.5 --width 160 --height 120 --spp 4
"""

import argparse
from pathlib import Path

import numpy as np

HALF = 8.0
LIKELY_PLANES = (0.0, -4.0, 4.0, -2.0, 6.0)
COLOURS = {
    "chalk": (0.75, 0.75, 0.72),
    "brick": (0.60, 0.22, 0.14),
    "moss": (0.25, 0.45, 0.15),
    "sea": (0.15, 0.35, 0.60),
    "sun": (0.75, 0.60, 0.15),
}


def soup(triangles):
    """(n,3,3) corners as (vertices, faces) without shared vertices."""
    triangles = np.asarray(triangles, float)
    return triangles.reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3)


def unit(rng, count):
    v = rng.normal(size=(count, 3))
    return v / np.linalg.norm(v, axis=1, keepdims=True)


def giants():
    """Floor and back wall of two triangles each, and beams that run from corner to corner of the scene."""
    h = HALF
    quads = [
        ((-h, -h, -h), (-h, -h, h), (h, -h, h), (h, -h, -h)),
        ((-h, -h, h), (-h, h, h), (h, h, h), (h, -h, h)),
    ]
    triangles = [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]
    for s, t in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        triangles.append(((-h * s, -h * t, h), (h * s, h * t, -h), (h * s, h * t - 0.25 * t, -h)))
    return soup(triangles)


def slivers(rng, count):
    """Length 1 to 16, aspect 10⁵ to 10⁷: the thinnest are as wide as the spacing of floats there."""
    length, aspect = rng.uniform(1, 2 * HALF, (count, 1)), 10 ** rng.uniform(5, 7, (count, 1))
    along = unit(rng, count)
    across = np.cross(along, unit(rng, count))
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    a = rng.uniform(-HALF, HALF, (count, 3))
    b = np.clip(a + along * length, -HALF, HALF)
    return soup(np.stack([a, b, np.clip(b + across * length / aspect, -HALF, HALF)], axis=1))


def grids(cells):
    """Every other cell of a regular grid, in each likely plane of each axis; the middle is left free."""
    triangles = []
    edges = np.linspace(-HALF / 2, HALF / 2, cells + 1)
    i, j = (k.reshape(-1) for k in np.meshgrid(np.arange(cells), np.arange(cells), indexing="ij"))
    u, v = edges[i], edges[j]
    step = HALF / cells
    shown = ((i + j) % 2 == 0) & (np.maximum(np.abs(u + step / 2), np.abs(v + step / 2)) > 1.5)
    u, v = u[shown], v[shown]
    for axis in range(3):
        for plane in LIKELY_PLANES:
            corners = np.empty((len(u), 4, 3))
            corners[:, :, axis] = plane
            corners[:, :, (axis + 1) % 3] = u[:, None] + step * np.array([0, 1, 1, 0])
            corners[:, :, (axis + 2) % 3] = v[:, None] + step * np.array([0, 0, 1, 1])
            triangles += [corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]
    return soup(np.concatenate(triangles))


def spheres(rings):
    """Latitude and longitude about each quarter point; poles and equators have vertices exactly on the planes."""
    theta, phi = np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1)
    p = np.stack(
        np.broadcast_arrays(
            np.sin(theta)[:, None] * np.cos(phi), np.sin(theta)[:, None] * np.sin(phi), np.cos(theta)[:, None]
        ),
        axis=-1,
    )
    p = np.round(p * 4096) / 4096
    a, b, c, d = p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]
    one = np.concatenate([np.stack([a, b, c], 2).reshape(-1, 3, 3), np.stack([a, c, d], 2).reshape(-1, 3, 3)])
    centres = np.array([(x, y, z) for x in (-4, 4) for y in (-4, 4) for z in (-4, 4)], float)
    return soup((one[None] + centres[:, None, None]).reshape(-1, 3, 3))


def tiny(rng, count):
    """Edges of 10⁻⁶ to 10⁻³, crowded around the centre and points where three planes meet."""
    places = rng.choice(np.array([(0, 0, 0), (4, 4, 4), (-4, 0, 4), (0, -4, -4), (2, 2, -2)], float), count)
    size = 10 ** rng.uniform(-6, -3, (count, 1, 1))
    middle = places + rng.normal(0, 0.02, (count, 3))
    on_plane = rng.uniform(0, 1, (count, 3)) < 0.3
    middle = np.where(on_plane, places, middle)
    return soup(middle[:, None] + size * rng.uniform(-1, 1, (count, 3, 3)))


def duplicates(rng, count):
    """Each triangle four times: twice as it is, once turned, once reversed."""
    base = rng.uniform(-HALF, HALF, (count, 1, 3)) + rng.uniform(-0.4, 0.4, (count, 3, 3))
    base = np.clip(base, -HALF, HALF)
    return soup(np.concatenate([base, base, base[:, [1, 2, 0]], base[:, [2, 1, 0]]]))


def degenerate(rng, count):
    """No area: a point, a doubled corner, three corners in a row; some on the likely planes."""
    a, b = rng.integers(-64, 65, (2, count, 3)) / 8.0
    kinds = [np.stack([a, a, a], 1), np.stack([a, b, b], 1), np.stack([a, (a + b) / 2, b], 1)]
    return soup(np.concatenate(kinds))


def cube(lo, hi):
    """Closed, outward."""
    v = np.array([[(lo, hi)[k >> axis & 1] for axis in range(3)] for k in range(8)], float)
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return v, np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def write_ply(path, v, f):
    faces = np.empty(len(f), dtype=[("count", "u1"), ("indices", "<i4", 3)])
    faces["count"], faces["indices"] = 3, f
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(v)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(f)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    path.write_bytes(header.encode() + v.astype("<f4").tobytes() + faces.tobytes())


def objects(detail):
    """(name, material, mesh) in a fixed order."""
    rng = np.random.default_rng(20140)
    many = lambda count: max(4, int(count * detail))
    return [
        ("giants", "chalk", giants()),
        ("slivers", "sea", slivers(rng, many(6000))),
        ("grids", "moss", grids(4 * max(2, int(6 * detail**0.5)))),
        ("spheres", "brick", spheres(max(4, int(20 * detail**0.5)))),
        ("tiny", "sun", tiny(rng, many(8000))),
        ("duplicates", "sea", duplicates(rng, many(1200))),
        ("degenerate", "brick", degenerate(rng, many(600))),
        ("glass", "glass", cube(-1.0, 1.0)),
    ]


def scene_text(parts, width, height, spp):
    lines = [f"""# A scene built to break domain decomposition. Written by generate.py; licence: Apache-2.0.

LookAt 3 1.6 -16   0 -0.2 0   0 1 0
Camera "perspective" "float fov" [50]
Film "rgb" "string filename" "adversarial.exr" "integer xresolution" [{width}] "integer yresolution" [{height}]
PixelFilter "box"
Sampler "independent" "integer pixelsamples" [{spp}]
Integrator "path" "integer maxdepth" [16]

WorldBegin

LightSource "infinite" "rgb L" [0.30 0.36 0.45]
LightSource "distant" "point3 from" [3 5 -4] "point3 to" [0 0 0] "rgb L" [0.9 0.8 0.6]
LightSource "point" "point3 from" [2.5 4.5 -6] "rgb I" [14 13 11]
MakeNamedMaterial "glass" "string type" "dielectric" "spectrum eta" "glass-BK7"
"""]
    for name, rgb in COLOURS.items():
        lines.append(
            f'MakeNamedMaterial "{name}" "string type" "diffuse" "rgb reflectance" [{rgb[0]} {rgb[1]} {rgb[2]}]'
        )
    for name, material, _ in parts:
        lines.append(f'NamedMaterial "{material}"\nShape "plymesh" "string filename" "meshes/{name}.ply"')
    lines.append("""
# The lamp: its triangles meet exactly in the plane x = 0.
AttributeBegin
  NamedMaterial "chalk"
  AreaLightSource "diffuse" "rgb L" [6 5.5 5]
  Shape "trianglemesh" "point3 P" [-2 7.5 -2   0 7.5 -2   2 7.5 -2   2 7.5 2   0 7.5 2   -2 7.5 2]
    "integer indices" [0 1 4  0 4 5  1 2 3  1 3 4]
AttributeEnd
""")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description="writes adversarial.pbrt and its meshes")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    parser.add_argument(
        "--detail", type=float, default=1.0, metavar="D", help="scales the triangle count (default 1)"
    )
    parser.add_argument("--width", type=int, default=480)
    parser.add_argument("--height", type=int, default=360)
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel (default 64)")
    args = parser.parse_args()
    (args.output / "meshes").mkdir(parents=True, exist_ok=True)
    parts = objects(args.detail)
    for name, _, (v, f) in parts:
        write_ply(args.output / "meshes" / f"{name}.ply", v, f)
    (args.output / "adversarial.pbrt").write_text(scene_text(parts, args.width, args.height, args.spp))
    print(f"{args.output / 'adversarial.pbrt'}: {sum(len(f) for _, _, (_, f) in parts) + 4} triangles")


if __name__ == "__main__":
    main()
