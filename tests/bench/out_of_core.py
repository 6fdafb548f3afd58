#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A bundle rendered in less memory than it has bytes, beside the same with all of it mapped and paged by the kernel, and Mitsuba 3.

  . scripts/mpi-environment; tests/bench/out_of_core.py BUNDLE [--mitsuba SCENE.xml PYTHON] [--ranks 1 2] [--spp 64] [options of render]

Each process has a memory cgroup (v1; as root) with a limit of all, 1/2, 1/4 and 1/8 of the bundle's bytes, and the bundle's files are
out of the page cache when it begins. `decomposed` is `render --memory LIMIT`; `paged` is `--distribution replicate` that believes in
plenty of memory. Columns: processor and wall time of all ranks and their ratio to the first line's of as many ranks, loads of a touched
domain, peak resident bytes over the limit, the film.
"""
import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
GROUPS = pathlib.Path("/sys/fs/cgroup/memory")
PLENTY = "64G"
INTO_GROUP = 'echo $$ > {0}.${{OMPI_COMM_WORLD_RANK:-0}}/cgroup.procs; exec "$@"'


def forget_pages(folder):
    for file in folder.rglob("*"):
        if file.is_file():
            with open(file, "rb") as opened:
                os.posix_fadvise(opened.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)


class Limited:
    """Memory groups, one a rank."""

    def __init__(self, ranks, limit):
        self.base = GROUPS / f"vitrail-out-of-core-{os.getpid()}"
        self.groups = [self.base.with_name(f"{self.base.name}.{rank}") for rank in range(ranks)]
        for group in self.groups:
            group.mkdir()
            (group / "memory.limit_in_bytes").write_text(str(limit))

    def __enter__(self):
        return ["sh", "-c", INTO_GROUP.format(self.base), "sh"]

    def __exit__(self, *_):
        for group in self.groups:
            (group / "memory.force_empty").write_text("0")
            group.rmdir()


def run(command, limit, ranks, patience):
    """Wall seconds, or what went wrong."""
    begun = time.monotonic()
    with Limited(ranks, limit) as within:
        launcher = ["mpirun", "-n", str(ranks)] if ranks > 1 else []
        try:
            done = subprocess.run([*launcher, *within, *map(str, command)], capture_output=True, text=True, timeout=patience)
        except subprocess.TimeoutExpired:
            return None, f"not done after {patience} s"
    if done.returncode != 0:
        return None, "killed for want of memory" if done.returncode in (-9, 137) else (done.stderr.strip() or "failed").splitlines()[-1]
    return time.monotonic() - begun, done.stdout


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bundle", type=pathlib.Path)
    parser.add_argument("--vitrail", default=ROOT / "build/release/bin/vitrail")
    parser.add_argument("--mitsuba", nargs=2, metavar=("SCENE", "PYTHON"))
    parser.add_argument("--ranks", type=int, nargs="*", default=[1], help="none: Mitsuba alone")
    parser.add_argument("--fractions", type=float, nargs="+", default=[1, .5, .25, .125])
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--patience", type=float, default=1800, help="seconds for one run")
    a, render_options = parser.parse_known_args()
    total = sum(f.stat().st_size for f in a.bundle.rglob("*") if f.is_file())
    print(f"{a.bundle}: {total / 1e6:.0f} MB\n")
    print("| ranks | memory each | | processor s | wall s | loads | peak | film |\n|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        stats_file, film = pathlib.Path(name) / "stats.json", pathlib.Path(name) / "a.film"
        for ranks in a.ranks:
            first = None
            for fraction in a.fractions:
                limit = int(total * fraction)
                if fraction == 1:  # the films, queues and programs besides
                    limit = 2 * total
                for manner, options in (("decomposed", ["--memory", limit]),
                                        ("paged", ["--memory", PLENTY, "--distribution", "replicate"])):
                    forget_pages(a.bundle)
                    wall, said = run([a.vitrail, "render", a.bundle, "-o", film, "--force", "--quiet", "--threads", 1, "--spp", a.spp,
                                      "--stats", stats_file, *options, *render_options], limit, ranks, a.patience)
                    line = f"| {ranks} | {limit / 1e6:.0f} MB | {manner} | "
                    if wall is None:
                        print(line + f"{said} | | | | |", flush=True)
                        continue
                    s = json.loads(stats_file.read_text())
                    first = first or (s["cpu_s"], wall)
                    print(line + f"{s['cpu_s']:.1f} ({s['cpu_s'] / first[0]:.2f}) | {wall:.1f} ({wall / first[1]:.2f}) | "
                          f"{s['domain_loads'] / s['domains_touched']:.2f} | {s['peak_rss_bytes'] / limit:.2f} | {s['film_hash']} |",
                          flush=True)
        if a.mitsuba:
            scene, python = a.mitsuba
            for fraction in a.fractions:
                limit = int(total * (2 if fraction == 1 else fraction))
                forget_pages(pathlib.Path(scene).parent)
                program = ("import sys, resource, mitsuba as mi; mi.set_variant('scalar_spectral'); "
                           "mi.render(mi.load_file(sys.argv[1]), spp=int(sys.argv[2])); "
                           "u = resource.getrusage(resource.RUSAGE_SELF); print(u.ru_utime + u.ru_stime, u.ru_maxrss * 1024)")
                wall, said = run([python, "-c", program, scene, a.spp], limit, 1, a.patience)
                line = f"| 1 | {limit / 1e6:.0f} MB | Mitsuba 3, scalar_spectral | "
                if wall is None:
                    print(line + f"{said} | | | | |", flush=True)
                else:
                    cpu, peak = map(float, said.split())
                    print(line + f"{cpu:.1f} | {wall:.1f} | | {peak / limit:.2f} | |", flush=True)


sys.exit(main())
