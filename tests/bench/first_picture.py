#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""From a scene file to a first picture: Vitrail, Mitsuba 3 and pbrt-v4 on public scenes with images, 64 x 36 pixels, 1 sample each.

  tests/bench/first_picture.py [--bin build/release/bin] [--pbrt PBRT] [--runs 3] [--page docs/why/textures.md] [SCENE...]

Vitrail renders the scene file with an empty cache, and again with what that kept. Mitsuba imports, loads and renders in one process;
what `import mitsuba` and its variant take alone is told apart. A scene of another format is handed over by `vitrail convert`, which
does not count. Each command runs in turn; medians of processor seconds (user and system), with --wall also of the wall, which says
little where others use the machine. Needs `pip install mitsuba`.
"""
import argparse
import os
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

from growth import put_into

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORPUS = pathlib.Path(os.environ.get("VITRAIL_CORPUS", ROOT.parent / "shared/corpus"))
WIDTH, HEIGHT = 64, 36
SCENES = {"classroom": "real/classroom/scene.xml", "bathroom": "real/bathroom2/bathroom2.pbrt",
          "textures": "pbrt-v4/scenes/09_textures.pbrt", "sponza": "mitsuba-0.6/sponza/scene.xml",
          "matpreview": "mitsuba-data/docs/scenes/bsdf_plastic_preserve.xml", "mask": "mitsuba-data/docs/scenes/bsdf_mask_after.xml"}
SCENES |= {name: f"mitsuba-data/tests/scenes/bsdf_spheres/test_{name}_path.xml"
           for name in ("envmap", "bumpmap", "normalmap", "textured_diffuse")}
VARIANTS = "llvm_ad_rgb", "scalar_rgb"
MITSUBA = f"""
import sys
import mitsuba as mi
mi.set_variant(sys.argv[1])
if len(sys.argv) > 2:
    scene = mi.load_file(sys.argv[2])
    scene = scene[0] if isinstance(scene, list) else scene
    params = mi.traverse(scene.sensors()[0])
    params["film.size"] = [{WIDTH}, {HEIGHT}]
    params.update()
    mi.Bitmap(mi.render(scene, spp=1)).write(sys.argv[3])
"""


class Refused(Exception):
    pass


def timed(command, **environment):
    """Seconds of processors and of the wall."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, env=os.environ | environment)
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        said = (done.stderr.strip() or done.stdout.strip() or f"status {done.returncode}").splitlines()
        raise Refused(said[-1])
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall


def for_mitsuba(options, scene, folder):
    """The scene's own file where Mitsuba 3 takes it."""
    text = scene.read_text(errors="replace") if scene.suffix == ".xml" else ""
    if re.search(r'<scene version=["\'](0\.|$)', text) or not text:
        timed([options.bin / "vitrail-convert", scene, folder / "m" / "scene.xml", "--quiet"])
        return folder / "m" / "scene.xml"
    return scene


def for_pbrt(options, scene, folder):
    file = folder / "p" / "scene.pbrt"
    timed([options.bin / "vitrail-convert", scene, file, "--quiet"])
    text = re.sub(r'("integer xresolution" *\[? *)\d+', rf"\g<1>{WIDTH}", file.read_text())
    file.write_text(re.sub(r'("integer yresolution" *\[? *)\d+', rf"\g<1>{HEIGHT}", text))
    return file


def commands(options, scene, folder):
    """Name → what makes its picture."""
    for name in "m", "p":
        (folder / name).mkdir()
    size = ["--width", WIDTH, "--height", HEIGHT, "--spp", 1, "--force", "--quiet"]
    vitrail = lambda: timed([options.bin / "vitrail-render", scene, "-o", folder / "v.exr", *size], XDG_CACHE_HOME=str(folder / "cache"))

    def first():
        shutil.rmtree(folder / "cache", ignore_errors=True)
        return vitrail()

    found = {"Vitrail": first, "again": vitrail}
    try:
        xml = for_mitsuba(options, scene, folder)
        for variant in VARIANTS:
            found[variant] = lambda v=variant: timed([sys.executable, "-c", MITSUBA, v, xml, folder / "m.exr"])
        if options.pbrt:
            file = for_pbrt(options, scene, folder)
            found["pbrt"] = lambda: timed([options.pbrt, "--quiet", "--spp", 1, "--outfile", folder / "p.exr", file])
    except Refused as why:
        print(f"{scene}: {why}", file=sys.stderr)
    return found


def row(options, name, folder):
    """Name of a column → medians of processor and wall seconds, or why there are none."""
    taken, refused = {}, {}
    runs = commands(options, CORPUS / SCENES[name], folder)
    for _ in range(options.runs):
        for column, run in runs.items():
            try:
                if column not in refused:
                    taken.setdefault(column, []).append(run())
            except Refused as why:
                refused[column] = str(why)
                print(f"{name}, {column}: {why}", file=sys.stderr)
    return {c: tuple(statistics.median(x) for x in zip(*t)) for c, t in taken.items() if c not in refused}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="; ".join(SCENES))
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--pbrt", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--wall", action="store_true")
    parser.add_argument("--page", type=pathlib.Path, help="a page whose table becomes this one")
    options = parser.parse_args()
    what = "seconds of processors" + " · wall" * options.wall
    columns = ["Vitrail", "again", *VARIANTS, *(["pbrt"] if options.pbrt else [])]
    table = [f"| first picture: {what} | " + " | ".join(columns) + " |", "|---" * (len(columns) + 1) + "|"]
    print(*table, sep="\n")

    def add(name, found):
        cells = [" · ".join(f"{s:.2f}" for s in found[c][:1 + options.wall]) if c in found else "—" for c in columns]
        table.append("| " + " | ".join([name, *cells]) + " |")
        print(table[-1], flush=True)

    for name in options.scenes or SCENES:
        with tempfile.TemporaryDirectory() as folder:
            add(name, row(options, name, pathlib.Path(folder)))
    add("start of Python and Mitsuba alone", {v: tuple(statistics.median(x) for x in zip(*(
        timed([sys.executable, "-c", MITSUBA, v]) for _ in range(options.runs)))) for v in VARIANTS})
    if options.page:
        put_into(options.page, table)


if __name__ == "__main__":
    main()
