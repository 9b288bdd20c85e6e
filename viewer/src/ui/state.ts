// What is shown. One object, one event: whoever changes it calls `changed`, whoever shows it listens.

export interface Shown {
  frame: number;
  playing: boolean;
  field: number;
  component: number;
  deform: number;
  rangeMode: "all" | "frame" | "fixed";
  fixed: { low: number; high: number };
  colorMap: number;
  mesh: boolean;
  normals: boolean;
  hiddenParts: Set<number>;
  finding: number;
  selected: { face: number | undefined; node: number | undefined };
}

export type Change = keyof Shown;

export class State {
  private readonly listeners: ((changes: ReadonlySet<Change>) => void)[] = [];
  constructor(readonly shown: Shown) {}

  on(listener: (changes: ReadonlySet<Change>) => void): void {
    this.listeners.push(listener);
  }
  set(values: Partial<Shown>): void {
    const changes = new Set<Change>();
    for (const [key, value] of Object.entries(values)) {
      const k = key as Change;
      if (this.shown[k] === value) continue;
      (this.shown as unknown as Record<string, unknown>)[k] = value;
      changes.add(k);
    }
    if (changes.size > 0) for (const listener of this.listeners) listener(changes);
  }
}
