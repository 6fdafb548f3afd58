#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""within_memory_test.py PROGRAMS SOURCE: each integrator and each writer in a memory cgroup of exactly --memory, on one rank or on
two, with VITRAIL_LONG_TESTS on both, with the least --memory that is not refused. Nothing is killed, no rank takes more by its own VmHWM, and the film is that of
all memory. `partition` too, also where it refuses: many lamps, many triangles; without VITRAIL_LONG_TESTS in a third of the budgets.
Groups of version 1 or 2, as root; status 77 where there are none."""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

programs, source = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
MIB = 1 << 20
LONG = bool(os.environ.get("VITRAIL_LONG_TESTS"))
LARGE = 560, 400  # pixels of 824 bytes: several times what a rank has; the kernel takes half a minute to write them in a group
INTO_GROUP = 'echo $$ > {0}.${{OMPI_COMM_WORLD_RANK:-0}}/cgroup.procs; exec "$@"'

INTEGRATORS = {
    "path": [],
    "direct": ["--integrator", "direct"],
    "photon": ["--integrator", "photon", "--photons", 20000, "--spp", 3],
    "adaptive": ["--adaptive", "--spp", 12],
    "splat": ["--splat", "--filter", "gaussian:1.5"],
    "many photons": ["--integrator", "photon", "--photons", 400000, "--spp", 2],
}
WRITERS = {
    "film": [],
    "checkpoint": ["--checkpoint-every", 0.05],
    "picture.png": [],
    "picture.tif": [],
    "picture.exr": [],
    "layers.exr": ["--aov", "albedo,position,normal,depth,crypto_object,crypto_material", "--alpha"],
    "spectral": ["--spectral", 16],
    "large.film": ["--spectral", 47],
    "large.exr": ["--spectral", 47],
    "large.png": ["--spectral", 47],
    "groups": ["--light-groups"],
    "profile": ["--profile", "profile.json"],
    "trace": ["--trace", "trace.json"],
}
OF_THE_JOB = "--checkpoint-every", "--profile", "--trace"  # options that leave the film as it is
FILMS = {}  # statistics of the films of all memory, by size and options: what is written of one, and by how many ranks, does not change it


def group_base():
    """A folder in which groups can be made, and the file of their limit."""
    for folder, limit in (("/sys/fs/cgroup/memory", "memory.limit_in_bytes"), ("/sys/fs/cgroup", "memory.max")):
        base = pathlib.Path(folder, f"vitrail-within-{os.getpid()}")
        trial = base.with_name(f"{base.name}.try")
        try:
            trial.mkdir()
            usable = (trial / limit).exists()
            trial.rmdir()
            if usable:
                return base, limit
        except OSError:
            continue
    print("skipped: no memory cgroup can be made here (root, version 1 or 2)")
    sys.exit(77)


BASE, LIMIT = group_base()


class Limited:
    """A group a rank."""

    def __init__(self, ranks, limit):
        self.groups = [BASE.with_name(f"{BASE.name}.{rank}") for rank in range(ranks)]
        for group in self.groups:
            group.mkdir()
            (group / LIMIT).write_text(str(limit))

    def __enter__(self):
        return ["sh", "-c", INTO_GROUP.format(BASE), "sh"]

    def __exit__(self, *_):
        for group in self.groups:
            group.rmdir()


def run(folder, ranks, words, limit=None):
    launcher = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
    words = [str(w) for w in words]
    if limit is None:
        return subprocess.run(launcher + words, capture_output=True, text=True, cwd=folder)
    with Limited(ranks, limit) as within:
        return subprocess.run(launcher + within + words, capture_output=True, text=True, cwd=folder)


def measure(folder, ranks, name, options):
    output = name if "." in name else "out.film"
    size, samples = (LARGE, 1) if name.startswith("large.") else ((200, 150), 4)
    words = [programs / "vitrail-render", "city.vit", "-o", output, "--width", size[0], "--height", size[1], "--spp", samples, "--threads", 2, "--quiet",
             "--force", "--stats", "stats.json", *options]
    film = (size, *(o for o in options if options[0] not in OF_THE_JOB))
    if film not in FILMS:
        done = run(folder, ranks, words)
        assert done.returncode == 0, done.stderr
        FILMS[film] = json.loads((folder / "stats.json").read_text())
    everything = FILMS[film]
    budget, done = MIB, None
    for _ in range(5):  # what MPI takes differs by a little from run to run
        done = run(folder, ranks, words + ["--memory", budget], None if budget == MIB else budget)
        least = re.search(r"Give at least (\d+)M", done.stderr)
        if done.returncode != 4 or not least:
            break
        budget = int(least[1]) * MIB
    assert budget > MIB, done.stderr
    if done.returncode != 0:
        return f"status {done.returncode} in {budget / MIB:.0f}M: {done.stderr.strip()[:400]}"
    little = json.loads((folder / "stats.json").read_text())
    print(f"{name}, {ranks} rank{'s'[:ranks - 1]}: {little['peak_rss_bytes'] / MIB:.1f} MiB of {budget / MIB:.0f}; with all memory "
          f"{everything['peak_rss_bytes'] / MIB:.1f}; {little['evictions']} evictions", flush=True)
    if little["film_hash"] != everything["film_hash"]:
        return "another film"
    if name.startswith("large.") and not (0 < little["film_window_bytes"] and budget < size[0] * size[1] * 824 / 3):
        return f"the film is in memory, or is not large for {budget / MIB:.0f}M"
    return f"{little['peak_rss_bytes']} bytes of {budget}" if little["peak_rss_bytes"] > budget else None


def write_sheet(folder, triangles):
    """A wavy sheet of so many triangles, sheet.pbrt, and the scenes where it shines and does not, lit.pbrt and unlit.pbrt: by a process
    of its own, for the greatest size of this one would count for those that it starts."""
    pid = os.fork()
    if pid > 0:
        assert os.waitpid(pid, 0)[1] == 0
        return
    side = int((triangles / 2) ** .5)
    points = [(x / side, y / side, .05 * math.sin(.3 * x) * math.cos(.2 * y)) for y in range(side + 1) for x in range(side + 1)]
    corners = [(y * (side + 1) + x, y * (side + 1) + x + 1, (y + 1) * (side + 1) + x) for y in range(side) for x in range(side)]
    corners += [(b, c + 1, c) for _, b, c in corners]
    text = " ".join(f"{v:.6g}" for p in points for v in p), " ".join(str(i) for t in corners for i in t)
    (folder / "sheet.pbrt").write_text(f'Shape "trianglemesh" "point3 P" [{text[0]}] "integer indices" [{text[1]}]\n')
    for name, light in ("lit", 'AreaLightSource "diffuse"'), ("unlit", 'LightSource "infinite"'):
        (folder / f"{name}.pbrt").write_text(f'Camera "perspective"\nFilm "rgb"\nWorldBegin\n{light}\nInclude "sheet.pbrt"\n')
    os._exit(0)


def partition(folder, scene, budget, options=()):
    """Of one run in a group of exactly that: the status, and the bytes that were resident at most."""
    words = [programs / "vitrail-partition", scene, "-o", "out.vit", "--force", "--quiet", "--no-cache", "--memory", budget, *options]
    with Limited(1, budget) as within:
        process = subprocess.Popen(within + [str(w) for w in words], cwd=folder, stderr=subprocess.PIPE, text=True)
        said = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
    return os.waitstatus_to_exitcode(status), usage.ru_maxrss * 1024, said.strip()


def measure_partition(folder, scene, budgets, fits, options=()):
    """Never more than the budget, whether it is kept or refused; `fits` is kept."""
    wrong = []
    for budget in budgets:
        status, peak, said = partition(folder, scene, budget * MIB, options)
        print(f"partition {scene}: {peak / MIB:.1f} MiB of {budget}, status {status}", flush=True)
        if status not in (0, 4) or peak > budget * MIB or (status != 0 and budget >= fits):
            wrong.append(f"partition {scene} in {budget}M: status {status}, {peak / MIB:.1f} MiB: {said[:300]}")
    return wrong


def main():
    with tempfile.TemporaryDirectory() as name:
        folder, wrong = pathlib.Path(name), []
        subprocess.run(["/usr/bin/python3", source / "examples/city/generate.py", "-o", folder / "city", "--triangles", "100000"],
                       check=True, stdout=subprocess.DEVNULL)
        scene = next((folder / "city").glob("*.pbrt"))
        subprocess.run([programs / "vitrail", "partition", scene, "-o", folder / "city.vit", "--domains", "64", "--aov", "crypto_object",
                        "--quiet"], check=True)
        budgets = [16, 20, 24, 32, 40, 48, 64, 80, 100, 128, 160, 200, 256, 320]
        wrong += measure_partition(folder, scene, budgets[:8] if LONG else budgets[:8:2] + [48], 48, ["--domains", 64])
        write_sheet(folder, 1.2e6)
        for i, (sheet, fits) in enumerate((("unlit.pbrt", 128), ("lit.pbrt", 200))):
            wrong += measure_partition(folder, sheet, budgets if LONG else sorted({fits, *budgets[i::3]}), fits)
        for i, (what, options) in enumerate([*INTEGRATORS.items(), *WRITERS.items()]):
            for ranks in (1, 2) if LONG else (1 + i % 2,):
                fault = measure(folder, ranks, what, options)
                if fault:
                    wrong.append(f"{what}, {ranks} ranks: {fault}")
                    print("WRONG:", wrong[-1], flush=True)
        assert not wrong, "\n".join(wrong)
    return 0


sys.exit(main())
