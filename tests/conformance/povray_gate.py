#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds POV-Ray scenes of others, in a folder of repositories, to POV-Ray's own pictures.

  tests/conformance/povray_gate.py FOLDER [--count 60] [--out FILE.tsv] [--sheet sheet.jpg] [--bin build/release/bin]

It takes scenes from each folder of FOLDER in turn, leaves out those that povray refuses, takes too long for or shows
otherwise each time, and stops at --count. A scene that falls short is looked at once more, with four times the samples
and 64 rays a pixel of povray. It needs povray, and Pillow, NumPy and OpenEXR for Python. For each scene it prints:

  light       the mean light of our picture over that of POV-Ray's (both decoded from sRGB, as files have them)
  blocks      how many of 8 × 6 blocks agree: three channels, each within 3 % of the block, plus 1 % of the mean of
              the picture, plus three standard errors of our samples (from four seeds)
  worst       the difference of the worst block beyond three standard errors, over its light and that 1 %
  silhouette  intersection over union of what objects cover (povray_pictures.py)

At the end: the share with a mean within 3 %, and with all blocks. A scene that Vitrail refuses counts as neither.
"""
import argparse
import collections
import pathlib
import sys
import tempfile

import numpy as np
import OpenEXR
from PIL import Image

import povray_pictures as pictures

HERE = pathlib.Path(__file__).resolve()
COLUMNS, ROWS, SEEDS = 8, 6, 4
Row = collections.namedtuple("Row", "scene light agreeing worst silhouette why pair")


def in_turn(folder):
    """The scenes of each folder in turn, those of one evenly over its names."""
    queues = []
    for top in sorted(path for path in folder.iterdir() if path.is_dir()):
        scenes = sorted(path for path in top.rglob("*") if path.suffix.lower() == ".pov")
        step = max(1, len(scenes) // 5)
        queues.append([scene for first in range(step) for scene in scenes[first::step]])
    while any(queues):
        for queue in queues:
            if queue:
                yield queue.pop(0)


def block_means(light):
    """Light of ROWS × COLUMNS blocks."""
    rows = [np.array_split(band, COLUMNS, axis=1) for band in np.array_split(light, ROWS, axis=0)]
    return np.array([[block.mean(axis=(0, 1)) for block in row] for row in rows])


def averaged(lights, mean):
    """The picture of all seeds together as files have it, at most 1, and the standard error of its blocks. What is above
    1 by no more than noise stays: noise of white would be cut on one side alone."""
    error = np.std(lights, axis=0, ddof=1) / np.sqrt(len(lights))
    white = (mean > 1 + 3 * error) | (mean > 1.1)
    blocks = [block_means(np.where(white, 1, light)) for light in lights]
    return np.where(white, 1, mean), np.std(blocks, axis=0, ddof=1) / np.sqrt(len(lights))


def light_of_films(films, folder, options):
    """Below 0 too: noise of black would else be cut on one side alone."""
    target = folder / "vitrail.exr"
    pictures.run([options.bin / "vitrail", "develop", *films, "-o", target], options.seconds)
    with OpenEXR.File(str(target)) as file:
        return np.array(file.channels()["RGB"].pixels, dtype=float)


def film_by_us(scene, folder, options, seed):
    extra = ["--spp", str(max(1, options.spp // SEEDS)), "--seed", str(seed)]
    return pictures.film_of(scene, folder, options, extra).rename(folder / f"{seed}.film")


def by_us(scene, folder, options):
    """The picture of all seeds, its light by block, and the standard error of that. The films are merged before they
    are developed: by an assumed_gamma the mean of noisy pictures would be brighter than the picture of the mean."""
    films = [film_by_us(scene, folder, options, seed) for seed in range(1, SEEDS + 1)]
    whole, errors = averaged([light_of_films([film], folder, options) for film in films],
                             light_of_films(films, folder, options))
    encoded = np.where(whole <= 0.0031308, 12.92 * whole, 1.055 * np.maximum(whole, 1e-9) ** (1 / 2.4) - 0.055)
    return Image.fromarray(np.uint8(np.round(255 * np.clip(encoded, 0, 1)))), block_means(whole), errors


def by_povray_alike(scene, folder, shown, finer):
    """Its picture of finer × finer rays a pixel, if it is one: not black, and the same a second time (a scene may be random by the time of day)."""
    first, second = (pictures.by_povray(scene, folder, shown, ["+A0.0", "+AM1", f"+R{finer}"]).convert("RGB") for _ in range(2))
    if np.asarray(first).max() <= 2:
        raise pictures.Skipped("povray shows black")
    if np.abs(np.asarray(first, dtype=float) - np.asarray(second, dtype=float)).mean() > 1:
        raise pictures.Skipped("povray shows something else each time")
    return first


def agrees(row):
    return row.light is not None and abs(row.light - 1) <= 0.03 and row.agreeing == COLUMNS * ROWS


def compared(scene, folder, options):
    """A scene that falls short is looked at again with more rays of both programs: stars, wires and few samples under
    an assumed_gamma need them."""
    row = compared_with(scene, folder, options, 3)
    if row.light is None or agrees(row):
        return row
    try:
        return compared_with(scene, folder, argparse.Namespace(**{**vars(options), "spp": 4 * options.spp}), 8)
    except pictures.Skipped:
        return row


def compared_with(scene, folder, options, finer):
    shown = argparse.Namespace(**{**vars(options), "height": options.width * 3 // 4})
    theirs = by_povray_alike(scene, folder, shown, finer)
    try:
        sized = pictures.sized(options, pictures.report_of(scene, options))
        ours, means, errors = by_us(scene, folder, sized)
        theirs = theirs.resize((sized.width, sized.height), Image.BOX)
    except pictures.Skipped as why:
        return Row(scene, None, 0, None, None, str(why), (theirs, Image.new("RGB", theirs.size, (255, 0, 255))))
    wanted = block_means(pictures.light_of(theirs))
    picture = max(wanted.mean(), means.mean(), 1e-6)
    beyond = np.maximum(np.abs(means - wanted) - 3 * errors, 0)
    agrees = (beyond <= 0.03 * np.maximum(means, wanted) + 0.01 * picture).all(axis=2)
    worst = (beyond / (np.maximum(means, wanted) + picture / 3)).max()
    try:
        silhouette = None if options.without_silhouettes else pictures.silhouettes(scene, folder, options)[0]
    except pictures.Skipped:
        silhouette = None
    return Row(scene, means.mean() / max(wanted.mean(), 1e-6), int(agrees.sum()), worst, silhouette, "", (theirs, ours))


def line_of(row, top):
    number = lambda value, form: "-" if value is None else format(value, form)
    return "\t".join([str(row.scene.relative_to(top)), number(row.light, ".3f"), f"{row.agreeing}/{COLUMNS * ROWS}",
                      number(row.worst, ".1%"), number(row.silhouette, ".3f"), row.why])


def main():
    parser = argparse.ArgumentParser(description="Holds POV-Ray scenes of others to POV-Ray's own pictures.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--list", type=pathlib.Path, help="a scene a line, below the folder, instead of those in turn")
    parser.add_argument("--bin", type=pathlib.Path, default=HERE.parents[2] / "build/release/bin")
    parser.add_argument("--width", type=int, default=160)
    parser.add_argument("--spp", type=int, default=64, help="of all seeds together")
    parser.add_argument("--seconds", type=float, default=60, help="of each program")
    parser.add_argument("--without-silhouettes", action="store_true")
    parser.add_argument("--out", type=pathlib.Path, help="the lines, into a file")
    parser.add_argument("--sheet", type=pathlib.Path, help="all pairs as one picture, POV-Ray's at the left, the worst first")
    options = parser.parse_args()
    options.height = None
    scenes = [options.folder / line for line in options.list.read_text().split("\n") if line] if options.list else in_turn(options.folder)
    out = options.out.open("w") if options.out else sys.stdout
    rows, left_out = [], 0
    print("scene\tlight\tblocks\tworst\tsilhouette\twhy", file=out)
    for scene in scenes:
        with tempfile.TemporaryDirectory() as folder:
            try:
                row = compared(scene.resolve(), pathlib.Path(folder), options)
            except (pictures.Skipped, OSError, Image.DecompressionBombError):
                left_out += 1
                continue
        rows.append(row)
        print(line_of(row, options.folder.resolve()), file=out, flush=True)
        if len(rows) == options.count:
            break
    if not rows:
        sys.exit("no scene was compared")
    means = sum(row.light is not None and abs(row.light - 1) <= 0.03 for row in rows)
    whole = sum(row.light is not None and row.agreeing == COLUMNS * ROWS for row in rows)
    print(f"{len(rows)} scenes of {len({row.scene.relative_to(options.folder.resolve()).parts[0] for row in rows})} folders: "
          f"mean within 3 %: {means} ({means / len(rows):.0%}); every block: {whole} ({whole / len(rows):.0%}); "
          f"left out, as povray shows nothing, or no two pictures alike: {left_out}")
    if options.sheet:
        worst_first = sorted(rows, key=lambda row: 1e9 if row.light is None else row.worst, reverse=True)
        pictures.sheet_of([(row.worst, row.pair) for row in worst_first], options.sheet)


if __name__ == "__main__":
    main()
