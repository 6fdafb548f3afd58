#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the hotel room as a PBRT v4 scene with binary PLY meshes.

Sample runs:
    ./generate.py -o /tmp/hotel-room                     the full scene
    ./generate.py -o /tmp/hotel-room --detail 0.1        a tenth of the triangles, for tests
    ./generate.py -o /tmp/hotel-room --switching         with electrochromic glass in the door
    ./generate.py -o /tmp/hotel-room --lamps 0           lamps off
    ./generate.py -o /tmp/hotel-room --width 1920 --height 1080 --spp 256
"""

import argparse
from collections import defaultdict
from pathlib import Path
from shutil import copytree

from bed import bed
from decor import decor
from exterior import exterior
from furniture import furniture
from materials import MATERIALS
from meshes import join, settled, write_ply
from room import curtains, door, floor, mouldings, panes, shell, window_frame
from textiles import rug

EYE, TARGET = (5.95, 0.32, 1.45), (2.33, 4.95, 1.12)
VERTICAL_FOV = 46.0
SUN_TRAVELS = (0.826, 0.334, -0.454)  # 27° above the horizon
SUN = (32.0, 28.2, 22.8)  # irradiance across its direction, linear sRGB
SKY = (0.84, 1.06, 1.38)
LEAST_DETAIL = 0.1
PLAIN_SHARE = 0.04  # of the full scene's triangles: what is flat enough to stay as it is


def collect(detail, switching):
    """The room with all that bends at `detail`: meshes and emissions by file name, in a fixed order."""
    parts = (
        shell()
        + floor()
        + mouldings()
        + window_frame()
        + panes(switching)
        + curtains(detail)
        + door()
        + rug(detail)
        + bed(detail)
        + furniture(detail)
        + decor(detail)
        + exterior(detail)
    )
    groups = defaultdict(list)
    for part in parts:
        flat = "" if part.mesh.n is not None else "-flat"
        groups[f"{part.name}-{part.material}{flat}"].append(part)
    return {
        name: (group[0].material, settled(join([p.mesh for p in group])), group[0].radiance)
        for name, group in groups.items()
    }


def numbers(values):
    return " ".join(f"{v:g}" for v in values)


def header(width, height, spp):
    return f"""# A hotel room with a glazed balcony door. Metres, z up, right-handed. Written by generate.py; licence: Apache-2.0.

Scale -1 1 1  # pbrt's camera is left-handed: without this the picture is mirrored
LookAt {numbers(EYE)}  {numbers(TARGET)}  0 0 1
Camera "perspective" "float fov" [{VERTICAL_FOV:g}]
Film "rgb" "string filename" "hotel-room.exr" "integer xresolution" [{width}] "integer yresolution" [{height}]
PixelFilter "gaussian"
Sampler "independent" "integer pixelsamples" [{spp}]
Integrator "path" "integer maxdepth" [12]

WorldBegin

# The sun, seen through the panes, and a clear sky.
LightSource "distant" "point3 from" [0 0 0] "point3 to" [{numbers(SUN_TRAVELS)}] "rgb L" [{numbers(SUN)}]
LightSource "infinite" "rgb L" [{numbers(SKY)}]
"""


def material(name):
    if name == "window":
        # A form that pbrt reads past: it has clear glass there.
        return (
            'AttributeBegin\n  Attribute "material" "string glazing" "glazing/electrochromic.json"\n'
            '  MakeNamedMaterial "window" "string type" "thindielectric"\nAttributeEnd'
        )
    if name == "glass":
        return 'MakeNamedMaterial "glass" "string type" "dielectric" "spectrum eta" "glass-BK7"'
    return (
        f'MakeNamedMaterial "{name}" "string type" "diffuse" "rgb reflectance" [{numbers(MATERIALS[name])}]'
    )


def shape(name, material_name, radiance):
    mesh = f'Shape "plymesh" "string filename" "meshes/{name}.ply"'
    if radiance is None:
        return f'NamedMaterial "{material_name}"\n{mesh}'
    return (
        f'AttributeBegin\n  NamedMaterial "{material_name}"\n  AreaLightSource "diffuse" "rgb L" [{numbers(radiance)}]'
        f' "bool twosided" true\n  {mesh}\nAttributeEnd'
    )


def write_scene(folder, detail, width, height, spp, switching=False, lamps=1):
    """Returns the number of triangles. `lamps` is a factor of what they emit."""
    (folder / "meshes").mkdir(parents=True, exist_ok=True)
    objects = collect((max(detail, LEAST_DETAIL) - PLAIN_SHARE) / (1 - PLAIN_SHARE), switching)
    if switching:
        copytree(Path(__file__).resolve().parent / "glazing", folder / "glazing", dirs_exist_ok=True)
    for name, (_, mesh, _) in objects.items():
        write_ply(folder / "meshes" / f"{name}.ply", mesh)
    used = sorted({m for m, _, _ in objects.values()})
    text = [header(width, height, spp)] + [material(m) for m in used] + [""]
    text += [
        shape(name, m, [lamps * r for r in radiance] if radiance and lamps else None)
        for name, (m, _, radiance) in objects.items()
    ]
    (folder / "hotel-room.pbrt").write_text("\n".join(text) + "\n")
    return sum(len(mesh.f) for _, mesh, _ in objects.values())


def main():
    parser = argparse.ArgumentParser(description="writes hotel-room.pbrt and its meshes")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    parser.add_argument(
        "--detail",
        type=float,
        default=1.0,
        metavar="D",
        help="scales the triangle count; at least 0.1 (default 1)",
    )
    parser.add_argument("--width", type=int, default=960)
    parser.add_argument("--height", type=int, default=540)
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel (default 64)")
    parser.add_argument(
        "--switching", action="store_true", help="glaze the door with switchable glazing (glazing/)"
    )
    parser.add_argument("--lamps", type=float, default=1, metavar="F", help="factor of the lamps' light; 0: off")
    args = parser.parse_args()
    count = write_scene(args.output, args.detail, args.width, args.height, args.spp, args.switching, args.lamps)
    print(f"{args.output / 'hotel-room.pbrt'}: {count} triangles")


if __name__ == "__main__":
    main()
