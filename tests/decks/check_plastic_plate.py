#!/usr/bin/env python3
"""An animation with plastic strain and friction, read back.

usage: check_plastic_plate.py ABUT DECK

DECK is plate_drop_0000.rad: a plate falls askew on a clamped elastic one, with friction. Here the lower plate is of a soft metal (LAW2), so
that plastic strain, tangential contact pressure and all other fields are not zero in some state. Runs in a folder of its own, then
read_animation.py with the Python that runs this script (it needs VTK: Debian's /usr/bin/python3). Exit status 0 when all holds.
"""
import os
import subprocess
import sys
import tempfile

ELASTIC = """/MAT/ELAST/2
aluminium
#                RHO
                2700
#                  E                  Nu
         70000000000                0.33
"""
PLASTIC = """/MAT/PLAS_JOHNS/2
soft aluminium
                2700
         70000000000                0.33
             5000000           100000000                 0.5                   0                   0
                   0                   0         0         0                   0
                   0                   0                   0                   0
"""
# The soft plate gives way at once and the plates part after 10 us: many states of a short run.
ENGINE = [("/RUN/plate_drop/1\n               0.001\n", "/RUN/plate_drop/1\n               6e-5\n"),
          ("/ANIM/DT\n                   0               4e-05\n", "/ANIM/DT\n                   0               3e-06\n")]
STATES = 21
FIELDS = ["displacement", "velocity", "contact_force", "contact_pressure_normal", "contact_pressure_tangential", "contact_penetration",
          "contact_state", "plastic_strain", "von_mises", "stress"]


def changed(source, target, changes):
    """A copy with some lines changed, each of which must be there once."""
    with open(source, encoding="utf-8") as file:
        text = file.read()
    for old, new in changes:
        if text.count(old) != 1:
            sys.exit(f"{source}: not as expected, there should be one\n{old}")
        text = text.replace(old, new)
    with open(target, "w", encoding="utf-8") as file:
        file.write(text)


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    abut, deck = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        copy = os.path.join(folder, os.path.basename(deck))
        changed(deck, copy, [(ELASTIC, PLASTIC)])
        changed(deck.replace("_0000.rad", "_0001.rad"), copy.replace("_0000.rad", "_0001.rad"), ENGINE)
        output = os.path.join(folder, "run")
        if subprocess.run([abut, "run", copy, "-o", output, "--quiet"]).returncode != 0:
            return 1
        name = os.path.basename(deck).replace("_0000.rad", ".pvd")
        reader = os.path.join(os.path.dirname(os.path.abspath(__file__)), "read_animation.py")
        return subprocess.run([sys.executable, reader, os.path.join(output, name), "--states", str(STATES), "--nonzero", *FIELDS]).returncode


if __name__ == "__main__":
    sys.exit(main())
