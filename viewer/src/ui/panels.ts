// The panels at the left: what ran, parts, what was picked.
import { errorText, outcomeText, phaseShares, type ReportDocument } from "../data/document";
import { formatCount, formatNumber, plural, unitName } from "../data/units";
import { css, partColor } from "../view/colormap";
import { h, icon, iconButton } from "./dom";
import type { Picture } from "./picture";
import type { State } from "./state";

function rows(entries: [string, string | number | undefined][]): HTMLElement {
  return h(
    "dl",
    { class: "facts" },
    entries
      .filter(([, v]) => v !== undefined && v !== "")
      .map(([k, v]) => [h("dt", null, k), h("dd", null, v!)])
      .flat(),
  );
}

function section(title: string, ...content: HTMLElement[]): HTMLElement {
  return h("section", null, h("h3", null, title), ...content);
}

export function summaryPanel(document: ReportDocument): HTMLElement {
  const { run } = document;
  const m = run.model;
  const outcome = run.outcome;
  const e = run.energies;
  const elements = m.shells + m.sh3ns + m.bricks + m.tetras;
  const energyUnit = unitName(m.units, "energy");
  const out = h("div", { class: "panel" });
  out.append(
    section(
      "Run",
      rows([
        ["outcome", outcomeText(run).long],
        [
          "time",
          outcome?.time === undefined ? undefined : `${formatNumber(outcome.time)} ${m.units.time} of ${formatNumber(m.t_end ?? NaN)}`,
        ],
        ["cycles", outcome?.cycles === undefined ? undefined : formatCount(outcome.cycles)],
        ["wall time", outcome?.wall_seconds === undefined ? undefined : `${formatNumber(outcome.wall_seconds, 3)} s`],
        ["energy error", errorText(e?.["ERR"], 3)],
        [
          "worst",
          run.worst?.ERR ? `${errorText(run.worst.ERR.value, 3)} at ${formatNumber(run.worst.ERR.time, 3)} ${m.units.time}` : undefined,
        ],
        ["contact CX", e?.["CX"] === undefined || e["CX"] === null ? undefined : `${formatNumber(e["CX"], 3)} ${energyUnit}`],
        ["added mass", run.mass && run.mass.added > 0 ? errorText(run.mass.error, 3) : undefined],
      ]),
    ),
    section(
      "Model",
      rows([
        ["nodes", formatCount(m.nodes)],
        ["elements", formatCount(elements)],
        ["shells", m.shells + m.sh3ns > 0 && m.bricks + m.tetras > 0 ? formatCount(m.shells + m.sh3ns) : undefined],
        ["solids", m.bricks + m.tetras > 0 && m.shells + m.sh3ns > 0 ? formatCount(m.bricks + m.tetras) : undefined],
        ["units", [m.units.mass, m.units.length, m.units.time].join(", ")],
        [
          "states",
          document.states_left_out ? `${document.frames.length}; ${document.states_left_out} could not be read` : document.frames.length,
        ],
      ]),
    ),
  );
  if (m.interfaces.length > 0) {
    out.append(
      section(
        plural(m.interfaces.length, "interface"),
        ...m.interfaces.map((i) =>
          h(
            "div",
            { class: "item" },
            h(
              "div",
              { class: "item-head" },
              h("span", { class: "tag" }, i.type),
              h("span", { class: "item-title" }, `${i.id}  ${i.title ?? ""}`),
            ),
            rows([
              ["gap", i.gap ? `${formatNumber(i.gap)} ${m.units.length}` : "none"],
              ["friction", i.friction ? formatNumber(i.friction) : "none"],
              ["stiffness scale", i.stiffness_scale === undefined ? undefined : formatNumber(i.stiffness_scale)],
            ]),
          ),
        ),
      ),
    );
  }
  const settings = run.settings ?? {};
  const phases = phaseShares(run).slice(0, 6);
  if (phases.length > 0) {
    out.append(
      section(
        "Where the time went",
        h(
          "ul",
          { class: "bars" },
          phases.map((t) =>
            h(
              "li",
              null,
              h("span", null, t.name),
              h(
                "span",
                { class: "bar", "aria-hidden": "true" },
                h("i", { style: `width:${((100 * t.share) / phases[0]!.share).toFixed(1)}%` }),
              ),
              h("span", { class: "number" }, `${formatNumber(100 * t.share, 2)} %`),
            ),
          ),
        ),
      ),
    );
  }
  out.append(
    section(
      "Program",
      rows([
        ["abut", `${run.abut.version}${run.abut.commit ? ` (${run.abut.commit})` : ""}`],
        ["profile", settings["profile"] as string | undefined],
        ["threads", settings["threads"] as number | undefined],
        ["instructions", settings["instruction_set"] as string | undefined],
        ["started", run.started?.replace("T", " ").replace("Z", " UTC")],
      ]),
      h(
        "ul",
        { class: "files" },
        (run.decks ?? []).map((d) => h("li", null, d)),
      ),
    ),
  );
  return out;
}

export function partsPanel(document: ReportDocument, state: State): HTMLElement {
  const parts = document.mesh!.parts;
  const counts = document.mesh!.part_elements;
  const massUnit = document.run.model.units.mass;
  const toggle = (index: number, only: boolean) => {
    const hidden = new Set(state.shown.hiddenParts);
    if (only) {
      const others = parts.map((_, i) => i).filter((i) => i !== index);
      const already = others.every((i) => hidden.has(i)) && !hidden.has(index);
      hidden.clear();
      if (!already) for (const i of others) hidden.add(i);
    } else if (hidden.has(index)) hidden.delete(index);
    else hidden.add(index);
    state.set({ hiddenParts: hidden });
  };
  const items = parts.map((id, i) => {
    const about = document.run.model.parts.find((p) => p.id === id);
    const button = h(
      "button",
      {
        type: "button",
        class: "part-toggle",
        "data-part": id,
        "aria-pressed": "true",
        onclick: () => toggle(i, false),
        title: "Show or hide this part",
      },
      h("span", { class: "eye" }),
      h("span", { class: "swatch", style: `background:${css(partColor(i))}` }),
      h(
        "span",
        { class: "part-name" },
        h("span", null, about?.title || `part ${id}`),
        h(
          "span",
          { class: "quiet" },
          [
            `id ${id}`,
            counts[i] ? plural(counts[i]!, "element") : "",
            about?.mass !== undefined ? `${formatNumber(about.mass)} ${massUnit}` : "",
          ]
            .filter(Boolean)
            .join(" · "),
        ),
      ),
    );
    const only = h(
      "button",
      { type: "button", class: "only", onclick: () => toggle(i, true), title: "Show only this part, or all again" },
      "only",
    );
    return { li: h("li", null, button, only), button };
  });
  const refresh = () => {
    items.forEach(({ button }, i) => {
      const shown = !state.shown.hiddenParts.has(i);
      button.setAttribute("aria-pressed", String(shown));
      button.querySelector(".eye")!.replaceChildren(icon(shown ? "eye" : "hidden"));
    });
  };
  refresh();
  state.on((changes) => changes.has("hiddenParts") && refresh());
  return h(
    "div",
    { class: "panel" },
    h(
      "div",
      { class: "panel-actions" },
      h("button", { type: "button", class: "small", onclick: () => state.set({ hiddenParts: new Set() }) }, "Show all"),
      h(
        "button",
        { type: "button", class: "small", onclick: () => state.set({ hiddenParts: new Set(parts.map((_, i) => i)) }) },
        "Hide all",
      ),
    ),
    h(
      "ul",
      { class: "parts" },
      items.map((i) => i.li),
    ),
  );
}

const shapeNames = ["3-node shell", "shell", "tetrahedron", "pyramid", "wedge", "brick"];
const stateNames = ["apart", "sticks", "slips"];

export function pickPanel(
  document: ReportDocument,
  picture: Picture,
  state: State,
  go: (kind: "node" | "element", id: number) => boolean,
): HTMLElement {
  const result = h("div", { class: "picked" });
  const message = h("p", { class: "quiet", role: "status" });
  const kind = h(
    "select",
    { "aria-label": "What to find" },
    h("option", { value: "node" }, "node"),
    h("option", { value: "element" }, "element"),
  );
  const number = h("input", { type: "number", min: 1, step: 1, placeholder: "id", "aria-label": "Id" });
  const form = h(
    "form",
    {
      class: "find",
      onsubmit: (event: Event) => {
        event.preventDefault();
        const found = go(kind.value as "node" | "element", Number(number.value));
        message.textContent = found ? "" : `no ${kind.value} ${number.value} on the surface that is shown`;
      },
    },
    kind,
    number,
    h("button", { type: "submit", class: "small" }, "Find"),
  );
  let run = 0;
  const refresh = async () => {
    const { face, node } = state.shown.selected;
    const mine = ++run;
    if (face === undefined && node === undefined) {
      result.replaceChildren(
        h("p", { class: "empty" }, h("strong", null, "Nothing picked"), "Click on the picture, or find a node or an element by its id."),
      );
      return;
    }
    const element = face === undefined ? undefined : picture.faceElement[face]!;
    const values = await picture.values({ node, element });
    if (mine !== run) return;
    const units = document.run.model.units;
    const table = (on: string) =>
      h(
        "table",
        { class: "values" },
        h(
          "tbody",
          null,
          values
            .filter((v) => v.on === on)
            .map((v) =>
              h(
                "tr",
                null,
                h("th", { scope: "row" }, v.label),
                h(
                  "td",
                  null,
                  v.look === "state"
                    ? (stateNames[Math.round(v.value)] ?? "–")
                    : `${formatNumber(v.value, 5)} ${Number.isNaN(v.value) ? "" : unitName(units, v.dimension)}`,
                ),
              ),
            ),
        ),
      );
    const frame = document.frames[state.shown.frame]!;
    const parts: HTMLElement[] = [];
    if (node !== undefined) {
      const n = picture.points.length / 3;
      const x = picture.view.positions();
      const origin = document.mesh!.origin;
      const deform = state.shown.deform;
      parts.push(
        h("h3", null, "Node ", h("span", { class: "id", "data-picked-node": picture.nodeIds[node]! }, picture.nodeIds[node]!)),
        h(
          "p",
          { class: "quiet position" },
          deform === 1
            ? `at (${[0, 1, 2].map((c) => formatNumber(x[c * n + node]! + origin[c]!, 5)).join(", ")}) ${units.length}`
            : `from (${[0, 1, 2].map((c) => formatNumber(picture.points[c * n + node]! + origin[c]!, 5)).join(", ")}) ${units.length}`,
        ),
        table("node"),
      );
    }
    if (element !== undefined) {
      const part = document.mesh!.parts[picture.elementPart[element]!]!;
      const title = document.run.model.parts.find((p) => p.id === part)?.title;
      parts.push(
        h(
          "h3",
          null,
          "Element ",
          h("span", { class: "id", "data-picked-element": picture.elementIds[element]! }, picture.elementIds[element]!),
        ),
        h(
          "p",
          { class: "quiet" },
          `${shapeNames[picture.elementShape[element]!] ?? "element"} of part ${part}${title ? `, ${title}` : ""}`,
        ),
        table("element"),
      );
    }
    result.replaceChildren(
      h(
        "div",
        { class: "picked-head" },
        h("p", { class: "quiet" }, `time ${formatNumber(frame.time)} ${units.time}, cycle ${formatCount(frame.cycle)}`),
        iconButton("close", "Clear", () => state.set({ selected: { face: undefined, node: undefined } })),
      ),
      ...parts,
    );
  };
  state.on((changes) => {
    if (changes.has("selected") || changes.has("frame") || changes.has("deform")) void refresh();
  });
  void refresh();
  return h("div", { class: "panel" }, form, message, result);
}
