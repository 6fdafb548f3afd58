#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Asks Mitsuba 3 what it makes of a scene file.

mitsuba_oracle.py REQUEST.json ANSWER.json

The request: {"scene": file, "variant": name, "queries": [{"op": …}, …]}; the answer: {"results": […],
"warnings": […]}, or {"error": message} where Mitsuba refuses the scene. Spectra are asked for at four wavelengths
in nm (an "rgb" variant answers r, g, b).
"""
import json
import sys

import mitsuba as mi
import numpy as np


def numbers(x):
    return [float(v) for v in np.array(x).ravel()]


def ray_of(query):
    ray = mi.Ray3f(query["o"], query["d"])
    if mi.is_spectral:
        ray.wavelengths = query["wavelengths"]
    return ray


def hit(scene, query):
    """Where a ray meets the scene, its normals, uv, the emission towards the ray's origin."""
    si = scene.ray_intersect(ray_of(query))
    if not si.is_valid():
        return {"valid": False}
    emitter = si.emitter(scene)
    media = lambda d: [m.id() if m else "" for m in [si.target_medium(mi.Vector3f(d))]][0]
    behind = -np.array(si.n)
    return {
        "valid": True, "t": float(si.t), "p": numbers(si.p), "n": numbers(si.n), "shading_n": numbers(si.sh_frame.n),
        "uv": numbers(si.uv), "emission": numbers(emitter.eval(si)) if emitter else [],
        "interior": media(behind) if si.is_medium_transition() else "",
        "exterior": media(-behind) if si.is_medium_transition() else "",
    }


def bsdf(scene, query):
    """BSDF times cosine for light that goes on in the world's direction `wo`; the chance to go straight on."""
    si = scene.ray_intersect(ray_of(query))
    material = si.bsdf()
    value = material.eval(mi.BSDFContext(), si, si.to_local(mi.Vector3f(query["wo"])))
    return {"value": numbers(value), "through": numbers(material.eval_null_transmission(si))}


def sampled(scene, query):
    """Where a specular BSDF sends light, and its weight."""
    si = scene.ray_intersect(ray_of(query))
    bs, weight = si.bsdf().sample(mi.BSDFContext(), si, query["u"], [0.5, 0.5])
    return {"wo": numbers(si.to_world(bs.wo)), "weight": numbers(weight), "eta": float(bs.eta)}


def light(scene, query):
    """What an emitter sends to a point: the direction towards it and the irradiance across that."""
    si = mi.SurfaceInteraction3f()
    si.p = query["p"]
    if mi.is_spectral:
        si.wavelengths = query["wavelengths"]
    ds, weight = scene.emitters()[query["index"]].sample_direction(si, [0.5, 0.5])
    return {"d": numbers(ds.d), "weight": numbers(weight)}


def environment(scene, query):
    si = mi.SurfaceInteraction3f()
    si.wi = -mi.Vector3f(query["d"])
    if mi.is_spectral:
        si.wavelengths = query["wavelengths"]
    return numbers(scene.environment().eval(si))


def camera(scene, query):
    sensor, answers = scene.sensors()[0], []
    for point in query["points"]:
        ray, _ = sensor.sample_ray(0, 0.5, point, query.get("aperture", [0.5, 0.5]))
        answers.append({"o": numbers(ray.o), "d": numbers(ray.d)})
    return answers


def shapes(scene, _):
    boxes = []
    for shape in scene.shapes():
        box = shape.bbox()
        boxes.append({"id": shape.id(), "min": numbers(box.min), "max": numbers(box.max)})
    return boxes


def medium(scene, query):
    """σs, σt and the phase function's value for light that goes straight on, inside of shape `index`."""
    inside = scene.shapes()[query["index"]].interior_medium()
    mei = mi.MediumInteraction3f()
    mei.p = query["p"]
    if mi.is_spectral:
        mei.wavelengths = query["wavelengths"]
    scattering, _, extinction = inside.get_scattering_coefficients(mei)
    mei.sh_frame = mi.Frame3f([0, 0, 1])
    mei.wi = [0, 0, -1]
    value, _ = inside.phase_function().eval_pdf(mi.PhaseFunctionContext(None), mei, [0, 0, 1])
    return {"sigma_s": numbers(scattering), "sigma_t": numbers(extinction), "forward": numbers(value)}


def film(scene, _):
    f = scene.sensors()[0].film()
    return {"size": numbers(f.size()), "crop_offset": numbers(f.crop_offset()), "crop_size": numbers(f.crop_size()),
            "filter": str(f.rfilter()), "samples": scene.sensors()[0].sampler().sample_count(),
            "integrator": str(scene.integrator())}


def render(scene, query):
    picture = np.array(mi.render(scene, spp=query["spp"], seed=1))
    return {"shape": list(picture.shape), "mean": numbers(picture.reshape(-1, picture.shape[-1]).mean(0)),
            "pixels": numbers(picture)}


def describe(scene, _):
    return str(scene)


def main():
    with open(sys.argv[1]) as file:
        request = json.load(file)
    mi.set_variant(request["variant"])
    warnings = []

    class Listener(mi.Appender):
        def append(self, level, text):
            warnings.append(text)

        def log_progress(self, *_):
            pass

    mi.logger().clear_appenders()
    mi.logger().add_appender(Listener())
    mi.set_log_level(mi.LogLevel.Warn)
    operations = {f.__name__: f for f in
                  (hit, bsdf, sampled, light, environment, camera, shapes, medium, film, render, describe)}
    try:
        scene = mi.load_file(request["scene"])
        answer = {"results": [operations[q["op"]](scene, q) for q in request["queries"]], "warnings": warnings}
    except RuntimeError as error:
        answer = {"error": str(error), "warnings": warnings}
    with open(sys.argv[2], "w") as file:
        json.dump(answer, file)


if __name__ == "__main__":
    main()
