// Topology of the picture: a vertex of its own for every face, edges each once, outlines where shapes end, picking against geometry.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  assignVertices,
  corner,
  edgeLines,
  faceNormals,
  featureEdges,
  findEdges,
  isTriangle,
  triangles,
  type Faces,
} from "../src/view/mesh";
import { arrowLines } from "../src/view/arrows";
import { pick } from "../src/view/pick";

function planar(faces: number[][]): Faces {
  const out = new Uint32Array(faces.length * 4);
  faces.forEach((f, i) => [0, 1, 2, 3].forEach((k) => (out[k * faces.length + i] = f[k] ?? f[2]!)));
  return { count: faces.length, corners: out };
}
/** A plane grid of n by n quadrilaterals, and its points (planar). */
function grid(n: number): { faces: Faces; nodes: number; points: Float32Array } {
  const at = (i: number, j: number) => i + (n + 1) * j;
  const list: number[][] = [];
  for (let j = 0; j < n; j++) for (let i = 0; i < n; i++) list.push([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
  const nodes = (n + 1) ** 2;
  const points = new Float32Array(3 * nodes);
  for (let j = 0; j <= n; j++)
    for (let i = 0; i <= n; i++) {
      points[at(i, j)] = i;
      points[nodes + at(i, j)] = j;
    }
  return { faces: planar(list), nodes, points };
}
const cube = planar([
  [0, 3, 2, 1],
  [4, 5, 6, 7],
  [0, 1, 5, 4],
  [1, 2, 6, 5],
  [2, 3, 7, 6],
  [3, 0, 4, 7],
]);
const cubePoints = Float32Array.from([0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1]);

function checkVertices(faces: Faces, nodes: number): number {
  const v = assignVertices(faces, nodes);
  assert.equal(new Set(v.ofFace).size, faces.count, "no two faces share their vertex");
  for (let f = 0; f < faces.count; f++) {
    assert.equal(v.faceOf[v.ofFace[f]!], f);
    assert.equal(v.node[v.ofFace[f]!], corner(faces, f, v.turn[f]!), "the vertex is a corner of its face");
  }
  for (let n = 0; n < nodes; n++) assert.equal(v.node[n], n);
  const index = triangles(faces, v, () => true);
  let at = 0;
  for (let f = 0; f < faces.count; f++) {
    const corners = [0, 1, 2, 3].map((k) => corner(faces, f, k)).slice(0, isTriangle(faces, f) ? 3 : 4);
    for (let t = 0; t < corners.length - 2; t++, at += 3) {
      assert.equal(index[at + 2], v.ofFace[f], "the face's vertex is the last of its triangle");
      const order = [0, 1, 2].map((k) => corners.indexOf(v.node[index[at + k]!]!));
      const turns = order.filter((x, k) => x > order[(k + 1) % 3]!).length;
      assert.equal(turns, 1, "the triangle turns like its face");
    }
  }
  assert.equal(at, index.length);
  return v.node.length - nodes;
}

test("a grid of quadrilaterals needs no copies of nodes", () => {
  const { faces, nodes } = grid(20);
  assert.equal(checkVertices(faces, nodes), 0);
});
test("a closed box, and triangles, of which there are more than nodes", () => {
  assert.ok(checkVertices(cube, 8) <= 1);
  const octahedron = planar([
    [0, 2, 4],
    [2, 1, 4],
    [1, 3, 4],
    [3, 0, 4],
    [2, 0, 5],
    [1, 2, 5],
    [3, 1, 5],
    [0, 3, 5],
  ]);
  const copies = checkVertices(octahedron, 6);
  assert.ok(copies >= 2 && copies <= 3, `eight faces, six nodes: ${copies} copies`);
});

test("edges come once each: Euler's count", () => {
  const { faces, nodes } = grid(7);
  const edges = findEdges(faces, nodes);
  assert.equal(edges.count, nodes + faces.count - 1);
  const border = [...edges.right.subarray(0, edges.count)].filter((f) => f === -1).length;
  assert.equal(border, 4 * 7);
  assert.equal(findEdges(cube, 8).count, 12);
});

test("outlines: a box has twelve, a plane its border, two parts the line between them", () => {
  const all = findEdges(cube, 8);
  assert.equal(
    featureEdges(all, faceNormals(cube, cubePoints), () => 0).reduce((a, b) => a + b, 0),
    12,
  );
  const { faces, nodes, points } = grid(4);
  const edges = findEdges(faces, nodes);
  const normals = faceNormals(faces, points);
  assert.equal(
    featureEdges(edges, normals, () => 0).reduce((a, b) => a + b, 0),
    16,
  );
  assert.equal(
    featureEdges(edges, normals, (f) => (f % 4 < 2 ? 0 : 1)).reduce((a, b) => a + b, 0),
    16 + 4,
  );
});

test("lines and triangles of hidden faces go; an edge stays while one of its faces is seen", () => {
  const { faces, nodes } = grid(2);
  const edges = findEdges(faces, nodes);
  const one = (f: number) => f === 0;
  assert.equal(edgeLines(edges, undefined, one).length, 2 * 4);
  assert.equal(triangles(faces, assignVertices(faces, nodes), one).length, 6);
});

test("normals look outward where faces do", () => {
  const normals = faceNormals(cube, cubePoints);
  assert.deepEqual(
    [...normals.subarray(0, 6)].map((x) => Math.round(x) + 0),
    [0, 0, -1, 0, 0, 1],
  );
});

test("a ray meets the nearest visible face and names its nearest corner", () => {
  const down: [number, number, number] = [0, 0, -1];
  const top = pick(cube, cubePoints, () => true, [0.9, 0.8, 5], down)!;
  assert.equal(top.face, 1);
  assert.equal(top.node, 6);
  assert.ok(Math.abs(top.distance - 4) < 1e-6);
  assert.equal(pick(cube, cubePoints, (f) => f !== 1, [0.9, 0.8, 5], down)!.face, 0);
  assert.equal(
    pick(cube, cubePoints, () => true, [1.5, 0.5, 5], down),
    undefined,
  );
  assert.equal(
    pick(cube, cubePoints, () => true, [0.5, 0.5, -5], down),
    undefined,
    "nothing behind the eye",
  );
});

test("arrows stand on the middle of a segment, along its normal by the right-hand rule, as long as 0.55 of its side", () => {
  const square = Float32Array.from([0, 2, 2, 0, 0, 0, 2, 2, 1, 1, 1, 1]);
  const shaft = (segment: number[]) => [...arrowLines([segment], square).slice(0, 6)];
  const near = (found: number[], wanted: number[]) => found.forEach((x, i) => assert.ok(Math.abs(x - wanted[i]!) < 1e-6, `${found}`));
  near(shaft([0, 1, 2, 3]), [1, 1, 1, 1, 1, 1 + 0.55 * 2]);
  near(shaft([3, 2, 1, 0]), [1, 1, 1, 1, 1, 1 - 0.55 * 2]);
  near(shaft([0, 1, 2, 2]), [4 / 3, 2 / 3, 1, 4 / 3, 2 / 3, 1 + 0.55 * Math.SQRT2]); // a triangle repeats its third node
  assert.equal(arrowLines([[0, 1, 2, 3]], square).length, 18); // a shaft and two strokes at its tip
});
