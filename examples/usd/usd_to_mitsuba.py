#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a stage of Universal Scene Description as a Mitsuba 3 XML with PLY meshes beside it.

python3 usd_to_mitsuba.py scene.usdc out/scene.xml && vitrail render out/scene.xml -o scene.exr
"""

import argparse
import os
import re
import sys
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field

try:
    import numpy as np
    from pxr import Tf, Usd, UsdGeom, UsdLux, UsdShade, UsdSkel
except ImportError as missing:
    sys.exit(f"{missing}: pip install usd-core numpy pillow")

from cameras import sensor
from lights import Lights
from materials import Materials
from meshes import PlyFiles, gprim, read_mesh
from mitsuba_xml import DRAWN, Shape, color, column_matrix, element, even_scale, number, placed, with_children

GPRIMS = ("Sphere", "Cube", "Cylinder", "Cylinder_1", "Cone", "Capsule", "Capsule_1", "Plane")
PREDICATE = Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)


@dataclass
class Group:
    """What stands below a prototype, or below the root of the stage: shapes, lights and placed groups."""

    id: str
    shapes: list = field(default_factory=list)
    lights: list = field(default_factory=list)
    placements: list = field(default_factory=list)
    uses: int = 0

    def count(self):
        self.uses += 1
        for group, _ in self.placements:
            group.count()


class Converter:
    def __init__(self, stage, out, time):
        self.stage, self.time, self.folder, self.notes = stage, time, os.path.dirname(out) or ".", {}
        self.materials = Materials(self.folder, time, self.note)
        stem = os.path.splitext(os.path.basename(out))[0]
        self.files = PlyFiles(os.path.join(self.folder, f"{stem}-meshes"))
        self.lights = Lights(stage, time, self.folder, self.materials.file, self.note)
        self.root, self.groups, self.cameras = Group("root"), {}, []

    def note(self, kind, prim):
        self.notes.setdefault(kind, []).append(str(prim.GetPath()))

    def visit(self, prim, parent, group):
        """Takes a prim and what is below it to a group; parent: (4,4) from the prim's parent to the group."""
        imageable, local = UsdGeom.Imageable(prim), UsdGeom.Xformable(prim)
        if imageable and imageable.GetVisibilityAttr().Get(self.time) == UsdGeom.Tokens.invisible:
            return
        matrix = parent
        if local:
            if local.TransformMightBeTimeVarying():
                self.note("animation: as at one time, see --time", prim)
            matrix = column_matrix(local.GetLocalTransformation(self.time))
            matrix = matrix if local.GetResetXformStack() else parent @ matrix
        if imageable and imageable.ComputePurpose() in DRAWN:
            self.take(prim, matrix, group)
        if prim.IsA(UsdGeom.PointInstancer):
            return
        if prim.IsInstance():
            group.placements.append((self.prototype(prim), matrix))
            return
        for child in prim.GetFilteredChildren(PREDICATE):
            self.visit(child, matrix, group)

    def take(self, prim, matrix, group):
        if prim.IsA(UsdGeom.Camera):
            self.cameras.append(prim)
        elif prim.IsA(UsdGeom.PointInstancer):
            self.point_instancer(UsdGeom.PointInstancer(prim), matrix, group)
        elif prim.IsA(UsdGeom.Mesh):
            self.mesh(prim, matrix, group)
        elif prim.GetTypeName() in GPRIMS:
            self.gprim(prim, matrix, group)
        elif prim.HasAPI(UsdLux.LightAPI):
            group.lights.append((prim, matrix))
        elif prim.IsA(UsdGeom.Gprim) or prim.IsA(UsdLux.LightFilter):
            self.note(f"{prim.GetTypeName()}: left out", prim)

    def prototype(self, instance):
        bound = UsdShade.MaterialBindingAPI(instance).ComputeBoundMaterial()[0]
        key = (str(instance.GetPrototype().GetPath()), str(bound.GetPath()) if bound else "")
        if key not in self.groups:
            self.groups[key] = group = Group(f"prototype-{len(self.groups)}")
            for child in instance.GetFilteredChildren(PREDICATE):
                self.visit(child, np.eye(4), group)
        return self.groups[key]

    def point_instancer(self, instancer, matrix, group):
        indices = instancer.GetProtoIndicesAttr().Get(self.time) or []
        mask = instancer.ComputeMaskAtTime(self.time) or [True] * len(indices)
        transforms = instancer.ComputeInstanceTransformsAtTime(
            self.time, self.time, UsdGeom.PointInstancer.ExcludeProtoXform, UsdGeom.PointInstancer.IgnoreMask
        )
        prototypes = []
        for path in instancer.GetPrototypesRel().GetForwardedTargets():
            if not self.stage.GetPrimAtPath(path):
                return self.note("PointInstancer of a prototype that is not there: left out", instancer)
            if str(path) not in self.groups:
                self.groups[str(path)] = Group(f"prototype-{len(self.groups)}")
                self.visit(self.stage.GetPrimAtPath(path), np.eye(4), self.groups[str(path)])
            prototypes.append(self.groups[str(path)])
        if len(transforms) != len(indices) or max(indices, default=0) >= len(prototypes):
            return self.note("PointInstancer of arrays that do not fit: left out", instancer)
        for index, shown, transform in zip(indices, mask, transforms):
            if shown:
                group.placements.append((prototypes[index], matrix @ column_matrix(transform)))

    def display_color(self, prim):
        """One RGB, "many", or nothing."""
        primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance("displayColor")
        values = primvar.ComputeFlattened(self.time) if primvar else None
        if UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance("displayOpacity").HasAuthoredValue():
            self.note("displayOpacity: left out", prim)
        if not values:
            return None
        return tuple(values[0]) if primvar.GetInterpolation() == UsdGeom.Tokens.constant else "many"

    def surface(self, prim, shown):
        bound = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial(UsdShade.Tokens.full)[0]
        return self.materials.of(bound, shown)

    def mesh(self, prim, matrix, group):
        shown, subsets = self.display_color(prim), UsdShade.MaterialBindingAPI(prim).GetMaterialBindSubsets()
        parts = [(self.surface(subset.GetPrim(), shown), subset.GetIndicesAttr().Get(self.time)) for subset in subsets]
        parts.append((self.surface(prim, shown), None))
        if not UsdGeom.Gprim(prim).GetDoubleSidedAttr().Get():
            self.note("doubleSided off: both sides are shown", prim)
        if prim.HasAPI(UsdSkel.BindingAPI):
            self.note("skin: left at rest", prim)
        read, rest = {}, None
        for surface, indices in parts:
            if surface.uv_name not in read:
                read[surface.uv_name] = read_mesh(prim, self.time, surface.uv_name, self.note)
            triangles = read[surface.uv_name]
            if triangles is None:
                return
            rest = np.ones(len(triangles.faces), dtype=bool) if rest is None else rest
            kept = rest if indices is None else np.isin(triangles.sources, indices)
            rest = rest & ~kept
            if kept.any():
                self.add(triangles if kept.all() else triangles.of(kept), surface, shown, prim, matrix, group)

    def add(self, triangles, surface, shown, prim, matrix, group):
        """A mesh. Under a mirroring its winding turns, as USD's front does."""
        if np.linalg.det(matrix[:3, :3]) < 0:
            triangles = triangles.reversed()
        if not surface.needs_colors:
            triangles.colors = None
        elif triangles.colors is None:
            one = (0.18, 0.18, 0.18) if shown in (None, "many") else shown
            triangles.colors = np.tile(one, (len(triangles.points), 1))
        path = self.files.write(triangles, re.sub(r"\W", "_", prim.GetName()))
        filename = element("string", name="filename", value=os.path.relpath(path, self.folder))
        flat = element("boolean", name="face_normals", value="true" if triangles.normals is None else "false")
        radiance = surface.emission
        if prim.HasAPI(UsdLux.MeshLightAPI):
            if group is not self.root and UsdLux.LightAPI(prim).GetNormalizeAttr().Get(self.time):
                self.note("MeshLightAPI with normalize: the area of the prototype, not of its instances", prim)
            a, b, c = (triangles.points[triangles.faces[:, k]] @ matrix[:3, :3].T for k in range(3))
            area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
            radiance = color("radiance", self.lights.emitted(prim, area))
        group.shapes.append(Shape("ply", matrix, surface, [filename, flat], radiance))

    def gprim(self, prim, matrix, group):
        shown = self.display_color(prim)
        surface, kind = self.surface(prim, shown), prim.GetTypeName()
        if kind in ("Sphere", "Cylinder") and even_scale(matrix) and not surface.needs_colors:
            radius = prim.GetAttribute("radius").Get(self.time)
            if kind == "Sphere":
                group.shapes.append(Shape("sphere", matrix, surface, [number("radius", radius)], surface.emission))
                return
            half = prim.GetAttribute("height").Get(self.time) / 2
            shift = {"X": 1, "Y": 2, "Z": 0}[prim.GetAttribute("axis").Get(self.time)]
            axes = matrix @ np.block([[np.roll(np.eye(3), shift, axis=0), np.zeros((3, 1))], [0, 0, 0, 1]])
            ends = [element("point", name=f"p{k}", x=0, y=0, z=z) for k, z in enumerate((-half, half))]
            side = Shape("cylinder", axes, surface, [*ends, number("radius", radius)], surface.emission)
            group.shapes.append(side)
            for z in (-half, half):
                cap = np.diag([radius, radius * np.sign(z), np.sign(z), 1])
                cap[2, 3] = z
                group.shapes.append(Shape("disk", axes @ cap, surface, [], surface.emission))
            return
        self.add(gprim(prim, self.time), surface, shown, prim, matrix, group)

    def place(self, group, world, scene):
        """Writes a group: its shapes, or an instance of them where the group is used more than once."""
        shared = group is not self.root and group.uses > 1
        if shared and any(shape.radiance is None for shape in group.shapes):
            scene.append(with_children(element("shape", "instance"), element("ref", id=group.id), placed(world)))
        scene.extend(shape.xml(world) for shape in group.shapes if not shared or shape.radiance is not None)
        for prim, matrix in group.lights:
            scene.extend(self.lights.elements(prim, world @ matrix))
        for other, matrix in group.placements:
            self.place(other, world @ matrix, scene)

    def convert(self, name, width, samples):
        self.visit(self.stage.GetPseudoRoot(), np.eye(4), self.root)
        self.root.count()
        path = with_children(element("integrator", "path"), element("integer", name="max_depth", value="-1"))
        camera = sensor(self.stage, self.time, self.cameras, self.note, name, width, samples)
        scene = with_children(element("scene", version="3.0.0"), path, camera)
        things = []
        self.place(self.root, np.eye(4), things)
        scene.extend(self.materials.elements)
        for group in self.groups.values():
            shapes = [shape.xml(np.eye(4)) for shape in group.shapes if shape.radiance is None]
            if group.uses > 1 and shapes:
                scene.append(with_children(element("shape", "shapegroup", id=group.id), *shapes))
        scene.extend(things)
        if not self.lights.count and not scene.findall("shape/emitter"):
            self.note("no light: a white surrounding of radiance 1", self.stage.GetPseudoRoot())
            scene.append(with_children(element("emitter", "constant"), color("radiance", (1, 1, 1))))
        return scene


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("usd", help=".usd, .usda, .usdc or .usdz")
    parser.add_argument("out", help=".xml to write; meshes and images go beside it")
    parser.add_argument("--time", type=float, help="time code; the stage's first otherwise")
    parser.add_argument("--camera", help="its name or path; the first otherwise")
    parser.add_argument("--width", type=int, help="of the picture; of the stage's render settings, or 960, otherwise")
    parser.add_argument("--spp", type=int, default=64, help="samples per pixel, 64 otherwise")
    args = parser.parse_args()
    if not os.path.isfile(args.usd):
        sys.exit(f"{args.usd}: no such file")
    try:
        stage = Usd.Stage.Open(args.usd)
    except Tf.ErrorException as error:
        sys.exit(f"{args.usd}: {str(error).strip().splitlines()[0].split(' : ')[-1]}")
    time = stage.GetStartTimeCode() if stage.HasAuthoredTimeCodeRange() else Usd.TimeCode.EarliestTime()
    converter = Converter(stage, args.out, Usd.TimeCode(time if args.time is None else args.time))
    os.makedirs(converter.folder, exist_ok=True)
    tree = ET.ElementTree(converter.convert(args.camera, args.width, args.spp))
    ET.indent(tree)
    tree.write(args.out, encoding="utf-8", xml_declaration=True)
    up, metres = UsdGeom.GetStageUpAxis(stage), UsdGeom.GetStageMetersPerUnit(stage)
    print(f"{args.out}: {up} is up, a unit is {metres:g} m, as in {args.usd}")
    for kind, paths in converter.notes.items():
        print(f"note: {kind}: {paths[0]}" + (f" and {len(paths) - 1} more" if len(paths) > 1 else ""))


if __name__ == "__main__":
    main()
