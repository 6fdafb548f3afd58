#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""short_jobs_test.py PROGRAMS SOURCE: short jobs of all kinds, one after the other in one folder: integrators and ways to sample,
1 or 2 ranks, 1 to 3 threads, 1 to 16 domains, all or an eighth of them in memory, homes that settle or not. Some are killed, ended by
TERM or by --time, or made to write a checkpoint at random moments, and typed again until they are done. Each gives the film of one rank
and one thread with one domain. One that differs is kept with that film, its own, its messages and its commands, in VITRAIL_SOAK_KEEP
(else /tmp/vitrail-differing-films). 14 jobs; VITRAIL_SOAK_JOBS says how many, with VITRAIL_LONG_TESTS 10,000. VITRAIL_SOAK_SEED begins
elsewhere."""
import collections
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

JOBS = int(os.environ.get("VITRAIL_SOAK_JOBS", 10000 if os.environ.get("VITRAIL_LONG_TESTS") else 14))
SEED = int(os.environ.get("VITRAIL_SOAK_SEED", 39))
KEEP = pathlib.Path(os.environ.get("VITRAIL_SOAK_KEEP", "/tmp/vitrail-differing-films"))
HANGS_S, MOST_STARTS = 300, 12
programs, source = (pathlib.Path(p).resolve() for p in sys.argv[1:3])

KINDS = {
    "path": [],
    "direct": ["--integrator", "direct"],
    "photon": ["--integrator", "photon", "--photons", 2000, "--spp", 3],
    "adaptive": ["--adaptive", "--spp", 48],
    "target": ["--target-error", 0.2, "--spp", 64],
    "adaptive target": ["--adaptive", "--target-error", 0.1, "--spp", 96],
    "splat": ["--splat", "--filter", "gaussian:1.5"],
    "one sequence": ["--one-sequence"],
    "layers": ["--aov", "albedo,normal,depth,crypto_object", "--alpha"],
    "spectral": ["--spectral", 8, "--wavelengths", 1],
    "groups": ["--light-groups", "--clamp", 2],
    "crop": ["--crop", "7,31,3,40", "--seed", 5],
    "deep": ["--max-depth", 40, "--roulette", "never", "--spp", 4],
}
DOMAINS = [1, 3, 16]
FATES = ["whole"] * 3 + ["kill"] * 4 + ["kill one"] * 2 + ["term"] * 2 + ["time", "checkpoints"]


def render(folder, film, kind, domains, *more):
    words = [programs / "vitrail-render", folder / f"box-{domains}.vit", "-o", folder / film, "--width", 40, "--height", 40, "--spp", 24,
             "--quiet", "--stats", folder / f"{film}.json", *KINDS[kind], *more]
    return [str(w) for w in words]


def children_of(pid):
    try:
        return [int(c) for c in pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()]
    except OSError:  # it has ended
        return []


def send(pid, number):
    try:
        os.kill(pid, number)
    except ProcessLookupError:
        pass


class Job:
    """One film, from its first start to its end."""

    def __init__(self, folder, dice, number, seconds):
        self.folder, self.dice, self.seconds = folder, dice, seconds
        self.kind, self.domains = dice.choice(list(KINDS)), dice.choice(DOMAINS)
        self.fate = dice.choice(FATES)
        self.film, self.commands, self.starts = f"job-{number}.film", [], 0
        self.log = folder / f"{self.film}.log"

    def command(self):
        """Anew for each start: another number of ranks goes on with the work of those before."""
        dice, ranks = self.dice, self.dice.choice([1, 1, 2])
        more = ["--threads", dice.randint(1, 3), "--distribution", dice.choice(["auto", "decompose", "replicate"])]
        if self.domains > 1 and dice.random() < .5:
            more += ["--domain-memory", max(f.stat().st_size for f in (self.folder / f"box-{self.domains}.vit/domains").iterdir()) + 4096]
        if self.fate != "whole":
            more += ["--checkpoint-every", dice.choice([.05, .2])]
        if self.fate == "time" and self.starts < 2:
            more += ["--time", round(self.seconds * dice.uniform(.5, 1.5), 2)]
        if dice.random() < .3:
            more += ["--settle-after", dice.choice([0, .1, .5]), "--settle-ending", dice.choice([0, .05, 60])]
        words = render(self.folder, self.film, self.kind, self.domains, *more)
        return ["mpirun", "-np", "2"] + words if ranks == 2 else words

    def trouble(self, process):
        """What its fate does to it, once, at a random moment."""
        if self.fate in ("whole", "time") or self.starts > 3:
            return
        time.sleep(self.dice.uniform(0, 1.2) * self.seconds)
        ranks = children_of(process.pid)
        if self.fate == "kill":
            for pid in [*ranks, process.pid]:
                send(pid, signal.SIGKILL)
        elif self.fate == "kill one":
            send(self.dice.choice(ranks or [process.pid]), signal.SIGKILL)
        elif process.poll() is None:
            send(process.pid, signal.SIGTERM if self.fate == "term" else signal.SIGUSR1)

    def start(self):
        command = self.command()
        self.commands.append(" ".join(command))
        self.starts += 1
        with open(self.log, "a") as log:
            process = subprocess.Popen(command, stdout=log, stderr=log)
            try:
                self.trouble(process)
                # One mpirun in twenty-five whose rank was killed does not end by itself (Open MPI 4.1 with PMIx 4.2).
                return process.wait(timeout=20 if self.fate == "kill one" and self.starts <= 4 else HANGS_S)
            except subprocess.TimeoutExpired:
                text = self.log.read_text()
                killed = self.fate == "kill one" or "exited on signal" in text  # before it knew what TERM and USR1 mean
                assert killed and self.starts <= 4, f"it hangs: {self.commands[-1]}\n{text}"
                return 137
            finally:
                for pid in [*children_of(process.pid), process.pid]:
                    send(pid, signal.SIGKILL)
                process.wait()

    def run(self):
        """Its film's hash."""
        while self.starts < MOST_STARTS:
            status = self.start()
            done = status == 0 and "--time" not in self.commands[-1]
            if done and (self.folder / self.film).exists() and not (self.folder / f"{self.film}.partial").exists():
                return json.loads((self.folder / f"{self.film}.json").read_text())["film_hash"]
            assert status not in (2, 3), f"{self.commands[-1]}\n{self.log.read_text()}"
        raise AssertionError(f"not done after {self.starts} starts\n{self.log.read_text()}")

    def keep(self, expected):
        KEEP.mkdir(parents=True, exist_ok=True)
        (KEEP / f"{self.film}.commands").write_text("\n".join([self.kind, self.fate, *self.commands]))
        for file in [*self.folder.glob(f"{self.film}*"), self.folder / expected]:
            shutil.copy(file, KEEP)

    def remove(self):
        for file in self.folder.glob(f"{self.film}*"):
            file.unlink()


def main():
    dice = random.Random(SEED)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for domains in DOMAINS:
            subprocess.run([str(w) for w in [programs / "vitrail", "partition", source / "examples/cornell-box/cornell-box.pbrt", "-o",
                                             folder / f"box-{domains}.vit", "--domains", domains, "--aov", "crypto_object", "--quiet"]],
                           check=True)
        expected, seconds = {}, {}
        for kind in KINDS:
            film, begun = f"{kind.replace(' ', '-')}.film", time.monotonic()
            subprocess.run(render(folder, film, kind, 1, "--threads", 1), check=True)
            seconds[kind] = time.monotonic() - begun
            expected[kind] = json.loads((folder / f"{film}.json").read_text())["film_hash"], film
        assert len(set(expected.values())) == len(KINDS)
        begun, starts, kinds, differing = time.monotonic(), 0, collections.Counter(), []
        for number in range(1, JOBS + 1):
            job = Job(folder, dice, number, 1)
            job.seconds = seconds[job.kind]
            film_hash = job.run()
            starts += job.starts
            kinds[job.fate] += 1
            if film_hash != expected[job.kind][0]:
                job.keep(expected[job.kind][1])
                differing.append(job.film)
                print(f"{job.film} ({job.kind}, {job.fate}) differs: it is kept in {KEEP}", flush=True)
            job.remove()
            if number % 100 == 0:
                print(f"{number} jobs, {starts} starts, {(time.monotonic() - begun) / 60:.1f} min, {len(differing)} differ", flush=True)
        left = sorted(f.name for f in folder.iterdir() if f.name.startswith("job-"))
        print(f"{JOBS} jobs from seed {SEED} in {starts} starts, {(time.monotonic() - begun) / 60:.1f} min: {dict(kinds)}; "
              f"{len(differing)} films differ; left over: {left}")
        assert not differing and not left


main()
