#!/usr/bin/env python3
"""What a Python callback costs per cycle, and a look at the state in it.

usage: PYTHONPATH=build/release/python python3 bench/python_callback.py [--cycles N] [--repeat N]

The same small model (two bricks in contact) runs without a callback, with an empty one, with one that reads the balance, and with one
that takes a view of the velocities. CPU time of the process, one thread; the smallest of the repeated runs counts, the
difference to the run without a callback is the cost.
"""
import argparse
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "python"))
import abut
from support import two_blocks

CALLBACKS = {
    "none": None,
    "one that counts": lambda run: None,
    "run.balance.err": lambda run: run.balance.err < 1.0,
    "run.velocities (a view)": lambda run: run.velocities is not None,
    "run.interfaces[0]": lambda run: run.interfaces[0].in_contact >= 0,
}


def seconds_per_cycle(callback, cycles):
    run = abut.Run(two_blocks(end=1e3).build(), threads=1, record_history=False)
    run.advance(100)
    start = time.process_time()
    if callback is None:
        run.advance(cycles)
    else:
        left = [cycles]

        def count(r):
            callback(r)
            left[0] -= 1
            return left[0] > 0

        run.advance_to_end(count)
    return (time.process_time() - start) / cycles


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cycles", type=int, default=20000)
    parser.add_argument("--repeat", type=int, default=5)
    arguments = parser.parse_args()
    print(abut.version())
    best = {name: float("inf") for name in CALLBACKS}
    for _ in range(arguments.repeat):
        for name, callback in CALLBACKS.items():
            best[name] = min(best[name], seconds_per_cycle(callback, arguments.cycles))
    print(f"{'callback':26} {'us per cycle':>13} {'its cost':>9}")
    for name, seconds in best.items():
        print(f"{name:26} {seconds * 1e6:13.2f} {(seconds - best['none']) * 1e6:9.2f}")


if __name__ == "__main__":
    main()
