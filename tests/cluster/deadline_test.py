#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""deadline_test.py PROGRAMS SOURCE PRELOAD: a scene that does not fit into memory, on a disk whose files open slowly. Jobs whose Slurm
allocation ends have their checkpoint before that, and --time is kept. A few; with VITRAIL_LONG_TESTS more. Prints how many, and by how
much the worst passed its limit."""
import os
import pathlib
import subprocess
import sys
import tempfile
import time

LONG = bool(os.environ.get("VITRAIL_LONG_TESTS"))
programs, source, preload = (pathlib.Path(p).resolve() for p in sys.argv[1:4])
LATE = 1.5  # of the limit, on a machine that others use


def must(*words):
    subprocess.run([str(w) for w in words], check=True, stdout=subprocess.DEVNULL)


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

        kept = jobs = 0
        for delay_s in (0, .005, .02) if LONG else (0, .005):
            for limit_s in (10, 40) if LONG else (24,):
                time_s = limit_s if LONG else limit_s / 2
                status, took_s = render("time.film", delay_s, "--force", "--time", time_s)
                right = status == 0 and took_s <= LATE * time_s
                print(f"{'kept' if right else 'LATE'}: --time {time_s}, opens take {1000 * delay_s:.0f} ms: {took_s:.1f} s, status {status}", flush=True)
                kept, jobs = kept + right, jobs + 1
                checkpoint = folder / "job.film.partial"
                checkpoint.unlink(missing_ok=True)
                end = int(time.time()) + limit_s
                status, took_s = render("job.film", delay_s, SLURM_JOB_ID="7", SLURM_JOB_END_TIME=str(end), SLURM_MEM_PER_NODE="4000")
                right = checkpoint.exists() and checkpoint.stat().st_ctime <= end
                print(f"{'kept' if right else 'LATE'}: a job that ends in {limit_s} s, opens take {1000 * delay_s:.0f} ms: {took_s:.1f} s, status {status}",
                      flush=True)
                kept, jobs = kept + right, jobs + 1
        print(f"{kept} of {jobs} in time")
        return kept != jobs


sys.exit(main())
