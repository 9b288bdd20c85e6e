#!/usr/bin/env python3
"""Draws docs/theory/pictures/NAME.svg, the pictures of docs/theory/contact.md, "Who touches".

usage: draw_contact.py DIR          write DIR/NAME.svg
       draw_contact.py --check DIR  compare instead of writing; exit status 1 if a file differs, is missing or not shown in ../contact.md

The surface is blue, its positive side up; forces on nodes are red. Standard library only.
"""
import math
import sys

import generated
from draw_findings import BLUE, DARK, GREY, RED, Picture

PALE = "#8fb3dd"


def rectangle(left, top, right, bottom):
    return (left, top), (right, top), (right, bottom), (left, bottom)


def measure(p, x, top, bottom, text):
    """A length with its name, between two heights."""
    p.arrow(x, (top + bottom) / 2, 0, (bottom - top) / 2, GREY).arrow(x, (top + bottom) / 2, 0, (top - bottom) / 2, GREY)
    return p.text(x + 6, (top + bottom) / 2 + 4, text, GREY)


def one_sided():
    """Truth for a free node, 1 to 4: d against Gap and depth limit."""
    p = Picture(620, 230)
    face, front, limit = 130, 70, 175
    p.fill(*rectangle(30, front, 430, face), color=PALE).fill(*rectangle(30, face, 430, limit))
    p.line((30, face), (230, face), (430, face), color=BLUE).arrow(40, face, 0, -22, BLUE).text(46, face - 10, "n", BLUE)
    measure(p, 445, front, face, "Gap, in front: d > 0")
    measure(p, 445, face, limit, "depth limit, behind: d < 0")
    p.node((100, 45), color=GREY).thin((100, 45), (100, face)).text(109, 42, "d > Gap: apart", GREY)
    p.thin((165, 105), (165, face), color=DARK).node((165, 105), (165, face)).arrow(165, 105, 0, -45, RED).text(171, 122, "d")
    p.text(150, face + 16, "p").text(172, 88, "P = Gap - d > 0")
    p.node((260, 155)).arrow(260, 155, 0, -105, RED).text(268, 166, "|d| within the limit: pushed")
    p.text(268, 62, "out through the front")
    p.node((100, 205), color=GREY).text(109, 209, "deeper, and coming from behind: ignored until it is seen in front", GREY)
    return p


def swept():
    """Truth for a free node, 5."""
    p = Picture(560, 230)
    p.fill(*rectangle(60, 110, 380, 155))
    p.thin((60, 135), (380, 135), color=BLUE).line((60, 110), (380, 110), color=BLUE)
    p.text(388, 139, "facet at t - h", BLUE).text(388, 114, "facet at t", BLUE)
    measure(p, 75, 110, 155, "depth limit")
    p.thin((200, 40), (250, 205), color=DARK).node((200, 40), color=GREY).node((250, 205))
    p.text(210, 40, "node at t - h, in front", GREY).text(260, 209, "node at t, deeper than the depth limit")
    share = (135 - 40) / (205 - 40 + 135 - 110)  # of the step, where the node is on the facet: 40 + 165 s = 135 - 25 s
    x, y = 200 + 50 * share, 40 + 165 * share
    p.add(f'<circle cx="{x:.4g}" cy="{y:.4g}" r="7" fill="none" stroke="{RED}" stroke-width="1.5"/>')
    p.text(x + 14, y - 34, f"they meet at {share:.2f} of the step: crossed,", RED).text(x + 14, y - 21, "held from then on", RED)
    p.arrow(250, 205, 0, -60, RED)
    return p


def taper(overshoot, depth):
    """T of docs/theory/contact.md, section 1; both in lengths of the facet."""
    u = min(1.0, max(0.0, (overshoot - 0.1 - depth) / 0.1))
    return (1.0 - u * u) ** 2


def strip():
    """T beyond a free border, for a node in front and for one 0.15 of the facet's length deep."""
    p = Picture(560, 260)
    border, unit, face = 200, 600, 70  # one facet's length is 600: a tenth is 60

    def at(overshoot):
        return border + unit * overshoot

    p.line((20, face), (border, face), color=BLUE).node((border, face), color=BLUE)
    p.line((border, face), (at(0.2), face), color=PALE).thin((border, face - 50), (border, 240)).thin((at(0.1), 105), (at(0.1), 240))
    p.thin((at(0.2), 105), (at(0.2), 240)).text(60, face + 16, "facet", BLUE).text(border - 70, 28, "free border")
    p.text(border + 6, face + 16, "strip, a fifth of the facet's length", GREY)
    for overshoot in (-0.15, 0.05, 0.15):
        x = at(overshoot)
        p.node((x, face - 16)).arrow(x, face - 16, 0, -34 * taper(overshoot, 0.0), RED)
    p.node((at(0.24), face - 16), color=GREY).text(at(0.24) + 8, face - 12, "held no more: lost", GREY)
    low, high = 230, 120
    p.thin((20, low), (540, low), dashed=False).text(504, low - 6, "way", GREY).text(24, high + 16, "T")
    for depth, dashed in ((0.0, False), (0.15, True)):
        steps = [0.1 + depth + 0.1 * k / 24 for k in range(25)]
        curve = [(20, high)] + [(round(at(o), 1), round(low - (low - high) * taper(o, depth), 1)) for o in steps]
        p.line(*curve, color=RED, width=2, dashed=dashed)
    p.text(border + 3, 252, "0").text(at(0.1) + 3, 252, "0.1").text(at(0.2) + 3, 252, "0.2")
    p.text(24, 150, "1 over the facet and half of the strip").text(at(0.34), 190, "for a node that is", RED)
    p.text(at(0.34), 204, "0.15 deep: longer by w", RED)
    return p


def tie():
    """Two facets at the same distance: over an edge one point, in a fold two."""
    p = Picture(560, 230)
    p.line((20, 190), (140, 120), (260, 190), color=BLUE).arrow(80, 155, -11, -19, BLUE).arrow(200, 155, 11, -19, BLUE)
    p.node((140, 120), color=BLUE).thin((140, 120), (140, 75), color=DARK).node((140, 75)).arrow(140, 75, 0, -45, RED)
    p.text(148, 112, "p on the edge,").text(148, 124, "the same for both").text(148, 92, "r = x - p").text(148, 42, "force along r", RED)
    p.text(20, 220, "ridge: one nearest point")
    left, right, foot = (300, 110), (540, 110), (420, 180)
    p.line(left, foot, right, color=BLUE)
    node = (420, 130)
    length = math.hypot(120, 70)
    along = (foot[0] - left[0]) / length, (foot[1] - left[1]) / length
    way = (node[0] - left[0]) * along[0] + (node[1] - left[1]) * along[1]
    near = round(left[0] + way * along[0], 1), round(left[1] + way * along[1], 1)
    mirror = round(840 - near[0], 1), near[1]
    p.thin(node, near, color=DARK).thin(node, mirror, color=DARK).node(near, mirror, color=BLUE).node(node)
    for point in (near, mirror):
        p.arrow(*node, round(0.8 * (node[0] - point[0]), 1), round(0.8 * (node[1] - point[1]), 1), GREY)
    p.arrow(*node, 0, -70, RED).text(428, 62, "mean of both,", RED).text(428, 76, "whatever their ids", RED)
    p.text(near[0] - 22, near[1] + 16, "p1").text(mirror[0] + 8, mirror[1] + 16, "p2")
    p.text(300, 220, "fold: two, equal to 1e-8 of the distance")
    return p


DRAWINGS = [one_sided, swept, strip, tie]


def main():
    folder, check = generated.arguments(__doc__)
    page = (folder.parent / "contact.md").read_text(encoding="utf-8")
    faults = 0
    for draw in DRAWINGS:
        path = folder / (draw.__name__ + ".svg")
        faults += generated.write_or_check(path, draw().svg(draw.__name__), check)
        if f"]({folder.name}/{path.name})" not in page:
            faults += 1
            print(f"{folder.parent / 'contact.md'} does not show {path.name}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
