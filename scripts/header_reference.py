#!/usr/bin/env python3
"""Renders the comments of a public header as Markdown: the API reference of the site is always that of the headers.

usage: header_reference.py HEADER        prints the page's part; exit status 1 names what has no comment

Understands the house's style: a comment at the head of the file; `///` before a declaration, `///<` behind a member; @param, @return,
@throws. Private members and what is marked "// internal" are left out. Standard library only.
"""
import re
import sys
from pathlib import Path

SKIPPED = re.compile(r"^(#|namespace\b|static_assert|using enum|private:|public:|friend\b|explicit Interface\()")


class Item:
    """A declaration with its comment; `body` holds what stands between the braces of a type."""

    def __init__(self, declaration, doc, body=""):
        self.declaration, self.doc, self.body = declaration, doc, body

    @property
    def kind(self):
        match = re.match(r"(struct|class|enum class|enum)\b", self.declaration)
        if match:
            return match.group(1)
        before = self.declaration.partition("=")[0]
        return "function" if "(" in before and not before.startswith("using") else "value"


def declarations(text):
    """The declarations of one scope, in order. Inline bodies of functions are cut off, those of types are kept."""
    items, doc, lines, k = [], [], text.splitlines(), 0
    while k < len(lines):
        line = lines[k].strip()
        k += 1
        if line.startswith("private:"):
            break
        if line.startswith("///") and not line.startswith("///<"):
            doc.append(line[3:].strip())
            continue
        if not line:
            doc = []
            continue
        if line.startswith("//") or SKIPPED.match(line):
            continue
        # A declaration goes on until its brackets are closed and it ends with ; or a body.
        gathered, comments, depth = [], [], 0
        while True:
            code, _, comment = line.partition("//")
            if comment.startswith("/<"):
                comments.append(comment[2:].strip())
            elif comment.startswith("/"):
                gathered.append("//" + comment)
            internal = comment.strip() == "internal"
            if code.strip() or not comment:
                inner = comment.startswith("/<") and "{" in "".join(gathered)
                gathered.append(f"{code.rstrip()}  //{comment}" if inner else code.rstrip())
            depth += code.count("{") - code.count("}") + code.count("(") - code.count(")")
            if depth <= 0 and (code.rstrip().endswith((";", "}"))) or k >= len(lines):
                break
            line = lines[k].strip()
            k += 1
        whole = "\n".join(gathered)
        if internal or re.match(r"(struct|class) \w+;$", whole.strip()):
            doc = []
            continue
        if re.match(r"(struct|class|enum)\b", whole) and "{" in whole:
            head, _, rest = whole.partition("{")
            body, _, after = rest.rpartition("}")
            variable = after.strip().rstrip(";").strip()
            items.append(Item(head.strip() + (f" {variable}" if variable else ""), doc + comments if "\n" not in body else doc, body))
        else:
            head = whole
            if "(" in head:
                head = re.sub(r"\s*\{.*\}\s*$", ";", re.sub(r"\s*\n\s*", " ", head), flags=re.S)
            if "operator" not in head:
                items.append(Item(re.sub(r"\s+", " ", head).strip(), doc + comments))
        doc = []
    return items


def prose(doc):
    """Comment lines as Markdown: @param and friends become a list."""
    parts = []
    for line in re.split(r"\s(?=@(?:param|return|returns|throws|pre|post)\b)", " ".join(doc)):
        line = re.sub(r"^@param\s+(\w+)\s+", r"- `\1`: ", line.strip())
        for tag, word in (("return", "Returns"), ("throws", "Throws"), ("pre", "Needs"), ("post", "Afterwards")):
            line = re.sub(rf"^@{tag}s?\s+", f"- *{word}* ", line)
        parts.append(line)
    text = "\n".join(parts).replace("<", "&lt;").replace("|", "\\|")
    text = re.sub(r"^#", r"\\#", text)
    return re.sub(r"([^\n])\n- ", r"\1\n\n- ", text, count=1)


def cell(doc):
    return prose(doc).replace("\n", " ")


def member_row(item):
    match = re.match(r"(?P<type>[^=]*?)\s*(?P<names>\w+\s*=\s*\{\}|\w+(?:\s*=\s*[^,]+)?(?:, \w+(?:\s*=\s*[^,]+)?)*|\w+(?:\{.*\}))\s*;$", item.declaration)
    if not match:
        return f"| `{item.declaration.rstrip(';')}` | | {cell(item.doc)} |"
    if "{" in match.group("names") and "=" not in match.group("names"):
        names = [match.group("names").partition("{")]
    else:
        names = [part.partition("=") for part in match.group("names").split(", ")]
    shown = ", ".join(name.strip() for name, _, _ in names)
    default = ", ".join(("{" + value if sign == "{" else value.strip()) for _, sign, value in names if sign and value != "}")
    return f"| `{shown}` : `{match.group('type')}` | {f'`{default}`' if default else ''} | {cell(item.doc)} |"


def values(body):
    """Rows of an enumeration."""
    for name, comment in re.findall(r"(\w+)\s*(?:,|$|\s)\s*(?://(?:/<)?\s*(.*))?", body, flags=re.M):
        yield f"| `{name}` | {cell([comment.lstrip('/<').strip()])} |"


def render_item(item, level, missing):
    name = re.sub(r"\s*:.*", "", item.declaration)
    title = re.sub(r"^(struct|class|enum class|enum)\s+", "", name).split(" ")[0] if item.kind in ("struct", "class", "enum", "enum class") else \
        re.search(r"(~?\w+)\s*\(", item.declaration).group(1) if item.kind == "function" else item.declaration
    out = []
    if item.kind in ("struct", "class"):
        out += [f"{'#' * level} {item.kind} {title}", "", prose(item.doc), ""]
        inside = declarations(item.body)
        members = [entry for entry in inside if entry.kind == "value"]
        if members:
            out += ["| member | default | meaning |", "|---|---|---|", *map(member_row, members), ""]
        for entry in inside:
            if entry.kind != "value" and not re.match(rf"~?{title}\(", entry.declaration):
                out += render_item(entry, level + 1, missing)
    elif item.kind.startswith("enum"):
        rows = list(values(item.body))
        out += [f"{'#' * level} enum {title}", "", prose(item.doc), ""]
        if any(not row.endswith("|  |") for row in rows):
            out += ["| value | meaning |", "|---|---|", *rows, ""]
        else:
            out += ["Values: " + ", ".join(row.split("|")[1].strip() for row in rows) + ".", ""]
    elif item.kind == "function":
        out += [f"{'#' * level} {title}()", "", "```cpp", wrapped(item.declaration.replace("[[nodiscard]] ", "")), "```", "", prose(item.doc), ""]
    else:
        name = re.search(r"(\w+)\s*(=|;|$)", item.declaration).group(1)
        out += [f"{'#' * level} {name}", "", "```cpp", wrapped(item.declaration), "```", "", prose(item.doc), ""]
    if not item.doc and item.kind != "value" and title[0] != "~":
        missing.append(title)
    return out


def wrapped(declaration, width=96):
    """A signature over several lines when it is long: one parameter a line."""
    if len(declaration) <= width:
        return declaration
    head, _, rest = declaration.partition("(")
    inside, _, tail = rest.rpartition(")")
    parts, depth, start = [], 0, 0
    for k, letter in enumerate(inside):
        depth += (letter in "<({") - (letter in ">)}")
        if letter == "," and depth == 0:
            parts.append(inside[start:k].strip())
            start = k + 1
    parts.append(inside[start:].strip())
    return f"{head}(\n    " + ",\n    ".join(parts) + f"){tail}"


def render(path, missing=None):
    text = path.read_text(encoding="utf-8")
    head = []
    for line in text.splitlines():
        if not line.startswith("//"):
            break
        head.append(line[3:])
    body = re.search(r"\nnamespace [\w:]+ \{\n(.*)\n\}  // namespace", text, flags=re.S)
    name = path.as_posix().partition("include/")[2]
    out = [f"```cpp\n#include <{name}>\n```", ""]
    paragraphs = "\n".join(head).split("\n\n")
    for paragraph in paragraphs:
        if re.match(r"\s{2,}", paragraph):
            out += ["```text", paragraph, "```", ""]
        else:
            out += [prose(paragraph.splitlines()), ""]
    for item in declarations(body.group(1)) if body else ():
        out += render_item(item, 3, missing if missing is not None else [])
    return "\n".join(out) + "\n"


def main():
    if len(sys.argv) != 2:
        print(__doc__)
        return 2
    missing = []
    print(render(Path(sys.argv[1]).resolve(), missing))
    if missing:
        print(f"without a comment: {', '.join(missing)}", file=sys.stderr)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
