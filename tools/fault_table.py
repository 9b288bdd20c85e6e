#!/usr/bin/env python3
"""Writes the table of faults in docs/theory/contact.md: what bench/contact_faults measures, between two markers.

usage: fault_table.py PROGRAM            runs it and writes its rows into the page
       fault_table.py --check PROGRAM    exit status 1 if a row is missing or new, or a number differs by more than rounding

Standard library only.
"""
import re
import subprocess
import sys
from pathlib import Path

PAGE = Path(__file__).resolve().parent.parent / "docs" / "theory" / "contact.md"
BEGIN, END = "<!-- contact_faults: begin -->\n", "<!-- contact_faults: end -->\n"
HEAD = "| fault | plain rule | abut |\n|---|---|---|\n"
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def same(a, b):
    """The same words, and numbers that agree to two of their digits (last digit of two printed) or are both rounding (below 1e-7)."""
    if NUMBER.sub("#", a) != NUMBER.sub("#", b):
        return False
    pairs = zip(map(float, NUMBER.findall(a)), map(float, NUMBER.findall(b)))
    return all(abs(x - y) <= 0.12 * max(abs(x), abs(y)) or max(abs(x), abs(y)) < 1e-7 for x, y in pairs)


def main():
    words = sys.argv[1:]
    check = words[:1] == ["--check"]
    if len(words) != 1 + check:
        print(__doc__)
        return 2
    rows = subprocess.run([words[-1]], check=True, capture_output=True, text=True).stdout
    page = PAGE.read_text(encoding="utf-8")
    before, rest = page.split(BEGIN)
    table, after = rest.split(END)
    if not check:
        PAGE.write_text(before + BEGIN + HEAD + rows + END + after, encoding="utf-8")
        return 0
    old, new = table.removeprefix(HEAD).splitlines(), rows.splitlines()
    wrong = [f"the page has {len(old)} rows, the program {len(new)}"] if len(old) != len(new) else []
    wrong += [f"page:    {a}\nmeasured: {b}" for a, b in zip(old, new) if not same(a, b)]
    print("\n".join(wrong) if wrong else f"{len(new)} rows as measured")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
