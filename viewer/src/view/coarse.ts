// A coarser picture for while it moves, where drawing all of it takes long: nodes that lie within one cell of a grid are drawn as one of
// them [Rossignac and Borrel 1993, Multi-resolution 3D approximations for rendering complex scenes]. No graphics library here.
import { corner, isTriangle, type Faces, type Vertices } from "./mesh";

/** Parts with fewer faces stay as they are. */
const FEW = 2000;

export interface Clusters {
  /** Vertex that stands for each node: one of its own part; one that has a face of its own, where there is one in the cell. */
  of: Uint32Array;
  /** Longest edge of a cell; 0: nothing is merged. */
  cell: number;
}

/** Median length of about a thousand edges of some faces. Points are planar (all x, all y, all z). */
function typicalEdge(faces: Faces, points: Float32Array, some: readonly number[]): number {
  const n = points.length / 3;
  const lengths: number[] = [];
  for (let i = 0, step = Math.max(1, Math.floor(some.length / 500)); i < some.length; i += step) {
    for (const k of [0, 1]) {
      const [p, q] = [corner(faces, some[i]!, k), corner(faces, some[i]!, k + 1)];
      lengths.push(Math.hypot(...[0, n, 2 * n].map((c) => points[c + p]! - points[c + q]!)));
    }
  }
  return lengths.sort((a, b) => a - b)[lengths.length >> 1] ?? 0;
}

/** Part of each node: of the face whose vertex it is, or else of any face on it; -1: on no face. */
function partOfNodes(faces: Faces, vertices: Vertices, nodes: number, partOf: Uint32Array): Int32Array {
  const out = new Int32Array(nodes).fill(-1);
  for (let k = 0; k < 4; k++) for (let f = 0; f < faces.count; f++) out[corner(faces, f, k)] = partOf[f]!;
  for (let i = 0; i < nodes; i++) if (vertices.faceOf[i]! >= 0) out[i] = partOf[vertices.faceOf[i]!]!;
  return out;
}

/**
 * Cells of twice the part's typical edge, so that a mesh of squares keeps a fourth of its faces. Parts are not merged with each other.
 * @param points of the nodes, planar
 * @param partOf part (0, 1, ...) of each face
 */
export function cluster(faces: Faces, vertices: Vertices, points: Float32Array, partOf: Uint32Array): Clusters {
  const n = points.length / 3;
  const of = Uint32Array.from({ length: n }, (_, i) => i);
  const facesOf: number[][] = [];
  for (let f = 0; f < faces.count; f++) (facesOf[partOf[f]!] ??= []).push(f);
  const partOfNode = partOfNodes(faces, vertices, n, partOf);
  const nodesOf: number[][] = facesOf.map(() => []);
  // Those that can carry a value of an element come first: the first of a cell stands for it.
  for (const owns of [true, false])
    for (let i = 0; i < n; i++) if (partOfNode[i]! >= 0 && vertices.faceOf[i]! >= 0 === owns) nodesOf[partOfNode[i]!]!.push(i);
  let longest = 0;
  facesOf.forEach((list, part) => {
    const edge = list.length < FEW ? 0 : typicalEdge(faces, points, list);
    if (!(edge > 0)) return;
    const cell = 2 * edge;
    longest = Math.max(longest, cell);
    const nodes = nodesOf[part]!;
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const i of nodes)
      for (let c = 0; c < 3; c++) {
        low[c] = Math.min(low[c]!, points[c * n + i]!);
        high[c] = Math.max(high[c]!, points[c * n + i]!);
      }
    // Half an edge before the first node: regular nodes lie inside the cells, not on their borders.
    const at = (c: number, x: number) => Math.floor((x - low[c]! + 0.5 * edge) / cell);
    const width = [0, 1].map((c) => at(c, high[c]!) + 1);
    const first = new Map<number, number>();
    for (const i of nodes) {
      const key = at(0, points[i]!) + width[0]! * (at(1, points[n + i]!) + width[1]! * at(2, points[2 * n + i]!));
      const known = first.get(key);
      if (known === undefined) first.set(key, i);
      else of[i] = known;
    }
  });
  return { of, cell: longest };
}

/** Triangles that are left of the visible faces; the last vertex of each has a face of its own, as values of elements want it. */
export function coarseTriangles(faces: Faces, vertices: Vertices, clusters: Clusters, visible: (face: number) => boolean): Uint32Array {
  const out = new Uint32Array(faces.count * 6);
  const { of } = clusters;
  const { faceOf } = vertices;
  let size = 0;
  const put = (a: number, b: number, c: number) => {
    if (a === b || b === c || c === a) return;
    if (faceOf[c]! >= 0) out.set([a, b, c], size);
    else if (faceOf[b]! >= 0) out.set([c, a, b], size);
    else if (faceOf[a]! >= 0) out.set([b, c, a], size);
    else return;
    size += 3;
  };
  for (let f = 0; f < faces.count; f++) {
    if (!visible(f)) continue;
    const [a, b, c, d] = [0, 1, 2, 3].map((k) => of[corner(faces, f, k)]!) as [number, number, number, number];
    put(a, b, c);
    if (!isTriangle(faces, f)) put(a, c, d);
  }
  return out.slice(0, size);
}
