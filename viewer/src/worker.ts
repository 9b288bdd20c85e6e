// Decodes chunks beside the page.
import { decodeChunk, type ChunkInfo } from "./data/chunk";

const scope = self as unknown as { postMessage(message: unknown, transfer?: Transferable[]): void };

self.onmessage = async (event: MessageEvent<{ id: number; info: ChunkInfo; text: string }>) => {
  const { id, info, text } = event.data;
  try {
    const array = await decodeChunk(info, text);
    scope.postMessage({ id, array }, [array.buffer]);
  } catch (error) {
    scope.postMessage({ id, error: String(error) });
  }
};
