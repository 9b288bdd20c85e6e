"""Models that the tests share: small, made from arrays."""
import ctypes
import os
from pathlib import Path

import numpy as np

import abut

ROOT = Path(__file__).resolve().parents[2]
DECKS = ROOT / "examples" / "decks"
STEEL = dict(density=7.8e-6, young=210.0, poisson=0.3)  # kg, mm, ms


def cube(corner=(0.0, 0.0, 0.0), size=1.0):
    """(8, 3) nodes of a brick: bottom face, then top face, both counter-clockwise seen from above."""
    unit = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], dtype=float)
    return np.asarray(corner) + size * unit


def builder(name="model"):
    return abut.ModelBuilder(name, units=("kg", "mm", "ms"))


def one_cube(b):
    """A free cube. @returns ids of its nodes"""
    ids = b.nodes(cube())
    b.part(b.solid_property(), b.elastic(**STEEL), bricks=[ids])
    return ids


def two_blocks(end=0.05, speed=-10.0, friction=0.2):
    """The deck examples/decks/twoblocks from arrays: a cube falls on a clamped one."""
    b = builder("twoblocks")
    low, high = b.nodes(cube()), b.nodes(cube((0.0, 0.0, 1.1)))
    steel, solid = b.elastic(**STEEL), b.solid_property()
    first, second = (b.part(solid, steel, bricks=[ids]) for ids in (low, high))
    b.contact(b.surface(parts=[first]), b.surface(parts=[second]), friction=friction)
    b.fix(low)
    b.velocity(high, (0.0, 0.0, speed))
    b.history(interfaces=[1])
    b.history(parts=[first, second])
    b.engine(end, step_scale=0.67, history_interval=0.0005)
    return b


def held_bytes():
    """What the process holds: its resident memory, or the blocks in use where the address sanitizer counts them (it keeps freed ones for a while)."""
    try:
        count = ctypes.CDLL(None).__sanitizer_get_current_allocated_bytes
    except AttributeError:
        with open("/proc/self/statm", encoding="ascii") as stream:
            return int(stream.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    count.restype = ctypes.c_size_t
    return count()
