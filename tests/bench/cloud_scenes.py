#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes clouds of ordinary size into a folder, for speed.py.

  tests/bench/cloud_scenes.py FOLDER [CELLS]      128 cells along each axis by default; half of them in colours
  tests/bench/speed.py --quick --size 96 --spp 16 64 --pbrt PBRT --also smooth=FOLDER/smooth.xml --also clumps=FOLDER/clumps.xml \\
      --also colours=FOLDER/colours.pbrt smooth clumps colours

smooth.xml, clumps.xml: Mitsuba's `heterogeneous` with a grid of σ_t, a ball that thins out, and dense clumps in thin air.
colours.pbrt: pbrt's `rgbgrid`, with grids of σ_s and σ_a.
"""
import pathlib
import struct
import sys

import numpy as np

XML = """<scene version="3.0.0"><integrator type="volpath"/><sensor type="perspective"><float name="fov" value="45"/>
<transform name="to_world"><lookat origin="0,-4,1" target="0,0,0" up="0,0,1"/></transform>
<film type="hdrfilm"><integer name="width" value="160"/><integer name="height" value="90"/></film></sensor><emitter type="constant"/>
<shape type="cube"><bsdf type="null"/><medium name="interior" type="heterogeneous"><float name="scale" value="8"/>
<volume name="sigma_t" type="gridvolume"><string name="filename" value="{file}"/>
<transform name="to_world"><scale value="2"/><translate x="-1" y="-1" z="-1"/></transform></volume>
<rgb name="albedo" value=".9,.9,.9"/></medium></shape></scene>
"""
PBRT = """LookAt 0 -4 1 0 0 0 0 0 1
Camera "perspective" "float fov" 45
Film "rgb" "integer xresolution" 160 "integer yresolution" 90
Integrator "volpath" "integer maxdepth" 100
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
MakeNamedMedium "cloud" "string type" "rgbgrid" "integer nx" {n} "integer ny" {n} "integer nz" {n} "point3 p0" [-1 -1 -1]
  "point3 p1" [1 1 1] "float scale" 8 "rgb sigma_s" [{scattering}] "rgb sigma_a" [{absorption}]
AttributeBegin
Material "interface"
MediumInterface "cloud" ""
Shape "sphere" "float radius" 1.7
AttributeEnd
"""


def ball(n):
    z = np.linspace(-1, 1, n)
    x, y, z = z[None, None, :], z[None, :, None], z[:, None, None]
    return np.maximum(0, 1 - np.sqrt(x * x + y * y + z * z)) * (1 + .3 * np.sin(20 * z)), (x, y, z)


def clumps(density):
    dense = np.random.default_rng(1).random((density.shape[0] // 8,) * 3) < .02
    return np.where(dense.repeat(8, 0).repeat(8, 1).repeat(8, 2), 8, density * .05)


def write_xml(folder, name, values):
    header = b"VOL\x03" + struct.pack("<iiiii6f", 1, *values.shape[::-1], 1, -1, -1, -1, 1, 1, 1)
    (folder / f"{name}.vol").write_bytes(header + values.astype("<f4").tobytes())
    (folder / f"{name}.xml").write_text(XML.format(file=f"{name}.vol"))


def write_colours(folder, n):
    density, axes = ball(n)
    hue = np.stack([.6 + .4 * np.sin(k * a + k) + 0 * density for k, a in zip((5, 7, 4), axes)], -1)
    numbers = lambda values: " ".join(f"{v:.3f}" for v in values.ravel())
    scattering, absorption = density[..., None] * hue, density[..., None] * (1.05 - hue) * .15
    (folder / "colours.pbrt").write_text(PBRT.format(n=n, scattering=numbers(scattering), absorption=numbers(absorption)))


def main():
    folder, n = pathlib.Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 128
    folder.mkdir(parents=True, exist_ok=True)
    density = ball(n)[0]
    write_xml(folder, "smooth", density)
    write_xml(folder, "clumps", clumps(density))
    write_colours(folder, n // 2)


if __name__ == "__main__":
    main()
