#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""reduction_test.py CLUSTER_REDUCTION: what a sum over ranks takes of rank 0's memory beside the sums, over TCP and in shared memory: a
few parts, however much there is to sum."""
import json
import subprocess
import sys

MIB, MOST_BESIDE = 512, 16


def main():
    wrong = []
    for net in ("tcp", "vader"):
        for ranks in (2, 4):
            command = ["mpirun", "--oversubscribe", "-n", ranks, "--mca", "pml", "ob1", "--mca", "btl", f"{net},self", sys.argv[1], MIB]
            done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=300)
            assert done.returncode == 0, done.stderr
            beside = json.loads(done.stdout)["beside_mib"]
            print(f"{net}, {ranks} ranks: {beside} MiB beside {MIB}", flush=True)
            if beside > MOST_BESIDE:
                wrong.append(f"{beside} MiB beside the sums of {ranks} ranks, {net}")
    assert not wrong, "; ".join(wrong)


main()
