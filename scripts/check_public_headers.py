#!/usr/bin/env python3
"""Compiles every header of include/abut alone, twice in a row, without a warning and without any other include path.

usage: check_public_headers.py COMPILER [ROOT]

Exit status 1 if a header does not compile. Standard library only.
"""
import subprocess
import sys
from pathlib import Path

FLAGS = ["-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wconversion", "-Wpedantic", "-Werror", "-x", "c++"]


def main():
    compiler = sys.argv[1]
    root = Path(sys.argv[2] if len(sys.argv) > 2 else Path(__file__).parent.parent).resolve()
    include = root / "include"
    headers = sorted(include.rglob("*.hpp"))
    bad = 0
    for header in headers:
        name = header.relative_to(include).as_posix()
        # Twice: a header without include guard is found, too.
        source = f"#include <{name}>\n#include <{name}>\nint main() {{ return 0; }}\n"
        run = subprocess.run([compiler, *FLAGS, "-I", str(include), "-"], input=source, text=True, capture_output=True)
        if run.returncode != 0:
            bad += 1
            print(f"include/{name} does not compile alone:\n{run.stderr}")
    print(f"{len(headers)} public headers compiled alone: {bad} failed")
    return 1 if bad or not headers else 0


if __name__ == "__main__":
    sys.exit(main())
