// Chunks on demand: text from the page, decoded in a worker, kept while there is room.
import { constantChunk, decodeChunk, type ChunkArray, type ChunkInfo } from "./chunk";
import workerText from "worker:../worker.ts";

const CACHE_BYTES = 512e6;

export class ChunkStore {
  private worker: Worker | undefined;
  private readonly waiting = new Map<
    number,
    { info: ChunkInfo; text: string; resolve: (a: ChunkArray) => void; reject: (e: Error) => void }
  >();
  private readonly cache = new Map<number, Promise<ChunkArray>>();
  private readonly sizes = new Map<number, number>();
  private readonly ready = new Set<number>();
  private bytes = 0;
  private pageComplete: Promise<void> | undefined;

  constructor() {
    try {
      const url = URL.createObjectURL(new Blob([workerText], { type: "text/javascript" }));
      this.worker = new Worker(url);
      this.worker.onmessage = (event: MessageEvent<{ id: number; array?: ChunkArray; error?: string }>) => {
        const { id, array, error } = event.data;
        const waiter = this.waiting.get(id);
        this.waiting.delete(id);
        if (array) waiter?.resolve(array);
        else waiter?.reject(new Error(error));
      };
      this.worker.onerror = () => this.withoutWorker();
    } catch {
      this.worker = undefined;
    }
  }

  /** True when the chunk can be had without waiting. */
  has(info: ChunkInfo): boolean {
    return info.id < 0 || this.ready.has(info.id);
  }

  get(info: ChunkInfo): Promise<ChunkArray> {
    if (info.id < 0) return Promise.resolve(constantChunk(info));
    const known = this.cache.get(info.id);
    if (known) {
      this.cache.delete(info.id); // youngest last
      this.cache.set(info.id, known);
      return known;
    }
    const made = this.load(info);
    this.cache.set(info.id, made);
    made.then(
      (array) => {
        this.ready.add(info.id);
        this.sizes.set(info.id, array.byteLength);
        this.bytes += array.byteLength;
        this.trim();
      },
      () => this.cache.delete(info.id),
    );
    return made;
  }

  private async load(info: ChunkInfo): Promise<ChunkArray> {
    const text = await this.text(info.id);
    if (!this.worker) return decodeChunk(info, text);
    return new Promise((resolve, reject) => {
      this.waiting.set(info.id, { info, text, resolve, reject });
      this.worker!.postMessage({ id: info.id, info, text });
    });
  }

  private async text(id: number): Promise<string> {
    let element = document.getElementById(`c${id}`);
    if ((!element || !element.nextSibling) && document.readyState === "loading") {
      this.pageComplete ??= new Promise((resolve) => document.addEventListener("DOMContentLoaded", () => resolve(), { once: true }));
      await this.pageComplete;
      element = document.getElementById(`c${id}`);
    }
    if (!element) throw new Error(`chunk ${id} is not in this report`);
    return element.textContent ?? "";
  }

  /** The browser does not let this page have a worker: what waits is decoded here. */
  private withoutWorker(): void {
    this.worker = undefined;
    for (const { info, text, resolve, reject } of this.waiting.values()) decodeChunk(info, text).then(resolve, reject);
    this.waiting.clear();
  }

  private trim(): void {
    for (const id of this.cache.keys()) {
      if (this.bytes <= CACHE_BYTES) return;
      if (!this.ready.has(id)) continue;
      this.bytes -= this.sizes.get(id) ?? 0;
      this.cache.delete(id);
      this.ready.delete(id);
      this.sizes.delete(id);
    }
  }
}
