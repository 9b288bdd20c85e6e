// Plots below the picture: uPlot, coloured by the page's theme, with the time of the picture marked.
import uPlot from "uplot";
import {
  controllerShares,
  controllerText,
  energyLines,
  errorLines,
  interfaceIds,
  interfaceLines,
  columnDimension,
  nearestIndex,
  type Column,
  type Columns,
  type Line,
} from "../data/series";
import { formatNumber, unitName, type UnitNames } from "../data/units";
import { h, tabs } from "./dom";

const lineColors = ["--line-1", "--line-2", "--line-3", "--line-4", "--line-5", "--line-6", "--line-7", "--line-8"];

function cssValue(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

export interface PlotHost {
  columns: Columns;
  units: UnitNames;
  interfaceTitle: (id: number) => string;
  /** Time of the picture, or undefined without an animation. */
  time: () => number | undefined;
  /** A time was clicked. */
  goTo: (time: number) => void;
}

/** One plot; remakes itself when the theme or the place changes. */
class Plot {
  readonly element = h("div", { class: "plot" });
  private readonly line = h("div", { class: "plot-mark", hidden: true });
  private plot: uPlot | undefined;
  private readonly on: boolean[];
  private readonly observer: ResizeObserver;

  constructor(
    private readonly host: PlotHost,
    private readonly lines: Line[],
    private readonly options: { percent?: boolean; strip?: Column | undefined; label: string },
  ) {
    this.on = lines.map((l) => !l.off);
    this.observer = new ResizeObserver(() => this.fill());
    this.observer.observe(this.element);
    this.element.setAttribute("role", "img");
    this.element.setAttribute("aria-label", options.label);
  }

  refresh(): void {
    this.plot?.destroy();
    this.plot = undefined;
    this.fill();
  }
  /** Marks the picture's time; the legend shows its values while the pointer is elsewhere. */
  mark(): void {
    this.place();
    const at = this.host.time();
    const time = this.host.columns.get("time");
    if (!this.plot || at === undefined || !time || this.plot.cursor.left! >= 0) return;
    this.plot.setLegend({ idx: nearestIndex(time, at) }, false);
  }

  /** The line at the picture's time is an element above the plot: moving it draws no plot again. */
  private place(): void {
    const at = this.host.time();
    const x = this.plot && at !== undefined ? this.plot.valToPos(at, "x") : -1;
    this.line.hidden = !(x >= 0 && x <= this.plot!.over.clientWidth);
    if (!this.line.hidden) this.line.style.transform = `translateX(${x.toFixed(1)}px)`;
  }

  private fill(): void {
    const width = this.element.clientWidth;
    const height = this.element.clientHeight;
    if (width < 60 || height < 60) return;
    if (this.plot) {
      this.plot.setSize({ width, height: this.roomFor(height) });
      queueMicrotask(() => this.mark()); // after uPlot has drawn, which empties its legend
      return;
    }
    this.make(width, height);
  }
  private roomFor(height: number): number {
    const legend = this.element.querySelector(".u-legend");
    return Math.max(60, height - (legend ? legend.getBoundingClientRect().height : 28));
  }

  private make(width: number, height: number): void {
    const time = this.host.columns.get("time");
    if (!time) return;
    const text = cssValue("--text-2");
    const grid = cssValue("--grid");
    const font = "11px " + cssValue("--font");
    const anyRight = this.lines.some((l) => l.right);
    const axis = (extra: uPlot.Axis): uPlot.Axis => ({
      stroke: text,
      font,
      labelFont: font,
      labelSize: 18,
      grid: { stroke: grid, width: 1 },
      ticks: { stroke: grid, width: 1, size: 4 },
      ...extra,
    });
    const unit = (lines: Line[]) => {
      const dimensions = [...new Set(lines.map((l) => l.dimension))];
      return this.options.percent ? "%" : dimensions.length === 1 ? unitName(this.host.units, dimensions[0]!) : "";
    };
    const values = (_: uPlot, splits: number[]) => splits.map((v) => formatNumber(v, 3));
    const number = (_: uPlot, v: number | null) => (v === null || v === undefined ? "–" : formatNumber(v));
    const plot = new uPlot(
      {
        width,
        height: height - 28,
        pxAlign: 1,
        padding: [8, anyRight ? 4 : 16, 0, 4],
        cursor: {
          points: { size: 6 },
          drag: { x: true, y: false },
        },
        legend: { live: true, markers: { dash: (_u, i) => (i > lineColors.length ? "dashed" : "solid") } },
        scales: {
          x: { time: false },
          y: { range: (_u, low, high) => padded(low, high) },
          right: { range: (_u, low, high) => padded(low, high) },
        },
        axes: [
          axis({ values, label: `time${this.host.units.time ? ` [${this.host.units.time}]` : ""}`, size: 30 }),
          axis({
            values,
            size: 64,
            label: unit(this.lines.filter((l) => !l.right)) ? `[${unit(this.lines.filter((l) => !l.right))}]` : "",
          }),
          ...(anyRight
            ? [axis({ scale: "right", side: 1, values, size: 48, label: this.lines.find((l) => l.right)!.label, grid: { show: false } })]
            : []),
        ],
        series: [
          { label: "time", value: number },
          ...this.lines.map((line, i) => ({
            label: line.label,
            scale: line.right ? "right" : "y",
            show: this.on[i]!,
            stroke: cssValue(lineColors[i % lineColors.length]!),
            width: 1.5,
            // Colours come round again, dashes tell the lines apart.
            ...(line.right ? { dash: [4, 3] } : i >= lineColors.length ? { dash: [10, 4] } : {}),
            points: { show: false },
            value: number,
          })),
        ],
        hooks: {
          ready: [
            (u) =>
              u.over.addEventListener("click", () => {
                if (!this.dragged && u.cursor.left! >= 0) this.host.goTo(u.posToVal(u.cursor.left!, "x"));
              }),
          ],
          setSeries: [
            (_u, index, opts) => {
              if (index !== null && index > 0 && opts.show !== undefined) this.on[index - 1] = opts.show;
            },
          ],
          setSelect: [
            () => {
              this.dragged = true;
              setTimeout(() => (this.dragged = false), 0);
            },
          ],
          draw: [
            (u) => {
              if (this.options.strip) drawStrip(u, time, this.options.strip);
              this.place();
            },
          ],
        },
      },
      [time, ...this.lines.map((l) => l.values)] as unknown as uPlot.AlignedData,
      this.element,
    );
    this.plot = plot;
    plot.over.append(this.line);
    // The plot leaves room for its legend, whose height is known once it is laid out.
    const names = this.element.querySelector(".u-legend");
    if (names) this.observer.observe(names);
    this.fill();
    this.mark();
  }
  private dragged = false;
}

function padded(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  if (low === high) return low === 0 ? [-1, 1] : [low - 0.1 * Math.abs(low), high + 0.1 * Math.abs(high)];
  const room = 0.06 * (high - low);
  return [low >= 0 && low < 0.3 * high ? 0 : low - room, high + room];
}

/** A band at the bottom that says who controls the time step. */
function drawStrip(u: uPlot, time: Column, kinds: Column): void {
  const { left, top, width, height } = u.bbox;
  const band = 7 * devicePixelRatio;
  u.ctx.save();
  u.ctx.beginPath();
  u.ctx.rect(left, top, width, height);
  u.ctx.clip();
  for (let i = 0; i < kinds.length; ) {
    let j = i + 1;
    while (j < kinds.length && kinds[j] === kinds[i]) j++;
    const x0 = u.valToPos(time[i]!, "x", true);
    const x1 = u.valToPos(time[Math.min(j, time.length - 1)]!, "x", true);
    u.ctx.fillStyle = cssValue(lineColors[kinds[i]! % lineColors.length]!);
    u.ctx.fillRect(x0, top + height - band, Math.max(1, x1 - x0), band);
    i = j;
  }
  u.ctx.restore();
}

export class PlotPanel {
  readonly element: HTMLElement;
  private readonly plots: Plot[] = [];
  private readonly tabs: ReturnType<typeof tabs>;

  constructor(private readonly host: PlotHost) {
    const { columns } = host;
    const ids = interfaceIds([...columns.keys()]);
    this.tabs = tabs(
      "Plots",
      [
        { id: "energy", title: "Energies", make: () => this.plot(energyLines(columns), { label: "Energies over time" }) },
        {
          id: "error",
          title: "Energy error",
          make: () =>
            this.plot(errorLines(columns), { percent: true, label: "Energy error over time, in per cent of the largest term so far" }),
        },
        { id: "interfaces", title: "Interfaces", make: () => this.interfaces(ids) },
        { id: "step", title: "Time step", make: () => this.step() },
        { id: "signals", title: "Signals", make: () => this.signals() },
      ],
      () => requestAnimationFrame(() => this.mark()),
    );
    const empty = h(
      "p",
      { class: "empty" },
      h("strong", null, "No time history"),
      "The run folder has no NAME_th.csv with rows. /TFILE in the Engine deck asks for one.",
    );
    const has = (columns.get("time")?.length ?? 0) > 1;
    this.element = h("section", { class: "plots", "aria-label": "Plots" }, has ? [this.tabs.list, this.tabs.panel] : empty);
    if (has) this.tabs.open("energy");
  }

  open(tab: string): void {
    this.tabs.open(tab);
  }
  refresh(): void {
    for (const p of this.plots) p.refresh();
  }
  mark(): void {
    for (const p of this.plots) if (p.element.isConnected) p.mark();
  }

  private make(lines: Line[], options: ConstructorParameters<typeof Plot>[2]): Plot {
    const plot = new Plot(this.host, lines, options);
    this.plots.push(plot);
    return plot;
  }
  private plot(lines: Line[], options: ConstructorParameters<typeof Plot>[2]): HTMLElement {
    return this.make(lines, options).element;
  }

  private interfaces(ids: number[]): HTMLElement {
    if (ids.length === 0) return h("p", { class: "empty" }, h("strong", null, "No interfaces"), "The model has no contact interface.");
    const place = h("div", { class: "fill" });
    const show = (id: number) =>
      place.replaceChildren(this.plot(interfaceLines(this.host.columns, id), { label: `Forces and nodes in contact of interface ${id}` }));
    show(ids[0]!);
    if (ids.length === 1) return place;
    const choice = h(
      "select",
      { "aria-label": "Interface", onchange: (e: Event) => show(Number((e.target as HTMLSelectElement).value)) },
      ids.map((id) => h("option", { value: id }, this.host.interfaceTitle(id))),
    );
    return h(
      "div",
      { class: "fill columns" },
      h("div", { class: "plot-side" }, h("label", { class: "field" }, "Interface", choice)),
      place,
    );
  }

  private step(): HTMLElement {
    const { columns } = this.host;
    const dt = columns.get("GLOBAL/DT");
    const kinds = columns.get("GLOBAL/DTKIND");
    const ids = columns.get("GLOBAL/DTID");
    const plot = this.plot(dt ? [{ label: "DT  time step", values: dt, dimension: "time" }] : [], {
      label: "Time step over time",
      strip: kinds,
    });
    if (!kinds) return plot;
    const rows = controllerShares(kinds, ids).map((s) =>
      h(
        "li",
        null,
        h("span", { class: "swatch", style: `background:var(${lineColors[s.kind % lineColors.length]})` }),
        h("span", null, controllerText(s, kinds.length)),
        h("span", { class: "number" }, `${formatNumber((100 * s.rows) / kinds.length, 3)} %`),
      ),
    );
    return h(
      "div",
      { class: "fill columns" },
      h("div", { class: "plot-side" }, h("h3", null, "Who gives the step"), h("ul", { class: "shares" }, rows)),
      h("div", { class: "fill" }, plot),
    );
  }

  private signals(): HTMLElement {
    const { columns } = this.host;
    const names = [...columns.keys()].filter((n) => n !== "time");
    const chosen = new Set<string>(names.filter((n) => /^NODE\/.*\/D[XYZ]$/.test(n)).slice(0, 3));
    if (chosen.size === 0 && names.length > 0) chosen.add(names[0]!);
    const place = h("div", { class: "fill" });
    const show = () => {
      const lines = names
        .filter((n) => chosen.has(n))
        .map((n): Line => ({ label: n, values: columns.get(n)!, dimension: columnDimension(n) }));
      place.replaceChildren(
        lines.length > 0
          ? this.plot(lines, { label: `Signals ${lines.map((l) => l.label).join(", ")}` })
          : h("p", { class: "empty" }, h("strong", null, "Nothing chosen"), "Tick a signal on the left."),
      );
    };
    const list = h("ul", { class: "signal-list" });
    const fill = (filter: string) => {
      const words = filter.toUpperCase().split(/\s+/).filter(Boolean);
      const matching = names.filter((n) => words.every((w) => n.toUpperCase().includes(w)));
      list.replaceChildren(
        ...matching.slice(0, 400).map((n) => {
          const box = h("input", {
            type: "checkbox",
            onchange: () => {
              if (box.checked) chosen.add(n);
              else chosen.delete(n);
              show();
            },
          }) as HTMLInputElement;
          box.checked = chosen.has(n);
          return h("li", null, h("label", null, box, n));
        }),
        ...(matching.length === 0 ? [h("li", { class: "quiet" }, "no signal of that name")] : []),
      );
    };
    fill("");
    show();
    const filter = h("input", {
      type: "search",
      placeholder: `Filter ${names.length} signals`,
      "aria-label": "Filter signals",
      oninput: (e: Event) => fill((e.target as HTMLInputElement).value),
    });
    return h("div", { class: "fill columns" }, h("div", { class: "plot-side" }, filter, list), place);
  }
}
