#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""kills_test.py PROGRAMS SOURCE: a random rank of four is killed at 20 random moments; each time the same command goes on from the
last checkpoint, and in the end the film is that of a job that nobody killed. Says how much work was done twice. Status 77 without
VITRAIL_LONG_TESTS."""
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

KILLS, RANKS, MOST_REPEATED = 20, 4, .05
programs, source = (pathlib.Path(p).resolve() for p in sys.argv[1:3])


def must(*words):
    subprocess.run([str(w) for w in words], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def ranks_of(job):
    """The pids of the ranks: children of children of mpirun."""
    parents = {}
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            pid, name, rest = re.match(r"(\d+) \((.*)\) (.*)", stat.read_text(), re.S).groups()
        except (OSError, AttributeError):
            continue
        parents[int(pid)] = (int(rest.split()[1]), name)
    return [pid for pid, (parent, name) in parents.items() if parent == job.pid and name.startswith("vitrail")]


class Job:
    def __init__(self, folder, film, *options):
        self.stats = folder / f"{film}.json"
        self.errors = open(folder / f"{film}.log", "w+")
        self.words = ["mpirun", "-np", RANKS, programs / "vitrail-render", folder / "city.vit", "-o", folder / film,
                      "--threads", 1, "--memory", "96M", "--stats", self.stats, *options]

    def start(self):
        self.errors.seek(0), self.errors.truncate()
        self.process = subprocess.Popen([str(w) for w in self.words], stdout=subprocess.PIPE, stderr=self.errors, text=True)

    def end(self):
        """Its status. One mpirun in twenty-five whose rank was killed does not end by itself (Open MPI 4.1 with PMIx 4.2)."""
        try:
            return self.process.wait(timeout=60)
        except subprocess.TimeoutExpired:
            self.process.kill()
            return self.process.wait()

    def held(self):
        """Samples a pixel that the last start went on with."""
        self.errors.seek(0)
        found = re.search(r"going on from .* with ([\d.e+-]+) of", self.errors.read())
        return float(found[1]) if found else 0.


def main():
    if not os.environ.get("VITRAIL_LONG_TESTS"):
        print("skipped: takes minutes, with VITRAIL_LONG_TESTS=1")
        return 77
    samples = int(os.environ.get("VITRAIL_KILLS_SAMPLES", 2048))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        must("/usr/bin/python3", source / "examples/city/generate.py", "-o", folder / "city", "--triangles", 10**6)
        scene = next((folder / "city").glob("*.pbrt"))
        must(programs / "vitrail", "partition", scene, "-o", folder / "city.vit", "--domains", 64)
        size = ["--width", 320, "--height", 240, "--spp", samples]
        whole = Job(folder, "whole.film", *size, "--quiet")
        begun = time.monotonic()
        whole.start()
        assert whole.process.wait() == 0
        job_s = time.monotonic() - begun
        job = Job(folder, "killed.film", *size, "--checkpoint-every", 0.5, "--progress", "json")
        dice, repeated, kills, done = random.Random(20), [], 0, 0.
        while True:
            job.start()
            moment = time.monotonic() + dice.uniform(.01, .06) * job_s + 2
            lines, killed = [], False
            while line := job.process.stdout.readline():
                if '"progress"' in line:
                    lines.append((time.monotonic(), json.loads(line)))
                if kills < KILLS and time.monotonic() >= moment and lines:
                    victims = ranks_of(job.process)
                    if len(victims) == RANKS:
                        os.kill(dice.choice(victims), signal.SIGKILL)
                        killed, kills = True, kills + 1
                        break
            status = job.end()
            held = job.held()
            if done > 0:
                repeated.append(max(0., done - held) / samples)
            if not killed:
                break
            assert status != 0
            done = lines[-1][1]["samples_per_pixel"]
            print(f"kill {kills}: {done:.1f} of {samples} samples a pixel", flush=True)
        assert status == 0, job.errors.name
        hashes = [json.loads(j.stats.read_text())["film_hash"] for j in (whole, job)]
        print(f"{kills} of {KILLS} kills; repeated in all {100 * sum(repeated):.1f} % of the samples, {100 * max(repeated):.2f} % "
              f"at most of one; film {hashes[1]} of {hashes[0]}; {job_s:.0f} s without kills")
        assert kills == KILLS, "the job was over before: more VITRAIL_KILLS_SAMPLES"
        assert hashes[0] == hashes[1]
        assert sum(repeated) <= MOST_REPEATED
    return 0


sys.exit(main())
