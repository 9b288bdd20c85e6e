// Joins the state with the view: which chunks a picture needs, and when it is drawn.
import { idsOf, type ChunkArray, type ChunkInfo } from "../data/chunk";
import type { ReportDocument } from "../data/document";
import { componentsOf, fieldRange, fieldText, scalarQuanta, valueAt, chunkRange, type Range } from "../data/fields";
import type { ChunkStore } from "../data/store";
import { partColor } from "../view/colormap";
import type { Coloring } from "../view/materials";
import { View } from "../view/scene";
import type { State } from "./state";

export interface Owner {
  /** Node or element number of the report. */
  node: number;
  element: number;
}

export class Picture {
  readonly view: View;
  readonly nodeIds: Float64Array;
  readonly elementIds: Float64Array;
  readonly faceElement: Uint32Array;
  readonly elementPart: Uint32Array;
  readonly elementShape: Uint8Array;
  readonly points: Float32Array;
  private readonly partOfFace: Uint32Array;
  private readonly ranges = new Map<string, Range>();
  private wanted = 0;
  private nodeIndex: Map<number, number> | undefined;
  private elementFace: Map<number, number> | undefined;
  /** Chunks of the picture, for picking. */
  private current: { frame: number; data: Map<number, ChunkArray> } = { frame: -1, data: new Map() };

  private constructor(
    canvas: HTMLCanvasElement,
    private readonly document: ReportDocument,
    private readonly store: ChunkStore,
    private readonly state: State,
    arrays: ChunkArray[],
  ) {
    const [points, nodeIds, corners, faceElement, elementIds, elementPart, elementShape] = arrays as [
      Float32Array,
      Uint32Array,
      Uint32Array,
      Uint32Array,
      Uint32Array,
      Uint32Array,
      Uint8Array,
    ];
    this.points = points;
    this.nodeIds = idsOf(nodeIds);
    this.elementIds = idsOf(elementIds);
    this.faceElement = faceElement;
    this.elementPart = elementPart;
    this.elementShape = elementShape;
    this.partOfFace = faceElement.map((e) => elementPart[e]!);
    this.view = new View(
      canvas,
      corners,
      points,
      this.partOfFace,
      document.mesh!.parts.map((_, i) => partColor(i)),
    );
  }

  static async make(canvas: HTMLCanvasElement, document: ReportDocument, store: ChunkStore, state: State): Promise<Picture> {
    const m = document.mesh!;
    const arrays = await Promise.all(
      [m.points, m.node_id, m.faces, m.face_element, m.element_id, m.element_part, m.element_shape].map((info) => store.get(info)),
    );
    return new Picture(canvas, document, store, state, arrays);
  }

  get fields() {
    return this.document.fields ?? [];
  }

  /** Range of the chosen component over all frames. */
  wholeRange(): Range {
    const { field, component } = this.state.shown;
    if (field < 0) return { low: 0, high: 0 };
    const key = `${field}/${component}`;
    let range = this.ranges.get(key);
    if (!range) {
      range = fieldRange(this.document.frames, field, component);
      this.ranges.set(key, range);
    }
    return range;
  }

  /** Range that the colours cover. */
  shownRange(): Range {
    const { field, component, rangeMode, fixed, frame } = this.state.shown;
    if (field < 0) return { low: 0, high: 1 };
    let range =
      rangeMode === "fixed"
        ? fixed
        : rangeMode === "frame"
          ? chunkRange(this.document.frames[frame]!.values[field]!, component)
          : this.wholeRange();
    if (rangeMode !== "fixed" && fieldText(this.fields[field]!.name).look === "sparse")
      range = { low: Math.min(0, range.low), high: range.high };
    return range.high > range.low ? range : { low: range.low, high: range.low + (Math.abs(range.low) || 1) };
  }

  private chunksOf(frame: number): { displacement: ChunkInfo | undefined; field: ChunkInfo | undefined; hidden: ChunkInfo | undefined } {
    const f = this.document.frames[frame]!;
    const at = this.fields.findIndex((x) => x.name === "displacement");
    return {
      displacement: f.values[at],
      field: this.state.shown.field >= 0 ? f.values[this.state.shown.field] : undefined,
      hidden: f.hidden,
    };
  }

  /** Draws the chosen frame as soon as its data are there; resolves when it is drawn, or when a later wish has overtaken it. */
  async show(): Promise<boolean> {
    const wish = ++this.wanted;
    const { frame, field, component, hiddenParts } = this.state.shown;
    const { displacement, field: fieldInfo, hidden } = this.chunksOf(frame);
    const [moves, values, off] = await Promise.all(
      [displacement, fieldInfo, hidden].map((info) => (info ? this.store.get(info) : undefined)),
    );
    if (wish !== this.wanted) return false;
    this.current = { frame, data: new Map() };
    let coloring: Coloring | undefined;
    if (values && fieldInfo) {
      this.current.data.set(field, values);
      const about = this.fields[field]!;
      const { quanta, range } = scalarQuanta(values, fieldInfo, component);
      coloring = {
        quanta: about.on === "element" ? this.toFaces(quanta) : quanta,
        range,
        shown: this.shownRange(),
        on: about.on,
        look: fieldText(about.name).look,
      };
    }
    const visible = new Uint8Array(this.partOfFace.length);
    for (let f = 0; f < visible.length; f++) visible[f] = (off && off[f]) || hiddenParts.has(this.partOfFace[f]!) ? 0 : 1;
    this.view.setVisible(visible);
    this.view.setFrame(moves as Uint16Array | undefined, displacement, coloring);
    return true;
  }

  private faceScratch = new Uint16Array();
  private toFaces(quanta: Uint16Array): Uint16Array {
    if (this.faceScratch.length !== this.faceElement.length) this.faceScratch = new Uint16Array(this.faceElement.length);
    for (let f = 0; f < this.faceElement.length; f++) this.faceScratch[f] = quanta[this.faceElement[f]!]!;
    return this.faceScratch;
  }

  /** Decodes what playing will need, one frame at a time, while nothing else is asked for. */
  async prefetch(): Promise<void> {
    const { field, frame } = this.state.shown;
    for (let step = 1; step < this.document.frames.length; step++) {
      if (this.state.shown.field !== field) return;
      const next = (frame + step) % this.document.frames.length;
      const { displacement, field: info, hidden } = this.chunksOf(next);
      await Promise.all([displacement, info, hidden].map((c) => (c && !this.store.has(c) ? this.store.get(c) : undefined)));
    }
  }

  /** All values of a node and of an element in the picture's frame. */
  async values(owner: {
    node: number | undefined;
    element: number | undefined;
  }): Promise<{ label: string; value: number; dimension: ReturnType<typeof fieldText>["dimension"]; look: string; on: string }[]> {
    const frame = this.document.frames[this.state.shown.frame]!;
    const out = [];
    for (let i = 0; i < this.fields.length; i++) {
      const about = this.fields[i]!;
      const which = about.on === "node" ? owner.node : owner.element;
      if (which === undefined) continue;
      const info = frame.values[i]!;
      const data = await this.store.get(info);
      const text = fieldText(about.name);
      for (const c of componentsOf(about)) {
        const name = c.component === -1 || c.name === "" ? text.label : `${text.label} ${c.name}`;
        out.push({ label: name, value: valueAt(data, info, c.component, which), dimension: text.dimension, look: text.look, on: about.on });
      }
    }
    return out;
  }

  nodeOf(id: number): number | undefined {
    if (!this.nodeIndex) {
      this.nodeIndex = new Map();
      this.nodeIds.forEach((n, i) => this.nodeIndex!.set(n, i));
    }
    return this.nodeIndex.get(id);
  }
  /** A face of the element. */
  faceOf(elementId: number): number | undefined {
    if (!this.elementFace) {
      this.elementFace = new Map();
      for (let f = this.faceElement.length - 1; f >= 0; f--) this.elementFace.set(this.elementIds[this.faceElement[f]!]!, f);
    }
    return this.elementFace.get(elementId);
  }
}
