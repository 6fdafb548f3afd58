# SPDX-License-Identifier: Apache-2.0
"""The scenes of growth.py: a kind of data each, of a size that is asked for. A generator writes `scene` and the files beside it into
a folder and returns the scene's path. What rays meet is alike at every size: the same surfaces in finer parts, the same light from
more lamps, the same cloud on a finer grid."""
import math
import struct
import zlib

import numpy as np

CAMERA = "LookAt 0 -4 2  0 0 .3  0 0 1"
SKY = 'LightSource "infinite" "rgb L" [.6 .7 .9]'
LAMP = 'LightSource "point" "rgb I" [9 9 8] "point3 from" [2 -3 4]'
FLOOR = ('Material "diffuse" "rgb reflectance" [.4 .4 .4]\nShape "trianglemesh" "point3 P" [-9 -9 0 9 -9 0 9 9 0 -9 9 0] '
         '"integer indices" [0 1 2 0 2 3]')
SQUARE = '"integer indices" [0 1 2 0 2 3] "point2 uv" [0 0 1 0 1 1 0 1]'
WIDE = '"point3 P" [-3 -3 .01 3 -3 .01 3 3 .01 -3 3 .01] ' + SQUARE


def numbers(values):
    return " ".join(f"{v:.6g}" for v in np.asarray(values, dtype=float).ravel())


def write(folder, body, integrator="path", depth=5, light=SKY, name="scene.pbrt"):
    file = folder / name
    file.write_text(f'{CAMERA}\nCamera "perspective" "float fov" 45\nFilm "rgb" "integer xresolution" 64 "integer yresolution" 36\n'
                    f'PixelFilter "box"\nIntegrator "{integrator}" "integer maxdepth" {depth}\nWorldBegin\n{light}\n'
                    + (body if isinstance(body, str) else "\n".join(body)) + "\n")
    return file


def write_png(file, pixels):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    height, width = pixels.shape[:2]
    rows = np.concatenate([np.zeros((height, 1), np.uint8), pixels.reshape(height, -1)], axis=1)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                     chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)) + chunk(b"IEND", b""))


def write_ply(file, vertices, triangles):
    faces = np.zeros(len(triangles), dtype=[("n", "u1"), ("i", "<i4", 3)])
    faces["n"], faces["i"] = 3, triangles
    file.write_bytes(f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\n"
                     f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n".encode()
                     + vertices.astype("<f4").tobytes() + faces.tobytes())


def side_of(cells):
    return round(cells ** (1 / 3))


# Grids

def cloud(n):
    """1 in the middle, 0 at the border, of n³ cells; [z][y][x]."""
    z = np.linspace(-1, 1, n)
    return np.maximum(0, 1 - np.sqrt(z[:, None, None] ** 2 + z[None, :, None] ** 2 + z[None, None, :] ** 2))


def medium(folder, n, parameters, kind="uniformgrid"):
    return write(folder, f'MakeNamedMedium "m" "string type" "{kind}" "integer nx" {n} "integer ny" {n} "integer nz" {n} '
                         f'"point3 p0" [-1 -1 -1] "point3 p1" [1 1 1] {parameters}\n'
                         'Material "interface"\nMediumInterface "m" ""\nShape "sphere" "float radius" 1.7', "volpath", 20)


def density(folder, cells):
    n = side_of(cells)
    return medium(folder, n, f'"rgb sigma_s" [3 3 3] "rgb sigma_a" [.5 .5 .5] "float density" [{numbers(cloud(n))}]')


def emission(folder, cells):
    n = side_of(cells)
    grid = numbers(cloud(n))
    return medium(folder, n, f'"rgb sigma_s" [1 1 1] "rgb sigma_a" [1 1 1] "float density" [{grid}] "rgb Le" [1 1 1] '
                             f'"float Lescale" [{grid}]')


def temperature(folder, cells):
    n = side_of(cells)
    return medium(folder, n, f'"rgb sigma_s" [1 1 1] "rgb sigma_a" [1 1 1] "float density" [{numbers(cloud(n))}] '
                             f'"float temperature" [{numbers(1500 + 2000 * cloud(n))}]')


def coloured(folder, cells):
    n = side_of(cells)
    each = cloud(n)[..., None]
    return medium(folder, n, f'"rgb sigma_s" [{numbers(each * [3, 2.5, 2])}] "rgb sigma_a" [{numbers(each * [.2, .3, .5])}]', "rgbgrid")


def write_volume(file, grid):
    n = len(grid)
    file.write_bytes(b"VOL\x03" + struct.pack("<iiiii6f", 1, n, n, n, 1, -1, -1, -1, 1, 1, 1) + grid.astype("<f4").tobytes())


def heterogeneous(folder, cells, varies):
    n = side_of(cells)
    write_volume(folder / "grid.vol", cloud(n) if varies == "sigma_t" else .5 + .4 * cloud(n))
    box = '<transform name="to_world"><scale value="2"/><translate x="-1" y="-1" z="-1"/></transform>'
    grid = f'<volume name="{varies}" type="gridvolume"><string name="filename" value="grid.vol"/>{box}</volume>'
    other = '<rgb name="albedo" value=".9,.9,.9"/>' if varies == "sigma_t" else '<float name="sigma_t" value=".3"/>'
    file = folder / "scene.xml"
    file.write_text('<scene version="3.0.0"><integrator type="volpath"><integer name="max_depth" value="20"/></integrator>'
                    '<sensor type="perspective"><float name="fov" value="45"/><transform name="to_world">'
                    '<lookat origin="0,-4,2" target="0,0,.3" up="0,0,1"/></transform><film type="hdrfilm"><integer name="width" '
                    'value="64"/><integer name="height" value="36"/></film></sensor><emitter type="constant"/><shape type="cube">'
                    '<bsdf type="null"/><medium name="interior" type="heterogeneous"><float name="scale" value="3"/>'
                    f'{grid}{other}</medium></shape></scene>')
    return file


# Images and tables

def texels(pixels):
    n = round(math.sqrt(pixels))
    return np.random.default_rng(1).integers(40, 216, (n, n, 3), dtype=np.uint8)


def image(folder, pixels, filter_name):
    write_png(folder / "image.png", texels(pixels))
    return write(folder, f'Texture "t" "spectrum" "imagemap" "string filename" "image.png" "string filter" "{filter_name}"\n'
                         f'Material "diffuse" "texture reflectance" "t"\nShape "trianglemesh" {WIDE}')


def sky_image(folder, pixels):
    write_png(folder / "sky.png", texels(pixels))
    return write(folder, FLOOR, light='LightSource "infinite" "string filename" "sky.png"')


def goniometric(folder, pixels):
    write_png(folder / "lamp.png", texels(pixels))
    return write(folder, FLOOR, light='Translate 0 0 2\nLightSource "goniometric" "string filename" "lamp.png" "rgb I" [9 9 9]\n'
                                      'Translate 0 0 -2')


def measured_values(samples, low, high):
    wavelengths = np.linspace(360, 830, samples)
    values = low + (high - low) * (.5 + .5 * np.sin(wavelengths / 20))
    return numbers(np.stack([wavelengths, values], 1)) if samples < 2000 else " ".join(
        f"{w:.9g} {v:.4g}" for w, v in zip(wavelengths, values))


def spectra(folder, samples):
    return write(folder, [f'Material "diffuse" "spectrum reflectance" [{measured_values(samples, .2, .8)}]',
                          f'Shape "trianglemesh" {WIDE}'],
                 light=f'LightSource "infinite" "spectrum L" [{measured_values(samples, .5, 1)}]')


def write_tensors(file, tensors):
    types = {np.dtype(np.uint8): 1, np.dtype(np.float32): 10}
    names = [name.encode() for name in tensors]
    at = 18 + sum(2 + len(name) + 11 + 8 * t.ndim for name, t in zip(names, tensors.values()))
    head, body = b"tensor_file\0\1\0" + struct.pack("<I", len(tensors)), b""
    for name, t in zip(names, tensors.values()):
        head += struct.pack("<H", len(name)) + name + struct.pack("<HBQ", t.ndim, types[t.dtype], at + len(body))
        head += struct.pack(f"<{t.ndim}Q", *t.shape)
        body += t.tobytes()
    file.write_bytes(head + body)


def measured(folder, values):
    """Isotropic: 8 incidences, 64 values a square at × 1, and half as many wavelengths as its side has."""
    side = max(4, round((values / 8) ** (1 / 3) * 1.26))
    waves, incidences = max(2, side // 2), 8
    random = np.random.default_rng(2)
    table = lambda *shape: random.uniform(.4, .6, shape).astype(np.float32)
    write_tensors(folder / "table.bsdf", {
        "description": np.frombuffer(b"of numbers", np.uint8), "phi_i": np.zeros(1, np.float32),
        "theta_i": np.linspace(0, 1.5, incidences, dtype=np.float32), "wavelengths": np.linspace(360, 830, waves, dtype=np.float32),
        "ndf": table(side, side), "sigma": table(side, side), "vndf": table(1, incidences, side, side),
        "luminance": table(1, incidences, side, side), "spectra": table(1, incidences, waves, side, side),
        "jacobian": np.ones(1, np.uint8)})
    return write(folder, f'Material "measured" "string filename" "table.bsdf"\nShape "trianglemesh" {WIDE}')


def fourier(folder, pairs):
    nodes, orders = 2 * round(math.sqrt(pairs) / 2), 6
    mu = np.sort(np.concatenate([-np.linspace(.01, 1, nodes // 2), np.linspace(.01, 1, nodes // 2)])).astype("<f4")
    cosines = np.abs(mu)[None, :, None] * np.ones((nodes, nodes, 1))
    coefficients = (cosines * .1 / (1 + np.arange(orders)) ** 2).astype("<f4")
    places = np.stack([np.arange(nodes * nodes) * orders, np.full(nodes * nodes, orders)], 1).astype("<i4")
    header = b"SCATFUN\x01" + struct.pack("<9if4i", 1, nodes, coefficients.size, orders, 1, 1, 0, 0, 0, 1., 0, 0, 0, 0)
    (folder / "table.bsdf").write_bytes(header[:64] + mu.tobytes() + bytes(4 * nodes * nodes) + places.tobytes() + coefficients.tobytes())
    (folder / "scene.pbrt").write_text(
        f'{CAMERA}\nCamera "perspective" "float fov" 45\nFilm "image" "integer xresolution" 64 "integer yresolution" 36\n'
        f'Integrator "path" "integer maxdepth" 5\nWorldBegin\n{SKY}\nMaterial "fourier" "string bsdffile" "table.bsdf"\n'
        f'Shape "trianglemesh" "point P" [-3 -3 .01 3 -3 .01 3 3 .01 -3 3 .01] "integer indices" [0 1 2 0 2 3]\nWorldEnd\n')
    return folder / "scene.pbrt"


# Lamps

def places(count, seed=3):
    """Of `count` things over the floor, all over a square of 6 × 6 and from .5 to 1.5 above it."""
    return np.random.default_rng(seed).uniform([-3, -3, .5], [3, 3, 1.5], (count, 3))


def points(folder, count):
    return write(folder, FLOOR, light="\n".join(f'LightSource "point" "rgb I" [{8 / count:.4g} {7 / count:.4g} {5 / count:.4g}] '
                                                f'"point3 from" [{numbers(p)}]' for p in places(count)))


def spots(folder, count):
    return write(folder, FLOOR, light="\n".join(f'LightSource "spot" "rgb I" [{90 / count:.4g} {70 / count:.4g} {50 / count:.4g}] '
                                                f'"float coneangle" 50 "point3 from" [{numbers(p)}] "point3 to" [{numbers(p * [1, 1, 0])}]'
                                                for p in places(count)))


def distant(folder, count):
    random = np.random.default_rng(4).normal(size=(count, 3))
    return write(folder, FLOOR, light="\n".join(f'LightSource "distant" "rgb L" [{3 / count:.4g} {3 / count:.4g} {2 / count:.4g}] '
                                                f'"point3 from" [{numbers([d[0], d[1], 1 + abs(d[2])])}]' for d in random))


def lamp_triangles(folder, count):
    corners = places(count)[:, None, :] + np.random.default_rng(5).normal(size=(count, 3, 3)) * .3 / math.sqrt(count)
    write_ply(folder / "lamps.ply", corners.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3))
    return write(folder, [FLOOR, 'AreaLightSource "diffuse" "rgb L" [40 30 20] "bool twosided" true',
                          'Shape "plymesh" "string filename" "lamps.ply"'], light="")


def lamp_spheres(folder, count):
    return write(folder, [FLOOR, 'AreaLightSource "diffuse" "rgb L" [40 30 20]',
                          *(f'AttributeBegin\nTranslate {numbers(p)}\nShape "sphere" "float radius" {.15 / math.sqrt(count):.4g}\n'
                            'AttributeEnd' for p in places(count))], light="")


# Shapes

def terrain(n, seed=0):
    """Hills over 6 × 6 in 2·n² triangles."""
    x = np.linspace(-3, 3, n + 1)
    grid = np.stack(np.meshgrid(x, x, indexing="ij"), -1).reshape(-1, 2)
    height = .3 + .15 * np.sin(3 * grid[:, 0] + seed) * np.sin(4 * grid[:, 1])
    i, j = (a.ravel() for a in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    a = i * (n + 1) + j
    return np.c_[grid, height], np.concatenate([np.stack([a, a + n + 1, a + 1], 1), np.stack([a + 1, a + n + 1, a + n + 2], 1)])


def triangles(folder, count):
    write_ply(folder / "hills.ply", *terrain(round(math.sqrt(count / 2))))
    return write(folder, 'Material "diffuse" "rgb reflectance" [.6 .6 .6]\nShape "plymesh" "string filename" "hills.ply"')


def standing(count, seed=6):
    """Where `count` things stand, in rows over 6 × 6, and how far apart they are."""
    side = math.ceil(math.sqrt(count))
    apart = 6 / side
    k = np.arange(count)
    jitter = np.random.default_rng(seed).uniform(-.2, .2, (count, 2))
    return (np.stack([k % side, k // side], 1) - side / 2 + .5 + jitter) * apart, apart


def curves(folder, count):
    """Hairs as far apart as they are wide for their number, each bent once; of two thirds of what there is to see."""
    feet, apart = standing(count)
    body = ['Material "diffuse" "rgb reflectance" [.6 .5 .4]']
    for (x, y), bend in zip(feet, np.random.default_rng(7).uniform(-1, 1, (count, 2)) * apart):
        top = 3 * apart
        body.append(f'Shape "curve" "string type" "cylinder" "float width" {.3 * apart:.4g} "point3 P" '
                    f'[{x:.5f} {y:.5f} 0 {x:.5f} {y:.5f} {top / 3:.4f} {x + bend[0]:.5f} {y + bend[1]:.5f} {top * 2 / 3:.4f} '
                    f'{x + 2 * bend[0]:.5f} {y + 2 * bend[1]:.5f} {top:.4f}]')
    return write(folder, [FLOOR, *body])


def spheres(folder, count, material=lambda k: 'Material "diffuse" "rgb reflectance" [.6 .5 .4]' if k == 0 else ""):
    feet, apart = standing(count)
    body = [FLOOR]
    for k, (x, y) in enumerate(feet):
        body.append(f'{material(k)}\nAttributeBegin\nTranslate {x:.5f} {y:.5f} {apart * .4:.5f}\n'
                    f'Shape "sphere" "float radius" {apart * .4:.5f}\nAttributeEnd')
    return write(folder, body)


def instances(folder, count):
    feet, apart = standing(count)
    write_ply(folder / "tile.ply", *terrain(8))
    return write(folder, ['ObjectBegin "o"', 'Material "diffuse" "rgb reflectance" [.6 .6 .6]',
                          'Shape "plymesh" "string filename" "tile.ply"', "ObjectEnd",
                          *(f'AttributeBegin\nTranslate {x:.5f} {y:.5f} 0\nScale {apart / 6:.5g} {apart / 6:.5g} {apart / 6:.5g}\n'
                            'ObjectInstance "o"\nAttributeEnd' for x, y in feet)])


def prototypes(folder, count):
    feet, apart = standing(count)
    body = []
    for k, (x, y) in enumerate(feet):
        v, t = terrain(4, seed=k)
        mesh = f'Shape "trianglemesh" "point3 P" [{numbers(v)}] "integer indices" [{numbers(t)}]'
        body.append(f'ObjectBegin "{k}"\n{mesh}\nObjectEnd')
        for turn in 0, 90:
            body.append(f'AttributeBegin\nTranslate {x:.5f} {y:.5f} 0\nRotate {turn} 0 0 1\n'
                        f'Scale {apart / 12:.5g} {apart / 12:.5g} {apart / 12:.5g}\nObjectInstance "{k}"\nAttributeEnd')
    return write(folder, ['Material "diffuse" "rgb reflectance" [.6 .6 .6]', *body])


# Appearance

def of_three(k):
    r, g, b = np.random.default_rng(k).uniform(.2, .8, 3)
    return [f'Material "diffuse" "rgb reflectance" [{r:.3f} {g:.3f} {b:.3f}]',
            f'Material "conductor" "rgb reflectance" [{r:.3f} {g:.3f} {b:.3f}] "float roughness" .2',
            f'Material "coateddiffuse" "rgb reflectance" [{r:.3f} {g:.3f} {b:.3f}] "float roughness" .1'][k % 3]


def materials(folder, count):
    return spheres(folder, count, of_three)


def textures(folder, count):
    def checks(k):
        return (f'Texture "t{k}" "spectrum" "checkerboard" "float uscale" 4 "float vscale" 4 "rgb tex1" [.{k % 9}5 .2 .3] "rgb tex2" [.6 .5 .4]\n'
                f'Material "diffuse" "texture reflectance" "t{k}"')
    return spheres(folder, count, checks)


def media(folder, count):
    def filled(k):
        return (f'MakeNamedMedium "m{k}" "string type" "homogeneous" "rgb sigma_a" [.{k % 9}5 .2 .3] "rgb sigma_s" [1 1 1]\n'
                f'MediumInterface "m{k}" ""\nMaterial "interface"')
    file = spheres(folder, count, filled)
    file.write_text(file.read_text().replace('Integrator "path"', 'Integrator "volpath"'))
    return file


def coats(folder, count):
    """A mixture of mixtures: `count` materials on one surface, in a tree."""
    body = [f'MakeNamedMaterial "m{k}" "string type" "diffuse" "rgb reflectance" [.{k % 8 + 1} .4 .5]' for k in range(count)]
    names = [f"m{k}" for k in range(count)]
    while len(names) > 1:
        pairs = list(zip(names[::2], names[1::2]))
        body += [f'MakeNamedMaterial "{a}{b}" "string type" "mix" "string materials" ["{a}" "{b}"] "float amount" .5' for a, b in pairs]
        names = [a + b for a, b in pairs] + names[len(names) // 2 * 2:]
    return write(folder, [*body, f'NamedMaterial "{names[0]}"\nShape "trianglemesh" {WIDE}'])


def layers(folder, count):
    """`count` coats one on the other: each is a varnish that lets half of what is below be seen."""
    body = ['MakeNamedMaterial "l0" "string type" "diffuse" "rgb reflectance" [.4 .4 .5]']
    for k in range(1, count):
        kind = ("coateddiffuse", "conductor", "diffuse")[k % 3]
        body += [f'MakeNamedMaterial "c{k}" "string type" "{kind}" "rgb reflectance" [.{k % 8 + 1} .4 .5]',
                 f'MakeNamedMaterial "l{k}" "string type" "mix" "string materials" ["l{k - 1}" "c{k}"] "float amount" .5']
    return write(folder, [*body, f'NamedMaterial "l{count - 1}"\nShape "trianglemesh" {WIDE}'])


def named_spheres(folder, count):
    """For layers that tell shapes apart."""
    return spheres(folder, count)


def room(folder, _=0):
    """Half closed, with a lamp: where photons go."""
    wall = '"point3 P" [-3 3 0 3 3 0 3 3 3 -3 3 3] ' + SQUARE
    return write(folder, f'{FLOOR}\nShape "trianglemesh" {WIDE}\nShape "trianglemesh" {wall}', light=LAMP)
