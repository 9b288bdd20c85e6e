#!/usr/bin/env python3
"""Ten friction coefficients: how much speed does a sliding block lose?

usage: friction_study.py [FOLDER]     the plot goes to FOLDER/friction_study.png (default: the present folder)

An aluminium block (40 x 40 x 20 mm) slides with 20 m/s on a fixed steel block, pressed on it with N = 20 kN. As a rigid body it has
after the time T the speed v0 - mu N T/m, or has stopped. The model is built from arrays; units: kg, m, s.
"""
import sys
from pathlib import Path

import numpy as np

import abut

SPEED, LOAD, END, RAMP = 20.0, 20e3, 2.5e-4, 2e-5
SIZE = np.array([0.04, 0.04, 0.02])
MASS = 2700 * SIZE.prod()


def block(builder, corner, size, count):
    """A box of bricks. @returns node ids [i, j, k] and bricks as (E, 8) node ids"""
    axes = [c + s * np.arange(n + 1) / n for c, s, n in zip(corner, size, count)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    ids = builder.nodes(grid.reshape(-1, 3)).reshape(grid.shape[:3])
    low, high = slice(None, -1), slice(1, None)
    face = [(low, low), (high, low), (high, high), (low, high)]
    bricks = np.stack([ids[a, b, level] for level in (low, high) for a, b in face], axis=-1)
    return ids, bricks.reshape(-1, 8)


def quads(grid):
    """Faces between the nodes of a layer [i, j], normals up."""
    return np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=-1).reshape(-1, 4)


def sliding_block(friction):
    b = abut.ModelBuilder("slide", title=f"friction {friction:g}")
    steel = b.elastic(density=7800, young=210e9, poisson=0.3)
    aluminium = b.elastic(density=2700, young=70e9, poisson=0.33)
    solid = b.solid_property()
    base, base_bricks = block(b, (-0.03, -0.03, -0.01), (0.1, 0.06, 0.01), (12, 7, 1))
    slider, slider_bricks = block(b, (0.0, -0.0205, 1e-4), SIZE, (4, 4, 2))
    b.part(solid, steel, bricks=base_bricks, title="base")
    part = b.part(solid, aluminium, bricks=slider_bricks, title="slider")
    b.fix(base[:, :, 0].ravel())
    b.velocity(slider.ravel(), (SPEED, 0.0, 0.0))
    top = slider[:, :, -1].ravel()
    b.load(top, "Z", b.function([0.0, RAMP, 1.0], [0.0, 1.0, 1.0]), scale=-LOAD / len(top))
    below = quads(slider[:, :, 0])[:, ::-1]
    b.contact(b.surface(quads(base[:, :, -1])), b.surface(below), gap=1e-4, friction=friction)
    b.history(parts=[part], interfaces=[1])
    b.engine(END)
    return b.build()


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    coefficients = np.linspace(0.05, 0.5, 10)
    speeds, works, errors = [], [], []
    for friction in coefficients:
        run = abut.Run(sliding_block(friction))
        run.advance_to_end()
        speeds.append(run.history["PART/2/XMOM"][-1] / MASS)
        works.append(run.interfaces[0].fw)
        errors.append(run.balance.err)

    rigid = np.maximum(0.0, SPEED - coefficients * LOAD * (END - RAMP / 2) / MASS)
    print("friction   speed   rigid body   friction work   energy error")
    for row in zip(coefficients, speeds, rigid, works, errors):
        print("{:8.2f} {:7.2f} {:12.2f} {:13.2f} J {:13.1e}".format(*row))

    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError:
        print("no plot: matplotlib is not installed (Debian: apt-get install python3-matplotlib)")
        return
    figure, axes = plt.subplots(figsize=(7, 4), layout="constrained")
    axes.plot(coefficients, rigid, "-", color="0.6", label="rigid body: $v_0 - \\mu N T/m$")
    axes.plot(coefficients, speeds, "o", color="tab:blue", label="abut")
    axes.set(xlabel="coefficient of friction", ylabel=f"speed after {END * 1e3:g} ms (m/s)", ylim=(-1, SPEED))
    axes.legend()
    folder.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / "friction_study.png", dpi=120)
    print(f"plot: {folder / 'friction_study.png'}")


if __name__ == "__main__":
    main()
