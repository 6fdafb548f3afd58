# SPDX-License-Identifier: Apache-2.0
"""UsdLux's lights as emitters of Mitsuba 3. Its units: OpenUSD's documentation of UsdLuxLightAPI."""

import os

import numpy as np
from pxr import Gf, UsdGeom, UsdLux

from mitsuba_xml import TURNED, Shape, bounds, color, column_matrix, element, even_scale, number, placed, rigid
from mitsuba_xml import with_children


class Lights:
    """`file`: the path of an asset on the disk, or nothing; `count`: of the lights so far."""

    def __init__(self, stage, time, folder, file, note):
        self.stage, self.time, self.folder, self.file, self.note = stage, time, folder, file, note
        self.count, self.environment = 0, None

    def emitted(self, prim, size):
        """Radiance as RGB (UsdLux, LightAPI): a light of intensity 1 gives the pixel that sees it 1; size: by
        which `normalize` divides."""
        light, get = UsdLux.LightAPI(prim), lambda attribute: attribute.Get(self.time)
        value = np.array(get(light.GetColorAttr())) * get(light.GetIntensityAttr())
        value = value * 2.0 ** get(light.GetExposureAttr())
        if get(light.GetEnableColorTemperatureAttr()):
            value = value * np.array(UsdLux.BlackbodyTemperatureAsRgb(get(light.GetColorTemperatureAttr())))
        for name in ("diffuse", "specular"):
            if get(prim.GetAttribute(f"inputs:{name}")) != 1:
                self.note(f"inputs:{name} of a light: left out", prim)
        if light.GetFiltersRel().GetTargets():
            self.note("light filters: left out", prim)
        for links in (light.GetLightLinkCollectionAPI(), light.GetShadowLinkCollectionAPI()):
            chosen = links.GetIncludesRel().GetTargets() or links.GetExcludesRel().GetTargets()
            if chosen or not links.GetIncludeRootAttr().Get():
                self.note("links of a light: it reaches all", prim)
        if prim.HasAPI(UsdLux.ShadowAPI) and not get(UsdLux.ShadowAPI(prim).GetShadowEnableAttr()):
            self.note("a light without shadows: it has them", prim)
        return value / size if get(light.GetNormalizeAttr()) and size > 0 else value

    def elements(self, prim, matrix):
        """The elements of a light; matrix: (4,4) to the world."""
        kind = prim.GetTypeName()
        get = lambda name: prim.GetAttribute(f"inputs:{name}").Get(self.time)
        self.count += 1
        if kind in ("RectLight", "DiskLight"):
            wide = (get("width") / 2, get("height") / 2) if kind == "RectLight" else (get("radius"),) * 2
            local = matrix @ TURNED @ np.diag([*wide, 1, 1])
            area = np.linalg.norm(np.cross(local[:3, 0], local[:3, 1])) * (4 if kind == "RectLight" else np.pi)
            radiance = self.emitted(prim, area)
            self.shaping(prim, "its shape of the beam is left out")
            if kind == "RectLight" and get("texture:file"):
                self.note("texture of a RectLight: left out", prim)
            shape = "rectangle" if kind == "RectLight" else "disk"
            return [Shape(shape, local, radiance=color("radiance", radiance)).xml(np.eye(4))]
        if kind == "SphereLight":
            return [self.sphere_light(prim, matrix, get("radius"))]
        if kind == "CylinderLight":
            scale = np.linalg.norm(matrix[:3, :3], axis=0)
            radius, half = get("radius") * np.sqrt(scale[1] * scale[2]), get("length") / 2 * scale[0]
            if even_scale(matrix) is None:
                self.note("CylinderLight of uneven scale: a round one", prim)
            ends = [element("point", name=f"p{k}", x=x, y=0, z=0) for k, x in enumerate((-half, half))]
            radiance = color("radiance", self.emitted(prim, 4 * np.pi * radius * half))
            return [Shape("cylinder", rigid(matrix), None, [*ends, number("radius", radius)], radiance).xml(np.eye(4))]
        if kind == "DistantLight":
            return [self.distant_light(prim, matrix, np.radians(min(get("angle"), 170)) / 2)]
        if kind.startswith("DomeLight"):
            return self.dome_light(prim, matrix)
        self.note(f"{kind}: left out", prim)
        return []

    def shaping(self, prim, consequence):
        """The half angle and the softness of a cone; nothing where the light has none."""
        api = UsdLux.ShapingAPI(prim)
        if not prim.HasAPI(UsdLux.ShapingAPI):
            return None
        angle, soft = (a.Get(self.time) for a in (api.GetShapingConeAngleAttr(), api.GetShapingConeSoftnessAttr()))
        if api.GetShapingFocusAttr().Get(self.time) or api.GetShapingIesFileAttr().Get(self.time):
            self.note("focus or IES file of a light: left out", prim)
        if angle >= 90:
            return None
        self.note(f"cone of a light: {consequence}", prim)
        return angle, soft

    def sphere_light(self, prim, matrix, radius):
        scales = np.linalg.svd(matrix[:3, :3], compute_uv=False)
        radius = radius * np.cbrt(np.prod(scales))
        if even_scale(matrix) is None:
            self.note("SphereLight of uneven scale: a round one", prim)
        radiance = self.emitted(prim, 4 * np.pi * radius**2 if radius > 0 else 1)
        # A sphere of radiance L has the intensity L pi r^2; one without a radius, normalized, a quarter of its power's.
        normalized = UsdLux.LightAPI(prim).GetNormalizeAttr().Get(self.time)
        intensity = color("intensity", radiance * (np.pi * radius**2 if radius > 0 else 0.25 if normalized else 0))
        cone = self.shaping(prim, "a spot without a size")
        if cone:
            beam = number("beam_width", cone[0] * (1 - min(cone[1], 1)))
            spot = with_children(element("emitter", "spot"), intensity, number("cutoff_angle", cone[0]), beam)
            return with_children(spot, placed(rigid(matrix) @ TURNED))
        if UsdLux.SphereLight(prim).GetTreatAsPointAttr().Get(self.time) or radius <= 0:
            place = element("point", name="position", **dict(zip("xyz", matrix[:3, 3])))
            return with_children(element("emitter", "point"), place, intensity)
        centre = element("point", name="center", **dict(zip("xyz", matrix[:3, 3])))
        out = Shape("sphere", np.eye(4), None, [centre, number("radius", radius)], color("radiance", radiance))
        return out.xml(np.eye(4))

    def distant_light(self, prim, matrix, half):
        """A delta light where it has no angle; otherwise a disk far behind the scene, of the same angle."""
        radiance = self.emitted(prim, np.pi * np.sin(half) ** 2 if half > 0 else 1)
        if half <= 0:
            direction = element("vector", name="direction", **dict(zip("xyz", -rigid(matrix)[:3, 2])))
            return with_children(element("emitter", "directional"), direction, color("irradiance", radiance))
        centre, size = bounds(self.stage, self.time)
        self.note("DistantLight with an angle: a disk at 500 times the scene's size", prim)
        away, world = 500 * size, rigid(matrix)
        world[:3, 3] = centre + away * world[:3, 2]
        wide = away * np.tan(half)
        disk = world @ TURNED @ np.diag([wide, wide, 1, 1])
        return Shape("disk", disk, radiance=color("radiance", radiance)).xml(np.eye(4))

    def dome_light(self, prim, matrix):
        if self.environment:
            self.note(f"DomeLight beside {self.environment}: left out, as Mitsuba has one", prim)
            return []
        self.environment = str(prim.GetPath())
        radiance = self.emitted(prim, 1)
        asset = prim.GetAttribute("inputs:texture:file").Get(self.time)
        path = self.file(asset, prim) if asset else None
        if path is None:
            return [with_children(element("emitter", "constant"), color("radiance", radiance))]
        if prim.GetAttribute("inputs:texture:format").Get(self.time) not in ("automatic", "latlong"):
            self.note("texture:format of a DomeLight: taken as latlong", prim)
        if np.ptp(radiance) > 1e-3 * np.max(radiance):
            self.note("colour of a DomeLight with a texture: its mean", prim)
        pole = prim.GetAttribute("poleAxis").Get() if prim.HasAttribute("poleAxis") else "Y"
        if pole == "Z" or pole == "scene" and UsdGeom.GetStageUpAxis(self.stage) == "Z":
            matrix = matrix @ column_matrix(Gf.Matrix4d().SetRotate(Gf.Rotation(Gf.Vec3d(1, 0, 0), 90)))
        world = rigid(matrix)
        world[:3, 3] = 0
        filename = element("string", name="filename", value=os.path.relpath(path, self.folder))
        scale = number("scale", np.mean(radiance))
        return [with_children(element("emitter", "envmap"), filename, scale, placed(world))]
