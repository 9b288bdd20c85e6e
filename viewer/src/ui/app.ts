// The page: header, panels, picture with its tools, plots.
import { idsOf } from "../data/chunk";
import { allFindings, type ReportDocument } from "../data/document";
import { componentsOf, fieldText } from "../data/fields";
import { nearestIndex, type Columns } from "../data/series";
import type { ChunkStore } from "../data/store";
import { unitName } from "../data/units";
import { colorMaps } from "../view/colormap";
import { ContactMarks } from "./contact";
import { h, replace, tabs } from "./dom";
import { findingsPanel } from "./findings";
import { header } from "./header";
import { help, press } from "./keys";
import { legend } from "./legend";
import { partsPanel, pickPanel, summaryPanel } from "./panels";
import { Picture } from "./picture";
import { PlotPanel } from "./plots";
import { splitter } from "./splitter";
import { State, type Change } from "./state";
import { Theme } from "./theme";
import { Toolbar } from "./toolbar";
import { Transport } from "./transport";

function chooseField(document: ReportDocument): { field: number; component: number } {
  const fields = document.fields ?? [];
  for (const name of ["contact_pressure", "von_mises", "displacement"]) {
    const at = fields.findIndex((f) => f.name === name);
    if (at < 0) continue;
    const high = Math.max(...document.frames.map((f) => Math.max(...(f.values[at]!.high ?? [0]))));
    if (high > 0) return { field: at, component: componentsOf(fields[at]!)[0]!.component };
  }
  return { field: fields.length > 0 ? 0 : -1, component: fields[0] ? componentsOf(fields[0])[0]!.component : 0 };
}

export class App {
  readonly state: State;
  picture: Picture | undefined;
  private readonly theme = new Theme(() => {
    this.themePicture();
    this.plots?.refresh();
  });
  private plots: PlotPanel | undefined;
  private toolbar: Toolbar | undefined;
  private transport: Transport | undefined;
  private marks: ContactMarks | undefined;
  private side: ReturnType<typeof tabs> | undefined;
  private readonly canvas = h("canvas", {
    class: "canvas",
    tabindex: "0",
    role: "application",
    "aria-label": "Picture of the model. Drag to turn, scroll to zoom, right-drag to move, click to pick. Arrow keys with Shift turn.",
  });
  private readonly legendPlace = h("div", { class: "legend-place" });
  private legendShown = "";
  private showing: Promise<unknown> = Promise.resolve();
  private readonly toast = h("div", { class: "toast", role: "status" });

  constructor(
    private readonly root: HTMLElement,
    readonly document: ReportDocument,
    readonly store: ChunkStore,
  ) {
    this.state = new State({
      frame: document.first ?? 0,
      playing: false,
      ...chooseField(document),
      deform: 1,
      rangeMode: "all",
      fixed: { low: 0, high: 1 },
      colorMap: 0,
      mesh: false,
      normals: false,
      hiddenParts: new Set(),
      finding: -1,
      selected: { face: undefined, node: undefined },
    });
  }

  get hasPicture(): boolean {
    return this.document.frames.length > 0 && this.document.mesh !== undefined;
  }

  async start(): Promise<void> {
    this.build();
    if (this.hasPicture) {
      this.picture = await Picture.make(this.canvas, this.document, this.store, this.state);
      this.wirePicture(this.picture);
      await this.picture.show();
      this.picture.view.fit();
      this.picture.view.drawNow();
      this.picture.view.wait();
      (window as unknown as { abutFirstPicture: number }).abutFirstPicture = performance.now();
    }
    this.fillSide();
    await this.fillPlots();
    if (this.picture) {
      await new Promise((resolve) => setTimeout(resolve, 30));
      this.picture.view.makeEdges();
      this.picture.view.makeCoarse();
      if (this.picture.view.faces.count <= 6000) this.state.set({ mesh: true });
      void this.picture.prefetch();
    }
  }

  // ---- layout ------------------------------------------------------------------------------------------------------

  private build(): void {
    const { run } = this.document;
    const top = header(this.document, {
      openFindings: () => this.side?.open("findings"),
      openError: () => this.plots?.open("error"),
      toggleTheme: () => this.theme.toggle(),
      help,
    });
    const side = h("aside", { class: "side", "aria-label": "About the run" });
    const plots = h("div", { class: "plot-place" });
    const main = h("main", { class: "main" }, this.hasPicture ? this.buildView() : this.noView(), splitter(this.root, plots), plots);
    replace(this.root, top, h("div", { class: "body" }, side, main), this.toast);
    document.title = `${run.model.name}: abut report`;
    document.addEventListener("keydown", (event) =>
      press(event, {
        state: this.state,
        view: this.picture?.view,
        toolbar: this.toolbar,
        transport: this.transport,
        hasContact: (this.document.contact ?? []).length > 0,
        toggleTheme: () => this.theme.toggle(),
      }),
    );
  }

  private noView(): HTMLElement {
    const why = "The run wrote no states. /ANIM/DT in the Engine deck asks for them; everything else of the run is here.";
    return h("section", { class: "view" }, h("p", { class: "empty" }, h("strong", null, "No animation"), why));
  }

  private buildView(): HTMLElement {
    this.toolbar = new Toolbar(this.document, this.state, {
      fit: () => this.picture?.view.fit(),
      save: () => this.savePicture(),
    });
    this.transport = new Transport(this.document, this.state, () => this.drawn());
    const stage = h("div", { class: "stage" }, this.canvas, this.legendPlace);
    return h("section", { class: "view", "aria-label": "Picture" }, this.toolbar.element, stage, this.transport.element);
  }

  private fillSide(): void {
    const side = this.root.querySelector(".side")!;
    const n = allFindings(this.document.run).length;
    const entries: { id: string; title: string | (string | Node)[]; make: () => HTMLElement }[] = [
      { id: "summary", title: "Model", make: () => summaryPanel(this.document) },
      {
        id: "findings",
        title: n > 0 ? ["Findings", h("span", { class: "count" }, n)] : "Findings",
        make: () => findingsPanel(this.document, this.state),
      },
    ];
    if (this.picture) {
      const picture = this.picture;
      entries.push({ id: "parts", title: "Parts", make: () => partsPanel(this.document, this.state) });
      entries.push({
        id: "pick",
        title: "Pick",
        make: () => pickPanel(this.document, picture, this.state, (kind, id) => this.find(kind, id)),
      });
    }
    this.side = tabs("About the run", entries);
    replace(side, this.side.list, this.side.panel);
    this.side.open("summary");
  }

  private async fillPlots(): Promise<void> {
    const { names, columns } = this.document.history;
    const arrays = await Promise.all(columns.map((c) => this.store.get(c)));
    const table: Columns = new Map(
      names.map((name, i) => [name, columns[i]!.kind === "u32" ? idsOf(arrays[i]!) : (arrays[i] as Float32Array)]),
    );
    const { run } = this.document;
    const times = this.document.frames.map((f) => f.time);
    this.plots = new PlotPanel({
      columns: table,
      units: run.model.units,
      interfaceTitle: (id) => `${id}  ${run.model.interfaces.find((i) => i.id === id)?.title ?? ""}`,
      time: () => (this.hasPicture ? times[this.state.shown.frame] : undefined),
      goTo: (time) => {
        if (this.hasPicture) this.state.set({ frame: nearestIndex(times, time), playing: false });
      },
    });
    this.root.querySelector(".plot-place")!.replaceChildren(this.plots.element);
  }

  // ---- picture -----------------------------------------------------------------------------------------------------

  private wirePicture(picture: Picture): void {
    const { view } = picture;
    const stage = this.canvas.parentElement!;
    const resize = () => view.resize(stage.clientWidth, stage.clientHeight);
    resize();
    new ResizeObserver(resize).observe(stage);
    this.themePicture();
    view.setColorMap(colorMaps[this.state.shown.colorMap]!);
    this.toolbar!.attach(picture);
    this.updateLegend();
    this.marks = new ContactMarks(
      this.document,
      this.store,
      picture,
      this.state,
      () => this.drawn(),
      (text) => this.say(text),
    );

    let down: { x: number; y: number } | undefined;
    this.canvas.addEventListener("pointerdown", (e) => (down = e.button === 0 ? { x: e.clientX, y: e.clientY } : undefined));
    this.canvas.addEventListener("pointerup", (e) => {
      if (!down || Math.hypot(e.clientX - down.x, e.clientY - down.y) > 4) return;
      this.pickAt(e.clientX, e.clientY);
    });
    this.state.on((changes) => this.follow(picture, changes));
  }

  /** What the picture does when the state has changed. */
  private follow(picture: Picture, changes: ReadonlySet<Change>): void {
    const { shown } = this.state;
    const { view } = picture;
    if (changes.has("colorMap")) view.setColorMap(colorMaps[shown.colorMap]!);
    if (changes.has("deform")) view.setDeform(shown.deform);
    if (changes.has("mesh")) view.showMesh(shown.mesh);
    if (changes.has("frame") || changes.has("field") || changes.has("component") || changes.has("hiddenParts")) {
      this.showing = picture.show();
      void this.showing.then((drawn) => {
        if (drawn && this.state.shown.normals) void this.marks?.showNormals();
        if (drawn && changes.has("field")) void picture.prefetch();
      });
    } else if (changes.has("rangeMode") || changes.has("fixed")) view.setShown(picture.shownRange());
    if (changes.has("normals") || (changes.has("deform") && shown.normals)) void this.marks?.showNormals();
    if (changes.has("selected")) view.select(shown.selected.face, shown.selected.node);
    if (changes.has("finding")) void this.marks?.followFinding();
    this.updateLegend();
    if (changes.has("frame")) this.plots?.mark();
  }

  /** The legend is made again only when it says something else: what is laid out again is drawn again by the browser. */
  private updateLegend(): void {
    const { shown } = this.state;
    const about = this.document.fields?.[shown.field];
    const range = about ? this.picture!.shownRange() : { low: 0, high: 0 };
    const key = about ? [about.name, shown.component, range.low, range.high, shown.colorMap].join() : "";
    if (key === this.legendShown) return;
    this.legendShown = key;
    if (!about) {
      this.legendPlace.replaceChildren();
      return;
    }
    const text = fieldText(about.name);
    const part = componentsOf(about).find((c) => c.component === shown.component);
    const title = part && part.name && part.component >= 0 ? `${text.label} ${part.name}` : text.label;
    const unit = unitName(this.document.run.model.units, text.dimension);
    this.legendPlace.replaceChildren(legend(title, unit, range, text.look, colorMaps[shown.colorMap]!, about.name === "contact_gap"));
  }

  /** Resolves when the picture that is wished for stands. */
  async drawn(): Promise<void> {
    for (let awaited; awaited !== this.showing; ) {
      awaited = this.showing;
      await awaited;
    }
    await new Promise<void>((resolve) => requestAnimationFrame(() => resolve()));
  }

  pickAt(x: number, y: number): void {
    const hit = this.picture?.view.pickAt(x, y);
    this.state.set({ selected: { face: hit?.face, node: hit?.node } });
    if (hit) this.side?.open("pick");
  }

  find(kind: "node" | "element", id: number): boolean {
    const picture = this.picture;
    if (!picture) return false;
    const node = kind === "node" ? picture.nodeOf(id) : undefined;
    const face = kind === "element" ? picture.faceOf(id) : undefined;
    if (node === undefined && face === undefined) return false;
    this.state.set({ selected: { face, node } });
    const count = picture.view.faces.count;
    picture.view.fit(node !== undefined ? [node] : [0, 1, 2, 3].map((k) => picture.view.faces.corners[k * count + face!]!));
    return true;
  }

  private themePicture(): void {
    const style = getComputedStyle(document.documentElement);
    this.picture?.view.setTheme(style.getPropertyValue("--stage").trim(), style.getPropertyValue("--edge").trim());
  }

  private say(text: string): void {
    this.toast.textContent = text;
    this.toast.classList.add("shown");
    setTimeout(() => this.toast.classList.remove("shown"), 3500);
  }

  private savePicture(): void {
    const view = this.picture?.view;
    if (!view) return;
    view.drawNow(true);
    this.canvas.toBlob((blob) => {
      if (!blob) return;
      const link = h("a", {
        href: URL.createObjectURL(blob),
        download: `${this.document.run.model.name}_${this.state.shown.frame + 1}.png`,
      });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
  }
}
