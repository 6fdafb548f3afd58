#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A year of daylight beside Radiance: seconds of processor and noise, of one run, on one thread each.

  tests/bench/daylight.py --bin build/release/bin --weather golden.epw --room CORPUS/daylight [--radiance FOLDER]

The room and the oracle are those of tests/conformance/year_oracle.py. "Noise" is the root mean square deviation, of single sensors in
single hours, from each one's own result with 8 times the paths; how far the two are apart is for year_oracle.py to tell. "Worth" is
Radiance's seconds × noise² over ours: how many times as long Radiance takes for the same noise.
"""
import argparse
import pathlib
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "conformance"))
import year_oracle as oracle


def noise(values, reference):
    lit = reference > 1e-3 * reference.mean()
    return float(np.sqrt(np.mean((values[lit] / reference[lit] - 1) ** 2)))


def row(what, ours_s, ours, theirs_s, theirs):
    worth = f"{theirs_s * theirs ** 2 / (ours_s * ours ** 2):8.2f}" if ours else f"{theirs_s / ours_s:8.2f}"
    print(f"{what:44}{ours_s:8.1f} s {100 * ours:6.2f} % {theirs_s:8.1f} s {100 * theirs:6.2f} % {worth}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    oracle.add_arguments(parser)
    parser.add_argument("--divisions", type=int, default=32768)
    parser.add_argument("--paths", type=int, default=32768)
    parser.add_argument("--hours", type=int, default=8)
    parser.add_argument("--sun-paths", type=int, default=4096)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        radiance, room = oracle.radiance_of(args, work), oracle.Room(args.bin, args.room, work)
        print(f"{'':44}{'ours':>10} {'noise':>8} {'Radiance':>10} {'noise':>8} {'worth':>8}")
        seconds, skies = [], []
        for paths, folder in ((args.paths, "y"), (args.paths, "y"), (8 * args.paths, "r")):  # of the second nothing is traced
            seconds.append(room.year(args.weather, room.sensors, work / folder, "--paths", str(paths), "-t", "1"))
            rows, ours = oracle.hours_of(work / folder)
            skies.append(ours - oracle.sun_part(rows, work / folder))
        all_s, product_s, _ = seconds
        _, reference, _, _ = radiance.year(args.weather, 8 * args.divisions)
        _, their_sky, traced_s, multiplied_s = radiance.year(args.weather, args.divisions)
        high = oracle.bright_hours(rows, reference)
        row("a year, sky and sun; noise of the sky", all_s, noise(skies[0][high], skies[2][high]), traced_s + multiplied_s,
            noise(their_sky[high], reference[high]))
        row("the product with the weather", product_s, 0, multiplied_s, 0)
        chosen, points = oracle.sunny_hours(room, args.weather, args.hours)
        sky = ["--patches", "1", "--paths", "2", "--sun-blur", "0", "-t", "1", "--sun-paths"]
        found = {}
        for paths in (args.sun_paths, 8 * args.sun_paths):
            seconds = room.year(work / "some.epw", work / "three.txt", work / f"h{paths}", *sky, str(paths))
            theirs = [radiance.sun(float(r[3]), float(r[4]), points, paths) for r in chosen]
            found[paths] = (seconds, np.load(work / f"h{paths}" / "as-it-is.sun.npy").T, sum(s for _, s in theirs),
                            np.array([values for values, _ in theirs]))
        ours_s, mine, theirs_s, other = found[args.sun_paths]
        _, our_reference, _, reference = found[8 * args.sun_paths]
        row(f"the sun of {len(chosen)} hours at 3 sensors", ours_s, noise(mine, our_reference), theirs_s, noise(other, reference))


if __name__ == "__main__":
    main()
