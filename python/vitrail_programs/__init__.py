# SPDX-License-Identifier: Apache-2.0
"""The programs of Vitrail, where the wheel brings them: `vitrail VERB ...`, found by `program()`.

Three of them contain CGAL and are under GPL-3.0-or-later; `vitrail VERB --version` says which. The libraries that they
need lie beside them, but for Open MPI: the machine's is used where there is one, so that mpirun and the ranks agree.
Nothing is imported here that a program does not need: it starts at once.
"""

import os
import pathlib
import shutil
import sys

_folder = pathlib.Path(__file__).parent


def program():
    """The program `vitrail`: $VITRAIL, else that of the wheel, else another one on the PATH. None where there is none."""
    if os.environ.get("VITRAIL"):
        return os.environ["VITRAIL"]
    if (_folder / "bin/vitrail").exists():
        return str(_folder / "bin/vitrail")
    own = os.path.realpath(sys.argv[0])
    folders = [f for f in os.get_exec_path() if os.path.realpath(os.path.join(f, "vitrail")) != own]
    return shutil.which("vitrail", path=os.pathsep.join(folders))


def environment():
    """The environment of the programs: where the machine has no Open MPI 4, they load the wheel's, for one process."""
    variables = dict(os.environ)
    if not (_folder / "mpi").exists() or _machine_has_mpi():
        return variables
    before = variables.get("LD_LIBRARY_PATH")
    variables["LD_LIBRARY_PATH"] = str(_folder / "mpi") + (os.pathsep + before if before else "")
    return variables


def _machine_has_mpi():
    import ctypes

    try:
        ctypes.CDLL("libmpi.so.40")
    except OSError:
        return False
    return True


def main():
    found = program()
    if not found:
        print("vitrail: this Python package came without the programs, and none is on the PATH "
              "(the environment variable VITRAIL may name it)", file=sys.stderr)
        sys.exit(4)
    os.execve(found, [found, *sys.argv[1:]], environment())
