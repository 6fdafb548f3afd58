#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads many POV-Ray scenes and counts what becomes of them: whole, with parts dropped, refused, out of time, crashed.

  tests/conformance/povray_scenes.py [--bin build/release/bin] [--seconds 60] [--out FILE.tsv] [FOLDER]

The folder is by default that of Debian's povray-examples. A line of FILE.tsv is a scene, its fate, its first message.
"""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve()
EXAMPLES = pathlib.Path("/usr/share/doc/povray/examples")


def fate_of(program, scene, seconds):
    """One of whole, parts dropped, refused, out of time, crashed; and why."""
    command = [program, scene, "--json", "--missing", "replace"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=seconds)
    except subprocess.TimeoutExpired:
        return "out of time", ""
    if done.returncode < 0 or done.returncode > 128:
        return "crashed", f"status {done.returncode}"
    if done.returncode != 0:
        return "refused", (done.stderr.strip().splitlines() or [""])[0]
    lost = [item["what"] for item in json.loads(done.stdout)["not_exact"] if item["fidelity"] == "dropped"]
    return ("parts dropped", lost[0]) if lost else ("whole", "")


def main():
    parser = argparse.ArgumentParser(description="Counts what becomes of POV-Ray scenes that are read.")
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=EXAMPLES)
    parser.add_argument("--bin", type=pathlib.Path, default=HERE.parents[2] / "build/release/bin")
    parser.add_argument("--seconds", type=float, default=60, help="of a scene")
    parser.add_argument("--out", type=pathlib.Path, help="a line a scene")
    parser.add_argument("-j", "--jobs", type=int, default=2)
    options = parser.parse_args()
    scenes = sorted(options.folder.rglob("*.pov"))
    if not scenes:
        sys.exit(f"{options.folder}: no scenes; Debian has some in povray-examples")
    program = options.bin / "vitrail-inspect"
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        fates = list(pool.map(lambda scene: fate_of(program, scene, options.seconds), scenes))
    if options.out:
        lines = [f"{scene.relative_to(options.folder)}\t{fate}\t{why}\n" for scene, (fate, why) in zip(scenes, fates)]
        options.out.write_text("".join(lines))
    for fate, count in collections.Counter(fate for fate, _ in fates).most_common():
        print(f"{count:5} of {len(scenes)}  {fate}")
    causes = collections.Counter(re.sub(r"^\S+?:\d+:\d+: |[\"'].*?[\"']|\d+", "…", why) for fate, why in fates if fate == "refused")
    for cause, count in causes.most_common(30):
        print(f"{count:5}  {cause}")
    parts = collections.Counter(why for fate, why in fates if fate == "parts dropped")
    for part, count in parts.most_common(30):
        print(f"{count:5}  dropped first: {part}")


if __name__ == "__main__":
    main()
