#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`vitrail year` beside Radiance: rfluxmtx, gendaymtx -m 4 and dctimestep for a year, rtrace for some hours of sun.

  tests/conformance/year_oracle.py --bin build/release/bin --weather golden.epw --room CORPUS/daylight [--radiance FOLDER]

The room is room.pbrt and room.rad with sensors.txt and sky.rad, without glass. The year has -ad DIVISIONS of rfluxmtx and --paths of
ours. Printed are: the sky alone (gendaymtx -s) in hours above 50 lx, sensor by sensor; DA, sDA and ASE of all light; seconds of
processor. Then --hours of sun are traced by rtrace with a disc where the sun stands for us, and compared with the coefficients of a
second year without blur. ASE is compared on a grid of its own, --grid, with shadow rays of rcontrib alone: with the suns and the light of
gendaymtx -D, which stand up to .7° apart from ours, and with our suns, whose discs are seen in part for some hours. With -ad 8192 rtrace has up to a quarter too little at the back where the sun is beside the window. FOLDER holds Radiance's bin/ and lib/: that of PyPI's pyradiance where none is given.
"""
import argparse
import csv
import importlib.util
import math
import os
import pathlib
import random
import re
import resource
import subprocess
import tempfile

import numpy as np

LX = np.array([47.4, 119.9, 11.6])  # of Radiance's RGB
DISC = 2 * math.pi * (1 - math.cos(math.radians(.533 / 2)))  # the sun's solid angle


def run(words, **more):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(words, check=True, capture_output=True, **more)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def table(file):
    with open(file) as text:
        return list(csv.reader(text))[1:]


def hours_of(folder):
    rows = table(folder / "hours.csv")
    return rows, np.array([[float(x) for x in row[9:]] for row in rows])


def sun_part(rows, folder):
    direct = np.array([float(row[5]) for row in rows])
    sunny = np.where(direct > 0)[0]
    part = np.zeros((len(rows), np.load(folder / "as-it-is.sun.npy").shape[0]))
    part[sunny] = (np.load(folder / "as-it-is.sun.npy") * direct[sunny]).T
    return part


class Radiance:
    def __init__(self, folder, room, work):
        self.bin, self.room, self.work = folder / "bin", room, work
        self.env = {**os.environ, "RAYPATH": f"{work}:{folder / 'lib'}", "PATH": f"{folder / 'bin'}:{os.environ['PATH']}"}

    def run(self, words, **more):
        return run([str(w) for w in words], env=self.env, **more)

    def year(self, weather, divisions):
        self.run(["epw2wea", weather, self.work / "w.wea"])
        skies = {}
        for name, more in (("all", []), ("sky", ["-s"])):
            (self.work / f"{name}.smx").write_bytes(self.run(["gendaymtx", "-m", 4, "-O0", *more, self.work / "w.wea"])[0])
        sensors = (self.room / "sensors.txt").read_bytes()
        matrix, traced_s = self.run(["rfluxmtx", "-n", 1, "-I+", "-ab", 8, "-ad", divisions, "-lw", "1e-5", "-faa", "-y",
                                     len(sensors.splitlines()), "-", "sky.rad", "room.rad"], input=sensors, cwd=self.room)
        (self.work / "d.mtx").write_bytes(matrix)
        for name in ("all", "sky"):
            text, multiplied_s = self.run(["dctimestep", "-h", self.work / "d.mtx", self.work / f"{name}.smx"])
            values = np.array(text.split(), float).reshape(len(sensors.splitlines()), -1, 3) @ LX
            skies[name] = values.T
        return skies["all"], skies["sky"], traced_s, multiplied_s

    def sun(self, elevation, azimuth, points, divisions):
        e, a = math.radians(elevation), math.radians(azimuth)
        x, y, z = math.cos(e) * math.sin(a), math.cos(e) * math.cos(a), math.sin(e)
        bright = 1 / DISC
        (self.work / "s.rad").write_text(f"void light sun 0 0 3 {bright} {bright} {bright}\nsun source s 0 0 4 {x} {y} {z} 0.533\n")
        (self.work / "s.oct").write_bytes(self.run(["oconv", self.room / "room.rad", self.work / "s.rad"])[0])
        text, seconds = self.run(["rtrace", "-n", 1, "-h", "-I+", "-ab", 8, "-ad", divisions, "-lw", "1e-6", "-aa", 0, "-dj", 0, "-ds", 0,
                            "-dt", 0, "-dc", 1, self.work / "s.oct"], input=points)
        return np.array(text.split(), float).reshape(-1, 3)[:, 1], seconds

    def suns(self, weather):
        """Of each hour with sun: its number in the year, where gendaymtx has the sun, and lx across its direction."""
        self.run(["epw2wea", weather, self.work / "w.wea"])
        self.run(["gendaymtx", "-n", "-O0", "-D", self.work / "suns.rad", self.work / "w.wea"])
        text = (self.work / "suns.rad").read_text()
        minutes = re.findall(r"light solar(\d+)", text)
        bright = re.findall(r"^3 (\S+)", text, re.MULTILINE)
        directions = np.array([line.split()[:3] for line in re.findall(r"^4 (.*)", text, re.MULTILINE)], float)
        return np.array(minutes, int) // 60, directions, np.array(bright, float) * LX.sum() * DISC

    def beams(self, directions, points, rays):
        """What a sun of 1 lx gives straight to the points: [sun][point]. One ray goes to the middle of its disc."""
        scene = "".join(f"void light m{i} 0 0 3 {1 / DISC} {1 / DISC} {1 / DISC}\nm{i} source s{i} 0 0 4 {x} {y} {z} 0.533\n"
                        for i, (x, y, z) in enumerate(directions))
        (self.work / "s.rad").write_text(scene)
        (self.work / "s.mod").write_text("".join(f"m{i}\n" for i in range(len(directions))))
        (self.work / "s.oct").write_bytes(self.run(["oconv", self.room / "room.rad", self.work / "s.rad"])[0])
        found, lines = [], points.splitlines(keepends=True)
        for first in range(0, len(lines), 50):
            some = lines[first:first + 50]
            rows, _ = self.run(["rcontrib", "-n", 1, "-h", "-I+", "-V+", "-ab", 0, "-dj", int(rays > 1), "-ds", 0, "-dt", 0, "-dc", 1,
                                "-faf", "-y", rays * len(some), "-M", "s.mod", self.work / "s.oct"], input=b"".join(some) * rays)
            found.append(np.frombuffer(rows, "<f4").reshape(rays, len(some), len(directions), 3)[..., 1].mean(0))
        return np.concatenate(found).T


def compare_sun_hours(room, radiance, weather, grid):
    """ASE 1000,250h: sensors with more than 250 hours of use above 1000 lx of the sun alone."""
    columns, rows = map(int, grid.split("x"))
    points = "".join(f"{4 * (i + .5) / columns} {6 * (j + .5) / rows} 0.8 0 0 1\n" for j in range(rows) for i in range(columns))
    (radiance.work / "grid.txt").write_text(points)
    room.year(weather, radiance.work / "grid.txt", radiance.work / "a", "--patches", "1", "--paths", "2", "--sun-paths", "2")
    hours = table(radiance.work / "a" / "hours.csv")
    use = np.array([8 <= int(row[2]) < 18 for row in hours])
    direct = np.array([float(row[5]) for row in hours])
    sunny = np.where(direct > 0)[0]
    elevation, azimuth = (np.radians([float(row[i]) for row in hours])[sunny] for i in (3, 4))
    ours_to_sun = np.stack([np.cos(elevation) * np.sin(azimuth), np.cos(elevation) * np.cos(azimuth), np.sin(elevation)], 1)
    their_hours, to_sun, their_direct = radiance.suns(weather)

    def bright(which, beams, lx):
        found = np.zeros((len(hours), columns * rows), bool)
        found[which] = beams * lx[:, None] > 1000
        return found[use]

    ours = bright(sunny, np.load(radiance.work / "a" / "as-it-is.beam.npy").T, direct[sunny])
    points = points.encode()
    for name, other in (("gendaymtx's suns", bright(their_hours, radiance.beams(to_sun, points, 1), their_direct)),
                        ("our suns, their middles", bright(sunny, radiance.beams(ours_to_sun, points, 1), direct[sunny])),
                        ("our suns, 16 rays to the disc", bright(sunny, radiance.beams(ours_to_sun, points, 16), direct[sunny]))):
        mine, its = ours.sum(0), other.sum(0)
        print(f"ASE, {mine.size} sensors, {name}: {100 * np.mean(mine > 250):.2f} % beside {100 * np.mean(its > 250):.2f} %; "
              f"hours most apart {abs(mine - its).max()}, on the average {np.mean(mine - its):+.2f} of {its.mean():.0f}; "
              f"{100 * np.mean(ours == other):.3f} % of the sensors' hours agree", flush=True)


class Room:
    """The corpus' room without glass in `work`, and years of ours in it."""
    def __init__(self, binaries, room, work):
        self.bin, self.work, self.sensors = binaries, work, room / "sensors.txt"
        run([binaries / "vitrail-partition", room / "room.pbrt", "-o", work / "room.vit", "--quiet"])

    def year(self, weather, sensors, output, *more):
        """Returns the seconds of processor."""
        return run([self.bin / "vitrail-year", self.work / "room.vit", "--weather", weather, "--quiet", "--up", "z", "--north", "y",
                    "--sensors", sensors, "-o", output, *more])[1]


def radiance_of(args, work):
    found = args.radiance or importlib.util.find_spec("pyradiance")
    if not found:
        raise SystemExit("there is no Radiance: give --radiance, or install pyradiance")
    return Radiance(args.radiance or pathlib.Path(found.origin).parent, args.room, work)


def add_arguments(parser):
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--weather", type=pathlib.Path, required=True)
    parser.add_argument("--room", type=pathlib.Path, required=True)
    parser.add_argument("--radiance", type=pathlib.Path)


def bright_hours(rows, their_sky):
    """Those with the sun above 10° and 50 lx of the sky at the mean sensor."""
    return (np.array([float(row[3]) for row in rows]) > 10) & (their_sky.sum(1) > 50 * their_sky.shape[1])


def sunny_hours(room, weather, count):
    """A weather file of so many hours of sun, those hours of the year, and three sensors: near, in the middle, at the back."""
    rows = table(room.work / "y" / "hours.csv")
    random.seed(5)
    chosen = sorted(random.sample([h for h, row in enumerate(rows) if float(row[5]) > 20000], count))
    lines = room.sensors.read_bytes().splitlines(keepends=True)
    points = b"".join([lines[1], lines[9], lines[17]])
    (room.work / "three.txt").write_bytes(points)
    hours = weather.read_text(encoding="latin-1").splitlines(keepends=True)
    (room.work / "some.epw").write_text("".join(hours[:8] + [hours[8 + h] for h in chosen]), encoding="latin-1")
    return [rows[h] for h in chosen], points


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    add_arguments(parser)
    parser.add_argument("--divisions", type=int, default=32768)
    parser.add_argument("--paths", default="128k")
    parser.add_argument("--sun-paths", default="16")
    parser.add_argument("--grid", default="20x30", help="sensors of ASE; 0: without it")
    parser.add_argument("--hours", type=int, default=50)
    parser.add_argument("--hour-paths", default="64k")
    parser.add_argument("--hour-divisions", type=int, default=65536)
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        radiance, room = radiance_of(args, work), Room(args.bin, args.room, work)
        ours_s = room.year(args.weather, room.sensors, work / "y", "--paths", args.paths, "--sun-paths", args.sun_paths, "-t", "1")
        rows, ours = hours_of(work / "y")
        theirs, their_sky, traced_s, multiplied_s = radiance.year(args.weather, args.divisions)
        our_sky = ours - sun_part(rows, work / "y")
        lit = their_sky > 50
        ratio = our_sky[lit] / their_sky[lit]
        print(f"sky, {lit.sum()} values above 50 lx: median {np.median(ratio):.4f}, 5 to 95 % {np.percentile(ratio, 5):.4f} "
              f"to {np.percentile(ratio, 95):.4f}, within 2 %: {100 * np.mean(abs(ratio - 1) < .02):.1f} %")
        high = bright_hours(rows, their_sky)
        ratio = our_sky[high].sum(1) / their_sky[high].sum(1)
        print(f"sky, mean of the sensors, sun above 10°: within 2 % in {100 * np.mean(abs(ratio - 1) < .02):.1f} % of {high.sum()} hours")
        use = np.array([8 <= int(row[2]) < 18 for row in rows])
        for target in (300, 500):
            mine, other = ((v[use] >= target).mean(0) for v in (ours, theirs))
            print(f"DA {target}: {mine.mean():.4f} beside {other.mean():.4f}; most apart {abs(mine - other).max():.4f}; "
                  f"sDA {np.mean(mine >= .5):.3f} beside {np.mean(other >= .5):.3f}")
        print(f"seconds of processor: {ours_s:.1f} beside {traced_s:.1f} of rfluxmtx and {multiplied_s:.1f} of dctimestep")
        if args.grid != "0":
            compare_sun_hours(room, radiance, args.weather, args.grid)
        if args.hours == 0:
            return
        chosen, points = sunny_hours(room, args.weather, args.hours)
        room.year(work / "some.epw", work / "three.txt", work / "h", "--patches", "1", "--paths", "2", "--sun-paths", args.hour_paths,
                  "--sun-blur", "0")
        off = []
        for row, mine in zip(chosen, np.load(work / "h" / "as-it-is.sun.npy").T):
            other, _ = radiance.sun(float(row[3]), float(row[4]), points, args.hour_divisions)
            lit = np.maximum(mine, other) > 1e-6  # else the sun is behind the walls for both
            off += list(mine[lit] / np.maximum(other[lit], 1e-9))
            print("/".join(row[:3]), *(f"{m:.5f} {o:.5f}" for m, o in zip(mine, other)), flush=True)
        off = np.array(off)
        print(f"sun by rtrace, {off.size} values: median {np.median(off):.4f}, within 2 %: {100 * np.mean(abs(off - 1) < .02):.1f} %")


if __name__ == "__main__":
    main()
