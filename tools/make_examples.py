#!/usr/bin/env python3
"""Writes the decks of examples/decks (units: kg, m, s).

usage: make_examples.py DIR           write DIR/NAME/NAME_0000.rad and NAME_0001.rad for every example
       make_examples.py --check DIR   compare instead of writing; exit status 1 if a file differs

The decks are part of the repository, so that they can be read and run without this script. Standard library only.
"""
import math
import sys

import generated

STEEL = dict(title="steel", density=7800.0, young=210e9, poisson=0.3)
ALUMINIUM = dict(title="aluminium", density=2700.0, young=70e9, poisson=0.33)
RULER = "#---1----|----2----|----3----|----4----|----5----|----6----|----7----|----8----|----9----|---10----|"


def integers(*values):
    return "".join(f"{value:>10}" for value in values)


def reals(*values):
    return "".join(f"{value:>20.12g}" for value in values)


class Mesh:
    """Nodes and elements with ids that count from 1."""

    def __init__(self):
        self.nodes, self.elements = [], 0

    def node(self, x, y, z):
        self.nodes.append((x, y, z))
        return len(self.nodes)

    def element(self, nodes):
        self.elements += 1
        return (self.elements, nodes)

    def plate(self, place, n, m, facing_down=False):
        """n by m shells over the unit square that `place` maps into space. @returns elements, node ids [i][j]"""
        ids = [[self.node(*place(i / n, j / m)) for j in range(m + 1)] for i in range(n + 1)]
        elements = []
        for i in range(n):
            for j in range(m):
                corners = [ids[i][j], ids[i + 1][j], ids[i + 1][j + 1], ids[i][j + 1]]
                elements.append(self.element(corners[::-1] if facing_down else corners))
        return elements, ids

    def block(self, corner, size, count):
        """Bricks in a box. @returns elements, node ids [k][i][j], k counting upwards"""
        at = [lambda c, axis=axis: corner[axis] + size[axis] * c / count[axis] for axis in range(3)]
        ids = [[[self.node(at[0](i), at[1](j), at[2](k)) for j in range(count[1] + 1)] for i in range(count[0] + 1)]
               for k in range(count[2] + 1)]
        elements = []
        for k in range(count[2]):
            for i in range(count[0]):
                for j in range(count[1]):
                    corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    elements.append(self.element([ids[k + up][a][b] for up in (0, 1) for a, b in corners]))
        return elements, ids


def flat(grid):
    return [node for row in grid for node in row]


def border(grid):
    last, end = len(grid) - 1, len(grid[0]) - 1
    return sorted(grid[i][j] for i in range(last + 1) for j in range(end + 1) if i in (0, last) or j in (0, end))


def quads(grid, facing_down=False):
    """Faces between the nodes of a grid; the normal is that of i to j unless it faces down."""
    faces = []
    for i in range(len(grid) - 1):
        for j in range(len(grid[0]) - 1):
            face = (grid[i][j], grid[i + 1][j], grid[i + 1][j + 1], grid[i][j + 1])
            faces.append(face[::-1] if facing_down else face)
    return faces


class Deck:
    def __init__(self, name, title, story):
        self.name = name
        self.lines = ["#RADIOSS STARTER", *(f"# {line}" for line in story), RULER, "/BEGIN", name, integers(2022, 0),
                      *[f"{'kg':>20}{'m':>20}{'s':>20}"] * 2, "/TITLE", title]

    def add(self, keyword, *cards):
        self.lines += [keyword, *cards]

    def elastic(self, number, title, density, young, poisson):
        self.add(f"/MAT/ELAST/{number}", title, "#                RHO", reals(density),
                 "#                  E                  Nu", reals(young, poisson))

    def shell_property(self, number, title, thickness, points):
        self.add(f"/PROP/SHELL/{number}", title, "#   Ishell    Ismstr     Ish3n    Idrill", integers(1, 2, 2, 0),
                 "#                 hm                  hf                  hr                  dm                  dn", reals(0, 0, 0, 0, 0),
                 "#        N   Istrain               Thick              Ashear              Ithick     Iplas",
                 integers(points, 0) + reals(thickness, 0) + " " * 10 + integers(2, 2))

    def solid_property(self, number, title):
        self.add(f"/PROP/SOLID/{number}", title, "#   Isolid    Ismstr               Icpre  Itetra10     Inpts   Itetra4    Iframe",
                 integers(1, 4, "", 0, 0, 0, 0, 1), "#                 qa                  qb                   h", reals(0, 0, 0), reals(0))

    def nodes(self, mesh):
        self.add("/NODE", *(f"{number:>10}{reals(*place)}" for number, place in enumerate(mesh.nodes, 1)))

    def part(self, number, title, family, prop, material, elements):
        self.add(f"/PART/{number}", title, "#  prop_ID    mat_ID subset_ID", integers(prop, material, 0))
        self.add(f"/{family}/{number}", *(integers(element, *nodes) for element, nodes in elements))

    def node_group(self, number, title, nodes):
        self.add(f"/GRNOD/NODE/{number}", title, *(integers(*nodes[k:k + 10]) for k in range(0, len(nodes), 10)))

    def surface_of_part(self, number, title, part):
        self.add(f"/SURF/PART/{number}", title, integers(part))

    def surface_of_faces(self, number, title, faces):
        self.add(f"/SURF/SEG/{number}", title, "#   seg_ID        n1        n2        n3        n4",
                 *(integers(k, *face) for k, face in enumerate(faces, 1)))

    def clamp(self, number, title, group, rotations):
        self.add(f"/BCS/{number}", title, "#  Tra rot   skew_ID  grnod_ID", f"   111 {'111' if rotations else '000'}" + integers(0, group))

    def velocity(self, number, title, vector, group):
        self.add(f"/INIVEL/TRA/{number}", title, "#                 Vx                  Vy                  Vz  grnod_ID", reals(*vector) + integers(group))

    def contact(self, number, title, first, second, friction, gap, stiffness=0):
        self.add(f"/INTER/TYPE3/{number}", title, "# surf_ID1  surf_ID2" + " " * 56 + "Idel", integers(first, second) + " " * 50 + integers(0),
                 "#              Stfac                Fric                 Gap              Tstart               Tstop",
                 reals(stiffness, friction, gap, 0, 0), "#      IBC       Irs       Irm", "       000" + integers(0, 0),
                 "#" + " " * 74 + "Ptlim", " " * 60 + reals(0))

    def contact_both_sides(self, number, title, nodes, surface, friction, gap):
        """TYPE7: a group of nodes against both sides of a surface."""
        self.add(f"/INTER/TYPE7/{number}", title,
                 "#  Slav_id   Mast_id      Istf      Ithe      Igap                Ibag      Idel     Icurv      Iadm",
                 integers(nodes, surface, 4, 0, 0) + " " * 10 + integers(0, 0, 0, 0),
                 "#          Fscalegap             GAP_MAX             Fpenmax                               Itied",
                 reals(0, 0, 0) + " " * 20 + integers(0),
                 "#              Stmin               Stmax          %mesh_size               dtmin  Irem_gap", reals(0, 0, 0, 0) + integers(0),
                 "#              Stfac                Fric              Gapmin              Tstart               Tstop", reals(1, friction, gap, 0, 0),
                 "#      IBC                        Inacti                VisS                VisF              Bumult",
                 "       000" + " " * 20 + integers(0) + reals(0, 0, 0),
                 "#    Ifric    Ifiltr               Xfreq     Iform   sens_ID", integers(0, 0) + reals(0) + integers(2, 0))

    def history(self, number, kind, ids):
        cards = [integers(node, 0) for node in ids] if kind == "NODE" else [integers(*ids)]
        self.add(f"/TH/{kind}/{number}", kind.lower(), "DEF", *cards)

    def write(self, end, rows, frames):
        """@returns {file name: text}; `rows` history rows, `frames` animation states"""
        engine = ["#RADIOSS ENGINE", f"/RUN/{self.name}/1", f"{end:>20.12g}", "/VERS/2022", "/PRINT/-100", "/TFILE/4",
                  f"{end / rows:>20.12g}", "/ANIM/DT", reals(0, end / frames), "/ANIM/VECT/DISP", "/ANIM/VECT/VEL", "/ANIM/VECT/CONT",
                  "/ANIM/VECT/PCONT", "/ANIM/ELEM/VONM", "/DT", reals(0.9, 0)]
        return {f"{self.name}_0000.rad": "\n".join(self.lines + ["/END"]) + "\n", f"{self.name}_0001.rad": "\n".join(engine) + "\n"}


def steel_over_aluminium(deck, mesh, table, plate):
    """Materials, properties, nodes and parts of a plate that falls on a clamped one."""
    deck.elastic(1, **STEEL)
    deck.elastic(2, **ALUMINIUM)
    deck.shell_property(1, "steel plate", 0.002, 3)
    deck.shell_property(2, "aluminium plate", 0.004, 3)
    deck.nodes(mesh)
    deck.part(1, "clamped plate", "SHELL", 2, 2, table)
    deck.part(2, "falling plate", "SHELL", 1, 1, plate)


def clamp_and_drop(deck, table_nodes, plate_nodes):
    """The lower plate's border is held; the upper one falls with 6 m/s, and 1 m/s sideways."""
    deck.node_group(1, "clamped border", border(table_nodes))
    deck.clamp(1, "clamp", 1, rotations=True)
    deck.node_group(2, "falling plate", flat(plate_nodes))
    deck.velocity(1, "fall", (1.0, 0.0, -6.0), 2)


def plate_drop(name="plate_drop", table_cells=16, plate_cells=11, end=1e-3, frames=25, gap=0.002):
    """Meshes that do not match, shells of different stiffness and thickness, friction: the everyday case of TYPE3."""
    mesh = Mesh()
    side = 0.24
    table, table_nodes = mesh.plate(lambda u, w: (side * (u - 0.5), side * (w - 0.5), 0.0), table_cells, table_cells)
    cosine, sine, edge = math.cos(math.radians(20)), math.sin(math.radians(20)), 0.12

    def turned(u, w):
        x, y = edge * (u - 0.5), edge * (w - 0.5)
        return cosine * x - sine * y, sine * x + cosine * y, 1.05 * gap

    plate, plate_nodes = mesh.plate(turned, plate_cells, plate_cells, facing_down=True)

    deck = Deck(name, "steel plate dropped on a clamped aluminium plate",
                ["A steel plate (0.12 m, 2 mm, turned by 20 degrees) falls with 6 m/s, and 1 m/s sideways, on an aluminium plate",
                 f"(0.24 m, 4 mm) that is clamped at its border. TYPE3 contact with a gap of {1e3 * gap:g} mm and friction 0.1."])
    steel_over_aluminium(deck, mesh, table, plate)
    deck.surface_of_part(1, "clamped plate, normals up", 1)
    deck.surface_of_part(2, "falling plate, normals down", 2)
    clamp_and_drop(deck, table_nodes, plate_nodes)
    deck.contact(1, "plate on plate", 1, 2, friction=0.1, gap=gap)
    deck.history(1, "PART", [1, 2])
    deck.history(2, "INTER", [1])
    deck.history(3, "NODE", [table_nodes[table_cells // 2][table_cells // 2], plate_nodes[plate_cells // 2][plate_cells // 2]])
    return deck.write(end=end, rows=200, frames=frames)


def block_on_block():
    """Bricks: pressed with 20 kN, a block of 86.4 g that slides with 20 m/s is stopped by friction within about 0.3 ms."""
    gap, load, size = 1e-4, 20e3, (0.04, 0.04, 0.02)
    mesh = Mesh()
    base, base_nodes = mesh.block((-0.03, -0.03, -0.02), (0.1, 0.06, 0.02), (20, 12, 2))
    slider, slider_nodes = mesh.block((0.0, -0.0205, 1.02 * gap), size, (7, 7, 3))

    deck = Deck("block_on_block", "aluminium block that slides on a steel block and is stopped by friction",
                ["An aluminium block (40 x 40 x 20 mm, 86.4 g) is pressed on a fixed steel block with 20 kN and starts with 20 m/s",
                 "sideways. TYPE3 contact between brick faces, gap 0.1 mm, friction 0.3."])
    deck.elastic(1, **STEEL)
    deck.elastic(2, **ALUMINIUM)
    deck.solid_property(1, "base")
    deck.solid_property(2, "slider")
    deck.nodes(mesh)
    deck.part(1, "base", "BRICK", 1, 1, base)
    deck.part(2, "slider", "BRICK", 2, 2, slider)
    deck.surface_of_faces(1, "top of the base", quads(base_nodes[-1]))
    deck.surface_of_faces(2, "bottom of the slider", quads(slider_nodes[0], facing_down=True))
    deck.node_group(1, "bottom of the base", flat(base_nodes[0]))
    deck.clamp(1, "fixed", 1, rotations=False)
    deck.node_group(2, "slider", [node for layer in slider_nodes for node in flat(layer)])
    deck.velocity(1, "slide", (20.0, 0.0, 0.0), 2)
    top = flat(slider_nodes[-1])
    deck.node_group(3, "top of the slider", top)
    deck.add("/FUNCT/1", "ramp", *(reals(*point) for point in ((0, 0), (1e-4, 1), (1, 1))))
    deck.add("/CLOAD/1", "press", "# funct_ID       Dir   skew_ID sensor_ID  grnod_ID                       Ascale_x            Fscale_y",
             integers(1, "Z", 0, 0, 3) + " " * 10 + reals(1, -load / len(top)))
    deck.contact(1, "slider on base", 1, 2, friction=0.3, gap=gap)
    deck.history(1, "PART", [1, 2])
    deck.history(2, "INTER", [1])
    deck.history(3, "NODE", [slider_nodes[0][3][3], slider_nodes[-1][3][3]])
    return deck.write(end=6e-4, rows=200, frames=25)


def slope():
    """A block slides down a slope of 30 degrees under its weight: a = g (sin 30 - mu cos 30). Gravity is switched on within 1 ms."""
    cosine, sine = math.cos(math.radians(30)), math.sin(math.radians(30))
    gap = 1e-4
    mesh = Mesh()
    ramp, ramp_nodes = mesh.block((-0.02, -0.03, -0.01), (0.12, 0.06, 0.01), (12, 6, 1))
    block, block_nodes = mesh.block((0.0, -0.0205, 1.00001 * gap), (0.04, 0.04, 0.02), (4, 4, 2))
    mesh.nodes = [(cosine * x + sine * z, y, cosine * z - sine * x) for x, y, z in mesh.nodes]

    deck = Deck("slope", "block on a slope",
                ["A steel block (40 x 40 x 20 mm) lies on a slope of 30 degrees and slides down under its weight, friction 0.3.",
                 "Gravity comes within 1 ms. Closed form from then on: speed = g (sin 30 - 0.3 cos 30) (t - 0.5 ms)."])
    deck.elastic(1, **STEEL)
    deck.solid_property(1, "bricks")
    deck.nodes(mesh)
    deck.part(1, "slope", "BRICK", 1, 1, ramp)
    deck.part(2, "block", "BRICK", 1, 1, block)
    deck.surface_of_faces(1, "top of the slope", quads(ramp_nodes[-1]))
    deck.surface_of_faces(2, "bottom of the block", quads(block_nodes[0], facing_down=True))
    deck.node_group(1, "bottom of the slope", flat(ramp_nodes[0]))
    deck.clamp(1, "fixed", 1, rotations=False)
    deck.node_group(2, "block", [node for layer in block_nodes for node in flat(layer)])
    deck.add("/FUNCT/1", "switched on in 1 ms", *(reals(*point) for point in ((0, 0), (1e-3, 1), (1, 1))))
    deck.add("/GRAV/1", "weight", "#  funct_ID       DIR   skew_ID sensor_ID  grnd_ID                       Ascale_x            Fscale_Y",
             integers(1, "Z", 0, 0, 2) + " " * 10 + reals(1, -9.81))
    deck.contact(1, "block on slope", 1, 2, friction=0.3, gap=gap)
    deck.history(1, "PART", [2])
    deck.history(2, "INTER", [1])
    deck.history(3, "NODE", [block_nodes[1][2][2]])
    return deck.write(end=1e-2, rows=200, frames=20)


def press_fit():
    """A hollow pin, 0.03 mm too thick, is pushed into a ring: a quarter of both, with planes of symmetry."""
    over, bore, turn = 3e-5, 0.010, 6
    mesh = Mesh()

    def quarter(radii, heights):
        """Bricks of a quarter tube; `radii(k)` of layer k of the nodes, inner first. @returns elements, ids [k][i][j]: height, radius, angle"""
        ids = [[[mesh.node(radius * math.cos(0.5 * math.pi * j / turn), radius * math.sin(0.5 * math.pi * j / turn), height)
                 for j in range(turn + 1)] for radius in radii(k)] for k, height in enumerate(heights)]
        elements = []
        for k in range(len(ids) - 1):
            for i in range(len(ids[0]) - 1):
                for j in range(turn):
                    corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    elements.append(mesh.element([ids[k + up][a][b] for up in (0, 1) for a, b in corners]))
        return elements, ids

    def side(ids, radius):
        """Faces of a cylindrical side; they look outwards."""
        layer = [row[radius] for row in ids]
        return [(layer[k][j], layer[k][j + 1], layer[k + 1][j + 1], layer[k + 1][j]) for k in range(len(layer) - 1) for j in range(turn)]

    ring, ring_nodes = quarter(lambda k: (bore, 0.013, 0.016, 0.020), [0.0025 * k for k in range(5)])
    outer = bore + over
    chamfer = {0: 1.5e-4}
    pin, pin_nodes = quarter(lambda k: (0.006, 0.008, outer - chamfer.get(k, 0.0)), [0.0102 + 0.0025 * k for k in range(7)])

    deck = Deck("press_fit", "pin pushed into a ring",
                ["A hollow steel pin (12 to 20 mm) is pushed into a steel ring (20 to 40 mm) by 12.7 mm; radial interference 0.03 mm.",
                 "A quarter with planes of symmetry; TYPE3 contact without a gap, Stfac 0.8, friction 0.1."])
    deck.elastic(1, **STEEL)
    deck.solid_property(1, "bricks")
    deck.nodes(mesh)
    deck.part(1, "ring", "BRICK", 1, 1, ring)
    deck.part(2, "pin", "BRICK", 1, 1, pin)
    deck.surface_of_faces(1, "bore of the ring", [face[::-1] for face in side(ring_nodes, 0)])
    deck.surface_of_faces(2, "outside of the pin", side(pin_nodes, 2))
    every = [ids for ids in (ring_nodes, pin_nodes)]
    deck.node_group(1, "plane y = 0", [row[i][0] for ids in every for row in ids for i in range(len(row))])
    deck.node_group(2, "plane x = 0", [row[i][turn] for ids in every for row in ids for i in range(len(row))])
    deck.node_group(3, "bottom of the ring", flat(ring_nodes[0]))
    deck.node_group(4, "top of the pin", flat(pin_nodes[-1]))
    for number, (title, directions) in enumerate((("symmetry", "010"), ("symmetry", "100"), ("support", "001")), 1):
        deck.add(f"/BCS/{number}", title, "#  Tra rot   skew_ID  grnod_ID", f"   {directions} 000" + integers(0, number))
    push, pushed = 5.0, 2.54e-3
    deck.add("/FUNCT/1", "speed of the press", *(reals(*point) for point in ((0, 0), (2e-4, 1), (pushed, 1), (pushed + 2e-4, 0), (1, 0))))
    deck.add("/IMPVEL/1", "press", "#funct_IDT       Dir   skew_ID sensor_ID  grnod_ID  frame_ID     Icoor",
             integers(1, "Z", 0, 0, 4, 0, 0), "#           Ascale_x            Fscale_Y              Tstart               Tstop",
             reals(1, -push, 0, 1e30))
    deck.contact(1, "pin in ring", 1, 2, friction=0.1, gap=0, stiffness=0.8)
    deck.history(1, "PART", [1, 2])
    deck.history(2, "INTER", [1])
    deck.history(3, "NODE", [ring_nodes[2][0][3], pin_nodes[3][2][3]])
    return deck.write(end=3.4e-3, rows=340, frames=34)


def dropped(name, title, story, add_contact):
    """Two plates of shells; the falling one looks the wrong way, which TYPE7 does not mind."""
    mesh = Mesh()
    side, edge, gap = 0.16, 0.08, 0.002
    table, table_nodes = mesh.plate(lambda u, w: (side * (u - 0.5), side * (w - 0.5), 0.0), 8, 8)
    plate, plate_nodes = mesh.plate(lambda u, w: (edge * (u - 0.45), edge * (w - 0.55), 1.05 * gap), 5, 5)
    deck = Deck(name, title, story)
    steel_over_aluminium(deck, mesh, table, plate)
    deck.surface_of_part(1, "clamped plate", 1)
    deck.surface_of_part(2, "falling plate", 2)
    clamp_and_drop(deck, table_nodes, plate_nodes)
    add_contact(deck, gap)
    deck.history(1, "PART", [1, 2])
    deck.history(2, "INTER", [1])
    return deck.write(end=1e-3, rows=100, frames=20)


def drop_type7():
    return dropped("drop_type7", "falling plate, TYPE7", ["A steel plate falls on a clamped aluminium plate; contact by TYPE7: nodes of the falling",
                                                          "plate against both sides of the clamped one. The starting point of the tutorial on converting."],
                   lambda deck, gap: deck.contact_both_sides(1, "plate on plate", 2, 1, friction=0.1, gap=gap))


def drop_type3():
    return dropped("drop_type3", "falling plate, TYPE3", ["drop_type7 with its contact card exchanged for TYPE3, and nothing else: the falling plate's normals",
                                                          "point away, which abut refuses. The tutorial on converting goes on from here."],
                   lambda deck, gap: deck.contact(1, "plate on plate", 1, 2, friction=0.1, gap=gap))


EXAMPLES = {"plate_drop": plate_drop, "block_on_block": block_on_block, "slope": slope, "press_fit": press_fit, "drop_type7": drop_type7,
            "drop_type3": drop_type3}


def main():
    folder, check = generated.arguments(__doc__)
    different = sum(generated.write_or_check(folder / name / file, text, check)
                    for name, make in EXAMPLES.items() for file, text in make().items())
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
