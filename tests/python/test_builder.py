"""Models from arrays: the same motion as a deck, the same checks, closed forms for what each method adds."""
import numpy as np
import pytest

import abut
from support import DECKS, STEEL, builder, cube, one_cube, two_blocks

MASS = STEEL["density"]  # of the unit cube


def test_the_same_bits_as_the_deck():
    deck = abut.Run(abut.Model.read(DECKS / "twoblocks" / "twoblocks_0000.rad"))
    built = abut.Run(two_blocks().build())
    for _ in range(3):
        deck.advance(20)
        built.advance(20)
        assert built.time == deck.time and built.state_hash == deck.state_hash


def test_written_files_are_the_same_model(tmp_path):
    b = two_blocks()
    model = abut.Model.read(b.write(tmp_path / "deck"))
    assert model.fingerprint == b.build().fingerprint


def test_numbers_keep_their_digits():
    values = np.array([[1 / 3, -1e-300, 123456.789012345], [np.pi * 1e-7, -2 / 3 * 1e-5, 1e22]])
    b = builder()
    one_cube(b)
    b.nodes(values)
    b.engine(1.0)
    read = b.build().coordinates[8:]
    np.testing.assert_allclose(read, values, rtol=1e-13, atol=0)
    assert read[0, 0] == 1 / 3


def test_gravity_and_loads_accelerate():
    """v(n - 1/2) = a (t - h/2) of the centre of mass: central differences are exact for a constant acceleration."""
    b = builder()
    ids = one_cube(b)
    always = b.function([0.0, 1.0], [1.0, 1.0])
    b.gravity("Z", always, scale=-9.81e-3)
    b.load(ids, "X", always, scale=1e-9)
    b.engine(0.01)
    run = abut.Run(b.build())
    run.advance(50)
    mid = run.time - 0.5 * run.step
    np.testing.assert_allclose(run.velocities.mean(axis=0), [8e-9 / MASS * mid, 0.0, -9.81e-3 * mid], rtol=1e-9, atol=1e-15)


def test_pressure_is_force_over_area():
    b = builder()
    ids = one_cube(b)
    b.pressure(b.surface(ids[[[4, 5, 6, 7]]]), b.function([0.0, 1.0], [1.0, 1.0]), scale=1e-6)
    b.engine(0.01)
    run = abut.Run(b.build())
    run.advance(100)
    # p A t at the half step, along the facet's normal (+z); the face deforms a little.
    momentum = (run.masses[:, None] * run.velocities).sum(axis=0)
    np.testing.assert_allclose(momentum, [0.0, 0.0, 1e-6 * (run.time - 0.5 * run.step)], rtol=1e-4, atol=1e-12)


def test_imposed_motion_and_fixed_axes():
    b = builder()
    ids = one_cube(b)
    ramp = b.function([0.0, 1.0], [0.0, 1.0])
    b.imposed_displacement(ids[4:], "Z", ramp, scale=0.5)
    b.fix(ids[:4], translation="z", rotation="")
    b.fix(ids[[0, 4]], translation="xy", rotation="")
    b.engine(0.01)
    run = abut.Run(b.build())
    run.advance_to_end()
    np.testing.assert_allclose(run.displacements[4:, 2], 0.5 * run.time, rtol=1e-9)
    np.testing.assert_array_equal(run.displacements[:4, 2], 0.0)
    np.testing.assert_array_equal(run.displacements[[0, 4], :2], 0.0)


def test_a_rigid_body_keeps_its_shape_and_a_wall_stops_it():
    b = builder()
    ids = one_cube(b)
    main = b.nodes([[0.5, 0.5, 0.5]])[0]
    b.rigid_body(main, ids)
    b.velocity(np.append(ids, main), (1.0, 0.0, 0.0))
    b.engine(0.01)
    run = abut.Run(b.build())
    run.advance(20)
    np.testing.assert_allclose(run.displacements[:, 0], run.time, rtol=1e-9)

    b = builder()
    ids = one_cube(b)
    b.velocity(ids, (0.0, 0.0, -1.0))
    wall = b.rigid_wall((0, 0, 0), (0, 0, 1), nodes=ids)
    b.history(rigid_walls=[wall], nodes=ids[:1])
    b.engine(0.002)
    run = abut.Run(b.build())
    run.advance_to_end()
    assert run.positions[:, 2].min() > -1e-9
    assert len(run.history.find("RWALL/1/FN?")) == 3 and len(run.history.find("NODE/1/D?")) == 3


def test_a_rigid_body_on_a_node_of_the_mesh_leaves_the_mesh_whole():
    """A bar at rest whose last brick is rigid, with one of the bar's nodes as main node: refused where the start would move that node
    (2.5 J from nothing), at rest with ICoG 3."""
    def bar(icog):
        b = builder()
        ids = b.nodes([(x, y, z) for x in range(4) for y, z in ((0, 0), (1, 0), (1, 1), (0, 1))])
        b.part(b.solid_property(), b.elastic(**STEEL), bricks=[np.append(ids[k:k + 4], ids[k + 4:k + 8]) for k in (0, 4, 8)])
        if icog == 1:
            b.rigid_body(ids[8], ids[9:])
        else:
            b.card(f"/RBODY/1\nend\n{ids[8]:>10}{0:>10}{0:>10}{0:>10}{0:>20}{b.group(ids[9:]):>10}{0:>10}{icog:>10}\n\n\n")
        b.engine(0.02)
        return abut.Run(b.build(), threads=1, record_history=False)

    with pytest.raises(abut.InputError, match=r"/RBODY/1 field 'node_ID': node 9 belongs to element 2, and ICoG 1 moves it by 0\.\d+, to the "
                                              r"centre of gravity at .*; give a free node, or ICoG 3"):
        bar(1)
    run = bar(3)
    run.advance_to_end()
    assert run.balance.ie == run.balance.ke == run.balance.initial == 0.0


def shells(b, height, facing_down=False):
    """A plate of 2 by 2 shells over the unit square. @returns node ids, facets"""
    ids = b.nodes([(x, y, height) for y in (0.0, 0.5, 1.0) for x in (0.0, 0.5, 1.0)])
    quads = np.array([[3 * j + i, 3 * j + i + 1, 3 * j + i + 4, 3 * j + i + 3] for j in range(2) for i in range(2)])
    return ids, ids[quads[:, ::-1] if facing_down else quads]


@pytest.mark.parametrize("kind", ["TYPE3", "TYPE5", "TYPE7"])
def test_interfaces_repel(kind):
    """A plate flies at a fixed one and comes back; without damping the balance closes but for what the interface says it made."""
    b = builder()
    low, low_quads = shells(b, 0.0)
    high, high_quads = shells(b, 0.12, facing_down=True)
    prop = b.shell_property(0.1)
    steel = b.elastic(**STEEL)
    b.part(prop, steel, shells=low_quads)
    b.part(prop, steel, shells=high_quads)
    b.fix(low)
    b.velocity(high, (0.0, 0.0, -1.0))
    lower = b.surface(low_quads)
    if kind == "TYPE3":
        number = b.contact(lower, b.surface(high_quads), gap=0.1, friction=0.1)
    elif kind == "TYPE5":
        number = b.contact_nodes(high, lower, gap=0.1)
    else:
        number = b.contact_both_sides(lower, nodes=high, gap=0.1)
    b.history(interfaces=[number])
    b.engine(0.5)
    model = b.build()
    assert model.interfaces[0].type == kind
    run = abut.Run(model)
    touched = []
    run.advance_to_end(lambda r: touched.append(r.interfaces[0].in_contact))
    assert max(touched) >= 9 and touched[-1] == 0
    assert run.velocities[9:, 2].mean() > 0.5
    assert abs(run.balance.err - run.balance.cx / run.balance.largest) < 1e-3
    if kind == "TYPE7":
        assert run.balance.dw > 0 and abs(run.balance.err) < 0.005
    else:
        assert abs(run.balance.err) < 0.02


def test_plastic_shells_and_triangles_and_tetrahedra():
    b = builder()
    ids = b.nodes([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1)])
    plastic = b.johnson_cook(yield_stress=0.3, hardening=0.5, exponent=0.4, **STEEL)
    b.part(b.shell_property(0.1, points=5), plastic, shells=ids[[[0, 1, 2, 3]]])
    b.part(b.shell_property(0.1), plastic, triangles=ids[[[0, 1, 4]]], title="triangle")
    b.part(b.solid_property(), plastic, tetras=ids[[[0, 1, 3, 4]]])
    b.card("/ADMAS/0/7\nadded\n" + f"{1e-3:>20}{b.group(ids[:1]):>10}")
    b.engine(1e-4)
    model = b.build()
    assert [len(model.elements(kind)) for kind in ("shell4", "shell3", "tetra", "brick")] == [1, 1, 1, 0]
    assert [part.title for part in model.parts] == ["part", "triangle", "part"]
    run = abut.Run(model)
    assert run.advance(1) and run.masses[0] > 1e-3


@pytest.mark.parametrize("call, error, words", [
    (lambda b: b.nodes([[0, 0]]), ValueError, r"coordinates has shape \(1, 2\), expected \(N, 3\)"),
    (lambda b: b.nodes([[0, 0, 0], [0, np.nan, 0]]), ValueError, "coordinates: row 1 is not finite"),
    (lambda b: b.nodes([[0, 0, 0]], ids=[1, 2]), ValueError, "ids has 2 values, expected 1"),
    (lambda b: b.part(1, 1, bricks=[[1, 2, 3]]), ValueError, r"bricks has shape \(1, 3\), expected \(K, 8\)"),
    (lambda b: b.part(1, 1, shells=[[0, 1, 2, 3]]), ValueError, "shells holds 0: ids are positive"),
    (lambda b: b.part(1, 1, shells=[[0.5, 1, 2, 3]]), TypeError, "shells holds float64"),
    (lambda b: b.surface(), ValueError, "either facets or parts"),
    (lambda b: b.fix([1], translation="xw"), ValueError, "expected letters out of 'xyz'"),
    (lambda b: b.velocity([1], [1, 2]), ValueError, "three finite numbers"),
    (lambda b: b.load([1], "Q", 1), ValueError, "direction is 'Q'"),
    (lambda b: b.history(beams=[1]), TypeError, "no argument 'beams'"),
    (lambda b: b.group([1], title="/NODE"), ValueError, "must be one line"),
    (lambda b: b.engine(0.0), ValueError, "end_time is 0.0, expected a positive number"),
    (lambda b: b.engine_text(), ValueError, "call engine"),
    (lambda b: b.card("GRAV"), ValueError, "begins with its keyword line"),
    (lambda b: b.engine(1.0, cards_text="junk"), ValueError, "cards_text is 'junk', but a block begins with its keyword line"),
    # The deck would end there, or be another one.
    (lambda b: b.card("/GRAV/1\ng\n\n/END"), ValueError, "text holds '/END', but /BEGIN and /END and #ENDDATA are written by the builder"),
    (lambda b: b.card("/GRAV/1\ng\n\n/ end / 1\n"), ValueError, "text holds '/ end / 1'"),
    (lambda b: b.card("/GRAV/1\ng\n\n#enddata\n"), ValueError, "text holds '#enddata'"),
    (lambda b: b.card("/BEGIN\nother\n"), ValueError, "text holds '/BEGIN'"),
    (lambda b: b.engine(1.0, cards_text="/PRINT/-1\n/RUN/m/1\n0.5"), ValueError, "cards_text holds '/RUN/m/1', but /RUN and /END are written"),
    (lambda b: b.engine(1.0, cards_text="/PRINT/-1\n/END"), ValueError, "cards_text holds '/END'"),
    (lambda b: b.engine(1.0, step_scale=np.nan), ValueError, "step_scale is nan, expected a finite number"),
    (lambda b: b.engine(1.0, print_every=1.5), TypeError, "print_every is 1.5, expected an integer"),
    (lambda b: b.engine(1.0, step_scale=0.0), ValueError, "step_scale is 0.0, expected a positive number"),
    (lambda b: b.engine(1.0, history_interval=0), ValueError, "history_interval is 0, expected a positive number"),
    (lambda b: b.engine(1.0, animation_interval=0.0), ValueError, "animation_interval is 0.0, expected a positive number"),
    # A card takes 0 for its default: the whole load would act.
    (lambda b: b.gravity("Z", 1, scale=0.0), ValueError, "scale is 0, expected another number"),
    (lambda b: b.load([1], "X", 1, scale=0), ValueError, "scale is 0, expected another number"),
    (lambda b: b.pressure(1, 1, scale=-0.0), ValueError, "scale is 0, expected another number"),
    (lambda b: b.imposed_velocity([1], "X", 1, scale=0.0), ValueError, "scale is 0, expected another number"),
    (lambda b: b.imposed_displacement([1], "X", 1, scale=0.0), ValueError, "scale is 0, expected another number"),
    (lambda b: b.contact(1, 2, stiffness_scale=0.0), ValueError, "stiffness_scale is 0, expected another number"),
    (lambda b: b.contact_nodes([1], 2, stiffness_scale=0.0), ValueError, "stiffness_scale is 0, expected another number"),
    (lambda b: b.johnson_cook(density=1, young=1, poisson=0, yield_stress=1, exponent=0.0), ValueError, "exponent is 0"),
    (lambda b: b.elastic(density=np.inf, young=1.0, poisson=0.3), ValueError, "density is inf, expected a finite number"),
    (lambda b: b.elastic(density=1.0, young=None, poisson=0.3), TypeError, "young is None, expected a number"),
    (lambda b: b.johnson_cook(density=1, young=1, poisson=0, yield_stress=np.nan), ValueError, "yield_stress is nan"),
    (lambda b: b.shell_property(np.nan), ValueError, "thickness is nan"),
    (lambda b: b.shell_property(1.0, points=2.5), TypeError, "points is 2.5, expected an integer"),
    (lambda b: b.shell_property(1.0, hourglass=(0, np.nan, 0)), ValueError, r"hourglass\[1\] is nan"),
    (lambda b: b.solid_property(qa=np.inf), ValueError, "qa is inf"),
    (lambda b: b.function([0, 1], [0, np.nan]), ValueError, "x and y: point 1 is not finite"),
    (lambda b: b.contact(1.7, 2), TypeError, "first is 1.7, expected an integer"),
    (lambda b: b.contact(1, 2, gap=np.nan), ValueError, "gap is nan"),
    (lambda b: b.contact_nodes([1], 1.5), TypeError, "surface is 1.5, expected an integer"),
    (lambda b: b.contact_both_sides(1, gap=np.inf), ValueError, "gap is inf"),
    (lambda b: b.part(0, 1), ValueError, "prop is 0: ids are positive"),
    (lambda b: b.surface(parts=[1.5]), TypeError, "parts holds float64"),
    (lambda b: b.rigid_body(1, [2], mass=np.nan), ValueError, "mass is nan"),
    (lambda b: b.imposed_velocity([1], "X", 1, birth=np.nan), ValueError, "birth is nan"),
    (lambda b: b.load([1], "X", "1"), TypeError, "function is '1', expected an integer"),
    (lambda b: b.fix([10_000_000_012]), ValueError, "nodes holds 10000000012: ids on a card have at most 10 digits"),
    (lambda b: b.fix(np.array([2**64 - 1], dtype=np.uint64)), ValueError, "at most 10 digits"),
    (lambda b: b.load([1], "X", 10_000_000_012), ValueError, "10000000012 has 11 characters, at most 10 fit"),
    (lambda b: (b.nodes([[0, 0, 0]], ids=[9_999_999_999]), b.nodes([[0, 0, 0]])), ValueError, "10000000000 has 11 characters"),
    (lambda b: b.history(nodes=[1], variables="DEF"), TypeError, r"variables is 'DEF', expected a list of names, e.g. \['DEF'\]"),
    (lambda b: b.history(nodes=[1], variables=["ELEVENCHARS"]), ValueError, "variables holds 'ELEVENCHARS', expected names of 1 to 10"),
    (lambda b: b.history(nodes=[1], variables=[]), ValueError, "variables is empty"),
    (lambda b: b.function([0, 1], np.array([0, 1j])), TypeError, "y holds complex128, expected real numbers"),
    (lambda b: b.nodes(np.zeros((2, 3), dtype=complex)), TypeError, "holds complex128, expected real numbers"),
    (lambda b: abut.ModelBuilder("drop", units="kgm"), ValueError, "units is 'kgm', expected three names"),
    (lambda b: abut.ModelBuilder("drop", units=("kg", "m")), ValueError, "expected three names"),
    (lambda b: abut.ModelBuilder("two words"), ValueError, "must not be empty nor hold blanks"),
])
def test_arguments_that_make_no_card(call, error, words):
    with pytest.raises(error, match=words):
        call(builder())


@pytest.mark.parametrize("call", [
    lambda b: b.part(1, 1, shells=[[1, 2, 3, 4]], bricks=[[1, 2]]),
    lambda b: b.part(1, 1, title="/NODE"),
    lambda b: b.nodes([[0, 0, 0]], ids=[10_000_000_012]),
    lambda b: b.load([1], "Q", 1),
    lambda b: b.velocity([1], [1, 2]),
    lambda b: b.rigid_body(1, [2], id=0),
    lambda b: b.imposed_velocity([1], "X", 1, scale=np.nan),
    lambda b: b.history(nodes=[1], parts=[0]),
    lambda b: b.engine(2.0, animation_interval=np.nan),
])
def test_a_refused_call_leaves_the_model_as_it_was(call):
    b = two_blocks()
    starter, engine = b.starter_text(), b.engine_text()
    with pytest.raises((ValueError, TypeError)):
        call(b)
    assert (b.starter_text(), b.engine_text()) == (starter, engine)
    assert b.nodes([[5.0, 5.0, 5.0]]).tolist() == [17] and b.group([17]) == two_blocks().group([1]) and b.part(1, 1) == 3


def test_every_variable_of_the_history_is_a_column():
    """More than ten names take several lines of the card."""
    b = builder()
    ids = one_cube(b)
    names = [f"{kind}{axis}" for kind in ("D", "V", "A", "") for axis in "XYZ"]
    sums = ["IE", "KE", "XMOM", "YMOM", "ZMOM", "MASS", "HE", "ERODED", "RKE", "VX", "VY", "VZ"]
    b.history(nodes=ids[:1], variables=names)
    b.history(parts=[1], variables=sums)
    b.engine(1e-3)
    columns = abut.Run(b.build()).history.names
    assert [name for name in names if f"NODE/1/{name}" not in columns] == []
    assert [name for name in sums if f"PART/1/{name}" not in columns] == []


def test_what_the_reader_refuses():
    b = builder()
    ids = b.nodes(cube())
    b.part(7, b.elastic(density=-1.0, young=210.0, poisson=0.7), bricks=[ids])
    b.fix([99])
    b.engine(1.0)
    with pytest.raises(abut.InputError) as caught:
        b.build()
    text = str(caught.value)
    assert "density is -1" in text and "Poisson's ratio is 0.7" in text and "/PROP" in text and "model_0000.rad" in text


@pytest.mark.parametrize("call, words", [
    (lambda b, n: b.fix(n + 1000), r"model_0000.rad:\d+: /GRNOD/NODE/1: no /NODE with id 1001 \(nor 7 more of the list\)"),
    (lambda b, n: b.fix(np.append(n[:1], 1000)), "/GRNOD/NODE/1: no /NODE with id 1000"),
    (lambda b, n: b.velocity([], (0, 0, 1)), "/GRNOD/NODE/1: the group holds no node"),
    (lambda b, n: b.load([1000], "Z", 0), "no /NODE with id 1000"),
    (lambda b, n: b.rigid_wall((0, 0, -1), (0, 0, 1), nodes=[1000]), "no /NODE with id 1000"),
    (lambda b, n: b.pressure(b.surface(parts=[1, 9]), 0), "/SURF/PART/EXT/1: no /PART with id 9"),
    (lambda b, n: b.pressure(b.surface(np.zeros((0, 4), dtype=int)), 0), "/SURF/SEG/1: the surface holds no segment"),
    (lambda b, n: b.history(nodes=[1, 1000]), "/TH/NODE/1: there is no NODE 1000"),
    (lambda b, n: b.history(rigid_bodies=[3]), "there is no RBODY 3"),
    (lambda b, n: (b.fix([1000]), b.contact(1, 2)), "no /NODE with id 1000.*\n.*no /SURF with id 1"),
])
def test_lists_of_what_there_is_not(call, words):
    """A deck may name what is not there, with a warning; a list that the builder wrote may not, and what card() brings may."""
    def model(more):
        b = builder()
        ids = one_cube(b)
        b.engine(1.0)
        more(b, ids)
        return b

    b = model(call)
    with pytest.raises(abut.InputError, match=r"(?s)" + words) as caught:
        b.build()
    wrong = [d for d in caught.value.diagnostics if d.severity == "error"]
    assert str(caught.value) == "\n".join(map(str, wrong)) and all(d.line > 0 for d in wrong)

    typed = model(lambda b, ids: b.card("/GRNOD/NODE/7\nfew\n         1      1000\n/TH/NODE/7\nnone\nDEF\n      1000")).build()
    assert [d.code for d in typed.findings] == ["model.unknown_member", "model.missing_output"]


def test_a_model_in_which_all_is_rigid_falls_in_steps():
    """Nothing limits the step then: it is a thousandth of the run and grows to a hundredth, not the whole of it."""
    b = builder()
    nodes, main = b.nodes(cube()), b.nodes([[0.5, 0.5, 0.5]])
    b.part(b.solid_property(), b.elastic(**STEEL), bricks=[nodes])
    b.rigid_body(main[0], nodes)
    b.gravity("z", b.function([0.0, 1.0], [1.0, 1.0]), scale=-9.81e-3)
    b.engine(2.0)
    run = abut.Run(b.build(), threads=1)
    run.advance_to_end()
    assert 100 < run.cycle < 200 and run.time == pytest.approx(2.0, rel=1e-2)
    assert run.displacements[:8, 2] == pytest.approx(np.full(8, -0.5 * 9.81e-3 * run.time**2), rel=2e-2)
