// Chunks come back as they went in: the coder here is written from the description in src/report/chunk.hpp, not from its code.
import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateSync } from "node:zlib";
import { NO_VALUE, TOP, constantChunk, decodeChunk, dequantise, fromBase64, idsOf, type ChunkInfo } from "../src/data/chunk";

/** Planar integers of `width` bytes to a chunk's text. */
function encode(values: number[], components: number, width: 2 | 4, differences: boolean): string {
  const n = values.length / components;
  const modulus = 2 ** (8 * width);
  const coded = values.map((v, i) => {
    if (!differences) return v >>> 0;
    const before = i % n === 0 ? 0 : values[i - 1]!;
    let d = (((v - before) % modulus) + modulus) % modulus;
    if (d >= modulus / 2) d -= modulus;
    return d >= 0 ? 2 * d : -2 * d - 1;
  });
  const planes: number[] = [];
  for (let k = 0; k < width; k++) for (const c of coded) planes.push(Math.floor(c / 2 ** (8 * k)) % 256);
  return deflateSync(Uint8Array.from(planes)).toString("base64");
}

function random(seed: number): () => number {
  let state = seed;
  return () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
}

test("base64 of every length, with and without the browser's own decoder", () => {
  const native = (Uint8Array as unknown as Record<string, unknown>)["fromBase64"];
  delete (Uint8Array as unknown as Record<string, unknown>)["fromBase64"];
  for (let n = 0; n < 70; n++) {
    const bytes = Uint8Array.from({ length: n }, (_, i) => (i * 37 + n * 11) & 255);
    assert.deepEqual(fromBase64(Buffer.from(bytes).toString("base64")), bytes);
  }
  if (native) (Uint8Array as unknown as Record<string, unknown>)["fromBase64"] = native;
});

test("16-bit chunks: each component starts from zero and wraps around", async () => {
  const next = random(1);
  const values = [...Array.from({ length: 500 }, () => Math.floor(next() * 65536)), 0, 65535, 0, 65535, 1, 32768, 32767, 5, 5, 5];
  const info: ChunkInfo = { id: 0, kind: "q16", count: values.length / 2, components: 2 };
  assert.deepEqual([...(await decodeChunk(info, encode(values, 2, 2, true)))], values);
});

test("32-bit integers beyond the sign bit", async () => {
  const values = [0, 4294967295, 1, 2147483648, 2147483647, 70000, 69999, 12];
  const info: ChunkInfo = { id: 0, kind: "u32", count: 4, components: 2 };
  assert.deepEqual([...(await decodeChunk(info, encode(values, 2, 4, true)))], values);
});

test("single-precision numbers keep their bits", async () => {
  const values = Float32Array.from([0, -1.5, 3.4e38, 1e-45, Math.PI, -0]);
  const words = [...new Uint32Array(values.buffer)];
  const info: ChunkInfo = { id: 0, kind: "f32", count: 6, components: 1 };
  const back = await decodeChunk(info, encode(words, 1, 4, false));
  assert.deepEqual(new Uint32Array(back.buffer), new Uint32Array(values.buffer));
});

test("values between the ends of a chunk, and none", () => {
  const info: ChunkInfo = { id: 0, kind: "q16", count: 1, components: 2, low: [0, -2], high: [1, 6] };
  assert.equal(dequantise(0, info, 1), -2);
  assert.equal(dequantise(TOP, info, 1), 6);
  assert.equal(dequantise(TOP / 2, info, 1), 2);
  assert.ok(Number.isNaN(dequantise(NO_VALUE, info, 0)));
});

test("a chunk without text is its lowest value everywhere", () => {
  const info: ChunkInfo = { id: -1, kind: "q16", count: 3, components: 1, low: [7], high: [7] };
  const data = constantChunk(info);
  assert.equal(data.length, 3);
  assert.equal(dequantise(data[2]!, info, 0), 7);
});

test("ids beyond 32 bits are exact", async () => {
  const ids = [5000000001, 5000000002, 9999999999, 7];
  const words = [...ids.map((i) => i % 2 ** 32), ...ids.map((i) => Math.floor(i / 2 ** 32))];
  const info: ChunkInfo = { id: 0, kind: "u32", count: 4, components: 2 };
  assert.deepEqual([...idsOf(await decodeChunk(info, encode(words, 2, 4, true)))], ids);
});
