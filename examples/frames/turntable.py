#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints frames for `vitrail render --frames`: a camera on a circle around a point."""

import argparse
import math


def point(text):
    x, y, z = (float(number) for number in text.split(","))
    return x, y, z


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--around", type=point, default="0,0,0", help="x,y,z that is looked at")
    parser.add_argument("--radius", type=float, required=True, help="of the circle, in scene units")
    parser.add_argument("--height", type=float, default=0, help="of the camera above the point")
    parser.add_argument("--up", choices=["y", "z"], default="z", help="the scene's axis that points up")
    parser.add_argument("--frames", type=int, default=36)
    args = parser.parse_args()
    x, y, z = args.around
    for i in range(args.frames):
        angle = 2 * math.pi * i / args.frames
        a, b = args.radius * math.cos(angle), args.radius * math.sin(angle)
        eye = (x + a, y + b, z + args.height) if args.up == "z" else (x + a, y + args.height, z + b)
        up = (0, 0, 1) if args.up == "z" else (0, 1, 0)
        numbers = ",".join(f"{number:.9g}" for number in (*eye, x, y, z, *up))
        print(f"--look-at={numbers}")


if __name__ == "__main__":
    main()
