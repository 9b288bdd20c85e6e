// Opens a report in Debian's Chromium or Firefox, without a network and without a graphics card.
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";
import { chromium, firefox } from "playwright-core";

const places = {
  chromium: [process.env.ABUT_CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"],
  firefox: [process.env.ABUT_FIREFOX, "/usr/bin/firefox-esr", "/usr/bin/firefox"],
};

/** The browser to test with, or undefined. */
export function findBrowser(name) {
  return places[name].find((file) => file && existsSync(file));
}

/** What a test with this browser misses, in words, or undefined. */
export function missing(name) {
  if (!findBrowser(name)) return `there is no ${name} here (scripts/install-deps --tests installs it)`;
  // Firefox without a window finds OpenGL, here Mesa's in software, only through a display.
  if (name === "firefox" && !process.env.DISPLAY && !existsSync("/usr/bin/Xvfb"))
    return "Firefox needs Xvfb for WebGL (scripts/install-deps --tests installs it)";
  return undefined;
}

/** A display of its own for Firefox. */
async function startDisplay() {
  const server = spawn("Xvfb", ["-displayfd", "3", "-screen", "0", "1400x900x24"], { stdio: ["ignore", "ignore", "ignore", "pipe"] });
  const number = await new Promise((resolve, reject) => {
    server.stdio[3].once("data", (data) => resolve(String(data).trim()));
    server.once("error", reject);
    server.once("exit", () => reject(new Error("Xvfb did not start")));
  });
  process.once("exit", () => server.kill());
  return { name: `:${number}`, stop: () => server.kill() };
}

export async function launch(name = "chromium") {
  if (name === "firefox") {
    const display = process.env.DISPLAY ? undefined : await startDisplay();
    // playwright drives an unpatched Firefox, as Debian has it, by WebDriver BiDi.
    const browser = await firefox.launch({
      channel: "moz-firefox",
      executablePath: findBrowser("firefox"),
      headless: true,
      env: { ...process.env, DISPLAY: display?.name ?? process.env.DISPLAY },
      firefoxUserPrefs: { "webgl.force-enabled": true },
    });
    browser.once("disconnected", () => display?.stop());
    return browser;
  }
  return chromium.launch({
    executablePath: findBrowser("chromium"),
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

/** A page with the report, its first picture drawn, and a list to which everything that goes wrong is added. `before` runs in the page first. */
export async function openReport(file, { width = 1280, height = 720, theme = "light", browser = undefined, before = undefined } = {}) {
  const own = browser ?? (await launch());
  const context = await own.newContext({ viewport: { width, height }, colorScheme: theme, offline: true, reducedMotion: "reduce" });
  const page = await context.newPage();
  if (before) await page.addInitScript(before);
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
