# SPDX-License-Identifier: Apache-2.0
"""The scenes of speed.py: each a file for Vitrail and one for Mitsuba 3. Those written here are Mitsuba's XML, which both read,
so that spheres are spheres to both; those of PBRT are handed to Mitsuba by `vitrail convert`."""
import math
import pathlib
import random
import re
import subprocess
import sys

import numpy as np

from plain_scene import plain_scene

ROOT = pathlib.Path(__file__).resolve().parents[2]
COLOURS = {"white": ".73 .73 .73", "red": ".6 .06 .05", "green": ".12 .45 .1", "black": "0 0 0"}


def rgb(name, value):
    return f'<rgb name="{name}" value="{value.replace(" ", ",")}"/>'


def scene(depth, size, body, eye="0,0,3.9", target="0,0,0", fov=39.3, integrator="path"):
    diffuse = "".join(f'<bsdf type="diffuse" id="{n}">{rgb("reflectance", c)}</bsdf>' for n, c in COLOURS.items())
    return (f'<scene version="3.0.0"><integrator type="{integrator}"><integer name="max_depth" value="{depth}"/></integrator>'
            f'<sensor type="perspective"><float name="fov" value="{fov}"/><transform name="to_world">'
            f'<lookat origin="{eye}" target="{target}" up="0,1,0"/></transform><film type="hdrfilm">'
            f'<integer name="width" value="{size}"/><integer name="height" value="{size}"/><rfilter type="box"/></film></sensor>'
            f'{diffuse}{body}</scene>')


def shape(kind, transform, material, more=""):
    bsdf = material if material.startswith("<") else f'<ref id="{material}"/>'
    return f'<shape type="{kind}"><transform name="to_world">{transform}</transform>{bsdf}{more}</shape>'


def lamp(radiance):
    return f'<emitter type="area">{rgb("radiance", radiance)}</emitter>'


def placed(x, y, z, scale, turn=""):
    return f'<scale value="{scale}"/>{turn}<translate x="{x}" y="{y}" z="{z}"/>'


def quad(x, y, z, half_x, half_z, turn, material, more=""):
    """Half the sides; it faces up before it is turned."""
    return shape("rectangle", f'<rotate x="1" angle="-90"/><scale x="{half_x}" y="1" z="{half_z}"/>{turn}'
                 f'<translate x="{x}" y="{y}" z="{z}"/>', material, more)


def walls(r=1, top=True):
    return (quad(0, -r, 0, r, r, "", "white") + quad(0, r, 0, r, r, '<rotate z="1" angle="180"/>', "white") * top
            + quad(0, 0, -r, r, r, '<rotate x="1" angle="90"/>', "white")
            + quad(-r, 0, 0, r, r, '<rotate z="1" angle="-90"/>', "red")
            + quad(r, 0, 0, r, r, '<rotate z="1" angle="90"/>', "green"))


def ceiling_lamp(radiance="18 14 7"):
    return quad(0, .99, 0, .23, .19, '<rotate z="1" angle="180"/>', "black", lamp(radiance))


def cube(x, y, z, sides, angle, material, more=""):
    return shape("cube", f'<scale x="{sides[0]}" y="{sides[1]}" z="{sides[2]}"/><rotate y="1" angle="{angle}"/>'
                 f'<translate x="{x}" y="{y}" z="{z}"/>', material, more)


def cornell_diffuse(folder, size):
    return scene(8, size, walls() + ceiling_lamp() + cube(.335, -.7, .38, (.3, .3, .3), -17, "white")
                 + cube(-.33, -.4, -.28, (.3, .6, .3), 18, "white"))


def cornell_spheres(folder, size):
    return scene(8, size, walls() + ceiling_lamp() + shape("sphere", placed(.45, -.65, .3, .35), '<bsdf type="dielectric"/>')
                 + shape("sphere", placed(-.4, -.65, -.3, .35), '<bsdf type="conductor"/>'))


def glass(folder, size):
    """Rough and smooth glass, seen and shadowed through each other."""
    rough = '<bsdf type="roughdielectric"><float name="alpha" value=".15"/></bsdf>'
    return scene(12, size, walls() + ceiling_lamp() + cube(.4, -.6, .3, (.3, .4, .1), -17, '<bsdf type="dielectric"/>')
                 + shape("sphere", placed(-.4, -.6, -.2, .4), rough))


def medium(folder, size):
    """A cube of fog without a surface."""
    fog = ('<medium type="homogeneous" name="interior"><float name="sigma_t" value="4"/>'
           '<spectrum name="albedo" value=".9"/></medium>')
    return scene(8, size, walls() + ceiling_lamp() + cube(0, -.3, 0, (.5, .5, .5), 20, '<bsdf type="null"/>', fog),
                 integrator="volpath")


def four_lamps(folder, size):
    """Four spheres of equal power, out of sight, over four plates of rough metal that mirror them, after Veach and Guibas (1995)."""
    eye, lamp_y, lamp_z = (2.2, 9), 3.4, -1.2  # y, z
    body = quad(0, -1, 0, 8, 8, "", "white") + quad(0, 6, -4, 8, 8, '<rotate x="1" angle="90"/>', "white")
    for radius, x in zip((.03, .1, .3, .9), (-2.4, -.9, .8, 2.6)):
        body += shape("sphere", placed(x, lamp_y, lamp_z, radius), "black", lamp(" ".join([f"{1.5 / radius ** 2:.6g}"] * 3)))
    for i, alpha in enumerate((.01, .04, .1, .25)):
        y, z = .55 - .4 * i, -1.2 + .95 * i
        ways = [(to_y - y, to_z - z) for to_y, to_z in (eye, (lamp_y, lamp_z))]
        half_y, half_z = (sum(c / math.hypot(*way) for c, way in zip(axis, ways)) for axis in zip(*ways))
        metal = f'<bsdf type="roughconductor"><string name="material" value="Cu"/><float name="alpha" value="{alpha}"/></bsdf>'
        tilt = math.degrees(math.atan2(half_z, half_y))
        body += quad(0, y, z, 3.6, .36, f'<rotate x="1" angle="{tilt:.4g}"/>', metal)
    return scene(5, size, body, eye=f"0,{eye[0]},{eye[1]}", target="0,-.3,0", fov=30)


def bumpy_sphere(path, rings=250):
    """4·rings·(rings − 1) triangles: a sphere whose radius ripples."""
    sectors = 2 * rings
    theta, phi = np.meshgrid(math.pi * np.arange(rings + 1) / rings, 2 * math.pi * np.arange(sectors) / sectors, indexing="ij")
    r = 1 + .04 * np.sin(23 * theta) * np.sin(31 * phi)
    points = np.stack([r * np.sin(theta) * np.cos(phi), r * np.sin(theta) * np.sin(phi), r * np.cos(theta)], -1)
    i, j = np.meshgrid(np.arange(rings), np.arange(sectors), indexing="ij")
    a, b = i * sectors + j, i * sectors + (j + 1) % sectors
    upper = np.stack([a, a + sectors, b], -1)[1:].reshape(-1, 3)
    lower = np.stack([b, a + sectors, b + sectors], -1)[:-1].reshape(-1, 3)
    faces = np.concatenate([upper, lower])
    rows = np.zeros(len(faces), dtype=[("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, faces
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {points[..., 0].size}\nproperty float x\nproperty float y\n"
            f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")
    path.write_bytes(head.encode() + points.astype("<f4").tobytes() + rows.tobytes())


def million_room(folder, size, lamps=100):
    """Four spheres of 249,000 triangles and a hundred lamps of unlike power."""
    bumpy_sphere(folder / "bumpy.ply")
    body = walls()
    for x, y, z in ((-.5, -.55, -.5), (.5, -.55, -.4), (-.45, .35, -.4), (.45, .3, .2)):
        body += shape("ply", placed(x, y, z, .42), "white", '<string name="filename" value="bumpy.ply"/>')
    rng = random.Random(1)
    for _ in range(lamps):
        brightness = 40 * rng.random() ** 4
        body += quad(rng.uniform(-.95, .95), .99, rng.uniform(-.95, .95), .02, .02, '<rotate z="1" angle="180"/>', "black",
                     lamp(" ".join(f"{brightness * rng.uniform(.5, 1):.4g}" for _ in range(3))))
    return scene(6, size, body)


def converted(bin_folder, source, folder, name):
    out = folder / f"{name}-converted" / f"{name}.xml"
    out.parent.mkdir(exist_ok=True)
    subprocess.run([str(bin_folder / "vitrail-convert"), str(source), str(out), "--quiet"], check=True)
    return out


def pbrt_scene(bin_folder, source, folder, name, size):
    """Square pictures of that size: a text in place of `source`, what lies beside it through links."""
    text = source.read_text()
    for axis in "xy":
        text = re.sub(rf'"integer {axis}resolution"\s*(\[\s*\d+\s*\]|\d+)', f'"integer {axis}resolution" [{size}]', text)
    mine = folder / f"{name}-{size}"
    mine.mkdir(exist_ok=True)
    for beside in source.resolve().parent.iterdir():
        if beside.name != source.name and not (mine / beside.name).exists():
            (mine / beside.name).symlink_to(beside)
    (mine / source.name).write_text(text)
    return mine / source.name, converted(bin_folder, mine / source.name, folder, name)


def of_pbrt(name):
    def make(bin_folder, folder, corpus, size):
        return pbrt_scene(bin_folder, corpus / name, folder, pathlib.Path(name).stem, size)
    return make


def hotel_room(bin_folder, folder, corpus, size):
    subprocess.run([sys.executable, str(ROOT / "examples/hotel-room/generate.py"), "-o", str(folder / "hotel"), "--detail", ".3"],
                   check=True, stdout=subprocess.DEVNULL)
    return pbrt_scene(bin_folder, folder / "hotel/hotel-room.pbrt", folder, "hotel-room", size)


def city(bin_folder, folder, corpus, size):
    """Every triangle in a mesh: where trees and cars are instances, llvm_ad_spectral takes 45 s a picture, whatever its samples."""
    subprocess.run([sys.executable, str(ROOT / "examples/city/generate.py"), "-o", str(folder / "city"), "--trees", "flattened"],
                   check=True, stdout=subprocess.DEVNULL)
    return pbrt_scene(bin_folder, folder / "city/city.pbrt", folder, "city-million", size)


def veach_plates(bin_folder, folder, corpus, size):
    """The geometry and the lamps of Nori's version of Veach's scene (1997, fig. 9.2); its spheres are spheres."""
    meshes = corpus / "nori/pa5/veach_mi/meshes"
    if not meshes.is_dir():
        raise FileNotFoundError(meshes)
    lamps = ((.1, -1.25, 0, 0, 100), (.03333, -3.75, 0, 0, 901.803), (.3, 1.25, 0, 0, 11.1111), (.9, 3.75, 0, 0, 1.23457), (1, 0, 4, 3, 100))
    body = "".join(shape("sphere", placed(x, y, z, radius), "black", lamp(f"{radiance} {radiance} {radiance}"))
                   for radius, x, y, z, radiance in lamps)
    surfaces = [(f"plate{i + 1}", f'<bsdf type="roughplastic"><float name="alpha" value="{alpha}"/>'
                 f'{rgb("diffuse_reflectance", ".0175 .0225 .0325")}</bsdf>') for i, alpha in enumerate((.005, .02, .05, .1))]
    for name, bsdf in [*surfaces, ("floor", f'<bsdf type="diffuse">{rgb("reflectance", ".1 .1 .1")}</bsdf>')]:
        body += shape("obj", "", bsdf, f'<string name="filename" value="{(meshes / name).resolve()}.obj"/>')
    file = folder / "veach.xml"
    file.write_text(scene(6, size, body, eye="0,6,27.5", target="0,-1.5,2.5", fov=25))
    return file, file


def of_mitsuba(name):
    def make(bin_folder, folder, corpus, size):
        source = corpus / "mitsuba-data" / name
        plain_scene(source, folder / source.name, size)
        return folder / source.name, folder / source.name
    return make


def of_old_mitsuba(name):
    """Of a version that Mitsuba 3 does not read: both get what `vitrail convert` makes of it."""
    def make(bin_folder, folder, corpus, size):
        new = converted(bin_folder, corpus / name, folder, pathlib.Path(name).stem)
        file = new.with_name("plain.xml")
        plain_scene(new, file, size)
        return file, file
    return make


def written(make_text):
    def make(bin_folder, folder, corpus, size):
        file = folder / f"{make_text.__name__}.xml"
        file.write_text(make_text(folder, size))
        return file, file
    return make


def of_file(source):
    """A scene from elsewhere."""
    def make(bin_folder, folder, corpus, size):
        if source.suffix == ".pbrt":
            return pbrt_scene(bin_folder, source, folder, source.stem, size)
        plain_scene(source, folder / source.name, size)
        return folder / source.name, folder / source.name
    return make


# Name → (bin folder, folder, corpus, size) → (file for Vitrail, file for Mitsuba)
SCENES = {
    "arealight": of_mitsuba("tests/scenes/bsdf_spheres/test_arealight_path.xml"),
    "envmap": of_mitsuba("tests/scenes/bsdf_spheres/test_envmap_path.xml"),
    "various shapes": of_mitsuba("tests/scenes/various_shapes/test_various_shapes_path.xml"),
    "box, diffuse": written(cornell_diffuse),
    "box, spheres": written(cornell_spheres),
    "cbox of Mitsuba": of_mitsuba("scenes/cbox/cbox-spectral.xml"),
    "Cornell of Tungsten": of_pbrt("pbrt/cornell-box/scene.pbrt"),
    "glass": written(glass),
    "medium": written(medium),
    "four lamps": written(four_lamps),
    "Veach's plates": veach_plates,
    "10⁶ triangles, 100 lamps": written(million_room),
    "killeroo-simple": of_pbrt("pbrt/killeroo-simple/killeroo-simple.pbrt"),
    "classroom, textured": of_old_mitsuba("real/classroom/scene.xml"),
    "bathroom, textured": of_pbrt("real/bathroom2/bathroom2.pbrt"),
    "hotel room": hotel_room,
    "city, 10⁶ triangles": city,
}
# Those that cycles_timing.py can build.
FOR_CYCLES = ("box, diffuse", "box, spheres", "10⁶ triangles, 100 lamps")
# Those that one would like beside them, and that the corpus has not: --also takes them.
ELSEWHERE = ("lego, 2 million triangles", "staircase", "dining-room", "killeroo-gold", "crown")
