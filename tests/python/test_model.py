"""Models: read, looked at, refused."""
import gc
import pickle

import numpy as np
import pytest

import abut
from support import DECKS, two_blocks

PLATES = DECKS / "plate_drop" / "plate_drop_0000.rad"


@pytest.fixture(scope="module")
def plates():
    return abut.Model.read(PLATES)


def test_a_deck_says_what_it_holds(plates):
    assert plates.name == "plate_drop"
    assert plates.node_ids.shape == (433,) and plates.node_ids.dtype == np.int64
    assert plates.coordinates.shape == (433, 3)
    shells = plates.elements("shell4")
    assert len(shells) == 377 and shells.nodes.shape == (377, 4) and shells.nodes.max() == 432
    assert len(plates.elements("brick")) == 0 and plates.elements("brick").nodes.shape == (0, 8)
    assert [part.id for part in plates.parts] == [1, 2]
    assert plates.units.length == 1.0 and plates.end_time == 1e-3
    (contact,) = plates.interfaces
    assert (contact.type, contact.friction, contact.gap) == ("TYPE3", 0.1, 0.002)
    assert plates.surfaces[contact.surfaces[1]].facets.shape == (121, 4)
    assert plates.path == PLATES and len(plates.files) == 2


def test_ids_become_indices(plates):
    np.testing.assert_array_equal(plates.node_ids[plates.node_indices([145, 355])], [145, 355])
    with pytest.raises(KeyError, match="there is no node 5000"):
        plates.node_indices([1, 5000])
    with pytest.raises(TypeError, match="ids does not hold integers"):
        plates.node_indices([1.5])


def test_arrays_are_views_that_cannot_be_written(plates):
    assert np.shares_memory(plates.coordinates, plates.coordinates)
    for array in (plates.coordinates, plates.node_ids, plates.elements("shell4").nodes):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_arrays_outlive_the_model():
    model = two_blocks().build()
    coordinates, nodes, kept = model.coordinates, model.elements("brick").nodes, model.coordinates.copy()
    del model
    gc.collect()
    np.testing.assert_array_equal(coordinates, kept)
    assert nodes.shape == (2, 8)


def test_inspection_with_the_first_step(plates):
    inspection = plates.inspect(with_step=True)
    # Plates of 0.24^2 x 0.004 aluminium and 0.12^2 x 0.002 steel
    np.testing.assert_allclose(inspection.part_masses, [0.24**2 * 0.004 * 2700, 0.12**2 * 0.002 * 7800], rtol=1e-12)
    assert inspection.first_step > 0 and inspection.controller.kind in ("shell4", "node", "interface")


def test_what_a_worker_process_raises_comes_back_whole():
    with pytest.raises(abut.InputError) as caught:
        abut.Model.from_text("/BEGIN\n", ["x"])
    error = pickle.loads(pickle.dumps(caught.value))
    assert type(error) is abut.InputError and str(error) == str(caught.value) and error.diagnostics
    for back, sent in zip(error.diagnostics, caught.value.diagnostics, strict=True):
        for name in ("severity", "code", "message", "file", "line", "keyword", "field", "columns"):
            assert getattr(back, name) == getattr(sent, name)
        assert str(back) == str(sent)


def test_every_fault_of_a_deck_at_once():
    text = two_blocks().starter_text().replace("210.0", "2x10").replace("/BCS/1", "/BEAM/1")
    with pytest.raises(abut.InputError) as caught:
        abut.Model.from_text(text, [two_blocks().engine_text()], name="faulty")
    errors = [d for d in caught.value.diagnostics if d.severity == "error"]
    assert len(errors) >= 2 and isinstance(caught.value, ValueError)
    (young,) = [d for d in errors if d.code == "deck.bad_real"]
    assert young.keyword == "/MAT/ELAST/1" and young.columns == (1, 20) and young.field == "E"
    assert text.splitlines()[young.line - 1].split()[0] == "2x10"
    assert str(young) in str(caught.value) and "faulty_0000.rad" in str(young)


def test_a_later_engine_deck_of_another_run():
    b = two_blocks()
    def later(name):
        return abut.Model.from_text(b.starter_text(), [b.engine_text(), f"/RUN/{name}/2\n1e3\n"], run=2)
    assert later(b.name).run_number == 2 and later(b.name.upper()).run_number == 2
    with pytest.raises(abut.InputError, match=f"'other' is another run than '{b.name}'.*; write /RUN/{b.name}/2"):
        later("other")


def test_a_file_that_is_not_there():
    with pytest.raises(abut.InputError, match="nowhere_0000.rad"):
        abut.Model.read("nowhere_0000.rad")


def test_reversed_normals_are_found_and_turned():
    deck = DECKS / "findings" / "normals_away" / "normals_away_0000.rad"
    model = abut.Model.read(deck)
    (finding,) = [f for f in model.inspect().contact if f.severity == "error"]
    assert finding.code == "contact.normals_away" and finding.advice
    assert np.isin(finding.segments, model.node_ids).all() and len(finding.segments) > 0
    with pytest.raises(abut.InputError, match="normals") as caught:
        abut.Run(model)
    assert "contact.normals_away" in [d.code for d in caught.value.diagnostics]
    turned = abut.Model.read(deck, orient=True)
    assert not [f for f in turned.inspect().contact if f.severity == "error"]


@pytest.mark.parametrize("call, words", [
    (lambda m: m.elements("beam"), "kind is 'beam', expected one of 'shell4'"),
    (lambda m: m.inspect(rules="mine"), "rules is 'mine', expected one of 'standard', 'reference'"),
    (lambda m: m.inspect(rules="soft"), "rules is 'soft'"),
])
def test_words_that_are_none(plates, call, words):
    with pytest.raises(ValueError, match=words):
        call(plates)
