#!/usr/bin/env python3
"""Writes a deck of which every contact value is known, and those values: two flat plates whose nodes all move as told.

usage: flat_plates.py FOLDER     FOLDER/flat_plates_0000.rad, _0001.rad, and known.json for viewer/browser/report.test.mjs

The meshes lie on each other. The lower plate is held; the upper one comes down from a distance of 1.5 mm to 0.9 mm, stays there, and then goes
sideways by half a millimetre. TYPE3 with a gap g of 1 mm and friction 0.1. Inside the plates, where every node has four facets around it
(docs/theory/contact.md, 3 and 4; h the side of a shell, t its thickness, P the penetration):

  gap            distance - g before the touch
  P              g - distance
  pressure       each node has the springs of two passes, kappa = s E t / 2 each: 2 kappa phi'(P) / h^2, phi' = g P / (g - P) (T13, T17, T24)
  shear          friction times pressure once it slips, and it slips once kappa/10 times the way exceeds friction kappa phi'

Standard library only.
"""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tools"))
from make_examples import STEEL, Deck, Mesh, flat, reals, integers  # noqa: E402

CELLS, SIDE, THICKNESS = 6, 0.01, 1e-3  # of a shell
GAP, FRICTION, STFAC = 1e-3, 0.1, 0.2
HIGH, LOW, WAY = 1.5e-3, 0.9e-3, 5e-4
TOUCHED, PUSHED, END, FRAMES = 4e-4, 6e-4, 1e-3, 10


def deck():
    mesh = Mesh()
    lower, lower_nodes = mesh.plate(lambda u, w: (CELLS * SIDE * u, CELLS * SIDE * w, 0.0), CELLS, CELLS)
    upper, upper_nodes = mesh.plate(lambda u, w: (CELLS * SIDE * u, CELLS * SIDE * w, HIGH), CELLS, CELLS, facing_down=True)
    plates = Deck("flat_plates", "two flat plates", ["Written by tests/report/flat_plates.py: every node moves as told."])
    plates.elastic(1, **STEEL)
    plates.shell_property(1, "plates", THICKNESS, 3)
    plates.nodes(mesh)
    plates.part(1, "lower plate", "SHELL", 1, 1, lower)
    plates.part(2, "upper plate", "SHELL", 1, 1, upper)
    plates.surface_of_part(1, "lower plate, normals up", 1)
    plates.surface_of_part(2, "upper plate, normals down", 2)
    plates.node_group(1, "lower plate", flat(lower_nodes))
    plates.clamp(1, "held", 1, rotations=True)
    plates.node_group(2, "upper plate", flat(upper_nodes))
    plates.add("/BCS/2", "no sideways motion, no rotation", "#  Tra rot   skew_ID  grnod_ID", "   010 111" + integers(0, 2))
    plates.add("/FUNCT/1", "down", *(reals(*point) for point in ((0, 0), (TOUCHED, LOW - HIGH), (1, LOW - HIGH))))
    plates.add("/FUNCT/2", "sideways", *(reals(*point) for point in ((0, 0), (PUSHED, 0), (END, WAY), (1, WAY))))
    for number, direction in ((1, "Z"), (2, "X")):
        plates.add(f"/IMPDISP/{number}", direction, "#funct_IDT       Dir   skew_ID sensor_ID  grnod_ID  frame_ID     Icoor",
                   integers(number, direction, 0, 0, 2, 0, 0), "#           Ascale_x            Fscale_Y              Tstart               Tstop",
                   reals(1, 1, 0, 1e30))
    plates.contact(1, "plate on plate", 1, 2, friction=FRICTION, gap=GAP, stiffness=STFAC)
    return plates.write(end=END, rows=100, frames=FRAMES), lower_nodes[CELLS // 2][CELLS // 2], upper_nodes[CELLS // 2][CELLS // 2]


def known(lower, upper):
    """What the report has to show at a node inside each plate, in states of the animation: {label: value}; `moves` for the upper plate alone."""
    depth = GAP - LOW
    pressure = STFAC * STEEL["young"] * THICKNESS * GAP * depth / (GAP - depth) / SIDE**2
    return {
        "lower": lower, "upper": upper, "segments": CELLS * CELLS,
        "frames": [
            {"frame": 0, "what": "apart", "values": {"Gap to the other surface": HIGH - GAP, "Penetration": 0, "Contact pressure": 0}, "state": "apart"},
            {"frame": 5, "what": "pressed", "state": "sticks",
             "values": {"Gap to the other surface": -depth, "Penetration": depth, "Contact pressure": pressure, "Contact shear stress": 0}},
            {"frame": 9, "what": "sliding", "state": "slips", "moves": {"Displacement Z": LOW - HIGH, "Velocity X": WAY / (END - PUSHED)},
             "values": {"Penetration": depth, "Contact pressure": pressure, "Contact shear stress": FRICTION * pressure}},
        ],
    }


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    files, lower, upper = deck()
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "known.json").write_text(json.dumps(known(lower, upper), indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
