#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A year of daylight at sensors: a model, a weather file (EPW), and what of it the year brings.

Sample runs:
    ./year.py room.pbrt paris.epw --sensors desk.txt -o year --up z --north x
    ./year.py room.pbrt paris.epw --sensors desk.txt -o dark --up z --north x --set window.state=1 --every 14

Sun and sky are measured apart, on every Nth day of the year: how many lux a sensor has for each lux outdoors. The sky is
measured three times, as Perez's overcast, cloudy and clear one. These shares are multiplied by the lux of each hour of the file, sun
across its direction and sky on the ground: between two such days and two such skies in proportion. What is between is off by
some per cent: docs/tutorial/daylight.md.

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
from pathlib import Path
from shutil import which

HOURS_OF_USE = range(8, 18)  # 8:00 to 18:00, as in IES LM-83
ENOUGH_LX = 300
BINS_LX = {"UDI_below_100": (0, 100), "UDI_100_300": (100, 300), "UDI_300_3000": (300, 3000), "UDI_above_3000": (3000, math.inf)}
MISSING_LX, MISSING_W = 999900, 9999  # of an EPW, and above
# Where the file has no lux: of W/m2, about what clear and cloudy skies have.
LM_PER_W = {"sun": 100, "sky": 120}
# Skies by the sun's part of the light, direct ÷ (direct + diffuse) in W/m2, and what then reaches the ground of it, of what is above the air.
SKIES = [(0, 0.25), (0.4, 0.28), (0.85, 0.12)]
SOLAR_W = 1367


def read_epw(path):
    """Latitude, longitude and zone; by (day of year, hour) lux of (sun across its direction, sky on the ground), and the sun's part."""
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
        hours[day.timetuple().tm_yday, int(row[3]) - 1] = lux, watts[0] / max(sum(watts), 1)
    if not hours:
        raise SystemExit(f"{path}: this is no weather file (EPW)")
    return latitude, longitude, zone, hours


class Model:
    """A bundle of the model under one sky after another."""

    def __init__(self, args, place, zone):
        self.args, self.place = args, place
        minutes = round(60 * zone)
        self.zone = f"{'-' if minutes < 0 else '+'}{abs(minutes) // 60:02}:{abs(minutes) % 60:02}"

    def run(self, *words):
        return subprocess.run([self.args.vitrail, *map(str, words)], check=True, stdout=subprocess.PIPE, text=True).stdout

    def moment(self, day, hour):
        """The middle of an hour."""
        date = datetime.date(2001, 1, 1) + datetime.timedelta(days=day - 1)
        return f"{self.place},{date}T{hour:02}:30{self.zone}"

    def skies(self, moment):
        """Of a moment the words of the sun alone, and of the skies alone; nothing at night."""
        said = json.loads(self.run("sky", "--json", moment))
        height = math.sin(math.radians(said["elevation_deg"]))
        if height <= 0:
            return []
        words = [f"{moment},sky=0"]
        for part, reaches in SKIES:
            diffuse = reaches * SOLAR_W * height
            words.append(f"{moment},sun=0,direct={diffuse * part / (1 - part):.3f}W,diffuse={diffuse:.3f}W")
        return words

    def outdoors(self, words):
        said = json.loads(self.run("sky", "--json", words))
        return said["direct_normal"]["illuminance_lx"] or said["diffuse_horizontal"]["illuminance_lx"]

    def measured(self, skies):
        """Lux of each sensor, a list for each of the skies."""
        folder, bundle = self.args.output, self.args.output / "model.vit"
        place = f"{self.place},2001-06-21T12:30{self.zone},up={self.args.up},north={self.args.north}"
        self.run("partition", self.args.model, "-o", bundle, f"--sky={place}", "--force", "--quiet")
        lights = json.loads(self.run("inspect", bundle, "--json"))["lights"]
        light = next(light["name"] for light in lights if light["kind"] == "sky")
        frames = folder / "skies.txt"
        frames.write_text("".join(f"--set {light}.sky={sky}\n" for sky in skies))
        settings = [word for text in self.args.set for word in ("--set", text)]
        self.run("render", bundle, "--frames", frames, "--sensors", self.args.sensors, "-o", folder / "sky%05d.csv",
                 "--spp", self.args.spp, "--max-depth", -1, "--quiet", *settings, *(["--force"] if self.args.force else []))  # fmt: skip
        tables = [folder / f"sky{i + 1:05}.csv" for i in range(len(skies))]
        return [[float(row["illuminance_lx"]) for row in csv.DictReader(table.open())] for table in tables]

    def shares(self, days):
        """By (day, hour): for each sensor, its lux a lux of the sun, and of each of the skies."""
        moments = {(day, hour): self.skies(self.moment(day, hour)) for day in days for hour in range(24)}
        moments = {at: words for at, words in moments.items() if words}
        measured = iter(self.measured([sky for words in moments.values() for sky in words]))
        of = {}
        for at, words in moments.items():
            for sky in words:
                outdoors = self.outdoors(sky)
                of.setdefault(at, []).append([value / outdoors if outdoors > 0 else 0 for value in next(measured)])
        return of


def between(days, day):
    """The two days of `days` around a day, and how far it is from the first to the second."""
    first = max((d for d in days if d <= day), default=days[-1])
    second = min((d for d in days if d > day), default=days[0])
    span = (second - first) % 365 or 365
    return first, second, ((day - first) % 365) / span


def of_skies(shares, part):
    """A sensor's lux a lux of the sky, where the sun has this part of the light."""
    for ((low, _), below), ((high, _), above) in zip(zip(SKIES, shares), zip(SKIES[1:], shares[1:])):
        if part <= high:
            return below + (above - below) * max(0, part - low) / (high - low)
    return shares[-1]


def illuminances(shares, days, sensors, at, hour):
    (sun, sky), part = hour
    first, second, way = between(days, at[0])
    ends = [(shares.get((day, at[1])), weight) for day, weight in ((first, 1 - way), (second, way))]
    ends = [(share, weight) for share, weight in ends if share]
    total = sum(weight for _, weight in ends)
    if total == 0:
        return [0] * sensors
    return [
        sum(weight / total * (sun * share[0][i] + sky * of_skies([s[i] for s in share[1:]], part)) for share, weight in ends)
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
    year = {at: illuminances(shares, days, sensors, at, hour) for at, hour in hours.items()}
    write_table(args.output / "year.csv", [
        {"day": day, "hour": hour} | {f"sensor_{i + 1}_lx": round(value, 1) for i, value in enumerate(lux)}
        for (day, hour), lux in year.items()
    ])  # fmt: skip
    rows = [figures(year, sensor) for sensor in range(sensors)]
    write_table(args.output / "figures.csv", rows)
    print((args.output / "figures.csv").read_text(), end="")
    lit = sum(row["DA_300"] >= 0.5 for row in rows)
    print(f"sDA300,50%: {100 * lit / sensors:.0f} % of {sensors} sensors")


if __name__ == "__main__":
    main()
