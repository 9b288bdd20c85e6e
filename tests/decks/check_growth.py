#!/usr/bin/env python3
"""The time that `abut check` takes grows as the deck does, not as its square: measured at N and 4 N.

usage: check_growth.py ABUT [SCENE...]

Processor time of the program; four times the deck may take seven times as long (a square would take sixteen, a power of 3/2 eight). Standard library only.
"""
import math
import os
import resource
import subprocess
import sys
import tempfile

HEAD = """#RADIOSS STARTER
/BEGIN
grown
      2022         0
                  kg                   m                   s
                  kg                   m                   s
/MAT/ELAST/1
steel
                7800
        210000000000                 0.3
/PROP/SHELL/1
shell
         1         2         2         0
                   0                   0                   0                   0                   0
         3         0               0.002                   0         0         2         2
"""


def integers(*values):
    return "".join(f"{v:>10}" for v in values) + "\n"


def reals(*values):
    return "".join(f"{v:>20.12g}" for v in values) + "\n"


def node(number, x, y, z):
    return f"{number:>10}" + reals(x, y, z)


def squares(n, apart=0.05):
    """n shells of their own side by side, four to a part: nodes 4 k + 1 to 4 k + 4."""
    corners = ((0.0, 0.0), (0.01, 0.0), (0.01, 0.01), (0.0, 0.01))
    side = math.ceil(math.sqrt(n))
    text = HEAD + "/NODE\n"
    for k in range(n):
        x, y = apart * (k % side), apart * (k // side)
        text += "".join(node(4 * k + i + 1, x + u, y + v, 0.0) for i, (u, v) in enumerate(corners))
    for part in range(1, n // 4 + 1):
        last = n if part == n // 4 else 4 * part
        text += f"/PART/{part}\nsquares\n" + integers(1, 1) + f"/SHELL/{part}\n"
        text += "".join(integers(k + 1, *range(4 * k + 1, 4 * k + 5)) for k in range(4 * part - 4, last))
    return text


def motions(n):
    """As many imposed motions as shells."""
    text = squares(n) + "/FUNCT/1\nf\n" + reals(0, 1) + reals(1, 1)
    return text + "".join(f"/GRNOD/NODE/{k + 1}\ng\n" + integers(4 * k + 1) + f"/IMPVEL/{k + 1}\nm\n         1         X         0         0{k + 1:>10}\n"
                          + reals(1, 1, 0, 1) for k in range(n))


def bodies(n):
    """As many rigid bodies as shells, and an initial velocity of all nodes."""
    text = squares(n)
    for k in range(n):
        text += (f"/GRNOD/NODE/{k + 2}\ng\n" + integers(*range(4 * k + 2, 4 * k + 5)) + f"/RBODY/{k + 1}\nb\n" + integers(4 * k + 1, 0, 0, 0).rstrip("\n")
                 + f"{0:>20}" + integers(k + 2, 0, 1, 0) + reals(0, 0, 0) + reals(0, 0, 0) + integers(0))
    return text + "/GRNOD/NODE/1\nall\n" + "".join(integers(*range(10 * k + 1, 10 * k + 11)) for k in range(4 * n // 10)) + "/INIVEL/TRA/1\nv\n" + reals(0, 0, -5).rstrip("\n") + integers(1)


def interfaces(n):
    """Half as many interfaces as shells, between neighbours."""
    text = squares(n)
    for k in range(n):
        text += f"/SURF/SEG/{k + 1}\ns\n" + integers(k + 1, *range(4 * k + 1, 4 * k + 5))
    for k in range(0, n - 1, 2):
        text += (f"/INTER/TYPE3/{k + 1}\ni\n" + integers(k + 1, k + 2) + reals(0.2, 0, 0.001, 0, 0) + integers(0) + reals(0, 0, 0))
    return text


def sphere(first, radius, n, inward):
    """Nodes and shells of a cube that is blown up, n by n on every face; nodes and shells are numbered from `first` + 1."""
    numbers, shells = {}, []

    def corner(axis, side, p, q):
        key = [0, 0, 0]
        key[axis], key[(axis + 1) % 3], key[(axis + 2) % 3] = side * n, 2 * p - n, 2 * q - n
        return numbers.setdefault(tuple(key), first + len(numbers) + 1)

    for axis in range(3):
        for side in (-1, 1):
            for p in range(n):
                for q in range(n):
                    face = [corner(axis, side, p + u, q + v) for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))]
                    shells.append(face[::-1] if (side < 0) != inward else face)
    nodes = ""
    for key, number in numbers.items():
        length = math.hypot(*key)
        nodes += node(number, *(radius * c / length for c in key))
    return nodes, shells


def far_body(n):
    """A sphere in the middle of a sphere, about n shells each: nothing is near, and all is about equally far."""
    n = round(math.sqrt(n / 6))
    outer, inner = sphere(0, 1.0, n, True), sphere(10 * n * n, 0.05, n, False)
    text = HEAD + "/NODE\n" + outer[0] + inner[0]
    for part, (first, (_, shells)) in enumerate(((0, outer), (10 * n * n, inner)), 1):
        text += f"/PART/{part}\nsphere\n" + integers(1, 1) + f"/SHELL/{part}\n"
        text += "".join(integers(first + k, *shell) for k, shell in enumerate(shells, 1))
        text += f"/SURF/PART/{part}\ns\n" + integers(part)
    return text + "/INTER/TYPE3/1\ni\n" + integers(1, 2) + reals(0.2, 0, 0.001, 0, 0) + integers(0) + reals(0, 0, 0)


SCENES = {"motions": (motions, 8000), "bodies": (bodies, 20000), "interfaces": (interfaces, 8000), "far_body": (far_body, 2400)}


def seconds(abut, deck):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run([abut, "check", deck], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if result.returncode != 0:
        raise SystemExit(f"{deck}: {result.returncode} {result.stderr[:400]}")
    return after.ru_utime - before.ru_utime


def main():
    if len(sys.argv) < 2:
        print(__doc__, file=sys.stderr)
        return 2
    failures = 0
    for name in sys.argv[2:] or SCENES:
        make, n = SCENES[name]
        times = []
        for count in (n, 4 * n):
            with tempfile.TemporaryDirectory() as work:
                deck = os.path.join(work, "grown_0000.rad")
                with open(deck, "w") as file:
                    file.write(make(count) + "/END\n")
                times.append(seconds(sys.argv[1], deck))
        print(f"{name}: {times[0]:.3g} s at {n}, {times[1]:.3g} s at {4 * n}")
        failures += times[1] > 7.0 * times[0]
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
