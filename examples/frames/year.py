#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A year of daylight at sensors: a model, a weather file (EPW), and what of it the year brings.

Sample runs:
    ./year.py room.pbrt paris.epw --sensors desk.txt -o year --up z --north x
    ./year.py room.pbrt paris.epw --sensors desk.txt -o dark --up z --north x --set window.state=1 --every 14

Sun and sky are measured apart, under the clear sky of every Nth day of the year: how many lux a sensor has for each
lux outdoors. These shares, between two such days in proportion, are multiplied by the lux of each hour of the file:
sun across its direction, sky on the ground. So clouds change how much light comes, but not from where in the sky: hours
without sun come out too bright: 1.6 times in a room with a window to the south, twice at its back.

Writes DIR/year.csv (an hour a row, a sensor a column, lux) and DIR/figures.csv (a sensor a row), and prints these:
    DA    hours of use in which a sensor has 300 lx or more (Reinhart and Walkenhorst 2001)
    UDI   the same of less than 100, 100 to 300, 300 to 3000, and more than 3000 lx (Nabil and Mardaljevic 2005)
    sDA   sensors that have 300 lx in half of the hours of use (IES LM-83, without blinds)
"""

import argparse
import csv
import datetime
import json
import math
import subprocess
import sys
from pathlib import Path
from shutil import which

HOURS_OF_USE = range(8, 18)  # 8:00 to 18:00, as in IES LM-83
ENOUGH_LX = 300
BINS_LX = {"UDI_below_100": (0, 100), "UDI_100_300": (100, 300), "UDI_300_3000": (300, 3000), "UDI_above_3000": (3000, math.inf)}
MISSING_LX, MISSING_W = 999900, 9999  # of an EPW, and above
# Where the file has no lux: of W/m2, about what clear and cloudy skies have.
LM_PER_W = {"sun": 100, "sky": 120}


def read_epw(path):
    """Latitude, longitude and zone; lux of (sun across its direction, sky on the ground) by (day of year, hour)."""
    rows = list(csv.reader(path.open(encoding="latin-1")))
    latitude, longitude, zone = (float(rows[0][i]) for i in (6, 7, 8))
    hours = {}
    for row in rows[8:]:
        if len(row) < 19:
            continue
        watts, lux = (float(row[14]), float(row[15])), (float(row[17]), float(row[18]))
        if max(watts) >= MISSING_W:
            watts = (0, 0)
        if max(lux) >= MISSING_LX or (max(lux) == 0 and max(watts) > 0):
            lux = (watts[0] * LM_PER_W["sun"], watts[1] * LM_PER_W["sky"])
        day = datetime.date(2001, int(row[1]), min(int(row[2]), 28) if int(row[1]) == 2 else int(row[2]))
        hours[day.timetuple().tm_yday, int(row[3]) - 1] = lux
    if not hours:
        raise SystemExit(f"{path}: this is no weather file (EPW)")
    return latitude, longitude, zone, hours


def axis(name):
    sign = -1 if name.startswith("-") else 1
    return tuple(sign * (letter == name[-1]) for letter in "xyz")


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


class Model:
    """Bundles of the model under the sun alone and under the sky alone."""

    def __init__(self, args, place, zone):
        self.args, self.place = args, place
        minutes = round(60 * zone)
        self.zone = f"{'-' if minutes < 0 else '+'}{abs(minutes) // 60:02}:{abs(minutes) % 60:02}"
        self.up, self.north = axis(args.up), axis(args.north)
        self.east = cross(self.north, self.up)

    def run(self, *words):
        return subprocess.run([self.args.vitrail, *map(str, words)], check=True, stdout=subprocess.PIPE, text=True).stdout

    def sky(self, day, hour):
        """What `vitrail sky` says of the middle of an hour."""
        date = datetime.date(2001, 1, 1) + datetime.timedelta(days=day - 1)
        return json.loads(self.run("sky", "--json", f"{self.place},{date}T{hour:02}:30{self.zone}"))

    def line(self, sky, light):
        """The frame of that sun."""
        azimuth, elevation = math.radians(sky["azimuth_deg"]), math.radians(sky["elevation_deg"])
        across = math.cos(elevation)
        of = (across * math.sin(azimuth), across * math.cos(azimuth), math.sin(elevation))
        x, y, z = (sum(o * a[i] for o, a in zip(of, (self.east, self.north, self.up))) for i in range(3))
        return f"--set {light}.sun={x:.9g}:{y:.9g}:{z:.9g}\n"

    def measured(self, part, other, skies):
        """Lux of each sensor, a list for each of the skies, under the `part` of them."""
        folder, bundle = self.args.output, self.args.output / f"{part}.vit"
        words = f"{self.place},2001-06-21T12:30{self.zone},up={self.args.up},north={self.args.north},{other}=0"
        self.run("partition", self.args.model, "-o", bundle, f"--sky={words}", "--force", "--quiet")
        lights = json.loads(self.run("inspect", bundle, "--json"))["lights"]
        light = next(light["name"] for light in lights if light["kind"] == "sky")
        frames = folder / f"{part}.txt"
        frames.write_text("".join(self.line(sky, light) for sky in skies))
        settings = [word for text in self.args.set for word in ("--set", text)]
        self.run("render", bundle, "--frames", frames, "--sensors", self.args.sensors, "-o", folder / f"{part}%05d.csv",
                 "--spp", self.args.spp, "--max-depth", -1, "--quiet", *settings, *(["--force"] if self.args.force else []))  # fmt: skip
        tables = [folder / f"{part}{i + 1:05}.csv" for i in range(len(skies))]
        return [[float(row["illuminance_lx"]) for row in csv.DictReader(table.open())] for table in tables]

    def shares(self, days):
        """By (day, hour) of the sun: for each sensor, its lux a lux of the sun, and of the sky."""
        moments = {(day, hour): self.sky(day, hour) for day in days for hour in range(24)}
        moments = {at: sky for at, sky in moments.items() if sky["diffuse_horizontal"]["illuminance_lx"] > 0}
        outdoors = [("sun", "sky", "direct_normal"), ("sky", "sun", "diffuse_horizontal")]
        of = {}
        for part, other, key in outdoors:
            for (at, sky), lux in zip(moments.items(), self.measured(part, other, moments.values())):
                whole = sky[key]["illuminance_lx"]
                of.setdefault(at, []).append([value / whole if whole > 0 else 0 for value in lux])
        return of


def between(days, day):
    """The two days of `days` around a day, and how far it is from the first to the second."""
    first = max((d for d in days if d <= day), default=days[-1])
    second = min((d for d in days if d > day), default=days[0])
    span = (second - first) % 365 or 365
    return first, second, ((day - first) % 365) / span


def illuminances(shares, days, sensors, at, lux):
    first, second, way = between(days, at[0])
    ends = [(shares.get((day, at[1])), weight) for day, weight in ((first, 1 - way), (second, way))]
    ends = [(share, weight) for share, weight in ends if share]
    total = sum(weight for _, weight in ends)
    if total == 0:
        return [0] * sensors
    return [
        sum(weight / total * sum(outdoors * part[i] for outdoors, part in zip(lux, share)) for share, weight in ends)
        for i in range(sensors)
    ]


def figures(year, sensor):
    used = [lux[sensor] for (_, hour), lux in year.items() if hour in HOURS_OF_USE]
    share = lambda low, high: sum(low <= value < high for value in used) / len(used)
    row = {"sensor": sensor + 1, "mean_lx": round(sum(used) / len(used), 1), "DA_300": round(share(ENOUGH_LX, math.inf), 4)}
    return row | {name: round(share(*bounds), 4) for name, bounds in BINS_LX.items()}


def write_table(path, rows):
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", type=Path, help="a scene; its own sky is replaced, its lamps should be off")
    parser.add_argument("weather", type=Path, help="an hourly weather file (.epw)")
    parser.add_argument("--sensors", type=Path, required=True, help="places, as of `vitrail render --sensors`")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--up", default="y", help="axis of the model that points up, as -z (default y)")
    parser.add_argument("--north", default="-z", help="axis of the model that points north (default -z)")
    parser.add_argument("--set", action="append", default=[], metavar="NAME.PROPERTY=VALUE", help="as of render")
    parser.add_argument("--every", type=int, default=30, metavar="DAYS", help="between days that are measured (default 30)")
    parser.add_argument("--spp", type=int, default=64, help="as of render (default 64)")
    parser.add_argument("--force", action="store_true", help="measure again what is there")
    parser.add_argument("--vitrail", default=which("vitrail") or "vitrail", help="the program, if not on the PATH")
    args = parser.parse_args()

    latitude, longitude, zone, hours = read_epw(args.weather)
    args.output.mkdir(parents=True, exist_ok=True)
    days = list(range(1, 366, args.every))
    shares = Model(args, f"{latitude:g},{longitude:g}", zone).shares(days)
    sensors = len(next(iter(shares.values()))[0])
    year = {at: illuminances(shares, days, sensors, at, lux) for at, lux in hours.items()}
    write_table(args.output / "year.csv", [
        {"day": day, "hour": hour} | {f"sensor_{i + 1}_lx": round(value, 1) for i, value in enumerate(lux)}
        for (day, hour), lux in year.items()
    ])  # fmt: skip
    rows = [figures(year, sensor) for sensor in range(sensors)]
    write_table(args.output / "figures.csv", rows)
    print((args.output / "figures.csv").read_text(), end="")
    lit = sum(row["DA_300"] >= 0.5 for row in rows)
    print(f"sDA300,50%: {100 * lit / sensors:.0f} % of {sensors} sensors")
    used = [lux for (_, hour), lux in hours.items() if hour in HOURS_OF_USE]
    without_sun = sum(sun < 0.05 * sky for sun, sky in used) / len(used)
    if without_sun > 0:
        print(f"year.py: {100 * without_sun:.0f} % of the hours of use have no sun; under the clear sky's shape they are too "
              "bright, 1.6 times by the median of a room with a window to the south, twice at its back", file=sys.stderr)  # fmt: skip


if __name__ == "__main__":
    main()
