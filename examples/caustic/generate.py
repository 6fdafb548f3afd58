#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a wine glass on a table in the sun or under a lamp, as a PBRT v4 scene with a binary PLY mesh.

Sample runs:
    ./generate.py -o /tmp/caustic                        the evening sun of Paris
    ./generate.py -o /tmp/caustic --light lamp           a small lamp beside it
    ./generate.py -o /tmp/caustic --glass glass-SF11 --width 960
"""

import argparse
from pathlib import Path

import numpy as np

# Half sections (r, z) in mm, from the axis over the outside to the rim and down the inside: corners of quadratic
# B-splines, which touch their first and last.
OUTSIDE = [
    (0, 0), (34, 0), (37, 0), (37, 2.5), (20, 4), (5, 8), (4, 30), (4, 46), (7, 52), (26, 58), (37, 80), (36, 105),
    (31, 138), (30.2, 140.6),
]  # fmt: skip
INSIDE = [
    (30.2, 140.6), (29.6, 141), (29.2, 138), (34, 105), (35, 81), (25, 61), (12, 56), (4, 56), (0, 56)
]  # fmt: skip
SKY = "48.86,2.35,2026-06-21T18:00+02:00,turbidity=2.5"  # the sun 35° high in the west
LAMP, LAMP_AT = 0.3, (-0.32, 0.08, 0.3)  # intensity on its axis


def spline(corners, steps):
    """Points and tangents along a uniform quadratic B-spline whose ends are the corners'."""
    p = np.array(corners, float)
    p = np.concatenate([[2 * p[0] - p[1]], p, [2 * p[-1] - p[-2]]])
    t = (np.arange(steps) / steps)[None, :, None]
    a, b, c = (p[k : len(p) - 2 + k, None] for k in range(3))
    points = (a * (1 - t) ** 2 + b * (1 + 2 * t - 2 * t**2) + c * t**2) / 2
    along = b - a + (a - 2 * b + c) * t
    last = (p[-2] + p[-1]) / 2
    return np.concatenate([points.reshape(-1, 2), [last]]), np.concatenate(
        [along.reshape(-1, 2), [p[-1] - p[-2]]]
    )


def turned_on_a_lathe(detail):
    """Positions in metres, normals and triangles of the closed glass, outward."""
    steps, count = max(2, round(10 * detail)), max(8, round(192 * detail))
    rows = []
    for corners in (OUTSIDE, INSIDE):
        points, along = spline(corners, steps)
        outward = np.stack([along[:, 1], -along[:, 0]], axis=1)
        outward /= np.linalg.norm(outward, axis=1, keepdims=True)
        points[:, 0] = points[:, 0].clip(0)
        rows.append((points, outward))
    points, outward = (np.concatenate(parts) for parts in zip(*rows))
    angle = 2 * np.pi * np.arange(count) / count

    def around(section):
        r, z = section[:, None, 0], section[:, None, 1]
        return np.stack([r * np.cos(angle), r * np.sin(angle), z + 0 * angle], axis=-1).reshape(-1, 3)

    index = np.arange(len(points) * count).reshape(len(points), count)
    a, b = index[:-1], index[1:]
    quads = np.stack([a, np.roll(a, -1, 1), np.roll(b, -1, 1), b], axis=-1).reshape(-1, 4)
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    v, n = around(points) / 1000, around(outward)
    corner = v[faces]
    area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    return v, n, faces[area > 1e-12]


def write_ply(path, v, n, faces):
    records = np.empty(len(faces), dtype=[("count", "u1"), ("indices", "<i4", 3)])
    records["count"], records["indices"] = 3, faces
    names = "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(v)}\n{names}"
    head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    path.write_bytes(head.encode() + np.concatenate([v, n], axis=1).astype("<f4").tobytes() + records.tobytes())


def scene(light, glass, width):
    lights = {
        "sun": f'LightSource "infinite" "string sky" "{SKY}"',
        "lamp": f'LightSource "spot" "point3 from" [{" ".join(map(str, LAMP_AT))}] "point3 to" [0 0 0.08] '
        f'"float coneangle" [24] "float conedeltaangle" [5] "blackbody I" [3000] "float scale" [{LAMP}]\n'
        'LightSource "infinite" "rgb L" [0.01 0.012 0.015]',
    }
    return f"""# A wine glass on a table. Metres, z up, y north. Written by generate.py; licence: Apache-2.0.

Scale -1 1 1  # pbrt's camera is left-handed
LookAt 0.11 -0.50 0.40  0.072 0.02 0.045  0 0 1
Camera "perspective" "float fov" [25]
Film "rgb" "string filename" "caustic.exr" "integer xresolution" [{width}] "integer yresolution" [{width * 3 // 4}]
PixelFilter "gaussian"
Sampler "independent" "integer pixelsamples" [256]
Integrator "path" "integer maxdepth" [12]

WorldBegin
# A form that pbrt reads past: its sky is one of a single radiance.
{lights[light]}

Material "diffuse" "spectrum reflectance" [360 0.30  420 0.42  480 0.52  560 0.60  640 0.66  720 0.68  830 0.68]
Shape "trianglemesh" "point3 P" [-0.3 -0.2 0  0.45 -0.2 0  0.45 0.6 0  -0.3 0.6 0] "integer indices" [0 1 2  0 2 3]

AttributeBegin
  Translate 0 0 0.0002
  Material "dielectric" "spectrum eta" "{glass}"
  Shape "plymesh" "string filename" "glass.ply"
AttributeEnd
"""


def main():
    parser = argparse.ArgumentParser(description="writes caustic.pbrt and glass.ply")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--light", choices=["sun", "lamp"], default="sun")
    parser.add_argument("--glass", default="glass-BK7", help="one of pbrt's named spectra (default glass-BK7)")
    parser.add_argument("--detail", type=float, default=1.0, help="of the mesh, along and around (default 1)")
    parser.add_argument("--width", type=int, default=640, help="of the picture, 4:3")
    args = parser.parse_args()
    args.output.mkdir(parents=True, exist_ok=True)
    v, n, faces = turned_on_a_lathe(args.detail)
    write_ply(args.output / "glass.ply", v, n, faces)
    (args.output / "caustic.pbrt").write_text(scene(args.light, args.glass, args.width))
    print(f"{args.output / 'caustic.pbrt'}: {len(faces)} triangles")


if __name__ == "__main__":
    main()
