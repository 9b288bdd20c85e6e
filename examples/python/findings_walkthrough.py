#!/usr/bin/env python3
# A walk through the findings of the contact inspection. Runs as a script, or cell by cell (# %%) in Jupyter, VS Code or Spyder.

# %% [markdown]
# A contact definition can be wrong in ways that no solver error shows: normals that look away let nodes through, a gap that is large
# for the mesh pushes from the start. abut looks at every interface before the first step and says what it sees: a code, a severity, the
# nodes or segments concerned, and what to do. This walk asks it about some decks of examples/decks/findings, one fault each.

# %%
from pathlib import Path

import numpy as np

import abut
from abut import contact

here = Path(__file__).resolve().parent if "__file__" in globals() else Path.cwd()
decks = here.parent / "decks" / "findings"
print(abut.version())

# %% [markdown]
# ## A deck whose normals are wrong
# `inspect` does not run anything: it looks at the geometry with the masses and speeds of the first cycle.

# %%
model = abut.Model.read(decks / "normals_away" / "normals_away_0000.rad")
inspection = model.inspect()
for finding in inspection.contact:
    print(f"{finding.severity:8} {finding.code}")
    print(f"         {finding.what}")
    print(f"         {finding.advice}")

# %% [markdown]
# A finding names what it is about in the deck's ids, as arrays: to plot them, to select them, to put them into a set.

# %%
worst = inspection.contact[0]
centres = model.coordinates[model.node_indices(worst.segments.ravel())].reshape(-1, 4, 3).mean(axis=1)
print(f"{len(worst.segments)} segments of surface {worst.surface_id}, around {centres.mean(axis=0).round(3)}")
print(f"{worst.measure_name}: {worst.measure:.3g}")

# %% [markdown]
# Errors stop a run, with everything that was found in the exception.

# %%
try:
    abut.Run(model)
except abut.InputError as error:
    print(f"refused: {len(error.diagnostics)} findings")
    print(error.diagnostics[0])

# %% [markdown]
# ## Let abut turn them
# Where the answer is clear, `orient` turns the segments; a note says which. `write_deck` would keep the result as a deck.

# %%
turned = abut.Model.read(decks / "normals_away" / "normals_away_0000.rad", orient=True)
for note in turned.findings:
    print(note)
print([finding.severity for finding in turned.inspect().contact])
run = abut.Run(turned)
run.advance_to_end()
print(run.outcome)

# %% [markdown]
# ## All of them in a table
# Every folder of examples/decks/findings has the name of the finding that it shows (docs/findings/index.md explains each).

# %%
print(f"{'deck':24} {'what the inspection says':60}")
for folder in sorted(decks.iterdir()):
    starter = folder / f"{folder.name}_0000.rad"
    if not starter.is_file():
        continue
    try:
        found = abut.Model.read(starter).inspect().contact
        said = ", ".join(dict.fromkeys(f"{f.severity} {f.code.removeprefix('contact.')}" for f in found)) or "nothing"
    except abut.InputError as error:
        said = "refused: " + ", ".join(dict.fromkeys(d.code for d in error.diagnostics if d.severity == "error"))
    print(f"{folder.name:24} {said:60}")

# %% [markdown]
# ## The same for a mesh that is not in a deck
# `abut.contact.inspect` takes facets and coordinates as arrays, for hosts that embed the contact library.

# %%
square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
x = np.vstack([np.column_stack([square, np.full(4, height)]) for height in (0.0, 0.1)])
for finding in contact.inspect([[0, 1, 2, 3]], [[4, 5, 6, 7]], x, gap=0.05):
    print(f"{finding.severity}: {finding.what} facets {finding.facets.tolist()} of side {finding.side}")
flip = contact.orient([[0, 1, 2, 3]], [[4, 5, 6, 7]], x, gap=0.05)
print("turn of the second:", flip[1].tolist())
