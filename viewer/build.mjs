// Bundles the page: node build.mjs OUT writes OUT/page.html (everything inline) and OUT/viewer_page.cpp (the same as a C++ source).
import { build } from "esbuild";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const out = path.resolve(process.argv[2] ?? "dist");
const common = {
  bundle: true,
  minify: true,
  target: ["chrome110", "firefox115"],
  write: false,
  legalComments: "none",
  logLevel: "warning",
  absWorkingDir: here,
};

// The worker is a text inside the page: from file:// a page may not load a script of its own, but it may run a Blob.
const worker = {
  name: "worker-text",
  setup(b) {
    b.onResolve({ filter: /^worker:/ }, (args) => ({ path: path.resolve(args.resolveDir, args.path.slice(7)), namespace: "worker-text" }));
    b.onLoad({ filter: /.*/, namespace: "worker-text" }, async (args) => {
      const result = await build({ ...common, entryPoints: [args.path], format: "iife" });
      return { contents: result.outputFiles[0].text, loader: "text", watchFiles: [args.path] };
    });
  },
};

const script = (await build({ ...common, entryPoints: ["src/main.ts"], format: "iife", plugins: [worker] })).outputFiles[0].text;
const style = (await build({ ...common, entryPoints: ["src/style.css"] })).outputFiles[0].text;
const licence = async (name) => {
  const folder = path.join(here, "node_modules", name);
  const about = JSON.parse(await readFile(path.join(folder, "package.json"), "utf8"));
  return `${about.name} ${about.version}\n${(await readFile(path.join(folder, "LICENSE"), "utf8")).trim()}`;
};
const notices = `\n${(await Promise.all(["three", "uplot"].map(licence))).join("\n\n")}\n`.replaceAll("--", "- -");

// What ends an element inside a script or style would end it in the page too.
const safe = (text) => text.replaceAll(/<\/(script|style)/gi, "<\\/$1").replaceAll("<!--", "<\\!--");
const template = await readFile(path.join(here, "src", "index.html"), "utf8");
const page = template
  .replace("<!--style-->", () => `<style>${safe(style)}</style>`)
  .replace("<!--script-->", () => `<script>${safe(script)}</script>`)
  .replace("<!--notices-->", () => `<!--${notices}-->`);

// A string literal of any length, cut where MSVC-like limits would not matter but editors do.
const pieces = page.match(/[^]{1,16000}/gu).map((piece) => `R"abut~~(${piece})abut~~"`);
const source = `// Written by viewer/build.mjs.\n#include "viewer_page.hpp"\n\nstd::string_view abut::app::viewer_page() {\n  static constexpr char page[] =\n${pieces.join("\n")};\n  return {page, sizeof page - 1};\n}\n`;
if (page.includes(")abut~~")) throw new Error("the page holds the delimiter of its own literal");
await mkdir(out, { recursive: true });
await writeFile(path.join(out, "page.html"), page);
await writeFile(path.join(out, "viewer_page.cpp"), source);
