#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes importers/mitsuba/sky_means.inl: what the sky and the sun of Mitsuba's sunsky are on the whole.

Evaluates Mitsuba itself (pip install mitsuba==3.9.1): of the sky the mean radiance of the upper hemisphere, of the
sun the irradiance on a plane across its direction, linear sRGB, W/(m2 sr nm) and W/(m2 nm).
Usage: generate_sky_means.py > importers/mitsuba/sky_means.inl
"""
import numpy as np
import mitsuba as mi

mi.set_variant("llvm_ad_rgb")
TURBIDITIES = (1, 2, 3, 4, 6, 8, 10)
ELEVATIONS = (2, 5, 10, 20, 40, 60, 85)
SUN_RADIUS = np.radians(0.2665)


def evaluate(turbidity, sun, directions, **scales):
    emitter = mi.load_dict({"type": "sunsky", "turbidity": turbidity, "sun_direction": list(map(float, sun)), **scales})
    si = mi.SurfaceInteraction3f()
    si.wi = mi.Vector3f(*(-directions.T))
    return np.array(emitter.eval(si)).mean(1)


def hemisphere(count=300):
    z, angle = np.meshgrid((np.arange(count) + 0.5) / count, (np.arange(2 * count) + 0.5) / count * np.pi)
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(angle), r * np.sin(angle), z], -1).reshape(-1, 3)


def disk(sun, count=60):
    r, angle = np.meshgrid(np.sqrt((np.arange(count) + 0.5) / count) * SUN_RADIUS,
                           (np.arange(count) + 0.5) / count * 2 * np.pi)
    u = np.array([-sun[2], 0, sun[0]])
    v = np.cross(sun, u)
    across = np.cos(angle)[..., None] * u + np.sin(angle)[..., None] * v
    return (np.cos(r)[..., None] * sun + np.sin(r)[..., None] * across).reshape(-1, 3)


print("// SPDX-License-Identifier: Apache-2.0\n// By scripts/generate_sky_means.py from Mitsuba 3.9.1.")
print("// Turbidities %s, then elevations %s of the sun in degrees: the sky's R G B, the sun's." % (TURBIDITIES, ELEVATIONS))
for turbidity in TURBIDITIES:
    for elevation in ELEVATIONS:
        e = np.radians(elevation)
        sun = np.array([np.cos(e), 0, np.sin(e)])
        sky = evaluate(turbidity, sun, hemisphere(), sun_scale=0.0)
        beam = evaluate(turbidity, sun, disk(sun), sky_scale=0.0) * np.pi * SUN_RADIUS**2
        print("{{%s}}," % ", ".join("%.5g" % max(0.0, v) for v in (*sky, *beam)))
