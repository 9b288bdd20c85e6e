// Names of units and numbers as text.

export interface UnitNames {
  mass: string;
  length: string;
  time: string;
}
export type Dimension =
  | "none"
  | "length"
  | "time"
  | "mass"
  | "speed"
  | "acceleration"
  | "force"
  | "stress"
  | "energy"
  | "density"
  | "rate"
  | "impulse";

/** Force, stress and energy in the unit systems that people use. */
const named: Record<string, { force: string; stress: string; energy: string }> = {
  "kg m s": { force: "N", stress: "Pa", energy: "J" },
  "Mg mm s": { force: "N", stress: "MPa", energy: "mJ" },
  "t mm s": { force: "N", stress: "MPa", energy: "mJ" },
  "kg mm ms": { force: "kN", stress: "GPa", energy: "J" },
  "g mm ms": { force: "N", stress: "MPa", energy: "mJ" },
};

export function unitName(units: UnitNames, dimension: Dimension): string {
  const { mass, length, time } = units;
  const system = named[`${mass} ${length} ${time}`];
  switch (dimension) {
    case "none":
      return "";
    case "length":
      return length;
    case "time":
      return time;
    case "mass":
      return mass;
    case "speed":
      return `${length}/${time}`;
    case "acceleration":
      return `${length}/${time}²`;
    case "rate":
      return `1/${time}`;
    case "density":
      return `${mass}/${length}³`;
    case "force":
      return system?.force ?? `${mass}·${length}/${time}²`;
    case "stress":
      return system?.stress ?? `${mass}/(${length}·${time}²)`;
    case "energy":
      return system?.energy ?? `${mass}·${length}²/${time}²`;
    case "impulse":
      return system ? `${system.force}·${time}` : `${mass}·${length}/${time}`;
  }
}

/** Four significant digits, without trailing zeros: 0.001234, 1.5e-7, 12350. */
export function formatNumber(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${Number(mantissa)}e${Number(exponent)}`.replace("-", "−").replace("e-", "e−");
  }
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}

export function formatCount(value: number): string {
  return Math.round(value).toLocaleString("en-US").replaceAll(",", "\u202f");
}

export function formatBytes(bytes: number): string {
  return bytes >= 1e6 ? `${(bytes / 1e6).toFixed(1)} MB` : `${Math.round(bytes / 1e3)} kB`;
}

/** "12 nodes", "1 node". */
export function plural(count: number, noun: string): string {
  return `${formatCount(count)} ${noun}${count === 1 ? "" : "s"}`;
}
