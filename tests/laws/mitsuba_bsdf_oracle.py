#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Asks Mitsuba 3 for values of its BSDFs.

mitsuba_bsdf_oracle.py REQUEST.json ANSWER.json

The request: [{"bsdf": dictionary for load_dict, "pairs": [[out x, y, z, in x, y, z], …]}, …] in the local frame, with
"wavelengths" (four, nm) where it depends on them; the answer, for each: {"values": [BSDF·cos of the first channel, …], "pdfs": […], "specular": [[in z, weight], …] of sampling
with the first and the last number of [0, 1), for each pair's `out`}.
"""
import json
import sys

import mitsuba as mi


def main():
    with open(sys.argv[1]) as file:
        request = json.load(file)
    answer = []
    for query in request:
        mi.set_variant("scalar_spectral" if "wavelengths" in query else "scalar_rgb")
        context = mi.BSDFContext()
        bsdf = mi.load_dict(query["bsdf"])
        values, pdfs, specular = [], [], []
        for pair in query["pairs"]:
            si = mi.SurfaceInteraction3f()
            si.t = 1
            si.wi = pair[:3]
            if "wavelengths" in query:
                si.wavelengths = query["wavelengths"]
            wo = mi.Vector3f(pair[3:])
            values.append(float(bsdf.eval(context, si, wo)[0]))
            pdfs.append(float(bsdf.pdf(context, si, wo)))
            ends = []
            for u in (0.0, 0.9999999):
                bs, weight = bsdf.sample(context, si, u, [0.5, 0.5])
                ends.append([float(bs.wo.z), float(weight[0])])
            specular.append(ends)
        answer.append({"values": values, "pdfs": pdfs, "specular": specular})
    with open(sys.argv[2], "w") as file:
        json.dump(answer, file)


if __name__ == "__main__":
    main()
