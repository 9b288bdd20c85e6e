"""What `mkdocs` does beyond its own for abut's documentation (mkdocs.yml names this file).

- KaTeX is taken from Debian's libjs-katex into the site, so that formulas are drawn without a network.
- A page may say `<!-- api: abut/contact/interface.hpp -->`: the reference of that public header stands there (scripts/header_reference.py).
- `<!-- references -->` becomes the list of docs/references.bib.
- Links from a page to files of the repository outside docs/ lead to copies in the site; links to folders become plain text.
"""
import os
import re
import sys
from pathlib import Path

from mkdocs.structure.files import File

ROOT = Path(__file__).resolve().parent.parent
KATEX = Path("/usr/share/javascript")
LINK = re.compile(r"(\[[^\]]*\])\(([^)\s#]+)(#[^)\s]*)?\)")
API = re.compile(r"<!-- api: (\S+) -->")
FIELD = re.compile(r"(\w+) = \{((?:[^{}]|\{[^{}]*\})*)\}")

sys.path.insert(0, str(ROOT / "scripts"))
import header_reference  # noqa: E402


def outside(page, link):
    """The repository's file or folder that a link of a page names, if it lies outside docs/."""
    if re.match(r"[a-z]+:", link):
        return None
    target = (ROOT / "docs" / page).parent.joinpath(link).resolve()
    if not target.is_relative_to(ROOT) or target.is_relative_to(ROOT / "docs"):
        return None
    return target.relative_to(ROOT)


def site_path(path):
    return f"repository/{path}.txt" if path.suffix not in (".png", ".svg", ".html") else f"repository/{path}"


def on_files(files, config):
    def add(path, folder, destination=None):
        file = File(path, str(folder), config["site_dir"], config["use_directory_urls"])
        if destination:
            file.src_uri = file.dest_uri = file.url = destination
            file.abs_dest_path = str(Path(config["site_dir"]) / destination)
        files.append(file)

    if not (KATEX / "katex").is_dir():
        raise SystemExit("docs: KaTeX is not installed (Debian: libjs-katex)")
    katex = [Path(folder) / name for folder, _, names in os.walk(KATEX / "katex", followlinks=True) for name in names]  # fonts/ is a link
    for path in sorted(katex):
        if path.suffix in (".woff2", ".woff") or path.name in ("katex.min.css", "katex.min.js", "auto-render.js"):
            add(str(path.relative_to(KATEX)), KATEX)
    linked = set()
    for page in files.documentation_pages():
        for _, link, _ in LINK.findall(Path(page.abs_src_path).read_text(encoding="utf-8")):
            target = outside(page.src_path, link)
            if target and (ROOT / target).is_file():
                linked.add(target)
    for target in sorted(linked):
        add(str(target), ROOT, site_path(target))
    return files


def references():
    """The bibliography as a table: tag, authors, title, where."""
    rows = ["| tag | source |", "|---|---|"]
    for entry in re.split(r"\n(?=@)", (ROOT / "docs" / "references.bib").read_text(encoding="utf-8")):
        key = re.match(r"@\w+\{([^,\s]+),", entry)
        if not key:
            continue
        field = {name: re.sub(r'\{\\"(.)\}', "\\1\u0308", text) for name, text in FIELD.findall(entry)}
        field = {name: re.sub(r"[{}]", "", text).replace("--", "\u2013") for name, text in field.items()}
        where = [field.get(name) for name in ("journal", "booktitle", "institution", "organization", "publisher", "howpublished")]
        parts = [field.get("author", "").replace(" and ", "; "), f"*{field.get('title', '')}*", *filter(None, where), field.get("volume", ""),
                 field.get("number", ""), field.get("pages", ""), field.get("year", ""), field.get("note", ""), field.get("url", "")]
        rows.append(f"| {key.group(1)} | {', '.join(part for part in parts if part)} |")
    return "\n".join(rows)


def on_page_markdown(markdown, page, config, files):
    source = page.file.src_path
    up = "../" * source.count("/")

    def lead(match):
        text, link, anchor = match.groups()
        target = outside(source, link)
        if target is None:
            return match.group(0)
        return f"{text}({up}{site_path(target)})" if (ROOT / target).is_file() else f"{text[1:-1]} (`{target}/`)"

    markdown = API.sub(lambda match: header_reference.render(ROOT / "include" / match.group(1)), markdown)
    return LINK.sub(lead, markdown.replace("<!-- references -->", references()))
