#!/usr/bin/env python3
"""Runs every deck in both profiles and writes docs/verification/decks.md.

usage: deck_table.py --abut PROGRAM [--threads N] [--out FILE] [--keep DIR] [DECK ...]

For each deck: the worst deviation of every signal group under `--profile reference` (tests/decks/compare.py), every signal that is
further than STRICT from the reference with the reference program's own noise, and side by
side the energy error of the reference program and of abut's default profile. The reference program's error is computed from
its own history by its own formula, 100 ((IE + KE + KER)/(E0 + EXTW) - 1), limited to 99.9 %. Decks that are not there are
named as such. Exit status 1 if a run failed. Standard library only.
"""
import argparse
import math
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "decks"))
import compare
import deck_files
import run_deck

GROUPS = ["GLOBAL energies", "GLOBAL momentum", "PART IE", "PART KE", "INTER IFN", "INTER IFT", "NODE D", "NODE V"]

RUNNABLE = [name for name in deck_files.EXAMPLES if name != "drop_type3"]  # its normals are turned away: abut refuses it, on purpose
STRICT = 0.001  # of every signal, without the noise files


def reference_error(history):
    """Per cent, per row."""
    columns = [history.column.get(f"GLOBAL/{name}", [0.0] * len(history.time)) for name in ("IE", "KE", "KER", "EXTW")]
    internal, kinetic, rotational, external = columns
    initial = internal[0] + kinetic[0] + rotational[0] - external[0]
    errors = []
    for row in range(len(history.time)):
        total = initial + external[row]
        value = internal[row] + kinetic[row] + rotational[row]
        error = 100 * (value / total - 1) if total != 0 else 0.0 if value == 0 else 99.9
        errors.append(max(-99.9, min(99.9, error)))
    return errors


def largest_term(history):
    """The largest energy term of the whole run."""
    names = [f"GLOBAL/{name}" for name in ("IE", "HE", "KE", "KER", "CE", "FW", "DW", "EXTW")]
    return max(abs(value) for name in names for value in history.column.get(name, [0.0]))


def percent(value):
    return "n/a" if value is None or math.isnan(value) else f"{value:.3g} %"


def reference_row(name, program, threads, keep):
    """(cells of the signal table, rows of the signals further off than STRICT, the reference)"""
    folder = deck_files.folder_of(name)
    history = run_deck.run(program, name, "reference", keep, threads)
    reference = compare.read_history(folder / f"{name}_ref.csv")
    noise = compare.read_noise(folder / f"{name}_noise.csv")
    found = compare.compare(history, reference, noise, 0.01, compare.SIGNALS)
    cells = []
    for group in GROUPS:
        members = [c for c in found if c.group == group]
        usable = [c for c in members if c.status in ("pass", "fail")]
        if any(c.status == "missing" for c in members):
            cells.append("missing")
        elif not usable:
            cells.append("not comparable" if members else "")
        else:
            worst = max(usable, key=lambda c: c.deviation)
            mark = " **outside**" if any(c.status == "fail" for c in usable) else ""
            cells.append(f"{worst.deviation:.1e}{mark}")
    count = {status: sum(c.status == status for c in found) for status in ("pass", "fail", "missing", "not comparable")}
    verdict = f"{count['pass']} / {count['pass'] + count['fail'] + count['missing']}"
    strict = compare.compare(history, reference, {}, STRICT, compare.SIGNALS)
    beyond = [c for c in strict if c.status != "pass"]
    members = {c.signal: [d for d in strict if d.group == c.group] for c in beyond}
    rows = [[name, c.signal, f"{c.deviation:.1e}", f"{noise.get(c.signal, 0.0):.1e}", f"{c.peak:.1e}", f"{max(d.peak for d in members[c.signal]):.1e}"]
            for c in beyond]
    count_strict = f"{len(strict) - len(beyond)} / {len(strict)}"
    return [*cells, verdict, str(count["not comparable"]), count_strict], rows, reference


def energy_row(name, program, threads, keep, reference):
    history = run_deck.run(program, name, "standard", keep, threads)
    figures = {what: value for what, value, _, _, _ in run_deck.energy(history)}
    largest = largest_term(history)
    made = history.column.get("GLOBAL/CX")
    cx = [abs(value) / largest if largest > 0 else 0.0 for value in made] if made else None
    theirs = reference_error(reference) if reference else None
    return [percent(theirs[-1]) if theirs else "", percent(max(theirs, key=abs)) if theirs else "",
            percent(100 * history.column["GLOBAL/ERR"][-1]),
            percent(100 * max(figures["ERR outside contact"], figures["ERR during contact"])), percent(100 * figures["LEDGER"]),
            percent(100 * cx[-1]) if cx else "", percent(100 * max(cx)) if cx else ""]


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head), *("| " + " | ".join(row) + " |" for row in rows), ""]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("decks", nargs="*", default=deck_files.OWN + deck_files.THIRD_PARTY + RUNNABLE)
    parser.add_argument("--abut", default=ROOT / "build" / "release" / "bin" / "abut")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--out", default=ROOT / "docs" / "verification" / "decks.md")
    parser.add_argument("--keep", help="keep the run folders here")
    args = parser.parse_args()

    signals, beyond, energies, absent, failed = [], [], [], [], []
    with tempfile.TemporaryDirectory(prefix="abut-decks-") as temporary:
        for name in args.decks:
            folder = deck_files.folder_of(name)
            if not (folder / f"{name}_0000.rad").is_file():
                absent.append(name)
                continue
            runs = Path(args.keep or temporary)
            reference = None
            for mode in ("reference", "standard"):
                keep = runs / f"{name}-{mode}"
                keep.mkdir(parents=True, exist_ok=True)
                try:
                    if mode == "standard":
                        energies.append([name, *energy_row(name, args.abut, args.threads, keep, reference)])
                    elif (folder / f"{name}_ref.csv").is_file():
                        row, further, reference = reference_row(name, args.abut, args.threads, keep)
                        signals.append([name, *row])
                        beyond += further
                except (RuntimeError, ValueError, OSError) as error:
                    failed.append(f"{name}, profile {mode}: {str(error).splitlines()[0]}")
            print(name, flush=True)

    page = ["# Decks", "",
            "Written by `tools/deck_table.py`; do not edit. The decks with reference results lie outside the project (`ABUT_DECKS`).", "",
            "## Agreement with the reference program, profile `reference`", "",
            "Worst deviation of each signal group (root mean square over time, relative to the reference; `tests/decks/compare.py`).",
            "Allowed per signal: the larger of 1 % and 1.5 times the reference program's own noise. Signals whose noise is above 20 %",
            "are not comparable and left out of the worst. Last column: signals within 0.1 % of the reference, without the noise.", "",
            *table(["deck", *GROUPS, "pass", "not comparable", "within 0.1 %"], signals),
            "### Further than 0.1 % without the noise", "",
            f"{len({row[0] for row in beyond})} of {len(signals)} decks have such signals, {len(beyond)} in all; the tests hold the others to 0.1 % of every signal",
            "(`run_deck.py reference NAME --strict`). Noise: deviation of the reference program from itself when only the factor of its time step",
            f"changes. {sum(float(row[2]) <= float(row[3]) for row in beyond)} of the {len(beyond)} deviations are below it. Peak: largest magnitude of the signal in the reference, and of the largest signal",
            "of its group. bars: both bars move along z, what they do along x and y is rounding that the impact has amplified; stack: sums of",
            "friction forces over faces that cancel by symmetry, 2e-6 of the normal impulse; plates_gap0: a velocity 1e-5 of the largest one.", "",
            *table(["deck", "signal", "deviation", "noise of the reference", "peak", "peak of its group"], beyond),
            "## Energy, default profile", "",
            "Error of the energy balance in per cent. Left: the reference program by its own formula, which leaves contact energy and",
            "hourglass work out of the balance. Right: abut, of the largest energy term so far. LEDGER is the balance of discrete works;",
            "CX is what contact made or lost, of the largest term of the run.", "",
            *table(["deck", "reference, end", "reference, worst", "abut ERR, end", "abut ERR, worst", "abut LEDGER, worst", "CX, end", "CX, largest"],
                   energies)]
    if failed:
        page += ["## Runs that failed", "", *(f"- {line}" for line in failed), ""]
    if absent:
        page += [f"Not there when this page was written: {', '.join(absent)}.", ""]
    out = Path(args.out)
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text("\n".join(page), encoding="utf-8")
    print(f"{out}: {len(signals)} decks compared, {len(energies)} energy rows, {len(failed)} runs failed, {len(absent)} decks absent")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
