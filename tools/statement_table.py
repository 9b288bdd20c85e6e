#!/usr/bin/env python3
"""Writes docs/theory/statements.md: every statement of the TYPE3 theory, where abut handles it, and the tests that prove it.

usage: statement_table.py [--check]

Tests name the statement that they prove: a test belongs to T7 when `T7` stands in its name, in the comment directly before
it, or in its body; a comment at the head of a file, before the first test, says what all its tests are about and counts for
the file. Ranges (T16..T18, T16 to T18) count for each. --check: exit status 1 if the file on disk differs. Standard library only.
"""
import re
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs" / "theory" / "statements.md"
STATEMENTS = ROOT / "docs" / "theory" / "statements.txt"
TEST = re.compile(r"^\s*(?:TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\s*\(\s*(\w+)\s*,\s*(\w+)")
NUMBER = re.compile(r"(?<![A-Za-z0-9_])T([1-9]\d?)(?![A-Za-z0-9_.]*\()\b")
RANGE = re.compile(r"(?<![A-Za-z0-9_])T(\d+)\s*(?:\.\.|-|to)\s*T(\d+)\b")
IN_NAME = re.compile(r"(?<![A-Za-z0-9])T(\d{1,2})(?![0-9A-Za-z])")


def mentioned(text):
    numbers = {int(n) for n in NUMBER.findall(text)}
    for first, last in RANGE.findall(text):
        numbers |= set(range(int(first), int(last) + 1))
    return {n for n in numbers if 1 <= n <= 33}


def tests_of(path):
    """{statement: [test names]} of one source file."""
    found = defaultdict(list)
    lines = path.read_text(encoding="utf-8").splitlines()
    starts = [(k, match) for k, line in enumerate(lines) if (match := TEST.match(line))]
    relative = path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else path.name
    if not starts:
        if path.suffix == ".py" or "consumer" in relative:
            for number in mentioned("\n".join(line for line in lines if line.lstrip().startswith(("//", "#", '"""')))):
                found[number].append(relative)
        return found

    def comment_before(k):
        first = k
        while first > 0 and lines[first - 1].lstrip().startswith("//"):
            first -= 1
        return first

    for number in mentioned("\n".join(line for line in lines[:comment_before(starts[0][0])] if line.lstrip().startswith("//"))):
        found[number].append(f"{relative} (all)")
    for at, (k, match) in enumerate(starts):
        end = comment_before(starts[at + 1][0]) if at + 1 < len(starts) else len(lines)
        text = "\n".join(lines[comment_before(k):end])
        numbers = mentioned(text) | {int(n) for n in IN_NAME.findall(match.group(2).replace("_", " "))}
        for number in numbers:
            if 1 <= number <= 33:
                found[number].append(f"{match.group(1)}.{match.group(2)}")
    return found


def read_statements():
    """[(number, statement, where)] from statements.txt: number | statement | where it is handled."""
    table = []
    for line in STATEMENTS.read_text(encoding="utf-8").splitlines():
        if line.strip() and not line.startswith("#"):
            number, statement, where = (field.strip() for field in line.split("|"))
            table.append((int(number[1:]), statement, where))
    return table


def page():
    tests = defaultdict(list)
    for path in sorted((ROOT / "tests").rglob("*")):
        if path.suffix in (".cpp", ".py"):
            for number, names in tests_of(path).items():
                tests[number] += names
    rows = read_statements()
    out = ["# The TYPE3 theory, statement by statement", "",
           "What the theory page of the interface says, in our words, where abut handles it, and which tests prove it. Written by",
           "`tools/statement_table.py` from `statements.txt` and from the tests that name a statement; do not edit.", "",
           "| | statement | where | tests |", "|---|---|---|---|"]
    for number, statement, where in rows:
        names = list(dict.fromkeys(tests[number]))
        out.append(f"| T{number} | {statement} | {where} | {'<br>'.join(f'`{n}`' for n in names) if names else 'none yet'} |")
    proven = sum(1 for number, _, _ in rows if tests[number])
    out += ["", f"{proven} of {len(rows)} statements are named by a test.", ""]
    return "\n".join(out)


def main():
    text = page()
    if sys.argv[1:] == ["--check"]:
        same = PAGE.is_file() and PAGE.read_text(encoding="utf-8") == text
        print("statements.md is current" if same else "statements.md is not what tools/statement_table.py writes")
        return 0 if same else 1
    PAGE.write_text(text, encoding="utf-8")
    print(text.splitlines()[-1])
    return 0


if __name__ == "__main__":
    sys.exit(main())
