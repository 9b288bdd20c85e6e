// Below the picture: play, pause, scrub, step.
import type { ReportDocument } from "../data/document";
import { formatNumber } from "../data/units";
import { h, icon, iconButton } from "./dom";
import type { State } from "./state";

const FRAMES_PER_SECOND = 16;

export class Transport {
  readonly element: HTMLElement;
  private readonly slider: HTMLInputElement;
  private readonly text = h("output", { class: "time" });
  private readonly playButton = iconButton("play", "Play (Space)", () => this.toggle(), { "data-action": "play" });

  /** @param drawn resolves when the picture that is wished for stands */
  constructor(
    private readonly document: ReportDocument,
    private readonly state: State,
    private readonly drawn: () => Promise<void>,
  ) {
    this.slider = h("input", { type: "range", class: "scrub", min: 0, step: 1, "aria-label": "State of the animation" });
    this.slider.max = String(this.last);
    this.slider.addEventListener("input", () => state.set({ frame: Number(this.slider.value), playing: false }));
    this.element = h(
      "div",
      { class: "transport", role: "toolbar", "aria-label": "Animation" },
      iconButton("start", "First state (Home)", () => this.go(0)),
      iconButton("previous", "One state back (←)", () => this.step(-1)),
      this.playButton,
      iconButton("next", "One state on (→)", () => this.step(1)),
      iconButton("end", "Last state (End)", () => this.go(this.last)),
      this.slider,
      this.text,
    );
    this.update();
    state.on((changes) => {
      if (changes.has("frame")) this.update();
      if (!changes.has("playing")) return;
      const { playing } = state.shown;
      this.playButton.replaceChildren(icon(playing ? "pause" : "play"));
      this.playButton.setAttribute("aria-label", playing ? "Pause (Space)" : "Play (Space)");
      if (playing) void this.play();
    });
  }

  get last(): number {
    return this.document.frames.length - 1;
  }
  go(frame: number): void {
    this.state.set({ frame: Math.min(this.last, Math.max(0, frame)), playing: false });
  }
  step(by: number): void {
    this.go(this.state.shown.frame + by);
  }
  toggle(): void {
    if (this.last > 0) this.state.set({ playing: !this.state.shown.playing });
  }

  private update(): void {
    const { frame } = this.state.shown;
    const time = `${formatNumber(this.document.frames[frame]!.time)} ${this.document.run.model.units.time}`;
    this.slider.value = String(frame);
    this.slider.setAttribute("aria-valuetext", `time ${time}`);
    this.text.textContent = `${frame + 1}/${this.last + 1}   t = ${time}`;
  }

  /** One state after the other, as fast as they can be drawn but not faster than `FRAMES_PER_SECOND`. */
  private async play(): Promise<void> {
    while (this.state.shown.playing) {
      const start = performance.now();
      this.state.set({ frame: (this.state.shown.frame + 1) % (this.last + 1) });
      await this.drawn();
      await new Promise((resolve) => setTimeout(resolve, Math.max(0, 1000 / FRAMES_PER_SECOND - (performance.now() - start))));
    }
  }
}
