#!/usr/bin/env python3
"""Draws docs/findings/CODE.svg, a picture for every finding of the contact inspection.

usage: draw_findings.py DIR          write DIR/CODE.svg
       draw_findings.py --check DIR  compare instead of writing; exit status 1 if a file differs, is missing or has no section in index.md

First surface blue and below, second red and above; arrows are normals unless named; what the finding complains about is dark.
Standard library only.
"""
import math
import sys

import generated

WIDTH, HEIGHT = 260, 110
BLUE, RED, GREY, DARK = "#2b6cb0", "#c05621", "#8a8f98", "#1a202c"


class Picture:
    def __init__(self, width=WIDTH, height=HEIGHT):
        self.width, self.height, self.parts = width, height, []

    def add(self, part):
        self.parts.append("  " + part)
        return self

    def line(self, *points, color=DARK, width=3, dashed=False):
        path = " ".join(f"{x:g},{y:g}" for x, y in points)
        dash = ' stroke-dasharray="5 4"' if dashed else ""
        return self.add(f'<polyline points="{path}" fill="none" stroke="{color}" stroke-width="{width}"{dash}/>')

    def thin(self, *points, color=GREY, dashed=True):
        return self.line(*points, color=color, width=1.2, dashed=dashed)

    def fill(self, *points, color=GREY):
        path = " ".join(f"{x:g},{y:g}" for x, y in points)
        return self.add(f'<polygon points="{path}" fill="{color}" fill-opacity="0.25" stroke="{color}" stroke-width="1.2"/>')

    def arrow(self, x, y, dx, dy, color=DARK):
        length = math.hypot(dx, dy)
        u, v = dx / length, dy / length
        tip, back = (x + dx, y + dy), (x + dx - 6 * u, y + dy - 6 * v)
        head = " ".join(f"{a:.3g},{b:.3g}" for a, b in (tip, (back[0] - 3 * v, back[1] + 3 * u), (back[0] + 3 * v, back[1] - 3 * u)))
        self.add(f'<line x1="{x:g}" y1="{y:g}" x2="{back[0]:.4g}" y2="{back[1]:.4g}" stroke="{color}" stroke-width="1.5"/>')
        return self.add(f'<polygon points="{head}" fill="{color}"/>')

    def node(self, *points, color=DARK):
        for x, y in points:
            self.add(f'<circle cx="{x:g}" cy="{y:g}" r="3.5" fill="{color}"/>')
        return self

    def text(self, x, y, text, color=DARK):
        text = text.replace("&", "&amp;").replace("<", "&lt;")
        return self.add(f'<text x="{x:g}" y="{y:g}" font-family="sans-serif" font-size="11" fill="{color}">{text}</text>')

    def svg(self, code):
        width, height = self.width, self.height
        head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="img">'
        ground = f'  <rect width="{width}" height="{height}" fill="white"/>'
        return "\n".join([head, f"  <title>{code}</title>", ground, *self.parts, "</svg>\n"])


def lower(p, x0=30, x1=230, y=80, color=BLUE, up=True, cells=4):
    p.line((x0, y), (x1, y), color=color)
    for i in range(cells + 1):
        x = x0 + (x1 - x0) * i / cells
        p.line((x, y - 3), (x, y + 3), color=color, width=1.2)
    for i in range(cells):
        if up is not None:
            p.arrow(x0 + (x1 - x0) * (i + 0.5) / cells, y, 0, -18 if up else 18, color)
    return p


def upper(p, x0=30, x1=230, y=30, up=False, cells=4, color=RED):
    return lower(p, x0, x1, y, color, up, cells)


def pair():
    return upper(lower(Picture()))


def shared_nodes(p):
    p.line((30, 80), (130, 55), color=BLUE).line((130, 55), (230, 80), color=RED).node((130, 55))
    p.text(140, 50, "a node of both")


def degenerate_facets(p):
    p.line((30, 60), (230, 60), color=BLUE).node((80, 60), (130, 60), (180, 60)).text(60, 85, "three nodes on a line: no normal")


def duplicate_facets(p):
    lower(p)
    p.line((80, 74), (130, 74), color=DARK).arrow(105, 74, 0, -24).text(138, 66, "the same nodes again")


def normals_away(p):
    upper(lower(p), up=True)
    p.text(60, 58, "looks away: nothing is felt")


def normals_alike(p):
    lower(p, y=62)
    p.line((30, 58), (230, 58), color=RED)
    for x in (80, 130, 180):
        p.arrow(x, 58, 0, -24, RED)
    p.text(60, 90, "they touch, both look up")


def partly_away(p):
    lower(p, y=62)
    p.line((30, 30), (130, 40), (170, 75), (230, 82), color=RED).arrow(80, 35, -2, 17, RED).arrow(200, 79, -2, 17, RED)
    p.text(150, 104, "a part is through")


def mixed_orientation(p):
    lower(p, up=None)
    for x, up in ((55, -18), (105, -18), (155, 18), (205, -18)):
        p.arrow(x, 80, 0, up, DARK if up > 0 else BLUE)
    p.text(120, 45, "one is the other way round")


def one_sided(p):
    p.fill((40, 40), (110, 25), (110, 60), (40, 80), color=BLUE).fill((110, 25), (190, 70), (190, 35), (110, 60), color=BLUE)
    p.arrow(75, 52, 0, -22).arrow(165, 50, 0, 24).text(60, 102, "a band that is turned once: no outside")


def junctions(p):
    p.line((30, 75), (230, 75), color=BLUE).line((130, 75), (130, 20), color=BLUE).node((130, 75)).text(138, 40, "three at one edge")


def no_stiffness(p):
    lower(p)
    p.thin((130, 80), (180, 80), color="white", dashed=False)
    for x in (135, 145, 155, 165, 175):
        p.node((x, 80), color=GREY)
    p.text(90, 104, "no shell or brick behind")


def overlap(p):
    p.fill((30, 60), (230, 60), (230, 105), (30, 105), color=BLUE).fill((70, 10), (190, 10), (190, 78), (70, 78), color=RED)
    p.node((70, 78), (110, 78), (150, 78), (190, 78)).text(196, 74, "depth")


def out_of_reach(p):
    lower(p, 20, 110)
    upper(p, 160, 245)
    p.thin((110, 80), (160, 30)).text(20, 30, "nobody before or behind")


def stiffness_ratio(p):
    upper(lower(p))
    p.fill((30, 80), (230, 80), (230, 88), (30, 88), color=BLUE).fill((30, 5), (230, 5), (230, 30), (30, 30), color=RED)
    p.text(100, 60, "K1 much larger than K2")


def size_ratio(p):
    upper(lower(p, cells=1), cells=12)
    p.text(70, 60, "one segment, many nodes")


def gap_large(p):
    lower(p)
    p.thin((30, 35), (230, 35)).arrow(40, 80, 0, -45, GREY).arrow(80, 92, 50, 0, GREY).text(85, 106, "size").text(46, 60, "gap")


def gap_small(p):
    lower(p)
    p.thin((30, 72), (230, 72)).node((130, 40)).arrow(130, 40, 0, 52).text(140, 50, "v h: one step").text(232, 76, "gap", GREY)


def interface_step(p):
    lower(p)
    p.node((130, 25)).line((130, 25), (130, 38), (122, 42), (138, 50), (122, 58), (138, 66), (130, 70), (130, 80), width=1.5)
    p.text(140, 28, "m").text(146, 50, "h = sqrt(2 m/K)").text(20, 50, "< h of the elements")


def aspect_ratio(p):
    p.fill((30, 50), (230, 50), (230, 70), (30, 70), color=BLUE).arrow(100, 88, 120, 0, GREY).text(60, 92, "long").text(60, 40, "short: 1, long: > 5")


def warp(p):
    p.fill((40, 85), (120, 95), (200, 75), (110, 60), color=BLUE).thin((120, 95), (110, 60)).node((200, 75), color=BLUE).node((200, 40))
    p.thin((200, 75), (200, 40)).thin((120, 95), (200, 40), (110, 60), color=DARK).text(120, 30, "a corner off the plane")


def bound_by_wall(p):
    lower(p)
    p.fill((20, 84), (240, 84), (240, 100), (20, 100)).node((80, 80), (130, 80), (180, 80)).text(100, 98, "rigid wall")


def same_pair(p):
    upper(lower(p))
    for x, label in ((95, "1"), (165, "2")):
        p.line((x, 30), (x, 40), (x - 8, 43), (x + 8, 49), (x - 8, 55), (x + 8, 61), (x, 64), (x, 80), width=1.5).text(x + 12, 60, label)
    p.text(60, 102, "two interfaces: K1 + K2")


def initial_penetration(p):
    upper(lower(p), y=55)
    p.thin((30, 40), (230, 40)).arrow(216, 40, 0, 15).text(222, 52, "P").text(36, 38, "gap", GREY)


def clearance(p):
    pair_of = upper(lower(p))
    pair_of.thin((30, 62), (230, 62)).arrow(130, 62, 0, -30).text(138, 52, "clearance").text(232, 66, "gap", GREY)


def blind_nodes(p):
    lower(p)
    upper(p, 30, 130, cells=2)
    p.node((180, 80), (230, 80)).text(136, 34, "no segment before")


def concave(p):
    p.line((30, 30), (90, 80), (170, 80), (230, 30), color=BLUE).arrow(60, 55, 10, -13, BLUE).arrow(130, 80, 0, -18, BLUE)
    p.arrow(200, 55, -10, -13, BLUE).node((90, 80), (170, 80)).text(95, 102, "folds inwards")


def bound_by_condition(p):
    pair_of = upper(lower(p))
    for x in (80, 130, 180):
        pair_of.fill((x, 82), (x - 8, 98), (x + 8, 98))
    pair_of.node((80, 80), (130, 80), (180, 80)).text(190, 98, "held along n")


def bound_by_body(p):
    lower(p)
    p.fill((60, 20), (200, 20), (200, 50), (60, 50), color=RED).node((60, 50), (107, 50), (153, 50), (200, 50)).text(100, 38, "rigid body")


def oriented(p):
    lower(p, 20, 110, up=False, cells=2)
    p.arrow(120, 60, 25, 0)
    lower(p, 155, 245, cells=2)
    p.text(100, 40, "--orient auto")


def turned_away(p):
    lower(p)
    p.line((60, 25), (120, 35), color=RED).arrow(90, 30, -3, 17, RED).arrow(125, 25, 20, 0, GREY)
    p.line((160, 20), (210, 45), color=RED).arrow(185, 33, 8, -16).text(150, 65, "it has turned over")


def deep_penetration(p):
    lower(p)
    p.thin((30, 35), (230, 35)).node((130, 77)).arrow(122, 35, 0, 40, GREY).text(140, 60, "P > 0.95 gap").text(36, 32, "gap", GREY)


def energy_made(p):
    p.thin((30, 20), (30, 95), (235, 95), dashed=False).line((30, 60), (90, 60), (110, 60), (130, 40), (150, 36), (235, 36))
    p.thin((30, 60), (235, 60)).text(160, 54, "CX is not zero").text(200, 108, "time", GREY)


def first_step(p):
    upper(lower(p), y=58)
    p.thin((30, 40), (230, 40)).text(36, 37, "gap", GREY).arrow(225, 58, 0, -28, RED).arrow(205, 58, 0, -18, GREY)
    p.text(40, 102, "leaves with less than it holds")


def crossed(p):
    lower(p)
    p.node((130, 35)).arrow(130, 35, 0, 68).node((130, 105), color=GREY).text(140, 40, "one step").text(140, 104, "it would be here", GREY)


def lost_over_border(p):
    lower(p, 30, 150, cells=3)
    p.thin((150, 80), (175, 80), color=BLUE).node((120, 76), color=GREY).node((200, 76)).arrow(128, 70, 62, 0).text(150, 60, "over a free border")


DRAWINGS = [shared_nodes, degenerate_facets, duplicate_facets, normals_away, normals_alike, partly_away, mixed_orientation, one_sided,
            junctions, no_stiffness, overlap, out_of_reach, stiffness_ratio, size_ratio, gap_large, gap_small, interface_step,
            aspect_ratio, warp, bound_by_wall, same_pair, initial_penetration, clearance, blind_nodes, concave, bound_by_condition, bound_by_body,
            oriented, turned_away, deep_penetration, energy_made, first_step, crossed, lost_over_border]


def main():
    folder, check = generated.arguments(__doc__)
    faults = 0
    page = (folder / "index.md").read_text(encoding="utf-8")
    for draw in DRAWINGS:
        picture = Picture()
        draw(picture)
        code, path = "contact." + draw.__name__, folder / (draw.__name__ + ".svg")
        faults += generated.write_or_check(path, picture.svg(code), check)
        if f"### {code}\n" not in page or f"]({path.name})" not in page:
            faults += 1
            print(f"{folder / 'index.md'} has no section with a picture for {code}")
    for line in page.splitlines():
        if line.startswith("### contact.") and line[12:] not in [d.__name__ for d in DRAWINGS]:
            faults += 1
            print(f"no picture is drawn for {line[4:]}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
