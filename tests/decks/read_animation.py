#!/usr/bin/env python3
"""Open an animation of abut as ParaView would and check it: every state of the index, every field, every value.

usage: /usr/bin/python3 read_animation.py NAME.pvd [--states N] [--end T] [--field NAME ...] [--nonzero NAME ...]

Needs VTK's Python module (Debian: python3-vtk9). For each state: the file can be read, its time is the index's, times increase,
points are the same as in the first state and no cell appears that the state before did not have, the fields that every state has are there with their number of components, and
every value is finite. --states: exact number of states. --end: time at or just after which the last one is (within
a hundredth). --field: a further field that must be there. --nonzero: a field that must
have a value other than zero in some state. Exit status 0 when all holds, else 1 with the first fault.
"""
import argparse
import array
import math
import os
import sys
import xml.etree.ElementTree as ElementTree

import vtk

NODE_FIELDS = {"node_id": 1, "displacement": 3, "velocity": 3, "contact_force": 3, "contact_pressure_normal": 3, "contact_pressure_tangential": 3, "contact_gap": 1,
               "contact_penetration": 1, "contact_state": 1}
MAY_BE_NAN = {"contact_gap"}  # where no other surface is near
CELL_FIELDS = {"element_id": 1, "part_id": 1, "plastic_strain": 1, "von_mises": 1, "stress": 6}


class Fault(Exception):
    pass


def require(condition, message):
    if not condition:
        raise Fault(message)


def read_index(path):
    """[(time, file)] of a .pvd."""
    root = ElementTree.parse(path).getroot()
    require(root.tag == "VTKFile" and root.get("type") == "Collection", f"{path} is not a VTK collection")
    folder = os.path.dirname(os.path.abspath(path))
    return [(float(d.get("timestep")), os.path.join(folder, d.get("file"))) for d in root.iter("DataSet")]


def read_grid(path):
    require(os.path.exists(path), f"{path} is missing")
    errors = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: errors.append(path))
    reader.SetFileName(path)
    reader.Update()
    require(not errors and reader.GetErrorCode() == 0, f"{path} cannot be read")
    return reader.GetOutput()


def values_of(vtk_array):
    """All values of a VTK array in a row. Not by numpy: Debian's VTK module does not bring it."""
    if vtk_array.GetNumberOfValues() == 0:
        return array.array("d")
    view = memoryview(vtk_array)
    return array.array(view.format, view.tobytes())


def check_arrays(path, attributes, expected, count):
    """Presence and shape of the expected arrays; finiteness of all. Returns {name: largest magnitude}."""
    for name, components in expected.items():
        field = attributes.GetArray(name)
        require(field is not None, f"{path}: no field '{name}'")
        require(field.GetNumberOfComponents() == components, f"{path}: field '{name}' has {field.GetNumberOfComponents()} components, not {components}")
    largest = {}
    for k in range(attributes.GetNumberOfArrays()):
        field = attributes.GetArray(k)
        require(field.GetNumberOfTuples() == count, f"{path}: field '{field.GetName()}' has {field.GetNumberOfTuples()} values, not {count}")
        values = values_of(field)
        finite = [v for v in values if not (field.GetName() in MAY_BE_NAN and math.isnan(v))]
        require(math.isfinite(sum(map(abs, finite))), f"{path}: field '{field.GetName()}' has values that are not finite")
        largest[field.GetName()] = float(max(map(abs, finite), default=0.0))
    return largest


def check(arguments):
    index = read_index(arguments.index)
    require(index, f"{arguments.index} names no state")
    if arguments.states is not None:
        require(len(index) == arguments.states, f"{arguments.index} names {len(index)} states, not {arguments.states}")
    times = [t for t, _ in index]
    require(all(a < b for a, b in zip(times, times[1:])), f"{arguments.index}: times do not increase")
    first, alive = None, set()
    largest = {}
    for time, path in index:
        grid = read_grid(path)
        stored = grid.GetFieldData().GetArray("TimeValue")
        require(stored is not None and stored.GetValue(0) == time, f"{path}: its time is not {time!r} as the index says")
        points, cells = grid.GetPointData(), grid.GetCellData()
        found = check_arrays(path, points, NODE_FIELDS, grid.GetNumberOfPoints())
        found.update(check_arrays(path, cells, CELL_FIELDS, grid.GetNumberOfCells()))
        for name in arguments.field:
            require(name in found, f"{path}: no field '{name}'")
        nodes, elements = values_of(points.GetArray("node_id")), set(zip(values_of(cells.GetArray("element_id")), values_of(cells.GetArray("part_id"))))
        if first is None:
            first, alive = (nodes, elements), elements
        require(nodes == first[0], f"{path}: other nodes than in the first state")
        require(elements <= alive, f"{path}: elements come back")
        alive = elements
        for name, value in found.items():
            largest[name] = max(largest.get(name, 0.0), value)
    for name in arguments.nonzero:
        require(largest.get(name, 0.0) > 0.0, f"field '{name}' is zero in every state")
    if arguments.end is not None:
        last = index[-1][0]
        require(arguments.end <= last <= 1.01 * arguments.end, f"{arguments.index} ends at {last}, not at {arguments.end}")
    print(f"{arguments.index}: {len(index)} states, {len(first[0])} points, {len(first[1])} cells at first, {len(alive)} at last")
    for name in sorted(largest):
        print(f"  {name:<30} largest magnitude {largest[name]:.6g}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("index")
    parser.add_argument("--states", type=int)
    parser.add_argument("--end", type=float)
    parser.add_argument("--field", nargs="*", default=[])
    parser.add_argument("--nonzero", nargs="*", default=[])
    try:
        check(parser.parse_args())
    except Fault as fault:
        print(fault, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
