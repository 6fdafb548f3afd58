# SPDX-License-Identifier: Apache-2.0
"""UsdPreviewSurface and its textures as Mitsuba 3's principled BSDF and bitmaps."""

import os
import re
import xml.etree.ElementTree as ET
import zipfile
from dataclasses import dataclass

import numpy as np
from pxr import UsdShade

from mitsuba_xml import color, element, number, with_children

try:
    from PIL import Image
except ImportError:  # pictures that Mitsuba has no way to say are then taken as they are, with a note
    Image = None

NEUTRAL, NORMALS = ((1, 1, 1, 1), (0, 0, 0, 0)), ((2, 2, 2), (-1, -1, -1))


def srgb_decoded(values):
    return np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4)


@dataclass
class Surface:
    """A BSDF that was written: its id, its emission (an element named radiance, or nothing), and what it reads."""

    id: str
    emission: ET.Element | None = None
    uv_name: str = "st"
    needs_colors: bool = False


class Materials:
    """Writes each material once; `elements` has their BSDFs."""

    def __init__(self, folder, time, note):
        self.folder, self.time, self.note = folder, time, note
        self.elements, self.known, self.images = [], {}, {}

    def of(self, material, display_color):
        """The surface of a bound UsdShade.Material; without one, of displayColor: one RGB, "many", or nothing."""
        shader = None
        if material:
            key = str(material.GetPath())
            if key not in self.known:
                shader = material.ComputeSurfaceSource()[0]
                if not shader or shader.GetIdAttr().Get() != "UsdPreviewSurface":
                    identifier = shader.GetIdAttr().Get() if shader else "nothing"
                    self.note(f"material of {identifier}, not of UsdPreviewSurface: displayColor is taken", material)
                    self.known[key] = None
                else:
                    self.known[key] = self.preview_surface(UsdShade.Shader(shader), key)
            if self.known[key]:
                return self.known[key]
        many = display_color == "many"
        value = None if many else (0.18, 0.18, 0.18) if display_color is None else tuple(map(float, display_color))
        if value not in self.known:
            surface = Surface(f"displayColor-{len(self.elements)}", needs_colors=many)
            reflectance = self.vertex_color("reflectance") if many else color("reflectance", np.clip(value, 0, 1))
            diffuse = with_children(element("bsdf", "diffuse"), reflectance)
            self.elements.append(with_children(element("bsdf", "twosided", id=surface.id), diffuse))
            self.known[value] = surface
        return self.known[value]

    def preview_surface(self, shader, path):
        surface = Surface(re.sub(r"\W", "_", path[1:]) + f"-{len(self.elements)}")
        get = lambda inputs, kind, default: self.parameter(shader, inputs, kind, default, surface)
        principled = element("bsdf", "principled")
        base, specular = get("diffuseColor", "color", (0.18, 0.18, 0.18)), []
        metallic, ior = get("metallic", "float", 0.0), get("ior", "float", 1.5)
        if get("useSpecularWorkflow", "float", 0) == 1:
            f0, metallic = get("specularColor", "color", (0.0, 0.0, 0.0)), 0.0
            if isinstance(f0, ET.Element):
                f0 = (0.04, 0.04, 0.04)
            self.note("specularColor: its mean becomes an index of refraction", shader)
            root = np.sqrt(np.clip(np.mean(f0), 0, 0.9))
            ior = (1 + root) / (1 - root)
        if isinstance(ior, ET.Element):
            ior = 1.5
            self.note("ior of a texture: 1.5", shader)
        ior = max(ior, 1 / max(ior, 1e-3))
        specular = number("eta", ior) if ior > 1.001 else number("specular", 0)
        with_children(principled, self.named("base_color", base), self.named("metallic", metallic), specular)
        principled.append(self.named("roughness", get("roughness", "float", 0.5)))
        coat, coat_roughness = get("clearcoat", "float", 0.0), get("clearcoatRoughness", "float", 0.01)
        if isinstance(coat, ET.Element) or coat > 0:
            self.note("clearcoat: Mitsuba's principled has a quarter of it, of a roughness up to 0.316", shader)
            alpha = 1e-4 if isinstance(coat_roughness, ET.Element) else coat_roughness**2
            gloss = np.clip((0.1 - alpha) / 0.099, 0, 1)  # Burley 2012: alpha from 0.1 to 0.001
            with_children(principled, self.named("clearcoat", coat), number("clearcoat_gloss", gloss))
        bsdf, normal = principled, get("normal", "normal", None)
        if isinstance(normal, ET.Element):
            bsdf = with_children(element("bsdf", "normalmap"), self.named("normalmap", normal), bsdf)
        bsdf = with_children(element("bsdf", "twosided"), bsdf)
        bsdf = self.cut_out(shader, bsdf, surface)
        if get("displacement", "float", 0.0) != 0.0:
            self.note("displacement: left out", shader)
        emission = get("emissiveColor", "color", (0.0, 0.0, 0.0))
        if isinstance(emission, ET.Element) or max(emission) > 0:
            self.note("emissiveColor: Mitsuba's area emitters shine from the front alone", shader)
            surface.emission = self.named("radiance", emission)
        bsdf.set("id", surface.id)
        self.elements.append(bsdf)
        return surface

    def cut_out(self, shader, bsdf, surface):
        threshold = self.parameter(shader, "opacityThreshold", "float", 0.0, surface)
        threshold = 0.0 if isinstance(threshold, ET.Element) else threshold
        opacity = self.parameter(shader, "opacity", "float", 1.0, surface, threshold)
        if isinstance(opacity, float):
            opacity = float(opacity >= threshold) if threshold > 0 else opacity
            if opacity >= 1:
                return bsdf
        mode = shader.GetInput("opacityMode").Get() if shader.GetInput("opacityMode") else "transparent"
        if threshold <= 0 and mode != "presence":
            self.note("opacity without opacityThreshold: a part of the light passes straight, highlights fade", shader)
        return with_children(element("bsdf", "mask"), self.named("opacity", opacity), bsdf)

    def named(self, name, value):
        if isinstance(value, ET.Element):
            value.set("name", name)
            return value
        return number(name, value) if np.ndim(value) == 0 else color(name, value)

    def vertex_color(self, name):
        texture = element("texture", "mesh_attribute", name)
        return with_children(texture, element("string", name="name", value="vertex_color"))

    def source(self, node, name):
        """A value, or a shader and the name of its output; through node graphs and interfaces."""
        given = node.GetInput(name)
        attributes = given.GetValueProducingAttributes() if given else []
        if not attributes:
            return None, None
        base, kind = UsdShade.Utils.GetBaseNameAndType(attributes[0].GetName())
        if kind == UsdShade.AttributeType.Output:
            return UsdShade.Shader(attributes[0].GetPrim()), base
        return attributes[0].Get(self.time), None

    def parameter(self, shader, name, kind, default, surface, threshold=0.0):
        """A number, a colour, or a texture element; kind: "color", "float" or "normal"."""
        value, output = self.source(shader, name)
        if output is None:
            if value is None:
                return default
            return float(value) if np.ndim(value) == 0 else tuple(map(float, value))
        identifier = str(value.GetIdAttr().Get() or "a shader without an id")
        if identifier == "UsdUVTexture":
            return self.texture(value, output, kind, default, surface, threshold)
        variable, _ = self.source(value, "varname")
        if identifier.startswith("UsdPrimvarReader") and variable == "displayColor" and kind == "color":
            surface.needs_colors = True
            return self.vertex_color(name)
        fallback, _ = self.source(value, "fallback")
        self.note(f"{identifier} of {variable} for {name}: its fallback", shader)
        if fallback is None or np.ndim(fallback) != (1 if kind == "color" else 0):
            return default
        return float(fallback) if np.ndim(fallback) == 0 else tuple(map(float, fallback))

    def texture(self, shader, output, kind, default, surface, threshold):
        constant = lambda name, other: other if self.source(shader, name)[0] is None else self.source(shader, name)[0]
        path = self.file(constant("file", None), shader)
        if path is None:
            fallback = constant("fallback", None)
            if fallback is None:
                return default
            return tuple(fallback)[:3] if kind == "color" else None if kind == "normal" else float(fallback[0])
        texture = element("texture", "bitmap")
        scale, bias = np.array(constant("scale", NEUTRAL[0])), np.array(constant("bias", NEUTRAL[1]))
        space = constant("sourceColorSpace", "auto")
        path, raw = self.image(path, kind, output, scale, bias, space, threshold, shader)
        with_children(texture, element("string", name="filename", value=os.path.relpath(path, self.folder)))
        texture.append(element("boolean", name="raw", value="true" if raw else "false"))
        wraps = [str(constant(name, "repeat")) for name in ("wrapS", "wrapT")]
        known = {"repeat": "repeat", "mirror": "mirror", "clamp": "clamp", "black": "clamp"}
        if wraps[0] != wraps[1] or "black" in wraps:
            self.note(f"wrapS {wraps[0]}, wrapT {wraps[1]}: {known.get(wraps[0], 'repeat')} for both", shader)
        texture.append(element("string", name="wrap_mode", value=known.get(wraps[0], "repeat")))
        with_children(texture, self.placement(shader, surface))
        return texture

    def placement(self, shader, surface):
        """The transform of texture coordinates, which the meshes have with v downwards; nothing where it is none."""
        node, output = self.source(shader, "st")
        steps = []
        while output is not None and node.GetIdAttr().Get() == "UsdTransform2d":
            get = lambda name, default: default if self.source(node, name)[0] is None else self.source(node, name)[0]
            (sx, sy), (tx, ty) = get("scale", (1, 1)), get("translation", (0, 0))
            # Scale, rotate, translate: so by the specification of UsdPreviewSurface.
            turn = element("rotate", z="1", angle=get("rotation", 0))
            steps = [element("scale", x=sx, y=sy), turn, element("translate", x=tx, y=ty)] + steps
            node, output = self.source(node, "in")
        if output is not None and str(node.GetIdAttr().Get()).startswith("UsdPrimvarReader_float2"):
            surface.uv_name = str(self.source(node, "varname")[0] or "st")
        if not steps:
            return None
        flip = lambda: [element("scale", x=1, y=-1), element("translate", x=0, y=1)]
        return with_children(element("transform", name="to_uv"), *flip(), *steps, *flip())

    def file(self, asset, shader):
        """A path on the disk, unpacked from its .usdz; nothing where there is no such file."""
        path = (asset.resolvedPath or asset.path) if asset else ""
        packed = re.fullmatch(r"(.*\.usdz)\[(.*)\]", path)
        if packed:
            target = os.path.join(self.folder, "textures", packed[2].replace("/", "_"))
            os.makedirs(os.path.dirname(target), exist_ok=True)
            with zipfile.ZipFile(packed[1]) as archive, open(target, "wb") as out:
                out.write(archive.read(packed[2]))
            return target
        if os.path.isfile(path):
            return os.path.abspath(path)
        self.note(f"image {path or 'without a name'}: not found, its fallback is taken", shader)
        return None

    def image(self, path, kind, output, scale, bias, space, threshold, shader):
        """A path and whether it is raw. A new image is made where Mitsuba has no words for a channel or a scale."""
        integer = os.path.splitext(path)[1].lower() in (".png", ".jpg", ".jpeg", ".tga", ".bmp")
        decoded = integer and space != "raw"
        plain = np.allclose(scale, 1) and np.allclose(bias, 0)
        if kind == "normal":
            if integer and plain:
                self.note("normal map of 8 bits without scale 2 and bias -1: taken as if it had them", shader)
            if plain or (np.allclose(scale[:3], NORMALS[0]) and np.allclose(bias[:3], NORMALS[1])):
                return path, True
        elif kind == "color" and plain and output == "rgb" and decoded == integer:
            return path, False
        if Image is None or not integer:
            why = "Pillow reads no such file" if Image else "there is no Pillow (pip install pillow)"
            self.note(f"scale, bias or channel of an image: left out, as {why}", shader)
            return path, kind != "color"
        key = (path, kind, output, tuple(scale), tuple(bias), decoded, threshold)
        if key not in self.images:
            self.images[key] = self.baked(*key)
        return self.images[key]

    def baked(self, path, kind, output, scale, bias, decoded, threshold):
        picture = Image.open(path)
        channels = {"r": [0], "g": [1], "b": [2], "a": [3]}.get(output, [0, 1, 2])
        if kind == "float":
            channels = channels[:1]
        if picture.mode in ("L", "1", "LA", "I", "I;16"):  # of few channels: USD takes them as linear in "auto"
            decoded = decoded and kind == "color"
        wide = picture.mode.startswith("I")
        values = np.asarray(picture if wide else picture.convert("RGBA"), dtype=np.float64) / (65535 if wide else 255)
        values = np.repeat(values[..., None], 4, axis=2) if wide else values
        if decoded:
            values[..., :3] = srgb_decoded(values[..., :3])
        values = (values * scale + bias)[..., channels]
        values = (values + 1) / 2 if kind == "normal" else values
        values = (values >= threshold).astype(np.float64) if threshold > 0 else values
        stem = f"{os.path.splitext(os.path.basename(path))[0]}-{output}-{len(self.images)}"
        target = os.path.join(self.folder, "textures", stem)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        levels = np.round(values * 255)
        if kind == "float" and np.abs(values * 255 - levels).max() < 1e-6 and 0 <= levels.min() <= levels.max() <= 255:
            Image.fromarray(levels[..., 0].astype(np.uint8), "L").save(target + ".png")
            return target + ".png", True
        with open(target + ".pfm", "wb") as out:  # its rows go from below to above
            out.write(f"{'Pf' if len(channels) == 1 else 'PF'}\n{values.shape[1]} {values.shape[0]}\n-1\n".encode())
            out.write(values[::-1].astype("<f4").tobytes())
        return target + ".pfm", kind != "color"
