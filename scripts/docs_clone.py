"""The clone in which blocks of the documentation run that build or test abut (check_docs_code.py), and what stands in for a build there.

The suite runs these blocks too, but does not build abut again nor run itself within itself. There
  cmake --preset NAME     the preset must be one of CMakePresets.json; build/NAME is then the build that is being tested
  cmake --build ...       the real one looks at its arguments and says what it would do (ninja -n); the targets must be there
  ctest ...               the real one lists the tests that its arguments choose (-N); none is a fault
  npm ...                 the real one, with packages that the build has fetched
  pip install .../python  the real one, with the module that is being tested (ABUT_BUILD_DIR)
  scripts/install-deps    installs nothing (ABUT_SKIP_DEPS)
and everything else, ./demo and ./check among it, is what it always is. With --full nothing stands in for anything.
"""
import shutil
import subprocess
from pathlib import Path

CMAKE = r"""#!/bin/sh
case ${1:-} in
  --preset)
    "@REAL@" --list-presets | grep -qx " *\"$2\".*" || exec "@REAL@" "$@"
    mkdir -p build
    [ -e "build/$2" ] || ln -s "@BUILD@" "build/$2" ;;
  --build)
    targets=no
    for argument in "$@"; do
      case $argument in
        --target) targets=yes ;;
        -*) targets=no ;;
        *) [ $targets = no ] || "@REAL@" --build "$2" --target help | grep -Eq "^(\.\.\. )?$argument(:| |\$)" || { echo "no target $argument"; exit 1; } ;;
      esac
    done
    exec "@REAL@" "$@" -- -n ;;
  *) exec "@REAL@" "$@" ;;
esac
"""
CTEST = """#!/bin/sh
list=$("@REAL@" "$@" -N) || exit
echo "$list"
case $list in *"Total Tests: 0"*) exit 1 ;; esac
"""
LISTED = """#!/bin/sh
list=$("@REAL@" "$@" --gtest_list_tests) || exit
echo "$list" | sed -n 's/^  */found /p'
"""


def write_program(path, text, **names):
    for name, value in names.items():
        text = text.replace(f"@{name.upper()}@", str(value))
    path.write_text(text)
    path.chmod(0o755)


def clone_programs(folder, build):
    """Writes the stand-ins into a folder for the PATH. @param build the build that is being tested"""
    folder.mkdir()
    for name, text in (("cmake", CMAKE), ("ctest", CTEST)):
        write_program(folder / name, text, real=shutil.which(name), build=build)


def list_tests(folder, programs):
    """A folder with all of `programs`, of which those named test_* say `found NAME` for each test that their filter takes."""
    folder.mkdir()
    for program in programs.iterdir():
        if program.name.startswith("test_"):
            write_program(folder / program.name, LISTED, real=program)
        else:
            (folder / program.name).symlink_to(program)


def is_repository(folder):
    done = subprocess.run(["git", "rev-parse", "--show-toplevel"], cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    return done.returncode == 0 and Path(done.stdout.strip()) == folder


def make_clone(root, clone):
    """What is committed in `root`, and over it what is not."""
    if not clone.exists():
        subprocess.run(["git", "clone", "--quiet", root, clone], check=True)
    command = ["git", "ls-files", "--modified", "--others", "--exclude-standard"]
    for name in subprocess.run(command, cwd=root, check=True, text=True, stdout=subprocess.PIPE).stdout.splitlines():
        if (root / name).is_file():
            (clone / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(root / name, clone / name)
