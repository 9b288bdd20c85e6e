// Colour maps with even steps of lightness, so that a step of the value looks alike everywhere.

export interface ColorMap {
  name: string;
  /** sRGB 0..255 at even distances. */
  stops: readonly (readonly [number, number, number])[];
}

function fromHex(name: string, text: string): ColorMap {
  return { name, stops: text.split(" ").map((h) => [0, 2, 4].map((i) => parseInt(h.slice(i, i + 2), 16)) as [number, number, number]) };
}

/** Viridis, Inferno (van der Walt, Smith 2015, CC0), and a cyan-grey-red pair for signed values. */
export const colorMaps: readonly ColorMap[] = [
  fromHex(
    "Viridis",
    "440154 481467 482576 453781 404688 39558c 33638d 2d718e 287d8e 238a8d 1f968b 20a386 29af7f 3dbc74 56c667 75d054 95d840 bade28 dde318 fde725",
  ),
  fromHex(
    "Inferno",
    "000004 08051d 180c3c 2f0a5b 450a69 5c126e 71196e 87216b 9b2964 b1325a c43c4e d74b3f e55c30 f1711f f8870e fca108 fbba1f f6d746 f1ed71 fcffa4",
  ),
  fromHex(
    "Cividis",
    "00224e 002c65 04366f 243f6d 38486c 48526c 565c6d 636671 6f7073 7b7a77 888478 958f78 a39a76 b2a672 c1b26b d0be61 e0cb55 f0d846 fee838",
  ),
  fromHex("Blue to red", "2f4aa8 4767b8 6585c7 86a3d4 a9bfdf ccd8e8 e8e9ea edd4c8 ebb9a3 e39a7e d7795d c75642 b03030"),
];

/** Colour at t in 0..1. */
export function colorAt(map: ColorMap, t: number): [number, number, number] {
  const last = map.stops.length - 1;
  const x = Math.min(1, Math.max(0, t)) * last;
  const i = Math.min(last - 1, Math.floor(x));
  const f = x - i;
  const p = map.stops[i]!;
  const q = map.stops[i + 1]!;
  return [0, 1, 2].map((c) => p[c]! + (q[c]! - p[c]!) * f) as [number, number, number];
}

/** RGBA bytes for a texture of `size` texels. */
export function colorTable(map: ColorMap, size = 256): Uint8Array<ArrayBuffer> {
  const out = new Uint8Array(4 * size);
  for (let i = 0; i < size; i++) {
    const c = colorAt(map, i / (size - 1));
    out.set([Math.round(c[0]), Math.round(c[1]), Math.round(c[2]), 255], 4 * i);
  }
  return out;
}

export function css(color: readonly [number, number, number]): string {
  return `rgb(${color.map((c) => Math.round(c)).join(" ")})`;
}

/** Ticks at round values within a range: about `count` of them. */
export function ticks(low: number, high: number, count = 5): number[] {
  if (!(high > low)) return [low];
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((m) => m * power).find((s) => (high - low) / s <= count) ?? 10 * power;
  const out: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) out.push(k * step + 0);
  return out;
}

/** Muted colours for parts: told apart by hue, alike in lightness, none of them a colour of the maps. */
const partColors: readonly [number, number, number][] = [
  [158, 170, 186],
  [196, 178, 152],
  [160, 184, 166],
  [190, 164, 176],
  [170, 166, 196],
  [188, 190, 150],
  [150, 186, 190],
  [198, 170, 160],
];
export function partColor(index: number): [number, number, number] {
  return [...partColors[index % partColors.length]!];
}
