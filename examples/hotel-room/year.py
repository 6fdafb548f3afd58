#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The hotel room over a year behind glass that is clear, electrochromic or photochromic: light on the desk and at the
eye of who sits there, hours of glare risk, melanopic light, and the solar heat that the glass lets in.

Sample runs:
    ./year.py -o /tmp/year --weather paris.epw              the window looks to the south
    ./year.py -o /tmp/year --weather oslo.epw --north=y     to the west
    ./year.py -o /tmp/year --weather made-up.epw --quick    a fast first look

The electrochromic glass is dark in the hours in which more than 2000 lx would come to the eye through clear glass. The
photochromic glass follows its kinetics, by the ultraviolet light on the pane. Writes year.md, a row a glass; year.svg,
by months; and a folder for each glass with what `vitrail year` says of it.
"""

import argparse
import csv
import json
import subprocess
from pathlib import Path
from shutil import which

from generate import write_scene
from pictures import write_plot

# By name: position and normal. The last lie in the middle of the window, before the glass and on the wall's inner side.
SENSORS = {
    "desk": "1.32 5.72 0.78  0 0 1",
    "eye": "1.32 5.25 1.2  0 1 0",
    "glass": "-0.2 3.75 1.2  -1 0 0",
    "opening": "0 3.75 1.2  -1 0 0",
}
DARK_LX = 2000
PHOTOCHROMIC_STATES = [0, 0.25, 0.5, 0.75, 1]


def table(file):
    with file.open() as rows:
        return list(csv.DictReader(rows))


def states(values):
    return [word for s in values for word in ("--state", f"s{s:g}=window.state={s:g}")]


def partition(vitrail, folder, kind, north):
    text = (folder / "hotel-room.pbrt").read_text().replace("electrochromic.json", f"{kind}.json")
    scene = folder / f"{kind}.pbrt"
    scene.write_text(text)
    bundle = folder / f"{kind}.vit"
    sky = f"0,0,2026-03-20T12:00Z,up=z,north={north}"  # the year brings its own; this says how the room stands
    words = [vitrail, "partition", scene, "-o", bundle, f"--sky={sky}", "--force", "--quiet"]
    subprocess.run([str(word) for word in words], check=True)
    return bundle


def row_of(name, folder):
    """What the table says of a glass, and its months."""
    desk, eye = table(folder / "figures.csv")[:2]
    heat = table(folder / "heat.csv")
    hours = table(folder / "hours.csv")
    year = sum(float(hour["let_in_w_m2"]) for hour in heat) / 1000
    months = {"heat": [], "eye": []}
    for month in range(1, 13):
        mine = [i for i, hour in enumerate(heat) if int(hour["month"]) == month]
        months["heat"].append((month, sum(float(heat[i]["let_in_w_m2"]) for i in mine) / 1000))
        used = [float(hours[i]["sensor_2_lx"]) for i in mine if 8 <= int(hours[i]["hour"]) < 18]
        months["eye"].append((month, sum(used) / max(1, len(used))))
    cells = [
        name,
        f"{float(desk['mean_lx']):.0f} ± {float(desk['mean_lx_error']):.0f}",
        f"{100 * float(desk['DA']):.1f} ± {100 * float(desk['DA_error']):.1f}",
        f"{float(eye['glare_hours']):.0f} ± {float(eye['glare_hours_error']):.0f}",
        f"{100 * float(eye['melanopic_250']):.1f} ± {100 * float(eye['melanopic_250_error']):.1f}",
        f"{year:.0f}",
    ]
    return cells, months


def main():
    parser = argparse.ArgumentParser(description="compares glasses of the hotel room over a year")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--weather", type=Path, required=True, help="an EPW")
    parser.add_argument("--north", default="x", help="axis; the window looks to -x (default x: it looks south)")
    parser.add_argument("--detail", type=float, default=0.1, metavar="D", help="as of generate.py (default 0.1)")
    parser.add_argument("--quick", action="store_true", help="fewer patches and paths")
    parser.add_argument("--vitrail", default=which("vitrail") or "vitrail", help="the program, if not on the PATH")
    args = parser.parse_args()

    write_scene(args.output, args.detail, 16, 9, 1, switching=True, lamps=0)
    (args.output / "sensors.txt").write_text("".join(f"{line}\n" for line in SENSORS.values()))
    rules = {"rules": [{"when": f"sensor 2 > {DARK_LX} lx", "state": "s1"}], "otherwise": "s0"}
    (args.output / "rules.json").write_text(json.dumps(rules))
    bundles = {kind: partition(args.vitrail, args.output, kind, args.north) for kind in ("electrochromic", "photochromic")}
    rows, months = [], {}
    for name, kind, words in (
        ("clear", "electrochromic", states([0, 1])),
        ("electrochromic", "electrochromic", [*states([0, 1]), "--rules", args.output / "rules.json"]),
        ("photochromic", "photochromic", [*states(PHOTOCHROMIC_STATES), "--photochromic"]),
    ):
        folder = args.output / kind
        quick = ["--patches", 1, "--paths", 2048, "--sun-paths", 4] if args.quick else ["--patches", 2, "--sun-paths", 64]
        run = [args.vitrail, "year", bundles[kind], "--weather", args.weather, "--sensors", args.output / "sensors.txt", "-o", folder,
               "--heat", f"window={args.output / 'glazing' / kind}.json@3", "--quiet", *quick, *words]  # fmt: skip
        subprocess.run([str(word) for word in run], check=True, stdout=subprocess.DEVNULL)
        cells, months[name] = row_of(name, folder)
        rows.append(cells)
    head = ["glass", "desk, mean lx", "DA 300, %", "glare, h", "melanopic 250 lx, %", "solar heat, kWh/m²"]
    lines = ["| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head), *rows]]
    (args.output / "year.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
    panels = [
        ("solar heat let in, kWh/m² of glass a month", {name: m["heat"] for name, m in months.items()}, {}),
        ("mean illuminance at the eye, 8 to 18 h, lx", {name: m["eye"] for name, m in months.items()}, {}),
    ]
    write_plot(args.output / "year.svg", panels, "month")


if __name__ == "__main__":
    main()
