#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares pictures of POV-Ray scenes with POV-Ray's own: silhouettes, and means of 8 × 8 blocks.

  tests/conformance/povray_pictures.py silhouettes [--bin build/release/bin] [--out FILE.tsv] [SCENE.pov]...
  tests/conformance/povray_pictures.py blocks --sheet sheet.jpg --list names.txt

Without scenes all of Debian's povray-examples. It needs povray, and Pillow and NumPy for Python.

silhouettes: what objects cover, whatever their textures let through: by povray at quality 1 (flat, opaque) with alpha,
and by povray_mask (of the tests; the same importer and tracer, every texture flat and opaque). Surroundings, fog and
media do not count. The number is intersection ÷ union of the coverages of 80 × 60 blocks: Σ min ÷ Σ max.
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


def by_povray(scene, folder, options, extra, original=None):
    """`original`: the file that the scene includes. Of an animation the first frame, as the reader has it, but where
    the scene asks whether it is one: it is none."""
    original = original or scene
    text = original.read_bytes()
    target = folder / "povray.png"
    if b"frame_number" in text and b"clock_on" not in text:
        extra = [*extra, "+KFI1", "+KFF2", "+SF1", "+EF1"]
    # Quoted: povray ends an unquoted name at a space, and shows the file of the rest of it, if there is one.
    run(["povray", f'+I"{scene}"', f"+O{target}", f"+W{options.width}", f"+H{options.height}", "-D", "-GA", "+WT1",
         f'+L"{original.parent}"', *extra], options.seconds, folder)
    pictures = sorted(folder.glob("povray*.png"))
    if not pictures:
        raise Skipped("povray refuses it")
    return Image.open(pictures[0])


def film_of(scene, folder, options, extra):
    film = folder / "vitrail.film"
    done = run([options.bin / "vitrail", "render", scene, "-o", film, "--width", str(options.width), "--height",
                str(options.height), "--missing", "replace", "--force", "--quiet", "--threads", "1", *extra],
               options.seconds)
    if done.returncode:
        raise Skipped((done.stderr.strip().splitlines() or ["render fails"])[0][:160])
    return film


def by_vitrail(scene, folder, options, extra):
    target = folder / "vitrail.png"
    run([options.bin / "vitrail", "develop", film_of(scene, folder, options, extra), "-o", target], options.seconds)
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


def silhouettes(scene, folder, options):
    """A second time with nine times the samples where the first falls short: letters and wires have much edge."""
    number, pair = masks(scene, folder, options, 1)
    return (number, pair) if number >= 0.98 else masks(scene, folder, options, 3)


def masks(scene, folder, options, finer):
    # As wide for its height as the reader has image_width and image_height. POV-Ray's own anti-aliasing looks closer
    # only where neighbours differ, and misses what is thinner than a pixel: here each sample is a pixel of its own.
    columns, rows, block = 640 * finer, 480 * finer, 8 * finer
    options = argparse.Namespace(**{**vars(options), "width": columns, "height": rows})
    bare = folder / "bare.pov"
    nothing = "color rgbt <0, 0, 0, 1>"
    bare.write_text(f'#include "{scene}"\nbackground {{ {nothing} }}\nsky_sphere {{ pigment {{ {nothing} }} }}\n')
    theirs = by_povray(bare, folder, options, ["+Q1", "+UA", "-A"], scene)
    ours = folder / "mask.pgm"
    done = run([options.bin / "povray_mask", bare, str(columns // block), str(rows // block), str(block * block), ours,
                scene.parent], options.seconds)
    if done.returncode:
        raise Skipped((done.stderr.strip().splitlines() or ["the mask fails"])[0][:160])
    a = coverage(theirs).reshape(rows // block, block, columns // block, block).mean(axis=(1, 3))
    b = np.asarray(Image.open(ours), dtype=float) / 255
    union = np.maximum(a, b).sum()
    if union == 0:
        raise Skipped("nothing is seen")
    return np.minimum(a, b).sum() / union, tuple(Image.fromarray(np.uint8(255 * mask)) for mask in (a, b))


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
    # The reader has 640 × 480 as image_width and image_height, whatever the camera sees.
    shown = argparse.Namespace(**{**vars(options), "height": options.width * 3 // 4})
    theirs = by_povray(scene, folder, shown, ["+A0.1"]).resize((options.width, options.height), Image.BOX)
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
