#!/usr/bin/env python3
"""Draws the plots of docs/verification/plots.md as SVG.

usage: plots.py --abut PROGRAM [--verify test_verify] [--out DIR]     (DIR: docs/verification by default)

Runs the decks of examples/decks (seconds) and, with --verify, the verification tests (a minute), and draws what they give beside what theory
says. Needs matplotlib (Debian: python3-matplotlib; it belongs to /usr/bin/python3). The same runs give the same files.
"""
import argparse
import csv
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

try:
    import matplotlib
except ImportError:
    print("plots: skipped: matplotlib is not there (Debian: python3-matplotlib, with /usr/bin/python3)")
    sys.exit(77)
matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "abut", "figure.figsize": (7.2, 3.8), "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False,
                            "axes.spines.right": False, "lines.linewidth": 1.6, "legend.frameon": False, "font.size": 10})
import matplotlib.pyplot as plt  # noqa: E402

BLUE, ORANGE, GREEN, RED, GREY = "#30638e", "#d1691e", "#2d7d46", "#a4243b", "#777777"


def history(program, deck, folder, change=None):
    """Runs an example, with its Starter text changed. @returns {column: values}"""
    text = (ROOT / f"examples/decks/{deck}/{deck}_0000.rad").read_text(encoding="utf-8")
    place = Path(folder) / f"{deck}_{abs(hash(str(change)))}"
    place.mkdir()
    if change:
        before, after = change
        if before not in text:
            raise SystemExit(f"plots: {deck} is not the deck that this script knows")
        text = text.replace(before, after)
    (place / f"{deck}_0000.rad").write_text(text, encoding="utf-8")
    (place / f"{deck}_0001.rad").write_bytes((ROOT / f"examples/decks/{deck}/{deck}_0001.rad").read_bytes())
    done = subprocess.run([str(program), "run", str(place / f"{deck}_0000.rad"), "-o", str(place / "run"), "--quiet"], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"plots: {deck} did not run:\n{done.stderr}")
    with open(place / "run" / f"{deck}_th.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(rows[0])}


def save(figure, out, name):
    figure.tight_layout()
    figure.savefig(Path(out) / f"{name}.svg", metadata={"Date": None})
    plt.close(figure)
    print(Path(out) / f"{name}.svg")


def slope(program, folder, out):
    figure, axes = plt.subplots()
    for mu, colour in ((0.1, BLUE), (0.3, GREEN), (0.5, ORANGE), (0.7, RED)):
        h = history(program, "slope", folder, (f"{0.3:>20}{0.0001:>20}", f"{mu:>20}{0.0001:>20}"))
        speed = [1e3 * math.hypot(x, z) / m for x, z, m in zip(h["PART/2/XMOM"], h["PART/2/ZMOM"], h["PART/2/MASS"])]
        a = max(0.0, 9.81 * (math.sin(math.pi / 6) - mu * math.cos(math.pi / 6)))
        theory = [1e3 * a * (0.5 * t * t / 1e-3 if t < 1e-3 else t - 0.5e-3) for t in h["time"]]
        axes.plot([1e3 * t for t in h["time"]], speed, color=colour, label=f"$\\mu$ = {mu}")
        axes.plot([1e3 * t for t in h["time"]], theory, color="black", linewidth=0.8, linestyle="--", label="theory" if mu == 0.7 else None)
    axes.set(xlabel="time, ms", ylabel="speed of the block, mm/s", title="Block on a slope of 30 degrees")
    axes.legend()
    save(figure, out, "slope")


def press_fit(program, folder, out):
    h = history(program, "press_fit", folder)
    delta, young, bore, inner, outer = 3e-5, 210e9, 10.0, 6.0, 20.0
    lame = delta * young / (1e-3 * bore * ((outer**2 + bore**2) / (outer**2 - bore**2) + (bore**2 + inner**2) / (bore**2 - inner**2)))
    figure, axes = plt.subplots()
    time = [1e3 * t for t in h["time"]]
    axes.plot(time, [1e-3 * abs(f) for f in h["INTER/1/FNX"]], color=BLUE, label="resultant of the pressure in X")
    axes.axhline(1e-3 * lame * 1e-4, color=BLUE, linewidth=0.8, linestyle="--", label="long tubes, whole length (Lamé)")
    axes.plot(time, [1e-2 * abs(f) for f in h["INTER/1/FTZ"]], color=ORANGE, label="push, times 10")
    axes.axhline(1e-2 * 0.1 * lame * 0.5 * math.pi * 1e-4, color=ORANGE, linewidth=0.8, linestyle="--")
    axes.set(xlabel="time, ms", ylabel="force on a quarter, kN", title="Press fit: a pin goes into a ring")
    axes.legend(loc="lower right")
    save(figure, out, "press_fit")


def energies(program, folder, out):
    h = history(program, "plate_drop", folder)
    time = [1e3 * t for t in h["time"]]
    figure, (upper, lower) = plt.subplots(2, 1, sharex=True, figsize=(7.2, 5.0), height_ratios=[3, 1])
    for name, label, colour in (("KE", "kinetic", BLUE), ("IE", "internal", GREEN), ("CE", "stored in contact", ORANGE), ("FW", "friction", RED),
                                ("KER", "rotation", GREY)):
        upper.plot(time, h[f"GLOBAL/{name}"], color=colour, label=label)
    upper.set(ylabel="energy, J", title="Plate drop: where the energy is, and what is missing of it")
    upper.legend(ncol=3)
    lower.plot(time, [100 * e for e in h["GLOBAL/ERR"]], color="black", label="error of the balance")
    lower.plot(time, [100 * c / h["GLOBAL/KE"][0] for c in h["GLOBAL/CX"]], color=ORANGE, linewidth=1, label="made by contact")
    lower.set(xlabel="time, ms", ylabel="%")
    lower.legend(ncol=2)
    save(figure, out, "plate_drop")


def bars(found, out):
    """Impact of two bars: the contact time against the closed form with the contact's spring in it, over the number of bricks."""
    figure, axes = plt.subplots()
    for case, colour, label in (("finer", BLUE, "s = 0.2, mesh refined (the spring stiffens with it)"), ("spring kept", ORANGE, "mesh refined, spring kept")):
        rows = re.findall(rf"\[found\] {case}: .* (\d+) per bar: contact ([\d.]+) \(spring theory ([\d.]+)\)", found)
        if not rows:
            raise SystemExit(f"plots: the verification tests print nothing about '{case}'")
        count = [int(row[0]) for row in rows]
        axes.semilogx(count, [float(row[1]) for row in rows], "o-", color=colour, label=label)
        axes.semilogx(count, [float(row[2]) for row in rows], "--", color=colour, linewidth=0.9, label="theory with spring")
    axes.axhline(20.0, color=GREY, linewidth=0.8, linestyle=":", label="theory, rigid contact: 2L/c")
    axes.set(xlabel="bricks along a bar", ylabel="contact time", title="Impact of two bars", xticks=[20, 40, 80, 160], xticklabels=["20", "40", "80", "160"])
    axes.minorticks_off()
    axes.legend()
    save(figure, out, "bars")


def made_energy(found, out):
    figure, axes = plt.subplots()
    for (case, values), colour in zip(re.findall(r"\[found\] CX, (\w+): .*? term ([\d.e+, -]+) at scale", found), (BLUE, GREEN, ORANGE)):
        axes.loglog([0.9, 0.45, 0.225], [float(value) for value in values.split(",")], "o-", color=colour, label=case)
    axes.loglog([0.9, 0.225], [1e-3, 1e-3 / 16], "--", color=GREY, linewidth=0.9, label="second order")
    axes.set(xlabel="factor of the time step", ylabel="mean |CX| over the largest term", title="Energy made by contact falls with the step",
             xticks=[0.225, 0.45, 0.9], xticklabels=["0.225", "0.45", "0.9"])
    axes.minorticks_off()
    axes.legend()
    save(figure, out, "made_energy")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--abut", required=True)
    parser.add_argument("--verify", help="build/release/bin/test_verify")
    parser.add_argument("--out", default=ROOT / "docs/verification")
    args = parser.parse_args()
    Path(args.out).mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="abut-plots-") as folder:
        slope(args.abut, folder, args.out)
        press_fit(args.abut, folder, args.out)
        energies(args.abut, folder, args.out)
    if args.verify:
        found = subprocess.run([args.verify, "--gtest_filter=Bars.*:EnergyMadeByContact.*"], capture_output=True, text=True).stdout
        bars(found, args.out)
        made_energy(found, args.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
