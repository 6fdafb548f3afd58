#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares pictures of POV-Ray scenes with POV-Ray's own: silhouettes, and means of 8 × 8 blocks.

  tests/conformance/povray_pictures.py silhouettes [--bin build/release/bin] [--out FILE.tsv] [SCENE.pov]...
  tests/conformance/povray_pictures.py blocks --sheet sheet.jpg --list names.txt

Without scenes all of Debian's povray-examples. It needs povray, and Pillow and NumPy for Python.

silhouettes: what an object covers, by povray at quality 1 (flat colours of full light) with alpha, and by `render
--alpha`; surroundings do not count. The number is intersection ÷ union of the coverages: Σ min ÷ Σ max.
blocks: both pictures as light (sRGB decoded), in 8 × 8 blocks. The number is the mean difference of the blocks, over
the mean of POV-Ray's picture. Scenes with media, noise patterns or radiosity are left out, by what inspect says.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

HERE = pathlib.Path(__file__).resolve()
EXAMPLES = pathlib.Path("/usr/share/doc/povray/examples")
WITHOUT_BLOCKS = ("media", "fog", "noise", "radiosity", "rainbow", "photons", "crand", "normal")


class Skipped(Exception):
    """Why a scene has no number."""


def run(command, seconds, cwd=None):
    try:
        return subprocess.run(command, cwd=cwd, capture_output=True, text=True, errors="replace", timeout=seconds)
    except subprocess.TimeoutExpired:
        raise Skipped(f"{pathlib.Path(command[0]).name} takes too long") from None


def by_povray(scene, folder, options, extra):
    target = folder / "povray.png"
    run(["povray", f"+I{scene}", f"+O{target}", f"+W{options.width}", f"+H{options.height}", "-D", "-GA", "+WT1",
         f"+L{scene.parent}", *extra], options.seconds, folder)
    if not target.exists():
        raise Skipped("povray refuses it")
    return Image.open(target)


def by_vitrail(scene, folder, options, extra):
    film, target = folder / "vitrail.film", folder / "vitrail.png"
    done = run([options.bin / "vitrail", "render", scene, "-o", film, "--width", str(options.width), "--height",
                str(options.height), "--missing", "replace", "--force", "--quiet", "--threads", "1", *extra],
               options.seconds)
    if done.returncode:
        raise Skipped((done.stderr.strip().splitlines() or ["render fails"])[0][:160])
    run([options.bin / "vitrail", "develop", film, "-o", target], options.seconds)
    return Image.open(target)


def report_of(scene, options):
    done = run([options.bin / "vitrail", "inspect", scene, "--json", "--missing", "replace"], options.seconds)
    if done.returncode:
        raise Skipped("not read")
    return json.loads(done.stdout)


def sized(options, report):
    """As high as the scene's own picture is for its width: POV-Ray stretches what the camera sees, we do not."""
    columns, rows = report["view"]["pixels"]
    height = options.height or max(8, round(options.width * rows / columns))
    return argparse.Namespace(**{**vars(options), "height": height})


def notes_of(report):
    return [item["what"] for item in report["not_exact"]]


def coverage(image):
    if image.mode not in ("LA", "RGBA", "PA"):
        return np.ones((image.height, image.width))
    return np.asarray(image.getchannel("A"), dtype=float) / 255


def first_channel(path):
    """Of a Radiance picture whose rows are packed: a mantissa and the exponent that all channels share."""
    data = path.read_bytes()
    head, _, rest = data.partition(b"\n\n")
    size, _, packed = rest.partition(b"\n")
    words = size.split()
    rows, columns = int(words[1]), int(words[3])
    image, at = np.empty((rows, 4, columns)), 0
    for row in range(rows):
        at += 4
        for channel in range(4):
            values = []
            while len(values) < columns:
                count = packed[at]
                if count > 128:
                    values += [packed[at + 1]] * (count - 128)
                    at += 2
                else:
                    values += packed[at + 1 : at + 1 + count]
                    at += 1 + count
            image[row, channel] = values
    return image[:, 0] * 2.0 ** (image[:, 3] - 136)


def nearer_share(depth, radius):
    """What of each pixel is nearer than the surroundings, whose depth is greatest beside it: it falls to the edges."""
    rows, columns = depth.shape
    greatest = depth
    for _ in range(4):
        padded = np.pad(greatest, 1, mode="edge")
        greatest = np.max([padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)], axis=0)
    share = 1 - depth / np.maximum(greatest, 1e-9)
    share[share < 0.02] = 0
    return np.where(greatest > 0.4 * radius, share, 1)


def silhouettes(scene, folder, options):
    report = report_of(scene, options)
    options = sized(options, report)
    bare = folder / "bare.pov"
    nothing = "pigment { color rgbt <0, 0, 0, 1> }"
    bare.write_text(f'#include "{scene}"\nbackground {{ color rgbt <0, 0, 0, 1> }}\nsky_sphere {{ {nothing} }}\n')
    theirs = by_povray(bare, folder, options, [f"+L{scene.parent}", "+Q1", "+UA", "+A0.0", "+AM1", "+R4"])
    ours = by_vitrail(scene, folder, options, ["--spp", "64", "--filter", "box", "--alpha", "--max-depth", "0", "--aov", "depth"])
    a, b = coverage(theirs), coverage(ours)
    if any(note.startswith("what is around the scene") for note in notes_of(report)):
        # The sphere that stands for it is farther than all else: depths are means of what a pixel shows.
        run([options.bin / "vitrail", "develop", folder / "vitrail.film", "-o", folder / "depth.hdr", "--layer",
             "depth"], options.seconds)
        radius = (report["bounds_upper"][0] - report["bounds_lower"][0]) / 2
        depth = first_channel(folder / "depth.hdr")
        b = b * nearer_share(depth, radius)
    union = np.maximum(a, b).sum()
    if union == 0:
        raise Skipped("nothing is seen")
    return np.minimum(a, b).sum() / union, (theirs, ours)


def light_of(image):
    v = np.asarray(image.convert("RGB"), dtype=float) / 255
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def blocks_of(image):
    rows, columns = image.shape[0] // 8, image.shape[1] // 8
    return image[: 8 * rows, : 8 * columns].reshape(rows, 8, columns, 8, 3).mean(axis=(1, 3))


def blocks(scene, folder, options):
    report = report_of(scene, options)
    options = sized(options, report)
    for note in notes_of(report):
        if any(word in note for word in WITHOUT_BLOCKS):
            raise Skipped(f"has {note[:60]}")
    if b"radiosity" in scene.read_bytes():
        raise Skipped("has radiosity")
    theirs = by_povray(scene, folder, options, ["+A0.1"])
    ours = by_vitrail(scene, folder, options, ["--spp", str(options.spp)])
    a, b = blocks_of(light_of(theirs)), blocks_of(light_of(ours))
    return np.abs(a - b).mean() / max(a.mean(), 1e-3), (theirs, ours)


def sheet_of(rows, path, columns=4):
    """Pairs side by side, POV-Ray's at the left, the worst first."""
    across = rows[0][1][0].width
    width, height = 2 * across + 2, round(across * 3 / 4) + 2
    sheet = Image.new("RGB", (columns * (width + 4), -(-len(rows) // columns) * height))
    for i, (_, pair) in enumerate(rows):
        for j, image in enumerate(pair):
            image = image.convert("RGB")
            image.thumbnail((across, height - 2))
            corner = ((i % columns) * (width + 4) + j * (width // 2 + 1), i // columns * height)
            sheet.paste(image, corner)
    sheet.save(path, quality=80)


def main():
    parser = argparse.ArgumentParser(description="Compares pictures of POV-Ray scenes with POV-Ray's own.")
    parser.add_argument("measure", choices=["silhouettes", "blocks"])
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    parser.add_argument("--list", type=pathlib.Path, help="a scene a line, below the folder of povray-examples")
    parser.add_argument("--bin", type=pathlib.Path, default=HERE.parents[2] / "build/release/bin")
    parser.add_argument("--width", type=int, default=120)
    parser.add_argument("--height", type=int, help="of all; else each has the scene's own aspect")
    parser.add_argument("--spp", type=int, default=32, help="of blocks")
    parser.add_argument("--seconds", type=float, default=120, help="of each program")
    parser.add_argument("--out", type=pathlib.Path, help="a line a scene: its number, or why there is none")
    parser.add_argument("--sheet", type=pathlib.Path, help="all pairs as one picture, the worst first")
    options = parser.parse_intermixed_args()
    scenes = options.scenes or sorted(EXAMPLES.rglob("*.pov"))
    if options.list:
        scenes = [EXAMPLES / line for line in options.list.read_text().split()]
    measure = silhouettes if options.measure == "silhouettes" else blocks
    numbers, pairs = [], []
    out = options.out.open("w") if options.out else sys.stdout
    for scene in scenes:
        with tempfile.TemporaryDirectory() as folder:
            try:
                number, pair = measure(scene.resolve(), pathlib.Path(folder), options)
                numbers.append(number)
                pairs.append((number, tuple(image.convert("RGBA") for image in pair)))
                print(f"{scene}\t{number:.4f}", file=out, flush=True)
            except Skipped as why:
                print(f"{scene}\t-\t{why}", file=out, flush=True)
    if not numbers:
        sys.exit("no scene was compared")
    good = [n >= 0.98 if measure is silhouettes else n <= 0.03 for n in numbers]
    wanted = "intersection ÷ union ≥ 0.98" if measure is silhouettes else "blocks within 3 %"
    print(f"{sum(good)} of {len(numbers)} scenes: {wanted}; median {np.median(numbers):.4f}; "
          f"{len(scenes) - len(numbers)} not compared")
    if options.sheet:
        sheet_of(sorted(pairs, key=lambda p: p[0], reverse=measure is blocks), options.sheet)


if __name__ == "__main__":
    main()
