"""What the tools that write files share: FOLDER, or --check FOLDER."""
import sys
from pathlib import Path


def arguments(usage):
    """(folder, check) of the command line; prints the usage and ends with status 2 when it is another one."""
    words = sys.argv[1:]
    check = words[:1] == ["--check"]
    if len(words) != 1 + check:
        print(usage)
        sys.exit(2)
    return Path(words[-1]), check


def write_or_check(path, text, check):
    """Writes `text`, or says that the file differs from it. @return number of faults, 0 or 1"""
    if not check:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    elif not path.is_file() or path.read_text(encoding="utf-8") != text:
        print(f"{path} is not what tools/{Path(sys.argv[0]).name} writes")
        return 1
    return 0
