// The legend in the corner of the picture, and the form that sets its range.
import type { Look, Range } from "../data/fields";
import { formatNumber } from "../data/units";
import { colorAt, css, ticks, type ColorMap } from "../view/colormap";
import { h } from "./dom";

export function legend(title: string, unit: string, range: Range, look: Look, map: ColorMap, hasGaps: boolean): HTMLElement {
  const head = h("div", { class: "legend-title" }, title, unit ? h("span", { class: "quiet" }, ` ${unit}`) : null);
  if (look === "state") {
    const entry = (color: string, text: string) => h("li", null, h("span", { class: "swatch", style: `background:${color}` }), text);
    return h(
      "div",
      { class: "legend" },
      head,
      h(
        "ul",
        { class: "legend-states" },
        entry("rgb(33 115 191)", "sticks"),
        entry("rgb(237 125 33)", "slips"),
        entry("var(--part)", "apart"),
      ),
    );
  }
  const stops = Array.from({ length: 33 }, (_, i) => css(colorAt(map, i / 32)));
  const marks = ticks(range.low, range.high, 5).map((t) => ({ t, at: (100 * (t - range.low)) / (range.high - range.low) }));
  return h(
    "div",
    { class: "legend" },
    head,
    h(
      "div",
      { class: "legend-bar" },
      h("div", { class: "legend-colors", style: `background:linear-gradient(to top, ${stops.join(", ")})` }),
      h(
        "div",
        { class: "legend-ticks" },
        marks.map(({ t, at }) => h("span", { style: `bottom:${at}%` }, formatNumber(t, 3))),
      ),
    ),
    h("div", { class: "legend-ends quiet" }, `${formatNumber(range.low, 4)} to ${formatNumber(range.high, 4)}`),
    look === "sparse"
      ? h("div", { class: "legend-none" }, h("span", { class: "swatch", style: "background:var(--part)" }), "no contact")
      : hasGaps
        ? h("div", { class: "legend-none" }, h("span", { class: "swatch", style: "background:var(--part)" }), "no value")
        : null,
  );
}
