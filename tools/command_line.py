#!/usr/bin/env python3
"""Writes what describes abut's command line from the program's own --help: the man page, the completion of bash, and a page of the guide.

usage: command_line.py --abut PROGRAM            write docs/man/abut.1, docs/man/abut.bash, docs/guide/command-line.md, docs/guide/keywords.md
       command_line.py --abut PROGRAM --check    compare instead of writing; exit status 1 if a file differs

So all of them name the same verbs and options, always. docs/guide/keywords.md is what `abut keywords` prints. Standard library only.
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

DESCRIPTION = """abut runs explicit finite-element dynamics of shells and solids in contact from Radioss decks. A deck is a Starter file NAME_0000.rad (the
model) with its Engine file NAME_0001.rad beside it (how long to run and what to write). Every fault of a deck is reported at once, with
file, line, keyword, field and columns; contacts are inspected before the first step and watched during the run."""

FILES = [("NAME.out", "listing: one line per printed cycle"), ("NAME_th.csv", "time history: one row per /TFILE interval; the first row names the columns"),
         ("NAME.pvd, NAME_anim/", "animation for ParaView: an index and one file per state"), ("run.json", "what ran: settings, timings, findings, hashes")]
EXIT = [("0", "done"), ("1", "the deck has errors, or the run did not reach its end"), ("2", "wrong usage")]
ENVIRONMENT = [("ABUT_ISA", "sse2, avx2 or avx512: takes this instruction set instead of the best one; results do not depend on it")]


class Option:
    def __init__(self, head, text):
        names = re.match(r"[^\s]+", head).group(0)
        self.names = names.split(",")
        rest = head[len(names):].strip()
        self.choices = re.findall(r"\{([^}]*)\}", rest)[0].split(",") if "{" in rest else []
        self.default = (re.search(r"=(\S+)$", re.sub(r"\{[^}]*\}", "", rest)) or [None, ""])[1]
        self.needs = (re.search(r"Needs: (\S+)", rest) or [None, ""])[1]
        self.value = {"TEXT": "FOLDER" if text.startswith("run folder") else "FILE", "INT": "N", "FLOAT": "X"}.get(re.match(r"[A-Z]*", rest).group(0), "")
        form = re.match(r"(ID[^\s,]*), ", text)  # a value with a form of its own: "ID:TIME, ..."
        if form:
            self.value, text = form.group(1), text[form.end():]
        if self.choices:
            self.value = "|".join(self.choices)
        self.text = text + (f" (default: {self.default})" if self.default else "") + (f" (with {self.needs})" if self.needs else "")

    @property
    def usage(self):
        return ", ".join(self.names) + (f" {self.value}" if self.value else "")


class Help:
    """One --help, taken apart."""

    def __init__(self, text):
        lines = text.splitlines()
        self.about = lines[0]
        self.positionals, self.options, self.verbs, self.footer = [], [], [], ""
        section, entries = None, {"Positionals": [], "Options": [], "Subcommands": []}
        for k, line in enumerate(lines):
            if line.startswith("Examples:"):
                self.footer = "\n".join(lines[k:])
                break
            if re.match(r"\w+:$", line):
                section = line[:-1]
            elif section in entries and re.match(r"  \S", line):
                head, text_ = (line[2:30].strip(), line[30:].strip()) if len(line) > 29 and line[29] == " " else (line.strip(), "")
                entries[section].append([head, text_])
            elif section in entries and line.strip():
                entries[section][-1][1] = (entries[section][-1][1] + " " + line.strip()).strip()
        self.options = [Option(*entry) for entry in entries["Options"]]
        self.positionals = [(head.split()[0], text_, "REQUIRED" in head) for head, text_ in entries["Positionals"]]
        self.verbs = [(head, text_) for head, text_ in entries["Subcommands"]]


def ask(program, *arguments):
    return subprocess.run([str(program), *arguments], check=True, capture_output=True, text=True).stdout


def synopsis(verb, page):
    return " ".join(["abut", verb, *(f"[{option.usage}]" for option in page.options if "--help" not in option.names),
                     *(name if required else f"[{name}]" for name, _, required in page.positionals)])


def roff(text):
    return re.sub(r"^([.'])", r"\\&\1", text.replace("\\", "\\e").replace("-", "\\-"), flags=re.M)


def man_page(top, pages):
    out = ['.\\" Written by tools/command_line.py from the program\'s --help; do not edit.', '.TH ABUT 1 "" "abut" "User commands"', ".SH NAME",
           "abut \\- " + roff(top.about.removeprefix("abut: ")), ".SH SYNOPSIS"]
    for verb, _ in top.verbs:
        out += [".nf" if False else f".B abut {verb}", roff(synopsis(verb, pages[verb]).removeprefix(f"abut {verb} ")), ".br"]
    out += [".SH DESCRIPTION", roff(DESCRIPTION)]
    for verb, text in top.verbs:
        out += [f".SH ABUT {verb.upper()}", roff(text[:1].upper() + text[1:] + ".")]
        for name, about, _ in pages[verb].positionals:
            out += [".TP", f".I {name}", roff(about)]
        for option in pages[verb].options:
            out += [".TP", f".B {roff(option.usage)}", roff(option.text)]
    out += [".SH OPTIONS WITHOUT A VERB"]
    for option in top.options:
        out += [".TP", f".B {roff(option.usage)}", roff(option.text)]
    for heading, rows in (("FILES OF A RUN", FILES), ("EXIT STATUS", EXIT), ("ENVIRONMENT", ENVIRONMENT)):
        out += [f".SH {heading}"]
        for name, about in rows:
            out += [".TP", f".B {roff(name)}", roff(about)]
    examples, _, notes = top.footer.partition("\n\n")
    out += [".SH EXAMPLES", ".nf", roff("\n".join(line[2:] for line in examples.splitlines()[1:])), ".fi", ".SH NOTES", ".nf", roff(notes), ".fi"]
    return "\n".join(out) + "\n"


def completion(top, pages):
    verbs = " ".join(verb for verb, _ in top.verbs)
    out = ["# Completion of abut for bash. Written by tools/command_line.py from the program's --help; do not edit.",
           "_abut() {", '  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb= word',
           '  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do', f"    case $word in {'|'.join(verb for verb, _ in top.verbs)}) verb=$word; break ;; esac", "  done",
           "  COMPREPLY=()", "  case $verb:$before in"]
    for verb, _ in top.verbs:
        for option in pages[verb].options:
            pattern = "|".join(f"{verb}:{name}" for name in option.names)
            if option.choices:
                out.append(f"    {pattern}) COMPREPLY=($(compgen -W '{' '.join(option.choices)}' -- \"$current\")); return ;;")
            elif option.value == "FILE":
                out.append(f"    {pattern}) COMPREPLY=($(compgen -f -- \"$current\")); return ;;")
            elif option.value == "FOLDER":
                out.append(f"    {pattern}) COMPREPLY=($(compgen -d -- \"$current\")); return ;;")
            elif option.value:
                out.append(f"    {pattern}) return ;;")
    out += ["  esac", "  case $verb in"]
    for verb, _ in top.verbs:
        names = " ".join(name for option in pages[verb].options for name in option.names)
        kinds = {name for name, _, _ in pages[verb].positionals}
        files = "$(compgen -d -- \"$current\") $(compgen -f -X '!*_[0-9][0-9][0-9][0-9].rad' -- \"$current\")" if "DECK" in kinds \
            else "$(compgen -d -- \"$current\")" if "RUN" in kinds else ""
        out.append(f"    {verb}) COMPREPLY=($(compgen -W '{names}' -- \"$current\")"
                   + (f"); [[ $current == -* ]] || COMPREPLY=({files}) ;;" if files else ") ;;"))
    out += [f"    *) COMPREPLY=($(compgen -W '{verbs} {' '.join(name for option in top.options for name in option.names)}' -- \"$current\")) ;;",
            "  esac", "}", "complete -o filenames -F _abut abut"]
    return "\n".join(out) + "\n"


def guide(top, pages):
    def cell(text):
        return text.replace("|", "\\|").replace("<", "&lt;")

    out = ["# Command line", "", "Written by `tools/command_line.py` from the program's `--help`; do not edit. The man page (`man abut`) and the completion of bash are "
           "written from it too; `cmake --install` puts them in place.", ""]
    for verb, text in top.verbs:
        out += [f"## abut {verb}", "", text[:1].upper() + text[1:] + ".", "", "| argument | |", "|---|---|"]
        out += [f"| `{name}` | {cell(about)} |" for name, about, _ in pages[verb].positionals]
        out += [f"| `{cell(option.usage)}` | {cell(option.text)} |" for option in pages[verb].options]
        out += [""]
    out += ["## Without a verb", "", "| argument | |", "|---|---|"]
    out += [f"| `{option.usage}` | {cell(option.text)} |" for option in top.options]
    out += ["", "## Exit status", "", "| | |", "|---|---|", *(f"| {name} | {about} |" for name, about in EXIT), "", "## Environment", "", "| | |", "|---|---|",
            *(f"| `{name}` | {about} |" for name, about in ENVIRONMENT)]
    return "\n".join(out) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--abut", required=True)
    parser.add_argument("--check", action="store_true")
    args = parser.parse_args()
    top = Help(ask(args.abut, "--help"))
    pages = {verb: Help(ask(args.abut, verb, "--help")) for verb, _ in top.verbs}
    files = {"docs/man/abut.1": man_page(top, pages), "docs/man/abut.bash": completion(top, pages), "docs/guide/command-line.md": guide(top, pages),
             "docs/guide/keywords.md": ask(args.abut, "keywords")}
    different = 0
    for name, text in files.items():
        path = ROOT / name
        if not args.check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        elif not path.is_file() or path.read_text(encoding="utf-8") != text:
            different += 1
            print(f"{name} is not what tools/command_line.py --abut PROGRAM writes: run it and commit the result")
    return 1 if different or not top.verbs else 0


if __name__ == "__main__":
    sys.exit(main())
