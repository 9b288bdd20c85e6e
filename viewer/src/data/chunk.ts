// Reads the chunks that src/report/chunk.cpp writes (its header says how).

export type ChunkKind = "q16" | "u32" | "f32" | "u8";

/** What the document says of a chunk; id -1: constant, `low` is its value. */
export interface ChunkInfo {
  id: number;
  kind: ChunkKind;
  count: number;
  components: number;
  low?: number[];
  high?: number[];
  /** q16 vectors: smallest and largest length. */
  norm?: [number, number];
}

export type ChunkArray = Uint16Array | Uint32Array | Float32Array | Uint8Array;

/** Quantum that stands for "no value". */
export const NO_VALUE = 65535;
/** Quantum of `high`. */
export const TOP = 65534;

const digits = (() => {
  const table = new Uint8Array(128);
  const text = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (let i = 0; i < 64; i++) table[text.charCodeAt(i)] = i;
  return table;
})();

export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const native = (Uint8Array as unknown as { fromBase64?: (t: string) => Uint8Array<ArrayBuffer> }).fromBase64;
  if (native) return native.call(Uint8Array, text);
  const padding = text.endsWith("==") ? 2 : text.endsWith("=") ? 1 : 0;
  const out = new Uint8Array((text.length / 4) * 3 - padding);
  let to = 0;
  for (let i = 0; i < text.length; i += 4) {
    const word =
      (digits[text.charCodeAt(i)]! << 18) |
      (digits[text.charCodeAt(i + 1)]! << 12) |
      (digits[text.charCodeAt(i + 2)]! << 6) |
      digits[text.charCodeAt(i + 3)]!;
    out[to++] = word >> 16;
    if (to < out.length) out[to++] = (word >> 8) & 255;
    if (to < out.length) out[to++] = word & 255;
  }
  return out;
}

export async function inflate(data: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const stream = new Blob([data]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Inflated planes to values: planar, component by component. */
export function fromPlanes(planes: Uint8Array, info: ChunkInfo): ChunkArray {
  const n = info.count * info.components;
  if (info.kind === "u8") return planes;
  if (info.kind === "q16") {
    const out = new Uint16Array(n);
    for (let c = 0, i = 0; c < info.components; c++) {
      let value = 0;
      for (const end = i + info.count; i < end; i++) {
        const z = planes[i]! | (planes[n + i]! << 8);
        value = (value + ((z >>> 1) ^ -(z & 1))) & 65535;
        out[i] = value;
      }
    }
    return out;
  }
  const words = new Uint32Array(n);
  for (let i = 0; i < n; i++) {
    words[i] = planes[i]! | (planes[n + i]! << 8) | (planes[2 * n + i]! << 16) | (planes[3 * n + i]! << 24);
  }
  if (info.kind === "f32") return new Float32Array(words.buffer);
  for (let c = 0, i = 0; c < info.components; c++) {
    let value = 0;
    for (const end = i + info.count; i < end; i++) {
      const z = words[i]!;
      value = (value + ((z >>> 1) ^ -(z & 1))) | 0;
      words[i] = value;
    }
  }
  return words;
}

export async function decodeChunk(info: ChunkInfo, text: string): Promise<ChunkArray> {
  return fromPlanes(await inflate(fromBase64(text)), info);
}

/** Ids of a u32 chunk of two components, the low words and the high ones: exact up to 2^53. */
export function idsOf(words: ArrayLike<number>): Float64Array {
  const n = words.length / 2;
  return Float64Array.from({ length: n }, (_, i) => words[i]! + 4294967296 * words[n + i]!);
}

/** A chunk without text. */
export function constantChunk(info: ChunkInfo): ChunkArray {
  const n = info.count * info.components;
  return info.kind === "q16"
    ? new Uint16Array(n)
    : info.kind === "u8"
      ? new Uint8Array(n)
      : info.kind === "u32"
        ? new Uint32Array(n)
        : new Float32Array(n);
}

/** Value of one quantum; NaN for none. */
export function dequantise(q: number, info: ChunkInfo, component: number): number {
  if (q === NO_VALUE) return NaN;
  const low = info.low?.[component] ?? 0;
  const high = info.high?.[component] ?? 0;
  const value = low + ((high - low) * q) / TOP;
  return Math.abs(value) < 1e-9 * (high - low) ? 0 : value;
}
