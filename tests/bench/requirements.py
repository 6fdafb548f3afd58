#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What it costs to have, store and send what a scene does not require: four small scenes, each partitioned as
its requirements say and with --require-everything. Prints a table for docs/why/measurements.md. The two pictures differ
by noise alone: tangents follow (u, v) where a bundle has them, and samples turn with them. Instructions are those of
valgrind's callgrind on the middle of the picture, one thread, all of the process but for what a render of one sample a
pixel takes: other work on the machine does not show in them.

    tests/bench/requirements.py [--bin build/release/bin] [--keep DIR] [--spp 9]
"""

import argparse
import json
import math
import os
import random
import re
import struct
import subprocess
import tempfile
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MPI = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
}
MIB = 1 << 20
MIDDLE = (60, 100, 45, 75)  # x0, x1, y0, y1


def write_png(path, size=256):
    """Noise: every texel differs."""
    rng = random.Random(1)
    data = b"".join(b"\0" + rng.randbytes(3 * size) for _ in range(size))

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    body = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data, 1)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + body)


def write_spheres(path, normals, uvs, rings=50, count=3):
    """count³ unit-grid spheres of 4·rings·(rings − 1) triangles."""
    segments = 2 * rings
    layout = ["x", "y", "z"] + ["nx", "ny", "nz"] * normals + ["u", "v"] * uvs
    vertices, faces = bytearray(), bytearray()
    total = 0
    for cell in range(count**3):
        centre = [3 * (cell // count**k % count) - 1.5 * (count - 1) for k in range(3)]
        for j in range(rings + 1):
            for i in range(segments + 1):
                t, p = math.pi * j / rings, 2 * math.pi * (i % segments) / segments
                r = math.sin(t) if 0 < j < rings else 0.0
                n = (r * math.cos(p), -math.cos(t), r * math.sin(p))
                row = [c + a for c, a in zip(centre, n)] + list(n) * normals + [i / segments, j / rings] * uvs
                vertices += struct.pack(f"<{len(row)}f", *row)
        first = cell * (rings + 1) * (segments + 1)
        for j in range(rings):
            for i in range(segments):
                a = first + j * (segments + 1) + i
                b = a + segments + 1
                for face in ([(a, b, a + 1)] if j else []) + ([(a + 1, b, b + 1)] if j < rings - 1 else []):
                    faces += struct.pack("<B3i", 3, *face)
                    total += 1
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {count**3 * (rings + 1) * (segments + 1)}\n"
    header += "".join(f"property float {name}\n" for name in layout)
    header += f"element face {total}\nproperty list uchar int vertex_indices\nend_header\n"
    path.write_bytes(header.encode() + vertices + faces)


SCENES = {
    "grey diffuse": ("flat", 'Material "diffuse" "float reflectance" [0.6]'),
    "textured": (
        "flat",
        'Texture "t" "spectrum" "imagemap" "string filename" "noise.png"\n'
        'Material "diffuse" "texture reflectance" "t"',
    ),
    "dispersive": ("smooth", 'Material "dielectric" "spectrum eta" "glass-SF11"'),
    "media": (
        "flat",
        'MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [0.1 0.2 0.3] "rgb sigma_s" [1 1 1]\n'
        'MediumInterface "fog" ""\nMaterial "dielectric" "float eta" [1.4]',
    ),
}


def scene_text(mesh, material, spp):
    return f"""LookAt 3 5 -14   0 0 0   0 1 0
Camera "perspective" "float fov" [42]
Film "rgb" "integer xresolution" [160] "integer yresolution" [120] "string filename" "x.exr"
PixelFilter "box"
Sampler "independent" "integer pixelsamples" [{spp}]
Integrator "volpath" "integer maxdepth" [8]
WorldBegin
LightSource "infinite" "rgb L" [0.4 0.5 0.6]
LightSource "point" "point3 from" [6 9 -8] "rgb I" [120 110 100]
AttributeBegin
Material "diffuse" "float reflectance" [0.5]
Shape "trianglemesh" "point3 P" [-20 -5 -20  -20 -5 20  20 -5 20  20 -5 -20] "integer indices" [0 1 2 0 2 3]
AttributeEnd
{material}
Shape "plymesh" "string filename" "{mesh}.ply"
"""


class Bench:
    def __init__(self, programs, folder):
        self.programs, self.folder = programs, folder

    def call(self, program, *arguments, ranks=0):
        stats = self.folder / "stats.json"
        command = ["mpirun", "-np", str(ranks)] if ranks else []
        command += [str(self.programs / f"vitrail-{program}"), *map(str, arguments), "--stats", str(stats)]
        done = subprocess.run(command, env=os.environ | MPI, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
        return json.loads(stats.read_text())

    def partition(self, scene, name, everything):
        bundle = self.folder / f"{name}.vit"
        stats = self.call("partition", scene, "-o", bundle, "--domains", 16, "--force", *["--require-everything"] * everything)
        needs = json.loads((bundle / "manifest.json").read_text())["requirements"]
        return bundle, stats["bundle_bytes"] / stats["input_triangles"], needs

    def render(self, bundle, *more, ranks=0, threads=1):
        film = self.folder / "x.film"
        return self.call("render", bundle, "-o", film, "--force", "--threads", threads, "--progress", "none", *more,
                         ranks=ranks)

    def instructions(self, bundle, spp):
        command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", str(self.programs / "vitrail-render"),
                   str(bundle), "-o", str(self.folder / "x.film"), "--threads", "1", "--progress", "none", "--force",
                   "--spp", str(spp), "--crop", ",".join(map(str, MIDDLE))]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
        return int(re.search(r"Collected : (\d+)", done.stderr)[1])

    def instructions_a_sample(self, bundle, spp):
        pixels = (MIDDLE[1] - MIDDLE[0]) * (MIDDLE[3] - MIDDLE[2])
        return (self.instructions(bundle, spp) - self.instructions(bundle, 1)) / (pixels * (spp - 1))

    def bytes_a_ray(self, bundle):
        """Two ranks with a quarter of the memory each."""
        domains = [f.stat().st_size for f in sorted((bundle / "domains").iterdir())]
        held = max(sum(domains) // 4, max(domains))
        all_of_it = self.render(bundle, "--spp", 1, ranks=2)
        memory = int(all_of_it["base_rss_bytes"] + 14 * MIB + 1.25 * held)
        stats = self.render(bundle, "--spp", 2, "--memory", memory, "--domain-memory", held, ranks=2)
        return stats["forwarded_bytes"] / stats["forwarded_rays"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="where to leave scenes and bundles")
    parser.add_argument("--spp", type=int, default=9, help="samples a pixel whose instructions are counted")
    args = parser.parse_args()
    temporary = None if args.keep else tempfile.TemporaryDirectory()
    folder = args.keep or Path(temporary.name)
    folder.mkdir(parents=True, exist_ok=True)
    bench = Bench(args.bin, folder)
    write_png(folder / "noise.png")
    write_spheres(folder / "flat.ply", normals=False, uvs=True)
    write_spheres(folder / "smooth.ply", normals=True, uvs=True)

    rows = {}
    for name, (mesh, material) in SCENES.items():
        scene = folder / f"{name.replace(' ', '-')}.pbrt"
        scene.write_text(scene_text(mesh, material, args.spp))
        for everything in (False, True):
            kind = "all" if everything else "own"
            bundle, per_triangle, needs = bench.partition(scene, f"{scene.stem}-{kind}", everything)
            rows[name, everything] = [per_triangle, bench.bytes_a_ray(bundle),
                                      bench.instructions_a_sample(bundle, args.spp), needs]

    print("| scene | requires | bytes a triangle | with everything | bytes a ray | with everything |"
          " instructions a sample | with everything |")
    print("|---|---|---|---|---|---|---|---|")
    for name in SCENES:
        own, everything = rows[name, False], rows[name, True]
        needs = ", ".join(k for k, v in own[3].items() if v) or "nothing"
        cells = [name, needs]
        for i in (0, 1):
            cells += [f"{own[i]:.1f}", f"{everything[i]:.1f}"]
        cells += [f"{row[2]:.0f}" for row in (own, everything)]
        print("| " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
