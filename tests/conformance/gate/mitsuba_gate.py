#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Loads scene files with Mitsuba 3 and renders them: the means of blocks of pixels, one set a seed.

mitsuba_gate.py REQUEST.json ANSWERS.jsonl

The request: {"variant": name, "blocks": b, "samples": n, "seeds": k, "scenes": [file, …]}. The answers are one line
a scene, in order, written as soon as they are known: {"error": message} where Mitsuba refuses the scene, else
{"warnings": […], "means": [[X, Y, Z of each of b × b blocks by rows, …] of each seed]}, "means" empty where k is 0.
"""
import json
import sys

import mitsuba as mi
import numpy as np

XYZ_OF_SRGB = np.array([[0.412453, 0.357580, 0.180423], [0.212671, 0.715160, 0.072169], [0.019334, 0.119193, 0.950227]])


class Listener(mi.Appender):
    def __init__(self):
        super().__init__()
        self.heard = []

    def append(self, level, text):
        self.heard.append(text)

    def log_progress(self, *_):
        pass


def block_means(picture, blocks):
    height, width, _ = picture.shape
    parts = picture[:, :, :3].reshape(blocks, height // blocks, blocks, width // blocks, 3).mean((1, 3))
    return (parts.reshape(-1, 3) @ XYZ_OF_SRGB.T).ravel().tolist()


def answer_of(file, request, listener):
    listener.heard = []
    try:
        scene = mi.load_file(file)
        means = [
            block_means(np.array(mi.render(scene, spp=request["samples"], seed=seed)), request["blocks"])
            for seed in range(request["seeds"])
        ]
        if not np.isfinite(means).all():
            return {"error": "its picture has values that are no numbers"}
        return {"warnings": listener.heard, "means": means}
    except RuntimeError as error:
        return {"error": str(error)}


def main():
    with open(sys.argv[1]) as file:
        request = json.load(file)
    mi.set_variant(request["variant"])
    listener = Listener()
    mi.logger().clear_appenders()
    mi.logger().add_appender(listener)
    mi.set_log_level(mi.LogLevel.Warn)
    with open(sys.argv[2], "w") as out:
        for scene in request["scenes"]:
            print(json.dumps(answer_of(scene, request, listener)), file=out, flush=True)


if __name__ == "__main__":
    main()
