#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""standstill_test.py PROGRAMS SOURCE PRELOAD: a rank is stopped, or its disk does not answer, at each step of a job; the job names that rank
and no other, ends with status 4 within twice the patience, and the same command makes the film that it would have made. Without
VITRAIL_LONG_TESTS a few of the cases. Prints how many were named rightly, of how many."""
import itertools
import json
import os
import pathlib
import queue
import random
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time

LONG = bool(os.environ.get("VITRAIL_LONG_TESTS"))
PATIENCE_S = 3
AT_ONCE = 4  # jobs: they wait for most of their time
TO_END_S = 8  # what mpirun takes to end the others, on a busy machine
TRANSPORTS = {"TCP": ["--mca", "btl", "tcp,self", "--mca", "pml", "ob1"], "shared memory": ["--mca", "btl", "vader,self", "--mca", "pml", "ob1"]}
# Step of the job: the calls that ranks make there, by their numbers.
STEPS = {
    "start": [("MPI_Init_thread", 1), ("MPI_Ireduce", 1), ("MPI_Ibcast", 1)],
    "set-up": [("round", 1), ("round", 4), ("MPI_Ibcast", 5)],
    "flow": [("round", 12), ("MPI_Isend", 2), ("MPI_Isend", 9)],
    "checkpoint": [("MPI_Ireduce", 3), ("MPI_Ireduce", 4)],
    "gather": [("MPI_Ireduce", 5), ("MPI_Ireduce", 6), ("barrier_of_part", 5)],
    "write": [("round_after_MPI_Ireduce", 1), ("round_after_MPI_Ireduce", 2)],
    "finalise": [("MPI_Ibarrier", 1), ("MPI_Finalize", 1)],
}
programs, source, preload = (pathlib.Path(p).resolve() for p in sys.argv[1:4])
host = os.uname().nodename


def must(*words):
    subprocess.run([str(w) for w in words], check=True, stdout=subprocess.DEVNULL)


def ranks_of(mpirun):
    """The pids of its ranks, by rank."""
    ranks = {}
    try:
        for pid in pathlib.Path(f"/proc/{mpirun}/task/{mpirun}/children").read_text().split():
            variables = pathlib.Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
            ranks |= {int(v[21:]): int(pid) for v in variables if v.startswith(b"OMPI_COMM_WORLD_RANK=")}
    except OSError:  # one has ended meanwhile
        pass
    return ranks


class Job:
    def __init__(self, folder, ranks, transport, standstill="", *options):
        self.film, self.mark, self.log = folder / "a.film", folder / "a.mark", open(folder / "a.log", "w+")
        words = ["mpirun", "-np", ranks, *TRANSPORTS[transport]]
        if standstill:
            words += ["-x", f"LD_PRELOAD={preload}", "-x", f"VITRAIL_STANDSTILL={standstill}", "-x", f"VITRAIL_STANDSTILL_MARK={self.mark}"]
        words += [programs / "vitrail-render", folder.parent / "city.vit", "-o", self.film, "--spp", 16, "--width", 96, "--threads", 1, "--quiet",
                  "--patience", PATIENCE_S, "--checkpoint-every", .05, "--domain-memory", 400000, "--distribution", "decompose",
                  "--stats", folder / "a.json", *options]
        self.begun = time.monotonic()
        self.process = subprocess.Popen([str(w) for w in words], stdout=self.log, stderr=self.log)

    def stands_still_since(self):
        """Seconds; None where the job ended before."""
        while self.process.poll() is None:
            if self.mark.exists():
                return time.monotonic()
            time.sleep(.02)
        return None

    def end(self, timeout_s):
        """Its status; None where it hangs."""
        try:
            return self.process.wait(timeout_s)
        except subprocess.TimeoutExpired:
            for pid in ranks_of(self.process.pid).values():
                os.kill(pid, signal.SIGKILL)
            self.process.kill()
            self.process.wait()
            return None

    def said(self):
        self.log.seek(0)
        return self.log.read()


def named(text):
    """The ranks that messages name as those that stand still."""
    ranks = set()
    one = r"\d+(?: \([^)]*\))?"
    for names in re.findall(rf": ranks? ({one}(?:, {one})*) ha(?:s|ve) not answered", text):
        ranks |= {int(r) for r in re.sub(r"\([^)]*\)", "", names).split(", ")}
    ranks |= {int(r) for r in re.findall(r"vitrail: rank (\d+) of \d+ \([^)]*\): (?!.* is stopped).* has not gone on", text)}
    for names in re.findall(r"of this host's ranks ([\d, ]+) (?:is|are) stopped", text):
        ranks |= {int(r) for r in names.split(",")}
    return ranks


class Matrix:
    def __init__(self, folder, expected):
        self.folder, self.expected = folder, expected
        self.right = self.all = 0
        self.longest_s = 0.

    def note(self, what, rank, job, status, seconds, file=""):
        text = job.said()
        found = named(text)
        wrong = []
        # Open MPI 4.1.4's mpirun itself dies now and then where two ranks end the job together.
        if status != 4 and "PMIx_server_finalize" not in text:
            wrong.append(f"status {status}")
        if found != {rank}:
            wrong.append(f"ranks {sorted(found)} are named")
        if file and file not in text:
            wrong.append(f"{file} is not named")
        if seconds > 2 * PATIENCE_S + TO_END_S:
            wrong.append(f"{seconds:.1f} s")
        self.all += 1
        self.right += not wrong
        self.longest_s = max(self.longest_s, seconds)
        print(f"{'right' if not wrong else 'WRONG'} {seconds:5.1f} s  {what}" + (f": {', '.join(wrong)}\n{text}" if wrong else ""), flush=True)

    def clear(self):
        for file in self.folder.glob("a.*"):
            file.unlink()

    def goes_on(self, ranks, transport):
        """The same command ends it, with the film of a job that nothing happened to."""
        job = Job(self.folder, ranks, transport)
        assert job.end(120) == 0, job.said()
        assert json.loads((self.folder / "a.json").read_text())["film_hash"] == self.expected

    def stop(self, ranks, rank, transport, step, call, number):
        self.clear()
        job = Job(self.folder, ranks, transport, f"{rank} {call} {number} stop")
        begun = job.stands_still_since()
        what = f"{step}: rank {rank} of {ranks} stops in {call} {number}, {transport}"
        if begun is None:
            assert job.end(60) == 0, job.said()
            return print(f"      -    {what}: it makes no such call")
        status = job.end(4 * PATIENCE_S + 20)
        self.note(what, rank, job, status, time.monotonic() - begun)
        if self.all % 7 == 1:
            self.goes_on(ranks, transport)

    def stop_in_flow(self, ranks, rank, transport, after_s):
        """By a signal from outside: in whatever it does."""
        self.clear()
        job = Job(self.folder, ranks, transport, "", "--spp", 4096)
        while len(found := ranks_of(job.process.pid)) < ranks or not (self.folder / "a.film.partial").exists():
            assert job.process.poll() is None, job.said()
            time.sleep(.01)
        time.sleep(after_s)
        os.kill(found[rank], signal.SIGSTOP)
        begun = time.monotonic()
        status = job.end(4 * PATIENCE_S + 20)
        self.note(f"flow: rank {rank} of {ranks} is stopped after {after_s:.3f} s, {transport}", rank, job, status, time.monotonic() - begun)

    def suspend(self, ranks, seconds):
        """All of a job stands still, as under `scontrol suspend`: nobody is missing."""
        self.clear()
        job = Job(self.folder, ranks, "shared memory", "", "--spp", 1024)
        while len(found := ranks_of(job.process.pid)) < ranks or not (self.folder / "a.film.partial").exists():
            assert job.process.poll() is None, job.said()
            time.sleep(.01)
        for number, wait_s in ((signal.SIGSTOP, seconds), (signal.SIGCONT, 1.5 * PATIENCE_S)):
            for pid in found.values():
                os.kill(pid, number)
            time.sleep(wait_s)
        self.all += 1
        right = job.process.poll() in (None, 0) and not job.said()
        self.right += right
        print(f"{'right' if right else 'WRONG'}          all {ranks} ranks are suspended for {seconds} s{'' if right else job.said()}", flush=True)
        job.process.terminate()
        job.end(60)

    def checkpoint_asked_for_in_set_up(self):
        """USR1 ends no rank, however early it comes."""
        self.clear()
        job = Job(self.folder, 2, "shared memory", "0 open 1 1 manifest.json")
        assert job.stands_still_since() is not None
        job.process.send_signal(signal.SIGUSR1)
        status = job.end(120)
        self.all += 1
        right = status == 0 and json.loads((self.folder / "a.json").read_text())["film_hash"] == self.expected
        self.right += right
        print(f"{'right' if right else 'WRONG'}          USR1 while the scene is read: status {status}" + ("" if right else "\n" + job.said()),
              flush=True)

    def damaged_while_disk_hangs(self):
        """Rank 0 finds a damaged domain while rank 1's loader hangs: both are told, and the job ends. By itself: others need the domain."""
        self.clear()
        domain = min((self.folder.parent / "city.vit/domains").iterdir())
        whole = domain.read_bytes()
        domain.write_bytes(whole[:-1] + bytes([whole[-1] ^ 1]))
        job = Job(self.folder, 2, "shared memory", "1 open 1 1000 domains/")
        begun = job.stands_still_since()
        status = job.end(4 * PATIENCE_S + 20)
        seconds, text = time.monotonic() - begun, job.said()
        domain.write_bytes(whole)
        right = status in (3, 4) and "rank 1 of 2" in text and domain.name in text and seconds < 2 * PATIENCE_S + TO_END_S
        self.all += 1
        self.right += right
        print(f"{'right' if right else 'WRONG'} {seconds:5.1f} s  a damaged domain on rank 0 while rank 1's disk hangs: status {status}"
              + ("" if right else "\n" + text), flush=True)

    def disk(self, ranks, rank, call, number, file, how):
        """A call that never returns, or one that takes long and is waited for."""
        self.clear()
        job = Job(self.folder, ranks, "shared memory", f"{rank} {call} {number} {how} {file}")
        what = f"disk: {call} {number} of {file} on rank {rank} of {ranks}, {how} s"
        if how < PATIENCE_S:
            status = job.end(300)
            self.all += 1
            right = status == 0 and json.loads((self.folder / "a.json").read_text())["film_hash"] == self.expected
            self.right += right
            return print(f"{'right' if right else 'WRONG'}          {what}: status {status}" + ("" if right else "\n" + job.said()), flush=True)
        begun = job.stands_still_since()
        assert begun is not None, f"{what}: it makes no such call"
        status = job.end(4 * PATIENCE_S + 20)
        self.note(what, rank, job, status, time.monotonic() - begun, file)


def cases(dice):
    """All of them but damaged_while_disk_hangs: methods of Matrix and their arguments."""
    found = []
    all_ranks = (2, 4) if LONG else (2,)
    for ranks in all_ranks:
        stops = list(itertools.product(range(ranks), TRANSPORTS, [(s, *c) for s, calls in STEPS.items() for c in calls]))
        found += [(Matrix.stop, ranks, *case[:2], *case[2]) for case in (stops if LONG else dice.sample(stops, 6))]
    moments = list(itertools.product(all_ranks, range(4), TRANSPORTS, range(8)))
    found += [(Matrix.stop_in_flow, ranks, rank, transport, dice.uniform(0, 1))
              for ranks, rank, transport, _ in (moments if LONG else [(2, 1, "TCP", 0), (4, 2, "TCP", 0), (3, 0, "shared memory", 0)]) if rank < ranks]
    disks = [(1, "open", 1, "manifest.json"), (0, "open", 3, "domains/"), (1, "mmap", 2, "domains/"), (1, "pread", 1, "manifest"),
             (0, "fsync", 1, "a.film"), (0, "fsync", 1, "a.film.partial"), (0, "open", 1, "a.film")]
    found += [(Matrix.disk, 2, *case, 1000) for case in disks]
    return found + [(Matrix.disk, 2, 1, "open", 1, "domains/", .05), (Matrix.checkpoint_asked_for_in_set_up,), (Matrix.suspend, 3, 2.5 * PATIENCE_S)]


def try_all(found, matrices):
    """Tries the cases, one at a time in each matrix. Returns the errors that ended some."""
    waiting, errors = queue.SimpleQueue(), []
    for case in found:
        waiting.put(case)

    def work(matrix):
        try:
            while True:
                method, *arguments = waiting.get_nowait()
                method(matrix, *arguments)
        except queue.Empty:
            pass
        except BaseException as error:  # pylint: disable=broad-except
            errors.append(error)

    workers = [threading.Thread(target=work, args=(matrix,)) for matrix in matrices]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    return errors


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        folders = [folder / str(i) for i in range(AT_ONCE)]
        for own in folders:
            own.mkdir()
        must("/usr/bin/python3", source / "examples/city/generate.py", "-o", folder / "city", "--triangles", 80000)
        scene = next((folder / "city").glob("*.pbrt"))
        must(programs / "vitrail", "partition", scene, "-o", folder / "city.vit", "--domains", 16, "--quiet")
        job = Job(folders[0], 1, "shared memory")
        assert job.end(120) == 0, job.said()
        expected = json.loads((folders[0] / "a.json").read_text())["film_hash"]
        matrices = [Matrix(own, expected) for own in folders]
        errors = try_all(cases(random.Random(39)), matrices)
        if errors:
            raise errors[0]
        matrices[0].damaged_while_disk_hangs()
        right, tried = sum(m.right for m in matrices), sum(m.all for m in matrices)
        print(f"{right} of {tried} named rightly; the longest took {max(m.longest_s for m in matrices):.1f} s with --patience {PATIENCE_S}")
        return right != tried


sys.exit(main())
