// The picture while it moves: fewer triangles, the same surface, values of elements where the shader looks for them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { cluster, coarseTriangles } from "../src/view/coarse";
import { assignVertices, type Faces } from "../src/view/mesh";

interface Mesh {
  faces: Faces;
  points: Float32Array;
  partOf: Uint32Array;
}
/** Plates of n by n quadrilaterals of edge h side by side along x, each a part of its own, above each other by 0.1 h: no nodes shared. */
function plates(...list: { n: number; h: number }[]): Mesh {
  const quads: number[][] = [];
  const x: number[][] = [];
  const partOf: number[] = [];
  list.forEach(({ n, h }, part) => {
    const first = x.length;
    for (let j = 0; j <= n; j++) for (let i = 0; i <= n; i++) x.push([i * h, j * h, 0.1 * h * part]);
    const at = (i: number, j: number) => first + i + (n + 1) * j;
    for (let j = 0; j < n; j++)
      for (let i = 0; i < n; i++) {
        quads.push([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        partOf.push(part);
      }
  });
  const corners = Uint32Array.from([0, 1, 2, 3].flatMap((k) => quads.map((q) => q[k]!)));
  return {
    faces: { count: quads.length, corners },
    points: Float32Array.from([0, 1, 2].flatMap((c) => x.map((p) => p[c]!))),
    partOf: Uint32Array.from(partOf),
  };
}
function area(index: Uint32Array, points: Float32Array): number {
  const n = points.length / 3;
  let sum = 0;
  for (let t = 0; t < index.length; t += 3) {
    const [a, b, c] = [index[t]!, index[t + 1]!, index[t + 2]!];
    const [px, py] = [points[b]! - points[a]!, points[n + b]! - points[n + a]!];
    const [qx, qy] = [points[c]! - points[a]!, points[n + c]! - points[n + a]!];
    sum += (px * qy - py * qx) / 2;
  }
  return sum;
}

test("a mesh of squares keeps a fourth of its triangles and its area to the border", () => {
  const { faces, points, partOf } = plates({ n: 64, h: 0.5 });
  const vertices = assignVertices(faces, points.length / 3);
  const clusters = cluster(faces, vertices, points, partOf);
  assert.equal(clusters.cell, 1);
  const index = coarseTriangles(faces, vertices, clusters, () => true);
  assert.ok(index.length / 3 <= 0.27 * 2 * faces.count, `${index.length / 3} triangles of ${2 * faces.count}`);
  const whole = (64 * 0.5) ** 2;
  const lost = whole - area(index, points);
  assert.ok(lost >= 0 && lost <= 4 * 64 * 0.5 * 0.5, "no more is lost than a strip of an element's width along the border");
});

test("the last vertex of each triangle carries the value of an element of its own part", () => {
  const { faces, points, partOf } = plates({ n: 50, h: 1 }, { n: 60, h: 0.8 });
  const vertices = assignVertices(faces, points.length / 3);
  const index = coarseTriangles(faces, vertices, cluster(faces, vertices, points, partOf), () => true);
  const split = 51 * 51; // nodes of the first plate
  for (let t = 0; t < index.length; t += 3) {
    const part = index[t]! < split ? 0 : 1;
    for (let k = 0; k < 3; k++) assert.equal(index[t + k]! < split ? 0 : 1, part, "parts are not merged with each other");
    const face = vertices.faceOf[index[t + 2]!]!;
    assert.ok(face >= 0);
    assert.equal(partOf[face], part);
  }
});

test("small parts stay as they are, and hidden faces are not drawn", () => {
  const { faces, points, partOf } = plates({ n: 20, h: 1 });
  const vertices = assignVertices(faces, points.length / 3);
  const clusters = cluster(faces, vertices, points, partOf);
  assert.equal(clusters.cell, 0);
  assert.equal(coarseTriangles(faces, vertices, clusters, () => true).length, 6 * faces.count);
  assert.equal(coarseTriangles(faces, vertices, clusters, (f) => f % 4 === 0).length, (6 * faces.count) / 4);
});
