// Numbers, units, ranges, lines of plots and findings as the page shows them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { NO_VALUE, TOP, type ChunkInfo } from "../src/data/chunk";
import { allFindings, errorText, outcomeText, phaseShares, type Frame, type RunManifest } from "../src/data/document";
import { chunkRange, componentsOf, fieldRange, scalarQuanta, valueAt } from "../src/data/fields";
import {
  columnDimension,
  controllerShares,
  controllerText,
  energyLines,
  errorLines,
  interfaceIds,
  interfaceLines,
  nearestIndex,
} from "../src/data/series";
import { formatNumber, plural, unitName } from "../src/data/units";
import { colorAt, colorMaps, colorTable, ticks } from "../src/view/colormap";

test("numbers are short and keep their meaning", () => {
  assert.equal(formatNumber(0), "0");
  assert.equal(formatNumber(1234.5678), "1235");
  assert.equal(formatNumber(-0.00123456), "−0.001235");
  assert.equal(formatNumber(0.000123), "1.23e−4");
  assert.equal(formatNumber(2.1e11), "2.1e11");
  assert.equal(formatNumber(NaN), "–");
  assert.equal(plural(1, "node"), "1 node");
  assert.equal(plural(12345, "node"), "12\u202f345 nodes");
});

test("units of force, stress and energy in the systems that people use", () => {
  assert.equal(unitName({ mass: "kg", length: "m", time: "s" }, "stress"), "Pa");
  assert.equal(unitName({ mass: "Mg", length: "mm", time: "s" }, "stress"), "MPa");
  assert.equal(unitName({ mass: "kg", length: "mm", time: "ms" }, "force"), "kN");
  assert.equal(unitName({ mass: "g", length: "mm", time: "ms" }, "energy"), "mJ");
  assert.equal(unitName({ mass: "lb", length: "in", time: "s" }, "force"), "lb·in/s²");
});

const vector: ChunkInfo = { id: 0, kind: "q16", count: 3, components: 3, low: [0, 0, 0], high: [3, 4, 0], norm: [0, 5] };
const data = Uint16Array.from([0, TOP, NO_VALUE, 0, TOP, NO_VALUE, 0, 0, NO_VALUE]);

test("the length of a vector, one of its components, and no value", () => {
  assert.equal(valueAt(data, vector, -1, 1), 5);
  assert.equal(valueAt(data, vector, 1, 1), 4);
  assert.ok(Number.isNaN(valueAt(data, vector, -1, 2)));
  assert.deepEqual([...scalarQuanta(data, vector, -1).quanta], [0, TOP, NO_VALUE]);
  assert.deepEqual([...scalarQuanta(data, vector, 1).quanta], [0, TOP, NO_VALUE]);
  assert.deepEqual(chunkRange(vector, -1), { low: 0, high: 5 });
  assert.equal(componentsOf({ name: "stress", on: "element", components: 6 }).length, 6);
});

test("a field's range covers all frames", () => {
  const frame = (low: number, high: number): Frame => ({
    time: 0,
    cycle: 0,
    values: [{ id: 0, kind: "q16", count: 1, components: 1, low: [low], high: [high] }],
  });
  assert.deepEqual(fieldRange([frame(1, 2), frame(-3, 0), frame(0, 9)], 0, 0), { low: -3, high: 9 });
  assert.deepEqual(fieldRange([], 0, 0), { low: 0, high: 0 });
});

const lightness = (c: readonly number[]) => {
  const linear = c.map((x) => ((x / 255 + 0.055) / 1.055) ** 2.4);
  const y = 0.2126 * linear[0]! + 0.7152 * linear[1]! + 0.0722 * linear[2]!;
  return 116 * Math.cbrt(y) - 16;
};
test("sequential colour maps grow lighter in even steps (CIE L*)", () => {
  for (const map of colorMaps.slice(0, 3)) {
    const l = Array.from({ length: 21 }, (_, i) => lightness(colorAt(map, i / 20)));
    const steps = l.slice(1).map((x, i) => x - l[i]!);
    const mean = (l[20]! - l[0]!) / 20;
    assert.ok(Math.min(...steps) > 0, `${map.name} never gets darker`);
    assert.ok(Math.max(...steps) < 1.8 * mean, `${map.name} has no jump: ${Math.max(...steps)} of ${mean}`);
  }
  assert.equal(colorTable(colorMaps[0]!).length, 1024);
});

test("ticks are round and inside", () => {
  assert.deepEqual(
    ticks(0, 1).map((t) => Math.round(t * 1000) / 1000),
    [0, 0.2, 0.4, 0.6, 0.8, 1],
  );
  const t = ticks(-3.3e7, 8.1e7);
  assert.ok(t.length >= 3 && t.length <= 6 && t[0]! >= -3.3e7 && t.at(-1)! <= 8.1e7);
  assert.deepEqual(ticks(5, 5), [5]);
});

test("plots: energies, error in per cent, forces as lengths", () => {
  const columns = new Map([
    ["time", Float32Array.from([0, 1])],
    ["GLOBAL/IE", Float32Array.from([0, 2])],
    ["GLOBAL/DW", Float32Array.from([0, 0])],
    ["GLOBAL/ERR", Float32Array.from([0, 0.5])],
    ["INTER/3/FNX", Float32Array.from([0, 3])],
    ["INTER/3/FNY", Float32Array.from([0, -4])],
    ["INTER/3/FNZ", Float32Array.from([0, 0])],
    ["INTER/3/NC", Float32Array.from([0, 7])],
  ]);
  assert.deepEqual(
    energyLines(columns).map((l) => [l.label.slice(0, 2), l.off]),
    [
      ["IE", false],
      ["DW", true],
    ],
  );
  assert.equal(errorLines(columns)[0]!.values[1], 50);
  assert.deepEqual(interfaceIds([...columns.keys()]), [3]);
  const lines = interfaceLines(columns, 3);
  assert.equal(lines[0]!.values[1], 5);
  assert.equal(lines.at(-1)!.right, true);
  assert.equal(columnDimension("INTER/3/IFNX"), "impulse");
  assert.equal(columnDimension("NODE/1/VX"), "speed");
  assert.equal(nearestIndex([0, 1, 2, 4], 2.9), 2);
  assert.equal(nearestIndex([0, 1, 2, 4], 99), 3);
});

test("who controls the time step, most often first", () => {
  assert.deepEqual(controllerShares([1, 1, 6, 1], [8, 8, 2, 9]), [
    { kind: 1, rows: 3, id: 8, idRows: 2 },
    { kind: 6, rows: 1, id: 2, idRows: 1 },
  ]);
});

test("a share of the step names the object that has it, or the most frequent one with its own share", () => {
  const [brick, contact] = controllerShares([3, 3, 6, 3], [20000017, 20000017, 2, 20000018]);
  assert.equal(controllerText(brick!, 4), "brick, most often 20000017 (50 %)");
  assert.equal(controllerText(contact!, 4), "interface 2");
  assert.equal(controllerText({ kind: 7, rows: 4, id: 0, idRows: 4 }, 4), "fixed");
});

test("shares of the phases add up to one: parts of a phase do not count again", () => {
  const timings = [
    { name: "run", seconds: 11 },
    { name: "elements", seconds: 6 },
    { name: "elements bricks", seconds: 5.5 },
    { name: "contact search", seconds: 2 },
    { name: "output", seconds: 0 },
  ];
  assert.deepEqual(phaseShares({ timings } as unknown as RunManifest), [
    { name: "elements", share: 0.75 },
    { name: "contact search", share: 0.25 },
  ]);
});

test("findings: worst first, and what the reader repeats as text only once", () => {
  const finding = (severity: "note" | "warning" | "error", code: string) => ({ severity, code });
  const run = {
    findings: [finding("note", "contact.clearance"), finding("error", "deck.card")],
    contact: [finding("note", "contact.clearance"), finding("warning", "contact.crossed")],
    run_findings: [finding("warning", "contact.energy_made")],
  } as unknown as RunManifest;
  assert.deepEqual(
    allFindings(run).map((f) => f.code),
    ["deck.card", "contact.energy_made", "contact.crossed", "contact.clearance"],
  );
});

test("how the run ended: a manifest that still says running is of a run without an end", () => {
  const of = (outcome?: RunManifest["outcome"]) => outcomeText({ outcome } as unknown as RunManifest);
  assert.equal(of({ kind: "finished", message: "" }).short, "finished");
  assert.equal(of({ kind: "failed", message: "the energy is not finite" }).long, "failed: the energy is not finite");
  assert.equal(of({ kind: "interrupted", message: "" }).long, "interrupted");
  for (const outcome of [undefined, { kind: "running" }]) {
    assert.equal(of(outcome).short, "not ended");
    assert.match(of(outcome).long, /stopped from outside/);
  }
});

test("an energy error that is not a number says so", () => {
  assert.equal(errorText(0.0123, 2), "1.2 %");
  assert.equal(errorText(null, 2), "not finite");
  assert.equal(errorText(undefined, 2), "");
});
