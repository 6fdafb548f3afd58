# SPDX-License-Identifier: Apache-2.0
"""Writes tests/tracer/bsdf/principled_reference.inc: values of Mitsuba 3's `principled` and `principledthin`.

    pip install mitsuba==3.9.1
    python3 scripts/generate_principled_reference.py > tests/tracer/bsdf/principled_reference.inc

A row: thin, base colour (r, g, b), its luminance, eta, roughness, anisotropic, metallic, spec_trans, spec_tint, sheen,
sheen_tint, flatness, clearcoat, clearcoat_gloss, diff_trans, out (x, y, z), in (x, y, z), f*cos (r, g, b).
"""
import random
import mitsuba as mi

mi.set_variant("scalar_rgb")
random.seed(20261121)
NAMES = ["roughness", "anisotropic", "metallic", "spec_trans", "spec_tint", "sheen", "sheen_tint", "flatness",
         "clearcoat", "clearcoat_gloss", "diff_trans"]
SOLID_ONLY, THIN_ONLY = {"metallic", "clearcoat", "clearcoat_gloss"}, {"diff_trans"}


def direction(side):
    z = random.random() ** random.choice([1, 3])
    v = mi.warp.square_to_uniform_sphere([random.random(), random.random()])
    v = mi.Vector3f(v.x, v.y, 0) / (v.x * v.x + v.y * v.y) ** 0.5 * (1 - z * z) ** 0.5
    return mi.Vector3f(v.x, v.y, side * max(z, 1e-3))


def parameters(thin):
    values = {}
    for name in NAMES:
        unused = name in (SOLID_ONLY if thin else THIN_ONLY)
        values[name] = 0 if unused or random.random() < 0.35 else round(random.random(), 3)
    values["roughness"] = round(random.choice([random.random(), 0.15, 0.4, 1]), 3)
    values["diff_trans"] *= 2
    if random.random() < 0.2 and not thin:
        values["spec_trans"] = 1
    return values


def toward_peak(out, bsdf, si, context, rows_side):
    """Near where the model samples, so that narrow lobes are met."""
    sampled, _ = bsdf.sample(context, si, random.random(), [random.random(), random.random()])
    return sampled.wo if sampled.pdf > 0 else direction(rows_side)


def listed(numbers):
    return ", ".join(f"{x:.7g}" for x in numbers)


def row(thin):
    values = parameters(thin)
    color = [round(random.random(), 3) for _ in range(3)]
    eta = round(random.choice([1.1, 1.33, 1.5, 2, random.uniform(1.05, 2.5)]), 3)
    used = {k: v for k, v in values.items() if k not in (SOLID_ONLY if thin else THIN_ONLY)}
    bsdf = mi.load_dict({"type": "principledthin" if thin else "principled",
                         "base_color": {"type": "rgb", "value": color}, "eta": eta, **used})
    si = mi.SurfaceInteraction3f()
    si.sh_frame = mi.Frame3f([0, 0, 1])
    two_sided = thin or values["spec_trans"] > 0
    si.wi = direction(random.choice([1, -1]) if two_sided else 1)
    context = mi.BSDFContext()
    side = random.choice([1, -1]) if two_sided else 1
    other = toward_peak(si.wi, bsdf, si, context, side) if random.random() < 0.6 else direction(side)
    value = bsdf.eval(context, si, other)
    numbers = [*color, mi.luminance(mi.Color3f(color)), eta, *(values[n] for n in NAMES)]
    return "{" + ", ".join([str(int(thin)), listed(numbers), *("{" + listed(v) + "}" for v in (si.wi, other, value))]) + "},"


print("// SPDX-" "License-Identifier: Apache-2.0")
print("// Written by scripts/generate_principled_reference.py: change that, not this.")
for thin in (False, True):
    for _ in range(200):
        print(row(thin))
