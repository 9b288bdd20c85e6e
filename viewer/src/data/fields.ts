// Fields as people choose them: a name, a unit, one number per node or element.
import { NO_VALUE, TOP, dequantise, type ChunkArray, type ChunkInfo } from "./chunk";
import type { FieldInfo, Frame } from "./document";
import type { Dimension } from "./units";

/** How values turn into colours. */
export type Look =
  | "plain" // the whole range
  | "sparse" // zero means "nothing here" and keeps the part's colour
  | "state"; // 0, 1, 2: apart, stick, slip

export interface FieldText {
  label: string;
  dimension: Dimension;
  look: Look;
  group: "Contact" | "Motion" | "Material" | "Other";
}

const known: Record<string, FieldText> = {
  contact_pressure: { label: "Contact pressure", dimension: "stress", look: "sparse", group: "Contact" },
  contact_shear: { label: "Contact shear stress", dimension: "stress", look: "sparse", group: "Contact" },
  contact_force: { label: "Contact force", dimension: "force", look: "sparse", group: "Contact" },
  contact_gap: { label: "Gap to the other surface", dimension: "length", look: "plain", group: "Contact" },
  contact_penetration: { label: "Penetration", dimension: "length", look: "sparse", group: "Contact" },
  contact_state: { label: "Stick or slip", dimension: "none", look: "state", group: "Contact" },
  displacement: { label: "Displacement", dimension: "length", look: "plain", group: "Motion" },
  velocity: { label: "Velocity", dimension: "speed", look: "plain", group: "Motion" },
  speed: { label: "Velocity", dimension: "speed", look: "plain", group: "Motion" },
  acceleration: { label: "Acceleration", dimension: "acceleration", look: "plain", group: "Motion" },
  angular_velocity: { label: "Angular velocity", dimension: "rate", look: "plain", group: "Motion" },
  plastic_strain: { label: "Plastic strain", dimension: "none", look: "plain", group: "Material" },
  von_mises: { label: "Von Mises stress", dimension: "stress", look: "plain", group: "Material" },
  pressure: { label: "Mean pressure", dimension: "stress", look: "plain", group: "Material" },
  stress: { label: "Stress", dimension: "stress", look: "plain", group: "Material" },
  density: { label: "Density", dimension: "density", look: "plain", group: "Material" },
  thickness: { label: "Thickness", dimension: "length", look: "plain", group: "Material" },
  hourglass_energy: { label: "Hourglass energy", dimension: "energy", look: "plain", group: "Material" },
  internal_force: { label: "Internal force", dimension: "force", look: "plain", group: "Other" },
  external_force: { label: "External force", dimension: "force", look: "plain", group: "Other" },
  mass: { label: "Nodal mass", dimension: "mass", look: "plain", group: "Other" },
};

export function fieldText(name: string): FieldText {
  const words = name.replaceAll("_", " ");
  return known[name] ?? { label: words.charAt(0).toUpperCase() + words.slice(1), dimension: "none", look: "plain", group: "Other" };
}

/** Names of what a field with so many components can show; -1 is the length of a vector. */
export function componentsOf(field: FieldInfo): { name: string; component: number }[] {
  if (field.components === 3)
    return [
      ["Size", -1],
      ["X", 0],
      ["Y", 1],
      ["Z", 2],
    ].map(([name, component]) => ({ name: String(name), component: Number(component) }));
  if (field.components === 6) return ["XX", "YY", "ZZ", "XY", "YZ", "XZ"].map((name, component) => ({ name, component }));
  return [{ name: "", component: 0 }];
}

export interface Range {
  low: number;
  high: number;
}

/** Smallest and largest value of a component in one frame. */
export function chunkRange(info: ChunkInfo, component: number): Range {
  if (component >= 0) return { low: info.low?.[component] ?? 0, high: info.high?.[component] ?? 0 };
  return { low: info.norm?.[0] ?? 0, high: info.norm?.[1] ?? 0 };
}

/** Over all frames. */
export function fieldRange(frames: readonly Frame[], field: number, component: number): Range {
  let low = Infinity;
  let high = -Infinity;
  for (const frame of frames) {
    const range = chunkRange(frame.values[field]!, component);
    low = Math.min(low, range.low);
    high = Math.max(high, range.high);
  }
  return low <= high ? { low, high } : { low: 0, high: 0 };
}

/** Value at one owner. */
export function valueAt(data: ChunkArray, info: ChunkInfo, component: number, owner: number): number {
  if (component >= 0) return dequantise(data[component * info.count + owner]!, info, component);
  let sum = 0;
  for (let c = 0; c < info.components; c++) sum += dequantise(data[c * info.count + owner]!, info, c) ** 2;
  return Math.sqrt(sum);
}

/** One component as quanta of `range`, in which the colours are looked up; a constant chunk has no quanta of its own. */
export function scalarQuanta(data: ChunkArray, info: ChunkInfo, component: number): { quanta: Uint16Array; range: Range } {
  const range = chunkRange(info, component);
  if (component >= 0) {
    const at = component * info.count;
    return { quanta: (data as Uint16Array).subarray(at, at + info.count), range };
  }
  const quanta = new Uint16Array(info.count);
  const scale = range.high > range.low ? TOP / (range.high - range.low) : 0;
  const n = info.count;
  const width = info.components;
  const low = info.low!;
  const unit = info.high!.map((h, c) => (h - low[c]!) / TOP);
  for (let i = 0; i < n; i++) {
    let sum = 0;
    for (let c = 0; c < width; c++) {
      const q = data[c * n + i]!;
      if (q === NO_VALUE) {
        sum = NaN;
        break;
      }
      const v = low[c]! + unit[c]! * q;
      sum += v * v;
    }
    quanta[i] = Number.isNaN(sum) ? NO_VALUE : Math.min(TOP, Math.max(0, Math.round((Math.sqrt(sum) - range.low) * scale)));
  }
  return { quanta, range };
}
