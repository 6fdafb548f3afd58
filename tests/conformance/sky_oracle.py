#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Skies of `vitrail sky` beside Radiance's gendaylit and the formulae of the CIE: lux on the ground and on four walls.

  tests/conformance/sky_oracle.py --bin build/release/bin [--radiance FOLDER]

Twelve moments, from clear to overcast, at the height where the sun stands for Vitrail: gendaylit is given that height, and then counts
with the sun's distance of early January, as the moments have it. It brings its sky to the measured light by a sum over 145 directions,
by which it is up to 4 % too dark where the sun's glow is narrow: "its own" is what a fine grid makes of it. The walls are compared
after that. The ground reflects 0.2 of both: its cd/m² are beside gendaymtx's, as gendaylit takes those of a CIE sky. FOLDER holds Radiance's bin/ and lib/: that of PyPI's pyradiance where none is given. Without it the CIE's rows alone
are printed. Ends with 1 where a value is off by more than 1 %.
"""
import argparse
import importlib.util
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

# Latitude, hour of local sun time about, direct and diffuse W/m².
MOMENTS = [(-35, 12, 0, 150), (-35, 9, 30, 300), (-20, 15, 120, 330), (45, 12, 150, 100), (30, 10, 300, 200), (-50, 12, 450, 220),
           (20, 14, 600, 120), (-30, 11, 900, 90), (50, 11, 2, 18), (35, 9, 500, 60), (55, 10, 60, 40), (-10, 12, 1000, 60)]
CIE = {1: (4, -.7, 0, -1, 0), 5: (0, -1, 0, -1, 0), 8: (0, -1, 10, -3, .45), 12: (-1, -.32, 10, -3, .45), 15: (-1, -.15, 24, -2.8, .15)}
GROUND = .2
WALLS = {"north": (0, 1, 0), "east": (1, 0, 0), "south": (0, -1, 0), "west": (-1, 0, 0)}


def directions(rows=1000, columns=720):
    theta = (np.arange(rows) + .5) / rows * np.pi / 2
    phi = (np.arange(columns) + .5) / columns * 2 * np.pi
    t, p = np.meshgrid(theta, phi, indexing="ij")
    d = np.stack([np.sin(t) * np.sin(p), np.sin(t) * np.cos(p), np.cos(t)], -1)
    return d, np.sin(t) * (np.pi / 2 / rows) * (2 * np.pi / columns)


DIRECTIONS, SOLID_ANGLES = directions()


def lux(luminance, sun, direct, normal):
    """What a plane gets of a sky and of the sun across its direction."""
    facing = np.maximum(0, DIRECTIONS @ np.array(normal, float))
    return float(np.sum(luminance * facing * SOLID_ANGLES)) + direct * max(0.0, float(np.dot(sun, normal)))


def distribution(k, sun, base):
    a, b, c, d, e = k
    cosine = np.clip(DIRECTIONS @ sun, -1, 1)
    return (1 + a * np.exp(b / np.maximum(DIRECTIONS[..., 2], .01))) * (base + c * np.exp(d * np.arccos(cosine)) + e * cosine ** 2)


def radiance_folder():
    found = importlib.util.find_spec("pyradiance")
    return pathlib.Path(found.origin).parent if found else None


def gendaylit(folder, height, azimuth, direct, diffuse, diffuse_lx):
    """Returns lux by plane with so much of the sky on the ground, and what Radiance has there. Its azimuth is from south to west."""
    text = subprocess.run([folder / "bin/gendaylit", "-ang", f"{height:.6f}", f"{azimuth - 180:.6f}", "-W", str(direct), str(diffuse), "-O", "2"],
                          capture_output=True, text=True, check=True, env=dict(os.environ, RAYPATH=str(folder / "lib"))).stdout
    lines = text.splitlines()
    scale, _, *k = [float(x) for x in next(line for line in lines if line.startswith("10 ")).split()[1:]]
    sun = np.array(k[5:])
    source = [float(line.split()[1]) for line in lines if line.startswith("3 ")]
    disc = 2 * math.pi * (1 - math.cos(math.radians(.533 / 2)))
    sky = scale * np.maximum(0, distribution(k[:5], sun, 1))
    own = lux(sky, sun, 0, (0, 0, 1))
    sky *= diffuse_lx / own
    return {name: lux(sky, sun, source[0] * disc if source else 0, normal) for name, normal in planes()}, own


def gendaymtx_ground(folder, latitude, hour, direct, diffuse):
    """Returns cd/m² of the ground."""
    with tempfile.NamedTemporaryFile("w", suffix=".wea") as weather:
        weather.write(f"place own\nlatitude {latitude}\nlongitude 0\ntime_zone 0\nsite_elevation 0\nweather_data_file_units 1\n"
                      f"1 3 {hour} {direct} {diffuse}\n")
        weather.flush()
        text = subprocess.run([folder / "bin/gendaymtx", "-m", "1", "-g", *3 * [str(GROUND)], "-c", "1", "1", "1", "-O0", weather.name],
                              capture_output=True, text=True, check=True, env=dict(os.environ, RAYPATH=str(folder / "lib"))).stdout
    return 179 * float(text.split("\n\n")[1].split()[0])


def planes():
    return [("horizontal", (0, 0, 1)), *WALLS.items()]


def ours(binaries, words):
    said = json.loads(subprocess.run([binaries / "vitrail", "sky", words, "--json"], capture_output=True, text=True, check=True).stdout)
    return said, {name: said[f"global_{name}"]["illuminance_lx"] for name, _ in planes()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default="build/release/bin")
    parser.add_argument("--radiance", type=pathlib.Path, default=radiance_folder())
    a = parser.parse_args()
    worst = {}

    def row(kind, said, found, expected, more=""):
        off = {name: found[name] / expected[name] - 1 for name in found}
        worst[kind] = max(worst.get(kind, 0), *(abs(x) for x in off.values()))
        print(f"{kind:10} {said['elevation_deg']:5.1f}° " + "  ".join(f"{name} {found[name]:7.0f} {off[name]:+7.2%}" for name in found) + more)

    for latitude, hour, direct, diffuse in MOMENTS:
        place = f"{latitude},0,2026-01-03T{hour:02}:00Z"
        if a.radiance:
            said, found = ours(a.bin, f"{place},direct={direct}W,diffuse={diffuse}W")
            of_sky = said["diffuse_horizontal"]["illuminance_lx"]
            expected, own = gendaylit(a.radiance, said["elevation_deg"], said["azimuth_deg"], direct, diffuse, of_sky)
            row("Perez", said, found, expected, f"  sky {of_sky:6.0f}, its own {own / of_sky - 1:+.2%}")
            lit = ours(a.bin, f"{place},direct={direct}W,diffuse={diffuse}W,ground={GROUND}")[1]
            row("ground", said, {"cd/m²": (lit["north"] - found["north"]) * 2 / math.pi},
                {"cd/m²": gendaymtx_ground(a.radiance, latitude, hour, direct, diffuse)})
        for kind, k in CIE.items():
            said, found = ours(a.bin, f"{place},cie={kind},direct={100 * direct}lx,diffuse={100 * diffuse}lx")
            height, azimuth = math.radians(said["elevation_deg"]), math.radians(said["azimuth_deg"])
            sun = np.array([math.cos(height) * math.sin(azimuth), math.cos(height) * math.cos(azimuth), math.sin(height)])
            sky = distribution(k, sun, 1 - k[2] * math.exp(k[3] * math.pi / 2))
            sky *= 100 * diffuse / lux(sky, sun, 0, (0, 0, 1))
            row(f"CIE {kind}", said, found, {name: lux(sky, sun, 100 * direct, normal) for name, normal in planes()})
    print("worst: " + ", ".join(f"{kind} {off:.2%}" for kind, off in worst.items()))
    if not a.radiance:
        print("without Radiance (PyPI: pyradiance) Perez's skies were compared with nothing")
    return 1 if max(worst.values()) > .01 else 0


if __name__ == "__main__":
    sys.exit(main())
