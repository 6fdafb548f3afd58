# SPDX-License-Identifier: Apache-2.0
"""appearance.xml: the same room for what Mitsuba 3 alone can say."""

import layout


def value(kind, name, text):
    return f'<{kind} name="{name}" value="{text}"/>'


def number(name, text):
    return value("float", name, text)


def rgb(name, *color):
    return value("rgb", name, " ".join(map(str, color)))


def nested(tag, kind, *content, name=None, id=None):
    attributes = "".join(f' {k}="{v}"' for k, v in (("id", id), ("name", name)) if v)
    return f'<{tag} type="{kind}"{attributes}>' + " ".join(content) + f"</{tag}>"


def to_world(*steps, name="to_world"):
    return f'<transform name="{name}">' + " ".join(steps) + "</transform>"


def triple(tag, x, y, z):
    return f'<{tag} x="{x:g}" y="{y:g}" z="{z:g}"/>'


def bitmap(name, file, u=1, v=1, *more, raw=False):
    """Mitsuba's images hang from v = 0: a negative v stands them up."""
    uv = to_world(f'<scale x="{u}" y="{v}"/>', name="to_uv")
    flag = [value("boolean", "raw", "true")] if raw else []
    file = value("string", "filename", f"textures/{file}")
    return nested("texture", "bitmap", file, uv, *flag, *more, name=name)


def bsdf(kind, *content):
    return nested("bsdf", kind, *content)


def two_sided(*content):
    return bsdf("twosided", *content)


def grid(name, file, place, half):
    lower = [p - h for p, h in zip(place, half)]
    placed = to_world(triple("scale", *(2 * h for h in half)), triple("translate", *lower))
    return nested("volume", "gridvolume", value("string", "filename", file), placed, name=name)


def header(width, height, spp):
    origin, target = (", ".join(map(str, p)) for p in (layout.EYE, layout.TARGET))
    return f"""<?xml version="1.0" encoding="utf-8"?>
<!-- What Mitsuba 3 can say beyond pbrt. Written by generate.py. Licence: Apache-2.0. -->
<scene version="3.0.0">
<integrator type="volpath"><integer name="max_depth" value="7"/><integer name="rr_depth" value="32"/></integrator>
<sensor type="thinlens">
  <string name="fov_axis" value="smaller"/><float name="fov" value="{layout.FOV_DEG}"/>
  <float name="aperture_radius" value="0.004"/><float name="focus_distance" value="6.4"/>
  <transform name="to_world"><lookat origin="{origin}" target="{target}" up="0, 1, 0"/></transform>
  <sampler type="independent"><integer name="sample_count" value="{spp}"/></sampler>
  <film type="hdrfilm">
    <integer name="width" value="{width}"/><integer name="height" value="{height}"/>
    <string name="pixel_format" value="rgb"/><rfilter type="tent"/>
  </film>
</sensor>
"""


def shape(mesh, *content, place=(0, 0, 0), size=1.0):
    placed = to_world(triple("scale", size, size, size), triple("translate", *place))
    return nested("shape", "ply", value("string", "filename", f"meshes/{mesh}.ply"), placed, *content) + "\n"


def room():
    tiles = nested(
        "texture",
        "checkerboard",
        rgb("color0", 0.80, 0.78, 0.74),
        rgb("color1", 0.16, 0.20, 0.28),
        to_world('<scale x="6" y="5"/>', name="to_uv"),
        name="reflectance",
    )
    height = bitmap("", "brick-height.png", 6, 5, raw=True)
    floor = bsdf("bumpmap", height, number("scale", 0.05), bsdf("diffuse", tiles))
    back = bsdf(
        "normalmap",
        bitmap("normalmap", "waves-normals.png", 2, 2, raw=True),
        bsdf("diffuse", bitmap("reflectance", "brick.png", 3, -2)),
    )
    mirror = value("string", "wrap_mode", "mirror")
    near = value("string", "filter_type", "nearest")
    clamp = value("string", "wrap_mode", "clamp")
    return "".join(
        [
            shape("floor", two_sided(floor)),
            shape("ceiling", bsdf("diffuse", rgb("reflectance", 0.75, 0.75, 0.75))),
            shape("back", two_sided(back)),
            shape("left", two_sided(bsdf("diffuse", bitmap("reflectance", "plaster.png", 3, 2, mirror)))),
            shape("right", bsdf("diffuse", bitmap("reflectance", "brick.png", 0.8, -0.8))),
            shape("bookcase", bsdf("roughplastic", bitmap("diffuse_reflectance", "wood.png", 3, 1))),
            shape("rug", bsdf("diffuse", bitmap("reflectance", "slide.png", 1, 1, near))),
            shape("picture", bsdf("diffuse", bitmap("reflectance", "painting.png", 1, -1, clamp))),
            shape("window", bsdf("thindielectric", value("string", "int_ior", "bk7"))),
            "".join(
                shape("candlestick", bsdf("roughconductor", value("string", "material", "Al")), place=(x, 0, z))
                for x, z in layout.CANDLESTICKS
            ),
        ]
    )


def aimed(origin, target):
    o, t = (", ".join(map(str, p)) for p in (origin, target))
    return to_world(f'<lookat origin="{o}" target="{t}" up="0, 0, 1"/>')


def lights():
    emitter = lambda kind, *content: nested("emitter", kind, *content)
    black = bsdf("diffuse", rgb("reflectance", 0, 0, 0))
    return "\n".join(
        [
            emitter("envmap", value("string", "filename", "textures/sky-lat-long.hdr"), number("scale", 1.2)),
            emitter("directional", value("vector", "direction", "0.3 -0.5 -0.8"), rgb("irradiance", 0.9, 0.87, 0.8)),
            emitter("point", '<point name="position" x="1.2" y="2.6" z="3.2"/>', rgb("intensity", 2.5, 2.3, 2.1)),
            emitter(
                "spot",
                aimed((-1.2, 3.0, 2.6), (0, 1.2, -0.75)),
                rgb("intensity", 25, 22, 17),
                number("cutoff_angle", 18),
                number("beam_width", 10),
                bitmap("texture", "spots.png"),
            ),
            emitter(
                "projector",
                aimed((0.4, 2.9, 3.2), (0.3, 0, 0.9)),
                bitmap("irradiance", "slide.png"),
                number("scale", 14),
                number("fov", 36),
            ),
            shape("lamp", black, emitter("area", rgb("radiance", 14, 13.2, 12))),
            shape("screen", black, emitter("area", bitmap("radiance", "painting.png", 1, -1))),
            shape("downlight", black, emitter("directionalarea", rgb("radiance", 4, 2.3, 1))),
        ]
    )


def objects():
    """(mesh, contents) of the 27 places, row by row; a function where the contents depend on the place."""
    scalar = lambda name, file: bitmap(name, file, 2, 2, raw=True)
    amber = nested(
        "medium",
        "homogeneous",
        value("spectrum", "sigma_t", "360:15, 550:7, 830:2"),
        rgb("albedo", 0.7, 0.45, 0.3),
        nested("phase", "hg", number("g", 0.5)),
        name="interior",
    )
    fog = nested("medium", "homogeneous", rgb("albedo", 0.9, 0.9, 0.95), number("scale", 8), name="interior")

    def smoke(place):
        half = [0.85 * layout.SIZE, layout.SIZE, 0.85 * layout.SIZE]
        return bsdf("null") + nested(
            "medium",
            "heterogeneous",
            grid("sigma_t", "smoke.vol", place, half),
            grid("albedo", "smoke-albedo.vol", place, half),
            number("scale", 25),
            nested("phase", "hg", number("g", 0.3)),
            name="interior",
        )

    beckmann, ggx = (value("string", "distribution", d) for d in ("beckmann", "ggx"))
    metal = lambda name: value("string", "material", name)
    samples = lambda name, text: value("spectrum", name, text)

    def attribute(name):
        return nested("texture", "mesh_attribute", value("string", "name", name), name="reflectance")

    return [
        # glass and media
        ("sphere", bsdf("dielectric", value("string", "int_ior", "diamond"))),
        ("vase", bsdf("roughdielectric", beckmann, number("alpha_u", 0.05), number("alpha_v", 0.3))),
        ("sphere", bsdf("dielectric", number("int_ior", 1.4)) + amber),
        ("vase", bsdf("dielectric", bitmap("specular_transmittance", "slide.png", 2, 1))),
        ("box", smoke),
        ("sphere", bsdf("null") + fog),
        (
            "sphere",
            bsdf("principled", number("spec_trans", 0.9), number("roughness", 0.15), rgb("base_color", 0.6, 0.8, 0.9)),
        ),
        (
            "vase",
            bsdf(
                "principledthin",
                rgb("base_color", 0.8, 0.7, 0.3),
                number("spec_trans", 0.3),
                number("diff_trans", 1.0),
                number("roughness", 0.3),
                number("sheen", 0.5),
            ),
        ),
        ("sphere", bsdf("thindielectric", number("int_ior", 1.9), rgb("specular_transmittance", 0.9, 0.7, 0.95))),
        # metals and plastics
        ("sphere", bsdf("conductor", metal("none"))),
        ("vase", bsdf("roughconductor", metal("Au"), beckmann, number("alpha", 0.2))),
        ("sphere", bsdf("roughconductor", metal("Ag"), ggx, scalar("alpha_u", "waves.png"), number("alpha_v", 0.05))),
        (
            "box",
            bsdf(
                "conductor",
                samples("eta", "360:0.8, 550:1.4, 830:2.6"),
                samples("k", "360:3.0, 550:4.5, 830:6.0"),
                bitmap("specular_reflectance", "plaster.png"),
            ),
        ),
        ("sphere", bsdf("plastic", rgb("diffuse_reflectance", 0.65, 0.1, 0.08))),
        ("vase", bsdf("plastic", bitmap("diffuse_reflectance", "slide.png"), value("boolean", "nonlinear", "true"))),
        ("sphere", bsdf("roughplastic", rgb("diffuse_reflectance", 0.1, 0.3, 0.6), number("alpha", 0.15), ggx)),
        (
            "vase",
            bsdf(
                "principled",
                rgb("base_color", 0.9, 0.6, 0.3),
                number("metallic", 1.0),
                number("anisotropic", 0.8),
                bitmap("roughness", "waves.png", 1, 1, raw=True),
            ),
        ),
        (
            "sphere",
            bsdf(
                "principled",
                bitmap("base_color", "painting.png", 1, -1),
                number("clearcoat", 1.0),
                number("clearcoat_gloss", 0.9),
                number("sheen", 0.6),
                number("sheen_tint", 0.5),
                number("spec_tint", 0.5),
                number("flatness", 0.4),
            ),
        ),
        # textures and what holds other materials
        ("sphere-colors", bsdf("diffuse", attribute("vertex_color"))),
        ("vase-colors", bsdf("diffuse", attribute("face_color"))),
        ("box", bsdf("bumpmap", bitmap("", "waves.png", 1, 1, raw=True), number("scale", 0.15), bsdf("plastic"))),
        (
            "sphere",
            bsdf(
                "normalmap",
                bitmap("normalmap", "waves-normals.png", 2, 2, raw=True),
                bsdf("roughconductor", metal("Cu"), number("alpha", 0.2)),
            ),
        ),
        (
            "box",
            bsdf(
                "blendbsdf",
                scalar("weight", "spots.png"),
                bsdf("diffuse", rgb("reflectance", 0.1, 0.4, 0.25)),
                bsdf("roughconductor", metal("Au"), number("alpha", 0.1)),
            ),
        ),
        (
            "sphere",
            bsdf("mask", scalar("opacity", "spots.png"), two_sided(bsdf("diffuse", rgb("reflectance", 0.7, 0.3, 0.1)))),
        ),
        (
            "bowl",
            two_sided(
                bsdf("plastic", rgb("diffuse_reflectance", 0.15, 0.25, 0.6)),
                bsdf("diffuse", rgb("reflectance", 0.85, 0.6, 0.2)),
            ),
        ),
        ("vase", bsdf("diffuse", bitmap("reflectance", "rainbow.pfm", 1, 1))),
        ("sphere", bsdf("principled", rgb("base_color", 0.5, 0.15, 0.4), number("roughness", 0.35))),
    ]


def scene_text(width, height, spp):
    text = header(width, height, spp) + room() + lights() + "\n"
    for (mesh, content), (x, y) in zip(objects(), layout.places(), strict=True):
        place = (x, y + layout.SIZE + 0.001, layout.DEPTH_Z)
        text += shape(mesh, content(place) if callable(content) else content, place=place, size=layout.SIZE)
    green = two_sided(bsdf("diffuse", rgb("reflectance", 0.2, 0.5, 0.12)))
    leaf = bsdf("mask", bitmap("opacity", "leaf.png", 1, -1, raw=True), green)
    pane = bsdf("principledthin", rgb("base_color", 0.5, 0.7, 0.9), number("spec_trans", 0.8), number("roughness", 0.05))
    text += shape("card", leaf, place=layout.LEAVES) + shape("sheet", pane, place=layout.PANE)
    return text + "</scene>\n"
