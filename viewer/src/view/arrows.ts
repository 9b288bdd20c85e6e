// Arrows along the normals of contact segments, as lines.
import { BufferAttribute, BufferGeometry, LineSegments, Vector3, Vector4 } from "three";
import { displacement, plainMaterial } from "./materials";

export interface ArrowGroup {
  /** Node numbers, four per segment (a triangle repeats its third). */
  segments: readonly (readonly number[])[];
  color: [number, number, number];
}

/** Ends of the lines: a shaft and two strokes at its tip for every segment, three numbers per end. */
export function arrowLines(segments: ArrowGroup["segments"], positions: Float32Array): Float32Array {
  const n = positions.length / 3;
  const at = (i: number) => new Vector3(positions[i]!, positions[n + i]!, positions[2 * n + i]!);
  const out: number[] = [];
  for (const s of segments) {
    const x = s.map((i) => at(i));
    const triangle = s[3] === s[2];
    const centre = triangle
      ? x[0]!.clone().add(x[1]!).add(x[2]!).divideScalar(3)
      : x[0]!.clone().add(x[1]!).add(x[2]!).add(x[3]!).divideScalar(4);
    const along = triangle ? x[1]!.clone().sub(x[0]!) : x[2]!.clone().sub(x[0]!);
    const across = triangle ? x[2]!.clone().sub(x[0]!) : x[3]!.clone().sub(x[1]!);
    const normal = along.clone().cross(across);
    const length = 0.55 * Math.sqrt(normal.length() / 2);
    normal.normalize().multiplyScalar(length);
    const tip = centre.clone().add(normal);
    out.push(...centre.toArray(), ...tip.toArray());
    const side = along.normalize().multiplyScalar(0.14 * length);
    const back = normal.clone().multiplyScalar(0.72).add(centre);
    out.push(...tip.toArray(), ...back.clone().add(side).toArray(), ...tip.toArray(), ...back.clone().sub(side).toArray());
  }
  return Float32Array.from(out);
}

export function makeArrows(group: ArrowGroup, positions: Float32Array): LineSegments {
  const ends = arrowLines(group.segments, positions);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(ends, 3));
  geometry.setAttribute("frame", new BufferAttribute(new Uint16Array((ends.length / 3) * 4), 4, true));
  const lines = new LineSegments(geometry, plainMaterial(displacement(0), new Vector4(...group.color, 1), { forward: 5e-5 }));
  lines.frustumCulled = false;
  lines.renderOrder = 10;
  return lines;
}
