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
    (lambda b: b.engine(0.0), ValueError, "expected a positive time"),
    (lambda b: b.engine_text(), ValueError, "call engine"),
    (lambda b: b.card("GRAV"), ValueError, "begins with its keyword line"),
    (lambda b: abut.ModelBuilder("two words"), ValueError, "must not be empty nor hold blanks"),
])
def test_arguments_that_make_no_card(call, error, words):
    with pytest.raises(error, match=words):
        call(builder())


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


def test_a_model_in_which_all_is_rigid_falls_in_steps():
    """Nothing limits the step then: it is a thousandth of the run, not the whole of it."""
    b = builder()
    nodes, main = b.nodes(cube()), b.nodes([[0.5, 0.5, 0.5]])
    b.part(b.solid_property(), b.elastic(**STEEL), bricks=[nodes])
    b.rigid_body(main[0], nodes)
    b.gravity("z", b.function([0.0, 1.0], [1.0, 1.0]), scale=-9.81e-3)
    b.engine(2.0)
    run = abut.Run(b.build(), threads=1)
    run.advance_to_end()
    assert 900 < run.cycle < 1100 and run.time == pytest.approx(2.0, rel=2e-3)
    assert run.displacements[:8, 2] == pytest.approx(np.full(8, -0.5 * 9.81e-3 * run.time**2), rel=2e-3)
