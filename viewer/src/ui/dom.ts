// Small helpers over the DOM.

type Child = Node | string | number | undefined | null | false;
type Props = Record<string, unknown>;

/** An element with attributes, `on...` handlers and children: h("button.primary", { onclick }, "Play"). */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  props?: Props | null,
  ...children: (Child | Child[])[]
): HTMLElementTagNameMap[K];
export function h(tag: string, props?: Props | null, ...children: (Child | Child[])[]): HTMLElement;
export function h(tag: string, props?: Props | null, ...children: (Child | Child[])[]): HTMLElement {
  const [name, ...classes] = tag.split(".");
  const element = document.createElement(name!);
  if (classes.length > 0) element.className = classes.join(" ");
  for (const [key, value] of Object.entries(props ?? {})) {
    if (value === undefined || value === false || value === null) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value as EventListener);
    else if (key === "class") element.className = [element.className, String(value)].filter(Boolean).join(" ");
    else if (key === "style") element.style.cssText = String(value);
    else if (key === "value" && "value" in element) (element as HTMLInputElement).value = String(value);
    else element.setAttribute(key, value === true ? "" : String(value));
  }
  for (const child of children.flat()) {
    if (child === undefined || child === null || child === false) continue;
    element.append(typeof child === "number" ? String(child) : child);
  }
  return element;
}

export function replace(parent: Element, ...children: (Child | Child[])[]): void {
  parent.replaceChildren(
    ...children
      .flat()
      .filter((c): c is Node | string | number => c !== undefined && c !== null && c !== false)
      .map((c) => (typeof c === "number" ? String(c) : c)),
  );
}

/** Pictograms: 20 x 20, strokes in the text colour. */
const paths: Record<string, string> = {
  play: "M6 4l10 6-10 6z",
  pause: "M6 4v12M14 4v12",
  previous: "M13 4l-7 6 7 6M5 4v12",
  next: "M7 4l7 6-7 6M15 4v12",
  start: "M15 4l-7 6 7 6M9 4l-7 6 7 6",
  end: "M5 4l7 6-7 6M11 4l7 6-7 6",
  fit: "M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4M7 7h6v6H7z",
  mesh: "M3 3h14v14H3zM3 10h14M10 3v14",
  normals: "M3 15h14M6 15V6M4 8l2-3 2 3M14 15V6M12 8l2-3 2 3",
  theme: "M10 3a7 7 0 1 0 7 7 5.5 5.5 0 0 1-7-7z",
  help: "M7.5 7.5a2.5 2.5 0 1 1 3.6 2.3c-.8.4-1.1.9-1.1 1.7M10 14.5v.5",
  camera: "M3 7h3l1.5-2h5L14 7h3v9H3zM10 14a2.5 2.5 0 1 0 0-5 2.5 2.5 0 0 0 0 5z",
  eye: "M2 10s3-5 8-5 8 5 8 5-3 5-8 5-8-5-8-5zM10 12a2 2 0 1 0 0-4 2 2 0 0 0 0 4z",
  hidden:
    "M3 3l14 14M4.5 6.5C2.900 8 2 10 2 10s3 5 8 5c1.300 0 2.500-.3 3.500-.8M8 5.200c.6-.1 1.300-.2 2-.2 5 0 8 5 8 5s-.6 1-1.700 2.200",
  search: "M9 14A5 5 0 1 0 9 4a5 5 0 0 0 0 10zM13 13l4 4",
  close: "M5 5l10 10M15 5L5 15",
};
export function icon(name: string): SVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 20 20");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", paths[name] ?? "");
  svg.append(path);
  return svg;
}

export function iconButton(name: string, label: string, onclick: (event: Event) => void, props: Props = {}): HTMLButtonElement {
  return h("button", { type: "button", class: "icon-button", "aria-label": label, title: label, onclick, ...props }, icon(name));
}

/** Tabs with arrow keys; the panels are made when they are first opened. */
export function tabs(
  label: string,
  entries: { id: string; title: Child | Child[]; make: () => HTMLElement }[],
  changed?: (id: string) => void,
) {
  const panel = h("div", { class: "tab-panel", role: "tabpanel", tabindex: "-1" });
  const made = new Map<string, HTMLElement>();
  const buttons = entries.map(({ id, title }) =>
    h("button", { type: "button", role: "tab", class: "tab", "data-tab": id, onclick: () => open(id) }, ...[title].flat()),
  );
  const list = h("div", { class: "tabs", role: "tablist", "aria-label": label }, buttons);
  let current = "";
  list.addEventListener("keydown", (event) => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (step === 0) return;
    event.preventDefault();
    event.stopPropagation();
    const at = entries.findIndex((e) => e.id === current);
    const next = (at + step + entries.length) % entries.length;
    open(entries[next]!.id);
    buttons[next]!.focus();
  });
  function open(id: string): void {
    const entry = entries.find((e) => e.id === id);
    if (!entry || id === current) return;
    current = id;
    buttons.forEach((b, i) => {
      const chosen = entries[i]!.id === id;
      b.setAttribute("aria-selected", String(chosen));
      b.tabIndex = chosen ? 0 : -1;
    });
    if (!made.has(id)) made.set(id, entry.make());
    panel.replaceChildren(made.get(id)!);
    changed?.(id);
  }
  return {
    list,
    panel,
    open,
    get current() {
      return current;
    },
  };
}
