// Starts the page: the document is in the page, the first picture's chunks are above this script.
import type { ReportDocument } from "./data/document";
import { ChunkStore } from "./data/store";
import { App } from "./ui/app";
import { h, replace } from "./ui/dom";

const root = document.getElementById("app")!;

function fail(title: string, detail: string): void {
  replace(root, h("p", { class: "empty", role: "alert" }, h("strong", null, title), detail));
}

const text = document.getElementById("abut-document")?.textContent;
if (!text) {
  fail("This page holds no run", "It is the empty viewer; `abut report RUN` fills it.");
} else {
  const app = new App(root, JSON.parse(text) as ReportDocument, new ChunkStore());
  // For tests and for people who like consoles.
  (window as unknown as { abut: App }).abut = app;
  app.start().catch((error: unknown) => {
    const message = error instanceof Error ? error.message : String(error);
    fail(
      "The report cannot be shown",
      /webgl/i.test(message) ? `This browser has no WebGL 2, which the picture needs (${message}).` : message,
    );
    console.error(error);
  });
}
