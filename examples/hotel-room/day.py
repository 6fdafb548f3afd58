#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The hotel room over a day, behind electrochromic glass in several states: pictures by hour and state, all
exposed alike, and the light on the desk and at the eye of who sits there.

Sample runs:
    ./day.py -o /tmp/day                                   the equinox in Paris, window to the south
    ./day.py -o /tmp/day --place 59.91,10.75 --date 2026-06-21 --zone +02:00 --north=y      Oslo, to the west
    ./day.py -o /tmp/day --hours 9 12 15 --states 0 1 --spp 256 --detail 1
    ./day.py -o /tmp/day --width 0                         the light alone

Sun and sky are part of a bundle: the scene is partitioned again for each hour; the state is set when it is rendered.
Writes day.png, a row a state and a column an hour; light.csv and light.svg. Lamps are off.
"""

import argparse
import csv
import subprocess
from pathlib import Path
from shutil import rmtree, which

from generate import write_scene
from pictures import write_mosaic, write_plot

# By name: position and normal. The desk is 75 cm high; who sits at it looks at the wall.
SENSORS = {"on the desk": ("1.32 5.72 0.78", "0 0 1"), "at the eye": ("1.32 5.25 1.2", "0 1 0")}
MELANOPIC_BY_DAY_LX = 250  # at least, at the eye (Brown et al. 2022, PLOS Biology 20(3))
DESK_LX = 500  # for writing and reading (EN 12464-1)


def run(*words):
    subprocess.run([str(word) for word in words], check=True)


def clock(hour):
    minutes = round(hour * 60)
    return f"{minutes // 60:02d}:{minutes % 60:02d}"


def measure(vitrail, bundle, state, folder, spp):
    """The rows of a CSV of SENSORS, by name."""
    table = folder / "sensors.csv"
    sensors = folder / "sensors.txt"
    sensors.write_text("".join(f"{p} {n}\n" for p, n in SENSORS.values()))
    run(
        vitrail, "render", bundle, "--sensors", sensors, "-o", table, "--spp", spp, "--set", f"window.state={state:g}",
        "--force", "--quiet",
    )  # fmt: skip
    with table.open() as file:
        return dict(zip(SENSORS, csv.DictReader(file)))


def picture(vitrail, bundle, state, name, spp, exposure):
    film, png = name.with_suffix(".film"), name.with_suffix(".png")
    run(vitrail, "render", bundle, "-o", film, "--spp", spp, "--set", f"window.state={state:g}", "--force", "--quiet")
    run(vitrail, "develop", film, "-o", png, "--exposure", exposure, "--tone", "aces", "--quiet")
    film.unlink()
    return png


def plot(path, rows, states, words):
    def lines(sensor, column):
        return {
            f"state {state:g}": [
                (float(row["hour"]), float(row[column]))
                for row in rows
                if (row["sensor"], row["state"]) == (sensor, f"{state:g}")
            ]
            for state in states
        }

    desk, eye = SENSORS
    panels = [
        (f"illuminance {desk}, lx", lines(desk, "illuminance_lx"), {f"{DESK_LX} lx": DESK_LX}),
        (f"melanopic EDI {eye}, lx", lines(eye, "melanopic_edi_lx"), {f"{MELANOPIC_BY_DAY_LX} lx": MELANOPIC_BY_DAY_LX}),
    ]
    write_plot(path, panels, f"hour, {words}")


def main():
    parser = argparse.ArgumentParser(description="renders and measures the hotel room over a day")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--place", default="48.86,2.35", help="latitude,longitude (default Paris)")
    parser.add_argument("--date", default="2026-03-20")
    parser.add_argument("--zone", default="+01:00", help="of the clock, from UTC")
    parser.add_argument("--north", default="x", help="axis; the window looks to -x (default x: it looks south)")
    parser.add_argument("--turbidity", type=float, default=3)
    parser.add_argument("--hours", type=float, nargs="+", default=[8, 10, 13, 15, 17], help="of the pictures")
    parser.add_argument("--measured", type=float, nargs="+", default=[7 + 0.5 * k for k in range(24)], help="hours")
    parser.add_argument("--states", type=float, nargs="+", default=[0, 0.5, 1], help="0 clear to 1 dark")
    parser.add_argument("--detail", type=float, default=0.1, metavar="D", help="as of generate.py (default 0.1)")
    parser.add_argument("--width", type=int, default=240, help="of a picture, 16:9; 0: no pictures")
    parser.add_argument("--spp", type=int, default=128, help="samples per pixel (default 128)")
    parser.add_argument("--sensor-spp", type=int, default=4096, help="a sixteenth of the samples per sensor")
    parser.add_argument("--exposure", type=float, default=6, help="of all pictures, in stops")
    parser.add_argument("--vitrail", default=which("vitrail") or "vitrail", help="the program, if not on the PATH")
    args = parser.parse_args()

    width = args.width or 16
    write_scene(args.output, args.detail, width, max(1, width * 9 // 16), args.spp, switching=True, lamps=0)
    hours = args.hours if args.width else []
    pictures, rows = {}, []
    for hour in sorted({*hours, *args.measured}):
        sky = (
            f"{args.place},{args.date}T{clock(hour)}{args.zone},up=z,north={args.north},turbidity={args.turbidity:g}"
        )
        bundle = args.output / "hour.vit"
        rmtree(bundle, ignore_errors=True)
        run(args.vitrail, "partition", args.output / "hotel-room.pbrt", "-o", bundle, f"--sky={sky}", "--quiet")
        for state in args.states:
            if hour in args.measured:
                for sensor, row in measure(args.vitrail, bundle, state, args.output, args.sensor_spp).items():
                    rows.append({"hour": f"{hour:g}", "state": f"{state:g}", "sensor": sensor, **row})
            if hour in hours:
                name = args.output / f"{clock(hour).replace(':', '')}-{state:g}"
                pictures[state, hour] = picture(args.vitrail, bundle, state, name, args.spp, args.exposure)
        print(clock(hour), flush=True)
    rmtree(bundle)

    with (args.output / "light.csv").open("w", newline="") as file:
        table = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    plot(args.output / "light.svg", rows, args.states, f"{args.date}, {args.place}")
    print(args.output / "light.csv", args.output / "light.svg", sep="\n")
    if hours:
        write_mosaic(args.output / "day.png", [[pictures[s, h] for h in hours] for s in args.states])
        print(args.output / "day.png")


if __name__ == "__main__":
    main()
