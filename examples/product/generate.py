#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a bottle of perfume in a studio as a glTF 2.0 scene: product.gltf and product.bin.

Sample runs:
    ./generate.py -o /tmp/product
    ./generate.py -o /tmp/product --detail 2
"""

import argparse
import json
from pathlib import Path

import numpy as np

# Sections (r, y) in mm, turned around y; a corner that is given twice is sharp.
BOTTLE = [(0, 0), (30, 0), (30, 0), (35, 3), (38, 12), (38, 50), (36, 66), (24, 76), (12, 79), (10, 84), (10, 92), (10, 92), (0, 92)]
LIQUID = [(0, 7), (28, 7), (33, 10), (34, 16), (34, 52), (34, 52), (0, 52)]
CAP = [(0, 93), (14, 93), (14, 93), (15, 94), (15, 122), (14, 123), (14, 123), (0, 123)]


def rounded(section, steps):
    """The section as quadratic B-splines between its sharp corners."""
    p = np.array([section[0], *section, section[-1]], float)
    t = np.linspace(0, 1, steps, endpoint=False)[None, :, None]
    a, b, c = (p[k : len(p) - 2 + k, None] for k in range(3))
    curve = ((a * (1 - t) ** 2 + b * (1 + 2 * t - 2 * t**2) + c * t**2) / 2).reshape(-1, 2)
    return np.concatenate([curve[np.r_[True, np.linalg.norm(np.diff(curve, axis=0), axis=1) > 1e-9]], p[-1:]])


def turned(section, detail):
    count = max(12, round(128 * detail))
    profile = rounded(section, max(2, round(8 * detail))) / 1000
    angle = 2 * np.pi * np.arange(count) / count
    r, y = profile[:, None, 0], profile[:, None, 1]
    points = np.stack([r * np.cos(angle), y + 0 * angle, r * np.sin(angle)], -1).reshape(-1, 3)
    along = np.gradient(profile, axis=0)
    normal = np.stack([along[:, 1], -along[:, 0]], 1)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    normals = np.stack(
        [normal[:, None, 0] * np.cos(angle), normal[:, None, 1] + 0 * angle, normal[:, None, 0] * np.sin(angle)], -1
    ).reshape(-1, 3)
    index = np.arange(len(points)).reshape(len(profile), count)
    a, b, c, d = index[:-1], np.roll(index[:-1], -1, 1), np.roll(index[1:], -1, 1), index[1:]
    faces = np.concatenate([np.stack([a, d, c], -1).reshape(-1, 3), np.stack([a, c, b], -1).reshape(-1, 3)])
    corner = points[faces]
    area = np.linalg.norm(np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1)
    return points, normals, faces[area > 1e-13]


def backdrop():
    """A sheet that bends from the floor into the wall."""
    bend = np.linspace(0, np.pi / 2, 24)
    y = np.r_[0, 0.3 - 0.3 * np.cos(bend), 1.2]
    z = np.r_[0.8, -0.3 - 0.3 * np.sin(bend), -0.6]
    points = np.stack([np.repeat([-1.5, 1.5], len(y)), np.tile(y, 2), np.tile(z, 2)], -1)
    k, n = np.arange(len(y) - 1), len(y)
    faces = np.concatenate([np.stack([k, k + n, k + n + 1], -1), np.stack([k, k + n + 1, k + 1], -1)])
    along = np.gradient(np.stack([y, z], -1), axis=0)
    normals = np.stack([np.zeros(2 * n), np.tile(-along[:, 1], 2), np.tile(along[:, 0], 2)], -1)
    return points, normals / np.linalg.norm(normals, axis=1, keepdims=True), faces


def panel(centre, right, up):
    c, r, u = (np.array(v, float) for v in (centre, right, up))
    normal = np.cross(r, u) / np.linalg.norm(np.cross(r, u))
    return np.array([c - r - u, c + r - u, c + r + u, c - r + u]), np.tile(normal, (4, 1)), np.array([[0, 1, 2], [0, 2, 3]])


def glass(color, ior, distance):
    return {
        "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
        "extensions": {
            "KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_ior": {"ior": ior},
            "KHR_materials_volume": {"thicknessFactor": 0.01, "attenuationColor": color, "attenuationDistance": distance},
        },
    }


def plain(color, roughness=1.0, metal=0.0):
    return {"pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "roughnessFactor": roughness, "metallicFactor": metal}}


def shining(strength):
    return plain((0, 0, 0)) | {
        "emissiveFactor": [1, 1, 1],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": strength}},
    }


def write(folder, parts):
    """`parts`: a name, a material, and positions, normals, triangles each."""
    data, views, accessors = b"", [], []

    def accessor(array, kind, component):
        nonlocal data
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
        data += array.tobytes()
        entry = {"bufferView": len(views) - 1, "componentType": component, "count": len(array), "type": kind}
        if kind == "VEC3":
            entry |= {"min": array.min(0).tolist(), "max": array.max(0).tolist()}
        accessors.append(entry)
        return len(accessors) - 1

    meshes, materials = [], []
    for name, material, (points, normals, faces) in parts:
        attributes = {"POSITION": accessor(points.astype("<f4"), "VEC3", 5126), "NORMAL": accessor(normals.astype("<f4"), "VEC3", 5126)}
        indices = accessor(faces.astype("<u4").reshape(-1), "SCALAR", 5125)
        materials.append(material | {"name": name, "doubleSided": True})
        meshes.append({"name": name, "primitives": [{"attributes": attributes, "indices": indices, "material": len(materials) - 1}]})
    eye, tilt = [0, 0.1, 0.42], -0.07
    camera = {"name": "camera", "camera": 0, "translation": eye, "rotation": [np.sin(tilt / 2), 0, 0, np.cos(tilt / 2)]}
    gltf = {
        "asset": {"version": "2.0", "generator": "examples/product/generate.py; licence: Apache-2.0"},
        "extensionsUsed": ["KHR_materials_transmission", "KHR_materials_ior", "KHR_materials_volume", "KHR_materials_emissive_strength"],
        "scene": 0,
        "scenes": [{"nodes": list(range(len(parts) + 1))}],
        "nodes": [{"mesh": k, "name": parts[k][0]} for k in range(len(parts))] + [camera],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.42, "aspectRatio": 4 / 3, "znear": 0.01}}],
        "meshes": meshes,
        "materials": materials,
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"uri": "product.bin", "byteLength": len(data)}],
    }
    (folder / "product.bin").write_bytes(data)
    (folder / "product.gltf").write_text(json.dumps(gltf, indent=1))


def main():
    parser = argparse.ArgumentParser(description="writes product.gltf and product.bin")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="DIR")
    parser.add_argument("--detail", type=float, default=1.0, help="of the meshes (default 1)")
    args = parser.parse_args()
    args.output.mkdir(parents=True, exist_ok=True)
    parts = [
        ("backdrop", plain((0.62, 0.56, 0.54)), backdrop()),
        ("bottle", glass([0.97, 0.98, 0.98], 1.5, 0.05), turned(BOTTLE, args.detail)),
        ("liquid", glass([0.95, 0.62, 0.25], 1.36, 0.05), turned(LIQUID, args.detail)),
        ("cap", plain((1.0, 0.78, 0.42), 0.22, 1.0), turned(CAP, args.detail)),
        ("softbox", shining(8), panel((-0.5, 0.45, 0.2), (0.12, 0, 0.3), (0.09, 0.22, -0.04))),
        ("rim", shining(12), panel((0.45, 0.3, -0.15), (-0.03, 0, -0.1), (0, 0.25, 0))),
        ("top", shining(3), panel((0, 0.8, 0.1), (0.35, 0, 0), (0, 0, 0.35))),
    ]
    write(args.output, parts)
    print(f"{args.output / 'product.gltf'}: {sum(len(faces) for _, _, (_, _, faces) in parts)} triangles")


if __name__ == "__main__":
    main()
