"""Models from arrays: cards are collected and read by the same reader as a deck, with the same checks and messages."""
from __future__ import annotations

import functools
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import cards
from .cards import integers, real, reals

if TYPE_CHECKING:
    from . import Diagnostic, InputError, Model

    def refuse(findings: Sequence[Diagnostic], wrong: Sequence[int]) -> NoReturn: ...
else:
    from ._native import InputError, Model
    from ._native import _refuse as refuse

_FAMILIES = {"shells": ("SHELL", 4), "triangles": ("SH3N", 3), "bricks": ("BRICK", 8), "tetras": ("TETRA4", 4)}
_HISTORY = {"nodes": "NODE", "parts": "PART", "shells": "SHEL", "triangles": "SH3N", "bricks": "BRIC", "interfaces": "INTER",
            "rigid_walls": "RWALL", "rigid_bodies": "RBODY"}
# What a list may hold that does not exist, and lists that hold nothing.
_MISSING = ("model.unknown_member", "model.empty_group", "model.empty_surface", "model.missing_output")

_Method = TypeVar("_Method", bound=Callable[..., Any])


def _whole(method: _Method) -> _Method:
    """A call that is refused leaves nothing behind: no card, no number that is taken."""

    @functools.wraps(method)
    def called(self: ModelBuilder, *arguments: Any, **named: Any) -> Any:
        lines, last = len(self._lines), dict(self._last)
        try:
            return method(self, *arguments, **named)
        except BaseException:
            del self._lines[lines:]
            self._last = last
            raise

    return cast(_Method, called)


class ModelBuilder:
    """Collects a model from arrays and keyword arguments; build() reads it like a deck.

        b = abut.ModelBuilder("drop", units=("kg", "m", "s"))
        ids = b.nodes(xyz)                                   # (N,) ids; ids[connectivity] turns indices into ids
        steel = b.elastic(density=7800, young=210e9, poisson=0.3)
        plate = b.part(b.shell_property(0.002), steel, shells=ids[quads])
        b.velocity(ids, (0, 0, -6))
        b.engine(1e-3, history_interval=5e-6)
        model = b.build()

    Objects are named by the ids that their methods return, numbered from 1 unless an id is given; nodes and elements are given as ids.
    Values are in the units of the model. Arguments that make no card raise ValueError or TypeError at once, and leave the model as it
    was; so does a scale of 0, which a card would take for 1. What only the whole model can tell (ids that do not exist, a negative
    density, ...) is InputError of build(), all faults in one go.
    """

    def __init__(self, name: str = "model", *, title: str = "", units: Sequence[str] = ("kg", "m", "s")) -> None:
        """name: no blank or slash; units: names of mass, length and time as in /BEGIN, e.g. ("kg", "mm", "ms")."""
        if not name or any(character in name for character in " /\t\n"):
            raise ValueError(f"name {name!r} must not be empty nor hold blanks or slashes")
        if isinstance(units, str) or len(units) != 3:
            raise ValueError(f"units is {units!r}, expected three names: those of mass, length and time")
        self.name = name
        line = "".join(f"{cards.checked_text(unit, 'a unit'):>20}" for unit in units)
        self._lines = ["#RADIOSS STARTER", "/BEGIN", cards.checked_text(name, "name"), integers(2022, 0), line, line]
        if title:
            self._lines += ["/TITLE", cards.checked_text(title, "title")]
        self._engine: list[str] = []
        self._last: dict[str, int] = {}
        self._typed: set[int] = set()  # lines of starter_text() that card() brought

    # ---- mesh ----

    @_whole
    def nodes(self, coordinates: ArrayLike, *, ids: ArrayLike | None = None) -> NDArray[np.int64]:
        """Adds nodes. coordinates: (N, 3) lengths. ids: (N,), None: goes on counting. Returns the ids (N,)."""
        xyz = cards.vectors(coordinates, "coordinates")
        numbers = self._numbers("nodes", len(xyz), ids, "ids")
        self._add("/NODE", *(integers(number) + reals(*row) for number, row in zip(numbers.tolist(), xyz.tolist())))
        return numbers

    @_whole
    def part(self, prop: int, material: int, *, shells: ArrayLike | None = None, triangles: ArrayLike | None = None,
             bricks: ArrayLike | None = None, tetras: ArrayLike | None = None, id: int | None = None, title: str = "part") -> int:
        """Adds a part with elements of one or more kinds, as node ids. Returns the part's id.

        shells: (E, 4), triangles: (E, 3), tetras: (E, 4); bricks: (E, 8), bottom face then top face. A degenerate brick repeats nodes.
        Elements are numbered on over all parts.
        """
        cards.check_ids(prop=prop, material=material)
        number = self._titled("PART", "PART", id, title, integers(prop, material, 0))
        given = {"shells": shells, "triangles": triangles, "bricks": bricks, "tetras": tetras}
        for family, connectivity in given.items():
            if connectivity is None:
                continue
            word, corners = _FAMILIES[family]
            elements = cards.id_array(connectivity, family, (corners,))
            numbers = self._numbers("elements", len(elements), None, "ids")
            self._add(f"/{word}/{number}", *(integers(e, *row) for e, row in zip(numbers.tolist(), elements.tolist())))
        return number

    # ---- materials and properties ----

    def elastic(self, *, density: float, young: float, poisson: float, id: int | None = None, title: str = "elastic") -> int:
        """Linear elastic material (LAW1). density: mass/volume, young: pressure. Returns its id."""
        cards.check_finite(density=density, young=young, poisson=poisson)
        return self._titled("MAT/ELAST", "MAT", id, title, reals(density), reals(young, poisson))

    def johnson_cook(self, *, density: float, young: float, poisson: float, yield_stress: float, hardening: float = 0.0,
                     exponent: float = 1.0, failure_strain: float = 0.0, largest_stress: float = 0.0, rate_coefficient: float = 0.0,
                     reference_rate: float = 0.0, id: int | None = None, title: str = "elastic-plastic") -> int:
        """Elastic-plastic material (LAW2): (a + b e^n)(1 + c ln(e'/e0')) with a, b, n, c in the order of the arguments; 0: none, but of n.

        failure_strain: plastic strain at which an element is deleted, largest_stress: cap of the yield stress; 0: none. Returns its id.
        """
        cards.check_finite(density=density, young=young, poisson=poisson, yield_stress=yield_stress, hardening=hardening,
                           failure_strain=failure_strain, largest_stress=largest_stress, rate_coefficient=rate_coefficient,
                           reference_rate=reference_rate)
        return self._titled("MAT/PLAS_JOHNS", "MAT", id, title, reals(density), reals(young, poisson) + integers(0, 0) + real(0),
                            reals(yield_stress, hardening, cards.nonzero(exponent, "exponent"), failure_strain, largest_stress),
                            reals(rate_coefficient, reference_rate), reals(0, 0, 0, 0, 0))

    def shell_property(self, thickness: float, *, points: int = 3, ishell: int = 1, ismstr: int = 2, ish3n: int = 2,
                       hourglass: Sequence[float] = (0.0, 0.0, 0.0), thickness_changes: bool = False, id: int | None = None,
                       title: str = "shell") -> int:
        """Property of shells and triangles (TYPE1). thickness: length; points: through the thickness, 0 global; 0 of `hourglass`
        (membrane, bending, rotation): the default. Returns its id."""
        if len(hourglass) != 3:
            raise ValueError("hourglass: expected three coefficients (membrane, bending, rotation)")
        cards.check_integers(points=points, ishell=ishell, ismstr=ismstr, ish3n=ish3n)
        cards.check_finite(thickness=thickness, **{f"hourglass[{k}]": value for k, value in enumerate(hourglass)})
        return self._titled("PROP/SHELL", "PROP", id, title, integers(ishell, ismstr, ish3n, 0), reals(*hourglass, 0, 0),
                            integers(points, 0) + reals(thickness, 0) + " " * 10 + integers(1 if thickness_changes else 2, 2))

    def solid_property(self, *, isolid: int = 1, ismstr: int = 4, qa: float = 0.0, qb: float = 0.0, hourglass: float = 0.0,
                       id: int | None = None, title: str = "solid") -> int:
        """Property of bricks and tetrahedra (TYPE14). qa, qb: bulk viscosity, hourglass: coefficient; 0: the default. Returns its id."""
        cards.check_integers(isolid=isolid, ismstr=ismstr)
        cards.check_finite(qa=qa, qb=qb, hourglass=hourglass)
        return self._titled("PROP/SOLID", "PROP", id, title, integers(isolid, ismstr, "", 0, 0, 0, 0, 1), reals(qa, qb, hourglass), reals(0))

    # ---- sets ----

    def group(self, nodes: ArrayLike, *, id: int | None = None, title: str = "nodes") -> int:
        """Node group of ids (K,). Other methods make their own from the ids that they are given. Returns its id."""
        return self._titled("GRNOD/NODE", "GRNOD", id, title, *cards.in_rows(cards.id_array(nodes, "nodes").tolist()))

    def surface(self, facets: ArrayLike | None = None, *, parts: Sequence[int] | None = None, id: int | None = None,
                title: str = "surface") -> int:
        """Contact surface from facets (F, 3) or (F, 4) of node ids, or from parts: their shells, and the outer faces of their solids.

        The right-hand rule over a facet's nodes gives its positive side. Returns its id.
        """
        if (facets is None) == (parts is None):
            raise ValueError("give either facets or parts")
        if parts is not None:
            return self._titled("SURF/PART/EXT", "SURF", id, title, *cards.in_rows(cards.id_array(parts, "parts").tolist()))
        assert facets is not None
        rows = cards.id_array(facets, "facets", (3, 4))
        return self._titled("SURF/SEG", "SURF", id, title, *(integers(k, *row) for k, row in enumerate(rows.tolist(), 1)))

    def function(self, x: ArrayLike, y: ArrayLike, *, id: int | None = None, title: str = "function") -> int:
        """Piecewise linear function through points x (K,), ascending, and y (K,). Returns its id."""
        xs, ys = cards.real_array(x, "x"), cards.real_array(y, "y")
        if xs.ndim != 1 or xs.shape != ys.shape:
            raise ValueError(f"x and y have shapes {xs.shape} and {ys.shape}, expected (K,) both")
        bad = np.flatnonzero(~(np.isfinite(xs) & np.isfinite(ys)))
        if bad.size > 0:
            raise ValueError(f"x and y: point {bad[0]} is not finite")
        return self._titled("FUNCT", "FUNCT", id, title, *(reals(*point) for point in zip(xs.tolist(), ys.tolist())))

    # ---- interfaces ----

    def contact(self, first: int, second: int, *, gap: float = 0.0, friction: float = 0.0, stiffness_scale: float = 0.2,
                birth: float = 0.0, death: float = 0.0, id: int | None = None, title: str = "contact") -> int:
        """Two surfaces, neither main (TYPE3). first, second: surface ids; gap: length; death 0: never. Returns its id."""
        cards.check_ids(first=first, second=second)
        cards.check_finite(gap=gap, friction=friction, birth=birth, death=death)
        scale = cards.nonzero(stiffness_scale, "stiffness_scale")
        return self._titled("INTER/TYPE3", "INTER", id, title, integers(first, second) + " " * 50 + integers(0),
                            reals(scale, friction, gap, birth, death), "       000" + integers(0, 0), " " * 60 + real(0))

    @_whole
    def contact_nodes(self, nodes: ArrayLike, surface: int, *, gap: float = 0.0, friction: float = 0.0, stiffness_scale: float = 0.2,
                      birth: float = 0.0, death: float = 0.0, id: int | None = None, title: str = "contact of nodes") -> int:
        """Nodes (ids) against a surface, one pass (TYPE5). Returns its id."""
        cards.check_ids(surface=surface)
        cards.check_finite(gap=gap, friction=friction, birth=birth, death=death)
        scale = cards.nonzero(stiffness_scale, "stiffness_scale")
        group = self.group(nodes, title=title)
        return self._titled("INTER/TYPE5", "INTER", id, title, integers(group, surface) + " " * 50 + integers(0),
                            reals(scale, friction, gap, birth, death), "       000" + integers(0, 0, 0), integers(0, 0) + real(0))

    @_whole
    def contact_both_sides(self, surface: int, *, gap: float, nodes: ArrayLike | None = None, friction: float = 0.0,
                           birth: float = 0.0, death: float = 0.0, id: int | None = None, title: str = "contact on both sides") -> int:
        """Nodes (ids; None: the surface's own, self contact) near both sides of a surface (TYPE7). Returns its id.

        gap: length, 0: made from the thicknesses there."""
        cards.check_ids(surface=surface)
        cards.check_finite(gap=gap, friction=friction, birth=birth, death=death)
        group = 0 if nodes is None else self.group(nodes, title=title)
        return self._titled("INTER/TYPE7", "INTER", id, title, integers(group, surface, 0, 0, 0), reals(0, 0, 0), reals(0, 0, 0, 0),
                            reals(0, friction, gap, birth, death), "       000" + integers(0, 0, 0) + reals(0, 0),
                            integers(0, 0) + real(0) + integers(2))

    # ---- conditions ----

    @_whole
    def fix(self, nodes: ArrayLike, *, translation: str = "xyz", rotation: str = "xyz", id: int | None = None,
            title: str = "fixed") -> int:
        """Nodes (ids) that do not move along, or turn about, the global axes named. Returns the condition's id."""
        group = self.group(nodes, title=title)
        flags = f"   {cards.axes(translation, 'translation')} {cards.axes(rotation, 'rotation')}"
        return self._titled("BCS", "BCS", id, title, flags + integers(0, group))

    @_whole
    def velocity(self, nodes: ArrayLike, value: ArrayLike, *, id: int | None = None, title: str = "initial velocity") -> int:
        """Initial velocity (3,) of nodes (ids). Where two touch one node the last counts. Returns its id."""
        group = self.group(nodes, title=title)
        return self._titled("INIVEL/TRA", "INIVEL", id, title, reals(*cards.vector(value, "value")) + integers(group))

    def imposed_velocity(self, nodes: ArrayLike, direction: str, function: int, *, scale: float = 1.0, birth: float = 0.0,
                         death: float = 0.0, id: int | None = None, title: str = "imposed velocity") -> int:
        """scale * function(time) along X, Y, Z or about XX, YY, ZZ. Returns its id."""
        return self._motion("IMPVEL", nodes, direction, function, scale, birth, death, id, title)

    def imposed_displacement(self, nodes: ArrayLike, direction: str, function: int, *, scale: float = 1.0, birth: float = 0.0,
                             death: float = 0.0, id: int | None = None, title: str = "imposed displacement") -> int:
        """scale * function(time) along X, Y, Z or about XX, YY, ZZ. Returns its id."""
        return self._motion("IMPDISP", nodes, direction, function, scale, birth, death, id, title)

    @_whole
    def load(self, nodes: ArrayLike, direction: str, function: int, *, scale: float = 1.0, id: int | None = None,
             title: str = "load") -> int:
        """Force scale * function(time) on each of the nodes (ids) along X, Y, Z (moment about XX, YY, ZZ). Returns its id."""
        cards.check_integers(function=function)
        group = self.group(nodes, title=title)
        return self._titled("CLOAD", "CLOAD", id, title, integers(function, cards.direction(direction), 0, 0, group) + " " * 10 +
                            reals(1, cards.nonzero(scale, "scale")))

    def pressure(self, surface: int, function: int, *, scale: float = 1.0, id: int | None = None, title: str = "pressure") -> int:
        """Pressure scale * function(time) along the normals of a surface (right-hand rule over its facets). Returns its id."""
        cards.check_ids(surface=surface)
        cards.check_integers(function=function)
        return self._titled("PLOAD", "PLOAD", id, title, integers(surface, function, 0, 0, "", 0) + reals(1, cards.nonzero(scale, "scale")))

    @_whole
    def gravity(self, direction: str, function: int, *, scale: float = 1.0, nodes: ArrayLike | None = None, id: int | None = None,
                title: str = "gravity") -> int:
        """Acceleration scale * function(time) along X, Y or Z of all nodes, or of those given (ids). Returns its id."""
        cards.check_integers(function=function)
        group = 0 if nodes is None else self.group(nodes, title=title)
        return self._titled("GRAV", "GRAV", id, title, integers(function, cards.direction(direction, rotations=False), 0, 0, group) + " " * 10 +
                            reals(1, cards.nonzero(scale, "scale")))

    @_whole
    def rigid_wall(self, point: ArrayLike, normal: ArrayLike, *, nodes: ArrayLike, friction: float = 0.0, id: int | None = None,
                   title: str = "rigid wall") -> int:
        """Fixed plane through a point (3,) with its normal (3,) towards the nodes (ids) that it stops. Returns its id."""
        at, towards = cards.vector(point, "point"), cards.vector(normal, "normal")
        cards.check_finite(friction=friction)
        group = self.group(nodes, title=title)
        return self._titled("RWALL/PLANE", "RWALL", id, title, integers(0, 2 if friction > 0 else 0, group, 0), reals(0, friction, 0, 0),
                            reals(*at), reals(*(at + towards)))

    @_whole
    def rigid_body(self, main: int, nodes: ArrayLike, *, mass: float = 0.0, id: int | None = None, title: str = "rigid body") -> int:
        """Nodes (ids) that move as one body with the node `main`, a free one: the start puts it to their centre of gravity. mass: added.
        Returns its id."""
        cards.check_ids(main=main)
        cards.check_finite(mass=mass)
        group = self.group(nodes, title=title)
        return self._titled("RBODY", "RBODY", id, title, integers(main, 0, 0, 0) + real(mass) + integers(group, 0, 0), reals(0, 0, 0),
                            reals(0, 0, 0), integers(0, 0, 0))

    # ---- outputs and control ----

    @_whole
    def history(self, *, variables: Sequence[str] = ("DEF",), title: str = "history", **objects: ArrayLike) -> None:
        """Asks for columns of the time history: nodes=, parts=, shells=, triangles=, bricks=, interfaces=, rigid_walls=, rigid_bodies=
        with ids (K,). variables: names as in /TH, at most 10 characters each, "DEF" for the usual ones."""
        wanted = cards.in_rows(cards.names(variables, "variables"))
        for kind, ids in objects.items():
            if kind not in _HISTORY:
                raise TypeError(f"history() has no argument {kind!r}; there are {', '.join(_HISTORY)}")
            word = _HISTORY[kind]
            numbers = cards.id_array(ids, kind).tolist()
            listed = [integers(number, 0) for number in numbers] if word in ("NODE", "SHEL", "SH3N", "BRIC") else cards.in_rows(numbers)
            self._titled(f"TH/{word}", "TH", None, title, *wanted, *listed)

    def card(self, text: str) -> None:
        """Any other blocks of the Starter deck, as text: keyword lines and their cards, without /BEGIN and /END."""
        first = len(self._lines)
        self._lines += cards.block(text, "text", ("/BEGIN", "/END", "#ENDDATA"))
        self._typed.update(range(first + 1, len(self._lines) + 1))

    def engine(self, end_time: float, *, step_scale: float = 0.9, history_interval: float | None = None,
               animation_interval: float | None = None, print_every: int = 100, cards_text: str = "") -> None:
        """What the Engine deck says; the last call counts.

        step_scale: factor of the stable step; history_interval, animation_interval: times, None: a hundredth of end_time, no animation;
        print_every: cycles between lines of the listing; cards_text: any other blocks, each from its keyword line,
        but for /RUN and /END.
        """
        cards.positive(end_time, "end_time")
        interval = end_time / 100 if history_interval is None else cards.positive(history_interval, "history_interval")
        if cards.integer(print_every, "print_every") < 1:
            raise ValueError(f"print_every is {print_every}, expected 1 or more cycles")
        lines = ["#RADIOSS ENGINE", f"/RUN/{self.name}/1", real(end_time), "/VERS/2022", f"/PRINT/-{print_every}", "/TFILE/4",
                 real(interval), "/DT", reals(cards.positive(step_scale, "step_scale"), 0)]
        if animation_interval is not None:
            lines += ["/ANIM/DT", reals(0, cards.positive(animation_interval, "animation_interval"))]
        if cards_text:
            lines += cards.block(cards_text, "cards_text", ("/RUN", "/END"))
        self._engine = lines

    # ---- results ----

    def starter_text(self) -> str:
        """The Starter deck as text."""
        return "\n".join([*self._lines, "/END"]) + "\n"

    def engine_text(self) -> str:
        """The Engine deck as text. Raises ValueError before engine() was called."""
        if not self._engine:
            raise ValueError("the model has no end: call engine(end_time) first")
        return "\n".join(self._engine) + "\n"

    def write(self, folder: str | os.PathLike[str]) -> Path:
        """Writes NAME_0000.rad and NAME_0001.rad into a folder, which is made. Returns the path of the first."""
        place = Path(folder)
        place.mkdir(parents=True, exist_ok=True)
        engine = self.engine_text()
        starter = place / f"{self.name}_0000.rad"
        starter.write_text(self.starter_text(), encoding="utf-8")
        (place / f"{self.name}_0001.rad").write_text(engine, encoding="utf-8")
        return starter

    def build(self, *, orient: bool = False) -> Model:
        """The model. Raises InputError with every finding; places in its messages are lines of starter_text().

        orient: turn the segments of contact surfaces to face each other where that is unambiguous.
        An id in a list that does not exist and a group that holds nothing, warnings where a deck or card() has them, are errors here.
        """
        try:
            model = Model.from_text(self.starter_text(), [self.engine_text()], name=self.name, orient=orient)
        except InputError as error:
            self._check_lists(error.diagnostics)
            raise
        self._check_lists(model.findings)
        return model

    # ---- helpers ----

    def _check_lists(self, findings: Sequence[Diagnostic]) -> None:
        """Raises InputError where a list that the builder wrote names what there is not."""
        wrong = [k for k, finding in enumerate(findings) if finding.code in _MISSING and finding.line not in self._typed]
        if wrong:
            refuse(findings, wrong)

    def _add(self, keyword: str, *lines: str) -> None:
        self._lines += [keyword, *lines]

    def _numbers(self, kind: str, count: int, ids: ArrayLike | None, name: str) -> NDArray[np.int64]:
        first = self._last.get(kind, 0) + 1
        numbers = np.arange(first, first + count, dtype=np.int64) if ids is None else cards.id_array(ids, name)
        if len(numbers) != count:
            raise ValueError(f"{name} has {len(numbers)} values, expected {count}")
        if count > 0:
            self._last[kind] = max(first - 1, int(numbers.max()))
        return numbers

    @_whole
    def _titled(self, keyword: str, kind: str, id: int | None, title: str, *lines: str) -> int:
        number = int(self._numbers(kind, 1, None if id is None else [id], "id")[0])
        self._add(f"/{keyword}/{number}", cards.checked_text(title, "title"), *lines)
        return number

    @_whole
    def _motion(self, keyword: str, nodes: ArrayLike, direction: str, function: int, scale: float, birth: float, death: float,
                id: int | None, title: str) -> int:
        cards.check_ids(function=function)
        cards.check_finite(birth=birth, death=death)
        group = self.group(nodes, title=title)
        return self._titled(keyword, keyword, id, title, integers(function, cards.direction(direction), 0, 0, group, 0, 0),
                            reals(1, cards.nonzero(scale, "scale"), birth, death))
