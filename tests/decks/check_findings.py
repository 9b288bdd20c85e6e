#!/usr/bin/env python3
"""Every deck of examples/decks/findings provokes its finding, its twin does not; --orient auto mends what it can.

usage: check_findings.py ABUT FOLDER

Standard library only. Exit status 0 when all holds.
"""
import csv
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile

# finding: (deck, severity, twin)
BEFORE = {
    "contact.normals_away": ("normals_away", "error", "sound"),
    "contact.normals_alike": ("normals_alike", "error", "touching"),
    "contact.mixed_orientation": ("mixed_orientation", "warning", "sound"),
    "contact.duplicate_facets": ("duplicate_facets", "error", "sound"),
    "contact.initial_penetration": ("initial_penetration", "note", "sound"),
    "contact.out_of_reach": ("out_of_reach", "warning", "sound"),
    "contact.blind_nodes": ("blind_nodes", "note", "sound"),
    "contact.clearance": ("sound", "note", "initial_penetration"),
    "contact.stiffness_ratio": ("stiffness_ratio", "warning", "sound"),
    "contact.size_ratio": ("size_ratio", "warning", "sound"),
    "contact.gap_large": ("gap_large", "warning", "sound"),
    "contact.gap_small": ("gap_small", "warning", "sound"),
    "contact.interface_step": ("interface_step", "warning", "sound"),
    "contact.aspect_ratio": ("aspect_ratio", "warning", "sound"),
    "contact.warp": ("warp", "warning", "sound"),
    "contact.partly_away": ("partly_away", "warning", "sound"),
    "contact.no_stiffness": ("no_stiffness", "warning", "sound"),
    "contact.concave": ("concave", "note", "sound"),
    "contact.bound_by_wall": ("bound_by_wall", "warning", "sound"),
    "contact.same_pair": ("same_pair", "warning", "sound"),
    "contact.bound_by_condition": ("bound_by_condition", "note", "sound"),
    "contact.bound_by_body": ("bound_by_body", "note", "sound"),
    "contact.junctions": ("junctions", "warning", "sound"),
    "contact.one_sided": ("one_sided", "warning", "sound"),
    "contact.overlap": ("overlap", "warning", "on_top"),
}
# What the reader says of a deck before the inspection could: finding of the reader: (deck, twin)
REFUSED = {
    "model.shared_node": ("shared_nodes", "sound"),
    "model.zero_area": ("degenerate_facets", "sound"),
}
ALSO_AWAY = ("mixed_orientation", "one_sided")  # an error beside the warning
DURING = {
    "contact.crossed": ("crossed", "deep_penetration", "standard"),
    "contact.deep_penetration": ("deep_penetration", "sound", "standard"),
    "contact.energy_made": ("crossed", "sound", "reference"),  # the reference's plain switching loses energy
    "contact.lost_over_border": ("lost_over_border", "initial_penetration", "standard"),
    "contact.first_step": ("initial_penetration", "sound", "standard"),
    "contact.turned_away": ("turned_away", "sound", "standard"),
}
failures = []


def expect(condition, what):
    if not condition:
        failures.append(what)
        print("not so:", what, file=sys.stderr)


def write_deck(abut, deck, work):
    """--write-deck leaves every file of its own deck alone, and what was in its place when it cannot write; it is never silent."""
    name = os.path.basename(deck).removesuffix("_0000.rad")
    folder = os.path.join(work, "own")
    os.makedirs(os.path.join(folder, "parts"))
    starter, engine, included = (os.path.join(folder, file) for file in (name + "_0000.rad", name + "_0001.rad", "parts/more.inc"))
    with open(deck, encoding="latin-1") as file:
        head, tail = file.read().split("/END", 1)
    for path, content in ((starter, head + "#include parts/more.inc\n/END" + tail), (included, "# nothing\n"),
                          (engine, open(deck.replace("_0000.rad", "_0001.rad"), encoding="latin-1").read()),
                          (engine.replace("_0001", "_0002"), f"/RUN/{name}/2\n1e3\n")):
        with open(path, "w", encoding="latin-1") as file:
            file.write(content)
    os.symlink(included, os.path.join(folder, "link"))

    def files():
        return {file.name: open(file.path, "rb").read() for place in (folder, os.path.join(folder, "parts"))
                for file in os.scandir(place) if file.is_file()}

    def written(target, *more, **options):
        return subprocess.run([abut, "check", starter, *(more or ("--orient", "auto")), "--write-deck", target],
                              capture_output=True, text=True, **options)

    before = files()
    for target in (starter, engine, engine.replace("_0001", "_0002"), included, os.path.join(folder, "parts", "..", name + "_0001.rad"),
                   os.path.join(folder, "link")):
        refused = written(target)
        expect(refused.returncode == 1 and "would overwrite the deck it reads" in refused.stderr and files() == before,
               f"--write-deck leaves {target} alone: {refused.stderr}")
    target = os.path.join(work, "none")
    silent = written(target, "--orient", "none")
    expect(silent.returncode == 1 and "nothing to write" in silent.stderr and not os.path.exists(target),
           f"--write-deck without anything to write says so: {silent.stderr}")
    target = os.path.join(folder, "kept")
    with open(target, "w") as file:
        file.write("what was there")

    def no_room():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))

    full = written(target, preexec_fn=no_room)
    expect(full.returncode == 1 and "cannot write" in full.stderr and open(target).read() == "what was there",
           f"a full disk leaves what was there: {full.stderr}")


def line_ends(abut, deck, work):
    """--write-deck keeps what it does not change byte for byte, and writes its own lines with the deck's line ends."""
    with open(deck, "rb") as file:
        original = file.read().replace(b"\r\n", b"\n")
    written = {}
    for end in (b"\n", b"\r\n"):
        for last in (b"", end):
            source, target = (os.path.join(work, name) for name in ("ends_0000.rad", "ends_written_0000.rad"))
            with open(source, "wb") as file:
                file.write((original.rstrip(b"\n")).replace(b"\n", end) + last)
            subprocess.run([abut, "check", source, "--orient", "auto", "--write-deck", target], capture_output=True, check=True)
            with open(target, "rb") as file:
                written[end, last] = file.read()
    plain = written[b"\n", b""]
    expect(all(got == plain.replace(b"\n", end) + last for (end, last), got in written.items()), "--write-deck keeps the deck's line ends")
    before, after = original.rstrip(b"\n").split(b"\n"), plain.split(b"\n")
    start = after.index(next(line for line in after if line.startswith(b"/SURF/SEG/") and line not in before))
    rest = after[:start] + after[len(after) - (len(before) - start):]
    changed = [a for a, b in zip(before, rest) if a != b]
    expect(before != after and len(before) == len(rest) and len(changed) == 2, f"--write-deck changes two cards: {changed}")


def main():
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    abut, folder = sys.argv[1:]

    def deck(name):
        return os.path.join(folder, name, name + "_0000.rad")

    def check(path, *options):
        result = subprocess.run([abut, "check", path, "--json", *options], capture_output=True, text=True)
        document = json.loads(result.stdout)
        return {c["code"]: c for c in document.get("contact", [])}, result.returncode, document

    for code, (name, severity, twin) in BEFORE.items():
        found, status, document = check(deck(name))
        got = sorted(found) or [f["message"] for f in document["findings"]]
        expect(code in found and found[code]["severity"] == severity, f"{name} gives the {severity} {code}: {got}")
        expect(status == (1 if severity == "error" or name in ALSO_AWAY else 0), f"check {name} ends with {status}")
        expect(code not in check(deck(twin))[0], f"{twin} does not give {code}")

    for code, (name, twin) in REFUSED.items():
        for which in (name, twin):
            _, status, document = check(deck(which))
            said = [f["code"] for f in document["findings"] if f["severity"] == "error"]
            expect(said == ([code] if which == name else []) and status == (1 if which == name else 0), f"{which}: {said}, {status}")
    for name in ("normals_away", "sound"):
        oriented = any(f["code"] == "contact.oriented" for f in check(deck(name), "--orient", "auto")[2]["findings"])
        expect(oriented == (name != "sound"), f"--orient auto says what it turned in {name}, and nothing else: {oriented}")

    with tempfile.TemporaryDirectory() as work:
        for name in ("normals_away", "both_away", "mixed_orientation"):
            stopped = subprocess.run([abut, "run", deck(name), "-o", os.path.join(work, "x"), "--quiet"], capture_output=True, text=True)
            expect(stopped.returncode == 1 and "--allow-findings" in stopped.stderr and not os.path.exists(os.path.join(work, "x")),
                   f"run stops on {name}")
            allowed = subprocess.run([abut, "run", deck(name), "-o", os.path.join(work, "a" + name), "--quiet", "--allow-findings"],
                                     capture_output=True, text=True)
            expect(allowed.returncode == 0, f"run {name} --allow-findings ends with {allowed.returncode}: {allowed.stderr}")
            fixed = os.path.join(work, name + "_0000.rad")
            found, status, document = check(deck(name), "--orient", "auto", "--write-deck", fixed)
            expect(status == 0 and any(f["code"] == "contact.oriented" for f in document["findings"]), f"--orient auto mends {name}")
            found, status, document = check(fixed)
            expect(status == 0 and "contact.normals_away" not in found and "contact.mixed_orientation" not in found,
                   f"the deck that --write-deck wrote for {name} is sound: {status} {sorted(found)}")
        write_deck(abut, deck("normals_away"), work)
        line_ends(abut, deck("normals_away"), work)
        in_turn = os.path.join(work, "in_turn_0000.rad")
        with open(deck("same_pair"), encoding="latin-1") as file, open(in_turn, "w", encoding="latin-1") as changed:
            first, second = (f"{0:>20}{9e-4:>20}{start:>20}{stop:>20}\n" for start, stop in ((0, 5e-6), (5e-6, 0)))
            changed.write(file.read().replace(f"{0:>20}{9e-4:>20}{0:>20}{0:>20}\n", first, 1).replace(f"{0:>20}{9e-4:>20}{0:>20}{0:>20}\n", second, 1))
        found, status, document = check(in_turn)
        expect(status == 0 and "contact.same_pair" not in found, f"interfaces that act in turn may share their surfaces: {status} {sorted(found)}")

        def no_room():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))

        with open(os.path.join(work, "full"), "w") as full:
            cut = subprocess.run([abut, "check", deck("sound")], stdout=full, stderr=subprocess.PIPE, text=True, preexec_fn=no_room)
        expect(cut.returncode == 1 and "standard output cannot be written" in cut.stderr, f"check without room for its output: {cut.returncode}")
        for code, (name, twin, profile) in DURING.items():
            for which in (name, twin):
                output = os.path.join(work, "r" + which)
                subprocess.run([abut, "run", deck(which), "-o", output, "--quiet", "--profile", profile], capture_output=True, text=True)
                with open(os.path.join(output, "run.json")) as file:
                    said = {f["code"]: f for f in json.load(file)["run_findings"]}
                expect((code in said) == (which == name), f"run {which}: {list(said)}")
                if which == name and code != "contact.energy_made":
                    where = said[code].get("nodes", []) + said[code].get("segments", [])
                    expect(where and (len(where) == said[code]["measure"] or code not in ("contact.crossed", "contact.lost_over_border")),
                           f"{code} names whom it concerns: {said[code]}")
        # The same against time: the plate's surface faces the other one until it has turned over, the other one's always does.
        for name, turns in (("turned_away", True), ("sound", False)):
            with open(os.path.join(work, "r" + name, name + "_th.csv")) as file:
                rows = list(csv.DictReader(file))
            first, second = ([float(row["INTER/1/" + column]) for row in rows] for column in ("FACE1", "FACE2"))
            expect(first[0] == 1.0 and second[0] == 1.0 and min(first) == 1.0, f"{name}: surfaces face each other at the start")
            expect((second[-1] < 0.5) == turns and (min(second) == 1.0) != turns, f"{name}: surface 2 faces by {second[-1]} at the end")
            if turns:
                expect(max(float(row["INTER/1/APPR"]) for row in rows) > 0.0, f"{name}: nodes approach in units of the gap")
    print(f"{len(BEFORE) + len(REFUSED) + 1 + len(DURING)} findings, {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
