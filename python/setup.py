# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the extension with CMake, and puts it into a wheel: what build_wheel.sh runs, and pip."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent.parent
BUILD = Path(os.environ.get("RIDGECRAFT_BUILD", ROOT / "build" / "python"))


def version() -> str:
    found = re.search(r"project\(ridgecraft VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())
    assert found, "CMakeLists.txt names no version"
    return found.group(1)


class BuildWithCMake(build_ext):
    def build_extension(self, ext: Extension) -> None:
        # The release build, without the program: libraries and the module.
        subprocess.run(
            ["cmake", "-G", "Ninja", "-S", ROOT, "-B", BUILD, "-DCMAKE_BUILD_TYPE=Release",
             "-DRIDGECRAFT_UNITY=ON", "-DRIDGECRAFT_PROGRAM=OFF", "-DRIDGECRAFT_PYTHON=ON",
             f"-DPython_EXECUTABLE={sys.executable}",
             # What others call so, too: options that come last, and count.
             *shlex.split(os.environ.get("CMAKE_ARGS", ""))],
            check=True,
        )
        subprocess.run(["cmake", "--build", BUILD, "--target", "ridgecraft_python"], check=True)
        built = next((BUILD / "python" / "ridgecraft").glob("_core.*.so"))
        target = Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(built), str(target))
        self.copy_file(str(ROOT / "LICENSE"), str(target.parent / "LICENSE"))


setup(
    name="ridgecraft",
    version=version(),
    description="Nearly convex parts of meshes, their hulls, and paper models",
    license="GPL-3.0-or-later",
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["ridgecraft"],
    package_data={"ridgecraft": ["_core.pyi", "py.typed"]},
    ext_modules=[Extension("ridgecraft._core", sources=[])],
    cmdclass={"build_ext": BuildWithCMake},
)
