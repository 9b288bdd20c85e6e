#!/usr/bin/env python3
"""`abut report` on the command line: the file that it writes, and what it refuses.

usage: check_command.py ABUT RUN_FOLDER

Exit status 77 when this abut was built without the report.
"""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path


def main():
    abut, run = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / "page.html"

        def call(*arguments):
            done = subprocess.run([abut, "report", *map(str, arguments)], text=True, capture_output=True)
            return done.returncode, done.stdout + done.stderr

        code, said = call(run, "-o", page)
        if code == 1 and "built without the report" in said:
            print("skipped: " + said.strip())
            return 77
        assert code == 0 and str(page) in said, said
        text = page.read_text(encoding="utf-8")
        assert 'id="abut-document"' in text and text.rstrip().endswith("</html>")
        # Self-contained: nothing is loaded, and the page forbids itself to load.
        assert "default-src 'none'" in text
        assert not re.search(r"<(script|link|img|iframe)[^>]+(src|href)=", text), "loads something"
        assert not list(Path(folder).glob("*.tmp*")), "a temporary file is left"

        bare = Path(folder) / "bare"
        shutil.copytree(run, bare, ignore=shutil.ignore_patterns("*.pvd", "*_anim"))
        code, said = call(bare, "-o", page)
        assert code == 0 and "there is no animation state" in said and "/ANIM/DT" in said, said

        code, said = call(folder)
        assert code == 1 and "run.json" in said, said
        code, said = call(run, "-o", Path(folder) / "missing" / "page.html")
        assert code == 1 and "missing" in said, said
        code, said = call()
        assert code == 2, said
    print("abut report: ok")
    return 0


if __name__ == "__main__":
    sys.exit(main())
