// The line at the top: what ran, how it ended, where to look first.
import { allFindings, errorText, outcomeText, type ReportDocument } from "../data/document";
import { h, iconButton } from "./dom";

export interface HeaderActions {
  openFindings: () => void;
  openError: () => void;
  toggleTheme: () => void;
  help: () => void;
}

function chip(tone: string, text: string, title: string, onclick?: () => void): HTMLElement {
  return onclick
    ? h("button", { type: "button", class: `chip ${tone}`, title, onclick }, text)
    : h("span", { class: `chip ${tone}`, title }, text);
}

export function header({ run }: ReportDocument, actions: HeaderActions): HTMLElement {
  const counts = { error: 0, warning: 0, note: 0 };
  for (const f of allFindings(run)) counts[f.severity]++;
  const outcome = outcomeText(run);
  const error = run.energies?.["ERR"];
  const plural = (count: number, noun: string) => `${count} ${noun}${count > 1 ? "s" : ""}`;
  return h(
    "header",
    { class: "header" },
    h("span", { class: "brand", "aria-label": "abut report" }, h("span", { class: "brand-mark", "aria-hidden": "true" }), "abut"),
    h("h1", null, run.model.name, run.model.title ? h("span", { class: "title" }, run.model.title) : null),
    h(
      "div",
      { class: "chips" },
      chip(outcome.short === "finished" ? "good" : "bad", outcome.short, outcome.long),
      error !== undefined
        ? chip(
            error === null ? "bad" : Math.abs(error) < 0.01 ? "good" : Math.abs(error) < 0.05 ? "warn" : "bad",
            `energy error ${errorText(error, 2)}`,
            "error of the energy balance at the end",
            actions.openError,
          )
        : null,
      counts.error ? chip("bad", plural(counts.error, "error"), "show the findings", actions.openFindings) : null,
      counts.warning ? chip("warn", plural(counts.warning, "warning"), "show the findings", actions.openFindings) : null,
    ),
    h("span", { class: "grow" }),
    iconButton("theme", "Dark or light (D)", actions.toggleTheme, { "data-action": "theme" }),
    iconButton("help", "Keys and help (?)", actions.help, { "data-action": "help" }),
  );
}
