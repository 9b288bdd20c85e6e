#!/usr/bin/env python3
"""The documented way into a virtual environment, without a network: install with pip, build a wheel, use both.

usage: check_package.py SOURCE BUILD     the module of the build folder BUILD is taken (ABUT_BUILD_DIR), not compiled again
"""
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

USE = """
import abut, pathlib, sys
assert pathlib.Path(abut.__file__).is_relative_to(sys.prefix), abut.__file__
run = abut.Run(abut.Model.read(sys.argv[1]))
run.advance(20)
print(abut.__version__, run.cycle, abut.contact.Surface([[0, 1, 2]]))
"""


def main():
    source, build = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    environment = {**os.environ, "ABUT_BUILD_DIR": str(build), "PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    environment.pop("PYTHONPATH", None)
    deck = source / "examples" / "decks" / "twoblocks" / "twoblocks_0000.rad"
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        # pip builds in the folder that it is given: a copy keeps the sources clean, links lead back to the rest of the clone.
        clone = work / "clone"
        (clone / "bindings").mkdir(parents=True)
        shutil.copytree(source / "bindings" / "python", clone / "bindings" / "python")
        (clone / "CMakeLists.txt").symlink_to(source / "CMakeLists.txt")
        package = str(clone / "bindings" / "python")

        def use(name, *install):
            subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", str(work / name)], check=True)
            python = work / name / "bin" / "python"
            subprocess.run([str(python), "-m", "pip", "install", "--quiet", "--no-build-isolation", "--no-index", *install], check=True,
                           env=environment)
            subprocess.run([str(python), "-c", USE, str(deck)], check=True, env=environment, cwd=work)

        use("installed", package)
        subprocess.run([sys.executable, "-m", "pip", "wheel", "--quiet", "--no-build-isolation", "--no-index", "--no-deps", "-w",
                        str(work / "wheels"), package], check=True, env=environment)
        (wheel,) = (work / "wheels").glob("abut-*.whl")
        print(wheel.name)
        use("from_wheel", str(wheel))


if __name__ == "__main__":
    main()
