// What goes into the buffers of the picture.
import { BufferAttribute, type BufferGeometry } from "three";
import { TOP, type ChunkInfo } from "../data/chunk";

/** Index buffers grow and are filled again: three.js keeps the GPU's copy of a buffer as long as its geometry. */
export function fillIndex(geometry: BufferGeometry, index: Uint32Array): void {
  const old = geometry.index;
  if (old && old.array.length >= index.length) {
    (old.array as Uint32Array).set(index);
    old.needsUpdate = true;
  } else {
    const room = new Uint32Array(Math.max(12, Math.ceil(1.3 * index.length)));
    room.set(index);
    const attribute = new BufferAttribute(room, 1);
    attribute.setUsage(35048); // DYNAMIC_DRAW
    geometry.setIndex(attribute);
  }
  geometry.setDrawRange(0, index.length);
}

/**
 * Positions as drawn.
 * @param points planar, as the displacement's quanta are
 * @param scale of the displacement
 */
export function movedPoints(
  points: Float32Array,
  quanta: Uint16Array | undefined,
  info: ChunkInfo | undefined,
  scale: number,
): Float32Array {
  const out = new Float32Array(points);
  if (!quanta || !info?.low || !info.high) return out;
  const n = points.length / 3;
  for (let c = 0; c < 3; c++) {
    const low = scale * info.low[c]!;
    const unit = (scale * (info.high[c]! - info.low[c]!)) / TOP;
    for (let i = c * n; i < (c + 1) * n; i++) out[i] = out[i]! + low + unit * quanta[i]!;
  }
  return out;
}
