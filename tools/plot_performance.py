#!/usr/bin/env python3
"""Draws the plots of docs/performance.md as SVG from what bench/run has measured.

usage: plot_performance.py [--csv FILE] [--out DIR]     (bench/results.csv and docs/performance by default)

The last row of a scene, instruction set and number of threads counts. Needs matplotlib (Debian: python3-matplotlib).
"""
import argparse
import csv
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

try:
    import matplotlib
except ImportError:
    print("plot_performance: skipped: matplotlib is not there (Debian: python3-matplotlib, with /usr/bin/python3)")
    sys.exit(77)
matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "abut", "figure.figsize": (7.2, 3.8), "axes.grid": True, "grid.alpha": 0.3,
                            "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.6, "legend.frameon": False,
                            "font.size": 10})
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = {"shells": "#30638e", "bricks": "#d1691e"}
PHASES = {"elements": "#30638e", "assembly": "#2d7d46", "contact_search": "#777777", "contact_force": "#a4243b",
          "constraints": "#d1691e", "integrate": "#c9b458"}
TARGETS = {"shells": 0.30, "bricks": 0.28}


def rows(path):
    """{(family, isa, threads): [rows by number of elements]}"""
    last = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            last[row["scene"], row["isa"], int(row["threads"])] = row
    found = {}
    for (scene, isa, threads), row in last.items():
        found.setdefault((scene.split("_")[0], isa, threads), []).append(row)
    for some in found.values():
        some.sort(key=lambda row: float(row["elements"]))
    return found


def save(figure, path):
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
    print(path)


def by_size(found, out):
    figure, axes = plt.subplots()
    for (family, isa, threads), some in sorted(found.items()):
        if isa != "avx2" or threads != 1:
            continue
        sizes = [float(row["elements"]) for row in some]
        axes.plot(sizes, [float(row["units_cycle"]) for row in some], "o-", color=COLOURS[family], label=f"{family}, whole cycle")
        axes.plot(sizes, [float(row["ns_elements"]) / float(row["unit_ns"]) for row in some], "s--", color=COLOURS[family],
                  label=f"{family}, elements")
        axes.plot(sizes, [float(row["floor_bytes_ns"]) / float(row["unit_ns"]) for row in some], ":", color=COLOURS[family],
                  label=f"{family}, bytes over bandwidth")
        axes.axhline(TARGETS[family], color=COLOURS[family], alpha=0.4, linewidth=0.8)
    axes.set_xscale("log")
    axes.set_ylim(bottom=0)
    axes.set_xlabel("elements")
    axes.set_ylabel("units per element and cycle")
    axes.set_title("Cost against size (thin lines: targets)")
    axes.legend(fontsize=8)
    save(figure, out / "size.svg")


def by_phase(found, out):
    figure, axes = plt.subplots()
    names, bottom, widths = [], [], {phase: [] for phase in PHASES}
    for (family, isa, threads), some in sorted(found.items()):
        if isa != "avx2" or threads != 1:
            continue
        for row in some:
            names.append(f"{family}\n{int(float(row['elements'])):,}".replace(",", " "))
            for phase in PHASES:
                widths[phase].append(float(row[f"ns_{phase}"]))
    bottom = [0.0] * len(names)
    for phase, colour in PHASES.items():
        axes.bar(names, widths[phase], bottom=bottom, color=colour, label=phase.replace("_", " "))
        bottom = [a + b for a, b in zip(bottom, widths[phase])]
    axes.set_ylabel("ns per element and cycle")
    axes.set_title("Time per phase, least over the cycles")
    axes.tick_params(axis="x", labelsize=7)
    axes.legend(fontsize=8)
    save(figure, out / "phases.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--csv", default=str(ROOT / "bench" / "results.csv"))
    parser.add_argument("--out", default=str(ROOT / "docs" / "performance"))
    args = parser.parse_args()
    out = Path(args.out)
    out.mkdir(parents=True, exist_ok=True)
    found = rows(args.csv)
    by_size(found, out)
    by_phase(found, out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
