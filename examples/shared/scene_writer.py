# SPDX-License-Identifier: Apache-2.0
"""Writes a PBRT v4 scene and its binary PLY meshes as a stream: little is held at a time."""

import json
import shutil
from collections import Counter, defaultdict

import numpy as np

from meshes import join

HELD_TRIANGLES = 700_000  # of all materials together; the largest mesh is written when there are more
INSTANCE = "AttributeBegin Translate {} {} {} Rotate {} 0 0 1{} ObjectInstance \"{}\" AttributeEnd\n"


def numbers(values):
    return " ".join(f"{v:.6g}" for v in values)


def write_ply(path, mesh):
    """Binary little-endian; positions are floats."""
    faces = np.empty(len(mesh.f), dtype=[("count", "u1"), ("indices", "<i4", 3)])
    faces["count"], faces["indices"] = 3, mesh.f
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(mesh.v)}\n"
    header += "property float x\nproperty float y\nproperty float z\n"
    header += f"element face {len(mesh.f)}\nproperty list uchar int vertex_indices\nend_header\n"
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(memoryview(np.ascontiguousarray(mesh.v, "<f4")).cast("B"))
        file.write(memoryview(faces).cast("B"))


class SceneWriter:
    """Counts what it writes: `unique` triangles are in files, `total` is what the renderer sees."""

    def __init__(self, folder, name, header):
        self.folder, self.name = folder, name
        if (folder / "meshes").exists():
            shutil.rmtree(folder / "meshes")
        (folder / "meshes").mkdir(parents=True)
        self.scene = open(folder / f"{name}.pbrt", "w")
        self.scene.write(header)
        self.held, self.held_count = defaultdict(list), Counter()
        self.files = self.instances = self.unique = self.total = 0
        self.objects = {}  # triangles of each

    def add(self, parts, turn=None, offset=0.0):
        """Parts of the scene, turned and moved."""
        for material, meshes in parts.by_material.items():
            mesh = join(meshes)
            v = mesh.v if turn is None else mesh.v @ turn.T
            self.held[material].append(mesh._replace(v=(v + offset).astype(np.float32)))
            self.held_count[material] += len(mesh.f)
        while sum(self.held_count.values()) > HELD_TRIANGLES:
            self._flush(max(self.held_count, key=self.held_count.get))

    def add_object(self, name, parts):
        """A prototype to be placed by `place`. Meshes that are held back stay outside of it."""
        self.scene.write(f'ObjectBegin "{name}"\n')
        for material in sorted(parts.by_material):
            self._shape(material, join(parts.by_material[material]))
        self.scene.write("ObjectEnd\n")
        self.objects[name] = parts.triangles
        self.unique += self.objects[name]

    def add_group(self, name, members):
        """A prototype made of others, each (name, offset, degrees): our importer's extension of PBRT."""
        self.scene.write(f'ObjectBegin "{name}"\n')
        for member in members:
            self._instance(*member)
        self.scene.write("ObjectEnd\n")
        self.objects[name] = sum(self.objects[member] for member, *_ in members)

    def place(self, name, offset, degrees=0.0, scale=1.0):
        self._instance(name, offset, degrees, scale)
        self.instances += 1
        self.total += self.objects[name]

    def _instance(self, name, offset, degrees=0.0, scale=1.0):
        x, y, z = (f"{c:.6g}" for c in offset)
        size = "" if scale == 1 else f" Scale {scale:.6g} {scale:.6g} {scale:.6g}"
        self.scene.write(INSTANCE.format(x, y, z, f"{degrees:.6g}", size, name))

    def _flush(self, material):
        mesh = join(self.held.pop(material))
        del self.held_count[material]
        self.unique += len(mesh.f)
        self.total += len(mesh.f)
        self._shape(material, mesh)

    def _shape(self, material, mesh):
        file = f"meshes/{self.files:05d}-{material}.ply"
        self.files += 1
        write_ply(self.folder / file, mesh)
        self.scene.write(f'NamedMaterial "{material}" Shape "plymesh" "string filename" "{file}"\n')

    def flush(self):
        """Writes what is held."""
        for material in sorted(self.held):
            self._flush(material)

    def close(self, **more):
        """Writes NAME.json with the counts, too."""
        self.flush()
        self.scene.close()
        counts = {
            "triangles": self.total,
            "unique_triangles": self.unique,
            "objects": len(self.objects),
            "instances": self.instances,
            "meshes": self.files,
            **more,
        }
        (self.folder / f"{self.name}.json").write_text(json.dumps(counts, indent=1) + "\n")
        return counts
