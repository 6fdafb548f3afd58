#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Where the time of a render goes, by stage: shares of the samples of Linux's perf, one thread, the kernel of
the operating system left out. Prints a row of a table for each bundle.

stages.py --bin build/release/bin BUNDLE..."""
import argparse
import pathlib
import re
import subprocess
import tempfile

# Names of functions, the first that fits. What fits none is shading: BSDFs, lights, textures, spectra.
STAGES = {
    "film": r"Film::|PixelSums|^deposit|quanta_of|^sense",
    "a sample's beginning": r"lanes::begin|^begin|Wave::|set_sample|key_of|CameraSampler|camera_ray|FilterSampler|Tracer::|hash_of_ray|^work\b|time_of",
    "intersection": r"visit_nearest|tree_closest|tree_occluded|node_closest|node_occluded|exact_hit|seen_hit|domain_closest|domain_occluded|domains_|"
                    r"instances_|any_entered|^prepare|trace_in_one|quadric_hits|closest_in|occluded_in|enter_domain|cluster_|holder_of|InstanceRay|"
                    r"find_hit|DomainWalk|meets|setback|curve|^decide",
    "lists and hits": r"LaneLists|surface_of|interaction|normal|texture_point",
}


def stage_of(symbol):
    return next((stage for stage, names in STAGES.items() if re.search(names, symbol)), "shading")


def shares(program, bundle, samples, folder):
    recorded = folder / "perf.data"
    subprocess.run(["perf", "record", "-q", "-e", "cpu-clock", "-F", "2000", "-o", recorded, program, bundle, "-o", folder / "x.exr", "--force",
                    "--quiet", "--threads", "1", "--spp", str(samples)], check=True, stderr=subprocess.DEVNULL)
    report = subprocess.run(["perf", "report", "-i", recorded, "--stdio", "--no-children", "-g", "none"], check=True, capture_output=True, text=True)
    found = dict.fromkeys(["intersection", "shading", *STAGES], 0.0)
    for line in report.stdout.splitlines():
        if row := re.match(r"\s*([\d.]+)%.*\[\.\] (.*)", line):
            found[stage_of(re.sub(r"vitrail::|\(anonymous namespace\)::", "", row[2]))] += float(row[1])
    return {stage: 100 * share / sum(found.values()) for stage, share in found.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bundles", nargs="+", type=pathlib.Path)
    parser.add_argument("--bin", default="build/release/bin", type=pathlib.Path)
    parser.add_argument("--spp", default=64, type=int)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for bundle in options.bundles:
            found = shares(options.bin / "vitrail-render", bundle, options.spp, pathlib.Path(folder))
            print(f"| {bundle.parent.name} | {' | '.join(f'{share:.0f}' for share in found.values())} |", flush=True)
    print(f"columns: {', '.join(found)}")


if __name__ == "__main__":
    main()
