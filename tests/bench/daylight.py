#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A year of daylight beside Radiance: seconds of processor and noise, of one run, on one thread each.

  tests/bench/daylight.py --bin build/release/bin --weather golden.epw --room CORPUS/daylight [--radiance FOLDER]

The room and the oracle are those of tests/conformance/year_oracle.py. "Noise" is the root mean square deviation, of single sensors in
single hours, from a reference: of the sky Radiance's own with -ad REFERENCE; of the sun the mean of both with 16 times the paths. "Worth"
is Radiance's seconds × noise² over ours: how many times as long Radiance takes for the same noise.
"""
import argparse
import pathlib
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "conformance"))
import year_oracle as oracle


def noise(values, reference):
    return float(np.sqrt(np.mean((values / reference - 1) ** 2)))


def row(what, ours_s, ours, theirs_s, theirs):
    worth = f"{theirs_s * theirs ** 2 / (ours_s * ours ** 2):8.2f}" if ours else f"{theirs_s / ours_s:8.2f}"
    print(f"{what:44}{ours_s:8.1f} s {100 * ours:6.2f} % {theirs_s:8.1f} s {100 * theirs:6.2f} % {worth}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    oracle.add_arguments(parser)
    parser.add_argument("--divisions", type=int, default=32768)
    parser.add_argument("--reference", type=int, default=262144)
    parser.add_argument("--paths", default="32768")
    parser.add_argument("--hours", type=int, default=8)
    parser.add_argument("--sun-paths", type=int, default=4096)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        radiance, room = oracle.radiance_of(args, work), oracle.Room(args.bin, args.room, work)
        print(f"{'':44}{'ours':>10} {'noise':>8} {'Radiance':>10} {'noise':>8} {'worth':>8}")
        options = ["--paths", args.paths, "-t", "1"]
        all_s = room.year(args.weather, room.sensors, work / "y", *options)
        product_s = room.year(args.weather, room.sensors, work / "y", *options)  # nothing is traced again
        rows, ours = oracle.hours_of(work / "y")
        our_sky = ours - oracle.sun_part(rows, work / "y")
        _, reference, _, _ = radiance.year(args.weather, args.reference)
        _, their_sky, traced_s, multiplied_s = radiance.year(args.weather, args.divisions)
        high = oracle.bright_hours(rows, reference)
        row("a year, sky and sun; noise of the sky", all_s, noise(our_sky[high], reference[high]), traced_s + multiplied_s,
            noise(their_sky[high], reference[high]))
        row("the product with the weather", product_s, 0, multiplied_s, 0)
        chosen, points = oracle.sunny_hours(room, args.weather, args.hours)
        sky = ["--patches", "1", "--paths", "2", "--sun-blur", "0", "-t", "1", "--sun-paths"]
        found = {}
        for paths in (args.sun_paths, 16 * args.sun_paths):
            seconds = room.year(work / "some.epw", work / "three.txt", work / f"h{paths}", *sky, str(paths))
            theirs = [radiance.sun(float(r[3]), float(r[4]), points, paths) for r in chosen]
            found[paths] = (seconds, np.load(work / f"h{paths}" / "as-it-is.sun.npy").T, sum(s for _, s in theirs),
                            np.array([values for values, _ in theirs]))
        ours_s, mine, theirs_s, other = found[args.sun_paths]
        reference = (found[16 * args.sun_paths][1] + found[16 * args.sun_paths][3]) / 2
        row(f"the sun of {len(chosen)} hours at 3 sensors", ours_s, noise(mine, reference), theirs_s, noise(other, reference))


if __name__ == "__main__":
    main()
