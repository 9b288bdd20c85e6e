// The bar between the picture and the plots.
import { h } from "./dom";

/** @param root whose height the plots share with the picture */
export function splitter(root: HTMLElement, plots: HTMLElement): HTMLElement {
  const bar = h("div", {
    class: "splitter",
    role: "separator",
    "aria-orientation": "horizontal",
    "aria-label": "Height of the plots",
    tabindex: "0",
  });
  const set = (height: number) => {
    const most = root.clientHeight - 260;
    plots.style.height = `${Math.min(most, Math.max(90, height))}px`;
  };
  bar.addEventListener("pointerdown", (event) => {
    bar.setPointerCapture(event.pointerId);
    const from = event.clientY + plots.clientHeight;
    const move = (e: PointerEvent) => set(from - e.clientY);
    bar.addEventListener("pointermove", move);
    bar.addEventListener("pointerup", () => bar.removeEventListener("pointermove", move), { once: true });
  });
  bar.addEventListener("keydown", (event) => {
    const step = event.key === "ArrowUp" ? 24 : event.key === "ArrowDown" ? -24 : 0;
    if (step === 0) return;
    event.preventDefault();
    event.stopPropagation();
    set(plots.clientHeight + step);
  });
  return bar;
}
