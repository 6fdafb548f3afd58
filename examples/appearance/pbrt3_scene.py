# SPDX-License-Identifier: Apache-2.0
"""appearance-v3.pbrt: what only pbrt-v3 can say, in the same room."""

import layout
from pbrt_scene import placed

HEADER = """# Materials, textures and lights that pbrt-v3 has and v4 has not. Written by generate.py.
# Licence: Apache-2.0.

Scale -1 1 1
LookAt @EYE@   @TARGET@   0 1 0
Camera "perspective" "float fov" [@FOV@]
Film "image" "string filename" "appearance-v3.exr" "integer xresolution" [@WIDTH@] "integer yresolution" [@HEIGHT@]
PixelFilter "mitchell"
Sampler "random" "integer pixelsamples" [@SPP@]
Integrator "path" "integer maxdepth" [6]

WorldBegin

Texture "st" "spectrum" "uv" "float uscale" [4] "float vscale" [4]
Texture "wood" "spectrum" "imagemap" "string filename" "textures/wood.png"
Texture "warm" "spectrum" "scale" "texture tex1" "wood" "rgb tex2" [1 0.7 0.5]
Texture "rough" "float" "imagemap" "string filename" "textures/spots.png" "float scale" [40]

AttributeBegin
  Rotate -90 1 0 0
  LightSource "infinite" "string mapname" "textures/sky-lat-long.hdr" "rgb L" [0.8 0.8 0.8]
AttributeEnd
LightSource "spot" "point from" [-1.2 3.0 2.6] "point to" [0 1.2 -0.75] "rgb I" [60 55 45]
  "float coneangle" [22] "float conedeltaangle" [14]
AttributeBegin
  Translate 1.8 2.7 2
  Rotate -90 1 0 0
  LightSource "goniometric" "string mapname" "textures/lantern.hdr" "rgb I" [5 4.5 4]
AttributeEnd
AttributeBegin
  AreaLightSource "area" "rgb L" [12 11 10]
  Material "matte"
  Shape "plymesh" "string filename" "meshes/lamp.ply"
AttributeEnd

Material "matte" "texture Kd" "st" "float sigma" [25]
Shape "plymesh" "string filename" "meshes/floor.ply"
Material "matte" "rgb Kd" [0.7 0.65 0.55] "texture sigma" "rough"
Shape "plymesh" "string filename" "meshes/back.ply"
Shape "plymesh" "string filename" "meshes/left.ply"
Shape "plymesh" "string filename" "meshes/right.ply"
Material "matte" "rgb Kd" [0.75 0.75 0.75]
Shape "plymesh" "string filename" "meshes/ceiling.ply"
Material "plastic" "texture Kd" "warm" "rgb Ks" [0.3 0.3 0.3] "float roughness" [0.1]
Shape "plymesh" "string filename" "meshes/bookcase.ply"
"""

MATERIALS = [
    'Material "glass" "float index" [1.6]',
    'Material "mirror"',
    'Material "metal" "float roughness" [0.02]',
    'Material "matte" "rgb Kd" [0.7 0.3 0.2] "float sigma" [60]',
    'Material "plastic" "rgb Kd" [0.1 0.3 0.6]',
    'Material "substrate" "rgb Kd" [0.5 0.2 0.1] "float uroughness" [0.02] "float vroughness" [0.3]',
    'Material "translucent" "rgb Kd" [0.4 0.5 0.3]',
    'Material "uber" "rgb Kd" [0.3 0.3 0.1] "rgb opacity" [0.5 0.5 0.5]',
    'Material "disney" "rgb color" [0.6 0.2 0.5] "float metallic" [0.4] "float clearcoat" [1]',
]


def scene_text(width, height, spp):
    text = HEADER
    for key, value in {
        "EYE": " ".join(map(str, layout.EYE)),
        "TARGET": " ".join(map(str, layout.TARGET)),
        "FOV": layout.FOV_DEG,
        "WIDTH": width,
        "HEIGHT": height,
        "SPP": spp,
    }.items():
        text = text.replace(f"@{key}@", str(value))
    for i, (x, y) in enumerate(layout.places()):
        mesh = ("sphere", "vase", "box")[(i + i // 9) % 3]
        before = MATERIALS[i % len(MATERIALS)]
        text += placed((x, y + layout.SIZE + 0.001, layout.DEPTH_Z), layout.SIZE, before, mesh)
    return text + "WorldEnd\n"
