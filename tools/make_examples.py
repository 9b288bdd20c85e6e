#!/usr/bin/env python3
"""Writes the decks of examples/decks (units: kg, m, s).

usage: make_examples.py DIR           write DIR/NAME/NAME_0000.rad and NAME_0001.rad for every example
       make_examples.py --check DIR   compare instead of writing; exit status 1 if a file differs

The decks are part of the repository, so that they can be read and run without this script. Standard library only.
"""
import math
import sys
from pathlib import Path

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

    def contact(self, number, title, first, second, friction, gap):
        self.add(f"/INTER/TYPE3/{number}", title, "# surf_ID1  surf_ID2" + " " * 56 + "Idel", integers(first, second) + " " * 50 + integers(0),
                 "#              Stfac                Fric                 Gap              Tstart               Tstop",
                 reals(0, friction, gap, 0, 0), "#      IBC       Irs       Irm", "       000" + integers(0, 0),
                 "#" + " " * 74 + "Ptlim", " " * 60 + reals(0))

    def history(self, number, kind, ids):
        cards = [integers(node, 0) for node in ids] if kind == "NODE" else [integers(*ids)]
        self.add(f"/TH/{kind}/{number}", kind.lower(), "DEF", *cards)

    def write(self, end, rows, frames):
        """@returns {file name: text}; `rows` history rows, `frames` animation states"""
        engine = ["#RADIOSS ENGINE", f"/RUN/{self.name}/1", f"{end:>20.12g}", "/VERS/2022", "/PRINT/-100", "/TFILE/4",
                  f"{end / rows:>20.12g}", "/ANIM/DT", reals(0, end / frames), "/ANIM/VECT/DISP", "/ANIM/VECT/VEL", "/ANIM/VECT/CONT",
                  "/ANIM/VECT/PCONT", "/ANIM/ELEM/VONM", "/DT", reals(0.9, 0)]
        return {f"{self.name}_0000.rad": "\n".join(self.lines + ["/END"]) + "\n", f"{self.name}_0001.rad": "\n".join(engine) + "\n"}


def plate_drop(name="plate_drop", table_cells=16, plate_cells=11, end=1e-3, frames=25):
    """Meshes that do not match, shells of different stiffness and thickness, friction: the everyday case of TYPE3."""
    gap = 0.002
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
                 "(0.24 m, 4 mm) that is clamped at its border. TYPE3 contact with a gap of 2 mm and friction 0.1."])
    deck.elastic(1, **STEEL)
    deck.elastic(2, **ALUMINIUM)
    deck.shell_property(1, "steel plate", 0.002, 3)
    deck.shell_property(2, "aluminium plate", 0.004, 3)
    deck.nodes(mesh)
    deck.part(1, "clamped plate", "SHELL", 2, 2, table)
    deck.part(2, "falling plate", "SHELL", 1, 1, plate)
    deck.surface_of_part(1, "clamped plate, normals up", 1)
    deck.surface_of_part(2, "falling plate, normals down", 2)
    deck.node_group(1, "clamped border", border(table_nodes))
    deck.clamp(1, "clamp", 1, rotations=True)
    deck.node_group(2, "falling plate", flat(plate_nodes))
    deck.velocity(1, "fall", (1.0, 0.0, -6.0), 2)
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


EXAMPLES = {"plate_drop": plate_drop, "block_on_block": block_on_block}


def main():
    arguments = sys.argv[1:]
    check = arguments[:1] == ["--check"]
    if len(arguments) != 1 + check:
        print(__doc__)
        return 2
    folder, different = Path(arguments[-1]), 0
    for name, make in EXAMPLES.items():
        for file, text in make().items():
            path = folder / name / file
            if check:
                same = path.is_file() and path.read_text(encoding="utf-8") == text
                different += not same
                if not same:
                    print(f"{path} is not what tools/make_examples.py writes")
            else:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
                print(path)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
