#!/usr/bin/env python3
"""docs/guide/profiles.md lists every choice on which the two profiles differ, in tables that are whole.

usage: test_profiles_page.py ROOT

The choices are the members of `Profile` (src/core/profile.hpp) and of contact `Rules` (include/abut/contact/options.hpp). Standard library
only. Exit status 1 with what is missing.
"""
import re
import sys
from pathlib import Path

IMPLIED = {"reference_contact"}  # asks for the contact rules, which are listed one by one


def members(path, struct):
    """Names of the data members with an initial value."""
    text = path.read_text(encoding="utf-8")
    body = text[text.index(f"struct {struct} {{"):]
    body = body[:body.index("\n};")]
    return [name for name in re.findall(r"^  [\w:]+ (\w+) = [^;]*;", body, re.MULTILINE)]


def main():
    root = Path(sys.argv[1])
    lines = (root / "docs/guide/profiles.md").read_text(encoding="utf-8").splitlines()
    faults = []
    for number, line in enumerate(lines):
        if line.startswith("|") and (number == 0 or not lines[number - 1].startswith("|")) and not lines[number + 1].startswith("|---"):
            faults.append(f"docs/guide/profiles.md:{number + 1}: a row outside of its table")
    rows = [re.findall(r"`(\w+)`", line.split("|")[1]) for line in lines if line.startswith("|")]
    listed = [row[0] for row in rows if row]
    choices = members(root / "src/core/profile.hpp", "Profile") + members(root / "include/abut/contact/options.hpp", "Rules")
    if len(choices) < 20:
        faults.append(f"only {len(choices)} choices found: the headers are not read as they are written")
    for name in choices:
        if name not in IMPLIED and listed.count(name) != 1:
            faults.append(f"docs/guide/profiles.md: `{name}` has {listed.count(name)} rows, not one")
    faults += [f"docs/guide/profiles.md: `{name}` is no choice of the program" for name in listed if name not in choices]
    print("\n".join(faults) if faults else f"{len(listed)} choices, each with its row")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
