# SPDX-License-Identifier: Apache-2.0
"""The verbs of `vitrail` as functions.

Options are those of the command line with _ for -: `spp=16` is --spp 16, `adaptive=True` --adaptive, a list
an option that repeats. The program is $VITRAIL, else that of the wheel, else `vitrail` on the PATH.
"""

import json
import os
import pathlib
import subprocess
import tempfile

import numpy as np
import vitrail_programs

from ._vitrail import Film


class ProgramError(RuntimeError):
    """A program failed; `status` is its exit status: 1 differs, 2 usage, 3 input, 4 machine."""

    def __init__(self, status, message):
        super().__init__(message or f"vitrail ended with status {status}")
        self.status = status


def _program():
    program = vitrail_programs.program()
    if not program:
        raise FileNotFoundError("vitrail is not on the PATH; the environment variable VITRAIL may name it")
    return program


def _words(options):
    words = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif value is not False and value is not None:
            for one in value if isinstance(value, (list, tuple)) else [value]:
                words += [option, os.fspath(one) if isinstance(one, os.PathLike) else str(one)]
    return words


def _run(words, report=None):
    """Runs vitrail; each line of its standard output goes to `report`."""
    with tempfile.TemporaryFile() as said:
        with subprocess.Popen([_program(), *words], stdout=subprocess.PIPE, stderr=said, text=True,
                              env=vitrail_programs.environment()) as process:
            try:
                for line in process.stdout:
                    if report:
                        report(line)
            except BaseException:
                process.terminate()  # render leaves a checkpoint
                raise
        if process.returncode != 0:
            said.seek(0)
            raise ProgramError(process.returncode, said.read().decode(errors="replace").strip())


def convert(scene, output, *, report=None, **options):
    """Writes a scene in another format. Returns the report: what is exact, approximated or dropped."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(report) if report else pathlib.Path(folder) / "report.json"
        _run(["convert", os.fspath(scene), os.fspath(output), "--report", os.fspath(file), *_words(options)])
        return json.loads(file.read_text(encoding="utf-8"))


def partition(scene, bundle, **options):
    """Cuts a scene into a bundle. Returns the bundle's path."""
    _run(["partition", os.fspath(scene), "-o", os.fspath(bundle), *_words(options)])
    return pathlib.Path(bundle)


def render(scene, output, *, progress=None, **options):
    """Renders a scene or a bundle, and returns the Film, which is kept beside the output as NAME.film.

    `output` is a picture, or the film itself. `progress` is called with a dict as often as
    `render --progress json` says something, the last time with "event": "end". What it raises stops the
    render, which leaves a checkpoint: the same call goes on.
    """
    report = (lambda line: progress(json.loads(line))) if progress else None
    film = pathlib.Path(output).with_suffix(".film")
    way = ["--progress", "json" if progress else "none"]
    _run(["render", os.fspath(scene), "-o", os.fspath(film), *way, *_words(options)], report)
    if film != pathlib.Path(output):
        _run(["develop", os.fspath(film), "-o", os.fspath(output)])
    return Film(film)


def statistics(file):
    """What `--stats FILE` wrote, as a dict; lists of numbers are arrays."""

    def with_arrays(value):
        if isinstance(value, dict):
            return {name: with_arrays(one) for name, one in value.items()}
        if isinstance(value, list) and value and all(isinstance(one, (int, float)) for one in value):
            return np.array(value)
        return [with_arrays(one) for one in value] if isinstance(value, list) else value

    return with_arrays(json.loads(pathlib.Path(file).read_text(encoding="utf-8")))
