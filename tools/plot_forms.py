#!/usr/bin/env python3
"""Runs the quasi-static closed forms and Taylor's bar and draws docs/verification/plots/*.svg from the tables that they leave.

usage: plot_forms.py [--test PROGRAM] [--tables DIR] [--out DIR]

--tables: where the tables (CSV) go; tables that are there already are drawn as they are. Exit status 1 if a test fails.
Standard library only.
"""
import argparse
import csv
import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FILTER = "Hertz.*:PressFit.GivesThePressureOfLame:ContactPatch.TwoPasses*:TaylorBar.*"
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 640, 400, 70, 20, 40, 50
COLOURS = ["#1f5fa8", "#c0392b", "#2e8b57", "#8e6bb0"]


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def ticks(low, high):
    """Round values, about five."""
    step = 10 ** math.floor(math.log10((high - low) / 4))
    step *= next(f for f in (1, 2, 5, 10) if (high - low) / (step * f) <= 6)
    first = math.ceil(low / step - 1e-9)
    return [step * i for i in range(first, math.floor(high / step + 1e-9) + 1)]


class Chart:
    def __init__(self, title, x_label, y_label, x_range, y_range, equal=False):
        self.x_range, self.y_range = x_range, y_range
        self.height = HEIGHT
        if equal:  # the same scale along both axes
            self.height = round((WIDTH - LEFT - RIGHT) * (y_range[1] - y_range[0]) / (x_range[1] - x_range[0])) + TOP + BOTTOM
        self.parts = [f'<text x="{WIDTH / 2}" y="22" text-anchor="middle" font-size="15">{title}</text>']
        self.legend = []
        base = self.height - BOTTOM
        for x in ticks(*x_range):
            p = self.x(x)
            self.parts.append(f'<path d="M{p:.1f} {TOP}V{base}" stroke="#ddd"/>')
            self.parts.append(f'<text x="{p:.1f}" y="{base + 18}" text-anchor="middle">{x:g}</text>')
        for y in ticks(*y_range):
            p = self.y(y)
            self.parts.append(f'<path d="M{LEFT} {p:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>')
            self.parts.append(f'<text x="{LEFT - 6}" y="{p + 4:.1f}" text-anchor="end">{y:g}</text>')
        self.parts.append(f'<path d="M{LEFT} {TOP}V{base}H{WIDTH - RIGHT}" fill="none" stroke="#333"/>')
        self.parts.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{self.height - 10}" text-anchor="middle">{x_label}</text>')
        middle = (TOP + base) / 2
        self.parts.append(f'<text transform="translate(18 {middle}) rotate(-90)" text-anchor="middle">{y_label}</text>')

    def x(self, v):
        low, high = self.x_range
        return LEFT + (v - low) / (high - low) * (WIDTH - LEFT - RIGHT)

    def y(self, v):
        low, high = self.y_range
        return self.height - BOTTOM - (v - low) / (high - low) * (self.height - TOP - BOTTOM)

    def _name(self, name, colour, mark):
        if not name:
            return
        y = TOP + 16 + 18 * len(self.legend)
        x = WIDTH - RIGHT - 210
        self.legend.append(mark(x + 10, y - 4, colour) + f'<text x="{x + 28}" y="{y}">{name}</text>')

    def line(self, points, name="", colour=COLOURS[0], dash=""):
        d = " ".join(f"{self.x(x):.1f},{self.y(y):.1f}" for x, y in points)
        style = f'fill="none" stroke="{colour}" stroke-width="2"' + (f' stroke-dasharray="{dash}"' if dash else "")
        self.parts.append(f'<polyline points="{d}" {style}/>')
        self._name(name, colour, lambda x, y, c: f'<path d="M{x - 8} {y}H{x + 12}" {style}/>')

    def dots(self, points, name="", colour=COLOURS[1]):
        for x, y in points:
            self.parts.append(f'<circle cx="{self.x(x):.1f}" cy="{self.y(y):.1f}" r="3" fill="{colour}" fill-opacity="0.6"/>')
        self._name(name, colour, lambda x, y, c: f'<circle cx="{x}" cy="{y}" r="3" fill="{c}"/>')

    def bar(self, x0, x1, y, colour):
        top = self.y(min(y, self.y_range[1]))
        self.parts.append(f'<rect x="{self.x(x0):.1f}" y="{top:.1f}" width="{self.x(x1) - self.x(x0):.1f}" '
                          f'height="{self.y(self.y_range[0]) - top:.1f}" fill="{colour}"/>')

    def name_bar(self, name, colour):
        self._name(name, colour, lambda x, y, c: f'<rect x="{x - 6}" y="{y - 6}" width="12" height="12" fill="{c}"/>')

    def text(self, x, y, text):
        self.parts.append(f'<text x="{self.x(x):.1f}" y="{self.y(y) - 4:.1f}" text-anchor="middle" font-size="11">{text}</text>')

    def write(self, path):
        body = "\n".join(self.parts + self.legend)
        path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {self.height}" font-family="sans-serif" font-size="13">\n'
                        f'<rect width="{WIDTH}" height="{self.height}" fill="white"/>\n{body}\n</svg>\n', encoding="utf-8")


def ellipse(radius, peak):
    return [(radius * i / 100, peak * math.sqrt(1 - (i / 100) ** 2)) for i in range(101)]


def hertz(tables, out, name, title, radius, peak, reach):
    chart = Chart(title, "distance from the middle, mm", "pressure, MPa", (0, reach), (0, 1.15 * peak))
    chart.line(ellipse(radius, peak), "Hertz")
    rows = table(tables / f"{name}.csv")
    chart.dots([(r["distance"], r["pressure"]) for r in rows if r["distance"] <= reach], "nodes of both bodies")
    chart.write(out / f"{name}.svg")


def press_fit(tables, out):
    chart = Chart("Press fit: pressure in the joint", "angle, degrees", "pressure, MPa", (0, 90), (80, 120))
    chart.line([(0, 100), (90, 100)], "Lame")
    chart.dots([(r["angle"], r["pressure"]) for r in table(tables / "press_fit_matching.csv")], "nodes of the disc")
    chart.write(out / "press_fit.svg")


def patch(tables, out):
    rows = [r for r in table(tables / "patch.csv") if r["stiffening"] == 0]
    ratios = list(dict.fromkeys((r["lower"], r["upper"]) for r in rows))
    chart = Chart("Contact patch test, constant law, s 4", "bricks along a side, upper on lower block", "largest error of stress, %",
                  (0, len(ratios)), (0, 100))
    for i, ratio in enumerate(ratios):
        for r in rows:
            if (r["lower"], r["upper"]) != ratio:
                continue
            side = 0 if r["passes"] == 2 else 1
            x = i + 0.15 + 0.35 * side
            chart.bar(x, x + 0.32, r["worst"], COLOURS[side])
            chart.text(x + 0.16, min(r["worst"], 96), f'{r["worst"]:.3g}')
        chart.text(i + 0.5, 88, f"{ratio[1]:g} on {ratio[0]:g}")
    chart.name_bar("two passes (TYPE3)", COLOURS[0])
    chart.name_bar("one pass (TYPE5)", COLOURS[1])
    chart.write(out / "patch.svg")


def taylor(tables, out, name, title):
    chart = Chart(title, "height, mm", "radius, mm", (0, 24), (0, 10), equal=True)
    chart.line([(r["height"], r["radius"]) for r in table(tables / f"{name}_wall.csv")], "rigid wall")
    chart.line([(r["height"], r["radius"]) for r in table(tables / f"{name}_block.csv")], "TYPE3, stiff block", COLOURS[1], "6 4")
    chart.write(out / f"{name}.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--test", type=Path, default=ROOT / "build/release/bin/test_verify")
    parser.add_argument("--tables", type=Path)
    parser.add_argument("--out", type=Path, default=ROOT / "docs/verification/plots")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        tables = options.tables or Path(scratch)
        tables.mkdir(parents=True, exist_ok=True)
        if not list(tables.glob("*.csv")):
            run = subprocess.run([options.test, f"--gtest_filter={FILTER}"], env={**os.environ, "ABUT_FORMS": str(tables)}, check=False)
            if run.returncode != 0:
                return 1
        options.out.mkdir(parents=True, exist_ok=True)
        hertz(tables, options.out, "hertz_spheres", "Hertz, spheres of 50 mm, approach 4 mm", 10.0, 2798.0, 13.0)
        hertz(tables, options.out, "hertz_cylinders", "Hertz, cylinders of 254 mm, 10 kN/mm", 3.78, 1684.0, 5.0)
        press_fit(tables, options.out)
        patch(tables, options.out)
        taylor(tables, options.out, "taylor_perfect", "Taylor's bar, yield 314 MPa, after 110 us")
        taylor(tables, options.out, "taylor_hardening", "Taylor's bar, yield 400 MPa, after 80 us")
    return 0


if __name__ == "__main__":
    sys.exit(main())
