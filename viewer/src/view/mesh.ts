// Topology of the picture: which vertex carries which face's value, triangles, edges. No graphics library here.

/** A quadrilateral has four corners; a triangle repeats its third. Planar: all first corners, all second corners, ... */
export interface Faces {
  count: number;
  corners: Uint32Array;
}

export function corner(faces: Faces, face: number, k: number): number {
  return faces.corners[k * faces.count + face]!;
}
export function isTriangle(faces: Faces, face: number): boolean {
  return corner(faces, face, 3) === corner(faces, face, 2);
}

/**
 * Vertices 0..nodes-1 are the nodes; copies follow. Every face has a vertex of its own, the last one of each of its triangles: WebGL takes
 * flat attributes from a triangle's last vertex, so that values of elements need no vertices per face. Meshes of quadrilaterals have
 * about as many nodes as faces: copies are rare.
 */
export interface Vertices {
  /** Node of each vertex. */
  node: Uint32Array;
  /** Vertex of each face. */
  ofFace: Uint32Array;
  /** Face of each vertex, or -1. */
  faceOf: Int32Array;
  /** Corner (0..3) at which each face's vertex is. */
  turn: Uint8Array;
}

export function assignVertices(faces: Faces, nodes: number): Vertices {
  const ofFace = new Uint32Array(faces.count);
  const turn = new Uint8Array(faces.count);
  const taken = new Uint8Array(nodes);
  const copies: number[] = [];
  for (let f = 0; f < faces.count; f++) {
    const corners = isTriangle(faces, f) ? 3 : 4;
    let k = 0;
    while (k < corners && taken[corner(faces, f, k)]) k++;
    if (k < corners) {
      ofFace[f] = corner(faces, f, k);
      taken[ofFace[f]!] = 1;
    } else {
      k = 0;
      ofFace[f] = nodes + copies.length;
      copies.push(corner(faces, f, 0));
    }
    turn[f] = k;
  }
  const node = new Uint32Array(nodes + copies.length);
  for (let n = 0; n < nodes; n++) node[n] = n;
  node.set(copies, nodes);
  const faceOf = new Int32Array(node.length).fill(-1);
  for (let f = 0; f < faces.count; f++) faceOf[ofFace[f]!] = f;
  return { node, ofFace, faceOf, turn };
}

/** Triangles of the visible faces by vertex; the face's own vertex comes last in each. */
export function triangles(faces: Faces, vertices: Vertices, visible: (face: number) => boolean): Uint32Array {
  const out = new Uint32Array(faces.count * 6);
  let n = 0;
  for (let f = 0; f < faces.count; f++) {
    if (!visible(f)) continue;
    const corners = isTriangle(faces, f) ? 3 : 4;
    const k = vertices.turn[f]!;
    const own = vertices.ofFace[f]!;
    for (let t = 1; t + 1 < corners; t++) {
      out[n++] = corner(faces, f, (k + t) % corners);
      out[n++] = corner(faces, f, (k + t + 1) % corners);
      out[n++] = own;
    }
  }
  return out.subarray(0, n);
}

/** Nodes of the visible faces, each once. */
export function nodesOf(faces: Faces, nodes: number, visible: (face: number) => boolean): number[] {
  const seen = new Uint8Array(nodes);
  const out: number[] = [];
  for (let f = 0; f < faces.count; f++) {
    if (!visible(f)) continue;
    for (let k = 0; k < 4; k++) {
      const i = corner(faces, f, k);
      if (!seen[i]) out.push(i);
      seen[i] = 1;
    }
  }
  return out;
}

/** Every edge once: two nodes, and the faces on it (-1: none; of more than two the first two count, `many` says so). */
export interface Edges {
  count: number;
  a: Uint32Array;
  b: Uint32Array;
  left: Int32Array;
  right: Int32Array;
  many: Uint8Array;
}

export function findEdges(faces: Faces, nodes: number): Edges {
  const start = new Uint32Array(nodes + 1);
  const forEach = (use: (low: number, high: number, face: number) => void) => {
    for (let f = 0; f < faces.count; f++) {
      const corners = isTriangle(faces, f) ? 3 : 4;
      for (let k = 0; k < corners; k++) {
        const p = corner(faces, f, k);
        const q = corner(faces, f, (k + 1) % corners);
        if (p < q) use(p, q, f);
        else use(q, p, f);
      }
    }
  };
  forEach((low) => start[low + 1]!++);
  for (let n = 0; n < nodes; n++) start[n + 1]! += start[n]!;
  const total = start[nodes]!;
  const fill = start.slice(0, nodes);
  const edges: Edges = {
    count: 0,
    a: new Uint32Array(total),
    b: new Uint32Array(total),
    left: new Int32Array(total).fill(-1),
    right: new Int32Array(total).fill(-1),
    many: new Uint8Array(total),
  };
  // Edges of one lower node lie together; a slot is used by the first face that brings the edge.
  forEach((low, high, face) => {
    let e = start[low]!;
    const end = fill[low]!;
    while (e < end && edges.b[e] !== high) e++;
    if (e === end) {
      edges.a[e] = low;
      edges.b[e] = high;
      edges.left[e] = face;
      fill[low]!++;
    } else if (edges.right[e] === -1) {
      edges.right[e] = face;
    } else {
      edges.many[e] = 1;
    }
  });
  for (let n = 0; n < nodes; n++) {
    for (let e = start[n]!; e < fill[n]!; e++) {
      const to = edges.count++;
      edges.a[to] = edges.a[e]!;
      edges.b[to] = edges.b[e]!;
      edges.left[to] = edges.left[e]!;
      edges.right[to] = edges.right[e]!;
      edges.many[to] = edges.many[e]!;
    }
  }
  return edges;
}

/** Unit normals of faces, by their diagonals. Points are planar (all x, all y, all z). */
export function faceNormals(faces: Faces, points: Float32Array): Float32Array {
  const n = points.length / 3;
  const out = new Float32Array(faces.count * 3);
  const at = (i: number, c: number) => points[c * n + i]!;
  for (let f = 0; f < faces.count; f++) {
    const [i, j, k, l] = [corner(faces, f, 0), corner(faces, f, 1), corner(faces, f, 2), corner(faces, f, 3)];
    const first = isTriangle(faces, f) ? [i, j] : [i, k];
    const second = isTriangle(faces, f) ? [i, k] : [j, l];
    const p = [0, 1, 2].map((c) => at(first[1]!, c) - at(first[0]!, c));
    const q = [0, 1, 2].map((c) => at(second[1]!, c) - at(second[0]!, c));
    const x = p[1]! * q[2]! - p[2]! * q[1]!;
    const y = p[2]! * q[0]! - p[0]! * q[2]!;
    const z = p[0]! * q[1]! - p[1]! * q[0]!;
    const size = Math.hypot(x, y, z) || 1;
    out.set([x / size, y / size, z / size], 3 * f);
  }
  return out;
}

/** Edges that outline a shape: borders, folds beyond `degrees`, and where parts meet. */
export function featureEdges(edges: Edges, normals: Float32Array, partOf: (face: number) => number, degrees = 35): Uint8Array {
  const limit = Math.cos((degrees * Math.PI) / 180);
  const out = new Uint8Array(edges.count);
  for (let e = 0; e < edges.count; e++) {
    const p = edges.left[e]!;
    const q = edges.right[e]!;
    if (q === -1 || edges.many[e] || partOf(p) !== partOf(q)) {
      out[e] = 1;
      continue;
    }
    const dot = normals[3 * p]! * normals[3 * q]! + normals[3 * p + 1]! * normals[3 * q + 1]! + normals[3 * p + 2]! * normals[3 * q + 2]!;
    if (dot < limit) out[e] = 1;
  }
  return out;
}

/** Node pairs of the edges that are wanted and lie on a visible face. */
export function edgeLines(edges: Edges, wanted: Uint8Array | undefined, visible: (face: number) => boolean): Uint32Array {
  const out = new Uint32Array(edges.count * 2);
  let n = 0;
  for (let e = 0; e < edges.count; e++) {
    if (wanted && !wanted[e]) continue;
    if (!visible(edges.left[e]!) && (edges.right[e] === -1 || !visible(edges.right[e]!))) continue;
    out[n++] = edges.a[e]!;
    out[n++] = edges.b[e]!;
  }
  return out.subarray(0, n);
}
