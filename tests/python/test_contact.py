"""The contact library on its own: closed forms, arrays at the border, history."""
import gc
import re

import numpy as np
import pytest

from abut import contact
from contact_scenes import CLEARANCE, FACET, GAP, interface, sheet, squares
from support import ROOT, held_bytes

def evaluated(made, x, v=None, **arguments):
    force, stiffness = np.zeros((len(x), 3)), np.zeros(len(x))
    v = np.zeros_like(x) if v is None else v
    made.search(x, v, **arguments)
    return made.evaluate(x, v, force, stiffness, **arguments), force, stiffness


def test_force_of_two_squares():
    """8 nodes held by K = s K1 K2/(K1 + K2), K1 = FACET/4, K2 = FACET, in both passes (T10, T13): F = 8 K P, and 2 K per node."""
    x, made = interface()
    result, force, stiffness = evaluated(made, x)
    k = 0.2 * (FACET / 4) * FACET / (FACET / 4 + FACET)
    np.testing.assert_allclose(force[:4].sum(axis=0), [0, 0, -8 * k * (GAP - CLEARANCE)], rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(force.sum(axis=0), 0, atol=1e-15)
    np.testing.assert_allclose(result.normal_force, force[4:].sum(axis=0), rtol=1e-12, atol=1e-15)
    assert result.in_contact == 8 and result.largest_penetration == pytest.approx(GAP - CLEARANCE)
    assert (stiffness > 0).all()
    np.testing.assert_array_equal(np.sort(made.nodes_in_contact), np.arange(8))
    normal, tangential = made.nodal_forces(8)
    np.testing.assert_allclose(normal, force, rtol=1e-12, atol=1e-15)
    np.testing.assert_array_equal(tangential, 0)
    np.testing.assert_allclose(made.nodal_area(x), 0.25)
    state, opening, penetration = made.nodal_contact(8)
    assert (state == 2).all()  # without friction every contact slips
    np.testing.assert_allclose(opening, CLEARANCE - GAP)
    np.testing.assert_allclose(penetration, GAP - CLEARANCE)


def test_forces_are_added_into_the_hosts_arrays():
    x, made = interface()
    _, alone, stiffness = evaluated(made, x)
    x, made = interface()
    force, k = np.full((8, 3), 5.0), np.full(8, 7.0)
    made.search(x, np.zeros_like(x))
    made.evaluate(x, np.zeros_like(x), force, k)
    np.testing.assert_allclose(force, alone + 5.0)
    np.testing.assert_allclose(k, stiffness + 7.0)


def flight(made, x, steps, mass, dt, one_call=False, start=None):
    """Central differences with fixed steps: the upper square flies at the lower one, which is clamped."""
    x, v = (x.copy(), np.zeros_like(x)) if start is None else start
    if start is None:
        x[4:, 2] = GAP + 0.05
        v[4:] = (0.3, 0.0, -1.0)
    inverse = np.where(np.arange(8) < 4, 0.0, 1.0 / mass)
    m = np.where(np.arange(8) < 4, 0.0, mass)
    for n in range(steps):
        force, k = np.zeros((8, 3)), np.zeros(8)
        if one_call:
            result = made.step(x, v, force, k, dt=dt, mass=m)
        else:
            made.search(x, v, mass=m)
            result = made.evaluate(x, v, force, k, mass=m)
            made.commit(dt)
        v = v + dt * inverse[:, None] * force
        x = x + dt * v
    return x, v, result


def test_an_impact_gives_its_energy_back():
    """Without friction the square leaves with the speed that it came with; energy made by the numerics is small and reported."""
    x, made = interface(law="stiffening", switch_correction=True, lower_size=5.0)
    _, v, result = flight(made, x, 4000, mass=0.1, dt=1e-3)
    np.testing.assert_allclose(v[4:, 2], 1.0, rtol=2e-3)
    np.testing.assert_allclose(v[4:, 0], 0.3, rtol=1e-9)
    kinetic = 0.5 * 0.1 * (v[4:]**2).sum()
    assert result.in_contact == 0 and result.elastic == 0
    assert kinetic - 0.5 * 0.1 * 4 * (0.3**2 + 1) == pytest.approx(result.made, abs=1e-4)


def test_friction_takes_energy():
    x, made = interface(law="stiffening", switch_correction=True, lower_size=5.0, friction=0.05, tangential_ratio=20.0)
    _, v, result = flight(made, x, 4000, mass=0.1, dt=1e-3)
    # The normal impulse is 2 m v_n per node; friction slows the slip by mu times that.
    np.testing.assert_allclose(v[4:, 0].mean(), 0.3 - 0.05 * 2.0, rtol=0.05)
    assert result.friction_work > 0
    lost = 0.5 * 0.1 * (4 * (0.3**2 + 1) - (v[4:]**2).sum())
    assert lost == pytest.approx(result.friction_work - result.made, abs=1e-4)


def test_one_call_is_three_verbs():
    states = []
    for one_call in (False, True):
        x, made = interface(law="stiffening", friction=0.2)
        states.append(flight(made, x, 300, mass=0.1, dt=1e-3, one_call=one_call)[:2])
    np.testing.assert_array_equal(states[1], states[0])


def test_threads_do_not_matter():
    """Sheets of 2500 and 2304 nodes: enough pieces for three threads."""
    lower, upper = sheet(0, 50, 0.0, True), sheet(2500, 48, 0.8 * GAP, False)
    x = np.vstack([lower[0], upper[0]])
    v = np.zeros_like(x)
    v[2500:] = (0.3, 0.1, -0.5)
    states = []
    for threads in (1, 3):
        made = contact.Interface.two_surfaces(contact.Surface(lower[1]), contact.Surface(upper[1]), contact.Options(gap=GAP, friction=0.2))
        for side, quads in enumerate((lower[1], upper[1])):
            made.set_surface(side, stiffness=np.full(len(quads), FACET))
        made.set_threads(threads)
        for n in range(5):
            force, k = np.zeros_like(x), np.zeros(len(x))
            result = made.step(x + 1e-3 * n * v, v, force, k, dt=1e-3)
            states.append((force, k))
        assert result.in_contact > 4000
    for one, other in zip(states[:5], states[5:]):
        np.testing.assert_array_equal(one[0], other[0])
        np.testing.assert_array_equal(one[1], other[1])


def test_a_restored_history_goes_on_with_the_same_bits():
    x, made = interface(law="stiffening", friction=0.2)
    start = flight(made, x, 120, mass=0.1, dt=1e-3)[:2]
    saved = made.history()
    assert isinstance(saved, bytes)
    expected = flight(made, x, 60, mass=0.1, dt=1e-3, start=start)[:2]
    _, other = interface(law="stiffening", friction=0.2)
    other.restore(saved)
    np.testing.assert_array_equal(flight(other, x, 60, mass=0.1, dt=1e-3, start=start)[:2], expected)


def test_one_pass_and_both_sides():
    x, lower, _ = squares()
    one_pass = contact.Interface.nodes_to_surface(np.arange(4, 8), lower, contact.Options(gap=GAP), node_stiffness=np.full(4, 2.5))
    one_pass.set_surface(1, stiffness=[FACET])
    result, force, _ = evaluated(one_pass, x)
    assert result.in_contact == 4 and (force[4:, 2] > 0).all()
    for side in (1, -1):
        x[4:, 2] = side * CLEARANCE
        both = contact.Interface.both_sides(np.arange(4, 8), lower, contact.BothSidesOptions(gap=GAP))
        both.set_surface(0, stiffness=np.full(4, 2.5))
        both.set_surface(1, stiffness=[FACET])
        _, force, _ = evaluated(both, x)
        assert (side * force[4:, 2] > 0).all()


def test_an_inactive_facet_lets_go():
    x, made = interface()
    for side in (0, 1):
        made.set_surface(side, active=[False])
    result, force, _ = evaluated(made, x)
    assert result.in_contact == 0 and not force.any()


def test_projections_take_penetrations_away():
    x, lower, upper = squares(clearance=0.05)
    made = contact.Interface.two_surfaces(lower, upper, contact.Options(gap=GAP, initial="project"))
    for side in (0, 1):
        made.set_surface(side, stiffness=[FACET])
    nodes, moves = made.projections(x)
    assert len(nodes) > 0 and moves.shape == (len(nodes), 3)
    x[nodes] += moves
    assert abs(x[4:, 2].mean() - x[:4, 2].mean()) >= GAP - 1e-9


def test_surfaces_know_their_neighbours():
    surface = contact.Surface([[0, 1, 2, 3], [1, 4, 2, -1]], node_keys=[50, 40, 30, 20, 10])
    assert len(surface) == 2
    np.testing.assert_array_equal(surface.nodes, [4, 3, 2, 1, 0])
    np.testing.assert_array_equal(surface.facets, [[0, 1, 2, 3], [1, 4, 2, 2]])
    np.testing.assert_array_equal(surface.neighbours, [[-1, 1, -1, -1], [-1, -1, 0, -1]])
    with pytest.raises(ValueError, match="read-only"):
        surface.facets[0] = 0


def test_inspection_finds_normals_that_look_away():
    x, lower, upper = squares(clearance=0.3)
    away = contact.Surface([[4, 5, 6, 7]])
    assert not [f for f in contact.inspect(lower, upper, x, gap=GAP) if f.severity == "error"]
    first = contact.inspect(lower, away, x, gap=GAP)[0]
    assert first.code == "contact.normals_away" and first.severity == "error" and first.side == 1 and first.advice
    np.testing.assert_array_equal(first.facets, [0])
    below, above = contact.facing(lower, away, x, gap=GAP)
    assert below.facets[0] == 1 and above.facets[0] == -1 and above.fraction == 0.0
    flip_first, flip_second, ambiguous = contact.orient(lower, away, x, gap=GAP)
    assert len(flip_first) == 0 and flip_second.tolist() == [0] and ambiguous == [False, False]
    with pytest.raises(ValueError, match="second names node 9, but x has 8 rows"):
        contact.inspect(lower, [[4, 5, 9]], x)


def answers(findings):
    return [(f.code, f.severity, f.side, f.facets.tolist(), f.nodes.tolist(), f.measure, f.what, f.advice, f.histogram.tolist()) for f in findings]


def test_an_interface_inspects_itself():
    """Interface.inspect() says what the free function says of the same surfaces, in all three kinds."""
    x, lower, upper = squares(clearance=0.15)
    x[4:, :2] *= 7.0
    away = contact.Surface([[4, 5, 6, 7]])
    v, mass = np.zeros_like(x), np.full(8, 1e-3)
    v[4:, 2] = -100.0
    state = dict(v=v, mass=mass, element_step=1e-3)
    for second in (upper, away):
        made = contact.Interface.two_surfaces(lower, second, contact.Options(gap=GAP, stiffness_scale=0.3))
        bare = dict(gap=GAP, stiffness_scale=0.3)
        assert answers(made.inspect(x)) == answers(contact.inspect(lower, second, x, **bare))
        made.set_surface(0, stiffness=[FACET])
        made.set_surface(1, stiffness=[500 * FACET])
        stiff = dict(first_stiffness=[FACET], second_stiffness=[500 * FACET])
        own = made.inspect(x, **state, second_outward=[1])
        assert answers(own) == answers(contact.inspect(lower, second, x, **bare, **state, **stiff, second_outward=[1]))
        assert {"contact.size_ratio", "contact.stiffness_ratio"} <= {f.code for f in own} or second is away
        wide = contact.InspectionLimits(size_ratio=1e3, stiffness_ratio=1e3)
        assert answers(made.inspect(x, limits=wide)) == answers(contact.inspect(lower, second, x, **bare, **stiff, limits=wide))
    nodes = np.arange(4, 8)
    one = contact.Interface.nodes_to_surface(nodes, lower, contact.Options(gap=GAP))
    both = contact.Interface.both_sides(nodes, lower, contact.BothSidesOptions(gap=GAP))
    for made in (one, both):
        made.set_surface(1, stiffness=[0.0])
        found = made.inspect(x)
        assert answers(found) == answers(contact.inspect(nodes, lower, x, gap=GAP, second_stiffness=[0.0], both_sides=made is both))
        assert "contact.no_stiffness" in {f.code for f in found}
    for arguments, words in (((x[:7],), "x must have at least 8 rows"), ((x, x[:5]), "v has")):
        with pytest.raises(ValueError, match=words):
            one.inspect(arguments[0], v=arguments[1] if len(arguments) > 1 else None)
    with pytest.raises(ValueError, match="2 values of outward for 1 facets"):
        made.inspect(x, second_outward=[1, 1])


def members_of(struct, header):
    """Names of the data members of a C++ structure of plain members, in their order."""
    text = re.sub(r"//[^\n]*", "", (ROOT / "include" / "abut" / "contact" / header).read_text(encoding="utf-8"))
    body = text[text.index(f"struct {struct} {{"):]
    body = body[body.index("{") + 1:body.index("\n};")]
    body = re.sub(r"<[^<>]*>|\benum class \w+ \{[^}]*\}", "", body.partition("[[nodiscard]]")[0])  # functions come last
    names = []
    for statement in body.split(";"):
        if statement.strip():
            names += [part.split("=")[0].split()[-1] for part in re.sub(r"\{[^}]*\}", "", statement).split(",") if part.split()]
    return names


CHANGED = {"stiffness_scale": 0.7, "friction": 0.25, "tangential_ratio": 0.3, "gap": 0.6, "automatic_gap": True, "birth": 0.5, "death": 2.0, "start_duration": 0.1,
           "shear_limit": 7.0, "damping": 0.35, "initial": "offset", "depth_limit": 0.9, "node_gap": [0.1, 0.2], "facet_gap": [0.3],
           "gap_max": 5.0, "node_size": [1.0, 2.0], "facet_size": [3.0], "stiffness": "series", "stiffness_min": 1.0, "stiffness_max": 9.0,
           "friction_form": "incremental", "friction_viscosity": 0.4, "largest_penetration": 0.8, "step_minimum": 1e-6, "step_scale": 0.5,
           "reference_step": True, "switch_correction": False, "all_pieces": True, "law": "constant", "edges": "plain",
           "one_pass_half_stiffness": True, "triangle_third_node_twice": True, "reference_friction": True, "area_ratio_projection": True,
           "unlimited_depth": True, "limits_step": False, "model": "renard", "c": [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], "share": 0.5,
           "frequency": 3.0, "aspect_ratio": 2.0, "warp_degrees": 3.0, "size_ratio": 5.0, "stiffness_ratio": 6.0, "concave_degrees": 7.0,
           "gap_of_size": 0.8, "steps_through_gap": 9.0}
STRUCTURES = {"Options": "options.hpp", "Rules": "options.hpp", "BothSidesOptions": "both_sides.hpp", "FrictionLaw": "friction_law.hpp",
              "FrictionFilter": "friction_law.hpp", "InspectionLimits": "inspect.hpp"}


@pytest.mark.parametrize("name", STRUCTURES)
def test_every_option_of_the_library_can_be_given_and_read(name):
    """The members of the C++ structure are the arguments of the Python class and its properties; what is given is read back."""
    members, cls = members_of(name, STRUCTURES[name]), getattr(contact, name)
    written = (ROOT / "src" / "contact" / "record" / "fields.hpp").read_text(encoding="utf-8")
    listed = re.search(r"LikeA<" + name + r"> T>\s+void fields.*?auto& \[([^\]]*)\]", written, re.DOTALL)
    if listed:  # the list that the compiler holds against the structure: nothing was overlooked above
        assert len(members) == len(listed.group(1).split(","))
    arguments = re.search(r"__init__\((.*)\) -> None", cls.__init__.__doc__).group(1)
    said = re.findall(r"(\w+): ", arguments)
    assert sorted(said[1:]) == sorted(members)
    assert sorted(n for n in vars(cls) if isinstance(vars(cls)[n], property)) == sorted(members)
    friction = {"friction_law": contact.FrictionLaw("darmstadt", [1.0, 2.0]), "filter": contact.FrictionFilter(0.5),
                "rules": contact.Rules(law="constant")}
    values = {n: CHANGED[n] for n in members if n not in friction}
    made, assigned = cls(**values), cls(**({"gap": 1.0} if name == "BothSidesOptions" else {}))
    for n, value in values.items():
        setattr(assigned, n, value)
        for read in (getattr(made, n), getattr(assigned, n)):
            assert np.array_equal(read, value) if isinstance(value, list) else read == value, n
    for n in set(members) & set(friction):
        setattr(assigned, n, friction[n])
        for given in (cls(**values, **{n: friction[n]}), assigned):
            inside = {"friction_law": "model", "filter": "share", "rules": "law"}[n]
            assert getattr(getattr(given, n), inside) == getattr(friction[n], inside)
    untouched, first = cls(**({"gap": CHANGED["gap"]} if name == "BothSidesOptions" else {})), cls(**values)
    assert all(not np.array_equal(getattr(untouched, n), getattr(first, n)) for n in values if (name, n) != ("BothSidesOptions", "gap"))


def test_sizes_of_nodes_and_facets_limit_the_gap():
    """Gap of a pair: max(gap, min(node_gap + facet_gap, gap_max, node_size + facet_size)) (Igap 3); F = K P without damping."""
    x, lower, _ = squares(clearance=0.3)
    forces = []
    for limit in (1e30, 0.2):
        options = contact.BothSidesOptions(gap=0.1, damping=0.0, friction_viscosity=0.0, switch_correction=False, node_gap=[0.25] * 4,
                                           facet_gap=[0.25], node_size=[limit] * 4, facet_size=[limit])
        made = contact.Interface.both_sides(np.arange(4, 8), lower, options)
        made.set_surface(1, stiffness=[FACET])
        forces.append(evaluated(made, x)[1][4:, 2])
    assert (forces[0] > forces[1]).all() and (forces[1] > 0.0).all()
    with pytest.raises(ValueError, match="node_size and facet_size come with node_gap"):
        contact.BothSidesOptions(gap=0.1, node_size=[1.0], facet_size=[1.0])


def test_a_log_is_replayed_with_the_same_bits(tmp_path):
    """The log begins in the middle of a flight, with history; a replay makes the same forces, results and stiffness."""
    x, made = interface(law="stiffening", friction=0.2)
    start = flight(made, x, 120, mass=0.1, dt=1e-3)[:2]
    log = tmp_path / "impact.calls"
    made.record(log, "test, job 7")
    recorded = flight(made, x, 60, mass=0.1, dt=1e-3, start=start)
    made.stop_recording()
    steps = []
    replayed = contact.replay(log, steps.append)
    assert (replayed.label, replayed.kind, replayed.nodes, replayed.facets) == ("test, job 7", "two surfaces", 8, 2)
    assert (replayed.steps, replayed.different, replayed.first_different) == (60, 0, -1)
    assert [s.number for s in steps] == list(range(60)) and all(s.same for s in steps)
    assert steps[-1].replayed.elastic == recorded[2].elastic and steps[-1].dt == 1e-3
    np.testing.assert_array_equal(steps[-1].recorded.normal_force, recorded[2].normal_force)
    x, other = interface(law="stiffening", friction=0.2)
    flight(other, x, 120, mass=0.1, dt=1e-3)
    np.testing.assert_array_equal(flight(other, x, 60, mass=0.1, dt=1e-3, start=start)[:2], recorded[:2])  # recording changes nothing


def test_logs_that_are_refused(tmp_path):
    x, made = interface()
    log = tmp_path / "contact.calls"
    made.record(log)
    flight(made, x, 5, mass=0.1, dt=1e-3)
    made.stop_recording()
    made.stop_recording()  # the second time it does nothing
    whole = log.read_bytes()
    log.write_bytes(whole[:-7])
    with pytest.raises(ValueError, match="record"):
        contact.replay(log)
    log.write_bytes(b"not a log")
    with pytest.raises(ValueError):
        contact.replay(log)
    with pytest.raises(FileNotFoundError, match="nowhere"):
        contact.replay(tmp_path / "nowhere.calls")
    with pytest.raises(FileNotFoundError, match="nowhere"):
        made.record(tmp_path / "nowhere" / "contact.calls")
    log.write_bytes(whole)
    with pytest.raises(KeyError):  # an exception of the callback comes through
        contact.replay(log, lambda step: {}["no"])


def test_arrays_of_the_host_are_used_in_place():
    """Forces arrive in the caller's memory, slices of a larger array too; a float64 array in C order is not copied to be read."""
    x, made = interface()
    larger = np.zeros((2, 8, 3))
    made.search(x, np.zeros_like(x))
    made.evaluate(x, np.zeros_like(x), larger[1], np.zeros(8))
    assert not larger[0].any() and larger[1].any()
    surface = contact.Surface([[0, 1, 2, 3]])
    assert np.shares_memory(surface.facets, surface.facets) and not surface.facets.flags.writeable


def test_nothing_leaks():
    """Surfaces, interfaces, logs and refused calls, made and dropped: the process does not grow."""
    size = 40
    k = np.arange((size + 1)**2).reshape(size + 1, size + 1)
    quads = np.stack([k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]], axis=-1).reshape(-1, 4)
    line = np.linspace(0, 1, size + 1)
    sheet = np.stack(np.meshgrid(line, line, [0.0], indexing="ij"), axis=-1).reshape(-1, 3)
    x = np.vstack([sheet, sheet + [0, 0, 0.01]])

    def one_round():
        lower, upper = contact.Surface(quads), contact.Surface(quads[:, ::-1] + len(sheet))
        made = contact.Interface.two_surfaces(lower, upper, contact.Options(gap=0.015))
        for side in (0, 1):
            made.set_surface(side, stiffness=np.full(len(quads), 1.0))
        force, stiffness = np.zeros_like(x), np.zeros(len(x))
        made.step(x, np.zeros_like(x), force, stiffness, dt=1e-3)
        kept = [made.history(), made.nodal_forces(len(x)), made.nodal_contact(len(x)), made.nodal_area(x), lower.neighbours, lower.facets]
        kept.append(contact.inspect(lower, upper, x, gap=0.015))
        with pytest.raises(TypeError):
            made.step(x, x, [[0.0] * 3] * len(x), stiffness, dt=1e-3)
        return len(kept)

    for _ in range(10):
        one_round()
    gc.collect()
    before = held_bytes()
    for _ in range(40):
        one_round()
    gc.collect()
    # One history alone is some 200 kB: a leak of it would be 8 MB.
    assert held_bytes() - before < 4e6
