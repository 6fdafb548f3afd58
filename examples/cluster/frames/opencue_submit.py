#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Submits the frames of a list to OpenCue: a layer of which each frame is one of the list.

    pip install opencue-pyoutline
    opencue_submit.py room.vit --frames day.txt --range 1-100 -o /shared/day%04d.png [--show SHOW --shot SHOT] [-- --spp 1024 …]

The words after -- go to `vitrail render`. --print shows the job in place of submitting it.
"""
import argparse
import os
import shlex
import sys

import outline
import outline.backend.cue
import outline.cuerun
from outline.modules.shell import Shell


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bundle", help="what vitrail partition wrote")
    parser.add_argument("--frames", required=True, help="a line of options for each frame")
    parser.add_argument("--range", required=True, help="numbers of lines: 1-100, 1-30,47 or 1-100x2")
    parser.add_argument("-o", "--output", required=True, help="the pictures, with a place for the number: day%%04d.png")
    parser.add_argument("--name", default="vitrail")
    parser.add_argument("--show", default=os.environ.get("SHOW", "testing"))
    parser.add_argument("--shot", default=os.environ.get("SHOT", "default"))
    parser.add_argument("--cores", type=float, default=1, help="that a frame reserves")
    parser.add_argument("--memory", default="2g", help="that a frame reserves")
    parser.add_argument("--print", action="store_true", dest="is_shown")
    arguments, more = sys.argv[1:], []
    if "--" in arguments:
        arguments, more = arguments[:arguments.index("--")], arguments[arguments.index("--") + 1:]
    o = parser.parse_args(arguments)
    job = outline.Outline(o.name, shot=o.shot, show=o.show, user=os.environ.get("USER", "vitrail"))
    words = ["vitrail", "render", o.bundle, "--frames", o.frames, "-o", o.output, "--retries", "2"] + more
    job.add_layer(Shell("render", command=[shlex.quote(word) for word in words] + ["--range", "#IFRAME#"],
                        range=o.range, chunk=1, cores=o.cores, memory=o.memory))
    if o.is_shown:
        print(outline.backend.cue.serialize_simple(outline.cuerun.OutlineLauncher(job)))
    else:
        outline.cuerun.launch(job, use_pycuerun=False)


if __name__ == "__main__":
    main()
