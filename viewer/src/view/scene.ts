// The picture: three.js objects over one set of buffers, drawn when something changed.
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  ClampToEdgeWrapping,
  DataTexture,
  DoubleSide,
  GLSL3,
  LineSegments,
  LinearFilter,
  Mesh,
  NearestFilter,
  PerspectiveCamera,
  Points,
  RGBAFormat,
  RawShaderMaterial,
  Scene,
  Sphere,
  SRGBColorSpace,
  NoColorSpace,
  UnsignedByteType,
  Vector2,
  Vector3,
  Vector4,
  WebGLRenderer,
  Color,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Look, Range } from "../data/fields";
import { TOP, type ChunkInfo } from "../data/chunk";
import { colorTable, type ColorMap } from "./colormap";
import { assignVertices, edgeLines, faceNormals, featureEdges, findEdges, triangles, type Edges, type Faces, type Vertices } from "./mesh";
import { pick, type Hit, type Vec } from "./pick";
import { faceFragment, faceVertex, plainFragment, plainVertex } from "./shaders";

export interface Coloring {
  quanta: Uint16Array;
  /** Of the quanta. */
  range: Range;
  /** Of the colours. */
  shown: Range;
  on: "node" | "element";
  look: Look;
}

/** Width that the legend takes, in pixels. */
const LEGEND = 170;

const looks: Record<Look, number> = { plain: 0, sparse: 1, state: 2 };

export class View {
  readonly renderer: WebGLRenderer;
  readonly camera = new PerspectiveCamera(28, 1, 0.01, 100);
  readonly controls: OrbitControls;
  readonly faces: Faces;
  readonly vertices: Vertices;
  private readonly scene = new Scene();
  private readonly frameAttribute: BufferAttribute;
  private readonly faceGeometry = new BufferGeometry();
  private readonly outlineGeometry = new BufferGeometry();
  private readonly meshGeometry = new BufferGeometry();
  private readonly markFaces = new BufferGeometry();
  private readonly markNodes = new BufferGeometry();
  private readonly selectedFace = new BufferGeometry();
  private readonly selectedNode = new BufferGeometry();
  private readonly arrows: LineSegments[] = [];
  private readonly objects: Record<
    "faces" | "outline" | "mesh" | "markFaces" | "markNodes" | "selectedFace" | "selectedNode",
    Mesh | LineSegments | Points
  >;
  private readonly displacement = { uLow: { value: new Vector3() }, uRange: { value: new Vector3() }, uDeform: { value: 1 } };
  private readonly faceMaterial: RawShaderMaterial;
  private edges: Edges | undefined;
  private outline: Uint8Array | undefined;
  private visibleFace: Uint8Array;
  private drawRequested = false;
  private displacementData: Uint16Array | undefined;
  private displacementInfo: ChunkInfo | undefined;
  private moved: Float32Array | undefined;
  private meshShown = false;
  private size = 1;
  private covered = 0;
  /** Called after each picture. */
  onDraw: (() => void) | undefined;
  drawCount = 0;

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
    const base = new Float32Array(3 * count);
    const part = new Float32Array(count);
    for (let v = 0; v < count; v++) {
      const n = this.vertices.node[v]!;
      for (let c = 0; c < 3; c++) base[3 * v + c] = points[c * nodes + n]!;
      const f = this.vertices.faceOf[v]!;
      part[v] = f < 0 ? 0 : partOfFace[f]!;
    }
    const position = new BufferAttribute(base, 3);
    this.frameAttribute = new BufferAttribute(new Uint16Array(4 * count), 4, true);
    this.frameAttribute.setUsage(35048); // DYNAMIC_DRAW
    const shared = [
      this.faceGeometry,
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
    this.faceGeometry.setAttribute("part", new BufferAttribute(part, 1));

    const palette = new Uint8Array(4 * Math.max(1, parts.length));
    parts.forEach((p, i) => palette.set([...p, 255], 4 * i));
    const partTexture = new DataTexture(palette, Math.max(1, parts.length), 1, RGBAFormat, UnsignedByteType);
    partTexture.minFilter = partTexture.magFilter = NearestFilter;
    partTexture.needsUpdate = true;
    this.faceMaterial = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: faceVertex,
      fragmentShader: faceFragment,
      side: DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
      uniforms: {
        ...this.displacement,
        uValue: { value: new Vector2() },
        uShown: { value: new Vector2(0, 1) },
        uColors: { value: null },
        uParts: { value: partTexture },
        uMode: { value: 2 },
        uLook: { value: 0 },
        uBands: { value: 0 },
      },
    });
    const plain = (color: Vector4, size = 1, forward = 0, round = false) =>
      new RawShaderMaterial({
        glslVersion: GLSL3,
        vertexShader: plainVertex,
        fragmentShader: plainFragment,
        side: DoubleSide,
        transparent: color.w < 1,
        uniforms: {
          ...this.displacement,
          uColor: { value: color },
          uSize: { value: size },
          uForward: { value: forward },
          uRound: { value: round },
        },
      });
    const ratio = this.renderer.getPixelRatio();
    const magenta = new Vector4(0.91, 0.12, 0.55, 0.82);
    this.objects = {
      faces: new Mesh(this.faceGeometry, this.faceMaterial),
      mesh: new LineSegments(this.meshGeometry, plain(new Vector4(0, 0, 0, 0.22))),
      outline: new LineSegments(this.outlineGeometry, plain(new Vector4(0, 0, 0, 0.75), 1, 1e-6)),
      markFaces: new Mesh(this.markFaces, plain(magenta, 1, 2e-5)),
      markNodes: new Points(this.markNodes, plain(new Vector4(0.91, 0.12, 0.55, 1), 7 * ratio, 8e-5, true)),
      selectedFace: new Mesh(this.selectedFace, plain(new Vector4(1, 0.84, 0.2, 0.75), 1, 4e-5)),
      selectedNode: new Points(this.selectedNode, plain(new Vector4(1, 0.3, 0.1, 1), 11 * ratio, 2e-4, true)),
    };
    Object.values(this.objects).forEach((object, order) => {
      object.frustumCulled = false;
      object.renderOrder = order;
      this.scene.add(object);
    });
    for (const empty of [this.markFaces, this.markNodes, this.selectedFace, this.selectedNode, this.meshGeometry, this.outlineGeometry])
      this.setIndex(empty, new Uint32Array());
    this.rebuildFaces();
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.draw());
    this.look([-0.75, -1, 0.62]);
  }

  /** Index buffers grow and are filled again: three.js keeps the GPU's copy of a buffer as long as its geometry. */
  private setIndex(geometry: BufferGeometry, index: Uint32Array): void {
    const old = geometry.index;
    if (old && old.array.length >= index.length) {
      (old.array as Uint32Array).set(index);
      old.needsUpdate = true;
    } else {
      const room = new Uint32Array(Math.max(12, Math.ceil(1.3 * index.length)));
      room.set(index);
      const attribute = new BufferAttribute(room, 1);
      attribute.setUsage(35048);
      geometry.setIndex(attribute);
    }
    geometry.setDrawRange(0, index.length);
  }

  /** Edges are looked for when the first picture stands. */
  makeEdges(): void {
    this.edges = findEdges(this.faces, this.points.length / 3);
    this.outline = featureEdges(this.edges, faceNormals(this.faces, this.points), (f) => this.partOfFace[f]!);
    this.rebuildEdges();
    this.draw();
  }

  private rebuildFaces(): void {
    this.setIndex(
      this.faceGeometry,
      triangles(this.faces, this.vertices, (f) => this.visibleFace[f] === 1),
    );
  }
  private rebuildEdges(): void {
    if (!this.edges) return;
    const visible = (f: number) => this.visibleFace[f] === 1;
    this.setIndex(this.outlineGeometry, edgeLines(this.edges, this.outline, visible));
    this.setIndex(this.meshGeometry, this.meshShown ? edgeLines(this.edges, undefined, visible) : new Uint32Array());
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

  setColorMap(map: ColorMap, bands = 0): void {
    const texture = new DataTexture(colorTable(map), 256, 1, RGBAFormat, UnsignedByteType);
    texture.minFilter = texture.magFilter = LinearFilter;
    texture.wrapS = ClampToEdgeWrapping;
    texture.colorSpace = NoColorSpace;
    texture.needsUpdate = true;
    (this.faceMaterial.uniforms["uColors"]!.value as DataTexture | null)?.dispose();
    this.faceMaterial.uniforms["uColors"]!.value = texture;
    this.faceMaterial.uniforms["uBands"]!.value = bands;
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
    const uniforms = this.faceMaterial.uniforms;
    uniforms["uMode"]!.value = coloring ? (coloring.on === "element" ? 1 : 0) : 2;
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
      (uniforms["uValue"]!.value as Vector2).set(coloring.range.low, coloring.range.high - coloring.range.low);
      (uniforms["uShown"]!.value as Vector2).set(coloring.shown.low, coloring.shown.high);
      uniforms["uLook"]!.value = looks[coloring.look];
    }
    this.frameAttribute.needsUpdate = true;
    this.draw();
  }

  setShown(shown: Range): void {
    (this.faceMaterial.uniforms["uShown"]!.value as Vector2).set(shown.low, shown.high);
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
    const out = new Float32Array(this.points);
    const data = this.displacementData;
    const info = this.displacementInfo;
    if (data && info?.low && info.high) {
      const n = this.points.length / 3;
      const scale = this.displacement.uDeform.value;
      for (let c = 0; c < 3; c++) {
        const low = scale * info.low[c]!;
        const unit = (scale * (info.high[c]! - info.low[c]!)) / TOP;
        for (let i = c * n; i < (c + 1) * n; i++) out[i] = out[i]! + low + unit * data[i]!;
      }
    }
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
    this.setIndex(this.markFaces, Uint32Array.from(index));
    this.setIndex(this.markNodes, Uint32Array.from(nodes));
    this.draw();
  }

  select(face: number | undefined, node: number | undefined): void {
    const corners = face === undefined ? [] : [0, 1, 2, 3].map((k) => this.faces.corners[k * this.faces.count + face]!);
    this.setIndex(
      this.selectedFace,
      Uint32Array.from(face === undefined ? [] : [corners[0]!, corners[1]!, corners[2]!, corners[0]!, corners[2]!, corners[3]!]),
    );
    this.setIndex(this.selectedNode, Uint32Array.from(node === undefined ? [] : [node]));
    this.draw();
  }

  /** Arrows along the normals of segments; an empty list takes them away. */
  setArrows(groups: readonly { segments: readonly (readonly number[])[]; color: [number, number, number] }[]): void {
    for (const old of this.arrows.splice(0)) {
      this.scene.remove(old);
      old.geometry.dispose();
    }
    const p = this.positions();
    const n = p.length / 3;
    const at = (i: number) => new Vector3(p[i]!, p[n + i]!, p[2 * n + i]!);
    for (const group of groups) {
      const out: number[] = [];
      for (const s of group.segments) {
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
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(Float32Array.from(out), 3));
      geometry.setAttribute("frame", new BufferAttribute(new Uint16Array((out.length / 3) * 4), 4, true));
      const material = new RawShaderMaterial({
        glslVersion: GLSL3,
        vertexShader: plainVertex,
        fragmentShader: plainFragment,
        uniforms: {
          uLow: { value: new Vector3() },
          uRange: { value: new Vector3() },
          uDeform: { value: 0 },
          uColor: { value: new Vector4(...group.color, 1) },
          uSize: { value: 1 },
          uForward: { value: 5e-5 },
          uRound: { value: false },
        },
      });
      const lines = new LineSegments(geometry, material);
      lines.frustumCulled = false;
      lines.renderOrder = 10;
      this.arrows.push(lines);
      this.scene.add(lines);
    }
    this.draw();
  }

  pickAt(x: number, y: number): Hit | undefined {
    const box = this.canvas.getBoundingClientRect();
    const from = this.camera.position.clone();
    const to = new Vector3(((x - box.left) / box.width) * 2 - 1, 1 - ((y - box.top) / box.height) * 2, 0.5).unproject(this.camera);
    const direction = to.sub(from).normalize();
    return pick(this.faces, this.positions(), (f) => this.visibleFace[f] === 1, from.toArray() as Vec, direction.toArray() as Vec);
  }

  /** Where a node is drawn, in pixels of the window. */
  project(node: number): { x: number; y: number } {
    const p = this.positions();
    const n = p.length / 3;
    const v = new Vector3(p[node]!, p[n + node]!, p[2 * n + node]!).project(this.camera);
    const box = this.canvas.getBoundingClientRect();
    return { x: box.left + ((v.x + 1) / 2) * box.width, y: box.top + ((1 - v.y) / 2) * box.height };
  }

  // ---- camera ------------------------------------------------------------------------------------------------------

  resize(width: number, height: number): void {
    if (width <= 0 || height <= 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    // The legend stands at the right: the middle of the picture moves to the middle of what is left.
    this.covered = width > 3 * LEGEND ? LEGEND / width : 0;
    this.camera.setViewOffset(width, height, (this.covered * width) / 2, 0, width, height);
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Nodes of the visible faces, or those given. */
  private *framed(nodes: readonly number[] | undefined): Iterable<number> {
    if (nodes && nodes.length > 0) {
      yield* nodes;
      return;
    }
    const seen = new Uint8Array(this.points.length / 3);
    for (let f = 0; f < this.faces.count; f++) {
      if (!this.visibleFace[f]) continue;
      for (let k = 0; k < 4; k++) {
        const i = this.faces.corners[k * this.faces.count + f]!;
        if (!seen[i]) yield i;
        seen[i] = 1;
      }
    }
  }

  private bounds(nodes: readonly number[] | undefined): Box3 {
    const p = this.positions();
    const n = p.length / 3;
    const box = new Box3();
    const x = new Vector3();
    for (const i of this.framed(nodes)) box.expandByPoint(x.set(p[i]!, p[n + i]!, p[2 * n + i]!));
    if (box.isEmpty()) box.set(new Vector3(-1, -1, -1), new Vector3(1, 1, 1));
    return box;
  }

  /** Brings the visible faces, or some nodes with something around them, into the frame. */
  fit(nodes?: readonly number[]): void {
    const all = this.bounds(undefined).getSize(new Vector3()).length() / 2;
    this.size = Math.max(all, 1e-12);
    const box = nodes ? this.bounds(nodes) : this.bounds(undefined);
    const centre = box.getCenter(new Vector3());
    const back = this.camera.position.clone().sub(this.controls.target).normalize();
    const right = this.camera.up.clone().cross(back).normalize();
    const up = back.clone().cross(right);
    const vertical = Math.tan(((this.camera.fov / 2) * Math.PI) / 180);
    const horizontal = vertical * this.camera.aspect * (1 - this.covered);
    // The nearest place from which every node is seen: depth + side/tan for each. Perspective makes what is near larger: the middle of
    // the picture is found in a few rounds.
    const p = this.positions();
    const n = p.length / 3;
    const chosen = [...this.framed(nodes)];
    const x = new Vector3();
    let distance = 0;
    for (let round = 0; round < 4; round++) {
      distance = 0;
      for (const i of chosen) {
        x.set(p[i]!, p[n + i]!, p[2 * n + i]!).sub(centre);
        distance = Math.max(distance, x.dot(back) + Math.max(Math.abs(x.dot(right)) / horizontal, Math.abs(x.dot(up)) / vertical));
      }
      if (round === 3 || !(distance > 0)) break;
      const extent = { left: Infinity, right: -Infinity, low: Infinity, high: -Infinity };
      for (const i of chosen) {
        x.set(p[i]!, p[n + i]!, p[2 * n + i]!).sub(centre);
        const depth = distance - x.dot(back);
        if (!(depth > 0)) continue;
        extent.left = Math.min(extent.left, x.dot(right) / depth);
        extent.right = Math.max(extent.right, x.dot(right) / depth);
        extent.low = Math.min(extent.low, x.dot(up) / depth);
        extent.high = Math.max(extent.high, x.dot(up) / depth);
      }
      if (!Number.isFinite(extent.left)) break;
      centre.addScaledVector(right, (distance * (extent.left + extent.right)) / 2);
      centre.addScaledVector(up, (distance * (extent.low + extent.high)) / 2);
    }
    distance = Math.max(1.08 * distance, nodes ? (0.16 * this.size) / vertical : 1e-9 * this.size);
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(back, distance);
    this.updateDepth();
    this.controls.update();
    this.draw();
  }

  look(direction: Vec): void {
    const d = new Vector3(...direction).normalize();
    this.camera.position.copy(this.controls.target).add(d);
    this.fit();
  }

  private updateDepth(): void {
    const distance = this.camera.position.distanceTo(this.controls.target) + this.controls.target.length();
    this.camera.near = Math.max(1e-3 * this.size, 1e-3 * distance);
    this.camera.far = distance + 12 * this.size;
    this.camera.updateProjectionMatrix();
  }

  turn(azimuth: number, polar: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(this.camera.up, azimuth);
    const right = offset.clone().cross(this.camera.up).normalize();
    const turned = offset.clone().applyAxisAngle(right, polar);
    if (Math.abs(turned.clone().normalize().dot(this.camera.up)) < 0.995) offset.copy(turned);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }
  zoom(factor: number): void {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.draw();
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
  drawNow(): void {
    this.drawRequested = false;
    this.updateDepth();
    this.renderer.render(this.scene, this.camera);
    this.drawCount++;
    this.onDraw?.();
  }
}
