"""The contact library on its own: arguments that are refused, and a second thread."""
import threading
import time

import numpy as np
import pytest

from abut import contact
from contact_scenes import GAP, interface, sheet, squares


def both_squares():
    """@returns first and second surface, x: the arguments of inspect(), facing() and orient()"""
    x, lower, upper = squares()
    return lower, upper, x


def nodes_on_a_square(node_stiffness):
    return contact.Interface.nodes_to_surface(np.arange(4, 8), squares()[1], contact.Options(gap=GAP), node_stiffness=node_stiffness)


@pytest.mark.parametrize("name, value, error, words", [
    ("force", np.zeros((8, 3), dtype=np.float32), TypeError, "force is added to: it must be a float64 array"),
    ("force", [[0.0] * 3] * 8, TypeError, "force is added to: it must be a float64 array"),
    ("force", np.zeros((3, 8)).T, TypeError, "force is added to: it must be in C order"),
    ("force", np.zeros((7, 3)), ValueError, r"force has shape \(7, 3\), expected \(8, 3\)"),
    ("stiffness", np.zeros((8, 1)), ValueError, r"stiffness has shape \(8, 1\), expected \(8,\)"),
    ("x", np.zeros((5, 3)), ValueError, "x has 5 rows, but the surfaces name node 7"),
    ("x", np.full((8, 3), np.nan), ValueError, "x: row 0 is not finite"),
    ("x", np.zeros((8, 3), dtype=complex), TypeError, "x does not hold real numbers but complex128"),
    ("v", np.zeros((9, 3)), ValueError, r"v has shape \(9, 3\), expected \(8, 3\)"),
    ("mass", np.ones(3), ValueError, r"mass has shape \(3,\), expected \(8,\)"),
    ("mass", np.full(8, -1.0), ValueError, "mass: row 0 is negative"),
    ("mass", np.full(8, np.nan), ValueError, "mass: row 0 is not finite"),
    ("time", np.nan, ValueError, "time must be finite, not nan"),
    ("dt", -1.0, ValueError, "dt.* must be a finite number >= 0, not -1"),
    ("dt", np.nan, ValueError, "dt.* must be a finite number >= 0, not nan"),
    ("x", [[0.0] * 3, [0.0] * 2], TypeError, "x cannot be made an array: its rows have different lengths"),
])
def test_arrays_that_are_refused(name, value, error, words):
    x, made = interface()
    arguments = dict(x=x, v=np.zeros_like(x), force=np.zeros((8, 3)), stiffness=np.zeros(8), mass=None)
    made.search(x, arguments["v"])
    arguments[name] = value
    with pytest.raises(error, match=words):
        made.evaluate(**arguments)


def test_positions_that_were_not_searched_are_refused():
    """Forces are those of search()'s positions; those of evaluate() are compared with them."""
    x, made = interface()
    force, stiffness = np.zeros((8, 3)), np.zeros(8)
    made.search(x, np.zeros_like(x))
    with pytest.raises(RuntimeError, match=r"evaluate\(\) got other positions than search\(\) in this step"):
        made.evaluate(x + [0.0, 0.0, 5.0], np.zeros_like(x), force, stiffness)
    assert not force.any()
    made.evaluate(x, np.zeros_like(x), force, stiffness)


def test_a_step_that_is_none_adds_nothing():
    x, made = interface()
    force, stiffness = np.zeros((8, 3)), np.zeros(8)
    with pytest.raises(ValueError, match="dt must be positive"):
        made.step(x, np.zeros_like(x), force, stiffness, dt=0.0)
    assert not force.any() and not stiffness.any()


def test_a_read_only_force_is_refused():
    x, made = interface()
    force = np.zeros((8, 3))
    force.flags.writeable = False
    with pytest.raises(TypeError, match="force is added to, but it is read-only"):
        made.step(x, np.zeros_like(x), force, np.zeros(8), dt=1e-3)


@pytest.mark.parametrize("call, words", [
    (lambda: contact.Surface([[0, 1, 1, 0]]), "facet"),
    (lambda: contact.Surface([[0, 1]]), r"facets has shape \(1, 2\), expected \(F, 3\) or \(F, 4\)"),
    (lambda: contact.Surface([[0, 1, -2]]), "-2 is not a node index"),
    (lambda: contact.Options(gap=-1.0), "gap must be >= 0"),
    (lambda: contact.Options(birth=1.0, death=0.5), "death must be later than birth, not 0.5"),
    (lambda: contact.Options(start_duration=1.0, initial="ignore"), "cannot be had with project or ignore"),
    (lambda: contact.BothSidesOptions(gap=0.1, node_size=[1.0], facet_size=[1.0]), "come with node_gap and facet_gap"),
    (lambda: contact.FrictionFilter(share=2.0), "share must be > 0 and at most 1"),
    (lambda: contact.Options(initial="push"), "initial is 'push', expected one of 'keep'"),
    (lambda: contact.Rules(law="soft"), "law is 'soft'"),
    (lambda: contact.BothSidesOptions(gap=0.0), "gap must be > 0"),
    (lambda: contact.BothSidesOptions(gap=np.inf), "gap must be > 0 and finite"),
    (lambda: contact.Options(gap=np.inf), "gap must be >= 0"),
    (lambda: contact.Surface(np.array([[0, 1, 2**64 - 1]], dtype=np.uint64)), "18446744073709551615 is too large for an id or an index"),
    (lambda: contact.inspect(*both_squares(), gap=np.nan), "gap must be a finite number >= 0, not nan"),
    (lambda: contact.inspect(*both_squares(), gap=-1.0), "gap must be a finite number >= 0"),
    (lambda: contact.inspect(*both_squares(), stiffness_scale=np.nan), "stiffness_scale must be a finite number >= 0"),
    (lambda: contact.inspect(*both_squares(), element_step=np.inf), "element_step must be a finite number >= 0"),
    (lambda: contact.inspect(*both_squares(), mass=np.full(8, -1.0)), "mass: row 0 is negative"),
    (lambda: contact.inspect(*both_squares(), limits=contact.InspectionLimits(warp_degrees=np.nan)), "limit of the inspection"),
    (lambda: contact.facing(*both_squares(), gap=np.nan), "gap must be a finite number >= 0"),
    (lambda: contact.orient(*both_squares(), gap=np.nan), "gap must be a finite number >= 0"),
    (lambda: interface()[1].inspect(squares()[0], element_step=-1.0), "element_step must be a finite number >= 0"),
    (lambda: nodes_on_a_square([1.0, -1.0, 1.0, 1.0]), "node_stiffness 1 is not a finite number >= 0"),
    (lambda: nodes_on_a_square(np.full(4, np.inf)), "node_stiffness: row 0 is not finite"),
    (lambda: interface()[1].set_threads(4097), "threads must be 1 to 4096"),
    (lambda: interface()[1].search(squares()[0], np.zeros((8, 3)), dt=-1.0), "must be a finite number >= 0, not -1"),
    (lambda: interface()[1].commit(1e-3), "commit"),
    (lambda: contact.Interface.two_surfaces(*squares()[1:]).search(squares()[0], np.zeros((8, 3))), "side 0 has no stiffness"),
    (lambda: interface()[1].set_surface(2), "side is 2"),
    (lambda: interface()[1].set_surface(0, stiffness=[1.0, 2.0]), r"stiffness has shape \(2,\), expected \(1,\)"),
    (lambda: interface()[1].restore(b"not a history, but long enough"), ""),
    (lambda: contact.Interface.two_surfaces(contact.Surface([[0, 1, 2]]), contact.Surface([[2, 3, 4]])), ""),
])
def test_values_that_are_refused(call, words):
    with pytest.raises((ValueError, RuntimeError), match=words):
        call()


@pytest.mark.parametrize("use", [
    lambda: contact.Interface.__new__(contact.Interface).search(squares()[0], np.zeros((8, 3))),
    lambda: contact.Surface.__new__(contact.Surface).nodes,
    lambda: contact.Options.__new__(contact.Options).gap,
    lambda: contact.Interface.two_surfaces(*squares()[1:], contact.Options.__new__(contact.Options)),
])
def test_an_object_that_new_alone_made_is_refused(use):
    with pytest.raises(TypeError, match="made by __new__ alone"):
        use()


def test_a_history_with_any_bit_turned_is_refused():
    saved = interface()[1].history()
    for at in range(len(saved)):
        damaged = bytearray(saved)
        damaged[at] ^= 1 << at % 8
        with pytest.raises(ValueError, match="damaged"):
            interface()[1].restore(bytes(damaged))
    for end in (0, 7, 23, len(saved) - 1):
        with pytest.raises(ValueError, match="not the history"):
            interface()[1].restore(saved[:end])


@pytest.mark.parametrize("call", [contact.inspect, contact.facing, contact.orient])
def test_facets_of_different_lengths_are_refused(call):
    x = squares()[0]
    with pytest.raises(TypeError, match="first cannot be made an array: its rows have different lengths"):
        call([[0, 1, 2], [3, 4]], [[4, 7, 6, 5]], x)


def test_one_thread_at_a_time():
    """While a thread is inside without the interpreter's lock, others are refused, also those that only look."""
    lower, upper = sheet(0, 50, 0.0, True), sheet(2500, 48, 0.8 * GAP, False)
    x = np.vstack([lower[0], upper[0]])
    made = contact.Interface.two_surfaces(contact.Surface(lower[1]), contact.Surface(upper[1]), contact.Options(gap=GAP))
    looks = {
        "nodal_forces": lambda: made.nodal_forces(len(x)), "nodal_contact": lambda: made.nodal_contact(len(x)),
        "nodal_area": lambda: made.nodal_area(x), "inspect": lambda: made.inspect(x), "projections": lambda: made.projections(x),
        "history": made.history, "nodes_in_contact": lambda: made.nodes_in_contact, "nodes_crossed": lambda: made.nodes_crossed,
        "nodes_lost": lambda: made.nodes_lost, "restore": lambda: made.restore(saved),
    }
    saved = made.history()
    refused, over = set(), threading.Event()

    def work():
        while not over.is_set():
            try:
                made.search(x, np.zeros_like(x))
            except RuntimeError:  # the other thread was inside
                pass

    worker = threading.Thread(target=work)
    worker.start()
    deadline = time.monotonic() + 60
    try:
        while refused != set(looks) and time.monotonic() < deadline:
            for name in set(looks) - refused:
                try:
                    looks[name]()
                except RuntimeError as error:
                    assert "at work in another thread" in str(error)
                    refused.add(name)
    finally:
        over.set()
        worker.join()
    assert refused == set(looks)
