#!/usr/bin/env python3
"""Use abut's command line as a user does: exit codes, messages, a run, an interrupted run.

usage: check_command_line.py ABUT DECK [PYTHON]

ABUT is the program, DECK a Starter deck that has no errors, with its Engine deck beside it. PYTHON (with VTK: Debian's /usr/bin/python3)
reads the animation of an interrupted run; without it only the index is looked at. Standard library only.
Exit status 0 when all holds.
"""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time


def call(*arguments, **options):
    return subprocess.run(list(arguments), capture_output=True, text=True, **options)


def expect(condition, what, result=None):
    if not condition:
        print(f"not so: {what}", file=sys.stderr)
        if result is not None:
            print(result.stdout, result.stderr, sep="\n", file=sys.stderr)
        sys.exit(1)


def usage(abut):
    expect(call(abut, "--version").returncode == 0, "--version ends with 0")
    for arguments in (("--help",), ("run", "--help"), ("check", "--help"), ("replay", "--help")):
        expect(call(abut, *arguments).returncode == 0, f"{' '.join(arguments)} ends with 0")
    for arguments in ((), ("run",), ("fly",), ("run", "x", "--profile", "none"), ("run", "x", "--threads", "0"), ("run", "x", "--hash-every", "often")):
        result = call(abut, *arguments)
        expect(result.returncode == 2 and result.stderr, f"wrong usage {arguments} ends with 2 and a message", result)
    result = call(abut, "some_0000.rad")
    expect(result.returncode == 2 and "abut run some_0000.rad" in result.stderr, "a deck without a command: what to type", result)
    result = call(abut, "check", "no such deck_0000.rad")
    expect(result.returncode == 1 and "no such deck_0000.rad" in result.stderr, "a missing deck ends with 1 and is named", result)


def check(abut, deck):
    for other in (deck.replace("_0000.rad", "_0001.rad"), deck.removesuffix("_0000.rad")):
        result = call(abut, "check", other)
        expect(result.returncode == 1 and f"there is '{deck}'" in result.stderr and len(result.stderr.splitlines()) <= 2,
               "an Engine deck, or a name without its end: the Starter deck that is there is named", result)
    result = call(abut, "check", deck)
    expect(result.returncode == 0 and "Counts" in result.stdout, "check summarises", result)
    result = call(abut, "check", deck, "--json")
    expect(result.returncode == 0, "check --json ends with 0", result)
    document = json.loads(result.stdout)
    expect(document["ok"] and document["model"]["nodes"] > 0, "check --json says that the deck is good", result)
    return document["model"]["name"]


def later_runs(abut, deck, folder):
    """check reads all Engine decks, as a run of them would: their faults together, and a line for each run."""
    os.makedirs(folder)
    for file in (deck, deck.replace("_0000.rad", "_0001.rad")):
        shutil.copy(file, folder)
    copy = os.path.join(folder, os.path.basename(deck))
    name = os.path.basename(deck).removesuffix("_0000.rad")

    def engine(run, text):
        with open(copy.replace("_0000.rad", f"_{run:04}.rad"), "w") as file:
            file.write(f"/RUN/{name}/{run}\n{text}")

    engine(2, "1e6\n/FOO\n")
    engine(3, "2e6\n/RBODY/OFF\n987654\n")
    result = call(abut, "check", copy)
    expect(result.returncode == 1 and f"{name}_0002.rad:3: /FOO" in result.stderr and f"{name}_0003.rad:4: /RBODY/OFF" in result.stderr,
           "check tells the faults of all runs", result)
    engine(2, "1e6\n")
    engine(3, "2e6\n")
    result = call(abut, "check", copy)
    lines = result.stdout.splitlines()
    expect(result.returncode == 0 and [l for l in lines if re.match("Run 2 +until 1e\\+06,", l)] and
           [l for l in lines if re.match("Run 3 +until 2e\\+06,", l)], "check lists all runs", result)
    document = json.loads(call(abut, "check", copy, "--json").stdout)
    expect([r["run"] for r in document["runs"]] == [1, 2, 3] and document["runs"][2]["t_end"] == 2e6 and
           f"{name}_0003.rad" in "".join(document["decks"]), "and in JSON", result)


STARTER_LINES = """/SURF/SEG/9001 /SURF/PART/EXT/9002 /SURF/ELLIPS/9003 /GRNOD/NODE/9004 /GRNOD/SPHERE/9005 /TH/NODE/9006 /TH/MONV/9007
    /BOX/RECTA/9008 /SKEW/FIX/9009 /SET/GENERAL/9010 /ADMAS/0/9011 /ADMAS/7/9012 /INTER/TYPE3/9013 /INTER/TYPE11/9014 /MAT/LAW36/9015
    /FRAME/FIX/9016 /FOO/9017 /DAMP/9018 /IOFLAG""".split()
ENGINE_LINES = """/PRINT/-100 /TFILE/4 /TFILE/A /ANIM/VECT/PCONT /ANIM/SHELL/EPSP /ANIM/ELEM/EPSD /ANIM/VECT/FOPT /ANIM/SHELL/TENS/STRESS/UPPER
    /ANIM/MASS /ANIM/FOO /ANIM/NODA/TEMP /DT/NODA/CST/0 /DT/NODA/STOP /DT/AMS /FOO /PROC /STOP /KEREL""".split()


def said_by_keywords(abut, line):
    """{"Starter": "read", "Engine": "refused"}: under which headings `abut keywords` puts a line."""
    result = call(abut, "keywords", line)
    if result.returncode == 1:
        expect("is refused" in result.stderr, f"abut keywords {line} knows nothing and says what that means", result)
        return {"Starter": "refused", "Engine": "refused"}
    headings = re.findall(r"(?m)^## (\w+): (\w+)", result.stdout)
    expect(headings and len(dict(headings)) == len(headings), f"abut keywords {line} has one answer per deck", result)
    return dict(headings)


def keywords(abut, deck, folder):
    """What `abut keywords LINE` says is what the reader does with the line in a deck."""
    os.makedirs(folder)
    starter = os.path.join(folder, os.path.basename(deck))
    text = re.split(r"(?m)^/END", open(deck).read())[0]
    with open(starter, "w") as file:
        file.write(text + "".join(f"{line}\ntitle\n\n" for line in STARTER_LINES))
    engine = deck.replace("_0000.rad", "_0001.rad")
    with open(starter.replace("_0000.rad", "_0001.rad"), "w") as file:
        file.write(open(engine).read() + "".join(f"{line}\n0.9 1e-9\n" for line in ENGINE_LINES))
    result = call(abut, "check", starter, "--json")
    findings = json.loads(result.stdout)["findings"]
    refusals = ("model.unsupported_keyword", "model.unknown_type", "model.unsupported")
    refused = {f["keyword"] for f in findings if f["code"] in refusals}
    warned = {f["keyword"] for f in findings if f["code"] == "model.left_out"}
    for line in STARTER_LINES:
        # What the reader passes over without a warning is no finding.
        does = ["refused"] if line in refused else ["passed"] if line in warned else ["read", "passed"]
        expect(said_by_keywords(abut, line)["Starter"] in does, f"abut keywords {line} is right: {does[0]}", result)
    messages = {f["code"]: f["message"] for f in findings if f["code"].startswith("engine.")}
    for line in ENGINE_LINES:
        def named(code):
            return re.search(rf" {re.escape(line)}( \(|,|$)", messages[code])
        does = "refused" if named("engine.unsupported") else "passed" if named("engine.left_out") or named("engine.skipped") else "read"
        expect(said_by_keywords(abut, line)["Engine"] == does, f"abut keywords {line} is right: {does}", result)
    for word in ("PCONT", "EPSD", "TENS", "/SURF/SEG", "/ADMAS/0", "/RUN/NAME/1", "/INTER/TYPE3/1", "#include"):
        result = call(abut, "keywords", word)
        expect(result.returncode == 0 and ": read" in result.stdout, f"abut keywords {word} finds what is read", result)


def endless(deck, folder):
    """A copy of the deck whose run does not end within the test."""
    os.makedirs(folder)
    engine = deck.replace("_0000.rad", "_0001.rad")
    shutil.copy(deck, folder)
    text, count = re.subn(r"(?m)^(/RUN/.*\n)\s*\S+", r"\g<1>1e6", open(engine).read())
    expect(count == 1, "the Engine deck has a final time")
    with open(os.path.join(folder, os.path.basename(engine)), "w") as file:
        file.write(text)
    return os.path.join(folder, os.path.basename(deck))


def states_in(index):
    if not os.path.exists(index):
        return 0
    with open(index) as file:
        return file.read().count("<DataSet ")


def interrupted(abut, deck, name, folder, python=None):
    """Ctrl-C after some history rows and two states: complete files, status 1, the manifest says so, the animation can be read."""
    process = subprocess.Popen([abut, "run", deck, "-o", folder, "--quiet"], stderr=subprocess.PIPE, text=True)
    history = os.path.join(folder, name + "_th.csv")
    index = os.path.join(folder, name + ".pvd")
    limit = time.monotonic() + 60
    while time.monotonic() < limit and process.poll() is None:
        if os.path.exists(history) and open(history).read().count("\n") > 1 and states_in(index) > 1:
            break
        time.sleep(0.02)
    expect(process.poll() is None, "the run lasts long enough to be interrupted")
    process.send_signal(signal.SIGINT)
    process.wait(timeout=60)
    expect(process.returncode == 1, "an interrupted run ends with 1")
    with open(os.path.join(folder, "run.json")) as file:
        expect(json.load(file)["outcome"]["kind"] == "interrupted", "run.json says that it was interrupted")
    with open(os.path.join(folder, name + ".out")) as file:
        expect("was interrupted" in file.read(), "the listing says that it was interrupted")
    with open(history) as file:
        lines = file.read()
    columns = {line.count(",") for line in lines.splitlines()}
    expect(lines.endswith("\n") and len(columns) == 1, "every history row is complete")
    expect(states_in(index) > 1, "the index names the states written so far")
    if python is not None:
        reader = os.path.join(os.path.dirname(os.path.abspath(__file__)), "read_animation.py")
        result = call(python, reader, index, "--nonzero", "displacement", "velocity")
        expect(result.returncode == 0, "every state of an interrupted run can be read", result)


def complete(abut, deck, name, folder):
    result = call(abut, "run", deck, "-o", folder, "--timing")
    expect(result.returncode == 0, "the run ends with 0", result)
    for file in (name + ".out", name + "_th.csv", "run.json"):
        expect(os.path.getsize(os.path.join(folder, file)) > 0, f"{file} is there")
    with open(os.path.join(folder, "run.json")) as file:
        record = json.load(file)
    expect(record["outcome"]["kind"] == "finished", "run.json says that it finished")
    seconds = {phase["name"]: phase["seconds"] for phase in record["timings"]}
    families = [time for name, time in seconds.items() if name.startswith("elements ")]
    expect(families and sum(families) <= seconds["elements"], "the time of the elements is told by family too")


def recorded(abut, folder):
    """--record-contact and --interface on a deck whose plates start within the gap; abut replay gives the same bits."""
    decks = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "decks", "findings")
    deck = os.path.join(decks, "initial_penetration", "initial_penetration_0000.rad")
    output = os.path.join(folder, "recorded")
    result = call(abut, "run", deck, "-o", output, "--quiet", "--interface", "1:start=5e-6", "--record-contact", "1")
    expect(result.returncode == 0, "a recorded run ends with 0", result)
    with open(os.path.join(output, "run.json")) as file:
        expect(json.load(file)["settings"]["interfaces"] == ["1:start=5e-06"], "run.json names the choice")
    log = os.path.join(output, "initial_penetration_contact_1.calls")
    result = call(abut, "replay", log, "--steps")
    expect(result.returncode == 0 and "every bit as recorded" in result.stdout and "interface 1" in result.stdout, "replay agrees", result)
    with open(log, "rb") as file:
        whole = file.read()
    for name, content in (("cut", whole[:-3]), ("flipped", whole[:3000] + bytes([whole[3000] ^ 8]) + whole[3001:])):
        with open(log, "wb") as file:
            file.write(content)
        result = call(abut, "replay", log)
        expect(result.returncode == 1 and "contact log: record" in result.stderr, f"a log that is {name} is refused", result)
    for option, value, why in (("--interface", "7:start=1", "no such interface"), ("--interface", "1", "expected KEY=VALUE"),
                               ("--interface", "1:law=soft", "expected one of stiffening"), ("--interface", "1:damping=2", "fraction of critical"),
                               ("--interface", "1:depth=0", "a length > 0"), ("--interface", "one:gap=auto", "neither an interface id"),
                               ("--interface", "1:initial=project,start=1", "cannot be had with"), ("--interface", "1:speed=1", "no setting"),
                               ("--interface", "1:gap=auto,gap=card", "twice"),
                               ("--record-contact", "1:2:3:4", "expected an interface id"), ("--record-contact", "x", "not a number"),
                               ("--record-contact", "1:nan", "not a number"), ("--record-contact", "1:0:-1", "not a number"),
                               ("--record-contact", "1:0.01:0.005", "from 0.01 to 0.005: no time is between these")):
        result = call(abut, "run", deck, "-o", output, option, value)
        expect(result.returncode == 1 and why in result.stderr, f"{option} {value} is refused: {why}", result)


def unwritable(abut, deck, folder):
    blocked = os.path.join(folder, "file")
    open(blocked, "w").close()
    result = call(abut, "run", deck, "-o", os.path.join(blocked, "run"))
    expect(result.returncode == 1 and blocked in result.stderr, "a run folder that cannot be made is named", result)


def main():
    if len(sys.argv) not in (3, 4):
        print(__doc__, file=sys.stderr)
        return 2
    abut, deck = sys.argv[1:3]
    usage(abut)
    name = check(abut, deck)
    with tempfile.TemporaryDirectory() as folder:
        keywords(abut, deck, os.path.join(folder, "keywords"))
        later_runs(abut, deck, os.path.join(folder, "later"))
        interrupted(abut, endless(deck, os.path.join(folder, "deck")), name, os.path.join(folder, "interrupted"), *sys.argv[3:])
        complete(abut, deck, name, os.path.join(folder, "complete"))
        recorded(abut, folder)
        unwritable(abut, deck, folder)
    print("the command line does what it says")
    return 0


if __name__ == "__main__":
    sys.exit(main())
