// Opens a report in Debian's Chromium, without a network and without a graphics card.
import { existsSync } from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

/** The Chromium to test with, or undefined. */
export function findChromium() {
  const candidates = [process.env.ABUT_CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
  return candidates.find((file) => file && existsSync(file));
}

export async function launch() {
  return chromium.launch({
    executablePath: findChromium(),
    headless: true,
    args: [
      "--no-sandbox",
      "--use-angle=swiftshader",
      "--use-gl=angle",
      "--enable-unsafe-swiftshader",
      "--ignore-gpu-blocklist",
      "--disable-dev-shm-usage",
    ],
  });
}

/** A page with the report, its first picture drawn, and a list to which everything that goes wrong is added. */
export async function openReport(file, { width = 1280, height = 720, theme = "light", browser = undefined } = {}) {
  const own = browser ?? (await launch());
  const context = await own.newContext({ viewport: { width, height }, colorScheme: theme, offline: true, reducedMotion: "reduce" });
  const page = await context.newPage();
  const problems = [];
  page.on("console", (message) => {
    if (message.type() === "error") problems.push(message.text());
  });
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("request", (request) => {
    if (/^https?:/.test(request.url())) problems.push(`asks the network for ${request.url()}`);
  });
  await page.goto(pathToFileURL(path.resolve(file)).href, { timeout: 120000 });
  await page.waitForFunction(() => document.querySelector(".side .tab-panel")?.firstChild != null, null, { timeout: 120000 });
  await page.waitForFunction(() => document.querySelector(".plots, .plot-place .empty") != null, null, { timeout: 120000 });
  return { page, browser: own, context, problems };
}
