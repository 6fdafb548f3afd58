#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints frames for `vitrail render --frames`: the sun of a sky at a place, from sunrise to sunset."""

import argparse
import json
import math
import subprocess


def sun_at(place, date, hour, zone):
    """Towards the sun, +x east, +y north, +z up; by `vitrail sky`."""
    whole = int(hour)
    time = f"{date}T{whole:02}:{round(60 * (hour - whole)) % 60:02}{zone}"
    said = subprocess.run(["vitrail", "sky", f"{place},{time}", "--json"], check=True, capture_output=True, text=True)
    sky = json.loads(said.stdout)
    azimuth, elevation = math.radians(sky["azimuth_deg"]), math.radians(sky["elevation_deg"])
    across = math.cos(elevation)
    return across * math.sin(azimuth), across * math.cos(azimuth), math.sin(elevation)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--place", default="48.86,2.35", help="latitude,longitude in degrees")
    parser.add_argument("--date", default="2026-06-21")
    parser.add_argument("--zone", default="+02:00", help="of the time, from UTC")
    parser.add_argument("--every", type=float, default=1, help="hours between frames")
    parser.add_argument("--light", default="sky-1", help="name of the sky in `vitrail inspect`")
    parser.add_argument("--up", choices=["y", "z"], default="z", help="the scene's axis that points up")
    args = parser.parse_args()
    for i in range(int(24 / args.every)):
        hour = i * args.every
        east, north, up = sun_at(args.place, args.date, hour, args.zone)
        if up <= 0:
            continue
        x, y, z = (east, north, up) if args.up == "z" else (east, up, -north)
        print(f"--set {args.light}.sun={x:.9g}:{y:.9g}:{z:.9g}  # {hour:g} h")


if __name__ == "__main__":
    main()
