#!/usr/bin/env python3
"""Checks that the documentation holds together.

usage: check_docs.py [ROOT]

- Links between Markdown files lead to files, and to headings, that exist.
- Tags such as [Flanagan 1981] or [Bridson et al. 2002] in docs/, include/, src/ and tests/ name an author and the year of an
  entry of docs/references.bib; with a letter (1984a) they are its key.
- Displayed formulas stand apart from each other: without a blank line between them they would be one, which cannot be drawn.
- Every page of docs/ can be reached from docs/index.md.
- docs/theory/statements.md is what tools/statement_table.py writes.
Exit status 1 if something is wrong. Standard library only.
"""
import re
import subprocess
import sys
from pathlib import Path

LINK = re.compile(r"(?<!!)\[[^\]]*\]\(([^)\s]+)\)")
BRACKET = re.compile(r"\[([^\[\]]*)\]")
NAME = r"[A-Z][A-Za-z-]+"
TAG = re.compile(rf"^\s*({NAME})(?:,? (?:and |& )?{NAME})*(?: et al\.?)?,? \(?([12]\d{{3}}[a-z]?)\b")
FENCE = re.compile(r"^(```|~~~)")


def prose(text):
    """Lines outside of fenced code."""
    inside = False
    for number, line in enumerate(text.splitlines(), 1):
        if FENCE.match(line.strip()):
            inside = not inside
        elif not inside:
            yield number, line


def anchors(text):
    """Anchors of the headings, as GitHub forms them."""
    found = set()
    for _, line in prose(text):
        match = re.match(r"#+\s+(.*)", line)
        if match:
            heading = re.sub(r"[`*\[\]]", "", match.group(1)).strip().lower()
            found.add(re.sub(r"[^\w\- ]", "", heading).replace(" ", "-"))
    return found


def references(path):
    """Keys of a bibliography, and every author with the year."""
    known = set()
    for entry in re.split(r"\n(?=@)", path.read_text(encoding="utf-8")) if path.is_file() else ():
        key = re.match(r"@\w+\{([^,\s]+),", entry)
        author = re.search(r"author = \{(.*?)\},\s", entry)
        year = re.search(r"year = \{(\d{4})\}", entry)
        if key:
            known.add(key.group(1))
        if author and year:
            surnames = [name.split(",")[0].strip().split(" ")[-1] for name in author.group(1).split(" and ")]
            known |= {surname + year.group(1) for surname in surnames}
    return known


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent.parent).resolve()
    pages = sorted((root / "docs").rglob("*.md")) + sorted(root.glob("*.md"))
    text = {page: page.read_text(encoding="utf-8") for page in pages}
    faults = []

    links = {}
    for page in pages:
        targets = links[page] = set()
        for number, line in prose(text[page]):
            for link in LINK.findall(line):
                if re.match(r"[a-z]+:", link):
                    continue
                name, _, anchor = link.partition("#")
                target = (page.parent / name).resolve() if name else page
                where = f"{page.relative_to(root)}:{number}"
                if not target.exists():
                    faults.append(f"{where}: {link}: no such file")
                    continue
                targets.add(target)
                if anchor and target in text and anchor not in anchors(text[target]):
                    faults.append(f"{where}: {link}: no such heading")

    for page in pages:
        lines = text[page].splitlines()
        faults += [f"{page.relative_to(root)}:{n}: a formula follows another without a blank line" for n, (a, b) in enumerate(zip(lines, lines[1:]), 2)
                   if a.endswith("$$") and a != "$$" and b.startswith("$$")]

    reached, front = set(), {root / "docs" / "index.md"}
    while front:
        page = front.pop()
        reached.add(page)
        front |= {target for target in links.get(page, ()) if target in text} - reached
    faults += [f"{page.relative_to(root)}: not reached from docs/index.md" for page in pages if page not in reached and page.is_relative_to(root / "docs")]

    known = references(root / "docs" / "references.bib")
    sources = [path for folder in ("include", "src", "tests", "apps", "bench") for path in sorted((root / folder).rglob("*"))
               if path.suffix in (".hpp", ".cpp")]
    for path in [page for page in pages if page.is_relative_to(root / "docs")] + sources:
        content = text.get(path) or path.read_text(encoding="utf-8")
        for number, line in prose(content) if path in text else enumerate(content.splitlines(), 1):
            for group in BRACKET.findall(line):
                for author, year in (match.groups() for part in group.split(";") if (match := TAG.match(part))):
                    if author + year not in known:
                        faults.append(f"{path.relative_to(root)}:{number}: [{author} {year}] is not in docs/references.bib")

    table = root / "tools" / "statement_table.py"
    if table.is_file() and subprocess.run([sys.executable, str(table), "--check"], stdout=subprocess.DEVNULL).returncode != 0:
        faults.append("docs/theory/statements.md is not current: run tools/statement_table.py")

    print("\n".join(faults + [f"{len(pages)} pages, {len(known)} names of references: {len(faults)} faults"]))
    return 1 if faults or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
