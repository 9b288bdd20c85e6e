#!/usr/bin/env python3
"""Runs a deck with abut and checks what came out.

usage: run_deck.py MODE NAME --abut PROGRAM [--threads N] [--keep DIR] [--tolerance T] [--strict]

MODE
  reference   profile `reference`, compared with NAME_ref.csv and NAME_noise.csv (compare.py); --strict: without the noise
  energy      profile `standard`: the discrete ledger and the energy balance stay within their limits, in every row of the time history
              and, by run.json, in every cycle
  contact     the same, and what the interfaces make or lose stays within its limits: for decks of the project's own

Limits, as fractions of the largest energy term so far: |GLOBAL/LEDGER| <= 0.002 always; |GLOBAL/ERR| <= 0.01
while no interface is in contact and <= 0.02 while one is; `contact`: |GLOBAL/CX| <= 0.01, and <= 0.002
behind the last row in which one is in contact.

The decks are those of examples/decks and of the folder ABUT_DECKS (default ../shared/decks beside the source tree).
Exit status 0 passed, 1 failed, 77 the deck is not there (CTest: skipped). Standard library only.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import compare
import deck_files

SKIPPED = 77
LEDGER_LIMIT = 0.002
ERROR_LIMIT = 0.01
ERROR_LIMIT_IN_CONTACT = 0.02
MADE_LIMIT = 0.002
MADE_LIMIT_IN_CONTACT = 0.01
TERMS = ("IE", "HE", "KE", "KER", "CE", "FW", "DW", "EXTW")


def run(program, name, profile, out, threads):
    """Runs the deck into `out`. @returns its time history. @throws RuntimeError with the end of the program's output."""
    deck = deck_files.folder_of(name) / f"{name}_0000.rad"
    command = [str(program), "run", str(deck), "-o", str(out), "--threads", str(threads), "--profile", profile]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
    if done.returncode != 0:
        tail = "\n".join(done.stdout.splitlines()[-25:])
        raise RuntimeError(f"abut run {deck.name} --profile {profile} ended with status {done.returncode}:\n{tail}")
    path = Path(out) / f"{name}_th.csv"
    if not path.is_file():
        raise RuntimeError(f"abut run {deck.name} --profile {profile} wrote no {path.name}")
    return compare.read_history(path)


def in_contact(history):
    """Per row: whether an interface has nodes in contact or holds energy."""
    counts = [values for name, values in history.column.items()
              if name == "GLOBAL/CE" or (name.startswith("INTER/") and name.endswith("/NC"))]
    return [any(values[row] > 0 for values in counts) for row in range(len(history.time))]


def worst(values, rows):
    """Largest magnitude and its row among `rows`; (0, None) without rows; NaN counts as largest."""
    chosen = max(rows, key=lambda row: math.inf if math.isnan(values[row]) else abs(values[row]), default=None)
    return (0.0, None) if chosen is None else (abs(values[chosen]), chosen)


def made_share(history):
    """GLOBAL/CX over the largest energy term so far, per row; 0 before there is energy."""
    shares, largest = [], 0.0
    for row, made in enumerate(history.column["GLOBAL/CX"]):
        largest = max([largest] + [abs(history.column[f"GLOBAL/{term}"][row]) for term in TERMS])
        shares.append(made / largest if largest > 0.0 else 0.0)
    return shares


def energy(history, with_made=False):
    """[(what, worst value, time, limit, passed)]"""
    for name in ("GLOBAL/LEDGER", "GLOBAL/ERR"):
        if name not in history.column:
            raise RuntimeError(f"the time history has no column {name}")
    contact = in_contact(history)
    rows = range(len(contact))
    cases = [
        ("LEDGER", history.column["GLOBAL/LEDGER"], list(rows), LEDGER_LIMIT),
        ("ERR outside contact", history.column["GLOBAL/ERR"], [row for row in rows if not contact[row]], ERROR_LIMIT),
        ("ERR during contact", history.column["GLOBAL/ERR"], [row for row in rows if contact[row]], ERROR_LIMIT_IN_CONTACT),
    ]
    if with_made:
        made = made_share(history)
        parted = max((row for row in rows if contact[row]), default=-1) + 1
        cases += [("CX up to separation", made, list(rows[:parted]), MADE_LIMIT_IN_CONTACT),
                  ("CX after separation", made, list(rows[parted:]), MADE_LIMIT)]
    for what, values, chosen, limit in cases:
        value, row = worst(values, chosen)
        yield what, value, (history.time[row] if row is not None else math.nan), limit, value <= limit


def worst_of_all_cycles(out):
    """One more case for energy(): the rows of a time history pass over most cycles."""
    error = json.loads((Path(out) / "run.json").read_text())["worst"]["ERR"]
    value = math.inf if error["value"] is None else abs(error["value"])
    return "ERR in every cycle", value, error["time"], ERROR_LIMIT_IN_CONTACT, value <= ERROR_LIMIT_IN_CONTACT


def check_energy(history, with_made, out):
    passed = True
    for what, value, time, limit, good in [*energy(history, with_made), worst_of_all_cycles(out)]:
        print(f"{what:<22}{value:>12.3e} at {time:<12.5g} limit {limit:g}{'' if good else '  outside'}")
        passed = passed and good
    if len(history.time) < 2:
        print("the time history has fewer than two rows")
        passed = False
    return 0 if passed else 1


def check_reference(history, folder, name, tolerance, strict):
    reference = compare.read_history(folder / f"{name}_ref.csv")
    noise = {} if strict else compare.read_noise(folder / f"{name}_noise.csv")
    found = compare.compare(history, reference, noise, tolerance, compare.SIGNALS)
    return compare.report(found, compare.covers(history, reference), history, reference)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mode", choices=["reference", "energy", "contact"])
    parser.add_argument("name")
    parser.add_argument("--abut", required=True)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--keep", help="keep the run folder here")
    parser.add_argument("--tolerance", type=float, default=0.001)
    parser.add_argument("--strict", action="store_true")
    args = parser.parse_args()

    folder = deck_files.folder_of(args.name)
    needed = [f"{args.name}_0000.rad"]
    if args.mode == "reference":
        needed += [f"{args.name}_ref.csv", f"{args.name}_noise.csv"]
    absent = [name for name in needed if not (folder / name).is_file()]
    if absent:
        print(f"skipped: {folder} has no {', '.join(absent)}.\n"
              f"The decks with reference results are not part of the project; set ABUT_DECKS to the folder that holds them.")
        return SKIPPED

    try:
        with tempfile.TemporaryDirectory(prefix=f"abut-{args.name}-") as temporary:
            out = args.keep or temporary
            os.makedirs(out, exist_ok=True)
            history = run(args.abut, args.name, "reference" if args.mode == "reference" else "standard", out, args.threads)
            if args.mode != "reference":
                return check_energy(history, args.mode == "contact", out)
        return check_reference(history, folder, args.name, args.tolerance, args.strict)
    except (RuntimeError, ValueError, OSError) as error:
        print(error)
        return 1


if __name__ == "__main__":
    sys.exit(main())
