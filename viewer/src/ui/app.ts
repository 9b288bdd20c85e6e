// The page: header, panels, picture with its tools, plots; keyboard and theme.
import type { Finding, ReportDocument } from "../data/document";
import { allFindings } from "../data/document";
import { componentsOf, fieldText } from "../data/fields";
import { nearestIndex, type Columns } from "../data/series";
import type { ChunkStore } from "../data/store";
import { formatNumber, unitName } from "../data/units";
import { colorMaps } from "../view/colormap";
import type { Vec } from "../view/pick";
import { h, icon, iconButton, replace, tabs } from "./dom";
import { legend } from "./legend";
import { findingsPanel, partsPanel, pickPanel, summaryPanel } from "./panels";
import { Picture } from "./picture";
import { PlotPanel } from "./plots";
import { State } from "./state";

const FRAMES_PER_SECOND = 16;

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
  private plots: PlotPanel | undefined;
  private themeChosen = false;
  private readonly canvas = h("canvas", {
    class: "canvas",
    tabindex: "0",
    role: "application",
    "aria-label": "Picture of the model. Drag to turn, scroll to zoom, right-drag to move, click to pick. Arrow keys with Shift turn.",
  });
  private readonly legendPlace = h("div", { class: "legend-place" });
  private readonly timeText = h("output", { class: "time" });
  private readonly slider = h("input", { type: "range", class: "scrub", min: 0, step: 1, "aria-label": "State of the animation" });
  private readonly playButton = iconButton("play", "Play (Space)", () => this.togglePlay());
  private side: ReturnType<typeof tabs> | undefined;
  private componentSelect = h("select", { "aria-label": "Component" });
  private fieldSelect = h("select", { "aria-label": "Colour by" });
  private showing: Promise<unknown> = Promise.resolve();
  private readonly toast = h("div", { class: "toast", role: "status" });
  private readonly arrowsData: { segments: number[][]; color: Vec; interface: number }[] = [];

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
    this.followTheme();
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
      if (this.picture.view.faces.count <= 6000) this.state.set({ mesh: true });
      void this.picture.prefetch();
    }
  }

  // ---- layout ------------------------------------------------------------------------------------------------------

  private build(): void {
    const { run } = this.document;
    const counts = { error: 0, warning: 0, note: 0 };
    for (const f of allFindings(run)) counts[f.severity]++;
    const kind = run.outcome?.kind ?? "running";
    const error = run.energies?.["ERR"];
    const chip = (tone: string, text: string, title: string, onclick?: () => void) =>
      onclick
        ? h("button", { type: "button", class: `chip ${tone}`, title, onclick }, text)
        : h("span", { class: `chip ${tone}`, title }, text);
    const header = h(
      "header",
      { class: "header" },
      h("span", { class: "brand", "aria-label": "abut report" }, h("span", { class: "brand-mark", "aria-hidden": "true" }), "abut"),
      h("h1", null, run.model.name, run.model.title ? h("span", { class: "title" }, run.model.title) : null),
      h(
        "div",
        { class: "chips" },
        chip(
          kind === "finished" ? "good" : "bad",
          kind === "finished" ? "finished" : kind,
          run.outcome?.message ?? "the run left no outcome: it was stopped from outside",
        ),
        error !== undefined && error !== null
          ? chip(
              Math.abs(error) < 0.01 ? "good" : Math.abs(error) < 0.05 ? "warn" : "bad",
              `energy error ${formatNumber(100 * error, 2)} %`,
              "error of the energy balance at the end",
              () => this.plots?.open("error"),
            )
          : null,
        counts.error
          ? chip("bad", `${counts.error} error${counts.error > 1 ? "s" : ""}`, "show the findings", () => this.side?.open("findings"))
          : null,
        counts.warning
          ? chip("warn", `${counts.warning} warning${counts.warning > 1 ? "s" : ""}`, "show the findings", () =>
              this.side?.open("findings"),
            )
          : null,
      ),
      h("span", { class: "grow" }),
      iconButton("theme", "Dark or light (D)", () => this.toggleTheme(), { "data-action": "theme" }),
      iconButton("help", "Keys and help (?)", () => this.help().showModal(), { "data-action": "help" }),
    );
    const side = h("aside", { class: "side", "aria-label": "About the run" });
    const center = this.hasPicture
      ? this.buildView()
      : h(
          "section",
          { class: "view" },
          h(
            "p",
            { class: "empty" },
            h("strong", null, "No animation"),
            "The run wrote no states. /ANIM/DT in the Engine deck asks for them; everything else of the run is here.",
          ),
        );
    const splitter = h("div", {
      class: "splitter",
      role: "separator",
      "aria-orientation": "horizontal",
      "aria-label": "Height of the plots",
      tabindex: "0",
    });
    const plots = h("div", { class: "plot-place" });
    const main = h("main", { class: "main" }, center, splitter, plots);
    replace(this.root, header, h("div", { class: "body" }, side, main), this.toast);
    this.wireSplitter(splitter, plots);
    document.title = `${run.model.name}: abut report`;
    document.addEventListener("keydown", (event) => this.key(event));
  }

  private buildView(): HTMLElement {
    const { shown } = this.state;
    const fields = this.document.fields ?? [];
    const groups = [...new Set(fields.map((f) => fieldText(f.name).group))];
    this.fieldSelect = h(
      "select",
      { "aria-label": "Colour by", "data-action": "field", onchange: () => this.setField(Number(this.fieldSelect.value)) },
      h("option", { value: -1 }, "parts"),
      groups.map((g) =>
        h(
          "optgroup",
          { label: g },
          fields
            .map((f, i) => ({ f, i }))
            .filter(({ f }) => fieldText(f.name).group === g)
            .map(({ f, i }) => h("option", { value: i }, fieldText(f.name).label)),
        ),
      ),
    );
    this.componentSelect = h("select", {
      "aria-label": "Component",
      onchange: () => this.state.set({ component: Number(this.componentSelect.value) }),
    });
    const deform = h("input", {
      type: "number",
      min: 0,
      step: "any",
      value: shown.deform,
      "aria-label": "Scale of the deformation",
      title: "Displacements are drawn this many times as large",
      onchange: () => this.state.set({ deform: Math.max(0, Number(deform.value) || 0) }),
    });
    const range = h(
      "select",
      { "aria-label": "Range of the colours", onchange: () => this.setRangeMode(range.value as "all" | "frame" | "fixed") },
      h("option", { value: "all" }, "range: whole run"),
      h("option", { value: "frame" }, "range: this state"),
      h("option", { value: "fixed" }, "range: fixed"),
    );
    const low = h("input", { type: "number", step: "any", "aria-label": "Lowest value" });
    const high = h("input", { type: "number", step: "any", "aria-label": "Highest value" });
    const setFixed = () => this.state.set({ fixed: { low: Number(low.value), high: Number(high.value) } });
    low.addEventListener("change", setFixed);
    high.addEventListener("change", setFixed);
    const fixed = h("span", { class: "fixed-range", hidden: true }, low, "to", high);
    const maps = h(
      "select",
      { "aria-label": "Colour map", onchange: () => this.state.set({ colorMap: Number(maps.value) }) },
      colorMaps.map((m, i) => h("option", { value: i }, m.name)),
    );
    const toggle = (name: string, label: string, key: "mesh" | "normals") => {
      const button = iconButton(name, label, () => this.state.set({ [key]: !this.state.shown[key] }), {
        "aria-pressed": "false",
        "data-action": key,
      });
      this.state.on((changes) => changes.has(key) && button.setAttribute("aria-pressed", String(this.state.shown[key])));
      return button;
    };
    this.state.on((changes) => {
      if (changes.has("rangeMode")) {
        range.value = this.state.shown.rangeMode;
        fixed.hidden = this.state.shown.rangeMode !== "fixed";
        if (!fixed.hidden) {
          low.value = formatPlain(this.state.shown.fixed.low);
          high.value = formatPlain(this.state.shown.fixed.high);
        }
      }
      if (changes.has("deform")) deform.value = String(this.state.shown.deform);
    });
    const bar = h(
      "div",
      { class: "toolbar", role: "toolbar", "aria-label": "Picture" },
      h("label", { class: "field" }, "Colour by", this.fieldSelect),
      this.componentSelect,
      range,
      fixed,
      maps,
      h("label", { class: "field" }, "Deformation", h("span", { class: "times" }, "×", deform)),
      h("span", { class: "grow" }),
      toggle("mesh", "Element edges (E)", "mesh"),
      (this.document.contact ?? []).length > 0 ? toggle("normals", "Normals of contact surfaces (N)", "normals") : null,
      iconButton("fit", "Fit into the frame (F)", () => this.picture?.view.fit()),
      iconButton("camera", "Save the picture as PNG", () => this.savePicture()),
    );
    const last = this.document.frames.length - 1;
    this.slider.max = String(last);
    this.slider.value = String(shown.frame);
    this.slider.addEventListener("input", () => this.state.set({ frame: Number(this.slider.value), playing: false }));
    const go = (frame: number) => this.state.set({ frame: Math.min(last, Math.max(0, frame)), playing: false });
    const transport = h(
      "div",
      { class: "transport", role: "toolbar", "aria-label": "Animation" },
      iconButton("start", "First state (Home)", () => go(0)),
      iconButton("previous", "One state back (←)", () => go(this.state.shown.frame - 1)),
      this.playButton,
      iconButton("next", "One state on (→)", () => go(this.state.shown.frame + 1)),
      iconButton("end", "Last state (End)", () => go(last)),
      this.slider,
      this.timeText,
    );
    this.playButton.dataset["action"] = "play";
    return h(
      "section",
      { class: "view", "aria-label": "Picture" },
      bar,
      h("div", { class: "stage" }, this.canvas, this.legendPlace),
      transport,
    );
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
      entries.push({ id: "parts", title: "Parts", make: () => partsPanel(this.document, picture, this.state) });
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
    const table: Columns = new Map(names.map((name, i) => [name, arrays[i] as Float32Array]));
    const { run } = this.document;
    this.plots = new PlotPanel({
      columns: table,
      units: run.model.units,
      interfaceTitle: (id) => `${id}  ${run.model.interfaces.find((i) => i.id === id)?.title ?? ""}`,
      time: () => (this.hasPicture ? this.document.frames[this.state.shown.frame]!.time : undefined),
      goTo: (time) => {
        if (this.hasPicture)
          this.state.set({
            frame: nearestIndex(
              this.document.frames.map((f) => f.time),
              time,
            ),
            playing: false,
          });
      },
    });
    this.root.querySelector(".plot-place")!.replaceChildren(this.plots.element);
  }

  private wireSplitter(splitter: HTMLElement, plots: HTMLElement): void {
    const set = (height: number) => {
      const most = this.root.clientHeight - 260;
      plots.style.height = `${Math.min(most, Math.max(90, height))}px`;
    };
    splitter.addEventListener("pointerdown", (event) => {
      splitter.setPointerCapture(event.pointerId);
      const from = event.clientY + plots.clientHeight;
      const move = (e: PointerEvent) => set(from - e.clientY);
      splitter.addEventListener("pointermove", move);
      splitter.addEventListener("pointerup", () => splitter.removeEventListener("pointermove", move), { once: true });
    });
    splitter.addEventListener("keydown", (event) => {
      const step = event.key === "ArrowUp" ? 24 : event.key === "ArrowDown" ? -24 : 0;
      if (step === 0) return;
      event.preventDefault();
      event.stopPropagation();
      set(plots.clientHeight + step);
    });
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
    this.fieldSelect.value = String(this.state.shown.field);
    this.fillComponents();
    this.updateReadouts();

    let down: { x: number; y: number } | undefined;
    this.canvas.addEventListener("pointerdown", (e) => (down = e.button === 0 ? { x: e.clientX, y: e.clientY } : undefined));
    this.canvas.addEventListener("pointerup", (e) => {
      if (!down || Math.hypot(e.clientX - down.x, e.clientY - down.y) > 4) return;
      this.pickAt(e.clientX, e.clientY);
    });

    this.state.on((changes) => {
      const { shown } = this.state;
      if (changes.has("colorMap")) view.setColorMap(colorMaps[shown.colorMap]!);
      if (changes.has("deform")) view.setDeform(shown.deform);
      if (changes.has("mesh")) view.showMesh(shown.mesh);
      if (changes.has("field") || changes.has("component")) this.fieldSelect.value = String(shown.field);
      if (changes.has("field")) this.fillComponents();
      if (changes.has("component")) this.componentSelect.value = String(shown.component);
      if (changes.has("frame") || changes.has("field") || changes.has("component") || changes.has("hiddenParts")) {
        this.showing = picture.show();
        void this.showing.then((drawn) => {
          if (drawn && this.state.shown.normals) this.updateArrows();
          if (drawn && changes.has("field")) void picture.prefetch();
        });
      } else if (changes.has("rangeMode") || changes.has("fixed")) view.setShown(picture.shownRange());
      if (changes.has("normals") || (changes.has("deform") && shown.normals)) this.updateArrows();
      if (changes.has("selected")) view.select(shown.selected.face, shown.selected.node);
      if (changes.has("finding")) this.followFinding();
      if (changes.has("playing")) {
        this.playButton.replaceChildren(icon(shown.playing ? "pause" : "play"));
        this.playButton.setAttribute("aria-label", shown.playing ? "Pause (Space)" : "Play (Space)");
        if (shown.playing) void this.play();
      }
      this.updateReadouts();
      if (changes.has("frame")) this.plots?.mark();
    });
  }

  setField(field: number): void {
    const about = this.document.fields?.[field];
    this.state.set({
      field,
      component: about ? componentsOf(about)[0]!.component : 0,
      rangeMode: this.state.shown.rangeMode === "fixed" ? "all" : this.state.shown.rangeMode,
    });
  }

  private setRangeMode(mode: "all" | "frame" | "fixed"): void {
    if (mode === "fixed" && this.picture) this.state.set({ fixed: this.picture.shownRange() });
    this.state.set({ rangeMode: mode });
  }

  private fillComponents(): void {
    const about = this.document.fields?.[this.state.shown.field];
    const choices = about ? componentsOf(about) : [];
    this.componentSelect.replaceChildren(...choices.map((c) => h("option", { value: c.component }, c.name)));
    this.componentSelect.hidden = choices.length < 2;
    this.componentSelect.value = String(this.state.shown.component);
  }

  private updateReadouts(): void {
    const { shown } = this.state;
    const frame = this.document.frames[shown.frame]!;
    const units = this.document.run.model.units;
    this.slider.value = String(shown.frame);
    this.slider.setAttribute("aria-valuetext", `time ${formatNumber(frame.time)} ${units.time}`);
    this.timeText.textContent = `${shown.frame + 1}/${this.document.frames.length}   t = ${formatNumber(frame.time)} ${units.time}`;
    const about = this.document.fields?.[shown.field];
    if (!about || !this.picture) {
      this.legendPlace.replaceChildren();
      return;
    }
    const text = fieldText(about.name);
    const part = componentsOf(about).find((c) => c.component === shown.component);
    const title = part && part.name && part.component >= 0 ? `${text.label} ${part.name}` : text.label;
    this.legendPlace.replaceChildren(
      legend(
        title,
        unitName(units, text.dimension),
        this.picture.shownRange(),
        text.look,
        colorMaps[shown.colorMap]!,
        about.name === "contact_gap",
      ),
    );
  }

  togglePlay(): void {
    if (this.document.frames.length > 1) this.state.set({ playing: !this.state.shown.playing });
  }

  /** Resolves when the picture that is wished for stands. */
  async drawn(): Promise<void> {
    for (let awaited; awaited !== this.showing; ) {
      awaited = this.showing;
      await awaited;
    }
    await new Promise<void>((resolve) => requestAnimationFrame(() => resolve()));
  }

  /** One state after the other, as fast as they can be drawn but not faster than `FRAMES_PER_SECOND`. */
  private async play(): Promise<void> {
    if (!this.picture) return;
    const count = this.document.frames.length;
    while (this.state.shown.playing) {
      const start = performance.now();
      this.state.set({ frame: (this.state.shown.frame + 1) % count });
      await this.drawn();
      await new Promise((resolve) => setTimeout(resolve, Math.max(0, 1000 / FRAMES_PER_SECOND - (performance.now() - start))));
    }
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

  // ---- contact -----------------------------------------------------------------------------------------------------

  private async loadContact(): Promise<void> {
    if (this.arrowsData.length > 0) return;
    for (const surface of this.document.contact ?? []) {
      const data = await this.store.get(surface.segments);
      const n = surface.segments.count;
      const segments = Array.from({ length: n }, (_, i) => [0, 1, 2, 3].map((k) => data[k * n + i]!));
      this.arrowsData.push({ segments, color: surface.side === 1 ? [0.09, 0.5, 0.9] : [0.94, 0.4, 0.1], interface: surface.interface });
    }
  }

  private updateArrows(): void {
    void this.loadContact().then(() => this.picture?.view.setArrows(this.state.shown.normals ? this.arrowsData : []));
  }

  private async followFinding(): Promise<void> {
    const picture = this.picture!;
    const finding: Finding | undefined = allFindings(this.document.run)[this.state.shown.finding];
    if (!finding) {
      picture.view.mark([], []);
      return;
    }
    let segments = (finding.segments ?? []).map((s) => s.map((id) => picture.nodeOf(id) ?? -1)).filter((s) => s.every((n) => n >= 0));
    const nodes = (finding.nodes ?? []).map((id) => picture.nodeOf(id) ?? -1).filter((n) => n >= 0);
    if (segments.length === 0 && nodes.length === 0 && finding.interface !== undefined) {
      await this.loadContact();
      segments = this.arrowsData.filter((g) => g.interface === finding.interface).flatMap((g) => g.segments);
    }
    if (finding.time !== undefined) {
      this.state.set({
        frame: nearestIndex(
          this.document.frames.map((f) => f.time),
          finding.time,
        ),
        playing: false,
      });
      await this.drawn();
    }
    picture.view.mark(segments, nodes);
    if (segments.length + nodes.length > 0) picture.view.fit([...new Set([...segments.flat(), ...nodes])]);
    else this.say("This finding has no place on the mesh.");
  }

  // ---- theme, keys, help -------------------------------------------------------------------------------------------

  /// The system's theme, as long as the user has not chosen one.
  private followTheme(): void {
    const system = window.matchMedia("(prefers-color-scheme: dark)");
    this.setTheme(system.matches);
    system.addEventListener("change", () => {
      if (this.themeChosen) return;
      this.setTheme(system.matches);
      this.rethemed();
    });
  }
  private setTheme(dark: boolean): void {
    document.documentElement.dataset["theme"] = dark ? "dark" : "light";
  }
  get dark(): boolean {
    return document.documentElement.dataset["theme"] === "dark";
  }
  toggleTheme(): void {
    this.themeChosen = true;
    this.setTheme(!this.dark);
    this.rethemed();
  }
  private rethemed(): void {
    this.themePicture();
    this.plots?.refresh();
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
    view.drawNow();
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

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (
      event.ctrlKey ||
      event.metaKey ||
      event.altKey ||
      target.closest("input:not([type=range]):not([type=checkbox]), select, textarea, dialog")
    )
      return;
    const { shown } = this.state;
    const view = this.picture?.view;
    const last = this.document.frames.length - 1;
    const go = (frame: number) => this.hasPicture && this.state.set({ frame: Math.min(last, Math.max(0, frame)), playing: false });
    const looks: Record<string, Vec> = { "1": [1, 0, 0.001], "2": [0, -1, 0.001], "3": [0.001, -0.001, 1], "0": [-0.75, -1, 0.62] };
    const turn = 0.12;
    const actions: Record<string, () => void> = {
      " ": () => this.togglePlay(),
      ArrowLeft: () => (event.shiftKey ? view?.turn(turn, 0) : go(shown.frame - 1)),
      ArrowRight: () => (event.shiftKey ? view?.turn(-turn, 0) : go(shown.frame + 1)),
      ArrowUp: () => event.shiftKey && view?.turn(0, turn),
      ArrowDown: () => event.shiftKey && view?.turn(0, -turn),
      Home: () => go(0),
      End: () => go(last),
      f: () => view?.fit(),
      e: () => this.state.set({ mesh: !shown.mesh }),
      n: () => (this.document.contact ?? []).length > 0 && this.state.set({ normals: !shown.normals }),
      d: () => this.toggleTheme(),
      c: () => this.hasPicture && this.setField(((shown.field + 2) % ((this.document.fields ?? []).length + 1)) - 1),
      "+": () => view?.zoom(0.85),
      "-": () => view?.zoom(1 / 0.85),
      "?": () => this.help().showModal(),
      Escape: () => this.state.set({ selected: { face: undefined, node: undefined }, finding: -1 }),
    };
    const direction = looks[event.key];
    const action = direction ? () => view?.look(direction) : (actions[event.key] ?? actions[event.key.toLowerCase()]);
    if (!action || (event.key === " " && target.closest("button, summary"))) return;
    if (event.key.startsWith("Arrow") && target.closest("[role=tablist], [role=separator]")) return;
    event.preventDefault();
    action();
  }

  private helpDialog: HTMLDialogElement | undefined;
  private help(): HTMLDialogElement {
    if (this.helpDialog) return this.helpDialog;
    const keys: [string, string][] = [
      ["Space", "play, pause"],
      ["← →", "one state back, on"],
      ["Home End", "first, last state"],
      ["C", "next field"],
      ["E", "element edges"],
      ["N", "normals of contact surfaces: blue first, orange second surface"],
      ["F", "fit into the frame"],
      ["1 2 3 0", "look along x, y, z; from the corner"],
      ["Shift + arrows", "turn"],
      ["+ −", "zoom"],
      ["D", "dark, light"],
      ["Esc", "let go of what is marked"],
    ];
    const dialog = h(
      "dialog",
      { class: "help", "aria-label": "Keys and help" },
      h("h2", null, "Keys"),
      h("dl", { class: "facts keys" }, keys.map(([k, v]) => [h("dt", null, h("kbd", null, k)), h("dd", null, v)]).flat()),
      h(
        "p",
        null,
        "Drag turns, the wheel zooms, the right button moves. A click on the picture picks the element and its nearest node; a click on a plot goes to that time.",
      ),
      h(
        "p",
        null,
        "Contact pressure is a node's net normal contact force over the area of contact surface around it. Where two surfaces hold each other in two passes, both passes are in the net force, each once.",
      ),
      h("form", { method: "dialog" }, h("button", { class: "small", type: "submit" }, "Close")),
    );
    document.body.append(dialog);
    this.helpDialog = dialog;
    return dialog;
  }
}

function formatPlain(value: number): string {
  return String(Number(value.toPrecision(5)));
}
