// Lines of the plots, from the columns of the time history.
import type { ReportDocument } from "./document";
import { formatNumber, type Dimension } from "./units";

export interface Line {
  label: string;
  values: Column;
  dimension: Dimension;
  /** Drawn against the right-hand axis. */
  right?: boolean;
  /** Off until it is asked for. */
  off?: boolean;
}

export type Column = Float32Array | Float64Array;
export type Columns = Map<string, Column>;

const energyNames: Record<string, string> = {
  IE: "internal",
  HE: "hourglass",
  KE: "kinetic",
  KER: "rotation",
  CE: "contact, stored",
  FW: "friction",
  DW: "damping",
  CX: "contact, made or lost",
  XE: "eroded, added mass",
  EXTW: "external work",
};

export function energyLines(columns: Columns): Line[] {
  const out: Line[] = [];
  for (const [code, name] of Object.entries(energyNames)) {
    const values = columns.get(`GLOBAL/${code}`);
    if (!values) continue;
    out.push({ label: `${code}  ${name}`, values, dimension: "energy", off: values.every((v) => v === 0) });
  }
  return out;
}

export function errorLines(columns: Columns): Line[] {
  const percent = (v: Column) => Float64Array.from(v, (x) => 100 * x);
  const out: Line[] = [];
  const error = columns.get("GLOBAL/ERR");
  const ledger = columns.get("GLOBAL/LEDGER");
  if (error) out.push({ label: "ERR  balance", values: percent(error), dimension: "none" });
  if (ledger) out.push({ label: "LEDGER  discrete works", values: percent(ledger), dimension: "none" });
  return out;
}

/** Ids of interfaces in the history, in its order. */
export function interfaceIds(names: readonly string[]): number[] {
  const ids = names.map((n) => /^INTER\/(\d+)\//.exec(n)?.[1]).filter((x) => x !== undefined);
  return [...new Set(ids.map(Number))];
}

function length(columns: Columns, prefix: string): Column | undefined {
  const parts = ["X", "Y", "Z"].map((c) => columns.get(prefix + c));
  if (parts.some((p) => !p)) return undefined;
  return Float64Array.from(parts[0]!, (x, i) => Math.hypot(x, parts[1]![i]!, parts[2]![i]!));
}

export function interfaceLines(columns: Columns, id: number): Line[] {
  const out: Line[] = [];
  const normal = length(columns, `INTER/${id}/FN`);
  const tangential = length(columns, `INTER/${id}/FT`);
  const count = columns.get(`INTER/${id}/NC`);
  if (normal) out.push({ label: "normal force", values: normal, dimension: "force" });
  if (tangential) out.push({ label: "friction force", values: tangential, dimension: "force", off: tangential.every((v) => v === 0) });
  for (const c of ["X", "Y", "Z"]) {
    const values = columns.get(`INTER/${id}/FN${c}`);
    if (values) out.push({ label: `FN${c}`, values, dimension: "force", off: true });
  }
  if (count) out.push({ label: "nodes in contact", values: count, dimension: "none", right: true });
  return out;
}

/** Who gives the time step, as numbers of GLOBAL/DTKIND (output/history_columns.cpp). */
export const controllers = ["none", "shell", "3-node shell", "brick", "tetrahedron", "node", "interface", "fixed", "contact at node"];

export interface ControllerShare {
  kind: number;
  rows: number;
  /** The object that controls most of these rows. */
  id: number;
  idRows: number;
}

/** How often who controlled the step, most often first. */
export function controllerShares(kinds: ArrayLike<number>, ids: ArrayLike<number> | undefined): ControllerShare[] {
  const all = new Map<number, { rows: number; ids: Map<number, number> }>();
  for (let i = 0; i < kinds.length; i++) {
    const kind = kinds[i]!;
    const entry = all.get(kind) ?? { rows: 0, ids: new Map<number, number>() };
    entry.rows++;
    const id = ids?.[i] ?? 0;
    entry.ids.set(id, (entry.ids.get(id) ?? 0) + 1);
    all.set(kind, entry);
  }
  return [...all.entries()]
    .map(([kind, { rows, ids: seen }]) => {
      const [id, idRows] = [...seen.entries()].sort((a, b) => b[1] - a[1])[0]!;
      return { kind, rows, id, idRows };
    })
    .sort((a, b) => b.rows - a.rows);
}

/** Who a share is about: the kind, and its only id, or the most frequent one with the share of that alone. */
export function controllerText(share: ControllerShare, rows: number): string {
  const kind = controllers[share.kind] ?? "?";
  if (!(share.id > 0)) return kind;
  if (share.idRows === share.rows) return `${kind} ${share.id}`;
  return `${kind}, most often ${share.id} (${formatNumber((100 * share.idRows) / rows, 3)} %)`;
}

/** Dimension of a column by its name. */
export function columnDimension(name: string): Dimension {
  const [kind, , variable = ""] = name.split("/");
  if (kind === "GLOBAL") {
    const v = name.split("/")[1]!;
    if (v === "DT") return "time";
    if (/MOM$/.test(v)) return "impulse";
    return ["ERR", "LEDGER", "DTKIND", "DTID"].includes(v) ? "none" : "energy";
  }
  if (kind === "NODE")
    return /^D/.test(variable)
      ? "length"
      : /^VR/.test(variable)
        ? "rate"
        : /^V/.test(variable)
          ? "speed"
          : /^AR/.test(variable)
            ? "none"
            : /^A/.test(variable)
              ? "acceleration"
              : "length";
  if (/^(INTER|RWALL|SECTIO)/.test(kind ?? "")) {
    if (/^I?F[NT][XYZ]$/.test(variable)) return variable.startsWith("I") ? "impulse" : "force";
    if (["CE", "FW", "DW", "CX"].includes(variable)) return "energy";
  }
  if (kind === "PART") {
    if (["IE", "KE", "HE", "RKE"].includes(variable)) return "energy";
    if (variable === "MASS") return "mass";
    if (/MOM$/.test(variable)) return "impulse";
    if (/^V/.test(variable)) return "speed";
  }
  if (kind === "BRIC" && /^S/.test(variable)) return "stress";
  return "none";
}

export function columnInfos(document: ReportDocument) {
  return document.history.names.map((name, i) => ({ name, info: document.history.columns[i]! }));
}

/** Row whose time is nearest. */
export function nearestIndex(times: ArrayLike<number>, time: number): number {
  let low = 0;
  let high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= time) low = middle;
    else high = middle;
  }
  return Math.abs(times[low]! - time) <= Math.abs(times[high]! - time) ? low : high;
}
