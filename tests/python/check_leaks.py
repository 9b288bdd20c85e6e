#!/usr/bin/env python3
"""The Python tests with every block of memory watched: nothing that abut's module allocated is lost.

usage: check_leaks.py MODULE_FOLDER LIBASAN [TEST_FILE ...]     all tests/python/test_*.py if not told

The module there has the address sanitizer in it (target abut_python_sanitized); its runtime LIBASAN is loaded before the interpreter, which has none,
and Python's own allocator is switched off (PYTHONMALLOC=malloc), so that the sanitizer sees every block. After the tests, while the interpreter still
lives (at its end it leaves much behind), the leak sanitizer looks for blocks to which no pointer is left (leak_plugin.py). Such a block counts when
the module is on its stack; others are the interpreter's and numpy's, and counted. Wrong accesses end the tests.
First the check itself is tried: an array of abut's that is lost on purpose must be found. Objects of abut's own classes are in pybind11's register and so never
without a pointer; what grows with those is looked for by the tests themselves (test_nothing_leaks).
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
LOSE_ONE = """
import ctypes, abut, leak_plugin
def lose():
    array = abut.contact.Surface([[0, 1, 2]]).neighbours
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(array))
lose()
leak_plugin.look()
"""


def environment_of(module, runtime, log):
    return {**os.environ, "PYTHONPATH": f"{module}:{HERE}", "PYTHONMALLOC": "malloc", "PYTHONDONTWRITEBYTECODE": "1", "PYTHONNOUSERSITE": "1",
            "OMP_NUM_THREADS": "1", "LD_PRELOAD": runtime,
            # At the end the interpreter has given up what it still holds. Stacks through objects without frame pointers need the slow way.
            "ASAN_OPTIONS": f"detect_leaks=1:leak_check_at_exit=0:detect_container_overflow=0:fast_unwind_on_malloc=0:malloc_context_size=12:log_path={log}",
            "LSAN_OPTIONS": "print_suppressions=0"}


def losses(folder):
    """[(whether abut's, text)] of the leak sanitizer's logs in a folder."""
    text = "\n".join(path.read_text(errors="replace") for path in sorted(Path(folder).glob("log.*")))
    blocks = re.findall(r"^(?:Direct|Indirect) leak of .*?\n\n", text + "\n\n", flags=re.M | re.S)
    return [("/_native" in block or "abut::" in block, block) for block in blocks]


def run(module, runtime, command):
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, *command], env=environment_of(module, runtime, Path(folder) / "log"), cwd=folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        logs = "".join(path.read_text(errors="replace") for path in Path(folder).glob("log.*"))
        accesses = re.search(r"^==\d+==ERROR: AddressSanitizer.*?(?=^==\d+==ABORTING|\Z)", logs, flags=re.M | re.S)
        return done.returncode, (accesses.group(0)[:6000] if accesses else "") + done.stdout, losses(folder)


def main():
    module, runtime = str(Path(sys.argv[1]).resolve()), sys.argv[2]
    files = [str(Path(file).resolve()) for file in sys.argv[3:]] or sorted(str(path) for path in HERE.glob("test_*.py"))
    status, output, found = run(module, runtime, ["-c", LOSE_ONE])
    if status != 0 or not any(ours for ours, _ in found):
        print(f"the check does not find what is lost on purpose:\n{output}")
        return 1
    faults = 0
    for file in files:
        status, output, found = run(module, runtime, ["-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", "-p", "leak_plugin", file])
        ours = [block for mine, block in found if mine]
        last = output.strip().splitlines()[-1:] or ["no output"]
        print(f"{Path(file).name}: {last[0]}; {len(ours)} blocks of abut lost, {len(found) - len(ours)} of others", flush=True)
        for block in ours[:10]:
            print(block)
        if status != 0:
            print(output[-6000:])
        faults += len(ours) + (status != 0)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
