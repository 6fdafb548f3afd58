#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How many scenes of folders `vitrail convert --check=peer` finds the same, told or different, by the programs of both formats.

  tests/conformance/peer_counts.py FOLDER... --from .pbrt --to .pbrt [--bin build/release/bin] [--out counts.tsv] [--seconds 300]

A scene is a file with that ending that is no part of another one (a .pbrt has a Camera or a WorldBegin, an .xml a sensor). Rows of the
.tsv: outcome, exit status, file, what was said last. They are kept: the same command goes on where it was stopped. pbrt, povray, and a
Python with Mitsuba are those on the path.

  same               the programs show one picture
  told               the same, with items approximated or dropped
  different          they show two pictures (exit status 1), with nothing told
  told, different    two pictures, with items approximated or dropped
  refused            not read, not written, or a program does not render it
"""
import argparse
import collections
import pathlib
import re
import subprocess
import tempfile


def is_scene(file):
    text = file.read_text(errors="replace")
    if file.suffix == ".pbrt":
        return "WorldBegin" in text and "Camera" in text
    return file.suffix != ".xml" or ("<scene" in text and "<sensor" in text)


def outcome(status, said):
    if status in (0, 1) and not re.search(r"renders it|does not render|is not on the path", said):
        told = re.search(r"(?<!\d)[1-9]\d* (?:approximated|dropped)", said)
        return {(0, False): "same", (0, True): "told", (1, False): "different", (1, True): "told, different"}[status, bool(told)]
    return "refused"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--from", dest="suffix", default=".pbrt")
    parser.add_argument("--to", default=".pbrt")
    parser.add_argument("--bin", type=pathlib.Path, default=pathlib.Path("build/release/bin"))
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("peer_counts.tsv"))
    parser.add_argument("--seconds", type=float, default=300)
    options = parser.parse_args()
    done = {line.split("\t")[2] for line in options.out.read_text().splitlines()} if options.out.exists() else set()
    files = sorted(f for folder in options.folders for f in folder.rglob("*" + options.suffix) if is_scene(f))
    with open(options.out, "a") as out:
        for file in files:
            if str(file) in done:
                continue
            with tempfile.TemporaryDirectory() as folder:
                command = [options.bin / "vitrail", "convert", file, "-o", pathlib.Path(folder) / ("out" + options.to), "--check=peer"]
                try:
                    run = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=options.seconds)
                    status, said = run.returncode, run.stdout + run.stderr
                except subprocess.TimeoutExpired:
                    status, said = 124, f"more than {options.seconds:.0f} s"
            last = " | ".join(said.strip().splitlines()[-4:]).replace("\t", " ").replace(folder, "")
            print(outcome(status, said), status, file, last, sep="\t", file=out, flush=True)
    counts = collections.Counter(line.split("\t")[0] for line in options.out.read_text().splitlines())
    print(f"{sum(counts.values())} scenes: " + ", ".join(f"{n} {what}" for what, n in counts.most_common()))


if __name__ == "__main__":
    main()
