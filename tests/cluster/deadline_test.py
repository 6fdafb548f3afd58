#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""deadline_test.py PROGRAMS SOURCE PRELOAD: a scene that does not fit into memory, on a disk whose files open slowly. Jobs whose Slurm
allocation ends have their checkpoint before that, and --time is kept. A few; with VITRAIL_LONG_TESTS more. Prints how many.

What a render expects of its last seconds it has measured before. Where others begin to use the machine in these, nothing can keep a
limit: what is late while all processors were busy is tried again, TRIES times in all. Where a processor was free it has one try."""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

LONG = bool(os.environ.get("VITRAIL_LONG_TESTS"))
programs, source, preload = (pathlib.Path(p).resolve() for p in sys.argv[1:4])
LATE = 1.5  # of the limit, on a machine that others use
TRIES = 3
QUIET = .5  # processors that nobody uses, on average, beside a render of one thread


def must(*words):
    subprocess.run([str(w) for w in words], check=True, stdout=subprocess.DEVNULL)


def idle_s():
    """Returns for how long processors have had nothing to do, in sum."""
    with open("/proc/stat") as stat:
        _, _, _, _, idle, waiting, *_ = stat.readline().split()
    return (int(idle) + int(waiting)) / os.sysconf("SC_CLK_TCK")


def is_kept(what, job):
    """`job` returns whether it was in time, how long it took, and its status. Tried again where others used the machine."""
    for left in reversed(range(TRIES)):
        begun, idle_before_s = time.monotonic(), idle_s()
        right, took_s, status = job()
        idle = (idle_s() - idle_before_s) / (time.monotonic() - begun)
        print(f"{'kept' if right else 'LATE'}: {what}: {took_s:.1f} s, status {status}, {idle:.1f} processors idle", flush=True)
        if right or idle >= QUIET or not left:
            return right


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        must("/usr/bin/python3", source / "examples/city/generate.py", "-o", folder / "city", "--triangles", 10**6 if LONG else 2 * 10**5)
        scene = next((folder / "city").glob("*.pbrt"))
        must(programs / "vitrail", "partition", scene, "-o", folder / "city.vit", "--domains", 1024 if LONG else 256, "--quiet")
        whole = sum(f.stat().st_size for f in (folder / "city.vit/domains").iterdir())

        def render(film, delay_s, *options, **variables):
            words = [programs / "vitrail-render", folder / "city.vit", "-o", folder / film, "--spp", 65536, "--width", 320, "--threads", 1, "--quiet",
                     "--checkpoint-every", 0, "--domain-memory", whole // 8, *options]
            environment = os.environ | {"LD_PRELOAD": str(preload), "VITRAIL_STANDSTILL": f"0 open 1 {delay_s} domains/"} | variables
            begun = time.monotonic()
            status = subprocess.run([str(w) for w in words], env=environment, timeout=900).returncode
            return status, time.monotonic() - begun

        def with_time(delay_s, time_s):
            status, took_s = render("time.film", delay_s, "--force", "--time", time_s)
            return status == 0 and took_s <= LATE * time_s, took_s, status

        def in_a_job(delay_s, limit_s):
            checkpoint = folder / "job.film.partial"
            checkpoint.unlink(missing_ok=True)
            end = int(time.time()) + limit_s
            status, took_s = render("job.film", delay_s, SLURM_JOB_ID="7", SLURM_JOB_END_TIME=str(end), SLURM_MEM_PER_NODE="4000")
            return checkpoint.exists() and checkpoint.stat().st_ctime <= end, took_s, status

        kept = []
        for delay_s in (0, .005, .02) if LONG else (0, .005):
            opens = f"opens take {1000 * delay_s:.0f} ms"
            for limit_s in (10, 40) if LONG else (24,):
                time_s = limit_s if LONG else limit_s / 3
                kept.append(is_kept(f"--time {time_s}, {opens}", lambda: with_time(delay_s, time_s)))
                if LONG or delay_s > 0:
                    kept.append(is_kept(f"a job that ends in {limit_s} s, {opens}", lambda: in_a_job(delay_s, limit_s)))
        print(f"{sum(kept)} of {len(kept)} in time")
        return not all(kept)


sys.exit(main())
