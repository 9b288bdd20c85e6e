// The picture: three.js objects over one set of buffers, drawn when something changed.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  LineSegments,
  Mesh,
  Points,
  Scene,
  Sphere,
  SRGBColorSpace,
  Vector3,
  Vector4,
  WebGLRenderer,
  type RawShaderMaterial,
} from "three";
import type { ChunkInfo } from "../data/chunk";
import type { Range } from "../data/fields";
import { fillIndex, movedPoints } from "./buffers";
import { cluster, coarseTriangles, type Clusters } from "./coarse";
import { makeArrows, type ArrowGroup } from "./arrows";
import type { ColorMap } from "./colormap";
import { FaceMaterials, displacement, plainMaterial, type Coloring } from "./materials";
import {
  assignVertices,
  edgeLines,
  faceNormals,
  featureEdges,
  findEdges,
  nodesOf,
  triangles,
  type Edges,
  type Faces,
  type Vertices,
} from "./mesh";
import { pick, type Hit, type Vec } from "./pick";
import { Rig } from "./rig";

/** Milliseconds: a picture that takes longer is drawn coarser while it moves. */
const SLOW = 25;
/** Milliseconds without a change after which the picture rests. */
const REST = 160;
/** Pixels: cells that are larger are not drawn as one. */
const VISIBLE = 7;

export class View {
  readonly renderer: WebGLRenderer;
  readonly rig: Rig;
  readonly faces: Faces;
  readonly vertices: Vertices;
  private readonly scene = new Scene();
  private readonly frameAttribute: BufferAttribute;
  private readonly faceGeometry = new BufferGeometry();
  private readonly coarseGeometry = new BufferGeometry();
  private readonly outlineGeometry = new BufferGeometry();
  private readonly meshGeometry = new BufferGeometry();
  private readonly markFaces = new BufferGeometry();
  private readonly markNodes = new BufferGeometry();
  private readonly selectedFace = new BufferGeometry();
  private readonly selectedNode = new BufferGeometry();
  private readonly arrows: LineSegments[] = [];
  private readonly objects: Record<
    "faces" | "coarse" | "outline" | "mesh" | "markFaces" | "markNodes" | "selectedFace" | "selectedNode",
    Mesh | LineSegments | Points
  >;
  private readonly displacement = displacement(1);
  private readonly faceMaterials = new FaceMaterials(this.displacement);
  private edges: Edges | undefined;
  private outline: Uint8Array | undefined;
  private visibleFace: Uint8Array;
  private drawRequested = false;
  private displacementData: Uint16Array | undefined;
  private displacementInfo: ChunkInfo | undefined;
  private moved: Float32Array | undefined;
  private meshShown = false;
  private clusters: Clusters | undefined;
  private moving = false;
  private rest: ReturnType<typeof setTimeout> | undefined;
  /** Called after each picture. */
  onDraw: (() => void) | undefined;
  drawCount = 0;
  /** Whether the last picture is one of those for while it moves. */
  drawnCoarse = false;

  constructor(
    readonly canvas: HTMLCanvasElement,
    corners: Uint32Array,
    private readonly points: Float32Array,
    private readonly partOfFace: Uint32Array,
    parts: readonly [number, number, number][],
  ) {
    this.faces = { count: corners.length / 4, corners };
    const nodes = points.length / 3;
    this.vertices = assignVertices(this.faces, nodes);
    this.visibleFace = new Uint8Array(this.faces.count).fill(1);
    const large = this.faces.count > 30000;
    this.renderer = new WebGLRenderer({ canvas, antialias: !large, powerPreference: "high-performance", preserveDrawingBuffer: false });
    this.renderer.outputColorSpace = SRGBColorSpace;
    this.renderer.setPixelRatio(large ? 1 : Math.min(2, window.devicePixelRatio));

    const count = this.vertices.node.length;
    const rest = new Float32Array(3 * count);
    const colors = new Uint8Array(4 * count);
    for (let v = 0; v < count; v++) {
      const n = this.vertices.node[v]!;
      for (let c = 0; c < 3; c++) rest[3 * v + c] = points[c * nodes + n]!;
      const f = this.vertices.faceOf[v]!;
      if (f >= 0) colors.set(parts[partOfFace[f]!]!, 4 * v);
    }
    const position = new BufferAttribute(rest, 3);
    this.frameAttribute = new BufferAttribute(new Uint16Array(4 * count), 4, true);
    this.frameAttribute.setUsage(35048); // DYNAMIC_DRAW
    const shared = [
      this.faceGeometry,
      this.coarseGeometry,
      this.outlineGeometry,
      this.meshGeometry,
      this.markFaces,
      this.markNodes,
      this.selectedFace,
      this.selectedNode,
    ];
    for (const geometry of shared) {
      geometry.setAttribute("position", position);
      geometry.setAttribute("frame", this.frameAttribute);
      geometry.boundingSphere = new Sphere(new Vector3(), Infinity);
    }
    const base = new BufferAttribute(colors, 4, true);
    for (const geometry of [this.faceGeometry, this.coarseGeometry]) geometry.setAttribute("base", base);

    const plain = (color: Vector4, options: Parameters<typeof plainMaterial>[2] = {}) => plainMaterial(this.displacement, color, options);
    const ratio = this.renderer.getPixelRatio();
    const magenta = new Vector4(0.91, 0.12, 0.55, 0.82);
    this.objects = {
      faces: new Mesh(this.faceGeometry, this.faceMaterials.of(undefined)),
      coarse: new Mesh(this.coarseGeometry, this.faceMaterials.of(undefined)),
      mesh: new LineSegments(this.meshGeometry, plain(new Vector4(0, 0, 0, 0.22))),
      outline: new LineSegments(this.outlineGeometry, plain(new Vector4(0, 0, 0, 0.75), { forward: 1e-6 })),
      markFaces: new Mesh(this.markFaces, plain(magenta, { forward: 2e-5 })),
      markNodes: new Points(this.markNodes, plain(new Vector4(0.91, 0.12, 0.55, 1), { size: 7 * ratio, forward: 8e-5, round: true })),
      selectedFace: new Mesh(this.selectedFace, plain(new Vector4(1, 0.84, 0.2, 0.75), { forward: 4e-5 })),
      selectedNode: new Points(this.selectedNode, plain(new Vector4(1, 0.3, 0.1, 1), { size: 11 * ratio, forward: 2e-4, round: true })),
    };
    Object.values(this.objects).forEach((object, order) => {
      object.frustumCulled = false;
      object.renderOrder = order;
      this.scene.add(object);
    });
    for (const empty of [
      this.coarseGeometry,
      this.markFaces,
      this.markNodes,
      this.selectedFace,
      this.selectedNode,
      this.meshGeometry,
      this.outlineGeometry,
    ])
      fillIndex(empty, new Uint32Array());
    this.rebuildFaces();
    this.rig = new Rig(canvas, () => this.move());
    this.look([-0.75, -1, 0.62]);
  }

  /** Edges are looked for when the first picture stands. */
  makeEdges(): void {
    this.edges = findEdges(this.faces, this.points.length / 3);
    this.outline = featureEdges(this.edges, faceNormals(this.faces, this.points), (f) => this.partOfFace[f]!);
    this.rebuildEdges();
    this.draw();
  }

  /** Measures how long the whole picture takes; from then on, one that takes long is drawn coarser while it moves. */
  makeCoarse(): void {
    const start = performance.now();
    this.drawNow();
    this.wait();
    if (performance.now() - start < SLOW) return;
    const clusters = cluster(this.faces, this.vertices, this.points, this.partOfFace);
    if (clusters.cell === 0) return;
    this.clusters = clusters;
    this.rebuildFaces();
  }

  private rebuildFaces(): void {
    fillIndex(
      this.faceGeometry,
      triangles(this.faces, this.vertices, (f) => this.visibleFace[f] === 1),
    );
    if (this.clusters)
      fillIndex(
        this.coarseGeometry,
        coarseTriangles(this.faces, this.vertices, this.clusters, (f) => this.visibleFace[f] === 1),
      );
  }
  private rebuildEdges(): void {
    if (!this.edges) return;
    const visible = (f: number) => this.visibleFace[f] === 1;
    fillIndex(this.outlineGeometry, edgeLines(this.edges, this.outline, visible));
    fillIndex(this.meshGeometry, this.meshShown ? edgeLines(this.edges, undefined, visible) : new Uint32Array());
  }

  /** @param visible per face, 1: drawn */
  setVisible(visible: Uint8Array): void {
    if (visible.every((v, i) => v === this.visibleFace[i])) return;
    this.visibleFace = visible;
    this.rebuildFaces();
    this.rebuildEdges();
    this.draw();
  }
  isVisible(face: number): boolean {
    return this.visibleFace[face] === 1;
  }
  showMesh(shown: boolean): void {
    this.meshShown = shown;
    this.rebuildEdges();
    this.draw();
  }
  get meshIsShown(): boolean {
    return this.meshShown;
  }

  setColorMap(map: ColorMap): void {
    this.faceMaterials.setColorMap(map);
    this.draw();
  }

  /** Positions and colours of one frame. */
  setFrame(displacement: Uint16Array | undefined, info: ChunkInfo | undefined, coloring: Coloring | undefined): void {
    const nodes = this.points.length / 3;
    const to = this.frameAttribute.array as Uint16Array;
    const { node, faceOf } = this.vertices;
    const count = node.length;
    this.displacementData = displacement;
    this.displacementInfo = info;
    this.moved = undefined;
    if (displacement && info?.low && info.high) {
      this.displacement.uLow.value.fromArray(info.low);
      this.displacement.uRange.value.fromArray(info.high).sub(this.displacement.uLow.value);
      for (let v = 0, i = 0; v < count; v++, i += 4) {
        const n = node[v]!;
        to[i] = displacement[n]!;
        to[i + 1] = displacement[nodes + n]!;
        to[i + 2] = displacement[2 * nodes + n]!;
      }
    }
    this.objects.faces.material = this.objects.coarse.material = this.faceMaterials.of(coloring);
    if (coloring) {
      const q = coloring.quanta;
      if (coloring.on === "element") {
        for (let v = 0, i = 3; v < count; v++, i += 4) {
          const f = faceOf[v]!;
          to[i] = f < 0 ? 0 : q[f]!;
        }
      } else {
        for (let v = 0, i = 3; v < count; v++, i += 4) to[i] = q[node[v]!]!;
      }
    }
    this.frameAttribute.needsUpdate = true;
    this.move();
  }

  setShown(shown: Range): void {
    this.faceMaterials.setShown(shown);
    this.draw();
  }

  setDeform(scale: number): void {
    this.displacement.uDeform.value = scale;
    this.moved = undefined;
    this.draw();
  }

  /** Positions as drawn, planar. */
  positions(): Float32Array {
    if (this.moved) return this.moved;
    const out = movedPoints(this.points, this.displacementData, this.displacementInfo, this.displacement.uDeform.value);
    this.moved = out;
    return out;
  }

  setTheme(background: string, line: string): void {
    this.scene.background = new Color(background);
    const color = new Color(line).convertLinearToSRGB();
    for (const object of [this.objects.mesh, this.objects.outline]) {
      const value = (object.material as RawShaderMaterial).uniforms["uColor"]!.value as Vector4;
      value.set(color.r, color.g, color.b, value.w);
    }
    this.draw();
  }

  // ---- marks -------------------------------------------------------------------------------------------------------

  /** @param segments node numbers, four per segment (a triangle repeats its third) */
  mark(segments: readonly (readonly number[])[], nodes: readonly number[]): void {
    const index: number[] = [];
    for (const s of segments) {
      index.push(s[0]!, s[1]!, s[2]!);
      if (s[3] !== undefined && s[3] !== s[2]) index.push(s[0]!, s[2]!, s[3]);
    }
    fillIndex(this.markFaces, Uint32Array.from(index));
    fillIndex(this.markNodes, Uint32Array.from(nodes));
    this.draw();
  }

  select(face: number | undefined, node: number | undefined): void {
    const corners = face === undefined ? [] : [0, 1, 2, 3].map((k) => this.faces.corners[k * this.faces.count + face]!);
    fillIndex(
      this.selectedFace,
      Uint32Array.from(face === undefined ? [] : [corners[0]!, corners[1]!, corners[2]!, corners[0]!, corners[2]!, corners[3]!]),
    );
    fillIndex(this.selectedNode, Uint32Array.from(node === undefined ? [] : [node]));
    this.draw();
  }

  /** Arrows along the normals of segments; an empty list takes them away. */
  setArrows(groups: readonly ArrowGroup[]): void {
    for (const old of this.arrows.splice(0)) {
      this.scene.remove(old);
      old.geometry.dispose();
    }
    for (const group of groups) this.arrows.push(makeArrows(group, this.positions()));
    if (this.arrows.length > 0) this.scene.add(...this.arrows);
    this.draw();
  }

  pickAt(x: number, y: number): Hit | undefined {
    const { origin, direction } = this.rig.ray(x, y);
    return pick(this.faces, this.positions(), (f) => this.visibleFace[f] === 1, origin, direction);
  }

  /** Where a node is drawn, in pixels of the window. */
  project(node: number): { x: number; y: number } {
    const p = this.positions();
    const n = p.length / 3;
    return this.rig.project([p[node]!, p[n + node]!, p[2 * n + node]!]);
  }

  // ---- camera ------------------------------------------------------------------------------------------------------

  resize(width: number, height: number): void {
    if (width <= 0 || height <= 0) return;
    this.renderer.setSize(width, height, false);
    this.rig.resize(width, height);
    this.draw();
  }

  /** Brings the visible faces, or some nodes with something around them, into the frame. */
  fit(nodes?: readonly number[]): void {
    const positions = this.positions();
    this.rig.fit(
      { positions, nodes: nodesOf(this.faces, positions.length / 3, (f) => this.visibleFace[f] === 1) },
      nodes && nodes.length > 0 ? { positions, nodes } : undefined,
    );
  }
  look(direction: Vec): void {
    this.rig.look(direction);
    this.fit();
  }

  /** Returns when the graphics card, or what stands in for it, is done with the picture. */
  wait(): void {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
  draw(): void {
    if (this.drawRequested) return;
    this.drawRequested = true;
    requestAnimationFrame(() => this.drawNow());
  }
  /** Draws what will be followed by more. */
  private move(): void {
    if (this.clusters) {
      this.moving = true;
      clearTimeout(this.rest);
      this.rest = setTimeout(() => {
        this.moving = false;
        this.draw();
      }, REST);
    }
    this.draw();
  }
  /** @param whole with every element, even while the picture moves */
  drawNow(whole = false): void {
    this.drawRequested = false;
    this.rig.updateDepth();
    const coarse = this.moving && !whole && this.clusters!.cell * this.rig.pixelsPerLength < VISIBLE;
    this.objects.coarse.visible = coarse;
    this.objects.faces.visible = this.objects.mesh.visible = !coarse;
    this.drawnCoarse = coarse;
    this.renderer.render(this.scene, this.rig.camera);
    this.drawCount++;
    this.onDraw?.();
  }
}
