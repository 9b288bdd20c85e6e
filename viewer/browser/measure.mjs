// How fast a report is: node browser/measure.mjs REPORT.html [chromium|firefox] prints JSON. No window, software rendering, 1280x720.
//   first_picture_ms  from the start of loading to the first complete picture
//   scrub_ms          median over jumps to all states in random order, each from the wish to the complete picture; every
//                     state is decoded on the way
//   scrub_again_ms    the same when all states are decoded
//   whole_ms          median for the whole picture, as it is drawn where a jump comes to rest (coarse: jumps are drawn coarser)
//   graphics_cpu_ms   processor time of the browser's graphics process per jump, mean (Chromium only): it
//                     depends less on what else the machine does
import { missing, launch, openReport } from "./browser.mjs";

const name = process.argv[3] ?? "chromium";
if (missing(name)) {
  console.log(`skipped: ${missing(name)}`);
  process.exit(77);
}
const browser = await launch(name);
// The browser's own start and its first use of the graphics library are not the report's.
const warm = await browser.newPage();
await warm.evaluate(() => document.createElement("canvas").getContext("webgl2") !== null);
await warm.close();
const { page, problems } = await openReport(process.argv[2], { browser });
const graphics = name === "chromium" ? await browser.newBrowserCDPSession() : undefined;
const graphicsSeconds = async () => {
  const { processInfo } = await graphics.send("SystemInfo.getProcessInfo");
  return processInfo.find((p) => p.type === "GPU").cpuTime;
};
const before = graphics ? await graphicsSeconds() : 0;
const result = await page.evaluate(async () => {
  const { abut } = window;
  const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
  const count = abut.document.frames.length;
  let seed = 7;
  const random = () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  const scrub = async () => {
    const order = Array.from({ length: count }, (_, i) => i).sort(() => random() - 0.5);
    const times = [];
    for (const frame of order) {
      if (frame === abut.state.shown.frame) continue;
      const start = performance.now();
      abut.state.set({ frame });
      await abut.drawn();
      abut.picture.view.wait();
      times.push(performance.now() - start);
    }
    return times;
  };
  const first = await scrub();
  await abut.picture.prefetch();
  const again = await scrub();
  return {
    frames: count,
    faces: abut.picture.view.faces.count,
    elements: abut.document.mesh.elements_total,
    first_picture_ms: Math.round(window.abutFirstPicture),
    scrub_ms: Math.round(median(first)),
    scrub_again_ms: Math.round(median(again)),
    coarse: abut.picture.view.drawnCoarse,
    slowest_ms: Math.round(Math.max(...first, ...again)),
    jumps: first.length + again.length,
  };
});
if (graphics) result.graphics_cpu_ms = Math.round((1000 * ((await graphicsSeconds()) - before)) / result.jumps);
result.whole_ms = await page.evaluate(() => {
  const { view } = window.abut.picture;
  const times = Array.from({ length: 15 }, () => {
    const start = performance.now();
    view.drawNow(true);
    view.wait();
    return performance.now() - start;
  });
  return Math.round(times.sort((a, b) => a - b)[7]);
});
await browser.close();
console.log(JSON.stringify({ ...result, problems }));
