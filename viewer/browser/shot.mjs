// A picture of a report: node viewer/browser/shot.mjs REPORT.html OUT.png [WIDTHxHEIGHT] [dark] [STEPS: javascript with `page` and `abut`]
import { openReport } from "./browser.mjs";

const [report, out, size = "1280x720", theme = "light", steps = ""] = process.argv.slice(2);
const [width, height] = size.split("x").map(Number);
const { page, browser, problems } = await openReport(report, { width, height, theme });
if (steps) await page.evaluate(`(async () => { const abut = window.abut; ${steps} })()`);
await page.waitForTimeout(800);
await page.screenshot({ path: out });
if (problems.length > 0) console.error(problems.join("\n"));
await browser.close();
