#!/usr/bin/env python3
"""Compares a time history with a reference, signal by signal.

usage: compare.py RESULT.csv REFERENCE.csv [--noise NOISE.csv] [--tolerance T] [--all] [--signals PATTERN ...]

Both files: a row of names, the first being `time`, then one row per output time. The result is interpolated linearly to
the times of the reference that it covers. With the root mean square |.| over these times, a signal's deviation is

    |result - reference| / max(|reference|, 1e-3 of the largest |reference| in its group),

a group being the same variable of the same kind, all ids and directions (NODE/*/D[XYZ]), or all energies: a signal that is
zero but for rounding does not decide. NOISE.csv (signal,rel) tells how far the reference program is from itself when only
its time step changes. A signal passes when its deviation is at most max(T, 1.5 noise); with noise above 0.2 it is listed as
not comparable. Compared by default: SIGNALS below; --all takes every column of the reference.

Exit status 0 if all compared signals pass and none is missing in the result, else 1. Standard library only.
"""
import argparse
import csv
import math
import sys
from dataclasses import dataclass
from fnmatch import fnmatchcase

SIGNALS = ["GLOBAL/IE", "GLOBAL/KE", "GLOBAL/EXTW", "GLOBAL/[XYZ]MOM", "PART/*/IE", "PART/*/KE", "INTER/*/IF[NT][XYZ]",
           "NODE/*/[DV][XYZ]"]
ENERGIES = {f"GLOBAL/{name}" for name in ("IE", "KE", "KER", "EXTW", "CE", "HE")}
FLOOR = 1e-3          # of the group's largest reference
NOISE_FACTOR = 1.5
NOISE_LIMIT = 0.2     # above it a signal is not comparable


@dataclass
class History:
    time: list
    column: dict      # name -> values


@dataclass
class Comparison:
    signal: str
    group: str
    status: str       # "pass", "fail", "missing", "not comparable"
    deviation: float = math.nan
    allowed: float = math.nan
    peak_ratio: float = math.nan
    peak: float = math.nan


def read_history(path):
    """@throws ValueError where the file is not a time history."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if row and not row[0].lstrip().startswith("#")]
    if not rows or rows[0][0].strip() != "time":
        raise ValueError(f"{path}: the first column must be 'time'")
    names = [name.strip() for name in rows[0]]
    table = []
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(names):
            if number == len(rows):
                break  # the row that was being written when a run was stopped
            raise ValueError(f"{path}: row {number} has {len(row)} values, {len(names)} are named")
        table.append([float(value) for value in row])
    columns = list(zip(*table)) if table else [()] * len(names)
    return History(list(columns[0]), {name: list(values) for name, values in zip(names[1:], columns[1:])})


def read_noise(path):
    with open(path, newline="", encoding="utf-8") as file:
        return {row[0]: float(row[1]) for row in list(csv.reader(file))[1:] if len(row) > 1}


def group_of(signal):
    """The signals whose largest member gives the floor of a deviation."""
    if signal in ENERGIES:
        return "GLOBAL energies"
    parts = signal.split("/")
    variable = parts[-1]
    if variable in ("XMOM", "YMOM", "ZMOM"):
        return f"{parts[0]} momentum"
    if len(parts) == 3 and len(variable) > 1 and variable[-1] in "XYZ":
        variable = variable[:-1]
    return f"{parts[0]} {variable}" if len(parts) == 3 else signal


def resample(time, values, at):
    """Linear interpolation; `at` ascending, constant beyond the ends."""
    result, i = [], 0
    for t in at:
        while i < len(time) and time[i] < t:
            i += 1
        if i == 0:
            result.append(values[0])
        elif i == len(time):
            result.append(values[-1])
        else:
            step = time[i] - time[i - 1]
            weight = (t - time[i - 1]) / step if step > 0 else 1.0
            result.append(values[i - 1] + weight * (values[i] - values[i - 1]))
    return result


def root_mean_square(values):
    largest = max(map(abs, values), default=0.0)
    if not largest > 0 or math.isinf(largest):
        return math.nan if any(math.isnan(v) for v in values) else largest
    return largest * math.sqrt(sum((v / largest) ** 2 for v in values) / len(values))


def compare(result, reference, noise, tolerance, patterns):
    """One Comparison per reference signal that matches a pattern, in the reference's order. @throws ValueError without common times."""
    if not result.time or not reference.time:
        raise ValueError("a history without rows")
    last = result.time[-1] * (1 + 1e-9)
    rows = [k for k, t in enumerate(reference.time) if t <= last]
    at = [reference.time[k] for k in rows]
    if not at:
        raise ValueError("the histories have no time in common")
    signals = [name for name in reference.column if any(fnmatchcase(name, pattern) for pattern in patterns)]
    expected = {name: [reference.column[name][k] for k in rows] for name in signals}
    size = {name: root_mean_square(values) for name, values in expected.items()}
    largest = {}
    for name in signals:
        largest[group_of(name)] = max(largest.get(group_of(name), 0.0), size[name])

    found = []
    for name in signals:
        group = group_of(name)
        if name not in result.column:
            found.append(Comparison(name, group, "missing"))
            continue
        got = resample(result.time, result.column[name], at)
        difference = root_mean_square([a - b for a, b in zip(got, expected[name])])
        scale = max(size[name], FLOOR * largest[group])
        deviation = 0.0 if difference == 0.0 else difference / scale if scale > 0 else math.inf
        own_noise = noise.get(name, 0.0)
        allowed = max(tolerance, NOISE_FACTOR * own_noise)
        peak = max(map(abs, expected[name]))
        ratio = max(map(abs, got)) / peak if peak > 0 else math.nan
        status = "not comparable" if own_noise > NOISE_LIMIT else "pass" if deviation <= allowed else "fail"
        found.append(Comparison(name, group, status, deviation, allowed, ratio, peak))
    return found


def covers(result, reference):
    """Whether the result reaches the end of the reference but for an output interval."""
    return result.time[-1] >= 0.98 * reference.time[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("result")
    parser.add_argument("reference")
    parser.add_argument("--noise")
    parser.add_argument("--tolerance", type=float, default=0.01)
    parser.add_argument("--signals", nargs="+", default=SIGNALS)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--quiet", action="store_true", help="print only what does not pass")
    args = parser.parse_args()
    try:
        result, reference = read_history(args.result), read_history(args.reference)
        noise = read_noise(args.noise) if args.noise else {}
        found = compare(result, reference, noise, args.tolerance, ["*"] if args.all else args.signals)
    except (OSError, ValueError) as error:
        print(f"compare: {error}")
        return 1
    return report(found, covers(result, reference), result, reference, args.quiet)


def report(found, complete, result, reference, quiet=False):
    """Prints a table and returns the exit status."""
    print(f"{'signal':<26}{'deviation':>12}{'allowed':>10}{'peak ratio':>12}{'peak':>14}")
    for c in found:
        if quiet and c.status == "pass":
            continue
        if c.status == "missing":
            print(f"{c.signal:<26}{'missing in the result':>48}")
        else:
            mark = {"pass": "", "fail": "  outside", "not comparable": "  not comparable"}[c.status]
            print(f"{c.signal:<26}{c.deviation:>12.3e}{c.allowed:>10.4f}{c.peak_ratio:>12.5f}{c.peak:>14.6g}{mark}")
    count = {status: sum(c.status == status for c in found) for status in ("pass", "fail", "missing", "not comparable")}
    print(f"{count['pass']} signals pass, {count['fail']} outside, {count['missing']} missing, "
          f"{count['not comparable']} not comparable")
    if not complete:
        print(f"the result ends at {result.time[-1]:g}, the reference at {reference.time[-1]:g}")
    if not count["pass"]:
        print("nothing was compared")
    return 0 if complete and count["pass"] and not count["fail"] and not count["missing"] else 1


if __name__ == "__main__":
    sys.exit(main())
