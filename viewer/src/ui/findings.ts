// The panel of findings: a card for each, which leads to its place on the mesh.
import { allFindings, type Finding, type ReportDocument } from "../data/document";
import { formatNumber, plural } from "../data/units";
import { h, icon } from "./dom";
import type { State } from "./state";

const severities = { error: "Errors", warning: "Warnings", note: "Notes" } as const;

function findingText(finding: Finding): { what: string; advice: string } {
  if (finding.what) return { what: finding.what, advice: finding.advice ?? "" };
  return { what: (finding.message ?? finding.code).replace(/\s*\[[\w.]+\]$/, ""), advice: finding.advice ?? "" };
}

export function findingsPanel(document: ReportDocument, state: State): HTMLElement {
  const findings = allFindings(document.run);
  const out = h("div", { class: "panel" });
  if (findings.length === 0) {
    out.append(
      h(
        "p",
        { class: "empty" },
        h("strong", null, "Nothing found"),
        "The inspection before the run and the watch during it had nothing to say about this model.",
      ),
    );
    return out;
  }
  const cards: HTMLElement[] = [];
  for (const severity of ["error", "warning", "note"] as const) {
    const some = findings.map((f, i) => ({ f, i })).filter(({ f }) => f.severity === severity);
    if (some.length === 0) continue;
    out.append(h("h3", null, `${severities[severity]} `, h("span", { class: "count" }, some.length)));
    for (const { f, i } of some) {
      const { what, advice } = findingText(f);
      const where = [f.interface !== undefined ? `interface ${f.interface}` : "", f.surface ? `surface ${f.surface}` : ""]
        .filter(Boolean)
        .join(", ");
      const size = [f.segments ? plural(f.segments.length, "segment") : "", f.nodes ? plural(f.nodes.length, "node") : ""]
        .filter(Boolean)
        .join(", ");
      const card = h(
        "button",
        {
          type: "button",
          class: `finding ${severity}`,
          "data-finding": i,
          "aria-pressed": "false",
          onclick: () => state.set({ finding: state.shown.finding === i ? -1 : i }),
        },
        h(
          "span",
          { class: "finding-head" },
          h("span", { class: "code" }, f.code.replace(/^contact\./, "")),
          where ? h("span", { class: "quiet" }, where) : null,
        ),
        h("span", { class: "finding-what" }, `${what}.`.replace(/\.\.$/, ".")),
        advice ? h("span", { class: "finding-advice" }, advice) : null,
        size || f.time !== undefined
          ? h(
              "span",
              { class: "finding-foot" },
              [size, f.time !== undefined ? `at time ${formatNumber(f.time)}` : ""].filter(Boolean).join(" · "),
              size || f.interface !== undefined ? h("span", { class: "show" }, icon("eye"), "show") : null,
            )
          : f.file
            ? h("span", { class: "finding-foot" }, `${f.file.split("/").pop()}${f.line ? `:${f.line}` : ""}`)
            : null,
      );
      cards.push(card);
      out.append(card);
    }
  }
  state.on((changes) => {
    if (!changes.has("finding")) return;
    for (const card of cards) {
      const chosen = Number(card.dataset["finding"]) === state.shown.finding;
      card.setAttribute("aria-pressed", String(chosen));
      if (chosen) card.scrollIntoView({ block: "nearest" });
    }
  });
  return out;
}
