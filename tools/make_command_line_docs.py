#!/usr/bin/env python3
"""Writes the man page and the bash completion from what `abut --help` says, so that they name the same commands and options.

usage: make_command_line_docs.py ABUT FOLDER          writes FOLDER/abut.1 and FOLDER/abut.bash
       make_command_line_docs.py ABUT FOLDER --check  exit status 1 when they differ from what would be written

Standard library only.
"""
import re
import subprocess
import sys
from pathlib import Path


class Command:
    """One page of help: summary, positionals and options as (names, values, description)."""

    def __init__(self, abut, *words):
        result = subprocess.run([abut, *words, "--help"], capture_output=True, text=True, check=True)
        self.words = words
        body, _, self.footer = result.stdout.partition("\nExamples:\n")
        lines = body.splitlines()
        self.summary = lines[0]
        self.usage = next(line.removeprefix("Usage: ") for line in lines if line.startswith("Usage: "))
        self.sections = {}
        current = None
        for line in lines[1:]:
            if re.fullmatch(r"[A-Z]\w+:", line):
                current = self.sections.setdefault(line[:-1], [])
            elif current is not None and line.startswith("  ") and not line.startswith("   "):
                head, _, text = line.strip().partition("  ")
                current.append([head.strip(), text.strip()])
            elif current and line.strip():
                current[-1][1] = (current[-1][1] + " " + line.strip()).strip()

    def options(self):
        """(names, values of a choice, takes a value, description)"""
        found = []
        for head, text in self.sections.get("Options", []):
            names = head.split()[0].split(",")
            choice = re.search(r"\{([^}]*)\}", head)
            kind = re.search(r"\s(TEXT|INT|FLOAT)", head)
            found.append((names, choice.group(1).split(",") if choice else [], bool(kind), text))
        return found


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text[:1] in ".'" else text


def option_text(names, values, takes_value):
    value = " " + ("|".join(values) if values else "\\fIVALUE\\fR") if takes_value else ""
    return ", ".join(f"\\fB{escaped(name)}\\fR" for name in names) + value


def man_page(program, commands):
    examples, _, notes = program.footer.partition("\n\n")
    out = ['.TH ABUT 1 "" "abut" "User Commands"', ".SH NAME", f"abut \\- {escaped(program.summary)}", ".SH SYNOPSIS"]
    for command in commands:
        out += [f".B {' '.join(('abut', *command.words))}", "[\\fIOPTIONS\\fR] " + " ".join(f"\\fI{h.split()[0]}\\fR" for h, _ in command.sections.get("Positionals", [])), ".br"]
    out += [".SH DESCRIPTION"] + [escaped(line) for line in notes.strip().splitlines()]
    out += [".SH OPTIONS"]
    for names, values, takes_value, text in program.options():
        out += [".TP", option_text(names, values, takes_value), escaped(text)]
    for command in commands:
        out += [f".SH ABUT {command.words[0].upper()}", escaped(command.summary[:1].upper() + command.summary[1:]) + "."]
        for head, text in command.sections.get("Positionals", []):
            out += [".TP", f"\\fI{head.split()[0]}\\fR", escaped(text)]
        for names, values, takes_value, text in command.options():
            out += [".TP", option_text(names, values, takes_value), escaped(text)]
    out += [".SH EXAMPLES", ".nf"] + [escaped(line) for line in examples.splitlines()] + [".fi"]
    return "\n".join(out) + "\n"


def completion(program, commands):
    names = lambda command: " ".join(name for option in command.options() for name in option[0])
    out = ["# bash completion of abut, written by tools/make_command_line_docs.py", "_abut() {",
           '  local word="${COMP_WORDS[COMP_CWORD]}" before="${COMP_WORDS[COMP_CWORD-1]}" command="${COMP_WORDS[1]}"',
           "  COMPREPLY=()", "  if [ \"$COMP_CWORD\" -eq 1 ]; then",
           f"    COMPREPLY=($(compgen -W '{' '.join(c.words[0] for c in commands)} {names(program)}' -- \"$word\"))", "    return", "  fi",
           '  case "$command $before" in']
    for command in commands:
        for option, values, takes_value, _ in command.options():
            pattern = " | ".join(f"'{command.words[0]} {name}'" for name in option)
            if values:
                out.append(f"    {pattern}) COMPREPLY=($(compgen -W '{' '.join(values)}' -- \"$word\")); return ;;")
    out += ["  esac", '  case "$command $word" in']
    for command in commands:
        out.append(f"    '{command.words[0]} -'*) COMPREPLY=($(compgen -W '{names(command)}' -- \"$word\")); return ;;")
    out += ["  esac", '  COMPREPLY=($(compgen -f -- "$word"))', "}", "complete -o filenames -F _abut abut"]
    return "\n".join(out) + "\n"


def main():
    if len(sys.argv) not in (3, 4) or sys.argv[3:] not in ([], ["--check"]):
        print(__doc__, file=sys.stderr)
        return 2
    abut, folder = sys.argv[1], Path(sys.argv[2])
    program = Command(abut)
    commands = [Command(abut, head.split()[0]) for head, _ in program.sections["Subcommands"]]
    pages = {"abut.1": man_page(program, commands), "abut.bash": completion(program, commands)}
    stale = 0
    for name, text in pages.items():
        path = folder / name
        if "--check" not in sys.argv:
            folder.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        elif not path.is_file() or path.read_text(encoding="utf-8") != text:
            print(f"{path} is not what the program's help says: tools/make_command_line_docs.py {abut} {folder}")
            stale = 1
    return stale


if __name__ == "__main__":
    sys.exit(main())
