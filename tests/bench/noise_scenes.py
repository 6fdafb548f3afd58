# SPDX-License-Identifier: Apache-2.0
"""Small scenes for what --adaptive gains and --target-error keeps: sparse ones first, insides of rooms last."""

HEAD = """Film "rgb" "integer xresolution" [{w}] "integer yresolution" [{h}] "string filename" "x.exr"
PixelFilter "box"
Sampler "independent" "integer pixelsamples" [16]
Integrator "path" "integer maxdepth" [{depth}]
"""

FLOOR = """AttributeBegin
Material "diffuse" "rgb reflectance" [{grey} {grey} {grey}]
Shape "trianglemesh" "point3 P" [-40 0 -40  40 0 -40  40 0 40  -40 0 40] "integer indices" [0 2 1 0 3 2]
AttributeEnd
"""

LAMP = """AttributeBegin
Translate {x} {y} {z}
AreaLightSource "diffuse" "rgb L" [{l} {l} {l}]
Shape "sphere" "float radius" [{r}]
AttributeEnd
"""

SPHERE = """AttributeBegin
Translate {x} {y} {z}
{material}
Shape "sphere" "float radius" [{r}]
AttributeEnd
"""


def head(camera, fov, depth=5, lens="", w=64, h=48):
    return (f"LookAt {camera}\nCamera \"perspective\" \"float fov\" [{fov}] {lens}\n"
            + HEAD.format(w=w, h=h, depth=depth) + "WorldBegin\n")


def sphere(x, y, z, r, material):
    return SPHERE.format(x=x, y=y, z=z, r=r, material=material)


DIFFUSE = 'Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]'
GLASS = 'Material "dielectric" "float eta" [1.5]'
METAL = 'Material "conductor" "float roughness" [0.2]'
SKY = 'LightSource "infinite" "rgb L" [0.4 0.4 0.4]\n'


def caustic():
    """A glass ball under a lamp on a dark floor: bright specks on a small part of the picture."""
    return (head("0 4 -6  0 0.6 0  0 1 0", 40, 8) + LAMP.format(x=0, y=6, z=2, r=0.5, l=40)
            + FLOOR.format(grey=0.2) + sphere(0, 0.8, 0, 0.6, GLASS))


def lamp():
    """A lamp close to the ground at night: a pool of light."""
    return (head("0 5 -14  0 0 2  0 1 0", 50, 4) + LAMP.format(x=0, y=0.5, z=0, r=0.3, l=10)
            + FLOOR.format(grey=0.3) + sphere(1.2, 0.5, 0.4, 0.5, DIFFUSE))


def toy():
    """Blocks in front of a plain background that lights them."""
    blocks = ""
    for i in range(5):
        x = -1 + 0.5 * i
        blocks += sphere(x, 0.3 + 0.12 * (i % 3), 0.3 * (i % 2), 0.28, DIFFUSE if i % 2 else METAL)
    return head("0 1.2 -6  0 0.5 0  0 1 0", 40) + SKY + LAMP.format(x=3, y=5, z=-3, r=0.4, l=60) + blocks


def defocus():
    """Small bright balls, out of focus, in the dark."""
    text = head("0 0 -8  0 0 0  0 1 0", 40, 3, '"float lensradius" [0.3] "float focaldistance" [3]')
    for i in range(6):
        text += LAMP.format(x=-2.5 + i, y=((i * 7) % 5 - 2) * 0.7, z=i % 3, r=0.06, l=50)
    return text


def sky():
    """A ball on a ground under an even sky: soft shadows alone."""
    return head("0 2 -6  0 0.6 0  0 1 0", 40) + SKY + FLOOR.format(grey=0.5) + sphere(0, 0.8, 0, 0.8, DIFFUSE)


def glossy():
    """Metal balls on a dark floor under a lamp."""
    return (head("0 2 -6  0 0.6 0  0 1 0", 40) + LAMP.format(x=-2, y=4, z=-2, r=0.3, l=60) + FLOOR.format(grey=0.05)
            + sphere(-0.9, 0.7, 0, 0.7, METAL) + sphere(0.9, 0.7, 0.3, 0.7, DIFFUSE))


def room():
    """Inside a box, most of its light reflected."""
    walls = ""
    for points in ("-2 0 -2  2 0 -2  2 0 2  -2 0 2", "-2 3 -2  2 3 -2  2 3 2  -2 3 2", "-2 0 2  2 0 2  2 3 2  -2 3 2",
                   "-2 0 -2  -2 0 2  -2 3 2  -2 3 -2", "2 0 -2  2 0 2  2 3 2  2 3 -2", "-2 0 -2  2 0 -2  2 3 -2  -2 3 -2"):
        walls += ('Material "diffuse" "rgb reflectance" [0.7 0.65 0.6]\nShape "trianglemesh" "point3 P" ['
                  + points + '] "integer indices" [0 1 2 0 2 3]\n')
    return head("0 1.5 -1.9  0 1.3 0  0 1 0", 70, 8) + LAMP.format(x=0.8, y=2.6, z=0.5, r=0.15, l=40) + walls


def hall():
    """The same with glass and metal, and the lamp behind a ball."""
    return room() + sphere(0.8, 2.1, 0.5, 0.3, METAL) + sphere(-0.7, 0.6, 0.6, 0.6, GLASS)


SCENES = {f.__name__: f for f in (caustic, lamp, toy, defocus, sky, glossy, room, hall)}
