#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A short film of a render whose ranks are all killed, and which goes on when the same command is typed again.

    ./kill_and_resume.py room.vit -o kill-and-resume.gif --spp 64        with Pillow (python3-pil)

Each picture of the film is a checkpoint, developed. The render is killed (KILL, which no program can see coming) where half of its
samples are done, and goes on as one process. In the end its film is compared with one that nobody disturbed.
"""

import argparse
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

MARGIN, LINE = 8, 17  # pixels


class Job:
    def __init__(self, args, folder):
        self.args, self.film, self.pictures = args, folder / "room.film", []
        self.shown = f"vitrail render room.vit -o room.film --spp {args.spp}"

    def command(self, film, *more):
        return [self.args.vitrail, "render", self.args.bundle, "-o", film, "--spp", self.args.spp, "--width", self.args.width,
                "--stats", film.with_suffix(".json"), *more]  # fmt: skip

    def start(self, ranks):
        words = ["mpirun", "-np", str(ranks)] * (ranks > 1) + [*map(str, self.command(self.film, "--checkpoint-every", self.args.every, "--threads", 1))]
        return subprocess.Popen(words, stderr=subprocess.PIPE, text=True, start_new_session=True)

    def run(self, *words):
        return subprocess.run([self.args.vitrail, *words], capture_output=True, text=True)

    def develop(self, film):
        """Returns the picture so far and its samples a pixel; nothing while there is none."""
        picture = film.with_name("so-far.png")
        done, told = self.run("develop", film, "-o", picture), self.run("inspect", film).stdout
        samples = re.search(r"^samples: (\d+)", told, re.MULTILINE)
        if done.returncode != 0 or not samples:
            return None
        image = Image.open(picture).convert("RGB")
        return image, int(samples[1]) / (image.width * image.height)

    def watch(self, process, words, until=float("inf")):
        """Keeps a picture of each checkpoint, until the process ends or so many samples are done."""
        checkpoint, seen = Path(f"{self.film}.partial"), 0
        while process.poll() is None:
            time.sleep(0.1)
            now = checkpoint.stat().st_mtime_ns if checkpoint.exists() else 0
            if now == seen:
                continue
            seen, found = now, self.develop(checkpoint)
            if found:
                self.pictures.append((found[0], words, f"{found[1]:.1f} of {self.args.spp} samples a pixel"))
                if found[1] >= until:
                    return


def hash_of(film):
    return json.loads(film.with_suffix(".json").read_text())["film_hash"]


def framed(picture, command, state):
    sheet = Image.new("RGB", (picture.width, picture.height + 2 * LINE + 2 * MARGIN), "#16181c")
    sheet.paste(picture, (0, 0))
    draw, font = ImageDraw.Draw(sheet), ImageFont.truetype("DejaVuSansMono.ttf", 12)
    draw.text((MARGIN, picture.height + MARGIN), "$ " + command, "#e6e6e6", font)
    draw.text((MARGIN, picture.height + MARGIN + LINE), state, "#8fd18f" if "killed" not in state else "#ff8a70", font)
    return sheet


def main():
    parser = argparse.ArgumentParser(description="makes a film of a render that is killed and goes on")
    parser.add_argument("bundle", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="GIF")
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--width", type=int, default=480)
    parser.add_argument("--every", type=float, default=1.5, metavar="S", help="seconds between pictures (default 1.5)")
    parser.add_argument("--vitrail", default=shutil.which("vitrail") or "vitrail", help="the program, if not on the PATH")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        job = Job(args, Path(folder))
        first = job.start(2)
        job.watch(first, "mpirun -np 2 " + job.shown, until=args.spp / 2)
        os.killpg(first.pid, signal.SIGKILL)
        first.wait()
        last = job.pictures[-1]
        job.pictures.append((last[0], last[1], "both ranks killed (kill -9)"))
        second = job.start(1)
        job.watch(second, job.shown)
        if second.wait() != 0:
            raise SystemExit(second.stderr.read())
        whole = Path(folder) / "whole.film"
        subprocess.run([*map(str, job.command(whole, "--quiet"))], check=True)
        same = hash_of(whole) == hash_of(job.film)
        if not same:
            raise SystemExit("the film differs from one that nobody disturbed")
        job.pictures.append((job.develop(job.film)[0], job.shown, "done: bit for bit the film of a render without a kill"))
    frames = [framed(*picture) for picture in job.pictures]
    waits = [2500 if "killed" in state or "done" in state else 400 for _, _, state in job.pictures]
    few = [frame.quantize(64, dither=Image.Dither.NONE) for frame in frames]
    few[0].save(args.output, save_all=True, append_images=few[1:], duration=waits, loop=0)
    print(args.output)


if __name__ == "__main__":
    main()
