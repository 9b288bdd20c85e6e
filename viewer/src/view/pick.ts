// What lies under a point of the picture: a ray against the visible faces as they are drawn.
import { corner, isTriangle, type Faces } from "./mesh";

export type Vec = [number, number, number];

export interface Hit {
  face: number;
  /** Corner of the face nearest to the hit. */
  node: number;
  point: Vec;
  distance: number;
}

/**
 * Nearest visible face that the ray meets, from either side (Moeller, Trumbore 1997).
 * @param points planar positions as drawn
 */
export function pick(faces: Faces, points: Float32Array, visible: (face: number) => boolean, origin: Vec, direction: Vec): Hit | undefined {
  const n = points.length / 3;
  const [ox, oy, oz] = origin;
  const [dx, dy, dz] = direction;
  let best = Infinity;
  let face = -1;
  for (let f = 0; f < faces.count; f++) {
    if (!visible(f)) continue;
    const a = corner(faces, f, 0);
    const last = isTriangle(faces, f) ? 1 : 2;
    for (let t = 1; t <= last; t++) {
      const b = corner(faces, f, t);
      const c = corner(faces, f, t + 1);
      const ax = points[a]!,
        ay = points[n + a]!,
        az = points[2 * n + a]!;
      const e1x = points[b]! - ax,
        e1y = points[n + b]! - ay,
        e1z = points[2 * n + b]! - az;
      const e2x = points[c]! - ax,
        e2y = points[n + c]! - ay,
        e2z = points[2 * n + c]! - az;
      const px = dy * e2z - dz * e2y,
        py = dz * e2x - dx * e2z,
        pz = dx * e2y - dy * e2x;
      const det = e1x * px + e1y * py + e1z * pz;
      if (det === 0) continue;
      const sx = ox - ax,
        sy = oy - ay,
        sz = oz - az;
      const u = (sx * px + sy * py + sz * pz) / det;
      if (u < 0 || u > 1) continue;
      const qx = sy * e1z - sz * e1y,
        qy = sz * e1x - sx * e1z,
        qz = sx * e1y - sy * e1x;
      const v = (dx * qx + dy * qy + dz * qz) / det;
      if (v < 0 || u + v > 1) continue;
      const distance = (e2x * qx + e2y * qy + e2z * qz) / det;
      if (distance > 0 && distance < best) {
        best = distance;
        face = f;
      }
    }
  }
  if (face < 0) return undefined;
  const point: Vec = [ox + best * dx, oy + best * dy, oz + best * dz];
  let node = corner(faces, face, 0);
  let nearest = Infinity;
  for (let k = 0; k < 4; k++) {
    const i = corner(faces, face, k);
    const d = Math.hypot(points[i]! - point[0], points[n + i]! - point[1], points[2 * n + i]! - point[2]);
    if (d < nearest) {
      nearest = d;
      node = i;
    }
  }
  return { face, node, point, distance: best };
}
