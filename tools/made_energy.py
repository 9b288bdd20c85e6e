#!/usr/bin/env python3
"""How the energy that contact makes or loses (CX) falls with the time step: runs decks at three step factors and eight phases.

usage: made_energy.py --abut PROGRAM [--phases N] [--friction MU] [--gap G] DECK_0000.rad ...

The factor of /DT in the Engine deck is replaced by 0.9, 0.45 and 0.225, each times 1 - 0.0137 p for phase p = 0, 1, ...: contact then begins
elsewhere in a step. Prints, per deck and factor, the mean over the phases of |CX| at the end and of its largest value of the run, over the largest energy
of the run; and the geometric mean of the factors by which halving the step divides each. --friction and --gap overwrite those fields of all
/INTER/TYPE3 of the Starter deck. Exit status 1 if a run failed. Standard library only.
"""
import argparse
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "decks"))
import compare

FACTORS = (0.9, 0.45, 0.225)
TERMS = ("IE", "HE", "KE", "KER", "CE", "FW", "DW", "EXTW")


def engine_with(text, factor):
    """The Engine deck with another step factor, no animation and a history of every cycle."""
    text, count = re.subn(r"(?m)^(/DT\s*\n)\s*\S+", rf"\g<1>{factor:20.12g}", text)
    if count != 1:
        sys.exit("made_energy.py: the Engine deck needs one /DT card")
    text = re.sub(r"(?m)^(/ANIM/DT\s*\n).*$", r"\g<1>                   0               1e+30", text)
    return re.sub(r"(?m)^(/TFILE\S*\s*\n).*$", r"\g<1>               1e-30", text)


def starter_with(text, friction, gap):
    """The Starter deck with other friction and gap (None: as they are) in its TYPE3 interfaces."""
    lines = text.split("\n")
    for start in [k for k, line in enumerate(lines) if line.startswith("/INTER/TYPE3/")]:
        cards = [k for k in range(start + 1, start + 20) if k < len(lines) and not lines[k].startswith("#")]
        k = cards[2]  # title, surfaces, Stfac Fric Gap
        card = lines[k].ljust(100)
        for value, first in ((friction, 20), (gap, 40)):
            if value is not None:
                card = card[:first] + f"{value:20g}" + card[first + 20:]
        lines[k] = card.rstrip()
    return "\n".join(lines)


def made(program, starter, factor, friction=None, gap=None):
    """(|CX| at the end, largest |CX|), over the largest energy."""
    name = starter.name.removesuffix("_0000.rad")
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder)
        (target / starter.name).write_text(starter_with(starter.read_text(), friction, gap))
        engine = starter.with_name(f"{name}_0001.rad").read_text()
        (target / f"{name}_0001.rad").write_text(engine_with(engine, factor))
        command = [program, "run", target / starter.name, "-o", target / "out", "--quiet", "--threads", "1"]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        history = compare.read_history(target / "out" / f"{name}_th.csv")
    energy = max(abs(v) for term in TERMS for v in history.column.get(f"GLOBAL/{term}", [0.0]))
    cx = history.column["GLOBAL/CX"]
    return abs(cx[-1]) / energy, max(map(abs, cx)) / energy


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--abut", required=True)
    parser.add_argument("--phases", type=int, default=8)
    parser.add_argument("--friction", type=float)
    parser.add_argument("--gap", type=float)
    parser.add_argument("decks", nargs="+", type=Path)
    options = parser.parse_args()
    logs = {"end": [], "largest": []}
    print("| Deck | CX at the end at 0.9 | 0.45 | 0.225 | largest CX at 0.9 | 0.45 | 0.225 |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for deck in options.decks:
        means = []
        for factor in FACTORS:
            found = [made(options.abut, deck, factor * (1 - 0.0137 * p), options.friction, options.gap) for p in range(options.phases)]
            means.append([sum(column) / options.phases for column in zip(*found)])
        for kind, values in zip(("end", "largest"), zip(*means)):
            if min(values) > 0:
                logs[kind].append(0.5 * math.log(values[0] / values[2]))
        cells = [f"{m[k]:.1e}" for k in (0, 1) for m in means]
        print(f"| {deck.name.removesuffix('_0000.rad')} | " + " | ".join(cells) + " |", flush=True)
    for kind, values in logs.items():
        if values:
            print(f"CX {'at the end' if kind == 'end' else 'largest'}: halving the step divides it by {math.exp(sum(values) / len(values)):.2f} on average")


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as error:
        sys.exit(f"made_energy.py: {error}")
