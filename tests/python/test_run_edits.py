"""Velocities that a host changes in a run."""
import numpy as np
import pytest

import abut
from support import builder, one_cube


def cube_after_five_cycles():
    b = builder()
    one_cube(b)
    b.engine(1.0)
    run = abut.Run(b.build())
    run.advance(5)
    return run


def test_changed_velocities_are_booked_as_external_work():
    run = cube_after_five_cycles()
    with run.edit() as e:
        e.velocities[:, 0] += 2.0
        e.velocities[3:5] += (0.0, 0.5, 0.0)
    assert run.velocities[3, 1] == 0.5 and run.cycle == 5
    start = run.time
    energy = 0.5 * (run.masses * (run.velocities**2).sum(axis=1)).sum()
    run.advance(2)
    assert run.balance.extw == pytest.approx(energy, rel=1e-12)
    assert abs(run.balance.ledger) < 1e-12
    assert run.displacements[:, 0].mean() == pytest.approx(2.0 * (run.time - start), rel=1e-12)

    run.velocities = np.zeros((8, 3))
    run.advance(1)
    assert np.abs(run.velocities).max() < 0.1

    with pytest.raises(ZeroDivisionError), run.edit() as e:
        e.velocities[:] = 100.0
        1 / 0
    assert np.abs(run.velocities).max() < 0.1


def test_an_edit_is_of_its_cycle():
    run = cube_after_five_cycles()
    with pytest.raises(RuntimeError, match=r"from cycle 5 to 7 inside the block of edit\(\)"):
        with run.edit() as e:
            e.velocities[:, 0] += 2.0
            run.advance(2)
    run.advance(1)
    assert not run.velocities.any() and run.balance.extw == 0.0


@pytest.mark.parametrize("assigned", [False, True])
def test_of_two_changes_at_once_none_is_lost_silently(assigned):
    run = cube_after_five_cycles()
    with pytest.raises(RuntimeError, match="changed inside the block of edit"):
        with run.edit() as outer:
            if assigned:
                run.velocities = np.full((8, 3), 2.0)
            else:
                with run.edit() as inner:
                    inner.velocities[:] = 2.0
            outer.velocities[:] = 7.0
    assert np.all(run.velocities == 2.0)
    with run.edit() as e:  # one after another they add up
        e.velocities[0] = 3.0
    with run.edit() as e:
        e.velocities[1] = 4.0
    assert run.velocities[:3, 0].tolist() == [3.0, 4.0, 2.0]


def test_velocities_that_wait_for_the_next_cycle_are_read_only():
    b = builder()
    one_cube(b)
    b.engine(1.0)
    run = abut.Run(b.build())
    run.velocities = np.ones((8, 3))
    with pytest.raises(ValueError, match="read-only"):
        run.velocities[:] = 0.0
    run.advance(1)
    np.testing.assert_allclose(run.velocities, 1.0)


@pytest.mark.parametrize("factor", [0.0, -1.0, 2.0])
def test_changed_velocities_under_stress_keep_the_balance(factor):
    """Elements count their force over the whole step up to the change: of first order in the step, a fifth of the energy here."""
    b = builder()
    one_cube(b)
    b.engine(1.0)
    run = abut.Run(b.build())
    run.advance(1)
    run.velocities = 1e-4 * (run.positions - 0.5)  # swings in and out
    for _ in range(8):
        run.advance(7)
        assert run.balance.ie > 0.02 * run.balance.ke
        before = run.balance.err * run.balance.largest
        run.velocities = factor * run.velocities
        run.advance(1)
        assert abs(run.balance.err * run.balance.largest - before) < 1e-4 * run.balance.largest
        assert abs(run.balance.ledger) < 1e-12


@pytest.mark.parametrize("value, words", [
    (np.zeros((7, 3)), r"velocities has shape \(7, 3\), expected \(8, 3\)"),
    (np.zeros(24), r"velocities has shape \(24,\), expected \(8, 3\)"),
    (np.full((8, 3), np.inf), "velocities: row 0 is not finite"),
])
def test_velocities_that_are_refused(value, words):
    b = builder()
    one_cube(b)
    b.engine(1.0)
    run = abut.Run(b.build())
    with pytest.raises(ValueError, match=words):
        run.velocities = value
