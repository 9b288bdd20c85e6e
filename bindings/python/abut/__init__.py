"""abut: explicit dynamics with two-surface contact.

    import abut

    model = abut.Model.read("plate_drop_0000.rad")          # or abut.ModelBuilder(...).build(), or Model.from_text
    run = abut.Run(model, threads=2)
    run.advance_to_end()
    print(run.outcome, run.balance.err)
    history = run.history
    history["INTER/1/FNZ"]                                   # a numpy array over history.time

`abut.contact` is the contact library on its own, for hosts that integrate by themselves. Guide: docs/guide/python.md.
"""
try:
    from . import _native  # noqa: F401
except ImportError as error:
    if "partially initialized" not in str(error):
        raise
    raise ImportError("abut's compiled half, abut._native, is not built for this Python (in a clone: scripts/build release abut_python_package)") from None
from . import contact
from ._native import (Balance, ContactFinding, Diagnostic, Edit, ElementTable, InputError, Inspection, InterfaceResult, Model,
                      ModelInterface, ModelSurface, Outcome, Part, Run, RunError, RunFinding, StepController, Units, version)
from .builder import ModelBuilder
from .history import History

__all__ = ["Balance", "ContactFinding", "Diagnostic", "Edit", "ElementTable", "History", "InputError", "Inspection", "InterfaceResult", "Model",
           "ModelBuilder", "ModelInterface", "ModelSurface", "Outcome", "Part", "Run", "RunError", "RunFinding", "StepController", "Units",
           "contact", "version"]
__version__ = version().split()[1].rstrip(",")

for _name in __all__:
    _object = globals()[_name]
    if getattr(_object, "__module__", None) == "abut._native":
        _object.__module__ = "abut"
del _name, _object
