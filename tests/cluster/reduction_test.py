#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""reduction_test.py CLUSTER_REDUCTION: a sum over ranks, of numbers and of a film's sums, over TCP and in shared memory. Beside the
sums it takes a few parts of rank 0's memory, however much there is to sum: 128 MiB, with VITRAIL_LONG_TESTS 512. A part is one message: in shared memory it is read by few
calls of the system (by strace, where it is installed), since a rank that waits for another may wait for a core."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

MIB, MOST_BESIDE = 512 if os.environ.get("VITRAIL_LONG_TESTS") else 128, 16
PART_MIB, MOST_READS = 2, 4


def command(ranks, net, *words):
    return [str(c) for c in ("mpirun", "--oversubscribe", "-n", ranks, "--mca", "pml", "ob1", "--mca", "btl", f"{net},self", *words)]


def reads_a_part():
    """By rank 0 of the other's memory, while they sum 64 MiB; None where that cannot be told."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "calls")
        strace = ["strace", "-f", "-qq", "-e", "trace=process_vm_readv", "-o", str(file)]
        try:
            subprocess.run(strace + ["true"], check=True, capture_output=True)
        except (OSError, subprocess.CalledProcessError):
            return None
        done = subprocess.run(strace + command(2, "vader", sys.argv[1], 64), capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stderr
        return file.read_text().count("process_vm_readv(") / (64 / PART_MIB) or None


def main():
    wrong = []
    for net in ("tcp", "vader"):
        for ranks in (2, 4):
            for kind in ([], ["film"]):
                done = subprocess.run(command(ranks, net, sys.argv[1], MIB, *kind), capture_output=True, text=True, timeout=300)
                assert done.returncode == 0, done.stderr
                result = json.loads(done.stdout)
                print(f"{net}, {ranks} ranks, {kind or 'numbers'}: {result['beside_mib']} MiB beside {MIB}, {result['s']} s", flush=True)
                # Of a film rank 0 then has pages that it had not touched.
                if not kind and result["beside_mib"] > MOST_BESIDE:
                    wrong.append(f"{result['beside_mib']} MiB beside the sums of {ranks} ranks, {net}")
    reads = reads_a_part()
    print("calls that read a part:", reads or "not told")
    if reads and reads > MOST_READS:
        wrong.append(f"{reads} calls read a part of {PART_MIB} MiB")
    assert not wrong, "; ".join(wrong)


main()
