# SPDX-License-Identifier: Apache-2.0
"""appearance.pbrt: what pbrt-v4 can say."""

import layout
from meshes import smoke


def grid_values(n, value):
    at = [(i + 0.5) / n for i in range(n)]
    return " ".join(f"{value(x, y, z):.3g}" for z in at for y in at for x in at)


def rgb_values(n, color):
    at = [(i + 0.5) / n for i in range(n)]
    return " ".join(f"{c:.3g}" for z in at for y in at for x in at for c in color(x, y, z))


def header(width, height, spp):
    eye, target = (" ".join(map(str, p)) for p in (layout.EYE, layout.TARGET))
    return f"""# Every material, texture, light and medium that pbrt-v4 has and Vitrail shows. Written by generate.py.
# Licence: Apache-2.0.

Scale -1 1 1
LookAt {eye}   {target}   0 1 0
Camera "perspective" "float fov" [{layout.FOV_DEG}] "float lensradius" [0.004] "float focaldistance" [6.4]
Film "rgb" "string filename" "appearance.exr" "integer xresolution" [{width}] "integer yresolution" [{height}]
PixelFilter "gaussian" "float xradius" [1.5] "float yradius" [1.5] "float sigma" [0.5]
Sampler "independent" "integer pixelsamples" [{spp}]
Integrator "volpath" "integer maxdepth" [6]

WorldBegin
"""


TEXTURES = """
Texture "wood" "spectrum" "imagemap" "string filename" "textures/wood.png" "float uscale" [3]
Texture "plaster" "spectrum" "imagemap" "string filename" "textures/plaster.png" "string filter" "ewa"
  "float uscale" [4] "float vscale" [2]
Texture "brick" "spectrum" "imagemap" "string filename" "textures/brick.png" "string filter" "trilinear"
  "float uscale" [3] "float vscale" [2]
Texture "metres" "spectrum" "imagemap" "string filename" "textures/brick.png" "string mapping" "planar"
  "vector3 v1" [0 0 0.8] "vector3 v2" [0 0.8 0] "float udelta" [0.25] "string encoding" "gamma 2.2"
Texture "painting" "spectrum" "imagemap" "string filename" "textures/painting.png" "string filter" "point"
Texture "ceiling" "spectrum" "imagemap" "string filename" "textures/spots.png" "bool invert" true
  "float scale" [0.25] "float uscale" [2] "float vscale" [2] "string encoding" "linear"
Texture "rug" "spectrum" "imagemap" "string filename" "textures/slide.png" "string wrap" "black"
  "float uscale" [1.2] "float vscale" [1.2] "float udelta" [-0.1] "float vdelta" [-0.1]
Texture "rainbow" "spectrum" "imagemap" "string filename" "textures/rainbow.pfm" "string wrap" "clamp"
  "float uscale" [1.4] "float udelta" [-0.2]
Texture "bright" "spectrum" "constant" "rgb value" [0.80 0.78 0.74]
Texture "dark" "spectrum" "constant" "rgb value" [0.16 0.20 0.28]
Texture "tiles" "spectrum" "checkerboard" "texture tex1" "bright" "texture tex2" "dark"
  "float uscale" [12] "float vscale" [10]
Texture "faded" "spectrum" "scale" "texture tex" "plaster" "float scale" [0.8]
Texture "spots" "float" "imagemap" "string filename" "textures/spots.png" "float uscale" [2]
Texture "leaf" "float" "imagemap" "string filename" "textures/leaf.png" "string wrap" "black"
  "string filter" "trilinear"
Texture "bumps" "float" "imagemap" "string filename" "textures/brick-height.png" "float scale" [0.02]
  "float uscale" [6] "float vscale" [5] "string encoding" "linear"
Texture "waves" "float" "imagemap" "string filename" "textures/waves.png" "string encoding" "linear"
Texture "fine" "float" "scale" "texture tex" "waves" "float scale" [0.3]
Texture "dented" "float" "scale" "texture tex" "waves" "float scale" [0.08]
"""

ROOM = """
Material "diffuse" "texture reflectance" "tiles" "texture displacement" "bumps"
Shape "plymesh" "string filename" "meshes/floor.ply"
Material "diffuse" "texture reflectance" "ceiling"
Shape "plymesh" "string filename" "meshes/ceiling.ply"
Material "diffuse" "texture reflectance" "faded"
Shape "plymesh" "string filename" "meshes/left.ply"
Material "diffuse" "texture reflectance" "brick" "string normalmap" "textures/waves-normals.png"
Shape "plymesh" "string filename" "meshes/back.ply"
Material "diffuse" "texture reflectance" "metres"
Shape "plymesh" "string filename" "meshes/right.ply"
Material "coateddiffuse" "texture reflectance" "wood" "float roughness" [0.1]
Shape "plymesh" "string filename" "meshes/bookcase.ply"
Material "diffuse" "texture reflectance" "rug"
Shape "plymesh" "string filename" "meshes/rug.ply"
Material "diffuse" "texture reflectance" "painting"
Shape "plymesh" "string filename" "meshes/picture.ply"
Material "thindielectric" "float eta" [1.5]
Shape "plymesh" "string filename" "meshes/window.ply"

ObjectBegin "candlestick"
  Material "conductor" "spectrum eta" "metal-CuZn-eta" "spectrum k" "metal-CuZn-k" "float roughness" [0.05]
  Shape "plymesh" "string filename" "meshes/candlestick.ply"
ObjectEnd
"""

LIGHTS = """
LightSource "infinite" "rgb L" [0.45 0.48 0.52]
AttributeBegin
  Rotate -90 1 0 0
  LightSource "infinite" "string filename" "textures/sky-equal-area.hdr" "float scale" [0.8]
    "point3 portal" [@PORTAL@]
AttributeEnd
LightSource "distant" "point3 from" [-2 3 6] "point3 to" [0 0 0] "rgb L" [0.9 0.87 0.8]
LightSource "point" "point3 from" [1.2 2.6 3.2] "rgb I" [2.5 2.3 2.1]
LightSource "spot" "point3 from" [-1.2 3.0 2.6] "point3 to" [0 1.2 -0.75] "float coneangle" [16]
  "float conedeltaangle" [6] "spectrum I" "stdillum-A" "float scale" [25]
AttributeBegin
  Translate 0.4 2.9 3.2
  Rotate 180 0 1 0
  Rotate 40 1 0 0
  LightSource "projection" "string filename" "textures/slide.png" "float fov" [34] "float scale" [14]
AttributeEnd
AttributeBegin
  Translate -2.75 2.6 0.9
  LightSource "goniometric" "string filename" "textures/lantern.hdr" "rgb I" [1.6 1.3 1.0]
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [14 13.2 12]
  Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
  Shape "plymesh" "string filename" "meshes/lamp.ply"
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "string filename" "textures/painting.png" "float scale" [1.2]
  Shape "plymesh" "string filename" "meshes/screen.ply"
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "blackbody L" [2700] "float scale" [5] "bool twosided" true
  Translate 0 -0.3 0
  Shape "plymesh" "string filename" "meshes/downlight.ply"
AttributeEnd
"""


def objects():
    """(mesh, what stands before the shape) of the 27 places, row by row."""
    return [
        # glass, and what may be in it
        ("sphere", 'Material "dielectric" "spectrum eta" "glass-BK7"'),
        ("vase", 'Material "dielectric" "spectrum eta" "glass-F11"'),
        ("sphere", 'Material "dielectric" "float eta" [1.5] "texture roughness" "fine"'),
        (
            "vase",
            'Material "dielectric" "float uroughness" [0.05] "float vroughness" [0.4] "bool remaproughness" false',
        ),
        (
            "sphere",
            'MakeNamedMedium "amber" "string type" "homogeneous" "rgb sigma_a" [0.6 3 9] "rgb sigma_s" [0 0 0]\n'
            '  MediumInterface "amber" ""\n  AttributeBegin\n    Translate 0.5 0.3 0.2\n    Scale 0.6 0.6 0.6\n'
            '    Material "dielectric" "float eta" [1.33] "integer priority" [2]\n    MediumInterface "" ""\n'
            '    Shape "plymesh" "string filename" "meshes/box.ply"\n  AttributeEnd\n'
            '  Material "dielectric" "float eta" [1.55] "integer priority" [1]',
        ),
        (
            "vase",
            'Material "subsurface" "rgb sigma_a" [0.05 0.2 0.5] "rgb sigma_s" [9 8 6] "float eta" [1.3]'
            ' "float roughness" [0.2]',
        ),
        (
            "box",
            f"""MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" 8 "integer ny" 8 "integer nz" 8
    "point3 p0" [-0.85 -1 -0.85] "point3 p1" [0.85 1 0.85] "rgb sigma_a" [2 2.5 3] "rgb sigma_s" [22 20 18]
    "float g" [0.4] "float density" [{grid_values(8, smoke)}]
  MediumInterface "smoke" ""
  Material "interface\"""",
        ),
        (
            "sphere",
            f"""MakeNamedMedium "dye" "string type" "rgbgrid" "integer nx" 4 "integer ny" 4 "integer nz" 4
    "point3 p0" [-1 -1 -1] "point3 p1" [1 1 1] "float scale" [8]
    "rgb sigma_a" [{rgb_values(4, lambda x, y, z: (0.1 + 0.7 * x, 0.3, 0.8 - 0.7 * x))}]
    "rgb sigma_s" [{rgb_values(4, lambda x, y, z: (1, 1, 1))}]
  MediumInterface "dye" ""
  Material "interface\"""",
        ),
        (
            "sphere",
            f"""MakeNamedMedium "ember" "string type" "uniformgrid" "integer nx" 4 "integer ny" 4 "integer nz" 4
    "point3 p0" [-1 -1 -1] "point3 p1" [1 1 1] "rgb sigma_a" [4 4 4] "rgb sigma_s" [2 2 2]
    "rgb Le" [1.5 0.45 0.12] "float Lescale" [{grid_values(4, lambda x, y, z: max(0.1, 1.4 - 1.4 * y))}]
    "float density" [{grid_values(4, lambda x, y, z: 1)}]
  MediumInterface "ember" ""
  Material "interface\"""",
        ),
        # metals and coats
        ("sphere", 'Material "conductor" "spectrum eta" "metal-Cu-eta" "spectrum k" "metal-Cu-k"'),
        (
            "vase",
            'Material "conductor" "spectrum eta" "metal-Au-eta" "spectrum k" "metal-Au-k"\n'
            '    "float uroughness" [0.05] "float vroughness" [0.5]',
        ),
        ("sphere", 'Material "conductor" "texture reflectance" "brick" "float roughness" [0.05]'),
        (
            "box",
            'Material "conductor" "spectrum eta" "metal-Al-eta" "spectrum k" "metal-Al-k" "texture roughness" "fine"',
        ),
        ("sphere", 'Material "coateddiffuse" "rgb reflectance" [0.65 0.10 0.08]'),
        ("vase", 'Material "coateddiffuse" "texture reflectance" "rainbow" "float roughness" [0.2]'),
        (
            "sphere",
            'Material "coateddiffuse" "rgb reflectance" [0.25 0.4 0.7] "float thickness" [0.3] "float g" [0.3]\n'
            '    "rgb albedo" [0.7 0.8 0.9] "integer nsamples" [2] "integer maxdepth" [12] "float roughness" [0.02]',
        ),
        ("vase", 'Material "coatedconductor" "texture displacement" "dented"'),
        (
            "sphere",
            'Material "coatedconductor" "rgb reflectance" [0.8 0.6 0.3] "float conductor.roughness" [0.1]\n'
            '    "float interface.roughness" [0.05] "float thickness" [0.1] "rgb albedo" [0.5 0.5 0.5]',
        ),
        # textures
        (
            "sphere",
            'Texture "globe" "spectrum" "imagemap" "string filename" "textures/painting.png"\n'
            '    "string mapping" "spherical"\n  Material "diffuse" "texture reflectance" "globe"',
        ),
        (
            "vase",
            'Texture "sleeve" "spectrum" "imagemap" "string filename" "textures/slide.png"\n'
            '    "string mapping" "cylindrical"\n  Material "diffuse" "texture reflectance" "sleeve"',
        ),
        (
            "box",
            'Texture "corners" "spectrum" "bilerp" "rgb v00" [0.8 0.1 0.1] "rgb v01" [0.1 0.7 0.1]\n'
            '    "rgb v10" [0.1 0.1 0.8] "rgb v11" [0.8 0.8 0.1]\n  Material "diffuse" "texture reflectance" "corners"',
        ),
        (
            "sphere",
            'TransformBegin\n  Scale 0.4 0.4 0.4\n'
            '  Texture "dice" "spectrum" "checkerboard" "integer dimension" 3 "rgb tex1" [0.75 0.72 0.6]\n'
            '    "rgb tex2" [0.3 0.1 0.1]\n  TransformEnd\n  Material "diffuse" "texture reflectance" "dice"',
        ),
        (
            "box",
            'Texture "boards" "spectrum" "checkerboard" "texture tex1" "wood" "rgb tex2" [0.2 0.3 0.2]\n'
            '    "string mapping" "planar" "vector3 v1" [2.5 0 0.7] "vector3 v2" [0 2.5 0.7]\n'
            '  Material "diffuse" "texture reflectance" "boards"',
        ),
        (
            "sphere",
            'Texture "snow" "spectrum" "directionmix" "rgb tex1" [0.85 0.87 0.9] "rgb tex2" [0.2 0.25 0.15]\n'
            '    "vector3 dir" [0 1 0]\n  Material "diffuse" "texture reflectance" "snow"',
        ),
        (
            "vase",
            'Texture "dappled" "spectrum" "mix" "rgb tex1" [0.15 0.35 0.5] "texture tex2" "wood"\n'
            '    "texture amount" "spots"\n'
            '  Material "diffuse" "texture reflectance" "dappled"',
        ),
        (
            "vase",
            'Material "diffusetransmission" "texture reflectance" "plaster" "rgb transmittance" [0.5 0.35 0.2]\n'
            '    "float scale" [0.6]',
        ),
        (
            "sphere",
            'MakeNamedMaterial "paint" "string type" "diffuse" "rgb reflectance" [0.1 0.4 0.25]\n'
            '  MakeNamedMaterial "gilt" "string type" "conductor" "spectrum eta" "metal-Au-eta"\n'
            '    "spectrum k" "metal-Au-k" "float roughness" [0.1]\n'
            '  Material "mix" "string materials" ["paint" "gilt"] "texture amount" "spots"',
        ),
    ]


def placed(place, size, before, mesh, after=""):
    x, y, z = place
    return f"""AttributeBegin
  Translate {x} {y} {z}
  Scale {size} {size} {size}
  {before}
  Shape "plymesh" "string filename" "meshes/{mesh}.ply"{after}
AttributeEnd
"""


def scene_text(width, height, spp):
    portal = "  ".join(" ".join(map(str, p)) for p in layout.PORTAL)
    text = header(width, height, spp) + TEXTURES + ROOM
    for x, z in layout.CANDLESTICKS:
        text += f'AttributeBegin\n  Translate {x} 0 {z}\n  ObjectInstance "candlestick"\nAttributeEnd\n'
    text += LIGHTS.replace("@PORTAL@", portal)
    for (mesh, before), (x, y) in zip(objects(), layout.places(), strict=True):
        text += placed((x, y + layout.SIZE + 0.001, layout.DEPTH_Z), layout.SIZE, before, mesh)
    text += placed(
        layout.LEAVES, 1, 'Material "diffuse" "rgb reflectance" [0.2 0.5 0.12]', "card", ' "texture alpha" "leaf"'
    )
    text += placed(layout.PANE, 1, 'Material "measured" "string filename" "sheet.txt"', "sheet")
    return text
