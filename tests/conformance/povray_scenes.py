#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads many POV-Ray scenes and counts what becomes of them: whole, with parts dropped, refused, out of time, crashed.

  tests/conformance/povray_scenes.py [--bin build/release/bin] [--seconds 60] [--out FILE.tsv] [FOLDER]

The folder is by default that of Debian's povray-examples. FILE.tsv gets a line as each scene ends: its name, its
stage, its fate, seconds of processor, peak MB, and why.

A stage is what the scene's own words ask of a reader: 1 the language and simple shapes; 2 differences,
intersections, clipping; 3 text, sweeps, polynomials, height fields, blobs; 4 implicit shapes and questions to objects
while the scene is read.
"""
import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve()
EXAMPLES = pathlib.Path("/usr/share/doc/povray/examples")
STAGES = {
    4: "isosurface parametric julia_fractal trace inside min_extent max_extent",
    3: "text prism lathe sor superellipsoid quadric cubic quartic poly height_field blob bicubic_patch sphere_sweep ovus",
    2: "difference intersection merge inverse clipped_by",
}
Read = collections.namedtuple("Read", "stage fate seconds megabytes why")


def stage_of(scene):
    text = re.sub(r"//[^\n]*|/\*.*?\*/|\"[^\"\n]*\"", " ", scene.read_text(errors="replace"), flags=re.S)
    words = set(re.findall(r"[A-Za-z_]\w*", text))
    return next((stage for stage, asked in STAGES.items() if words & set(asked.split())), 1)


def measured(command, seconds):
    """Its status (None: out of time), what it writes, seconds of processor, peak MB."""
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
    with tempfile.TemporaryFile() as output, tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdout=output, stderr=errors, preexec_fn=limit)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for file in (output, errors):
            file.seek(0)
            texts.append(file.read().decode(errors="replace"))
        late = process.returncode in (-signal.SIGXCPU, -signal.SIGKILL)
        return None if late else process.returncode, texts, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def fate_of(program, scene, seconds):
    """One of whole, parts dropped, refused, out of time, crashed; and why."""
    command = [program, scene, "--json", "--missing", "replace"]
    status, (output, errors), used, peak = measured(command, seconds)
    fate, why = "whole", ""
    if status is None:
        fate = "out of time"
    elif status < 0 or status > 128:
        fate, why = "crashed", f"status {status}"
    elif status != 0:
        fate, why = "refused", (errors.strip().splitlines() or [""])[0]
    else:
        lost = [item["what"] for item in json.loads(output)["not_exact"] if item["fidelity"] == "dropped"]
        if lost:
            fate, why = "parts dropped", "; ".join(dict.fromkeys(lost))
    return Read(stage_of(scene), fate, used, peak, why)


def main():
    parser = argparse.ArgumentParser(description="Counts what becomes of POV-Ray scenes that are read.")
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=EXAMPLES)
    parser.add_argument("--bin", type=pathlib.Path, default=HERE.parents[2] / "build/release/bin")
    parser.add_argument("--seconds", type=int, default=60, help="of processor, of a scene")
    parser.add_argument("--out", type=pathlib.Path, help="a line a scene")
    parser.add_argument("-j", "--jobs", type=int, default=2)
    options = parser.parse_args()
    scenes = sorted(options.folder.rglob("*.pov"))
    if not scenes:
        sys.exit(f"{options.folder}: no scenes; Debian has some in povray-examples")
    program = options.bin / "vitrail-inspect"
    out = options.out.open("w") if options.out else None

    def read(scene):
        r = fate_of(program, scene, options.seconds)
        if out:
            name = scene.relative_to(options.folder)
            out.write(f"{name}\t{r.stage}\t{r.fate}\t{r.seconds:.2f}\t{r.megabytes:.0f}\t{r.why}\n")
            out.flush()
        return r

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        reads = list(pool.map(read, scenes))
    for fate, count in collections.Counter(r.fate for r in reads).most_common():
        stages = collections.Counter(r.stage for r in reads if r.fate == fate)
        print(f"{count:5} of {len(scenes)}  {fate}; by stage " + ", ".join(f"{s}: {stages[s]}" for s in (1, 2, 3, 4)))
    causes = collections.Counter(
        re.sub(r"^\S+?:\d+:\d+: |[\"'].*?[\"']|\d+", "…", r.why) for r in reads if r.fate == "refused"
    )
    for cause, count in causes.most_common(30):
        print(f"{count:5}  {cause}")
    parts = collections.Counter(part for r in reads if r.fate == "parts dropped" for part in r.why.split("; "))
    for part, count in parts.most_common(30):
        print(f"{count:5}  dropped: {part}")
    for r, scene in sorted(zip(reads, scenes), reverse=True, key=lambda pair: pair[0].seconds)[:10]:
        print(f"{r.seconds:8.2f} s {r.megabytes:6.0f} MB  {scene.relative_to(options.folder)}")


if __name__ == "__main__":
    main()
