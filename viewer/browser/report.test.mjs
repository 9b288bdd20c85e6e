// The report in a real browser, without a network: node browser/report.test.mjs REPORT.html FINDINGS.html KNOWN.html KNOWN.json [SCREENSHOTS [chromium|firefox]]
//   REPORT    of examples/decks/plate_drop
//   FINDINGS  of examples/decks/findings/normals_away, whose contact surfaces look away from each other
//   KNOWN     of the deck that tests/report/flat_plates.py writes, and the contact values that it has in closed form
// Exit status 77 with a message when there is no such browser. Screenshots stay in the folder.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { checkValue, rows } from "./known.mjs";

const [report, findings, knownReport, knownValues, folder = "screenshots", name = "chromium"] = process.argv.slice(2);
let tools;
try {
  tools = { ...(await import("./browser.mjs")), ...(await import("./png.mjs")) };
} catch (error) {
  console.log(`skipped: playwright-core is not installed in viewer/ (npm ci): ${error.message}`);
  process.exit(77);
}
const { missing, launch, openReport, readPng, describe, difference, share } = tools;
if (missing(name)) {
  console.log(`skipped: ${missing(name)}`);
  process.exit(77);
}
mkdirSync(folder, { recursive: true });
const browser = await launch(name).catch((error) => {
  // An older Firefox opens the report, but cannot be driven: Debian 12 without its updates has 140.
  if (name !== "firefox" || !/unknown command/.test(error.message)) throw error;
  console.log("skipped: this Firefox is too old for playwright-core's WebDriver BiDi (153 is known to do)");
  process.exit(77);
});
console.log(`${name} ${browser.version()}`);

const settle = (page) => page.evaluate(() => window.abut.drawn().then(() => new Promise((done) => setTimeout(done, 60))));
/** The picture alone, without the legend above it. */
async function picture(page, name) {
  await settle(page);
  const clip = await page.locator(".stage").boundingBox();
  await page.evaluate(() => document.querySelector(".legend-place").setAttribute("hidden", ""));
  const file = await page.screenshot({ clip });
  await page.evaluate(() => document.querySelector(".legend-place").removeAttribute("hidden"));
  await page.screenshot({ path: path.join(folder, `${name}.png`) });
  return readPng(file);
}
const shown = (page, what) => page.evaluate((key) => window.abut.state.shown[key], what);
const magenta = (r, g, b) => r > 150 && g < 90 && b > 90 && b < 210;

const steps = [];
const test = (name, body) => steps.push({ name, body });
let { page, problems } = await openReport(report, { browser });
await page.waitForFunction(() => window.abut.state.shown.mesh); // edges are there: the page has settled
await page.evaluate(() => window.abut.state.set({ mesh: false }));
let first;

test("load: the picture is not blank, has the colours of a field, and lies inside the frame", async () => {
  first = await picture(page, "load");
  if (name === "chromium") assert.equal(page.workers().length, 1, "what is compressed is decoded in a worker");
  const { covered, box, colors } = describe(first);
  assert.ok(covered > 0.1, `the mesh covers ${covered} of the picture`);
  assert.ok(colors.size >= 12, `${colors.size} colours`);
  const border = 4;
  assert.ok(box.left >= border && box.top >= border, `left ${box.left}, top ${box.top}`);
  assert.ok(box.right < first.width - border && box.bottom < first.height - border, `right ${box.right}, bottom ${box.bottom}`);
  assert.ok(box.right - box.left > 0.5 * first.width || box.bottom - box.top > 0.7 * first.height, "the mesh fills the frame");
});

test("the model, the outcome and the energies are named", async () => {
  const text = await page.locator("body").innerText();
  for (const word of ["plate_drop", "finished", "energy error", "TYPE3", "clamped plate"]) {
    if (word === "clamped plate") await page.getByRole("tab", { name: "Parts" }).click();
    assert.ok((await page.locator("body").innerText()).includes(word), `${word} is not on the page: ${text.slice(0, 400)}`);
  }
  assert.ok((await page.locator(".u-legend .u-series").count()) > 8, "the plot of energies has its lines");
});

test("play: states follow each other and the picture changes", async () => {
  await page.getByLabel("Colour by").selectOption({ label: "Displacement" });
  await page.locator(".stage canvas").focus();
  await page.keyboard.press("Home");
  const before = await picture(page, "play-start");
  await page.locator("[data-action=play]").click();
  await page.waitForFunction(() => window.abut.state.shown.frame >= 5, null, { timeout: 20000 });
  await page.keyboard.press("Space");
  assert.equal(await shown(page, "playing"), false, "the space bar pauses");
  const frame = await shown(page, "frame");
  assert.ok(difference(before, await picture(page, "play-later")) > 0.003);
  await page.keyboard.press("ArrowRight");
  assert.equal(await shown(page, "frame"), frame + 1, "the arrow steps");
  await page.locator(".scrub").fill("2");
  await settle(page);
  assert.equal(await shown(page, "frame"), 2, "the slider scrubs");
  await page.getByLabel("Colour by").selectOption({ label: "Contact pressure" });
});

test("recolour: another field has other colours, and the legend says which", async () => {
  await page.evaluate(() => window.abut.state.set({ frame: window.abut.document.first }));
  const before = await picture(page, "field-pressure");
  await page.getByLabel("Colour by").selectOption({ label: "Von Mises stress" });
  const after = await picture(page, "field-von-mises");
  assert.ok(difference(before, after) > 0.05);
  assert.match(await page.locator(".legend").innerText(), /Von Mises stress\s*Pa/);
  await page.getByLabel("Colour by").selectOption({ label: "Displacement" });
  await page.getByLabel("Component").selectOption({ label: "Z" });
  assert.match(await page.locator(".legend").innerText(), /Displacement Z\s*m/);
  assert.ok(difference(after, await picture(page, "field-displacement")) > 0.05);
  const states = await page.getByLabel("Colour by").locator("option").allInnerTexts();
  for (const name of [
    ...["Contact pressure", "Gap to the other surface", "Penetration", "Stick or slip"],
    ...["Displacement", "Velocity", "Plastic strain", "Stress"],
  ]) {
    assert.ok(states.includes(name), `no field ${name} in ${states}`);
  }
  await page.getByLabel("Colour by").selectOption({ label: "Contact pressure" });
});

test("every field and the parts alone are drawn: each way of colouring has a shader of its own", async () => {
  const select = page.getByLabel("Colour by");
  for (const label of await select.locator("option").allInnerTexts()) {
    await select.selectOption({ label });
    await settle(page);
    const clip = await page.locator(".stage").boundingBox();
    const { covered } = describe(readPng(await page.screenshot({ clip })));
    assert.ok(covered > 0.1, `${label} covers ${covered} of the picture`);
    assert.deepEqual(problems, [], label);
  }
  await select.selectOption({ label: "Contact pressure" });
});

test("deform: a larger scale moves the mesh", async () => {
  const before = await picture(page, "deform-1");
  await page.getByLabel("Scale of the deformation").fill("10");
  await page.keyboard.press("Enter");
  assert.ok(difference(before, await picture(page, "deform-10")) > 0.03);
  await page.getByLabel("Scale of the deformation").fill("1");
  await page.keyboard.press("Enter");
});

test("pick: a click names the element and its node with values; the node is the one under the pointer", async () => {
  const id = 145;
  const at = await page.evaluate((n) => window.abut.picture.view.project(window.abut.picture.nodeOf(n)), id);
  await page.evaluate(() => window.abut.state.set({ hiddenParts: new Set([1]) })); // the falling plate hides that node
  await settle(page);
  await page.mouse.click(at.x + 1, at.y + 1);
  await page.waitForSelector("[data-picked-node]");
  assert.equal(await page.locator("[data-picked-node]").innerText(), String(id));
  const text = await page.locator(".picked").innerText();
  assert.match(text, /Displacement\s+[-−\d]/);
  assert.match(text, /Von Mises stress\s+[\d.e−]+ Pa/);
  const history = await page.evaluate(() => window.abut.document.history.names.includes("NODE/145/DZ"));
  assert.ok(history);
  await picture(page, "pick");
  await page.keyboard.press("Escape");
  await page.evaluate(() => window.abut.state.set({ hiddenParts: new Set() }));
});

test("a picked value is that of the time history", async () => {
  const { picked, column } = await page.evaluate(async () => {
    const { abut } = window;
    const node = abut.picture.nodeOf(145);
    const values = await abut.picture.values({ node, element: undefined });
    const { names, columns } = abut.document.history;
    const times = await abut.store.get(columns[0]);
    const dz = await abut.store.get(columns[names.indexOf("NODE/145/DZ")]);
    const time = abut.document.frames[abut.state.shown.frame].time;
    let row = 0;
    times.forEach((t, i) => (row = Math.abs(t - time) < Math.abs(times[row] - time) ? i : row));
    return { picked: values.find((v) => v.label === "Displacement Z").value, column: dz[row] };
  });
  assert.ok(Math.abs(picked - column) < 0.02 * Math.abs(column) + 1e-6, `${picked} and ${column}`);
});

test("parts: one is taken away and comes back", async () => {
  await page.getByRole("tab", { name: "Parts" }).click();
  const before = await picture(page, "parts-all");
  await page.locator("[data-part='1']").click();
  const without = await picture(page, "parts-one");
  assert.ok(describe(without).covered < 0.7 * describe(before).covered);
  await page.locator("[data-part='1']").click();
  assert.ok(difference(before, await picture(page, "parts-again")) < 0.001);
});

test("normals of the contact surfaces, in a colour per side", async () => {
  const blue = (r, g, b) => b > 190 && r < 90;
  const before = share(await picture(page, "normals-off"), blue);
  await page.keyboard.press("n");
  await page.waitForTimeout(300);
  const image = await picture(page, "normals-on");
  assert.ok(share(image, blue) > before + 0.001, "arrows of the first surface");
  await page.keyboard.press("n");
});

test("a plot's click goes to its time", async () => {
  const over = await page.locator(".plot .u-over").boundingBox();
  await page.mouse.click(over.x + 0.25 * over.width, over.y + 0.5 * over.height);
  await settle(page);
  const frame = await shown(page, "frame");
  assert.ok(frame >= 4 && frame <= 9, `frame ${frame}`);
});

test("every tab of plots draws", async () => {
  for (const name of ["Energy error", "Interfaces", "Time step", "Signals", "Energies"]) {
    await page.getByRole("tab", { name }).click();
    await page.waitForTimeout(120);
    const clip = await page.locator(".plot:visible").boundingBox();
    const image = readPng(await page.screenshot({ clip }));
    await page.screenshot({ path: path.join(folder, `plot-${name.replaceAll(" ", "-").toLowerCase()}.png`) });
    const saturated = share(image, (r, g, b) => Math.max(r, g, b) - Math.min(r, g, b) > 60);
    assert.ok(saturated > 0.0008, `${name} has lines: ${saturated}`);
  }
});

test("dark and light: both readable (contrast 4.5 of text, 3 of lines), the picture follows", async () => {
  const contrast = () =>
    page.evaluate(() => {
      const style = getComputedStyle(document.documentElement);
      const luminance = (name) => {
        const hex = style.getPropertyValue(name).trim().slice(1);
        const [r, g, b] = [0, 2, 4]
          .map((i) => parseInt(hex.slice(i, i + 2), 16) / 255)
          .map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
      };
      const ratio = (p, q) => {
        const [a, b] = [luminance(p), luminance(q)].sort((x, y) => y - x);
        return (a + 0.05) / (b + 0.05);
      };
      const text = [
        ["--text", "--surface"],
        ["--text-2", "--surface"],
        ["--text-2", "--surface-2"],
        ["--accent", "--surface"],
        ["--on-accent", "--accent"],
        ["--good", "--good-soft"],
        ["--warn", "--warn-soft"],
        ["--bad", "--bad-soft"],
      ];
      const lines = [1, 2, 3, 4, 5, 6, 7, 8].map((i) => [`--line-${i}`, "--surface"]);
      return { text: text.map(([p, q]) => [p, q, ratio(p, q)]), lines: lines.map(([p, q]) => [p, q, ratio(p, q)]) };
    });
  for (const theme of ["light", "dark"]) {
    if (theme === "dark") await page.keyboard.press("d");
    const { background } = describe(await picture(page, `theme-${theme}`));
    assert.equal(background[0] < 100, theme === "dark");
    const { text, lines } = await contrast();
    for (const [p, q, ratio] of text) assert.ok(ratio >= 4.5, `${theme}: ${p} on ${q} has ${ratio.toFixed(2)}`);
    for (const [p, q, ratio] of lines) assert.ok(ratio >= 3, `${theme}: ${p} on ${q} has ${ratio.toFixed(2)}`);
  }
  await page.keyboard.press("d");
});

test("keyboard: everything is reached by Tab, tabs by arrows, help opens and closes", async () => {
  await page.getByRole("tab", { name: "Parts" }).focus();
  await page.keyboard.press("ArrowLeft");
  assert.equal(await page.getByRole("tab", { name: "Findings" }).getAttribute("aria-selected"), "true");
  const reached = new Set();
  for (let i = 0; i < 80; i++) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.getAttribute("aria-label") ?? document.activeElement.textContent));
  }
  for (const label of ["Colour by", "State of the animation", "Scale of the deformation", "Play (Space)"])
    assert.ok(reached.has(label), `${label} is not reached by Tab`);
  assert.equal(
    await page.evaluate(
      () =>
        [...document.querySelectorAll("button, input, select, .stage canvas")].filter(
          (e) => !(e.getAttribute("aria-label") || e.textContent.trim() || e.closest("label")),
        ).length,
    ),
    0,
    "every control has a name",
  );
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press("?");
  assert.ok(await page.locator("dialog.help").isVisible());
  await page.keyboard.press("Escape");
  assert.ok(!(await page.locator("dialog.help").isVisible()));
});

test("nothing asked for the network, nothing failed", () => assert.deepEqual(problems, []));

test("follow a finding: its segments are marked on the mesh and in the frame", async () => {
  await page.context().close();
  ({ page, problems } = await openReport(findings, { browser }));
  await page.waitForFunction(() => window.abut.picture.view.drawCount > 0);
  await page.getByRole("tab", { name: "Findings" }).click();
  const before = share(await picture(page, "finding-before"), magenta);
  assert.equal(before, 0);
  await page.locator(".finding.error").first().click();
  await page.waitForTimeout(200);
  const image = await picture(page, "finding-shown");
  assert.ok(share(image, magenta) > 0.02, "marked segments are seen");
  const inner = { width: image.width, height: image.height, pixel: image.pixel };
  let edge = 0;
  for (let x = 0; x < inner.width; x++)
    edge += (magenta(...inner.pixel(x, 1)) ? 1 : 0) + (magenta(...inner.pixel(x, inner.height - 2)) ? 1 : 0);
  assert.equal(edge, 0, "they lie inside the frame");
  await page.locator(".finding.error").first().click();
  assert.equal(share(await picture(page, "finding-gone"), magenta), 0);
  assert.deepEqual(problems, []);
});

const known = JSON.parse(readFileSync(knownValues, "utf8"));
/** Clicks on a node that is seen. @returns what the panel says of it: {label: text} */
async function pickNode(id) {
  await settle(page);
  const at = await page.evaluate((n) => window.abut.picture.view.project(window.abut.picture.nodeOf(n)), id);
  await page.mouse.click(at.x + 1, at.y + 1);
  await page.waitForFunction((n) => document.querySelector("[data-picked-node]")?.textContent === String(n), id);
  const rows = await page.locator(".picked table").first().locator("tr").allInnerTexts();
  await page.keyboard.press("Escape");
  return Object.fromEntries(rows.map((row) => row.split("\t").map((cell) => cell.trim())));
}
test("known values: gap, penetration, pressure, shear, stick and slip on flat plates are those of the closed form", async () => {
  await page.context().close();
  ({ page, problems } = await openReport(knownReport, { browser }));
  await page.waitForFunction(() => window.abut.picture.view.drawCount > 0);
  for (const { frame, what, state, values, moves = {} } of known.frames) {
    for (const [side, id, hidden] of [
      ["upper", known.upper, 0],
      ["lower", known.lower, 1],
    ]) {
      await page.evaluate(([f, part]) => window.abut.state.set({ frame: f, hiddenParts: new Set([part]) }), [frame, hidden]);
      const shows = await pickNode(id);
      for (const [label, value] of Object.entries({ ...values, ...(side === "upper" ? moves : {}) }))
        checkValue(shows[label] ?? "nothing", label, value, `${what}, ${side} plate`);
      assert.equal(shows["Stick or slip"], state, `${what}, ${side} plate`);
    }
  }
  await page.evaluate(() => window.abut.state.set({ frame: 0, hiddenParts: new Set() }));
});

test("normals: blue from the first surface upwards, orange from the second downwards, 0.55 of a segment long", async () => {
  const blue = (r, g, b) => r < 90 && g > 90 && b > 190;
  const orange = (r, g, b) => r > 200 && g > 60 && g < 140 && b < 70;
  await page.locator(".stage canvas").focus();
  await page.keyboard.press("1"); // along x: both plates are lines
  await page.evaluate(() => document.activeElement.blur()); // the frame of the focus is blue
  const before = await picture(page, "sides-off");
  assert.equal(rows(before, blue).count + rows(before, orange).count, 0);
  await page.keyboard.press("n");
  await page.waitForTimeout(300);
  const image = await picture(page, "sides-on");
  const [first, second] = [rows(image, blue), rows(image, orange)];
  const { lower, upper, segment } = await page.evaluate(
    ([a, b]) => {
      const { picture } = window.abut;
      const at = (id) => picture.view.project(picture.nodeOf(id));
      const stage = document.querySelector(".stage").getBoundingClientRect();
      return { lower: at(a).y - stage.top, upper: at(b).y - stage.top, segment: Math.abs(at(a + 1).x - at(a).x) };
    },
    [known.lower, known.upper],
  );
  const near = (found, wanted, what) => assert.ok(Math.abs(found - wanted) < 0.2 * segment, `${what}: ${found}, and should be ${wanted}`);
  near(first.top, lower - 0.55 * segment, "tips of the first surface");
  near(first.bottom, lower, "feet of the first surface");
  near(second.bottom, upper + 0.55 * segment, "tips of the second surface");
  near(second.top, upper, "feet of the second surface");
  assert.ok(first.count > 100 && second.count > 100, `${first.count} and ${second.count} pixels`);
  await page.keyboard.press("n");
  assert.deepEqual(problems, []);
});

test("a browser that refuses a worker, at once or later, shows the same", async () => {
  let whole;
  for (const before of [
    undefined,
    () => (window.Worker = undefined),
    () =>
      (window.Worker = class {
        postMessage() {
          setTimeout(() => this.onerror?.(new Event("error")), 0);
        }
      }),
  ]) {
    await page.context().close();
    ({ page, problems } = await openReport(knownReport, { browser, before }));
    await page.evaluate(() => window.abut.state.set({ frame: 0 }));
    await page.keyboard.press("1");
    const image = await picture(page, before ? "no-worker" : "worker");
    whole ??= image;
    assert.ok(difference(whole, image) < 0.001);
    assert.deepEqual(problems, []);
  }
});

let failed = 0;
for (const { name, body } of steps) {
  const start = performance.now();
  try {
    await body();
    console.log(`ok      ${name} (${Math.round(performance.now() - start)} ms)`);
  } catch (error) {
    failed++;
    console.log(`FAILED  ${name}\n        ${error.stack.split("\n").slice(0, 6).join("\n        ")}`);
  }
}
await browser.close();
console.log(`${steps.length - failed} of ${steps.length} passed; screenshots in ${folder}`);
process.exit(failed > 0 ? 1 : 0);
