#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""soak_test.py PROGRAMS SOURCE: 16 ranks on this machine, each with memory for an eighth of the domains that it answers for, of which
a random one stands still for a random moment again and again. The same job is repeated until the time is over: each gives the film
of one rank that has memory for everything, none hangs, and the memory of the ranks does not grow while they work. A small one of
some seconds; with VITRAIL_LONG_TESTS 30 minutes, or VITRAIL_SOAK_MINUTES."""
import json
import os
import pathlib
import random
import signal
import statistics
import subprocess
import sys
import tempfile
import time

RANKS, DOMAINS, EIGHTH = 16, 256, 8
LONG = bool(os.environ.get("VITRAIL_LONG_TESTS"))
MINUTES = float(os.environ.get("VITRAIL_SOAK_MINUTES", 30 if LONG else 0))  # at least one job
TRIANGLES, SAMPLES, WIDTH = (10**6, 256, 320) if LONG else (10**5, 8, 96)
LONGEST_STOP_S, PATIENCE_S, HANGS_S = 2, 60, 1800
MOST_GROWTH, PAGES_OF_CHANCE = 1.1, 1 << 20  # bytes; of what a rank holds, from the first half of a job to the second
programs, source = (pathlib.Path(p).resolve() for p in sys.argv[1:3])


def render(folder, film, *options):
    words = [programs / "vitrail-render", folder / "city.vit", "-o", folder / film, "--width", WIDTH, "--spp", SAMPLES, "--threads", 1,
             "--quiet", "--force", "--stats", folder / f"{film}.json", *options]
    return [str(w) for w in words]


def read(file):
    try:
        return file.read_bytes()
    except OSError:  # the process has ended
        return b""


def ranks_of(mpirun):
    children = read(pathlib.Path(f"/proc/{mpirun}/task/{mpirun}/children")).split()
    return [int(pid) for pid in children if read(pathlib.Path("/proc", pid.decode(), "comm")).startswith(b"vitrail")]


def resident_bytes(pid):
    statm = read(pathlib.Path(f"/proc/{pid}/statm")).split()
    return int(statm[1]) * os.sysconf("SC_PAGESIZE") if statm else 0


def stop_for_a_moment(dice, pid):
    try:
        os.kill(pid, signal.SIGSTOP)
        time.sleep(dice.uniform(.01, LONGEST_STOP_S if LONG else .1))
        os.kill(pid, signal.SIGCONT)
    except ProcessLookupError:
        pass


def growth(of_a_rank):
    """The second half over the first, without the first fifth, in which it fills."""
    held = of_a_rank[len(of_a_rank) // 5:]
    first, second = (statistics.mean(half) for half in (held[:len(held) // 2], held[len(held) // 2:]))
    return (second - PAGES_OF_CHANCE) / first


def soak(folder, dice, budget_bytes):
    """One job. How often a rank stood still, the most that a rank held, and by how much what each of them held grew."""
    words = ["mpirun", "-np", str(RANKS)] + render(folder, "soak.film", "--domain-memory", budget_bytes, "--patience", PATIENCE_S,
                                                   "--distribution", "decompose", "--checkpoint-every", 20 if LONG else 1)
    held, stops, begun = {}, 0, time.monotonic()
    with open(folder / "soak.log", "w+") as log:
        job = subprocess.Popen(words, stdout=log, stderr=log)
        try:
            while job.poll() is None:
                assert time.monotonic() - begun < HANGS_S, "it hangs"
                ranks = ranks_of(job.pid)
                for pid in ranks:
                    held.setdefault(pid, []).append(resident_bytes(pid))
                if len(ranks) == RANKS:
                    stop_for_a_moment(dice, dice.choice(ranks))
                    stops += 1
                time.sleep(dice.uniform(0, .2))
        finally:
            job.kill()
        log.seek(0)
        assert job.returncode == 0, log.read()
    held = [[b for b in of_a_rank if b > 0] for of_a_rank in held.values()]
    return stops, max(map(max, held)), [growth(h) for h in held if len(h) >= 20]


def main():
    dice = random.Random(17)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def must(*words):
            subprocess.run([str(w) for w in words], check=True, stdout=subprocess.DEVNULL)

        must("/usr/bin/python3", source / "examples/city/generate.py", "-o", folder / "city", "--triangles", TRIANGLES)
        scene = next((folder / "city").glob("*.pbrt"))
        must(programs / "vitrail", "partition", scene, "-o", folder / "city.vit", "--domains", DOMAINS, "--quiet")
        must(*render(folder, "alone.film"))
        expected = json.loads((folder / "alone.film.json").read_text())
        bundle_bytes = sum(f.stat().st_size for f in (folder / "city.vit/domains").iterdir())
        begun, jobs = time.monotonic(), 0
        while jobs == 0 or time.monotonic() - begun < 60 * MINUTES:
            stops, most, grown = soak(folder, dice, bundle_bytes // RANKS // EIGHTH)
            stats = json.loads((folder / "soak.film.json").read_text())
            jobs += 1
            print(f"job {jobs}, {(time.monotonic() - begun) / 60:.1f} min: {stops} stops, {stats['domain_loads']} loads of "
                  f"{stats['domains_touched']} domains, {stats['messages']} messages, {most / 2**20:.0f} MiB at most"
                  + (f", grown to {statistics.mean(grown):.3f}, of one rank {max(grown):.3f}" if grown else ""), flush=True)
            assert stats["film_hash"] == expected["film_hash"], "another film"
            assert stops > 0 and stats["evictions"] > 0
            if LONG:  # in seconds it only fills
                assert len(grown) == RANKS and statistics.mean(grown) <= MOST_GROWTH, grown
        print(f"{jobs} jobs in {(time.monotonic() - begun) / 60:.1f} min, film {expected['film_hash']}")


main()
