#!/usr/bin/env python3
"""Runs the code of the documentation: every fenced block of README.md, CONTRIBUTING.md, docs/ and examples/README.md.

usage: check_docs_code.py [--full] [--abut PROGRAM] [--library FILE] [--python PROGRAM --python-path FOLDER] [--no-npm]
                          [--clones yes|no] [--only PAGE ...] [--except PAGE ...] [--list]

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
  <!-- code: in a clone -->        run in a clone of the repository named abut (with what is not committed), which such blocks share. Its build is
                                   the one that is being tested, and the suite is listed there (docs_clone.py); with --full it is a clone like any
  <!-- code: beside a clone -->    the same, where that clone lies; REPOSITORY stands for this repository
  <!-- code: listed, REASON -->    test programs of the block list the tests that they would run; they run them with --full

The blocks of a page share one temporary folder, which has the repository's examples/, scripts/ and tools/; abut is on the PATH. What would open a
window is read instead: `paraview FILE` opens every state of FILE with VTK's own reader (tests/decks/read_animation.py).
With --full only the blocks of the last three kinds are run, for real: in a fresh clone that is built, and for minutes. Pages that clone come first.
Without a repository around, or npm, or the module, the blocks that need them are left out, and counted.
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

import docs_clone

ROOT = Path(__file__).resolve().parent.parent
PAGES = ["README.md", "CONTRIBUTING.md", "examples/README.md"]
LIMIT = 600  # seconds for one block
FULL_LIMIT = 5400  # seconds with --full
CLONE = {"in a clone": "abut", "beside a clone": "."}


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
    def __init__(self, program, library, place, python=sys.executable, python_path=None, full=False, npm=True):
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
        self.in_clone = {**self.environment}
        if not full:
            docs_clone.clone_programs(self.place / "clone_programs", self.program.parent.parent)
            self.in_clone |= {"PATH": f"{self.place / 'clone_programs'}:{self.environment['PATH']}", "ABUT_BUILD_DIR": str(self.program.parent.parent),
                              "npm_config_prefer_offline": "true"}
        if python_path and not full:
            self.environment["PYTHONPATH"] = str(python_path)
        self.repository, self.npm = docs_clone.is_repository(ROOT), npm and shutil.which("npm") is not None
        self.printed = ""

    def run_in_clone(self, block):
        needs_module = "python" in block.text
        if not self.repository or ("npm " in block.text and not self.npm) or (needs_module and not self.python_path):
            return "left out", None
        if "git clone" not in block.text:
            docs_clone.make_clone(ROOT, self.place / "abut")
        text = block.text.replace("REPOSITORY", str(ROOT))
        return "run", self.call(["bash", "-e", "-o", "pipefail", "-c", text], self.place / CLONE[block.directive], environment=self.in_clone)

    def run_listed(self, block, folder):
        if not self.full:
            programs = folder / "build/release/bin"
            programs.unlink()
            docs_clone.list_tests(programs, self.program.parent)
        fault = self.call(["bash", "-e", "-o", "pipefail", "-c", block.text], folder)
        if not self.full:
            shutil.rmtree(programs)
            programs.symlink_to(self.program.parent)
        return "run" if self.full else "listed", fault

    def call(self, command, folder, may_fail=False, environment=None):
        done = subprocess.run(command, cwd=folder, env=environment or self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, errors="replace", timeout=self.limit)
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
        flags = os.environ.get("CXXFLAGS", "").split()  # a sanitizer's library needs the sanitizer's flag
        return self.call([compiler, "-std=c++20", "-Wall", "-Wextra", *flags, "-I", str(ROOT / "include"), "page.cpp", *libraries, "-o", "page"], folder) \
            or self.call(["./page"], folder)

    def run(self, block, folder):
        """@returns (kind, fault or None)"""
        directive, language = block.directive, block.language
        if directive in CLONE:
            return self.run_in_clone(block)
        if directive.startswith("listed, "):
            return self.run_listed(block, folder)
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
    parser.add_argument("--no-npm", action="store_true", help="leave out what needs npm")
    parser.add_argument("--full", action="store_true", help="run the blocks of clones and the listed ones for real, and no others: minutes")
    parser.add_argument("--clones", choices=("yes", "no"), help="only the blocks that run in a clone, or all others")
    parser.add_argument("--only", nargs="*", default=[""], help="pages or folders, as paths from the root of the repository")
    parser.add_argument("--except", nargs="*", default=[], dest="without", help="the same, left out")
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
                    args.python_path.resolve() if args.python_path else None, args.full, not args.no_npm)
    pages = []
    for path in [ROOT / name for name in PAGES] + sorted((ROOT / "docs").rglob("*.md")):
        page = path.relative_to(ROOT).as_posix()
        if page.startswith(tuple(args.only)) and not page.startswith(tuple(args.without)):
            blocks = [block for block in blocks_of(page, path.read_text(encoding="utf-8"))
                      if args.clones is None or (block.directive in CLONE) == (args.clones == "yes")]
            pages.append((page, blocks))
    # A clone can be made only where there is none.
    pages.sort(key=lambda entry: not any(block.directive in CLONE and "git clone" in block.text for block in entry[1]))
    counts, faults = {}, []
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
                if args.list or (args.full and kind == "run"):
                    print(f"{block.where}: {kind} {block.language}, {time.monotonic() - start:.0f} s", flush=True)
                if fault:
                    faults.append(f"{block.where}: {fault}")
    if faults:
        print("\n".join(faults))
    print(", ".join(f"{count} {kind}" for kind, count in sorted(counts.items())) + f": {len(faults)} faults")
    return 1 if faults or not counts else 0


if __name__ == "__main__":
    sys.exit(main())
