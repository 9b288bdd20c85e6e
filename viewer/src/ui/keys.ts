// Keys of the page, and the dialog that names them.
import type { Vec } from "../view/pick";
import type { View } from "../view/scene";
import { h } from "./dom";
import type { State } from "./state";
import type { Toolbar } from "./toolbar";
import type { Transport } from "./transport";

/** What keys act on; without an animation there are no picture, toolbar and transport. */
export interface KeyTargets {
  state: State;
  view: View | undefined;
  toolbar: Toolbar | undefined;
  transport: Transport | undefined;
  hasContact: boolean;
  toggleTheme: () => void;
}

const names: [string, string][] = [
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

const directions: Record<string, Vec> = { "1": [1, 0, 0.001], "2": [0, -1, 0.001], "3": [0.001, -0.001, 1], "0": [-0.75, -1, 0.62] };

const TURN = 0.12;

function actionOf(event: KeyboardEvent, targets: KeyTargets): (() => void) | undefined {
  const { state, view, toolbar, transport } = targets;
  const direction = directions[event.key];
  if (direction) return () => view?.look(direction);
  const shift = event.shiftKey;
  const actions: Record<string, () => void> = {
    " ": () => transport?.toggle(),
    ArrowLeft: () => (shift ? view?.rig.turn(TURN, 0) : transport?.step(-1)),
    ArrowRight: () => (shift ? view?.rig.turn(-TURN, 0) : transport?.step(1)),
    ArrowUp: () => shift && view?.rig.turn(0, TURN),
    ArrowDown: () => shift && view?.rig.turn(0, -TURN),
    Home: () => transport?.go(0),
    End: () => transport?.go(transport.last),
    f: () => view?.fit(),
    e: () => state.set({ mesh: !state.shown.mesh }),
    n: () => targets.hasContact && state.set({ normals: !state.shown.normals }),
    d: () => targets.toggleTheme(),
    c: () => toolbar?.nextField(),
    "+": () => view?.rig.zoom(0.85),
    "-": () => view?.rig.zoom(1 / 0.85),
    "?": () => help(),
    Escape: () => state.set({ selected: { face: undefined, node: undefined }, finding: -1 }),
  };
  return actions[event.key] ?? actions[event.key.toLowerCase()];
}

/** Does what a key stands for, unless it belongs to what has the focus. */
export function press(event: KeyboardEvent, targets: KeyTargets): void {
  const target = event.target as HTMLElement;
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (target.closest("input:not([type=range]):not([type=checkbox]), select, textarea, dialog")) return;
  const action = actionOf(event, targets);
  if (!action || (event.key === " " && target.closest("button, summary"))) return;
  if (event.key.startsWith("Arrow") && target.closest("[role=tablist], [role=separator]")) return;
  event.preventDefault();
  action();
}

let dialog: HTMLDialogElement | undefined;

/** Opens the dialog. */
export function help(): void {
  if (!dialog) {
    dialog = h(
      "dialog",
      { class: "help", "aria-label": "Keys and help" },
      h("h2", null, "Keys"),
      h("dl", { class: "facts keys" }, names.map(([k, v]) => [h("dt", null, h("kbd", null, k)), h("dd", null, v)]).flat()),
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
  }
  dialog.showModal();
}
