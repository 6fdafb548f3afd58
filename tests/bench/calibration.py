#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `plan` says of 1 to 8 ranks, beside what they do: the Cornell box and a city of 10^6 triangles.

  . scripts/mpi-environment; tests/bench/calibration.py [--runs 3] [--folder build/calibration] [--delays 1 5 50 200]

The profile is of one rank that has everything in memory, the median of three. A thread a rank; times are of the processor, so that a machine with
fewer cores than ranks, or a busy one, does: of all ranks, and of the one that traces longest, which ends last on a cluster.
Delays are microseconds in the mean, put between MPI and the ranks (tests/farm/message_faults.c). Needs numpy.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FAULTS = ROOT / "build/release/tests/farm/libmessage_faults.so"
COUNTS = "trace_s", "busiest_trace_s", "domain_loads", "forwarded_rays"


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout


class Scene:
    def __init__(self, vitrail, folder, name, file, options):
        self.vitrail, self.folder, self.options = vitrail, folder, options
        self.bundle, self.profile = folder / f"{name}.vit", folder / f"{name}.json"
        if not self.bundle.exists():
            run(vitrail, "partition", file, "-o", self.bundle, "--domains", 64, "--quiet")
        profiles = []
        for _ in range(3):
            self.render(1, 0, "--profile", self.profile)
            profiles.append(self.profile.read_text())
        profiles.sort(key=lambda text: json.loads(text)["cost"]["trace_s"])
        self.profile.write_text(profiles[1])

    def render(self, ranks, delay_us, *options):
        stats = self.folder / "stats.json"
        mpirun = ["mpirun", "-n", ranks] if ranks > 1 else []
        if delay_us > 0:  # evenly from 0 to twice as long
            mpirun += ["-x", f"LD_PRELOAD={FAULTS}", "-x", f"VITRAIL_MESSAGE_FAULTS=1 {2e-3 * delay_us}"]
        run(*mpirun, self.vitrail, "render", self.bundle, "-o", self.folder / "a.film", "--force", "--quiet", "--threads", 1,
            "--stats", stats, *self.options, *options)
        return json.loads(stats.read_text())

    def plan(self, ranks, delay_us, seen, *options):
        """Files are read as quickly as in the render that was seen: on a busy machine the clock runs on meanwhile."""
        seconds = seen["load_s"] / seen["domain_loads"] * seen["trace_s"] / ranks / seen["wall_s"]
        domains = sum(1 for _ in (self.bundle / "domains").iterdir())
        point = json.loads(run(self.vitrail, "plan", self.bundle, "--profile", self.profile, "--threads", 1, "--ranks", ranks,
                               "--latency", delay_us + 1, "--disk-latency", 0,
                               "--disk", int(self.bytes() / domains / seconds), "--json", *options))["plan"][0]
        return point | {"busiest_trace_s": point["busiest_workers"] * point["seconds"]}

    def bytes(self):
        return sum(f.stat().st_size for f in self.bundle.rglob("*") if f.is_file())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "build/calibration")
    parser.add_argument("--delays", type=float, nargs="*", default=[1, 5, 50, 200])
    parser.add_argument("--vitrail", default=ROOT / "build/release/bin/vitrail")
    a = parser.parse_args()
    a.folder.mkdir(parents=True, exist_ok=True)
    city = a.folder / "city"
    if not city.exists():
        run(sys.executable, ROOT / "examples/city/generate.py", "-o", city)
    scenes = {
        "cornell box": Scene(a.vitrail, a.folder, "box", ROOT / "examples/cornell-box/cornell-box.pbrt",
                             ("--spp", 64, "--width", 128)),
        "city": Scene(a.vitrail, a.folder, "city", city / "city.pbrt", ("--spp", 16, "--width", 320)),
    }
    print("| scene | ranks | memory for domains | delay, µs | " + " | ".join(COUNTS) + " |\n|" + "---|" * (4 + len(COUNTS)))
    cases = [(ranks, quarter, 0) for quarter in (False, True) for ranks in (1, 2, 4)]
    cases += [(ranks, False, delay) for ranks in (2, 4, 8) for delay in a.delays]
    for name, scene in scenes.items():
        for ranks, quarter, delay_us in cases:
            options = ["--distribution", "decompose"]
            if quarter:
                options += ["--domain-memory", scene.bytes() // 4]
            real = [scene.render(ranks, delay_us, *options) for _ in range(a.runs)]
            planned = scene.plan(ranks, delay_us, real[0], *options)
            cells = []
            for key in COUNTS:
                measured = statistics.median(r[key] for r in real)
                ratio = f" ({planned[key] / measured:.2f})" if measured > 0 else ""
                cells.append(f"{measured:.4g} · {planned[key]:.4g}{ratio}")
            print(f"| {name} | {ranks} | {'¼' if quarter else 'all'} | {delay_us:g} | " + " | ".join(cells) + " |", flush=True)
    print("\nmeasured (median) · planned (planned ÷ measured)")


main()
