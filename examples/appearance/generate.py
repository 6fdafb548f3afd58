#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a room whose shelf shows every material, texture, light and medium that Vitrail has, in three files.

Sample runs:
    ./generate.py -o /tmp/appearance
    ./generate.py -o /tmp/appearance --width 96 --height 64 --spp 16
"""

import argparse
from pathlib import Path

import images
import layout
import meshes
import mitsuba_scene
import pbrt3_scene
import pbrt_scene

# A coated pane: what it reflects and lets through by wavelength and angle (docs/why/measured-glass.md).
SHEET = [(400, 0.30, 0.42), (500, 0.14, 0.70), (600, 0.22, 0.62), (700, 0.46, 0.34)]


def sheet_text():
    rows = ["# a pane with an interference coat; made up", "wavelength_nm angle_deg R T"]
    for nm, r, t in SHEET:
        for angle in (0, 40, 65, 80):
            more = (angle / 90) ** 4  # reflects more, lets less through, the more it is seen from the side
            rows.append(f"{nm} {angle} {r + (1 - r) * 0.8 * more:.4f} {t * (1 - more):.4f}")
    return "\n".join(rows) + "\n"


def main():
    parser = argparse.ArgumentParser(description="writes appearance.pbrt and appearance.xml with their files")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--width", type=int, default=480)
    parser.add_argument("--height", type=int, default=320)
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel (default 64)")
    args = parser.parse_args()
    (args.output / "meshes").mkdir(parents=True, exist_ok=True)
    images.write_all(args.output / "textures")
    for name, mesh in layout.meshes().items():
        meshes.write_ply(args.output / "meshes" / f"{name}.ply", mesh)
    for name, mesh, colors in (("sphere", meshes.sphere(), "vertex"), ("vase", meshes.vase(), "face")):
        meshes.write_ply(args.output / "meshes" / f"{name}-colors.ply", mesh, colors)
    meshes.write_vol(args.output / "smoke.vol", 12, 1, lambda x, y, z: (meshes.smoke(x, y, z),))
    meshes.write_vol(args.output / "smoke-albedo.vol", 4, 3, lambda x, y, z: (0.95 - 0.4 * y, 0.9, 0.6 + 0.35 * y))
    (args.output / "sheet.txt").write_text(sheet_text())
    size = (args.width, args.height, args.spp)
    (args.output / "appearance.pbrt").write_text(pbrt_scene.scene_text(*size))
    (args.output / "appearance.xml").write_text(mitsuba_scene.scene_text(*size))
    (args.output / "appearance-v3.pbrt").write_text(pbrt3_scene.scene_text(*size))


if __name__ == "__main__":
    main()
