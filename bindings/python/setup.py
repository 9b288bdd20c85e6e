"""Builds the package abut from a clone of the repository: CMake makes the module, setuptools packs it.

ABUT_BUILD_DIR=DIR uses a build folder that exists already, e.g. build/release; without it the module is built in build/python.
CMAKE_BUILD_PARALLEL_LEVEL is the number of compilers at a time (2 if it is not set).
"""
import os
import re
import subprocess
import sys
import sysconfig
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent


def version():
    return re.search(r"project\(abut VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)


class CMakeBuild(build_ext):
    """The one extension is the CMake target abut_python."""

    def build_extension(self, ext):
        given = os.environ.get("ABUT_BUILD_DIR")
        build = Path(given).resolve() if given else ROOT / "build" / "python"
        if not given or not (build / "CMakeCache.txt").is_file():
            # Headers belong to the interpreter below a virtual environment.
            base = Path(sysconfig.get_config_var("BINDIR")) / f"python{sys.version_info[0]}.{sys.version_info[1]}"
            python = base if base.is_file() else Path(sys.executable)
            subprocess.run(["cmake", "-S", str(ROOT), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release", "-DABUT_BUILD_TESTS=OFF",
                            "-DABUT_PYTHON=ON", f"-DPython_EXECUTABLE={python}"], check=True)
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", "2")
        subprocess.run(["cmake", "--build", str(build), "--target", "abut_python", "--parallel", jobs], check=True)
        suffix = sysconfig.get_config_var("EXT_SUFFIX")
        module = build / "python" / "abut" / f"_native{suffix}"
        if not module.is_file():
            raise FileNotFoundError(f"{module}: {build} was configured for another interpreter than {sys.executable}")
        target = Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(module), str(target))


setup(version=version(), packages=["abut"], package_data={"abut": ["py.typed", "*.pyi"]}, ext_modules=[Extension("abut._native", [])],
      cmdclass={"build_ext": CMakeBuild}, zip_safe=False)
