#!/usr/bin/env python3
"""Writes the decks of examples/decks/findings: one per finding of the contact inspection, and `sound`, which has none.

usage: make_finding_decks.py DIR          write DIR/NAME/NAME_0000.rad and NAME_0001.rad
       make_finding_decks.py --check DIR  compare instead of writing; exit status 1 if a file differs

Every deck is two square steel plates over each other, or two blocks (kg, m, s); tests/decks/check_findings.py says which finding each provokes
and which other deck is its twin. Standard library only.
"""
import math
import sys

import generated
from make_examples import STEEL, Deck, Mesh, flat, integers, quads, reals

SIDE, DISTANCE, GAP = 0.1, 1e-3, 9e-4


def plates(name, story, lower=4, upper=4, distance=DISTANCE, gap=GAP, lower_up=True, upper_down=True, flipped=(), repeated=(), shift=0.0,
           stretch=1.0, lower_young=STEEL["young"], thickness=(1e-3, 1e-3), speed=0.0, stfac=0, start=0.0, warp=0.0, valley=0.0, extra=None, end=1e-5, spin=0.0, slide=0.0, raised=0.0,
           loose=False, shared=False, line=False, branch=False, twisted=False):
    """Plate 1 below looks up, plate 2 above looks down, unless told otherwise."""
    mesh = Mesh()
    low, low_nodes = mesh.plate(lambda u, w: (stretch * SIDE * u, SIDE * w, valley * abs(u - 0.5) + (raised if u > 0.7 else 0.0)), lower, lower)
    added = []
    if branch:
        foot = [low_nodes[2][1], low_nodes[2][2]]
        added.append([*foot, *(mesh.node(x, y, -SIDE / 4) for x, y, _ in (mesh.nodes[node - 1] for node in reversed(foot)))])
    if twisted:
        mesh = Mesh()
        low_nodes = [[mesh.node(*band(i / 12, j / 2)) for j in range(3)] for i in range(12)]
        added = [[low_nodes[11][j], low_nodes[0][2 - j], low_nodes[0][1 - j], low_nodes[11][j + 1]] for j in range(2)]
        low = [mesh.element(list(face)) for face in quads(low_nodes)]
    low += [mesh.element(face) for face in added]
    high, high_nodes = mesh.plate(lambda u, w: (shift + stretch * SIDE * u, SIDE * w, distance + (warp if u == w == 0.25 else 0.0)), upper, upper)
    deck = Deck(name, name.replace("_", " "), [story])
    deck.elastic(1, "steel", STEEL["density"], lower_young, STEEL["poisson"])
    deck.elastic(2, **STEEL)
    deck.shell_property(1, "lower", thickness[0], 3)
    deck.shell_property(2, "upper", thickness[1], 3)
    deck.nodes(mesh)
    deck.part(1, "lower", "SHELL", 1, 1, low)
    deck.part(2, "upper", "SHELL", 2, 2, high)
    faces = quads(low_nodes, facing_down=not lower_up)
    for k in flipped:
        faces[k] = faces[k][::-1]
    faces += [faces[k] for k in repeated]
    if loose:
        faces.append([low_nodes[i][j] for i, j in ((0, 0), (2, 0), (2, 2), (0, 2))])
    faces += added
    if line:
        faces.append([low_nodes[0][0], low_nodes[1][0], low_nodes[2][0], low_nodes[2][0]])
    deck.surface_of_faces(1, "lower", faces)
    deck.surface_of_faces(2, "upper", quads(high_nodes, facing_down=upper_down) + ([faces[0][::-1]] if shared else []))
    deck.contact(1, "plate on plate", 1, 2, friction=0, gap=gap)
    if stfac:
        card = deck.lines.index("#              Stfac                Fric                 Gap              Tstart               Tstop") + 1
        deck.lines[card] = reals(stfac) + deck.lines[card][20:60] + reals(start) + deck.lines[card][80:]
    deck.node_group(1, "lower", flat(low_nodes))
    deck.node_group(2, "upper", flat(high_nodes))
    if speed or slide:
        deck.velocity(1, "fall", (slide, 0.0, -speed), 2)
    if spin:
        turning = [node for row in high_nodes for node in row]
        for k, node in enumerate(turning, 2):
            deck.node_group(10 + k, "one node", [node])
            deck.velocity(k, "turn", (0.0, 0.0, spin * (mesh.nodes[node - 1][0] - SIDE / 2)), 10 + k)
    if extra:
        extra(deck)
    deck.history(1, "INTER", [1])
    return deck.write(end=end, rows=10, frames=1)


def band(u, w):
    """A Moebius band: half a turn on the way round."""
    angle, across = 2 * math.pi * u, 0.3 * SIDE * (w - 0.5)
    radius = SIDE / 2 + across * math.cos(angle / 2)
    return SIDE / 2 + radius * math.cos(angle), SIDE / 2 + radius * math.sin(angle), across * math.sin(angle / 2) - 0.2 * SIDE


def blocks(name, story, overlap):
    """Two blocks of bricks, one on the other."""
    mesh = Mesh()
    low, low_nodes = mesh.block((0.0, 0.0, -SIDE / 2), (SIDE, SIDE, SIDE / 2), (4, 4, 2))
    high, high_nodes = mesh.block((0.1 * SIDE, 0.1 * SIDE, -overlap), (0.8 * SIDE, 0.8 * SIDE, SIDE / 2), (4, 4, 2))
    deck = Deck(name, name.replace("_", " "), [story])
    deck.elastic(1, **STEEL)
    deck.solid_property(1, "bricks")
    deck.nodes(mesh)
    deck.part(1, "lower", "BRICK", 1, 1, low)
    deck.part(2, "upper", "BRICK", 1, 1, high)
    deck.surface_of_faces(1, "lower", quads(low_nodes[-1]))
    deck.surface_of_faces(2, "upper", quads(high_nodes[0], facing_down=True))
    deck.contact(1, "block on block", 1, 2, friction=0, gap=0)
    deck.history(1, "INTER", [1])
    return deck.write(end=1e-5, rows=10, frames=1)


def wall(deck):
    deck.node_group(3, "upper, walled", [26, 27, 28])
    deck.add("/RWALL/PLANE/1", "wall above", integers(0, 0, 3, 0), reals(0.0, 0.0, 0.0), reals(0, 0, DISTANCE), reals(0, 0, DISTANCE - 1.0))


def clamp(deck):
    deck.clamp(1, "lower held", 1, rotations=True)


def body(deck):
    deck.add("/RBODY/1", "upper plate is rigid", integers(51, 0, 0, 0) + reals(0) + integers(2, 0, 0, 0), reals(0, 0, 0), reals(0, 0, 0), integers(0))
    position = deck.lines.index("/NODE")
    deck.lines.insert(position + 51, f"{51:>10}{reals(SIDE / 2, SIDE / 2, DISTANCE)}")


def second(deck):
    deck.contact(2, "plate on plate again", 2, 1, friction=0, gap=GAP)


DECKS = {
    "sound": dict(story="Two plates that face each other: nothing to complain about."),
    "normals_away": dict(story="The upper plate looks up.", upper_down=False),
    "both_away": dict(story="Both plates look away from each other.", lower_up=False, upper_down=False),
    "normals_alike": dict(story="Plates that touch; both look up.", distance=0.0, gap=0.0, upper_down=False),
    "touching": dict(story="Plates that touch and look at each other.", distance=0.0, gap=0.0),
    "mixed_orientation": dict(story="One segment of the lower plate looks down.", flipped=(5,)),
    "duplicate_facets": dict(story="One segment of the lower plate is listed twice.", repeated=(5,)),
    "initial_penetration": dict(story="The gap is larger than the distance of the plates.", gap=1.5e-3),
    "out_of_reach": dict(story="The upper plate is beside the lower one.", shift=0.5),
    "blind_nodes": dict(story="The upper plate covers half of the lower one.", shift=0.05),
    "stiffness_ratio": dict(story="The lower plate is of rubber.", lower_young=STEEL["young"] / 50),
    "size_ratio": dict(story="One segment of the lower plate meets 6 by 6 of the upper.", lower=2, upper=12),
    "gap_large": dict(story="The gap is most of a segment.", distance=0.021, gap=0.02),
    "gap_small": dict(story="The plates meet so fast that a step is half of the gap.", gap=1e-5, distance=2e-5, speed=20.0),
    "interface_step": dict(story="A contact spring that is stiffer than what the plates' step allows.", stfac=500),
    "aspect_ratio": dict(story="Segments eight times as long as wide.", stretch=8.0),
    "warp": dict(story="One node of the upper plate is lifted by a third of a segment.", warp=0.01),
    "concave": dict(story="The lower plate is a valley.", valley=0.05, distance=0.03),
    "bound_by_wall": dict(story="Three nodes of the upper plate are on a rigid wall.", extra=wall),
    "bound_by_condition": dict(story="The lower plate cannot move.", extra=clamp),
    "deep_penetration": dict(story="The upper plate falls so fast that it sinks in by most of a segment.", gap=0.0, speed=3000.0),
    "crossed": dict(story="The upper plate falls so fast that nodes would jump through the lower one in a step.", gap=0.0, speed=8000.0),
    "lost_over_border": dict(story="The upper plate is pressed on the lower one and shot sideways.", gap=3e-3, slide=1000.0, speed=600.0,
                             end=2e-5),
    "partly_away": dict(story="A part of the lower plate has been pushed up through the upper one.", lower=8, upper=8, raised=3e-3),
    "no_stiffness": dict(story="One segment of the lower surface is on no element.", loose=True),
    "same_pair": dict(story="A second interface acts between the same two surfaces.", extra=second),
    "bound_by_body": dict(story="The upper plate is a rigid body.", extra=body),
    "turned_away": dict(story="The upper plate turns over; its surface then looks up.", distance=0.054, gap=0.03, spin=2e3, end=2.2e-3, stfac=1e-9,
                        start=1.4e-3),
    "shared_nodes": dict(story="One segment of the lower plate is in the upper surface too.", shared=True),
    "degenerate_facets": dict(story="One segment of the lower surface has its nodes on one line.", line=True),
    "junctions": dict(story="A rib stands on the back of the lower plate, and is in its surface.", branch=True),
    "one_sided": dict(story="The lower surface is a Moebius band.", twisted=True),
}
BLOCKS = {
    "overlap": dict(story="Two blocks whose meshes overlap by a tenth of a brick.", overlap=2.5e-3),
    "on_top": dict(story="Two blocks that touch.", overlap=0.0),
}


def main():
    folder, check = generated.arguments(__doc__)
    decks = [plates(name, **options) for name, options in DECKS.items()] + [blocks(name, **options) for name, options in BLOCKS.items()]
    different = sum(generated.write_or_check(folder / file.rpartition("_")[0] / file, text, check) for deck in decks for file, text in deck.items())
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
