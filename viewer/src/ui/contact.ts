// Contact surfaces on the picture: their normals, and what a finding speaks of.
import { allFindings, type Finding, type ReportDocument } from "../data/document";
import { nearestIndex } from "../data/series";
import type { ChunkStore } from "../data/store";
import type { ArrowGroup } from "../view/arrows";
import type { Picture } from "./picture";
import type { State } from "./state";

/** Colours of the first and of the second surface's arrows. */
const first: [number, number, number] = [0.09, 0.5, 0.9];
const second: [number, number, number] = [0.94, 0.4, 0.1];

export class ContactMarks {
  private surfaces: Promise<(ArrowGroup & { interface: number })[]> | undefined;

  /**
   * @param drawn resolves when the picture that is wished for stands
   * @param say   tells the user something in passing
   */
  constructor(
    private readonly document: ReportDocument,
    private readonly store: ChunkStore,
    private readonly picture: Picture,
    private readonly state: State,
    private readonly drawn: () => Promise<void>,
    private readonly say: (text: string) => void,
  ) {}

  private load() {
    this.surfaces ??= Promise.all(
      (this.document.contact ?? []).map(async (surface) => {
        const data = await this.store.get(surface.segments);
        const n = surface.segments.count;
        const segments = Array.from({ length: n }, (_, i) => [0, 1, 2, 3].map((k) => data[k * n + i]!));
        return { segments, color: surface.side === 1 ? first : second, interface: surface.interface };
      }),
    );
    return this.surfaces;
  }

  async showNormals(): Promise<void> {
    const groups = await this.load();
    this.picture.view.setArrows(this.state.shown.normals ? groups : []);
  }

  /** Marks what the chosen finding speaks of, goes to its time, and brings it into the frame. */
  async followFinding(): Promise<void> {
    const { picture, state } = this;
    const finding: Finding | undefined = allFindings(this.document.run)[state.shown.finding];
    if (!finding) {
      picture.view.mark([], []);
      return;
    }
    let segments = (finding.segments ?? []).map((s) => s.map((id) => picture.nodeOf(id) ?? -1)).filter((s) => s.every((n) => n >= 0));
    const nodes = (finding.nodes ?? []).map((id) => picture.nodeOf(id) ?? -1).filter((n) => n >= 0);
    if (segments.length === 0 && nodes.length === 0 && finding.interface !== undefined) {
      const all = await this.load();
      segments = all.filter((g) => g.interface === finding.interface).flatMap((g) => g.segments.map((s) => [...s]));
    }
    if (finding.time !== undefined) {
      const times = this.document.frames.map((f) => f.time);
      state.set({ frame: nearestIndex(times, finding.time), playing: false });
      await this.drawn();
    }
    picture.view.mark(segments, nodes);
    if (segments.length + nodes.length > 0) picture.view.fit([...new Set([...segments.flat(), ...nodes])]);
    else this.say("This finding has no place on the mesh.");
  }
}
