#!/usr/bin/env python3
"""Checks the objects of a build against docs/determinism.md.

usage: check_isa_objects.py BUILD_DIR [--nm NM] [--state-path STAGE ...]

Objects that are built per instruction set (target abut_<stage>_<isa>):
- what they define is in namespace abut or internal to the object: no inline function of a common library, which the
  linker could pick for the whole program and which an older CPU cannot run;
- what they define weakly (inline functions, templates) is defined by no object that was built for another set;
- what they import from the maths library is exact in IEEE 754 (sqrt, floor, ...): other results depend on the CPU.
The last rule is also applied to all objects of the stages given with --state-path, but for folders named inspect: what they
say is shown to the user and never enters the state.
Exit status 1 if a rule is broken or nothing was found to check, 77 where nm is missing.
"""
import argparse
import re
import shutil
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

# Functions of <math.h> that IEEE 754 does not define to the last bit (sqrt, floor, fma and the like are exact).
INEXACT = {"acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cbrt", "cos", "cosh", "erf", "erfc", "exp", "exp10", "exp2", "expm1",
           "hypot", "lgamma", "lgamma_r", "log", "log10", "log1p", "log2", "pow", "sin", "sincos", "sinh", "tan", "tanh", "tgamma",
           "j0", "j1", "jn", "y0", "y1", "yn"}
INEXACT |= {f"{name}{suffix}" for name in INEXACT for suffix in ("f", "l")} | {f"__{name}_finite" for name in INEXACT}
ISA_TARGET = re.compile(r"abut_(\w+)_(sse2|avx2|avx512)\.dir$")
TARGET = re.compile(r"abut_(\w+)\.dir$")


def symbols(nm, objects):
    """{object: [(kind, mangled name)]}"""
    table = defaultdict(list)
    for start in range(0, len(objects), 200):
        out = subprocess.run([nm, "-A", "-P", *map(str, objects[start:start + 200])], text=True, capture_output=True, check=True).stdout
        for line in out.splitlines():
            place, rest = line.split(": ", 1)
            fields = rest.split()
            if len(fields) >= 2:
                table[place].append((fields[1], fields[0]))
    return table


def in_abut(name):
    """A function, variable, guard or type record of namespace abut, by its mangled name."""
    return re.match(r"_Z(T[ISVTCW]|GV|GR|Z)?(N[KVOR]*)?L?4abut", name) is not None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--nm", default="nm")
    parser.add_argument("--state-path", nargs="*", default=[])
    args = parser.parse_args()
    if not shutil.which(args.nm):
        print(f"{args.nm} not found")
        return 77

    isa_of, stage_of = {}, {}
    for path in Path(args.build).glob("CMakeFiles/**/*.o"):
        for folder in path.parts:
            match = ISA_TARGET.match(folder)
            if match:
                stage_of[str(path)], isa_of[str(path)] = match.group(1), match.group(2)
                break
            match = TARGET.match(folder)
            if match:
                stage_of[str(path)], isa_of[str(path)] = match.group(1), "common"
                break
    table = symbols(args.nm, sorted(stage_of))

    weak_sets = defaultdict(set)  # symbol -> instruction sets of the objects that define it weakly or strongly
    for place, entries in table.items():
        for kind, name in entries:
            if kind in "WVuTDBR":
                weak_sets[name].add(isa_of[place])

    faults = 0
    checked = 0
    for place in sorted(table):
        isa = isa_of[place]
        state_path = isa != "common" or (stage_of[place] in args.state_path and "/inspect/" not in place)
        checked += isa != "common"
        for kind, name in table[place]:
            if name.startswith("DW.ref."):
                continue  # a pointer to the personality routine of exceptions: data, the same for all
            problem = None
            if kind == "U" and state_path and name.split("@")[0] in INEXACT:
                problem = f"imports {name} of the maths library: its last bits depend on the CPU"
            elif isa != "common" and kind in "WVuTDBRGSC":
                if not in_abut(name):
                    problem = f"defines {name}, which is not of namespace abut"
                elif kind in "WVu" and weak_sets[name] - {isa}:
                    others = ", ".join(sorted(weak_sets[name] - {isa}))
                    problem = f"defines {name} weakly, and so do objects of: {others}"
            if problem:
                faults += 1
                print(f"{place}: {problem}")
    if checked == 0 and not args.state_path:
        print("no objects built per instruction set in this build")
    print(f"{checked} objects built per instruction set, {len(table)} in all: {faults} faults")
    return 1 if faults or not table else 0


if __name__ == "__main__":
    sys.exit(main())
