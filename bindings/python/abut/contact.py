"""The contact library on its own: surfaces and interfaces for hosts that integrate by themselves.

    lower, upper = Surface(lower_facets), Surface(upper_facets)
    interface = Interface.two_surfaces(lower, upper, Options(gap=1e-3, friction=0.1))
    interface.set_surface(0, stiffness=E * thickness)                # per facet
    interface.set_surface(1, stiffness=E * thickness)
    interface.search(x, v, mass=m, time=t)                           # every step: who can touch,
    result = interface.evaluate(x, v, force, stiffness, mass=m, time=t)   # adds into the host's arrays,
    h = 0.9 * numpy.sqrt(2 * m / (own_stiffness + stiffness)).min()  # a step that is stable with them
    h = min(h, result.kinematic_step, 1.1 * last)                    # takes no node through the gap, and grows slowly,
    interface.commit(h)                                              # history moves on

Units are the host's, as long as they are consistent.
"""
from ._native.contact import (BothSidesOptions, Facing, Finding, FrictionFilter, FrictionLaw, InspectionLimits, Interface, Options, Replay,
                              ReplayedStep, Rules, StepResult, Surface, facing, inspect, orient, replay)

__all__ = ["BothSidesOptions", "Facing", "Finding", "FrictionFilter", "FrictionLaw", "InspectionLimits", "Interface", "Options", "Replay",
           "ReplayedStep", "Rules", "StepResult", "Surface", "facing", "inspect", "orient", "replay"]

for _name in __all__:
    if isinstance(globals()[_name], type):
        globals()[_name].__module__ = "abut.contact"
del _name
