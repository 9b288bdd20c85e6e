#!/usr/bin/env python3
"""Runs the code of the documentation: every fenced block of README.md, CONTRIBUTING.md, docs/ and examples/README.md.

usage: check_docs_code.py [--full] [--abut PROGRAM] [--library FILE] [--python PROGRAM --python-path FOLDER] [--only PAGE ...] [--list]

What a block is follows from its info string and from a comment right above it, and no block is passed over:

  console        lines that start with "$ " are run ("> " goes on); what stands below each must be what it prints. "..." stands for anything,
                 in a line or as a line of its own; the number of blanks does not count.
  sh, bash       run from the first to the last line; must succeed
  python         run; must succeed. With --python-path, by the interpreter of --python and with the module abut; without it, blocks that import
                 abut are left out, and counted
  cpp            compiled and linked with abut::contact, and run
  text, none     a drawing or a form; must not contain commands

  <!-- code: output -->            what the block above printed (same rules as console)
  <!-- code: excerpt of FILE -->   not run, but every line stands in FILE in this order ("..." skips lines; indentation and
                                   the slashes of a comment do not count)
  <!-- code: fails -->             the commands of the block end with an error, as the page says
  <!-- code: full, REASON -->      run with --full only (./check --full), and named with its reason without it
  <!-- code: full in a clone, REASON -->      the same, in a clone of the repository named abut (with what is not committed), which such blocks share
  <!-- code: full beside a clone, REASON -->  the same, where that clone lies; REPOSITORY stands for this repository

The blocks of a page share one temporary folder, which has the repository's examples/, scripts/ and tools/; abut is on the PATH. What would open a
window is read instead: `paraview FILE` opens every state of FILE with VTK's own reader (tests/decks/read_animation.py).
With --full only the blocks marked "full" are run, pages that clone first.
Exit status 1 if a block does not do what it says. Standard library only.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGES = ["README.md", "CONTRIBUTING.md", "examples/README.md"]
LIMIT = 300  # seconds for one block
FULL_LIMIT = 5400  # seconds for one that is marked "full"
CLONE = {"full in a clone": "abut", "full beside a clone": "."}


class Block:
    def __init__(self, page, line, language, directive, text):
        self.page, self.line, self.language, self.directive, self.text = page, line, language, directive, text

    @property
    def where(self):
        return f"{self.page}:{self.line}"


def blocks_of(page, text):
    lines, k, directive = text.splitlines(), 0, ""
    while k < len(lines):
        fence = re.match(r"(\s*)(`{3,}|~{3,})\s*(\w*)", lines[k])
        comment = re.match(r"\s*<!-- code: (.*?) -->\s*$", lines[k])
        if fence:
            indent, mark, language = fence.groups()
            start = k
            k += 1
            body = []
            while k < len(lines) and not lines[k].strip().startswith(mark):
                body.append(lines[k][len(indent):] if lines[k].startswith(indent) else lines[k])
                k += 1
            yield Block(page, start + 1, language, directive, "\n".join(body))
            directive = ""
        elif comment:
            directive = comment.group(1)
        elif re.match(r" {4}\S", lines[k]) and (k == 0 or not lines[k - 1].strip()) and not inside_list(lines, k):
            yield Block(page, k + 1, "indented", "", lines[k])
        elif lines[k].strip():
            directive = ""
        k += 1


def inside_list(lines, k):
    """Whether an indented line belongs to a list above it."""
    above = next((line for line in reversed(lines[:k]) if line.strip() and not line.startswith("  ")), "")
    return re.match(r"\s*([-*+]|\d+\.) ", above) is not None


def pattern_of(line):
    return ".*".join(re.escape(part) for part in line.split("..."))


def output_differs(expected, printed):
    """What is wrong with a printed text, or None. A line "..." stands for any number of lines."""
    want, got = ([re.sub(" +", " ", line).rstrip() for line in text.strip("\n").splitlines()] for text in (expected, printed))
    position, free = 0, False
    for line in want:
        if line.strip() == "...":
            free = True
            continue
        pattern = re.compile(pattern_of(line) + "$")
        found = next((k for k in range(position, len(got) if free else min(position + 1, len(got))) if pattern.match(got[k])), None)
        if found is None:
            actual = got[position] if position < len(got) else "(nothing more)"
            return f"the page says:  {line}\n    it printed:     {actual}"
        position, free = found + 1, False
    if position < len(got) and not free:
        return f"it printed more than the page says: {got[position]}"
    return None


def commands_of(text):
    """[(command, expected output)] of a console block; a command goes on in lines that start with "> "."""
    found, lines, k = [], text.splitlines(), 0
    while k < len(lines):
        if not lines[k].startswith("$ "):
            if not found:
                raise ValueError("a console block starts with a line '$ command'")
            found[-1][1].append(lines[k])
            k += 1
            continue
        command = lines[k][2:]
        k += 1
        while k < len(lines) and lines[k].startswith("> "):
            command += "\n" + lines[k][2:]
            k += 1
        found.append((command, []))
    return [(command, "\n".join(output)) for command, output in found]


class Runner:
    def __init__(self, program, library, place, python=sys.executable, python_path=None, full=False):
        """@param place a folder for what all pages share"""
        self.program, self.library, self.place, self.python, self.python_path = Path(program), library, Path(place), python, python_path
        self.full, self.limit = full, FULL_LIMIT if full else LIMIT
        programs = self.place / "programs"
        programs.mkdir()
        window = programs / "paraview"
        window.write_text(f'#!/bin/sh\nexec /usr/bin/python3 {ROOT}/tests/decks/read_animation.py "$@"\n')
        window.chmod(0o755)
        (programs / "python3").symlink_to(shutil.which(python))
        self.environment = {**os.environ, "PATH": f"{programs}:{self.program.parent}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8"}
        if not full:
            self.environment["ABUT_SKIP_DEPS"] = "1"
        if python_path and not full:
            self.environment["PYTHONPATH"] = str(python_path)
        self.printed = ""

    def clone(self):
        """The clone that pages share: what is committed, and over it what is not."""
        clone = self.place / "abut"
        if not clone.exists():
            subprocess.run(["git", "clone", "--quiet", ROOT, clone], check=True)
        changed = subprocess.run(["git", "ls-files", "--modified", "--others", "--exclude-standard"], cwd=ROOT, check=True, text=True, stdout=subprocess.PIPE)
        for name in changed.stdout.splitlines():
            if (ROOT / name).is_file():
                (clone / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(ROOT / name, clone / name)

    def run_in_full(self, block, folder):
        kind, _, reason = block.directive.partition(", ")
        if kind not in ("full", *CLONE) or not reason:
            return "unknown", f"unknown directive: {block.directive}"
        if not self.full:
            return "only in full", None
        if kind in CLONE and "git clone" not in block.text:
            self.clone()
        text = block.text.replace("REPOSITORY", str(ROOT)) if kind == "full beside a clone" else block.text
        return "run", self.call(["bash", "-e", "-o", "pipefail", "-c", text], self.place / CLONE[kind] if kind in CLONE else folder)

    def call(self, command, folder, may_fail=False):
        done = subprocess.run(command, cwd=folder, env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, errors="replace", timeout=self.limit)
        self.printed = done.stdout
        if (done.returncode != 0) != may_fail:
            tail = "\n    ".join(done.stdout.splitlines()[-8:])
            return f"ended with {done.returncode}:\n    {tail}"
        return None

    def console(self, block, folder, may_fail):
        printed = ""
        for command, expected in commands_of(block.text):
            fault = self.call(["bash", "-e", "-o", "pipefail", "-c", command], folder, may_fail)
            printed = self.printed
            fault = fault or output_differs(expected, printed)
            if fault:
                return f"$ {command}\n    {fault}"
        return None

    def compile(self, block, folder):
        if not self.library:
            return "needs --library"
        (folder / "page.cpp").write_text(block.text + "\n")
        compiler = os.environ.get("CXX", "c++")
        libraries = [str(self.library), str(self.library.with_name("libabut_simd.a"))]  # contact's own, and what it needs
        return self.call([compiler, "-std=c++20", "-Wall", "-Wextra", "-I", str(ROOT / "include"), "page.cpp", *libraries, "-o", "page"], folder) \
            or self.call(["./page"], folder)

    def run(self, block, folder):
        """@returns (kind, fault or None)"""
        directive, language = block.directive, block.language
        if directive.startswith("full"):
            return self.run_in_full(block, folder)
        if self.full:
            return "left out", None
        if directive == "output":
            return "outputs", output_differs(block.text, self.printed)
        if directive.startswith("excerpt of "):
            return "excerpts", excerpt_differs(block.text, ROOT / directive.removeprefix("excerpt of ").strip())
        if directive not in ("", "fails"):
            return "unknown", f"unknown directive: {directive}"
        may_fail = directive == "fails"
        if language == "console":
            return "run", self.console(block, folder, may_fail)
        if language in ("sh", "bash"):
            if not self.python_path and re.search(r"\bimport abut\b", block.text):
                return "left out", None
            return "run", self.call(["bash", "-e", "-o", "pipefail", "-c", block.text], folder, may_fail)
        if language == "python":
            if not self.python_path and re.search(r"^(import|from) abut\b", block.text, flags=re.M):
                return "left out", None
            return "run", self.call([self.python, "-c", block.text], folder, may_fail)
        if language == "cpp":
            return "run", self.compile(block, folder)
        if language in ("text", ""):
            command = re.search(r"^(\$ |abut (run|check)|cmake |\./)", block.text, flags=re.M)
            return "drawings", f"holds a command: {command.group(0)}" if command else None
        if language == "indented":
            return "unknown", "code by indentation: put it between ``` so that it says what it is"
        return "unknown", f"a block in '{language}' can only be an excerpt: <!-- code: excerpt of FILE -->"


def excerpt_differs(text, path):
    if not path.is_file():
        return f"{path.relative_to(ROOT)} does not exist"
    def plain(line):
        return re.sub(r"^//+\s*", "", line.strip())

    source, position, free = [plain(line) for line in path.read_text(encoding="utf-8").splitlines()], 0, True
    for line in filter(None, map(plain, text.splitlines())):
        if line == "...":
            free = True
            continue
        found = next((k for k in range(position, len(source)) if source[k] == line), None)
        blank = found is not None and all(not entry for entry in source[position:found])
        if found is None or not (free or blank):
            return f"{path.relative_to(ROOT)} does not hold this line here: {line}"
        position, free = found + 1, False
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--abut", default=ROOT / "build/release/bin/abut", type=Path)
    parser.add_argument("--library", type=Path, default=ROOT / "build/release/libabut_contact.a")
    parser.add_argument("--python", default=sys.executable, help="interpreter that the module abut is for")
    parser.add_argument("--python-path", type=Path, help="folder of the package abut, e.g. build/release/python")
    parser.add_argument("--full", action="store_true", help="run the blocks marked full, and no others: minutes")
    parser.add_argument("--only", nargs="*", default=[], help="pages, as paths from the root of the repository")
    parser.add_argument("--list", action="store_true", help="say what each block is")
    args = parser.parse_args()

    with tempfile.TemporaryDirectory(prefix="abut-docs-") as place:
        return check(args, place)


def furnish(folder, runner):
    """What the page's blocks find around them."""
    for name in ("examples", "scripts", "tools"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "docs/verification").mkdir(parents=True)
    (folder / "build/release").mkdir(parents=True)
    (folder / "build/release/bin").symlink_to(runner.program.parent)
    if runner.python_path:
        (folder / "build/release/python").symlink_to(runner.python_path)


def check(args, place):
    runner = Runner(args.abut.resolve(), args.library.resolve() if args.library.is_file() else None, place, args.python,
                    args.python_path.resolve() if args.python_path else None, args.full)
    pages = []
    for path in [ROOT / name for name in PAGES] + sorted((ROOT / "docs").rglob("*.md")):
        page = path.relative_to(ROOT).as_posix()
        if not args.only or page in args.only:
            pages.append((page, list(blocks_of(page, path.read_text(encoding="utf-8")))))
    if args.full:  # a clone can be made only where there is none
        pages.sort(key=lambda entry: not any(block.directive.startswith("full") and "git clone" in block.text for block in entry[1]))
    counts, faults, later = {}, [], []
    for _, blocks in pages:
        with tempfile.TemporaryDirectory(prefix="page-", dir=place) as temporary:
            folder = Path(temporary)
            if any(block.language in ("console", "sh", "bash", "python") for block in blocks):
                furnish(folder, runner)
            for block in blocks:
                start = time.monotonic()
                try:
                    kind, fault = runner.run(block, folder)
                except (ValueError, OSError, subprocess.SubprocessError) as error:
                    kind, fault = "run", str(error)
                counts[kind] = counts.get(kind, 0) + 1
                if kind == "only in full":
                    later.append(f"{block.where}: {block.directive}")
                if args.list or (args.full and kind == "run"):
                    print(f"{block.where}: {kind} {block.language}, {time.monotonic() - start:.0f} s", flush=True)
                if fault:
                    faults.append(f"{block.where}: {fault}")
    print("\n".join([*faults, *later]))
    print(", ".join(f"{count} {kind}" for kind, count in sorted(counts.items())) + f": {len(faults)} faults")
    return 1 if faults or not counts else 0


if __name__ == "__main__":
    sys.exit(main())
