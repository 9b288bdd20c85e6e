#!/usr/bin/env python3
"""Says in a few lines what a run folder holds and what its time history shows.

usage: summarise_run.py RUN_FOLDER      (the folder that `abut run` filled)

Exit status 1 if there is no time history. Standard library only.
"""
import csv
import json
import math
import sys
from pathlib import Path


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names = [name.strip() for name in rows[0]]
    table = [[float(value) for value in row] for row in rows[1:] if len(row) == len(names)]
    return {name: [row[k] for row in table] for k, name in enumerate(names)}


def outcome_of(folder):
    """How the run ended, as run.json has it."""
    try:
        outcome = json.loads((folder / "run.json").read_text(encoding="utf-8"))["outcome"]
        kind, message = outcome["kind"], outcome.get("message", "")
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return "not known: there is no run.json that says how the run ended"
    if kind == "running":
        return "not ended: the run still goes on, or was stopped from outside"
    return f"{kind}: {message}" if message else kind


def largest(values):
    """The value of largest size and its row; nan and 0 when none is finite."""
    rows = [row for row, value in enumerate(values) if math.isfinite(value)]
    row = max(rows, key=lambda row: abs(values[row]), default=None)
    return (math.nan, 0) if row is None else (values[row], row)


def since(values, time):
    """Where a value is not finite first, if one is."""
    row = next((row for row, value in enumerate(values) if not math.isfinite(value)), None)
    return "" if row is None else f"   not finite at time {time[row]:.4g}"


def interface_lines(history, ident):
    """What one interface did: its largest force, how long it touched, its friction work."""
    time = history["time"]

    def force(kind):
        parts = [history.get(f"INTER/{ident}/{kind}{axis}") for axis in "XYZ"]
        return [math.sqrt(sum(p[row] ** 2 for p in parts)) for row in range(len(time))] if all(parts) else None

    normal, tangential = force("FN"), force("FT")
    if normal:
        peak, row = largest(normal)
        yield f"interface {ident}: largest normal force {peak:.5g} at time {time[row]:.4g}{since(normal, time)}"
        if tangential and largest(tangential)[0] > 0:
            yield f"interface {ident}: largest friction force {largest(tangential)[0]:.5g}{since(tangential, time)}"
    count = history.get(f"INTER/{ident}/NC")
    if count and max(count) > 0:
        rows = [row for row, value in enumerate(count) if value > 0]
        yield f"interface {ident}: in contact between time {time[rows[0]]:.4g} and {time[rows[-1]]:.4g}, up to {max(count):.0f} nodes"


def main():
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    folder = Path(sys.argv[1])
    histories = sorted(folder.glob("*_th.csv"))
    if not histories:
        print(f"{folder}: no time history (NAME_th.csv)")
        return 1
    path = histories[0]
    history = read(path)
    time = history.get("time")
    if not time:
        print(f"{path}: no rows")
        return 1

    print(f"Results in {folder}/")
    known = [("listing", "*.out"), ("time history", "*_th.csv"), ("animation", "*.pvd"), ("what ran", "run.json")]
    for what, pattern in known:
        for file in sorted(folder.glob(pattern)):
            print(f"  {file.name:<28}{what}")
    print(f"Outcome: {outcome_of(folder)}")
    print(f"What they show at time {time[-1]:.4g} ({len(time)} rows):")
    terms = [("internal energy", "IE"), ("hourglass energy", "HE"), ("kinetic energy", "KE"), ("rotational kinetic energy", "KER"),
             ("stored in contact", "CE"), ("friction work", "FW"), ("contact damping", "DW"), ("external work", "EXTW"),
             ("made or lost by contact", "CX")]
    start = history.get("GLOBAL/KE", [math.nan])[0]
    print(f"  {'kinetic energy at the start':<30}{start:>14.6g}")
    for what, name in terms:
        values = history.get(f"GLOBAL/{name}")
        if values:
            print(f"  {what:<30}{values[-1]:>14.6g}   largest {largest(values)[0]:.6g}{since(values, time)}")
    error = history.get("GLOBAL/ERR")
    if error:
        worst, row = largest(error)
        worst_text = since(error, time).strip() or f"{100 * worst:.4f}% at time {time[row]:.4g}"
        print(f"  {'error of the balance':<30}{100 * error[-1]:>13.4f}%   worst {worst_text}")
    for ident in sorted({name.split("/")[1] for name in history if name.startswith("INTER/")}, key=int):
        for line in interface_lines(history, ident):
            print(f"  {line}")
    animations = sorted(folder.glob("*.pvd"))
    if animations and (folder / "report.html").exists():
        print(f"See it: {(folder / 'report.html').resolve().as_uri()} (any browser), or paraview {animations[0]} (Debian: apt-get install paraview)")
    elif animations:
        print(f"See it: abut report {folder} (one page for any browser), or paraview {animations[0]} (Debian: apt-get install paraview)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
