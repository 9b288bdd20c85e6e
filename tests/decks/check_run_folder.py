#!/usr/bin/env python3
"""A run folder holds one run: what an earlier run left, or another process writes, is never mixed with it.

usage: check_run_folder.py ABUT DECK

ABUT is the program, DECK a Starter deck that has no errors, with its Engine deck beside it. Standard library only.

- a new run in the folder of an earlier one leaves nothing of it that could be resumed, replayed or looked at;
- a checkpoint of other settings than those of the results is refused;
- two programs do not write in one folder;
- a checkpoint is found by its own name, from within the folder, and when the run's name ends like that of an older checkpoint;
- a time history or listing that was changed is refused, and nothing is cut then; an animation state that was deleted stops nothing;
- /RFILE of a later Engine deck acts, unless the command line says otherwise;
- a resumed run says that it is not recorded, and a recording without a call says so.
Exit status 0 when all holds.
"""
import argparse
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from check_restart import CHECKPOINT_EVERY, Case, call, expect, half_way, read, untouched, write


def started(command, there):
    """The command under way, when a file is there."""
    process = subprocess.Popen([str(part) for part in command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    while process.poll() is None and not os.path.exists(there):
        time.sleep(0.002)
    return process


def killed(process):
    process.send_signal(signal.SIGKILL)
    expect(process.wait() == -signal.SIGKILL, "the run lasts long enough to be killed")


def endless(case, folder):
    """A copy of the deck whose run does not end within the test."""
    os.makedirs(folder)
    shutil.copy(case.deck, folder)
    text = open(case.deck.replace("_0000.rad", "_0001.rad")).read()
    changed, count = re.subn(r"(?m)^(/RUN/.*\n)\s*\S+", r"\g<1>1e6", text)
    expect(count == 1, "the Engine deck has a final time")
    write(os.path.join(folder, case.name + "_0001.rad"), changed.encode())
    return os.path.join(folder, case.name + "_0000.rad")


def earlier_run(case):
    folder = os.path.join(case.folder, "earlier")
    half_way(case, folder)
    for name in (case.name + "_contact_1.calls", "report.html"):
        write(os.path.join(folder, name), b"of an earlier run")
    write(os.path.join(folder, "other_contact_1.calls"), b"of another run")
    listing = os.path.join(folder, case.name + ".out")
    os.remove(listing)
    # Without checkpoints of its own, so that there are none when it is killed.
    process = started([case.abut, "run", endless(case, os.path.join(case.folder, "endless")), "-o", folder, "--quiet"],
                      os.path.join(folder, "run.json"))
    while not os.path.exists(listing) or b"CYCLE" not in read(listing):
        time.sleep(0.002)
    killed(process)
    left = [name for name in os.listdir(folder) if name.endswith((".rst", ".calls", ".html"))]
    expect(left == ["other_contact_1.calls"], f"of an earlier run nothing is left that a new one does not write: {left}")
    untouched(case, folder, "there is no checkpoint", "a run that was killed before its first checkpoint cannot be resumed")
    print("a new run does not go on from an earlier one")


def other_settings(case):
    folder, other = os.path.join(case.folder, "settings"), os.path.join(case.folder, "other_settings")
    for more, why in (("--profile", "reference"), "another rule set"), (("--interface", "all:damping=0.3"), "other settings of interfaces"):
        half_way(case, folder)
        shutil.rmtree(other, ignore_errors=True)
        killed(started([*case.command(other, 1), *more], case.checkpoint(other)))
        for name in (case.checkpoint(other), case.checkpoint(other, True)):
            if os.path.exists(name):
                shutil.copy(name, folder)
        untouched(case, folder, f"it is of {why} ", f"the checkpoint of a run with {' '.join(more)} is not one of these results")
    print("checkpoints of other settings are refused")


def two_writers(case):
    folder = os.path.join(case.folder, "shared")
    deck = os.path.join(case.folder, "endless", case.name + "_0000.rad")
    process = started([case.abut, "run", deck, "-o", folder, "--quiet", "--checkpoint-every", CHECKPOINT_EVERY], case.checkpoint(folder))
    listing = read(folder, case.name + ".out")
    for result in (case.resume(folder), case.run(folder)):
        expect(result.returncode == 1 and "another abut is writing there" in result.stderr, "a second program is refused", result)
    expect(process.poll() is None, "the first one goes on")
    expect(read(folder, case.name + ".out").startswith(listing), "and its files are as they were")
    killed(process)
    result = case.run(folder)
    expect(result.returncode == 0, "a program that was killed keeps no folder", result)
    print("one program writes in a folder")


def names(case):
    folder = os.path.join(case.folder, "within")
    half_way(case, folder)
    result = call(case.abut, "resume", case.name + ".rst", "--quiet", cwd=folder)
    expect(result.returncode == 0, "a checkpoint is resumed from within its folder", result)
    case.expect_same(folder, "from within the folder")

    # Endings of the run's name that look like that of the checkpoint before the newest.
    decks = os.path.join(case.folder, "names")
    os.makedirs(decks)
    name = case.name + "_previous"
    shutil.copy(case.deck, os.path.join(decks, name + "_0000.rad"))
    engine = open(case.deck.replace("_0000.rad", "_0001.rad")).read()
    write(os.path.join(decks, name + "_0001.rad"), engine.replace(f"/RUN/{case.name}/", f"/RUN/{name}/").encode())
    folder = os.path.join(case.folder, "ending")
    newest, previous = (os.path.join(folder, name + ending) for ending in (".rst", "_previous.rst"))
    killed(started([case.abut, "run", os.path.join(decks, name + "_0000.rad"), "-o", folder, "--quiet", "--threads", "1",
                    "--checkpoint-every", CHECKPOINT_EVERY], previous))
    expect(os.path.exists(newest), "there are two checkpoints")
    result = call(case.abut, "resume", folder)
    first = int(re.search(r"from cycle (\d+)", result.stdout).group(1))
    expect(result.returncode == 0 and first >= 2 * CHECKPOINT_EVERY, "the newest checkpoint is taken, whatever the name of the run", result)
    print("checkpoints are found by their names")


def changed_files(case):
    start, folder = os.path.join(case.folder, "start"), os.path.join(case.folder, "changed")
    half_way(case, start)

    def fresh():
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(start, folder)

    history, listing = case.name + "_th.csv", case.name + ".out"
    rows = read(start, history)
    digit = rows.index(b"\n") + 5
    for name, content in ((history, rows.replace(b"\n", b"\r\n")), (history, rows[:digit] + b"7" + rows[digit + 1:]),
                          (listing, read(start, listing).replace(b"\n", b"\r\n"))):
        expect(content != read(start, name), "the file is changed")
        fresh()
        write(os.path.join(folder, name), content)
        untouched(case, folder, f"{name}' was changed since the checkpoint was written", "a changed file is refused")
    fresh()
    state = os.path.join(folder, case.name + "_anim", case.name + "_00001.vtu")
    os.remove(state)
    result = case.resume(folder)
    expect(result.returncode == 0 and "no checkpoint was written" not in result.stderr, "a deleted animation state stops nothing", result)
    shutil.copy(os.path.join(case.reference, case.name + "_anim", os.path.basename(state)), state)
    case.expect_same(folder, "after the state is back")
    print("files that were changed are not cut")


def cycles_of_checkpoints(command, folder, name):
    """How many cycles lie between the two checkpoints that a killed run has left."""
    cycles = []
    for file in (name + "_previous.rst", name + ".rst"):
        one = os.path.join(folder + "_one")
        shutil.rmtree(one, ignore_errors=True)
        shutil.copytree(folder, one)
        for other in (name + "_previous.rst", name + ".rst"):
            if other != file:
                os.remove(os.path.join(one, other))
        process = subprocess.Popen([*command, one], stdout=subprocess.PIPE, text=True)
        cycles.append(int(re.search(r"from cycle (\d+)", process.stdout.readline()).group(1)))
        process.kill()
        process.wait()
    return cycles[1] - cycles[0]


def later_rfile(case):
    decks = os.path.join(case.folder, "rfile")
    deck = endless(case, decks)
    engine = open(deck.replace("_0000.rad", "_0001.rad")).read()
    short = re.sub(r"(?m)^(/RUN/.*\n)\s*\S+", r"\g<1>1e-5", engine)
    write(deck.replace("_0000.rad", "_0001.rad"), (short + "/RFILE\n30\n").encode())
    write(deck.replace("_0000.rad", "_0002.rad"), f"/RUN/{case.name}/2\n1e6\n/RFILE\n70\n".encode())
    for more, every in ((), 70), (("--checkpoint-every", "50"), 50):
        folder = os.path.join(case.folder, f"every_{every}")
        process = started([case.abut, "run", deck, "-o", folder, "--quiet", "--threads", "1", *more], case.checkpoint(folder))
        while process.poll() is None and read(folder, "run.json").count(b'"at":') == 0:
            time.sleep(0.002)
        written = set()
        while process.poll() is None and len(written) < 4:  # two of run 2 are there then
            written.add(os.stat(case.checkpoint(folder)).st_mtime_ns)
        killed(process)
        found = cycles_of_checkpoints([case.abut, "resume"], folder, case.name)
        expect(found == every, f"run 2 with {more or '/RFILE 70'} has a checkpoint every {every} cycles, not {found}")
    print("/RFILE of a later Engine deck acts")


def recordings(case):
    folder = os.path.join(case.folder, "recorded")
    killed(started([*case.command(folder, 1), "--record-contact", "1"], case.checkpoint(folder)))
    result = case.resume(folder)
    said = "this call log ends before it"
    expect(result.returncode == 0 and said in result.stderr, "a resumed run says that it is not recorded", result)
    expect(said.encode() in read(folder, case.name + ".out"), "and so does its listing")
    folder = os.path.join(case.folder, "not_recorded")
    result = case.run(folder, "--record-contact", "1:1e5")
    expect(result.returncode == 0 and "the call log of interface 1 is empty" in result.stderr, "a recording without a call says so", result)
    expect(b"the call log of interface 1 is empty" in read(folder, case.name + ".out"), "and so does the listing")
    log = os.path.join(folder, case.name + "_contact_1.calls")
    for path, why in ((log, "is empty"), (folder, "is a folder"), (os.path.join(folder, "run.json"), "not a call log")):
        result = call(case.abut, "replay", path)
        expect(result.returncode == 1 and f"'{path}'" in result.stderr and why in result.stderr, f"replay names the file: {why}", result)
    print("recordings say what they do not hold")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("abut")
    parser.add_argument("deck")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="abut_folder_") as folder:
        case = Case(os.path.abspath(arguments.abut), arguments.deck, folder, random.Random(1))
        for check in (earlier_run, other_settings, two_writers, names, changed_files, later_rfile, recordings):
            check(case)
    return 0


if __name__ == "__main__":
    sys.exit(main())
