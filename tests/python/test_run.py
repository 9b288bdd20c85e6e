"""Runs: going on, looking, changing, stopping; nothing leaks and nothing blocks."""
import gc
import json
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import abut
from support import DECKS, STEEL, builder, cube, held_bytes, two_blocks


def run_of(**arguments):
    return abut.Run(two_blocks(**arguments).build(), threads=1)


def reference_hash(cycles):
    run = run_of()
    run.advance(cycles)
    return run.state_hash


def test_to_the_end():
    run = run_of()
    assert not run.is_over and run.outcome is None and run.cycle == 0
    assert run.advance_to_end() is False
    assert run.outcome.kind == "finished" and run.time >= 0.05 and run.outcome.cycles == run.cycle
    assert run.advance() is False
    assert abs(run.balance.err) < 0.01 and set(run.balance.terms()) >= {"IE", "KE", "CX"}
    assert run.controller.kind != "none" and run.timings["run"] > 0


def test_the_way_does_not_change_the_bits():
    """Cycle by cycle, with callbacks, to a time and on more threads: the same state."""
    expected = reference_hash(60)
    stepwise = run_of()
    while stepwise.cycle < 60:
        stepwise.advance()
    called = run_of()
    called.advance_to_end(lambda r: r.cycle < 60)
    timed = run_of()
    timed.advance_to(stepwise.time - 1.5 * stepwise.step)
    timed.advance(60 - timed.cycle)
    threaded = abut.Run(two_blocks().build(), threads=2)
    threaded.advance(60)
    for run in (stepwise, called, timed, threaded):
        assert run.cycle == 60 and run.state_hash == expected


def test_a_callback_sees_every_nth_cycle_and_can_stop():
    run = run_of()
    seen = []
    assert run.advance_to_end(lambda r: seen.append(r.cycle) or len(seen) < 3, every=7) is True
    assert seen == [7, 14, 21] and run.cycle == 21 and not run.is_over
    run.advance(39)
    assert run.state_hash == reference_hash(60)


@pytest.mark.parametrize("answer, stops", [(None, False), (True, False), (np.bool_(True), False), (False, True), (np.bool_(False), True)])
def test_a_callback_says_whether_the_run_goes_on(answer, stops):
    run = run_of()
    run.advance_to(1e-4, lambda r: answer)
    assert (run.cycle == 1) == stops


@pytest.mark.parametrize("answer, kind", [(0, "int"), (1.5, "float"), ("no", "str"), (np.array([False]), "numpy.ndarray"), (np.int64(0), "numpy.int64")])
def test_other_answers_of_a_callback_are_refused(answer, kind):
    run = run_of()
    with pytest.raises(TypeError, match=f"a value of type {kind}, expected None or True to go on, False to stop"):
        run.advance_to_end(lambda r: answer)
    assert run.cycle == 1 and not run.is_over
    run.advance(59)
    assert run.state_hash == reference_hash(60)


@pytest.mark.parametrize("call, words", [
    (lambda run: run.advance(-1), "cycles must be 0 or more"),
    (lambda run: run.advance_to(float("nan")), "time must be a number"),
    (lambda run: run.advance_to_end(every=0), "every must be 1 or more"),
])
def test_ways_that_lead_nowhere_are_refused(call, words):
    run = run_of()
    with pytest.raises(ValueError, match=words):
        call(run)
    assert run.cycle == 0


def test_an_exception_of_a_callback_leaves_the_run_where_it_is():
    run = run_of()

    def fail(r):
        if r.cycle == 10:
            raise LookupError("as planned")

    with pytest.raises(LookupError, match="as planned"):
        run.advance_to_end(fail)
    assert run.cycle == 10 and not run.is_over
    run.advance(50)
    assert run.state_hash == reference_hash(60)


def test_views_follow_the_run_and_cannot_be_written():
    run = run_of()
    positions, masses = run.positions, run.masses
    before = positions.copy()
    run.advance(30)
    np.testing.assert_array_equal(positions, run.positions)
    assert np.shares_memory(positions, run.positions) and not np.array_equal(before, positions)
    np.testing.assert_allclose(positions - run.displacements, run.model.coordinates, atol=1e-15)
    assert masses.sum() == pytest.approx(2 * 7.8e-6, rel=1e-12)
    for view in (positions, run.velocities, run.accelerations, run.contact_forces, run.displacements, masses):
        with pytest.raises(ValueError, match="read-only"):
            view[0] = 0
    del run
    gc.collect()
    assert np.isfinite(positions).all()


def test_history_is_what_the_file_says(tmp_path):
    with abut.Run(two_blocks().build(), output=tmp_path / "out") as run:
        run.advance_to_end()
    history, file = run.history, abut.History.read(tmp_path / "out")
    assert history.names == file.names and history.names[0] == "time"
    np.testing.assert_allclose(file.table, history.table, rtol=1e-8, atol=1e-12)
    assert len(history.time) > 90 and set(history.find("INTER/1/F?Z")) == {"INTER/1/FNZ", "INTER/1/FTZ"}
    assert np.abs(history["INTER/1/FNZ"]).max() > 0
    np.testing.assert_array_equal(history.structured()["GLOBAL/KE"], history["GLOBAL/KE"])
    assert list(history) == history.names and sum(1 for column in history.values() if len(column) == len(history.time)) == len(history)
    with pytest.raises(KeyError, match="FNQ"):
        history["INTER/1/FNQ"]
    assert json.loads((tmp_path / "out" / "run.json").read_text())["outcome"]


def test_history_before_the_first_cycle_has_columns_and_no_rows():
    run = run_of()
    before = run.history
    assert before.table.shape == (0, len(before.names)) and before.time.shape == (0,)
    run.advance()
    assert run.history.names == before.names and len(run.history.time) == 1
    with pytest.raises(RuntimeError, match="record_history=False"):
        abut.Run(two_blocks().build(), record_history=False).history


def test_a_row_of_the_history_without_its_end_is_left_out(tmp_path):
    """The file of a run that was killed, or goes on: the last line may be cut inside a number."""
    file = tmp_path / "a_th.csv"
    file.write_text("time,GLOBAL/KE\n0,1\n0.5,2.25\n")
    np.testing.assert_array_equal(abut.History.read(file).table, [[0, 1], [0.5, 2.25]])
    file.write_text("time,GLOBAL/KE\n0,1\n0.5,2")
    np.testing.assert_array_equal(abut.History.read(tmp_path).table, [[0, 1]])


def test_interfaces_and_fields():
    run = run_of()
    run.advance_to_end(lambda r: r.interfaces[0].in_contact == 0)
    (result,) = run.interfaces
    assert result.id == 1 and result.in_contact > 0 and result.normal_force.shape == (3,)
    names = run.node_field_names()
    assert {"displacement", "contact_force"} <= set(names)
    np.testing.assert_array_equal(run.node_field("displacement"), run.displacements)
    assert run.node_field("mass").shape == (16,)
    assert run.element_field("brick", "stress").shape == (2, 6) and run.element_field("brick", "von_mises").shape == (2,)
    assert run.element_field("shell4", "stress").shape == (0,)
    with pytest.raises(ValueError, match="'heat' is not a field of nodes"):
        run.node_field("heat")


@pytest.mark.parametrize("name", ["lost_over_border", "crossed"])
def test_findings_of_the_run_name_their_nodes(name):
    """What the watch found names all nodes, and the interface's result of that cycle the same ones."""
    path = DECKS / "findings" / name / (name + "_0000.rad")
    run = abut.Run(abut.Model.read(path), threads=1, allow_findings=True)
    seen = {}

    def watch(r):
        (result,) = r.interfaces
        for kind, count, nodes in (("crossed", result.crossed, result.crossed_nodes), ("lost", result.lost, result.lost_nodes)):
            assert nodes.shape == (count,) and nodes.dtype == np.int32
            if count and kind not in seen:
                seen[kind] = (r.cycle, nodes)
        assert (result.deepest_node >= 0) == (result.largest_penetration > 0.0)

    run.advance_to_end(watch)
    kind = {"lost_over_border": "lost", "crossed": "crossed"}[name]
    (found,) = [f for f in run.findings if f.diagnostic.code == "contact." + name]
    assert found.measure == len(found.nodes) > 0 and found.segments.shape == (0, 4)
    np.testing.assert_array_equal(np.sort(found.nodes), np.sort(run.model.node_ids[seen[kind][1]]))
    assert seen[kind][0] - found.cycle in (0, 1)
    assert run.interfaces[0].lost == 0 and run.interfaces[0].lost_nodes.shape == (0,)


def test_a_checkpoint_goes_on_with_the_same_bits(tmp_path):
    model = two_blocks().build()
    run = abut.Run(model, threads=1)
    run.advance(30)
    run.save(tmp_path / "here")
    loaded = abut.Run.load(model, tmp_path / "here", threads=2)
    assert loaded.cycle == 30 and loaded.state_hash == run.state_hash
    loaded.advance(30)
    assert loaded.state_hash == reference_hash(60)
    np.testing.assert_array_equal(loaded.velocities, loaded.node_field("velocity"))
    with pytest.raises(abut.RunError):
        abut.Run.load(two_blocks(friction=0.3).build(), tmp_path / "here")
    with pytest.raises(abut.RunError):
        abut.Run.load(model, tmp_path / "not there")


def test_a_checkpoint_touches_no_other_file(tmp_path):
    run = run_of()
    for name in ("notes.txt", "notes_previous.txt"):
        (tmp_path / name).write_text("mine")
    run.advance()
    run.save(tmp_path / "notes.txt")
    assert (tmp_path / "notes_previous.txt").read_text() == "mine"
    assert abut.Run.load(run.model, tmp_path / "notes.txt").cycle == 1
    (tmp_path / "folder").mkdir()
    with pytest.raises(abut.RunError, match="Is a directory"):
        run.save(tmp_path / "folder")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["folder", "notes.txt", "notes_previous.txt"]


def test_a_run_folder_is_resumed(tmp_path):
    deck = two_blocks().write(tmp_path / "deck")
    run = abut.Run(abut.Model.read(deck), output=tmp_path / "out", checkpoint_every=10, threads=1)
    run.advance(45)
    run.finish()
    resumed = abut.Run.resume(tmp_path / "out", threads=1)
    assert 0 < resumed.cycle <= 45
    resumed.advance_to_end()
    whole = abut.Run(abut.Model.read(deck), output=tmp_path / "whole", threads=1)
    whole.advance_to_end()
    assert resumed.state_hash == whole.state_hash
    np.testing.assert_array_equal(abut.History.read(tmp_path / "out").table, abut.History.read(tmp_path / "whole").table)
    with pytest.raises(abut.RunError):
        abut.Run.resume(tmp_path / "deck")
    with pytest.raises(abut.RunError, match="a new run in its folder would remove it"):
        abut.Run.load(abut.Model.read(deck), tmp_path / "out" / "twoblocks.rst", output=tmp_path / "out")
    assert (tmp_path / "out" / "twoblocks.rst").exists()


def test_a_resumed_run_has_the_rows_of_a_run_that_kept_none(tmp_path):
    deck = two_blocks().write(tmp_path / "deck")
    run = abut.Run(abut.Model.read(deck), output=tmp_path / "out", checkpoint_every=37, record_history=False, threads=1)
    run.advance_to_end()
    (tmp_path / "deck" / "twoblocks_0002.rad").write_text(f"/RUN/twoblocks/2\n{1.5 * run.model.end_time}\n")
    resumed = abut.Run.resume(tmp_path / "out", threads=1)
    before = resumed.history.table.copy()
    np.testing.assert_array_equal(before, abut.History.read(tmp_path / "out").table)
    resumed.advance_to_end()
    table = abut.History.read(tmp_path / "out").table
    assert len(table) > len(before) > 10
    np.testing.assert_array_equal(resumed.history.table, table)

    # From a checkpoint with rows behind it.
    (tmp_path / "out" / "twoblocks.rst").unlink()
    again = abut.Run.resume(tmp_path / "out", threads=1)
    assert len(before) <= len(again.history.time) < len(table) and again.history.time[-1] < again.time
    again.advance_to_end()
    np.testing.assert_array_equal(again.history.table, table)


def test_a_gradual_start_pushes_an_overlap_apart_over_its_time():
    """A cube 0.02 deep in another's gap: at once it is thrown out, gradually the interface puts in work SW and less speed."""
    def overlap(**settings):
        b = builder()
        low, high = b.nodes(cube()), b.nodes(cube((0.0, 0.0, 1.03)))
        steel, solid = b.elastic(**STEEL), b.solid_property()
        for ids in (low, high):
            b.part(solid, steel, bricks=[ids])
        b.contact(b.surface(low[[[4, 5, 6, 7]]]), b.surface(high[[[3, 2, 1, 0]]]), gap=0.05)
        b.fix(low)
        b.engine(0.02)
        run = abut.Run(b.build(), threads=1, allow_findings=True, **settings)
        run.advance_to_end()
        return run

    at_once, gradual = overlap(), overlap(interfaces={1: "start=0.015"})
    assert at_once.interfaces[0].sw == 0.0 and gradual.interfaces[0].sw > 0.0
    assert gradual.velocities[8:, 2].mean() < 0.7 * at_once.velocities[8:, 2].mean()


def test_finish_closes_the_files(tmp_path):
    run = abut.Run(two_blocks().build(), output=tmp_path)
    run.advance(25)
    outcome = run.finish("enough")
    assert (outcome.kind, outcome.message, outcome.cycles) == ("stopped", "enough", 25)
    assert run.is_over and run.output == tmp_path
    assert json.loads((tmp_path / "run.json").read_text())
    assert len(abut.History.read(tmp_path).time) == len(run.history.time)


def test_one_run_at_a_time_writes_in_a_folder(tmp_path):
    older = abut.Run(two_blocks().build(), output=tmp_path, threads=1, checkpoint_every=2)
    older.advance(5)
    listing = (tmp_path / "twoblocks.out").read_text()
    for newer in (lambda: abut.Run(two_blocks().build(), output=tmp_path), lambda: abut.Run.resume(tmp_path)):
        with pytest.raises(abut.RunError, match="a Run that was not finished"):
            newer()
    assert (tmp_path / "twoblocks.out").read_text() == listing
    older.finish()
    run = abut.Run(two_blocks().build(), output=tmp_path, threads=1)
    run.advance_to_end()
    manifest = (tmp_path / "run.json").read_text()
    del older, run
    gc.collect()
    assert (tmp_path / "run.json").read_text() == manifest and json.loads(manifest)["outcome"]["kind"] == "finished"


def test_other_threads_go_on_meanwhile():
    run = run_of(end=1e3)
    counted, refused = 0, None
    cycled = threading.Event()
    worker = threading.Thread(target=run.advance_to_end, args=(lambda r: cycled.set() or True,), kwargs={"every": 20})
    worker.start()
    assert cycled.wait(60)
    deadline = time.monotonic() + 60
    while counted < 1000 and time.monotonic() < deadline:
        counted += 1
        try:
            run.time
        except RuntimeError as error:
            refused = str(error)
    assert worker.is_alive()
    run.interrupt()
    worker.join(60)
    assert not worker.is_alive()
    assert counted == 1000 and "goes on in another thread" in refused
    assert run.outcome.kind == "interrupted" and run.cycle > 0


def test_runs_in_two_threads_do_not_disturb_each_other():
    runs = [run_of(), run_of(friction=0.5)]
    alone = [run_of(), run_of(friction=0.5)]
    for run in alone:
        run.advance_to_end()
    workers = [threading.Thread(target=run.advance_to_end) for run in runs]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join(60)
    assert [run.state_hash for run in runs] == [run.state_hash for run in alone]
    assert runs[0].state_hash != runs[1].state_hash


INTERRUPTED = """
import json, sys
sys.path.insert(0, {folder!r})
import abut
from support import two_blocks
run = abut.Run(two_blocks(end=1e3).build(), output={output!r}, threads=1)
run.advance()
calls = 0
def callback(r):
    global calls
    calls += 1
    if calls == 1:
        print("going", flush=True)
if not {with_callback}:
    print("going", flush=True)
try:
    run.advance_to_end(callback if {with_callback} else None)
except KeyboardInterrupt:
    print(json.dumps([run.is_over, run.outcome.kind, run.cycle, calls]))
"""


@pytest.mark.parametrize("with_callback", [False, True])
def test_ctrl_c_raises_and_leaves_complete_files(tmp_path, with_callback):
    script = INTERRUPTED.format(folder=str(Path(__file__).parent), output=str(tmp_path),
                                with_callback=with_callback)
    with subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "going\n"
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=60)
    over, kind, cycle, calls = json.loads(out)
    assert over and kind == "interrupted" and cycle > 0 and (calls > 0) == with_callback
    written = json.loads((tmp_path / "run.json").read_text())
    assert "interrupted" in json.dumps(written["outcome"])
    assert len(abut.History.read(tmp_path).time) > 0


def test_a_file_in_the_way_is_a_run_error(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(abut.RunError):
        abut.Run(two_blocks().build(), output=tmp_path / "file")


@pytest.mark.parametrize("arguments, words", [
    (dict(threads=-1), "threads must be 0"),
    (dict(threads=4097), r"threads must be 0 \(all\) to 4096"),
    (dict(hash_every=-1), "hash_every must be 0"),
    (dict(checkpoint_every=-1), "checkpoint_every must be 0"),
    (dict(rules="other"), "rules is 'other'"),
])
def test_settings_that_are_refused(arguments, words):
    with pytest.raises(ValueError, match=words):
        abut.Run(two_blocks().build(), **arguments)


def test_threads_that_cannot_be_made_are_a_run_error():
    """In a process with memory for the stacks of a few threads."""
    script = ("import resource, abut, support; model = support.two_blocks().build()\n"
              "size = 100_000_000 + resource.getpagesize() * int(open('/proc/self/statm').read().split()[0])\n"
              "resource.setrlimit(resource.RLIMIT_AS, (size, size)); abut.Run(model, threads=1000)")
    done = subprocess.run([sys.executable, "-c", script], env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
                          capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and "RunError: cannot make 1000 threads, only " in done.stderr, done.stderr


def test_recorded_contact_is_replayed(tmp_path):
    """record_contact keeps an interface's inputs between two times; the replay has the same bits, the run has them too."""
    model = two_blocks().build()
    run = abut.Run(model, threads=1, output=tmp_path, record_contact={1: (0.01, 0.02)})
    run.advance_to_end()
    steps = []
    replayed = abut.contact.replay(tmp_path / "twoblocks_contact_1.calls", steps.append)
    assert replayed.steps > 0 and replayed.different == 0
    assert all(0.01 <= s.time <= 0.02 for s in steps)
    plain = abut.Run(model, threads=1)
    plain.advance_to_end()
    assert plain.state_hash == run.state_hash


@pytest.mark.parametrize("arguments, error, words", [
    (dict(record_contact={1: None}), ValueError, "record_contact needs an output folder"),
    (dict(record_contact={9: None}, output=True), abut.RunError, "9"),
    (dict(record_contact={1: (0.01, 0.005)}, output=True), abut.RunError, "from 0.01 to 0.005: no time is between these"),
    (dict(record_contact={1: (-1.0, 0.005)}, output=True), abut.RunError, "no time is between these"),
    (dict(record_contact={1: (0.0, float("nan"))}, output=True), abut.RunError, "no time is between these"),
    (dict(record_contact={1: (float("inf"), float("inf"))}, output=True), abut.RunError, "no time is between these"),
    (dict(interfaces={9: "start=1"}), abut.RunError, "9"),
    (dict(interfaces={1: "law=soft"}), abut.RunError, "law is 'soft', expected one of stiffening, constant"),
    (dict(interfaces={"some": "law=constant"}), abut.RunError, "neither an interface id nor 'all'"),
])
def test_interfaces_that_are_not_there(tmp_path, arguments, error, words):
    if "output" in arguments:
        arguments = {**arguments, "output": tmp_path}
    with pytest.raises(error, match=words):
        abut.Run(two_blocks().build(), **arguments)


def test_settings_of_an_interface_reach_it(tmp_path):
    """Damping shows as DW; `all` is overruled by a choice that names the interface; run.json keeps what was set."""
    model = two_blocks().build()
    plain, damped = abut.Run(model, threads=1), abut.Run(model, threads=1, interfaces={"all": "damping=0.5"}, output=tmp_path / "damped")
    none = abut.Run(model, threads=1, interfaces={"all": "damping=0.5", 1: "damping=0"})
    for run in (plain, damped, none):
        run.advance_to_end()
    assert plain.interfaces[0].dw == 0.0 and damped.interfaces[0].dw > 0.0 and none.state_hash == plain.state_hash
    assert json.loads(next((tmp_path / "damped").glob("run.json")).read_text())["settings"]["interfaces"] == ["all:damping=0.5"]
    # The surfaces are the whole hulls of two cubes: the faces that meet, and those that look away from the other cube.
    assert plain.interfaces[0].facing == pytest.approx([0.5, 0.5]) and plain.interfaces[0].peak_approach >= plain.interfaces[0].largest_approach


def test_the_inspection_knows_of_choices():
    """The first step is that of the choices; an interface that is not there is refused as by a run."""
    model = two_blocks().build()
    assert model.inspect(interfaces={1: "start=0.01"}, with_step=True).first_step > 0
    with pytest.raises((ValueError, RuntimeError), match="9"):
        model.inspect(interfaces={9: "start=0.01"}, with_step=True)


def test_nothing_leaks():
    """Models, runs, views, histories and exceptions, made and dropped: the process does not grow."""
    text, engine = two_blocks().starter_text(), [two_blocks().engine_text()]

    def one_round():
        model = abut.Model.from_text(text, engine)
        run = abut.Run(model, threads=2)
        run.advance_to_end(lambda r: r.cycle < 30)
        kept = [run.positions, run.history, run.interfaces, run.balance, model.coordinates, run.node_field("velocity")]
        with run.edit() as e:
            e.velocities += 1.0
        try:
            abut.Model.from_text(text.replace("/BCS/1", "/BEAM/1"), engine)
        except abut.InputError as error:
            kept.append(error.diagnostics)
        return len(kept)

    for _ in range(30):
        one_round()
    gc.collect()
    before = held_bytes()
    for _ in range(150):
        one_round()
    gc.collect()
    # One state of this model is some 100 kB: a leak of any of them would be 15 MB.
    assert held_bytes() - before < 4e6
