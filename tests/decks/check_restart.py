#!/usr/bin/env python3
"""Torture the restart: whatever happens to a run, it goes on with the same bits, or says clearly why it does not.

usage: check_restart.py ABUT DECK [--kills N] [--damages N] [--seed S]
       check_restart.py ABUT DECK --stops N

ABUT is the program, DECK a Starter deck that has no errors, with its Engine deck beside it. Standard library only.

- kill -9 at N random moments, of runs and of resumed runs, on changing numbers of threads: what is in the folder is readable,
  and the run that goes on ends with the time history, the animation and the state hashes of the run that was never stopped;
- a disk that is full during a checkpoint, and during the time history: a limit on the size of files, and (as root, or where users may make
  namespaces) a file system that is really full; a system that makes no threads;
- checkpoints cut off and with flipped bits: the one before is taken, or a clear refusal;
- checkpoints of another model, of a changed Engine deck, of another version: refused, and the folder stays as it is;
- a chain of Engine decks NAME_0001, NAME_0002 ends in the state of one run to the same time: run at once, and by `abut resume` with kills
  in run 2; run 2 does not begin in the state of another model;
- with --stops nothing but this: N runs of which each stops at another time, spread over the whole, and goes on with NAME_0002.
Exit status 0 when all holds.
"""
import argparse
import json
import os
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree

CHECKPOINT_EVERY = 40
HASH_EVERY = 50


def fail(what, result=None):
    print(f"not so: {what}", file=sys.stderr)
    if result is not None:
        print(result.stdout, result.stderr, sep="\n", file=sys.stderr)
    sys.exit(1)


def expect(condition, what, result=None):
    if not condition:
        fail(what, result)


def call(*arguments, **options):
    result = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, timeout=300, **options)
    expect(result.returncode in (0, 1), f"{arguments} ends with 0 or 1, not {result.returncode}", result)
    return result


def read(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


def write(path, content):
    with open(path, "wb") as file:
        file.write(content)


class Case:
    """A deck, and the run of it that nothing happened to."""

    def __init__(self, abut, deck, folder, dice):
        self.abut, self.dice = abut, dice
        self.deck = os.path.abspath(deck)
        self.name = os.path.basename(deck).removesuffix("_0000.rad")
        self.folder = folder
        self.reference = os.path.join(folder, "reference")
        start = time.monotonic()
        result = self.run(self.reference, threads=1)
        self.seconds = time.monotonic() - start
        expect(result.returncode == 0, "the run that nothing happens to finishes", result)
        self.expected = self.results(self.reference)
        expect(len(self.expected["hashes"]) > 3 and len(self.expected["animation"]) > 3, "the run has hashes and animation states")

    def command(self, folder, threads):
        return [self.abut, "run", self.deck, "-o", folder, "--quiet", "--threads", str(threads), "--hash-every", str(HASH_EVERY),
                "--checkpoint-every", str(CHECKPOINT_EVERY)]

    def run(self, folder, *more, threads=2, **options):
        return call(*self.command(folder, threads), *more, **options)

    def resume(self, folder, *more, threads=2, **options):
        return call(self.abut, "resume", folder, "--quiet", "--threads", threads, *more, **options)

    def checkpoint(self, folder, previous=False):
        return os.path.join(folder, self.name + ("_previous" if previous else "") + ".rst")

    def results(self, folder):
        """What must not depend on what happened on the way."""
        with open(os.path.join(folder, "run.json")) as file:
            manifest = json.load(file)
        animation = os.path.join(folder, self.name + "_anim")
        return {"outcome": manifest["outcome"]["kind"], "cycles": manifest["outcome"].get("cycles"), "energies": manifest.get("energies"),
                "worst": manifest.get("worst"), "hashes": manifest.get("hashes"), "history": read(folder, self.name + "_th.csv"),
                "index": read(folder, self.name + ".pvd"),
                "animation": {file: read(animation, file) for file in sorted(os.listdir(animation)) if not file.startswith(".")}}

    def expect_same(self, folder, what):
        found = self.results(folder)
        for key, value in self.expected.items():
            expect(found[key] == value, f"{what}: '{key}' is that of the run that was never stopped")
        left = [file for file in os.listdir(folder) if file.endswith(".part")]
        expect(not left, f"{what}: no temporary file is left: {left}")

    def expect_readable(self, folder):
        """After a kill: whole rows, a manifest, and an index whose states can be read."""
        history = os.path.join(folder, self.name + "_th.csv")
        if os.path.exists(history):
            rows = read(history).decode().split("\n")[:-1]
            expect(len({row.count(",") for row in rows}) <= 1, "every whole row of a killed run has all columns")
            for row in rows[1:]:
                [float(value) for value in row.split(",")]
        manifest = os.path.join(folder, "run.json")
        if os.path.exists(manifest):
            json.loads(read(manifest))
        index = os.path.join(folder, self.name + ".pvd")
        if os.path.exists(index):
            for state in xml.etree.ElementTree.fromstring(read(index)).iter("DataSet"):
                expect(read(folder, state.get("file")).rstrip().endswith(b"</VTKFile>"), f"{state.get('file')} of a killed run is whole")


def kill_some_time(case, command, longest):
    """Starts the command and kills it at a random moment. True when it was killed before its end."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(case.dice.uniform(0.0, longest))
    process.send_signal(signal.SIGKILL)
    return process.wait() != 0


def kills(case, count):
    done = resumed = 0
    while done < count:
        folder = os.path.join(case.folder, "killed")
        shutil.rmtree(folder, ignore_errors=True)
        command = case.command(folder, case.dice.choice((1, 2, 3)))
        while done < count and kill_some_time(case, command, case.seconds):
            done += 1
            case.expect_readable(folder)
            if os.path.exists(case.checkpoint(folder)):
                command = [case.abut, "resume", folder, "--quiet", "--threads", str(case.dice.choice((1, 2, 3)))]
            else:
                result = case.resume(folder) if os.path.isdir(folder) else None
                expect(result is None or (result.returncode == 1 and "there is no checkpoint" in result.stderr),
                       "without a checkpoint resume says so", result)
        if os.path.exists(case.checkpoint(folder)):
            result = case.resume(folder, threads=case.dice.choice((1, 2, 3)))
            if result.returncode == 1:
                expect("the run is finished" in result.stderr, "only a finished run does not go on", result)
            else:
                resumed += 1
            case.expect_same(folder, f"after kill {done}")
    if resumed == 0:  # on a busy machine all of them may have come before the first checkpoint
        half_way(case, folder)
        done, resumed = done + 1, 1
        expect(case.resume(folder, threads=3).returncode == 0, "a killed run goes on")
        case.expect_same(folder, "after a kill half-way")
    print(f"{done} kills, {resumed} runs brought to their end with the same bits")


def half_way(case, folder):
    """A run that was killed when it had two checkpoints."""
    for _ in range(20):
        shutil.rmtree(folder, ignore_errors=True)
        process = subprocess.Popen(case.command(folder, 1), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while process.poll() is None and not os.path.exists(case.checkpoint(folder, previous=True)):
            time.sleep(0.002)
        process.kill()
        process.wait()
        if json.loads(read(folder, "run.json"))["outcome"]["kind"] == "running" and os.path.exists(case.checkpoint(folder, True)):
            return
    fail("a run can be killed between its second checkpoint and its end")


def at_the_last_moment(case):
    """Killed when the last checkpoint was written and run.json was not: the files are brought to their end."""
    begun = os.path.join(case.folder, "begun")
    half_way(case, begun)
    folder = os.path.join(case.folder, "nearly")
    shutil.copytree(case.reference, folder)
    shutil.copy(os.path.join(begun, "run.json"), os.path.join(folder, "run.json"))
    result = case.resume(folder)
    expect(result.returncode == 0, "a run that was killed before its files were ended is brought to its end", result)
    case.expect_same(folder, "killed at the last moment")
    untouched(case, folder, "the run is finished", "and is finished then")


def full_disk(case):
    """A limit on the size of files stands for a disk that is full: the write fails in the middle."""
    def limited(size):
        return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))

    biggest = max(len(content) for content in case.expected["animation"].values())
    checkpoint = os.path.getsize(case.checkpoint(case.reference))
    history = len(case.expected["history"])
    expect(checkpoint > 1.2 * max(biggest, history), "the checkpoint is the largest file of this deck")

    folder = os.path.join(case.folder, "no_checkpoint")
    result = case.run(folder, preexec_fn=limited(checkpoint // 2 + max(biggest, history) // 2))
    expect(result.returncode == 0 and "no checkpoint was written" in result.stderr, "a run goes on without room for checkpoints", result)
    case.expect_same(folder, "without room for checkpoints")
    expect(not os.path.exists(case.checkpoint(folder)), "no part of a checkpoint is left")

    folder = os.path.join(case.folder, "full_disk")
    half_way(case, folder)
    before = read(case.checkpoint(folder))
    result = case.resume(folder, preexec_fn=limited(len(read(folder, case.name + "_th.csv")) + 100))
    expect(result.returncode == 1 and "cannot write" in result.stderr, "a full disk is named", result)
    expect(read(case.checkpoint(folder)) == before, "the checkpoint that was there is kept when the disk is full")
    case.expect_readable(folder)
    result = case.resume(folder)
    expect(result.returncode == 0, "with room again the run goes on", result)
    case.expect_same(folder, "after a full disk")
    print("a full disk does no harm")


def no_threads(case):
    """Stacks that no memory is large enough for: the system makes no thread but the first."""
    hard = resource.getrlimit(resource.RLIMIT_STACK)[1]
    if hard != resource.RLIM_INFINITY:
        print("a system without threads: left out, the size of a stack is limited here")
        return
    folder = os.path.join(case.folder, "no_threads")
    result = case.run(folder, threads=1, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_STACK, (1 << 42, hard)))
    expect(result.returncode == 0 or "cannot make the thread that writes the animation" in result.stderr, "a missing thread is named", result)


# Ends with 0, 1 (abut's), or 77: no file system can be mounted here. $1: its size in kB, $2: the folder, then the command.
SMALL_DISK = """
size=$1; place=$2; shift 2
mount -t tmpfs -o size=${size}k tmpfs "$place" 2>/dev/null || exit 77
cp -r "$place.content/." "$place" || exit 76
"$@"
status=$?
rm -rf "$place.content" && cp -r "$place" "$place.content"
exit $status
"""


def small_disk(case):
    """A file system on which the folder of a killed run has a little room left, in a mount namespace of its own."""
    folder = os.path.join(case.folder, "small")
    start = os.path.join(case.folder, "start_small")
    half_way(case, start)
    for part in [name for name in contents(start) if name.endswith(".part")]:
        os.remove(part)  # what was on its way gives its room back when it is written again
    used = sum(-(-len(content) // 4096) * 4 for content in contents(start).values())
    as_root = ["unshare", "--mount"] if os.geteuid() == 0 else ["unshare", "--user", "--map-root-user", "--mount"]
    checkpoint = os.path.getsize(case.checkpoint(start)) // 1024
    stopped = 0
    for room in (8, checkpoint // 2, checkpoint + 16):  # kB
        for path in (folder, folder + ".content"):
            shutil.rmtree(path, ignore_errors=True)
        os.makedirs(folder)
        shutil.copytree(start, folder + ".content")
        before = [content for name, content in contents(start).items() if name.endswith(".rst")]
        result = subprocess.run([*as_root, "sh", "-c", SMALL_DISK, "sh", str(used + room), folder, case.abut, "resume", folder, "--quiet"],
                                capture_output=True, text=True, timeout=300)
        if result.returncode == 77 or "unshare" in result.stderr:
            print("a file system that is really full: left out, none can be mounted here")
            return
        expect(result.returncode in (0, 1), "on a small disk a run ends with 0 or 1", result)
        shutil.rmtree(folder)
        os.rename(folder + ".content", folder)
        case.expect_readable(folder)
        if result.returncode == 0:
            case.expect_same(folder, f"with {room} kB of room")
            continue
        stopped += 1
        expect("No space left on device" in result.stderr, "a full file system is named", result)
        # The newest one may be new: there was room for it, and later there was none for an animation state.
        expect(room > checkpoint or read(case.checkpoint(folder)) in before, "a checkpoint that was there is kept", result)
        result = case.resume(folder)
        expect(result.returncode == 0, "with room again the run goes on", result)
        expect("from the checkpoint before it" not in result.stderr, "the newest checkpoint is whole", result)
        case.expect_same(folder, f"after a file system was full with {room} kB left")
    expect(stopped > 0, "the file system was full in one of the cases")
    print(f"a full file system stopped {stopped} of 3 runs and does no harm")


def another_model(case):
    """A run of the same name of which one node lies elsewhere. @returns its folder, with a checkpoint"""
    decks = os.path.join(case.folder, "another")
    os.makedirs(decks)
    shutil.copy(case.deck.replace("_0000.rad", "_0001.rad"), decks)
    text = open(case.deck).read()
    line = re.search(r"(?m)^/NODE\n(?:#.*\n)*(.*)$", text)
    moved = line.group(1)[:-1] + ("1" if line.group(1)[-1] != "1" else "2")
    write(os.path.join(decks, os.path.basename(case.deck)), (text[:line.start(1)] + moved + text[line.end(1):]).encode())
    folder = os.path.join(case.folder, "run_of_another")
    other = Case.__new__(Case)
    other.__dict__.update(case.__dict__, deck=os.path.join(decks, os.path.basename(case.deck)))
    half_way(other, folder)
    return folder


def damages(case, count):
    start = os.path.join(case.folder, "start")
    half_way(case, start)
    good = read(case.checkpoint(start))

    def damaged():
        bad = bytearray(good)
        if case.dice.random() < 0.4:
            return bytes(bad[:case.dice.randrange(len(bad))])
        for _ in range(case.dice.randint(1, 4)):
            bad[case.dice.randrange(len(bad))] ^= 1 << case.dice.randrange(8)
        return bytes(bad)

    folder = os.path.join(case.folder, "damaged")
    for k in range(count):
        bad = damaged()
        if bad == good:
            continue
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(start, folder)
        write(case.checkpoint(folder), bad)
        if k % 4 == 0:  # the one before it is whole
            result = case.resume(folder)
            expect(result.returncode == 0 and "from the checkpoint before it" in result.stderr, "the checkpoint before is taken", result)
            case.expect_same(folder, "from the checkpoint before")
            continue
        if k % 4 == 1:
            write(case.checkpoint(folder, True), damaged()[:-1])
        else:
            os.remove(case.checkpoint(folder, True))
        untouched(case, folder, "cannot be resumed", "damaged checkpoints are refused")
    print(f"{count} damaged checkpoints: the one before, or a refusal")


def contents(folder):
    return {os.path.join(base, file): read(base, file) for base, _, files in os.walk(folder) for file in files}


def untouched(case, folder, message, what, *more):
    before = contents(folder)
    result = case.resume(folder, *more)
    expect(result.returncode == 1 and message in result.stderr, what, result)
    expect(contents(folder) == before, f"{what}, and the folder stays as it is")


def checksum(data):
    """state::Checksum of src/state/checkpoint.cpp: head and content, filled to whole words, and the length behind them; four rows of every
    fourth word, then over the four."""
    mask, start = (1 << 64) - 1, 0xCBF29CE484222325

    def mixed(hash_, word):
        hash_ = ((hash_ ^ word) * 0x100000001B3) & mask
        return hash_ ^ hash_ >> 32

    content, length = data[:-8], data[-8:]
    words = struct.iter_unpack("<Q", content + b"\0" * (-len(content) % 8) + length)
    rows = [start] * 4
    for i, (word,) in enumerate(words):
        rows[i % 4] = mixed(rows[i % 4], word)
    sum_ = start
    for row in rows:
        sum_ = mixed(sum_, row)
    return sum_


def others(case):
    folder = os.path.join(case.folder, "other")
    half_way(case, folder)
    decks = os.path.join(case.folder, "decks")
    os.makedirs(decks)
    engine = case.deck.replace("_0000.rad", "_0001.rad")
    other = os.path.join(decks, os.path.basename(case.deck))

    text = open(case.deck).read()
    expect("/NODE\n" in text, "the deck has nodes")
    write(other, text.replace("/NODE\n", "/NODE\n# changed\n", 1).encode())
    shutil.copy(engine, decks)
    untouched(case, folder, "is another model, or was changed since", "a changed Starter deck is refused", "--deck", other)
    shutil.copy(case.deck, decks)
    engine_text = open(engine).read()
    write(os.path.join(decks, os.path.basename(engine)), engine_text.replace("/PRINT/-100", "/PRINT/-200").encode())
    untouched(case, folder, "an Engine deck of the runs up to 1 was changed since", "a changed Engine deck is refused", "--deck", other)
    untouched(case, folder, "is not there any more", "a deck that is gone is named", "--deck", os.path.join(decks, "none_0000.rad"))

    mixed = os.path.join(case.folder, "mixed")
    another = another_model(case)
    for previous in (False, True):  # the newest alone, and both
        shutil.rmtree(mixed, ignore_errors=True)
        shutil.copytree(folder, mixed)
        for which in {False, previous}:
            shutil.copy(case.checkpoint(another), case.checkpoint(mixed, which))
        untouched(case, mixed, "it is of another model", "the checkpoint of another model is refused")

    good = read(case.checkpoint(folder))
    version = re.search(rb"\d+\.\d+\.\d+", good[24:200]).group()
    changed = good[:-8].replace(version, b"9" * len(version), 1)
    write(case.checkpoint(folder), changed + struct.pack("<Q", checksum(changed)))
    untouched(case, folder, f"written by abut {'9' * len(version)}", "another version is refused")
    write(case.checkpoint(folder), good)
    shutil.copy(engine, decks)
    result = case.resume(folder, "--deck", other)
    expect(result.returncode == 0, "a deck that was moved is found with --deck", result)
    case.expect_same(folder, "with a deck that was moved")
    untouched(case, folder, "the run is finished", "a finished run does not go on")
    print("other models, decks and versions are refused")


def first_part(case, decks, share):
    """The deck in a folder of its own, with an Engine deck to this share of the time. @returns it, and the match of /RUN in the whole one's"""
    os.makedirs(decks)
    shutil.copy(case.deck, decks)
    deck = os.path.join(decks, os.path.basename(case.deck))
    text = open(case.deck.replace("_0000.rad", "_0001.rad")).read()
    end = re.search(r"(?m)^(/RUN/.*)/1\s*\n\s*(\S+)", text)
    first = text.replace(end.group(0), f"{end.group(1)}/1\n{share * float(end.group(2))}", 1)
    write(deck.replace("_0000.rad", "_0001.rad"), first.encode())
    return deck, end


def stops(case, count):
    for k in range(1, count + 1):
        deck, end = first_part(case, os.path.join(case.folder, f"stop_{k}"), k / (count + 1))
        folder = os.path.join(case.folder, f"stopped_{k}")
        result = call(case.abut, "run", deck, "-o", folder, "--quiet", "--hash-every", HASH_EVERY, "--checkpoint-every", CHECKPOINT_EVERY)
        expect(result.returncode == 0, "the first part of a run runs", result)
        write(deck.replace("_0000.rad", "_0002.rad"), f"{end.group(1)}/2\n{end.group(2)}\n".encode())
        result = case.resume(folder, threads=1 + k % 3)
        expect(result.returncode == 0, "its second part runs", result)
        case.expect_same(folder, f"stopped at {k} of {count + 1} parts of the time")
    print(f"{count} runs that were stopped on their way end with the same bits")


def chain(case, kills_in_run_2):
    """Run 1 to 40 % of the time and run 2 to the end: the state is that of one run; rows at the seam may be more."""
    decks = os.path.join(case.folder, "chain")
    deck, end = first_part(case, decks, 0.4)
    second = deck.replace("_0000.rad", "_0002.rad")
    folder = os.path.join(case.folder, "in_steps")
    result = call(case.abut, "run", deck, "-o", folder, "--quiet", "--hash-every", HASH_EVERY, "--checkpoint-every", CHECKPOINT_EVERY)
    expect(result.returncode == 0, "run 1 of a chain runs", result)
    write(second, f"{end.group(1)}/2\n{end.group(2)}\n".encode())
    last = read(case.checkpoint(folder))
    for which in (False, True):
        shutil.copy(case.checkpoint(os.path.join(case.folder, "run_of_another")), case.checkpoint(folder, which))
    untouched(case, folder, "it is of another model", "run 2 does not begin in the state of another model")
    write(case.checkpoint(folder), last)
    os.remove(case.checkpoint(folder, True))
    command = [case.abut, "resume", folder, "--quiet", "--threads", "2"]
    killed = sum(kill_some_time(case, command, 0.4 * case.seconds) for _ in range(kills_in_run_2))
    case.expect_readable(folder)
    result = case.resume(folder)
    expect(result.returncode == 0 or "the run is finished" in result.stderr, "run 2 goes on after kills", result)
    case.expect_same(folder, f"after {killed} kills in run 2")
    print(f"abut resume takes NAME_0002.rad; {killed} kills in run 2")

    folder = os.path.join(case.folder, "chained")
    result = call(case.abut, "run", deck, "-o", folder, "--quiet", "--threads", 2, "--hash-every", HASH_EVERY)
    expect(result.returncode == 0, "a chain of Engine decks runs", result)
    found = case.results(folder)
    for key in ("hashes", "cycles", "energies", "animation", "index", "history"):
        expect(found[key] == case.expected[key], f"a chain of Engine decks: '{key}' is that of one run")
    write(deck.replace("_0000.rad", "_0003.rad"), f"{end.group(1)}/3\n{end.group(2)}\n".encode())
    result = call(case.abut, "run", deck, "-o", folder, "--quiet")
    expect(result.returncode == 1 and "is not after the final time" in result.stderr, "a run that would end at once is refused", result)
    print("a chain of Engine decks ends like one run")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("abut")
    parser.add_argument("deck")
    parser.add_argument("--kills", type=int, default=6)
    parser.add_argument("--damages", type=int, default=8)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--stops", type=int, default=0)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="abut_restart_") as folder:
        case = Case(os.path.abspath(arguments.abut), arguments.deck, folder, random.Random(arguments.seed))
        if arguments.stops > 0:
            stops(case, arguments.stops)
            return 0
        kills(case, arguments.kills)
        at_the_last_moment(case)
        full_disk(case)
        small_disk(case)
        no_threads(case)
        damages(case, arguments.damages)
        others(case)
        chain(case, max(2, arguments.kills // 5))
    return 0


if __name__ == "__main__":
    sys.exit(main())
