#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does the work of a sample grow with the size of the data? For each kind of data a scene of N, 8 N and 64 N items, in which rays
meet alike things. Prints a table: instructions a sample with N items, their growth with 8 N and 64 N, and bytes an item.

    tests/bench/growth.py [--bin build/release/bin] [--only WORD] [--short] [--page docs/why/growth.md]

Instructions are those of valgrind's callgrind on one thread: all of a render of many samples a pixel less all of one of fewer, so
that loading and what is done once do not count. Bytes an item are those of the bundle, and of the greatest resident memory of
`partition` and `render`: of 64 N less those of 8 N. Exit status 1 where a row grows beyond its limit, 77 without valgrind.
--short takes some rows, N and 8 N.
"""
import argparse
import collections
import functools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import growth_scenes as scenes

ROOT = pathlib.Path(__file__).resolve().parents[2]
PIXELS = 64 * 36
SKIPPED = 77  # as ctest has it
FLAT = 1.15, 1.25
AGAIN = 2
TREE = "a tree's depth"

# `most`: of the work at 8 N and 64 N, in that at N. `reason`: of a row that is not flat. `bytes`: of an item at most, in the bundle and
# resident in either program; None: not judged. `kept`: options of partition, `options`: of render; `spp`:
# of the two renders.
Row = collections.namedtuple("Row", "name write count item most reason bytes kept options spp short",
                             defaults=(FLAT, "", None, (), (), (4, 16), False))


def rows():
    s = scenes
    yield Row("grid of density", s.density, 16**3, "cell", short=True)
    yield Row("grid of emission", s.emission, 16**3, "cell")
    yield Row("grid of temperature", s.temperature, 16**3, "cell")
    yield Row("grid of colours", s.coloured, 16**3, "cell")
    yield Row("grid of extinction", functools.partial(s.heterogeneous, varies="sigma_t"), 16**3, "cell")
    yield Row("grid of albedo", functools.partial(s.heterogeneous, varies="albedo"), 16**3, "cell")
    yield Row("image, bilinear", functools.partial(s.image, filter_name="bilinear"), 128**2, "texel", spp=(24, 32))
    yield Row("image, by levels", functools.partial(s.image, filter_name="trilinear"), 128**2, "texel", (1.25, 1.25),
              "two levels where the first is too fine", spp=(8, 16))
    yield Row("sky image", s.sky_image, 128**2, "texel", (2, 4), "spectra of texels that are met first", spp=(24, 32))
    yield Row("lamp's image", s.goniometric, 128**2, "texel", spp=(24, 32))
    yield Row("spectra", s.spectra, 1600, "sample", short=True)
    yield Row("measured table", s.measured, 16384, "value", spp=(8, 16))
    yield Row("table of Fourier series", s.fourier, 256, "pair", spp=(8, 16))
    yield Row("point lights", s.points, 500, "light", (1.25, 1.4), TREE, bytes=(45, 450, 420), short=True)
    yield Row("spot lights", s.spots, 300, "light", (1.25, 1.4), TREE)
    yield Row("distant lights", s.distant, 32, "light", short=True)
    yield Row("triangles that shine", s.lamp_triangles, 1000, "triangle", (1.5, 2), TREE)
    yield Row("spheres that shine", s.lamp_spheres, 250, "sphere", (1.5, 2), TREE)
    yield Row("triangles", s.triangles, 5000, "triangle", (1.5, 2), TREE, short=True)
    yield Row("curves", s.curves, 500, "curve", (1.5, 2), TREE, bytes=(230, 1200, 230))
    yield Row("quadrics", s.spheres, 250, "sphere", (1.5, 2), TREE)
    yield Row("instances", s.instances, 400, "instance", (1.5, 2), TREE)
    yield Row("prototypes", s.prototypes, 100, "prototype", (1.5, 2), TREE)
    yield Row("materials", s.materials, 100, "material", (1.5, 2), TREE)
    yield Row("textures", s.textures, 100, "texture", (1.5, 2), TREE)
    yield Row("media", s.media, 3, "medium", (1.5, 2), TREE)
    yield Row("mixtures", s.coats, 4, "material", (1.5, 2), "choices on the way down")
    yield Row("layers of materials", s.layers, 2, "layer", (1.5, 2), "choices on the way down")
    yield Row("layers of shapes", s.named_spheres, 250, "shape", (1.5, 2), TREE, kept=("--aov", "cryptomatte"), options=("--aov", "cryptomatte"))
    yield Row("groups of lights", s.points, 2, "light", options=("--light-groups",))
    yield Row("photons", s.room, 2000, "photon", options=("--integrator", "photon"), spp=(2, 4))


class Bench:
    def __init__(self, programs, folder):
        self.programs, self.folder = programs, folder

    def run(self, program, *arguments, under=()):
        command = [*under, self.programs / f"vitrail-{program}", *arguments, "--force", "--quiet", "--threads", 1,
                   "--stats", self.folder / "stats.json"]
        done = subprocess.run([str(c) for c in command], capture_output=True, text=True,
                              env=os.environ | {"XDG_CACHE_HOME": str(self.folder / "cache")})
        if done.returncode:
            raise SystemExit(f"{' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
        return done.stderr, json.loads((self.folder / "stats.json").read_text())

    def instructions(self, bundle, options, spp):
        text, _ = self.run("render", bundle, "-o", self.folder / "x.film", "--spp", spp, *options,
                           under=("valgrind", "--fair-sched=yes", "--tool=callgrind", "--callgrind-out-file=/dev/null"))
        return int(re.search(r"Collected : (\d+)", text)[1])

    def a_sample(self, bundle, row, count):
        if row.name == "photons":
            return self.a_photon(bundle, row, count)
        few, many = row.spp
        return (self.instructions(bundle, row.options, many) - self.instructions(bundle, row.options, few)) / (PIXELS * (many - few))

    def a_photon(self, bundle, row, count):
        """Of an iteration, with what a photon brings to the pixels: the radius has alike many of them at any count."""
        few, many = row.spp
        options = [*row.options, "--photons", count, "--photon-radius", 4 / count**.5, "--crop", "0,8,0,8"]
        return (self.instructions(bundle, options, many) - self.instructions(bundle, options, few)) / (count * (many - few))

    def measure(self, row, count):
        """Instructions a sample; bytes of the bundle, and resident of partition and render."""
        folder = self.folder / re.sub(r"\W", "-", f"{row.name} {count}")
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        scene, bundle = row.write(folder, count), folder / "scene.vit"
        _, partition = self.run("partition", scene, "-o", bundle, "--domains", 1, *row.kept)
        _, render = self.run("render", bundle, "-o", self.folder / "x.film", "--spp", 1, *row.options)
        size = sum(f.stat().st_size for f in bundle.rglob("*") if f.is_file())
        work = self.a_sample(bundle, row, count)
        shutil.rmtree(folder)
        return work, (size, partition["peak_rss_bytes"], render["peak_rss_bytes"])


def line(bench, row, short):
    """A line of the table, and what is beyond its limit."""
    counts = [row.count, 8 * row.count] + [64 * row.count] * (not short)
    found = [bench.measure(row, n) for n in counts]
    work = [w for w, _ in found]
    # How many paths are at hand at once depends on the clock, and few take more: what looks odd is measured again.
    for _ in range(AGAIN):
        if all(1 / FLAT[-1] < w / work[0] <= most for w, most in zip(work[1:], row.most)):
            break
        work = [min(w, bench.measure(row, n)[0]) for w, n in zip(work, counts)]
    growth = [w / work[0] for w in work[1:]]
    faults = [f"{row.name}: {g:.2f} times the work at {n} {row.item}s, at most {most}"
              for g, n, most in zip(growth, counts[1:], row.most) if g > most]
    # Of few items they are lost in the rest of the memory.
    sizes = [] if short else [(b - a) / (counts[-1] - counts[-2]) for a, b in zip(found[-2][1], found[-1][1])]
    if row.bytes:
        faults += [f"{row.name}: {s:.0f} bytes a {row.item} in {where}, at most {most}"
                   for s, most, where in zip(sizes, row.bytes, ("the bundle", "partition", "render")) if s > most]
    limits = " · ".join(str(most) for most in row.most[:len(growth)])
    kind = "media" if row.item == "medium" else f"{row.item}s"
    cells = [row.name, f"{row.count} {kind}", f"{work[0]:.0f}", *(f"{g:.2f}" for g in growth),
             f"{limits}, {row.reason}" if row.reason else limits, *(f"{s:.4g}" for s in sizes)]
    return "| " + " | ".join(cells) + " |", faults


def put_into(page, table):
    """In place of the table with the same head."""
    lines = page.read_text().splitlines()
    begin = lines.index(table[0])
    end = next((i for i in range(begin, len(lines)) if not lines[i].startswith("|")), len(lines))
    page.write_text("\n".join(lines[:begin] + table + lines[end:]) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--only", default="", metavar="WORD", help="rows whose names have it")
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--keep", type=pathlib.Path, metavar="DIR", help="where to work, in place of a temporary folder")
    parser.add_argument("--page", type=pathlib.Path, help="a page whose table becomes this one")
    options = parser.parse_args()
    if not shutil.which("valgrind"):
        print("skipped: valgrind is not installed")
        return SKIPPED
    with tempfile.TemporaryDirectory() as temporary:
        bench = Bench(options.bin.resolve(), options.keep or pathlib.Path(temporary))
        growths = ["8 N"] + ["64 N"] * (not options.short)
        head = ["data", "N", "instructions a sample", *growths, "at most"] + ["bytes of bundle", "of partition", "of render"] * (not options.short)
        table, faults = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"], []
        print(*table, sep="\n")
        for row in rows():
            if options.only in row.name and (row.short or not options.short):
                text, beyond = line(bench, row, options.short)
                print(text, flush=True)
                table.append(text)
                faults += beyond
    if options.page:
        put_into(options.page, table)
    print(*faults, sep="\n", end="\n" if faults else "", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
