#!/usr/bin/env python3
"""The Python tests under valgrind: no wrong access in abut's code, nothing of abut's lost.

usage: check_memory.py MODULE_FOLDER [TEST_FILE ...]     all tests/python/test_*.py if not told

A report counts when abut's module is on its stack; what the interpreter and numpy do by themselves does not. Two things are told apart:
errors (access to memory that is not there or not initialised) and losses (`definitely lost`: no pointer to it is left). The sanitizers' build runs
the same tests (full.sanitizers) without looking for losses, because the interpreter is full of them. Exit status 77: no valgrind.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SUPPRESSIONS = Path("/usr/lib/valgrind/python3.supp")


def reports(text):
    """Blocks of valgrind's output, without its numbers in front of the lines."""
    lines = [re.sub(r"^==\d+== ?", "", line) for line in text.splitlines() if re.match(r"^==\d+==", line)]
    return [block for block in "\n".join(lines).split("\n\n") if re.search(r"^ +at 0x", block, flags=re.M)]


def main():
    if shutil.which("valgrind") is None:
        print("skipped: no valgrind (Debian: valgrind; scripts/install-deps --full)")
        return 77
    module = str(Path(sys.argv[1]).resolve())
    files = [str(Path(file).resolve()) for file in sys.argv[2:]] or sorted(str(path) for path in HERE.glob("test_*.py"))
    environment = {**os.environ, "PYTHONPATH": module, "PYTHONMALLOC": "malloc", "PYTHONDONTWRITEBYTECODE": "1", "OMP_NUM_THREADS": "1"}
    faults = 0
    for file in files:
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder) / "log"
            command = ["valgrind", "--leak-check=full", "--show-leak-kinds=definite", "--errors-for-leak-kinds=definite", "--num-callers=40",
                       f"--log-file={log}", *([f"--suppressions={SUPPRESSIONS}"] if SUPPRESSIONS.exists() else []),
                       sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", file]
            done = subprocess.run(command, env=environment, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            found = reports(log.read_text(errors="replace"))
        ours = [block for block in found if "_native" in block or "abut::" in block]
        print(f"{Path(file).name}: {done.stdout.strip().splitlines()[-1]}; {len(ours)} reports of abut's code, {len(found) - len(ours)} of others", flush=True)
        for block in ours[:10]:
            print(block, "\n")
        if done.returncode != 0:
            print(done.stdout[-3000:])
        faults += len(ours) + (done.returncode != 0)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
