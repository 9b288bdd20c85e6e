#!/usr/bin/env python3
"""Checks the direction of every #include against docs/adr/0005-stages.md.

usage: check_includes.py [ROOT]

- A stage of src/ includes only itself and the stages before it in STAGES, and public headers (include/abut).
- contact/ includes only include/abut, simd/ and itself; no other stage includes its private headers.
- include/abut includes only the standard library and include/abut.
- A library that belongs to one stage (MPI, VTK, CLI11) is included there only.
- A quoted include names a file that exists.
Files of more than 500 lines are listed as warnings. Exit status 1 if a rule is broken. Standard library only.
"""
import re
import sys
from pathlib import Path

STAGES = ["core", "simd", "parallel", "deck", "model", "materials", "elements", "contact", "state", "init",
          "constraints", "cycle", "output", "report", "run"]
# Header pattern -> the only folders (relative to the root) that may include it.
RESERVED = [
    (re.compile(r"^mpi\.h$"), ("src/parallel/",), "MPI"),
    (re.compile(r"^vtk\w*\.h$"), ("src/report/",), "VTK"),
    (re.compile(r"^CLI/"), ("apps/",), "CLI11"),
    (re.compile(r"^pybind11/"), ("bindings/",), "pybind11"),
]
LONG_FILE = 500
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def includes(path):
    """(line number, quoted?, name) of every #include of a file, comments left out."""
    inside = False
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if inside:
            end = line.find("*/")
            if end < 0:
                continue
            line, inside = line[end + 2:], False
        line = re.sub(r"/\*.*?\*/", "", line)
        if "/*" in line:
            line, inside = line[:line.index("/*")], True
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1) == '"', match.group(2)


def stage_of(relative):
    """Stage of a file of src/, or None."""
    parts = relative.split("/")
    return parts[1] if parts[0] == "src" and len(parts) > 2 else None


def check_file(root, path):
    relative = path.relative_to(root).as_posix()
    stage = stage_of(relative)
    if relative.startswith("src/") and stage not in STAGES:
        yield 0, f"'{relative}' is in no stage; the stages are {', '.join(STAGES)}"
        return
    for number, quoted, name in includes(path):
        for pattern, folders, library in RESERVED:
            if pattern.match(name) and not relative.startswith(folders):
                yield number, f"<{name}>: {library} is used in {' and '.join(folders)} only"
        first = name.split("/")[0]
        is_private = first in STAGES and (root / "src" / name).is_file()
        is_public = first == "abut" and (root / "include" / name).is_file()
        if first in STAGES and not is_private and "/" in name:
            yield number, f'"{name}": no such file in src/'
        if first == "abut" and not is_public:
            yield number, f'"{name}": no such file in include/'
        if relative.startswith("include/"):
            if not is_public and (quoted or "/" in name or name.endswith(".h")):
                yield number, f"{name}: a public header includes the standard library and include/abut only"
        elif stage == "contact":
            if not is_public and first not in ("contact", "simd") and (quoted or "/" in name or name.endswith(".h")):
                yield number, f"{name}: contact/ includes include/abut, simd/ and itself only"
        elif stage and is_private:
            if first == "contact":
                yield number, f'"{name}": contact/ is used through include/abut/contact only'
            elif STAGES.index(first) > STAGES.index(stage):
                yield number, f'"{name}": {stage}/ comes before {first}/ and must not include it'
        elif stage and quoted and not is_public:
            if not (path.parent / name).is_file():
                yield number, f'"{name}": write it as "stage/file.hpp"'


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    faults = warnings = files = 0
    for folder in ("include", "src", "apps", "bindings"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".hpp", ".cpp", ".h"):
                continue
            files += 1
            relative = path.relative_to(root).as_posix()
            for number, message in check_file(root, path):
                print(f"{relative}:{number}: {message}")
                faults += 1
    for folder in ("include", "src", "apps", "bindings", "tests", "bench", "examples"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".hpp", ".cpp", ".h", ".py"):
                lines = len(path.read_text(encoding="utf-8").splitlines())
                if lines > LONG_FILE:
                    print(f"{path.relative_to(root).as_posix()}: warning: {lines} lines (more than {LONG_FILE})")
                    warnings += 1
    print(f"{files} files checked: {faults} faults, {warnings} warnings")
    return 1 if faults or files == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
