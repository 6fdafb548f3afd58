#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The hotel room behind electrochromic glass in several states: a strip of pictures, all exposed alike.

Sample runs:
    ./states.py -o /tmp/states                           clear, half and dark
    ./states.py -o /tmp/states --states 0 0.25 0.5 0.75 1 --spp 256 --detail 1
    ./states.py -o /tmp/states --spp 64 --denoise        without noise
    ./states.py -o /tmp/states --integrator direct       light from sun, sky and lamps alone

The scene is partitioned once; each state is set when it is rendered. A run goes on where another was stopped.
"""

import argparse
import subprocess
from pathlib import Path
from shutil import which

from generate import write_scene
from pictures import write_mosaic


def run(*words):
    subprocess.run([str(word) for word in words], check=True)


def render(vitrail, bundle, picture, state, options):
    """`picture` of the bundle with its window in that state."""
    run(vitrail, "render", bundle, "-o", picture, "--set", f"window.state={state:g}", *options)


def main():
    parser = argparse.ArgumentParser(description="renders the hotel room in several states of its glass")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--states", type=float, nargs="+", default=[0, 0.5, 1], help="0 clear to 1 dark")
    parser.add_argument("--detail", type=float, default=0.1, metavar="D", help="as of generate.py (default 0.1)")
    parser.add_argument("--width", type=int, default=320)
    parser.add_argument("--height", type=int, default=180)
    parser.add_argument("--spp", type=int, default=128, help="samples per pixel (default 128)")
    parser.add_argument("--integrator", choices=["path", "direct"], default="path")
    parser.add_argument("--denoise", action="store_true", help="by Intel Open Image Denoise (docs/how-to/denoise.md)")
    parser.add_argument("--vitrail", default=which("vitrail") or "vitrail", help="the program, if not on the PATH")
    args = parser.parse_args()

    scene, bundle = args.output / "hotel-room.pbrt", args.output / "hotel-room.vit"
    write_scene(args.output, args.detail, args.width, args.height, args.spp, switching=True)
    run(args.vitrail, "partition", scene, "-o", bundle)
    options = ["--spp", args.spp, "--integrator", args.integrator, *["--denoise"] * args.denoise]
    pictures = [args.output / f"{args.integrator}-{state:g}.png" for state in args.states]
    for state, picture in zip(args.states, pictures):
        render(args.vitrail, bundle, picture, state, options)
    strip = args.output / f"{args.integrator}.png"
    write_mosaic(strip, [pictures])
    print(strip)


if __name__ == "__main__":
    main()
