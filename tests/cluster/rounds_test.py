#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""rounds_test.py CLUSTER_ROUNDS [RANKS...]: what a round costs a rank, over TCP and in shared memory: the sockets that it has open,
the messages that it sends, and its processor time. Sockets and messages do not grow with the ranks (4 and 16, or those given):
a rank speaks with its parent and four children at most. Open MPI's own monitoring counts the messages."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

program = pathlib.Path(sys.argv[1]).resolve()
counts = [int(n) for n in sys.argv[2:]] or [4, 16]
MOST = 5  # neighbours
OWN_SOCKETS = 4  # mpirun's and those that listen, and one to spare
ROUNDS = 60


FEW_FILES = 200  # the soft limit of a rank, which takes as many as it may


def run(net, ranks, rounds, *options):
    command = ["mpirun", "--oversubscribe", "-n", ranks, "--mca", "btl", f"{net},self", *options,
               "sh", "-c", f'ulimit -Sn {FEW_FILES}; exec "$@"', "sh", program, rounds]
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def messages(net, ranks, rounds):
    """What each rank sent in all, and to how many others at most."""
    with tempfile.TemporaryDirectory() as folder:
        run(net, ranks, rounds, "--mca", "pml", "ob1,monitoring", "--mca", "pml_monitoring_enable", 2,
            "--mca", "pml_monitoring_enable_output", 3, "--mca", "pml_monitoring_filename", f"{folder}/sent")
        sent, files = [0] * ranks, list(pathlib.Path(folder).iterdir())
        assert len(files) == ranks, "Open MPI counts no messages"
        for file in files:
            for rank, number in re.findall(r"^[EI]\s+(\d+)\s.*?(\d+) msgs sent", file.read_text(), re.M):
                sent[int(rank)] += int(number)
    return sent


def main():
    wrong = []
    for net in ("tcp", "vader"):
        for ranks in counts:
            cost = run(net, ranks, ROUNDS)
            first, all_ = messages(net, ranks, 0), messages(net, ranks, ROUNDS)
            most = max(b - a for a, b in zip(first, all_)) / ROUNDS
            print(f"{net}, {ranks} ranks: {cost['sockets']} sockets, {most:.1f} messages a round at most, {cost['us']:.0f} us a round",
                  flush=True)
            if cost["files"] <= FEW_FILES:
                wrong.append(f"a rank may open {cost['files']} files, though it is allowed more")
            if net == "tcp" and cost["sockets"] > OWN_SOCKETS + MOST:
                wrong.append(f"{cost['sockets']} sockets of a rank of {ranks}")
            if most > MOST + .5:
                wrong.append(f"{most:.1f} messages a round of a rank of {ranks}, {net}")
    assert not wrong, "; ".join(wrong)


main()
