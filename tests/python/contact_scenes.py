"""Surfaces and interfaces that the tests share."""
import numpy as np

from abut import contact

GAP, CLEARANCE, FACET = 0.2, 0.1, 10.0


def squares(clearance=CLEARANCE):
    """Two unit squares that face each other. @returns x (8, 3), first and second surface"""
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    x = np.vstack([np.column_stack([square, np.full(4, z)]) for z in (0.0, clearance)])
    return x, contact.Surface([[0, 1, 2, 3]]), contact.Surface([[4, 7, 6, 5]])


def interface(law="constant", switch_correction=False, lower_size=1.0, **options):
    x, lower, upper = squares()
    x[:4, :2] = 0.5 + lower_size * (x[:4, :2] - 0.5)
    rules = contact.Rules(law=law, switch_correction=switch_correction)
    made = contact.Interface.two_surfaces(lower, upper, contact.Options(gap=GAP, rules=rules, **options))
    for side in (0, 1):
        made.set_surface(side, stiffness=[FACET])
    return x, made


def sheet(first, n, z, up):
    """n x n nodes over the unit square from index `first` on, and their quadrilaterals, normals up or down."""
    side = np.linspace(0, 1, n)
    x = np.array([(a, b, z) for b in side for a in side])
    corner = first + np.arange(n * n).reshape(n, n)
    quads = np.stack([corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]], axis=-1).reshape(-1, 4)
    return x, quads if up else quads[:, ::-1]
