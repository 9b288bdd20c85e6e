#!/usr/bin/env python3
"""Makes the tables and plots of docs/performance.md from what bench/run and bench/contact have measured.

usage: plot_performance.py [--csv FILE] [--contact FILE] [--page FILE] [--out DIR]
       (bench/results.csv, bench/contact.csv, docs/performance.md and docs/images/performance if not told)

The last row of a scene, instruction set and number of threads counts. Plots: cost per element against size, contact cost against size,
threads, time per phase. The page's part between the lines "<!-- measured: begin -->" and "<!-- measured: end -->" is written anew.
Needs matplotlib (Debian: python3-matplotlib, with /usr/bin/python3).
"""
import argparse
import csv
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

try:
    import matplotlib
except ImportError:
    print("plot_performance: skipped: matplotlib is not there (Debian: python3-matplotlib, with /usr/bin/python3)")
    sys.exit(77)
matplotlib.use("svg")
matplotlib.rcParams.update({"svg.hashsalt": "abut", "figure.figsize": (7.2, 3.8), "axes.grid": True, "grid.alpha": 0.3,
                            "axes.spines.top": False, "axes.spines.right": False, "lines.linewidth": 1.6, "legend.frameon": False,
                            "font.size": 10})
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = {"shells": "#30638e", "bricks": "#d1691e"}
PHASES = {"elements": "#30638e", "assembly": "#2d7d46", "contact_search": "#777777", "contact_force": "#a4243b",
          "constraints": "#d1691e", "integrate": "#c9b458"}
TARGETS = {"shells": 0.30, "bricks": 0.28}
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"


def last_rows(path, *keys):
    """{key: row}, the last of each, numbers as numbers."""
    last = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            for key, value in row.items():
                try:
                    row[key] = float(value)
                except ValueError:
                    pass
            last[tuple(row[key] for key in keys)] = row
    return last


def common_unit(rows):
    """All rows in the least unit that was measured beside them: the cores' clock moves, and `ns` is the least of all cycles."""
    least = min(row["unit_ns"] for row in rows)
    for row in rows:
        row["unit_ns"], row["units_cycle"] = least, row["ns"] / least
    return rows


def family(row):
    return row["scene"].split("_")[0]


def select(rows, isa, threads):
    """Rows by family, then size."""
    return sorted((row for row in rows if row["isa"] == isa and row["threads"] == threads), key=lambda row: (family(row), row["elements"]))


def interrupted(row):
    """Whether no cycle of the row was left alone: the wall times of its phases then say nothing (the CPU time of a cycle still does)."""
    return row["threads"] == 1 and row["ns_cycle"] > 1.2 * row["ns"]


def count(number):
    return f"{int(number):,}".replace(",", " ")


def save(figure, path):
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
    print(path)


def by_size(rows, out):
    figure, axes = plt.subplots()
    for name, colour in COLOURS.items():
        some = [row for row in select(rows, "avx2", 1) if family(row) == name]
        sizes = [row["elements"] for row in some]

        def line(style, label, value):
            axes.plot(sizes, [value(row) / row["unit_ns"] for row in some], style, color=colour, label=f"{name}, {label}")

        line("o-", "whole cycle", lambda row: row["ns"])
        line("s--", "elements", lambda row: float("nan") if interrupted(row) else row["ns_elements"])
        line(":", "bytes over bandwidth", lambda row: row["floor_bytes_ns"])
        line("-.", "operations over peak", lambda row: row["floor_operations_ns"])
        axes.axhline(TARGETS[name], color=colour, alpha=0.4, linewidth=0.8)
    axes.set(xscale="log", xlabel="elements", ylabel="units per element and cycle", title="Cost against size (thin lines: targets)")
    axes.set_ylim(bottom=0)
    axes.legend(fontsize=7, ncol=2)
    save(figure, out / "size.svg")


def by_phase(rows, out):
    figure, axes = plt.subplots()
    some = [row for row in select(rows, "avx2", 1) if not interrupted(row)]
    names = [f"{family(row)}\n{count(row['elements'])}" for row in some]
    bottom = [0.0] * len(names)
    for phase, colour in PHASES.items():
        widths = [row[f"ns_{phase}"] for row in some]
        axes.bar(names, widths, bottom=bottom, color=colour, label=phase.replace("_", " "))
        bottom = [a + b for a, b in zip(bottom, widths)]
    axes.set(ylabel="ns per element and cycle", title="Time per phase, least over the cycles")
    axes.tick_params(axis="x", labelsize=7)
    axes.legend(fontsize=8)
    save(figure, out / "phases.svg")


def by_threads(rows, out):
    pairs = [(one, two) for two in select(rows, "avx2", 2) for one in select(rows, "avx2", 1) if one["scene"] == two["scene"]]
    if not pairs:
        (out / "threads.svg").unlink(missing_ok=True)
        return
    figure, axes = plt.subplots()
    places = range(len(pairs))
    for shift, label, colour, key in ((-0.2, "whole cycle", "#30638e", "cycle"), (0.2, "elements", "#c9b458", "elements")):
        axes.bar([p + shift for p in places], [one[f"ns_{key}"] / two[f"ns_{key}"] for one, two in pairs], 0.38, color=colour, label=label)
    axes.axhline(1.8, color="#a4243b", linewidth=0.8, label="target")
    axes.set_xticks(list(places), [f"{family(one)}\n{count(one['elements'])}" for one, _ in pairs])
    axes.set(ylabel="times as fast as one thread", title="Two threads, least over the cycles")
    axes.legend(fontsize=8)
    save(figure, out / "threads.svg")


def by_contact(path, out):
    rows = sorted(last_rows(path, "surface", "motion", "nodes").values(), key=lambda row: row["nodes"])
    figure, axes = plt.subplots()
    for (surface, motion), style in ((("flat", "resting"), "o-"), (("curved", "resting"), "s-"), (("flat", "sliding"), "o--"), (("curved", "sliding"), "s--")):
        some = [row for row in rows if (row["surface"], row["motion"]) == (surface, motion)]
        axes.plot([row["nodes"] for row in some], [row["ns_search"] + row["ns_force"] for row in some], style,
                  color="#30638e" if surface == "flat" else "#d1691e", label=f"{surface}, {motion}")
    axes.set(xscale="log", yscale="log", xlabel="nodes", ylabel="ns per node and step", title="Contact alone, search and force")
    axes.legend(fontsize=8)
    save(figure, out / "contact.svg")


def table(rows):
    yield "| scene | elements | set, threads | ns | units | target | elements, ns | floor of bytes | of operations | ratio | elements: ratio | mean CPU, ns | load |"
    yield "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
    for row in sorted(rows, key=lambda row: (row["isa"] != "avx2", row["threads"], family(row), row["elements"])):
        one = row["threads"] == 1
        alone = not interrupted(row)
        ratios = f"{row['ratio']:.1f} | {row['ratio_elements'] if alone else float('nan'):.1f}".replace("nan", "") if one else " | "
        yield (f"| {row['scene']} | {count(row['elements'])} | {row['isa']}, {row['threads']:.0f} | {row['ns']:.0f} | {row['units_cycle']:.2f} | "
               f"{TARGETS[family(row)] if one and row['isa'] == 'avx2' else ''} | {row['ns_elements'] if alone else float('nan'):.0f} | {row['floor_bytes_ns']:.0f} | "
               f"{row['floor_operations_ns']:.0f} | {ratios} | {row['ns_cpu']:.0f} | {row['load']:.1f} |").replace("| nan |", "| |")


def measured(rows, out, page):
    """The part of the page that is made from the rows."""
    newest = rows[-1]
    commits = sorted({row["commit"] for row in rows})
    folder = Path(out).resolve().relative_to(page.resolve().parent)
    yield BEGIN
    yield (f"{newest['cpu']}, {newest['compiler']}; commit {', '.join(commits)}; unit {newest['unit_ns']:.0f} ns, triad "
           f"{newest['triad_gb_s']:.1f} GB/s, peak {max(row['peak_g_s'] for row in rows if row['isa'] == 'avx2'):.0f}e9 simple operations per second (AVX2). "
           "Written by `tools/plot_performance.py` from `bench/results.csv`.")
    yield ""
    yield from table(rows)
    yield ""
    for name in ("shells", "bricks"):
        row = next((row for row in rows if family(row) == name), None)
        if row:
            yield (f"Counted per element of {name} and cycle: {row['operations']:.0f} simple operations, {row['divisions']:.1f} divisions and {row['roots']:.1f} roots in the "
                   f"kernel, {row['bytes_counted']:.0f} bytes in the whole cycle (of the smallest scene).")
    yield ""
    for file, text in (("size", "Cost per element against size"), ("phases", "Time per phase"), ("threads", "Two threads"), ("contact", "Contact alone")):
        if (Path(out) / f"{file}.svg").exists():
            yield f"![{text}]({folder.as_posix()}/{file}.svg)"
            yield ""
    yield END


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--csv", default=str(ROOT / "bench" / "results.csv"))
    parser.add_argument("--contact", default=str(ROOT / "bench" / "contact.csv"))
    parser.add_argument("--page", default=str(ROOT / "docs" / "performance.md"))
    parser.add_argument("--out", default=str(ROOT / "docs" / "images" / "performance"))
    args = parser.parse_args()
    out, page = Path(args.out), Path(args.page)
    out.mkdir(parents=True, exist_ok=True)
    rows = common_unit(list(last_rows(args.csv, "scene", "isa", "threads").values()))
    by_size(rows, out)
    by_phase(rows, out)
    by_threads(rows, out)
    if Path(args.contact).exists():
        by_contact(args.contact, out)
    text = page.read_text(encoding="utf-8")
    head, _, rest = text.partition(BEGIN)
    _, found, tail = rest.partition(END)
    if not found:
        raise SystemExit(f"plot_performance: {page} has no lines {BEGIN} and {END}")
    page.write_text(head + "\n".join(measured(sorted(rows, key=lambda row: row["elements"]), out, page)) + tail, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
