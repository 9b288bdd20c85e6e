// Above the picture: what its colours and its shape show.
import type { ReportDocument } from "../data/document";
import { componentsOf, fieldText } from "../data/fields";
import { colorMaps } from "../view/colormap";
import { h, iconButton } from "./dom";
import type { Picture } from "./picture";
import type { State } from "./state";

export interface ToolbarActions {
  fit: () => void;
  save: () => void;
}

export class Toolbar {
  readonly element: HTMLElement;
  private readonly fields: HTMLSelectElement;
  private readonly components: HTMLSelectElement;
  private picture: Picture | undefined;

  constructor(
    private readonly document: ReportDocument,
    private readonly state: State,
    actions: ToolbarActions,
  ) {
    this.fields = this.fieldSelect();
    this.components = h("select", {
      "aria-label": "Component",
      onchange: () => state.set({ component: Number(this.components.value) }),
    });
    const maps = h(
      "select",
      { "aria-label": "Colour map", onchange: () => state.set({ colorMap: Number(maps.value) }) },
      colorMaps.map((m, i) => h("option", { value: i }, m.name)),
    );
    this.element = h(
      "div",
      { class: "toolbar", role: "toolbar", "aria-label": "Picture" },
      h("label", { class: "field" }, "Colour by", this.fields),
      this.components,
      ...this.range(),
      maps,
      h("label", { class: "field" }, "Deformation", h("span", { class: "times" }, "×", this.deformation())),
      h("span", { class: "grow" }),
      this.toggle("mesh", "Element edges (E)", "mesh"),
      (document.contact ?? []).length > 0 ? this.toggle("normals", "Normals of contact surfaces (N)", "normals") : null,
      iconButton("fit", "Fit into the frame (F)", actions.fit),
      iconButton("camera", "Save the picture as PNG", actions.save),
    );
    state.on((changes) => {
      if (changes.has("field") || changes.has("component")) this.fields.value = String(state.shown.field);
      if (changes.has("field")) this.fillComponents();
      if (changes.has("component")) this.components.value = String(state.shown.component);
    });
  }

  /** The picture stands: its range can be asked for. */
  attach(picture: Picture): void {
    this.picture = picture;
    this.fields.value = String(this.state.shown.field);
    this.fillComponents();
  }

  setField(field: number): void {
    const about = this.document.fields?.[field];
    this.state.set({
      field,
      component: about ? componentsOf(about)[0]!.component : 0,
      rangeMode: this.state.shown.rangeMode === "fixed" ? "all" : this.state.shown.rangeMode,
    });
  }
  nextField(): void {
    this.setField(((this.state.shown.field + 2) % ((this.document.fields ?? []).length + 1)) - 1);
  }

  private fillComponents(): void {
    const about = this.document.fields?.[this.state.shown.field];
    const choices = about ? componentsOf(about) : [];
    this.components.replaceChildren(...choices.map((c) => h("option", { value: c.component }, c.name)));
    this.components.hidden = choices.length < 2;
    this.components.value = String(this.state.shown.component);
  }

  private fieldSelect(): HTMLSelectElement {
    const fields = this.document.fields ?? [];
    const groups = [...new Set(fields.map((f) => fieldText(f.name).group))];
    const select = h(
      "select",
      { "aria-label": "Colour by", "data-action": "field", onchange: () => this.setField(Number(select.value)) },
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
    return select;
  }

  private range(): HTMLElement[] {
    const { state } = this;
    const mode = h(
      "select",
      {
        "aria-label": "Range of the colours",
        onchange: () => {
          if (mode.value === "fixed" && this.picture) state.set({ fixed: this.picture.shownRange() });
          state.set({ rangeMode: mode.value as "all" | "frame" | "fixed" });
        },
      },
      h("option", { value: "all" }, "range: whole run"),
      h("option", { value: "frame" }, "range: this state"),
      h("option", { value: "fixed" }, "range: fixed"),
    );
    const setFixed = () => state.set({ fixed: { low: Number(low.value), high: Number(high.value) } });
    const low = h("input", { type: "number", step: "any", "aria-label": "Lowest value", onchange: setFixed });
    const high = h("input", { type: "number", step: "any", "aria-label": "Highest value", onchange: setFixed });
    const ends = h("span", { class: "fixed-range", hidden: true }, low, "to", high);
    const plain = (value: number) => String(Number(value.toPrecision(5)));
    state.on((changes) => {
      if (!changes.has("rangeMode")) return;
      const { rangeMode, fixed } = state.shown;
      mode.value = rangeMode;
      ends.hidden = rangeMode !== "fixed";
      if (ends.hidden) return;
      low.value = plain(fixed.low);
      high.value = plain(fixed.high);
    });
    return [mode, ends];
  }

  private deformation(): HTMLInputElement {
    const { state } = this;
    const input = h("input", {
      type: "number",
      min: 0,
      step: "any",
      value: state.shown.deform,
      "aria-label": "Scale of the deformation",
      title: "Displacements are drawn this many times as large",
      onchange: () => state.set({ deform: Math.max(0, Number(input.value) || 0) }),
    });
    state.on((changes) => {
      if (changes.has("deform")) input.value = String(state.shown.deform);
    });
    return input;
  }

  private toggle(pictogram: string, label: string, key: "mesh" | "normals"): HTMLButtonElement {
    const { state } = this;
    const button = iconButton(pictogram, label, () => state.set({ [key]: !state.shown[key] }), {
      "aria-pressed": "false",
      "data-action": key,
    });
    state.on((changes) => changes.has(key) && button.setAttribute("aria-pressed", String(state.shown[key])));
    return button;
  }
}
