#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A Python that has imported Mitsuba and forks for each script: importing it takes longer than most scripts.

    mitsuba_server.py --serve SOCKET          answers until its standard input ends; fails where there is no Mitsuba
    mitsuba_server.py SOCKET SCRIPT ARG ...   runs SCRIPT there, as `python3 SCRIPT ARG ...` would
    mitsuba_server.py SOCKET -c TEXT          runs TEXT there
"""
import os
import socket
import sys
import time


def run_script(folder, arguments):
    import runpy
    os.chdir(folder)
    if arguments[0] == "-c":
        sys.argv = ["-c"] + arguments[2:]
        exec(compile(arguments[1], "-c", "exec"), {"__name__": "__main__"})
    else:
        sys.argv = arguments
        sys.path[0] = os.path.dirname(arguments[0])
        runpy.run_path(arguments[0], run_name="__main__")


def status_of(folder, arguments, streams):
    """Runs the script in a process of its own and returns its exit status."""
    child = os.fork()
    if child == 0:
        for number, stream in enumerate(streams, 1):
            os.dup2(stream, number)
        try:
            run_script(folder, arguments)
            status = 0
        except SystemExit as end:
            status = end.code if isinstance(end.code, int) else int(end.code is not None)
        except BaseException:
            import traceback
            traceback.print_exc()
            status = 1
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) & 0xff


def serve(path):
    import select
    import mitsuba  # noqa: F401
    import numpy  # noqa: F401
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(path + ".new")
    listener.listen()
    os.rename(path + ".new", path)  # who sees it is answered
    while True:
        if sys.stdin in select.select([sys.stdin, listener], [], [])[0]:
            os.unlink(path)
            return
        asker = listener.accept()[0]
        text, streams, _, _ = socket.recv_fds(asker, 1 << 20, 2)
        folder, *arguments = text.decode().split("\0")
        asker.send(bytes([status_of(folder, arguments, streams)]))
        asker.close()
        for stream in streams:
            os.close(stream)


def ask(path, arguments):
    connection, until = socket.socket(socket.AF_UNIX), time.monotonic() + 60
    while not os.path.exists(path) and time.monotonic() < until:
        time.sleep(.02)
    connection.connect(path)
    socket.send_fds(connection, ["\0".join([os.getcwd(), *arguments]).encode()], [1, 2])
    answer = connection.recv(1)
    return answer[0] if answer else 1


if sys.argv[1] == "--serve":
    serve(sys.argv[2])
else:
    sys.exit(ask(sys.argv[1], sys.argv[2:]))
