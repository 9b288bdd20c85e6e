#!/usr/bin/env python3
"""A host with its own integrator in numpy: a net of springs falls on a tilted table, and abut.contact does the contact.

usage: own_integrator.py

The host owns positions, velocities, masses and springs. Each step it asks the interface who can touch (search), lets it add
forces and nodal stiffness into its arrays (evaluate), takes a step that is stable with both (h <= sqrt(2 m/K)), and says so
(commit). At the end the energies must add up: kinetic + springs + stored in contact + friction work. Units: kg, m, s.
"""
import numpy as np

from abut import contact

N = 12                        # nodes along a side of the net
SIDE, MASS, SPRING = 0.2, 0.4, 5e3
GAP, FRICTION = 4e-3, 0.2


def grid(n, side):
    """Nodes (n^2, 3) of a square in z = 0 around the origin, facets with normals up."""
    line = side * (np.arange(n) / (n - 1) - 0.5)
    x = np.stack(np.meshgrid(line, line, [0.0], indexing="ij"), axis=-1).reshape(-1, 3)
    k = np.arange(n * n).reshape(n, n)
    return x, np.stack([k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]], axis=-1).reshape(-1, 4)


def springs_of(facets):
    """Every side and both diagonals of every facet once."""
    pairs = np.concatenate([facets[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3))])
    return np.unique(np.sort(pairs, axis=1), axis=0)


def main():
    net, net_facets = grid(N, SIDE)
    table, table_facets = grid(8, 2 * SIDE)
    tilt = np.radians(10.0)
    table = table @ np.array([[np.cos(tilt), 0, np.sin(tilt)], [0, 1, 0], [-np.sin(tilt), 0, np.cos(tilt)]]).T
    net[:, 2] += 0.03

    x = np.vstack([net, table])
    v = np.zeros_like(x)
    v[:len(net)] = (0.0, 0.0, -2.0)
    mass = np.concatenate([np.full(len(net), MASS / len(net)), np.zeros(len(table))])   # 0: a node that cannot move
    inverse = np.where(mass > 0, 1 / np.where(mass > 0, mass, 1), 0)

    springs = springs_of(net_facets)
    length = np.linalg.norm(x[springs[:, 1]] - x[springs[:, 0]], axis=1)
    own_stiffness = np.bincount(springs.ravel(), minlength=len(x)) * 2 * SPRING    # bound of the row sums

    falling = contact.Surface(net_facets[:, ::-1])             # looks down
    standing = contact.Surface(table_facets + len(net))        # looks up
    interface = contact.Interface.two_surfaces(standing, falling, contact.Options(gap=GAP, friction=FRICTION))
    interface.set_surface(0, stiffness=np.full(len(standing), 20 * SPRING))
    interface.set_surface(1, stiffness=np.full(len(falling), 20 * SPRING))
    for finding in contact.inspect(standing, falling, x, v=v, mass=mass, gap=GAP):
        print(f"{finding.severity}: {finding.what}")

    time, step, steps, touched = 0.0, 0.0, 0, 0
    kinetic_start = 0.5 * (mass[:, None] * v**2).sum()
    while time < 0.06:
        force, stiffness = np.zeros_like(x), np.zeros(len(x))
        arm = x[springs[:, 1]] - x[springs[:, 0]]
        now = np.linalg.norm(arm, axis=1)
        pull = (SPRING * (now - length) / now)[:, None] * arm
        np.add.at(force, springs[:, 0], pull)
        np.add.at(force, springs[:, 1], -pull)

        interface.search(x, v, mass=mass, time=time)
        result = interface.evaluate(x, v, force, stiffness, mass=mass, time=time)
        touched = max(touched, result.in_contact)

        moving = mass > 0
        new_step = 0.9 * np.sqrt(2 * mass[moving] / (own_stiffness + stiffness)[moving]).min()
        new_step = min(new_step, result.kinematic_step, 1.1 * step if step > 0.0 else np.inf)   # steps grow slowly
        v_old = v
        v = v + 0.5 * (step + new_step) * inverse[:, None] * force
        interface.commit(new_step)
        x = x + new_step * v
        time, step, steps = time + new_step, new_step, steps + 1

    kinetic = 0.5 * (mass[:, None] * v_old * v).sum()     # at t^n: from the half steps before and after
    elastic = 0.5 * SPRING * ((now - length)**2).sum()
    total = kinetic + elastic + result.elastic + result.friction_work
    error = (total - kinetic_start) / kinetic_start
    print(f"{steps} steps; up to {touched} nodes in contact, {result.in_contact} at the end")
    print(f"kinetic {kinetic:.4f} J, springs {elastic:.4f} J, contact {result.elastic:.4f} J, friction {result.friction_work:.4f} J")
    print(f"start {kinetic_start:.4f} J: the balance is off by {error:.2%}, of which the contact reports {result.made / kinetic_start:.2%}")
    if touched == 0 or abs(error) > 0.02:
        raise SystemExit("the energies do not add up")


if __name__ == "__main__":
    main()
