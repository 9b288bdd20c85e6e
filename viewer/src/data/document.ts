// The report's document: what src/report/ writes beside the chunks.
import type { ChunkInfo } from "./chunk";
import { formatNumber } from "./units";

export interface Finding {
  interface?: number;
  surface?: number;
  severity: "note" | "warning" | "error";
  code: string;
  what?: string;
  advice?: string;
  message?: string;
  measure?: { name: string; value: number } | number;
  nodes?: number[];
  segments?: number[][];
  histogram?: { low: number; high: number; count: number }[];
  time?: number;
  cycle?: number;
  file?: string;
  line?: number;
}

export interface RunManifest {
  abut: { version: string; commit?: string; compiler?: string };
  started?: string;
  decks?: string[];
  settings?: Record<string, unknown>;
  model: {
    name: string;
    title?: string;
    units: { mass: string; length: string; time: string };
    nodes: number;
    shells: number;
    sh3ns: number;
    bricks: number;
    tetras: number;
    parts: { id: number; title?: string; mass?: number }[];
    interfaces: { id: number; title?: string; type: string; stiffness_scale?: number; friction?: number; gap?: number }[];
    t_end?: number;
  };
  findings?: Finding[];
  contact?: Finding[];
  run_findings?: Finding[];
  outcome?: { kind: string; message?: string; cycles?: number; time?: number; wall_seconds?: number; element_cycles_per_second?: number };
  timings?: { name: string; seconds: number }[];
  energies?: Record<string, number | null>;
  mass?: { total: number; added: number; error: number };
  /** A value that is not a number is null. */
  worst?: { ERR?: { value: number | null; time: number }; CX?: { value: number | null; time: number } };
}

export interface FieldInfo {
  name: string;
  on: "node" | "element";
  components: number;
}

export interface Frame {
  time: number;
  cycle: number;
  /** One chunk per field, in the order of `fields`. */
  values: ChunkInfo[];
  /** u8 per face: 1 hidden. Absent: all are seen. */
  hidden?: ChunkInfo;
  deleted?: number;
}

export interface MeshInfo {
  origin: [number, number, number];
  points: ChunkInfo;
  /** Ids: idsOf(). */
  node_id: ChunkInfo;
  faces: ChunkInfo;
  face_element: ChunkInfo;
  element_id: ChunkInfo;
  element_part: ChunkInfo;
  element_shape: ChunkInfo;
  /** Part ids; `element_part` counts in this list. */
  parts: number[];
  /** Elements of each, also those that are not seen. */
  part_elements: number[];
  elements_total: number;
  nodes_total: number;
}

export interface ReportDocument {
  run: RunManifest;
  history: { names: string[]; rows: number; columns: ChunkInfo[] };
  mesh?: MeshInfo;
  contact?: { interface: number; side: number; surface: number; segments: ChunkInfo }[];
  fields?: FieldInfo[];
  fields_left_out?: boolean;
  frames: Frame[];
  /** States of the animation that could not be read. */
  states_left_out?: number;
  first?: number;
}

/** How the run ended. A manifest says "running" until the run itself writes its end; a run that is stopped from outside does not. */
export function outcomeText(run: RunManifest): { short: string; long: string } {
  const { kind = "running", message } = run.outcome ?? {};
  if (kind === "running") return { short: "not ended", long: "not ended: the run wrote no end; it goes on, or was stopped from outside" };
  if (kind === "finished") return { short: kind, long: "reached its end" };
  return { short: kind, long: message ? `${kind}: ${message}` : kind };
}

/** Phases of a run, the longest first, as shares of all. "elements shells" and the like are parts of "elements", "run" is the whole. */
export function phaseShares(run: RunManifest): { name: string; share: number }[] {
  const phases = (run.timings ?? []).filter((t) => t.name !== "run" && !t.name.startsWith("elements ") && t.seconds > 0);
  const total = phases.reduce((sum, t) => sum + t.seconds, 0);
  return phases.map((t) => ({ name: t.name, share: t.seconds / total })).sort((a, b) => b.share - a.share);
}

/** A share as text; null is what is not a number. Empty when there is none. */
export function errorText(value: number | null | undefined, digits: number): string {
  if (value === undefined) return "";
  return value === null ? "not finite" : `${formatNumber(100 * value, digits)} %`;
}

/** Findings of the inspection, of the run, and of the reader, each once: the reader's list repeats those of the inspection as text. */
export function allFindings(run: RunManifest): Finding[] {
  const rank = { error: 0, warning: 1, note: 2 };
  const inspected = run.contact ?? [];
  const codes = new Set(inspected.map((f) => f.code));
  const others = (run.findings ?? []).filter((f) => !codes.has(f.code));
  return [...(run.run_findings ?? []), ...inspected, ...others].sort((a, b) => rank[a.severity] - rank[b.severity]);
}
