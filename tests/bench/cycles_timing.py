#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One process of Cycles, as PyPI's `bpy`, that renders one scene of speed_scenes.py again and again, in one thread of the CPU.

cycles_timing.py SCENE.xml

SCENE.xml is Mitsuba's format, of which it takes what those scenes have: rectangles, cubes, spheres and PLY; diffuse surfaces, smooth
glass and mirrors; rectangles that shine, which become Cycles' area lights; a perspective camera without a turn. Spheres are meshes of
131,000 triangles with smooth normals: Cycles has no others. What Cycles does by default is left as it is, but for what would solve
another problem: denoiser off; no clamp, no blur of caustics; a box filter and the bounces of the scene.

Speaks as mitsuba_timing.py does: reads lines "WAY SPP SEED OUT.exr", WAY being `adaptive`, its default, or `uniform`; writes the
picture, linear sRGB, and prints the seconds of processors; before the first line those that it took to start.
"""
import contextlib
import io
import math
import os
import pathlib
import sys
import time
import xml.etree.ElementTree as xml

import bpy
import numpy as np
from mathutils import Matrix, Vector

REFUSED = 3  # exit status: the scene has what this cannot hand over


def refuse(what):
    print(f"cannot hand {what} to Cycles", file=sys.stderr)
    sys.exit(REFUSED)


def numbers(text):
    values = [float(v) for v in text.replace(",", " ").split()]
    return values * 3 if len(values) == 1 else values


def attribute(node, name, otherwise):
    found = node.find(f"*[@name='{name}']")
    return otherwise if found is None else found.get("value")


def transform_of(node):
    matrix = Matrix.Identity(4)
    for step in node.find("transform"):
        part = lambda axis, usual: float(step.get(axis, step.get("value", usual)))
        if step.tag == "scale":
            values = numbers(step.get("value")) if step.get("value") else [part(axis, 1) for axis in "xyz"]
            matrix = Matrix.Diagonal([*values, 1]) @ matrix
        elif step.tag == "translate":
            matrix = Matrix.Translation([float(step.get(axis, 0)) for axis in "xyz"]) @ matrix
        elif step.tag == "rotate":
            axis = Vector([float(step.get(axis, 0)) for axis in "xyz"])
            matrix = Matrix.Rotation(math.radians(float(step.get("angle"))), 4, axis) @ matrix
        else:
            refuse(f"a <{step.tag}>")
    return matrix


def material_of(node):
    material = bpy.data.materials.new(node.get("id") or node.get("type"))
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    nodes.clear()
    kind = node.get("type")
    if kind == "diffuse":
        surface = nodes.new("ShaderNodeBsdfDiffuse")
        surface.inputs["Color"].default_value = (*numbers(attribute(node, "reflectance", ".5")), 1)
    elif kind == "dielectric":
        surface = nodes.new("ShaderNodeBsdfGlass")
        surface.inputs["Color"].default_value = (1, 1, 1, 1)
        surface.inputs["Roughness"].default_value = 0
        surface.inputs["IOR"].default_value = float(attribute(node, "int_ior", 1.5046))
    elif kind == "conductor" and node.find("*") is None:
        surface = nodes.new("ShaderNodeBsdfGlossy")
        surface.inputs["Color"].default_value = (1, 1, 1, 1)
        surface.inputs["Roughness"].default_value = 0
    else:
        refuse(f"a bsdf {kind}")
    links.new(surface.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return material


def mesh_of(points, faces, smooth):
    mesh = bpy.data.meshes.new("mesh")
    faces = np.asarray(faces, dtype=np.int32)
    count, corners = faces.shape
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", np.asarray(points, dtype=np.float32).ravel())
    mesh.loops.add(count * corners)
    mesh.loops.foreach_set("vertex_index", faces.ravel())
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, count * corners, corners, dtype=np.int32))
    mesh.polygons.foreach_set("use_smooth", np.full(count, smooth))
    mesh.update(calc_edges=True)
    return mesh


def rectangle():
    return mesh_of([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2, 3)], False)


def cube():
    points = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    return mesh_of(points, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)], False)


def sphere(rings=256):
    sectors = rings
    theta, phi = np.meshgrid(math.pi * np.arange(rings + 1) / rings, 2 * math.pi * np.arange(sectors) / sectors, indexing="ij")
    points = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(rings), np.arange(sectors), indexing="ij")
    a, b = i * sectors + j, i * sectors + (j + 1) % sectors
    return mesh_of(points, np.concatenate([np.stack([a, a + sectors, b], -1)[1:].reshape(-1, 3),
                                           np.stack([b, a + sectors, b + sectors], -1)[:-1].reshape(-1, 3)]), True)


def ply(file):
    """As speed_scenes.bumpy_sphere writes it: points of three floats, triangles."""
    head, body = file.read_bytes().split(b"end_header\n", 1)
    count = lambda element: int(head.split(b"element " + element + b" ")[1].split()[0])
    points = np.frombuffer(body, "<f4", 3 * count(b"vertex")).reshape(-1, 3)
    rows = np.frombuffer(body, [("n", "u1"), ("v", "<i4", 3)], count(b"face"), points.nbytes)
    return mesh_of(points, rows["v"], False)


def add(data, matrix, material=None):
    made = bpy.data.objects.new("object", data)
    made.matrix_world = matrix
    if material:
        made.active_material = material
    bpy.context.scene.collection.objects.link(made)
    return made


def add_lamp(matrix, emitter):
    """A rectangle that shines where its z points; an area light does where its −z points. Its power is that of a surface of two
    metres' sides, scaled: π·area·radiance watts."""
    radiance = numbers(attribute(emitter, "radiance", "1"))
    matrix = matrix @ Matrix.Rotation(math.pi, 4, "X")
    place, turn, scale = matrix.decompose()
    light = bpy.data.lights.new("lamp", "AREA")
    light.shape, light.size, light.size_y = "RECTANGLE", 2 * abs(scale.x), 2 * abs(scale.y)
    most = max(*radiance, 1e-9)
    light.color = [r / most for r in radiance]
    light.energy = most * math.pi * light.size * light.size_y
    add(light, Matrix.LocRotScale(place, turn, None)).visible_camera = True


def add_shape(node, folder, materials, meshes):
    matrix, kind, emitter = transform_of(node), node.get("type"), node.find("emitter")
    if emitter is not None:
        if kind != "rectangle":
            refuse(f"a {kind} that shines")
        return add_lamp(matrix, emitter)
    if node.find("medium") is not None:
        refuse("a medium")
    name = kind if kind != "ply" else attribute(node, "filename", "")
    if name not in meshes:
        makers = {"rectangle": rectangle, "cube": cube, "sphere": sphere, "ply": lambda: ply(folder / name)}
        if kind not in makers:
            refuse(f"a shape {kind}")
        meshes[name] = makers[kind]()
    mesh, bsdf = meshes[name], node.find("bsdf")
    material = materials[node.find("ref").get("id")] if bsdf is None else material_of(bsdf)
    if mesh.materials and mesh.materials[0] != material:
        mesh = mesh.copy()
        mesh.materials.clear()
    if not mesh.materials:
        mesh.materials.append(material)
    add(mesh, matrix)


def set_camera(sensor):
    look = sensor.find("transform/lookat")
    origin, target = (Vector(numbers(look.get(name))) for name in ("origin", "target"))
    camera = bpy.data.cameras.new("camera")
    camera.angle = math.radians(float(attribute(sensor, "fov", 0)))
    camera.clip_end = 1e4
    made = bpy.data.objects.new("camera", camera)
    back = (origin - target).normalized()
    right = Vector(numbers(look.get("up"))).cross(back).normalized()
    turn = Matrix([right, back.cross(right), back]).transposed()
    made.matrix_world = Matrix.Translation(origin) @ turn.to_4x4()
    bpy.context.scene.collection.objects.link(made)
    bpy.context.scene.camera = made


def set_up(root):
    scene = bpy.context.scene
    film = root.find("sensor/film")
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = (int(attribute(film, side, 0)) for side in ("width", "height"))
    scene.render.resolution_percentage = 100
    scene.render.threads_mode, scene.render.threads = "FIXED", 1
    scene.render.use_persistent_data = True
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.use_file_extension = False
    scene.world = bpy.data.worlds.new("black")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.blur_glossy = 0
    cycles.pixel_filter_type = "BOX"
    # Mitsuba counts edges, the last of which a lamp's light takes to the camera; Cycles what scatters before that light.
    bounces = int(attribute(root.find("integrator"), "max_depth", 8)) - 2
    for name in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces"):
        setattr(cycles, name, bounces)


def main():
    file = pathlib.Path(sys.argv[1])
    speech = os.dup(1)  # Blender talks on standard output
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
    say = lambda number: os.write(speech, f"{number}\n".encode())
    bpy.ops.wm.read_factory_settings(use_empty=True)
    root = xml.parse(file).getroot()
    set_up(root)
    set_camera(root.find("sensor"))
    materials = {node.get("id"): material_of(node) for node in root.findall("bsdf")}
    meshes = {}
    for node in root.findall("shape"):
        add_shape(node, file.parent, materials, meshes)
    for node in root.findall("emitter"):
        refuse(f"an emitter {node.get('type')}")
    say(time.process_time())
    for line in sys.stdin:
        way, spp, seed, out = line.split()
        scene = bpy.context.scene
        scene.cycles.use_adaptive_sampling = way == "adaptive"
        scene.cycles.samples, scene.cycles.seed, scene.render.filepath = int(spp), int(seed), out
        start = time.process_time()
        with contextlib.redirect_stdout(io.StringIO()):
            bpy.ops.render.render(write_still=True)
        say(time.process_time() - start)


main()
