#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""examples/usd: what it writes of small stages, held to UsdLux, to closed forms and, where it is there, to Mitsuba.

usd_test.py VITRAIL SOURCE [Usd.test_notes]. VITRAIL_USD_PYTHON names a Python that has pxr, without which it ends with
77 (skipped); VITRAIL_MITSUBA_PYTHON one that has mitsuba.
"""

import math
import os
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET
import zlib

PYTHON, MITSUBA = os.environ.get("VITRAIL_USD_PYTHON", sys.executable), os.environ.get("VITRAIL_MITSUBA_PYTHON")
VITRAIL, SOURCE = sys.argv[1:3]
CAMERA = """
def Camera "high" { float focalLength = 50
  float horizontalAperture = 20
  float verticalAperture = 20
  float horizontalApertureOffset = 5
  float verticalApertureOffset = 2
  double3 xformOp:translate = (0, 5, 0)
  float xformOp:rotateX = -90
  uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}
"""
TURNED = """
  double3 xformOp:translate = (0, 2, 0)
  float xformOp:rotateX = -90
  float3 xformOp:scale = (2, 2, 2)
  uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX", "xformOp:scale"]
"""
FLOOR = """
def Mesh "floor" { uniform token subdivisionScheme = "none"
  point3f[] points = [(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)]
  int[] faceVertexCounts = [4]
  int[] faceVertexIndices = [3, 2, 1, 0]
  color3f[] primvars:displayColor = [(0.5, 0.5, 0.5)]
  texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "faceVarying")
  %s
}
"""
PREVIEW = """
def Material "m" { token outputs:surface.connect = </m/s.outputs:surface>
  def Shader "s" { uniform token info:id = "UsdPreviewSurface"
    %s
    token outputs:surface
  }
  def Shader "t" { uniform token info:id = "UsdUVTexture"
    asset inputs:file = @%s@
    token inputs:sourceColorSpace = "raw"
    token inputs:wrapS = "clamp"
    token inputs:wrapT = "clamp"
    float2 inputs:st.connect = </m/x.outputs:result>
    float outputs:r
    float outputs:g
    float outputs:b
    float3 outputs:rgb
  }
  def Shader "x" { uniform token info:id = "UsdTransform2d"
    float2 inputs:scale = (2, 1)
    float inputs:rotation = 90
    float2 inputs:translation = (1, 0)
    float2 inputs:in.connect = </m/r.outputs:result>
    float2 outputs:result
  }
  def Shader "r" { uniform token info:id = "UsdPrimvarReader_float2"
    string inputs:varname = "st"
    float2 outputs:result
  }
}
"""


def png(width, height, rows):
    """RGB of 8 bits."""
    part = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    lines = b"".join(b"\0" + bytes(row) for row in rows)
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + part(b"IHDR", head) + part(b"IDAT", zlib.compress(lines)) + part(b"IEND", b"")


def read_png(path):
    """Rows of linear RGB, of a picture of 8 bits."""
    with open(path, "rb") as file:
        data = file.read()
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at : at + 8])
        part = data[at + 8 : at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colors = struct.unpack(">IIBB", part[:10])
        packed += part if kind == b"IDAT" else b""
        at += size + 12
    assert depth == 8 and colors in (2, 6)
    step, lines = {2: 3, 6: 4}[colors], zlib.decompress(packed)
    above, rows = [0] * (step * width), []
    for y in range(height):
        kind, *line = lines[y * (step * width + 1) : (y + 1) * (step * width + 1)]
        for x in range(len(line)):
            left, up, corner = (line[x - step], above[x], above[x - step]) if x >= step else (0, above[x], 0)
            guess = left + up - corner
            nearest = min((left, up, corner), key=lambda value: abs(guess - value))
            line[x] = (line[x] + (0, left, up, (left + up) // 2, nearest)[kind]) % 256
        above = line
        linear = [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in (byte / 255 for byte in line)]
        rows.append([linear[x : x + 3] for x in range(0, step * width, step)])
    return rows


class Usd(unittest.TestCase):
    def setUp(self):
        made = tempfile.TemporaryDirectory()
        self.addCleanup(made.cleanup)
        self.folder = made.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def convert(self, stage, name="scene.usda", options=(), up="Y"):
        """The XML's root and what was printed."""
        if stage is not None:
            with open(self.path(name), "w") as file:
                file.write(f'#usda 1.0\n( upAxis = "{up}" )\n' + stage.replace(" }", "\n}"))
        script = os.path.join(SOURCE, "examples/usd/usd_to_mitsuba.py")
        command = [PYTHON, "-B", script, self.path(name), self.path("out/scene.xml"), *map(str, options)]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        return ET.parse(self.path("out/scene.xml")).getroot(), done.stdout

    def pixels(self, spp=256):
        """Rows of RGB, linear and up to 1, of vitrail's picture; the mean of Mitsuba's has to be near of theirs."""
        out = self.path("out/picture.png")
        command = [VITRAIL, "render", self.path("out/scene.xml"), "-o", out, "--force", "--quiet", "--spp", str(spp)]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        rows = read_png(out)
        if MITSUBA:
            script = os.path.join(SOURCE, "tests/importers/render_mitsuba.py")
            other = self.path("out/mitsuba.npy")
            command = [MITSUBA, script, self.path("out/scene.xml"), other, "--spp", str(spp), "--variant", "scalar_rgb"]
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            self.assertEqual(done.returncode, 0, done.stdout)
            with open(other, "rb") as file:
                data = file.read()[-12 * len(rows) * len(rows[0]) :]
            theirs = [min(value, 1) for (value,) in struct.iter_unpack("<f", data)]
            ours = [value for row in rows for pixel in row for value in pixel]
            self.assertAlmostEqual(sum(theirs) / sum(ours), 1, delta=0.03)
        return rows

    def numbers(self, root, path):
        return [float(n) for n in root.find(path).get("value").split()]

    def test_radiance_by_usdlux(self):
        """intensity 3, exposure 1, scale 2: 6 nits; divided by the area in the world where normalized."""
        for kind, size, area in [
            ("RectLight", "float inputs:width = 0.5\nfloat inputs:height = 0.25", 1 * 0.5),
            ("DiskLight", "float inputs:radius = 0.25", math.pi * 0.25),
            ("SphereLight", "float inputs:radius = 0.25", 4 * math.pi * 0.25),
            ("CylinderLight", "float inputs:radius = 0.1\nfloat inputs:length = 0.5", 2 * math.pi * 0.2 * 1),
        ]:
            for normalize in (0, 1):
                light = f'def {kind} "l" {{ float inputs:intensity = 3\nfloat inputs:exposure = 1\n{size}\n'
                light += f"bool inputs:normalize = {normalize}\ncolor3f inputs:color = (1, 0.5, 0)\n{TURNED} }}\n"
                root, _ = self.convert(light + CAMERA)
                expected = 6 / (area if normalize else 1)
                value = self.numbers(root, "shape/emitter/rgb")
                for n, part in zip(value, (1, 0.5, 0)):
                    self.assertAlmostEqual(n, part * expected, delta=1e-5 * expected, msg=f"{kind} {normalize}")

    def test_points_spots_and_suns(self):
        sphere = 'def SphereLight "l" { float inputs:intensity = 3\nfloat inputs:radius = 0.25\n%s }\n' + CAMERA
        root, _ = self.convert(sphere % (TURNED + "bool treatAsPoint = 1\n"))
        self.assertAlmostEqual(self.numbers(root, "emitter/rgb")[0], 3 * math.pi * 0.25, places=5)
        shaping = 'def SphereLight "l" ( prepend apiSchemas = ["ShapingAPI"] ) { float inputs:intensity = 3\n'
        shaping += "float inputs:shaping:cone:angle = 30\nfloat inputs:shaping:cone:softness = 0.5\n"
        root, said = self.convert(shaping + TURNED + "}\n" + CAMERA)
        self.assertEqual(root.find("emitter").get("type"), "spot")
        self.assertEqual([n.get("value") for n in root.findall("emitter/float")], ["30", "15"])
        self.assertIn("note: cone of a light", said)
        # A sun of one degree that gives 2 lux straight down, and a delta light of as much.
        for angle in (1, 0):
            sun = f'def DistantLight "l" {{ float inputs:angle = {angle}\nfloat inputs:intensity = 2\n'
            sun += "bool inputs:normalize = 1\nfloat xformOp:rotateX = -90\n"
            sun += 'uniform token[] xformOpOrder = ["xformOp:rotateX"] }\n'
            self.convert(sun + CAMERA + FLOOR % "", options=["--width", 4, "--spp", 16])
            centre = self.pixels()[1][1]
            self.assertAlmostEqual(centre[1], 0.5 * 2 / math.pi, delta=0.005, msg=f"angle {angle}")

    def test_windows_of_cameras(self):
        """The window of an aperture moved by a quarter to the right: what is on the axis is a quarter to the left."""
        dome = 'def DomeLight "l" { float inputs:intensity = 1 }\n'
        small = 'def Mesh "dot" { point3f[] points = [(-.1, 0, -.1), (-.1, 0, .1), (.1, 0, .1), (.1, 0, -.1)]\n'
        small += 'int[] faceVertexCounts = [4]\nint[] faceVertexIndices = [0, 1, 2, 3]\n'
        small += "color3f[] primvars:displayColor = [(0, 0, 0)] }\n"
        for camera in (CAMERA, CAMERA.replace("float focalLength = 50", 'token projection = "orthographic"')):
            self.convert(dome + camera + small, options=["--width", 20])
            rows = self.pixels(64)
            dark = [(x, y) for y, row in enumerate(rows) for x, pixel in enumerate(row) if pixel[1] < 0.5]
            self.assertTrue(dark)
            middle = [sum(point[k] for point in dark) / len(dark) for k in (0, 1)]
            # Offsets of 5 and 2 of an aperture of 20, of 20 pixels: from (9.5, 9.5) by (-5, +2).
            self.assertAlmostEqual(middle[0], 4.5, delta=0.6)
            self.assertAlmostEqual(middle[1], 11.5, delta=0.6)
        lens = "float fStop = 2\nfloat focusDistance = 4\nfloat focalLength"
        root, _ = self.convert(dome + CAMERA.replace("float focalLength", lens))
        self.assertEqual(root.find("sensor").get("type"), "thinlens")
        lens = {n.get("name"): float(n.get("value")) for n in root.findall("sensor/float")}
        self.assertAlmostEqual(lens["aperture_radius"], 5 / 4)
        self.assertAlmostEqual(lens["fov"], math.degrees(2 * math.atan(0.2)), places=4)

    def test_notes(self):
        """What is broken or left out is said, and the rest is written."""
        mesh = FLOOR % "point3f[] points.timeSamples = { 3: [(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)] }\n"
        mesh += 'def Mesh "empty" { }\ndef PointInstancer "many" { rel prototypes = </nothing>\n'
        mesh += "int[] protoIndices = [0]\npoint3f[] positions = [(0, 0, 0)]\n}\n"
        mesh += 'def DomeLight "l" { asset inputs:texture:file = @none.exr@ }\n'
        mesh += 'def RectLight "r" { rel collection:lightLink:excludes = </floor> }\n'
        mesh = mesh.replace("  %s", "").replace('(interpolation = "faceVarying")', '(interpolation = "vertex")')
        root, said = self.convert(mesh.replace("(1, 1), (0, 1)]", "(1, 1)]"))
        for note in (
            "mesh without faces, or with indices that do not fit: /empty",
            "PointInstancer of a prototype that is not there: left out: /many",
            "normals or a primvar of fewer values than the mesh needs: left out: /floor",
            "image none.exr: not found, its fallback is taken: /l",
            "links of a light: it reaches all: /r",
            "no camera: one that sees all: /",
        ):
            self.assertIn("note: " + note, said)
        self.assertEqual([s.get("type") for s in root.findall("shape")], ["ply", "rectangle"])

    def test_domes(self):
        """Four colours by quarters of longitude, from pi to -pi, dark below; poles by OpenEXR and by poleAxis."""
        colors = [(255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 0)]
        row = lambda bright: [part * bright // 4 for x in range(64) for part in colors[x // 16]]
        with open(self.path("sky.png"), "wb") as file:
            file.write(png(64, 32, [row(4)] * 16 + [row(1)] * 16))
        for kind, up, turn, quarter in [  # the camera's rotateXYZ
            ("DomeLight", "Y", (0, -45, 0), 0),  # it looks between +x and -z: longitude 3/4 pi
            ("DomeLight", "Z", (0, 135, 0), 2),  # between -x and +z; the axis upwards does not matter
            ("DomeLight_1", "Z", (90, 0, -135), 1),  # between +x and -y: 1/4 pi
        ]:
            stage = f'def {kind} "l" {{ asset inputs:texture:file = @sky.png@ }}\n' + CAMERA
            stage = stage.replace("double3 xformOp:translate = (0, 5, 0)", f"float3 xformOp:rotateXYZ = {turn}")
            stage = stage.replace('["xformOp:translate", "xformOp:rotateX"]', '["xformOp:rotateXYZ"]')
            self.convert(stage.replace("Offset = 5", "Offset = 0"), options=["--width", 6], up=up)
            picture = self.pixels(64)
            for y, bright in ((0, 1), (5, 0.051)):  # 63 of 255 by the sRGB curve
                for channel, part in enumerate(colors[quarter]):
                    mean = sum(pixel[channel] for pixel in picture[y]) / 6
                    noise = 0.1 * bright + 0.005
                    self.assertAlmostEqual(mean, bright * part / 255, delta=noise, msg=f"{kind} {up} {turn} {y}")

    def test_textures(self):
        """A packed image, its channels and its transform; out of a .usdz."""
        rows = [[200, 10, 40] + [100, 20, 50], [50, 30, 60] + [25, 250, 70]]
        inputs = "color3f inputs:diffuseColor.connect = </m/t.outputs:rgb>\nfloat inputs:ior = 1\n"
        inputs += "float inputs:roughness.connect = </m/t.outputs:g>\nfloat inputs:opacityThreshold = 0.5\n"
        bound = 'rel material:binding = </m>\n'
        floor = FLOOR.replace('"floor" {', '"floor" ( prepend apiSchemas = ["MaterialBindingAPI"] ) {') % bound
        stage = 'def DomeLight "l" { float inputs:intensity = 1 }\n' + PREVIEW % (inputs, "a/packed.png")
        stage += floor + CAMERA.replace("Offset = 5", "Offset = 0").replace("Offset = 2", "Offset = 0")
        with open(self.path("root.usda"), "w") as file:
            file.write('#usda 1.0\n( upAxis = "Y" )\n' + stage.replace(" }", "\n}"))
        os.mkdir(self.path("a"))
        with open(self.path("a/packed.png"), "wb") as file:
            file.write(png(2, 2, rows))
        pack = "import sys; from pxr import UsdUtils; UsdUtils.CreateNewUsdzPackage(*sys.argv[1:])"
        subprocess.run([PYTHON, "-c", pack, self.path("root.usda"), self.path("scene.usdz")], check=True)
        os.remove(self.path("a/packed.png"))
        root, _ = self.convert(None, "scene.usdz", ["--width", 8])
        names = [n.get("value") for n in root.findall(".//texture/string[@name='filename']")]
        for name in names:
            self.assertTrue(os.path.isfile(self.path("out/" + name)), name)
        steps = [step.tag for step in root.find(".//texture/transform")]
        self.assertEqual(steps, ["scale", "translate", "scale", "rotate", "translate", "scale", "translate"])
        # (s, t), which go right and up in the picture, become (1 - t, 2 s). The reflectance has no sRGB curve.
        picture = self.pixels(64)
        for y, x, red in [(0, 0, 50), (0, 7, 200), (7, 0, 25), (7, 7, 100)]:
            self.assertAlmostEqual(picture[y][x][0] / (red / 255), 1, delta=0.3, msg=f"{x} {y}")

    def test_instances_share_a_group(self):
        stage = """
class "proto" { def Sphere "ball" { double radius = 0.1
    color3f[] primvars:displayColor = [(0.1, 0.2, 0.3)]
  }
  def Cube "hidden" { token visibility = "invisible"
  }
  def Cube "guide" { uniform token purpose = "guide"
  }
}
def "a" ( instanceable = true
  prepend references = </proto> ) { }
def Xform "b" ( instanceable = true
  prepend references = </proto> ) { double3 xformOp:translate = (1, 0, 0)
  uniform token[] xformOpOrder = ["xformOp:translate"]
}
def PointInstancer "many" { rel prototypes = </many/cone>
  int[] protoIndices = [0, 0, 0]
  point3f[] positions = [(0, 1, 0), (0, 2, 0), (0, 3, 0)]
  int64[] invisibleIds = [1]
  def Cone "cone" { double radius = 0.2
  }
}
def BasisCurves "curve" { }
"""
        root, said = self.convert(stage + CAMERA)
        kinds = [shape.get("type") for shape in root.findall("shape")]
        self.assertEqual(kinds.count("shapegroup"), 2)
        self.assertEqual(kinds.count("instance"), 4)
        self.assertEqual([s.get("type") for s in root.findall("shape[@type='shapegroup']/shape")], ["sphere", "ply"])
        places = [self.numbers(s, "transform/matrix")[3:12:4] for s in root.findall("shape[@type='instance']")]
        self.assertEqual(places, [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 3, 0]])
        self.assertIn("note: BasisCurves: left out: /curve", said)
        self.assertIn("note: no light", said)

    def test_subsets_and_fronts(self):
        """Two quads, one of a subset that glows; left-handed, so that it shines up from indices that turn about -y."""
        stage = PREVIEW % ("color3f inputs:emissiveColor = (0.8, 0.4, 0.2)\n", "none.png")
        stage += 'def Mesh "two" { uniform token subdivisionScheme = "none"\nuniform token orientation = "leftHanded"\n'
        stage += "point3f[] points = [(-1,0,-1),(0,0,-1),(1,0,-1),(-1,0,1),(0,0,1),(1,0,1)]\n"
        stage += "int[] faceVertexCounts = [4, 4]\nint[] faceVertexIndices = [0,1,4,3, 1,2,5,4]\n"
        stage += 'def GeomSubset "right" ( prepend apiSchemas = ["MaterialBindingAPI"] ) {\n'
        stage += 'uniform token elementType = "face"\nuniform token familyName = "materialBind"\nint[] indices = [1]\n'
        stage += "rel material:binding = </m>\n }\n}\n"
        root, _ = self.convert(stage + CAMERA.replace("Offset = 5", "Offset = 0"), options=["--width", 8])
        self.assertEqual(len(root.findall("shape[@type='ply']")), 2)
        picture = self.pixels(64)
        glow = [picture[y][x] for y in range(1, 7) for x in range(5, 8)]
        for channel, expected in enumerate((0.8, 0.4, 0.2)):
            mean = sum(pixel[channel] for pixel in glow) / len(glow)
            self.assertAlmostEqual(mean, expected, delta=0.02 * expected, msg=f"channel {channel}")
        self.assertLess(picture[4][1][0], 0.01)


if __name__ == "__main__":
    if subprocess.run([PYTHON, "-c", "import numpy, pxr, PIL"], stderr=subprocess.DEVNULL).returncode:
        print(f"skipped: {PYTHON} has no pxr, numpy or PIL: pip install usd-core numpy pillow")
        print("VITRAIL_USD_PYTHON names another Python")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
