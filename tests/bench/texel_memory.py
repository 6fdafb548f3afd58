#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What it costs to hold an eighth of a scene's texels: a floor and walls of 16 images of 2048^2 pixels, under a sky.

  tests/bench/texel_memory.py [--folder build/texel_memory] [--runs 3]

`trilinear` and `bilinear` are pbrt's filters: the first takes the MIP level of a ray's footprint, the second the finest texels
whatever the footprint. Each is rendered with memory for all tiles and for an eighth of them, in turns; processor seconds, their
ratio, tiles that were read, and whether the films agree. Needs numpy.
"""
import argparse
import json
import pathlib
import statistics
import struct
import subprocess
import zlib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
SIZE, IMAGES = 2048, 16


def photograph(seed):
    """Like one: as much in every octave."""
    random = np.random.default_rng(seed)
    picture = np.zeros((SIZE, SIZE, 3))
    for octave in range(2, 12):
        cells = random.random((2 ** octave, 2 ** octave, 3)) - .5
        picture += np.kron(cells, np.ones((SIZE >> octave, SIZE >> octave, 1))) / 4
    return (255 * np.clip(picture + .5, 0, 1)).astype(np.uint8)


def write_png(file, pixels):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    rows = np.concatenate([np.zeros((SIZE, 1), np.uint8), pixels.reshape(SIZE, -1)], axis=1)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", SIZE, SIZE, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)) + chunk(b"IEND", b""))


def write_scene(folder, images, filter_name):
    """A floor of 4 x 2 squares and a wall of as many."""
    text = ['LookAt 0 1.5 -5  0 1 0  0 1 0', 'Camera "perspective" "float fov" 60',
            'Film "rgb" "integer xresolution" 480 "integer yresolution" 270', 'Integrator "volpath" "integer maxdepth" 5',
            'WorldBegin', 'LightSource "infinite" "rgb L" [1 1 1]']
    for i, image in enumerate(images):
        x, level = 2 * (i % 4) - 4, i // 4
        y0, z0, y1, z1 = ((0, 2 * level - 4, 0, 2 * level - 2) if level < 2 else (2 * level - 4, 0, 2 * level - 2, 0))
        text += [f'Texture "t{i}" "spectrum" "imagemap" "string filename" "{image.name}" "string filter" "{filter_name}"',
                 f'Material "diffuse" "texture reflectance" "t{i}"',
                 f'Shape "trianglemesh" "point3 P" [{x} {y0} {z0} {x + 2} {y0} {z0} {x + 2} {y1} {z1} {x} {y1} {z1}] '
                 '"point2 uv" [0 0 1 0 1 1 0 1] "integer indices" [0 1 2 0 2 3]']
    file = folder / f"{filter_name}.pbrt"
    file.write_text("\n".join(text) + "\n")
    return file


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build/texel_memory")
    parser.add_argument("--vitrail", default=ROOT / "build/release/bin/vitrail")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--spp", type=int, default=16)
    a = parser.parse_args()
    a.folder.mkdir(parents=True, exist_ok=True)
    images = [a.folder / f"{i}.png" for i in range(IMAGES)]
    for i, image in enumerate(images):
        if not image.exists():
            write_png(image, photograph(i))
    print("| filter | texels, MB | all, s | an eighth, s | all ÷ an eighth | tiles in all | read: all | an eighth | films |\n" + "|---" * 9 + "|")
    for name in "trilinear", "bilinear":
        bundle = a.folder / f"{name}.vit"
        if not bundle.exists():
            run(a.vitrail, "partition", write_scene(a.folder, images, name), "-o", bundle, "--domains", 1, "--quiet")
        texels = sum(f.stat().st_size for f in (bundle / "textures").iterdir())
        stats = {share: [] for share in (1, 8)}
        for _ in range(a.runs):
            for share, seen in stats.items():
                # A quarter of --memory is for tiles.
                options = ["--memory", 4 * texels // share] if share > 1 else []
                run(a.vitrail, "render", bundle, "-o", a.folder / "a.film", "--force", "--quiet", "--threads", 1, "--spp", a.spp,
                    "--stats", a.folder / "stats.json", *options)
                seen.append(json.loads((a.folder / "stats.json").read_text()))
        all_s, eighth_s = (statistics.median(s["cpu_s"] for s in seen) for seen in stats.values())
        ratio = statistics.median(x["cpu_s"] / y["cpu_s"] for x, y in zip(*stats.values()))
        hashes = {s["film_hash"] for seen in stats.values() for s in seen}
        reads = [seen[0].get("tiles_read", "") for seen in stats.values()]
        print(f"| {name} | {texels / 1e6:.0f} | {all_s:.2f} | {eighth_s:.2f} | {ratio:.2f} | {texels >> 14} | {reads[0]} | {reads[1]} | "
              f"{'the same' if len(hashes) == 1 else 'DIFFER'} |", flush=True)


main()
