// Checks of a report in a real browser; see `run`.
import { existsSync, mkdtempSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { parseArgs } from "node:util";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import * as inside from "./inside.mjs";

const { values: given, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    browser: { type: "string" },
    work: { type: "string" },
    shots: { type: "string" },
    fragment: { type: "boolean", default: false },
  },
});
const file = positionals[0];
const FLAGS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync",
];
const DESK = { width: 1280, height: 900 };
const PHONES = [{ width: 390, height: 844 }, { width: 360, height: 740 }];
// A4 less the margins of the style sheet, 14 mm and 16 mm on either side, px.
const PAPER = { width: 687, height: 1001 };
// WCAG 2.2, contrast (minimum) of text.
const CONTRAST = 4.5;
// The view takes 0.6 s from state to state.
const TRAVEL_MS = 3000;
// A busy machine is not a fault of the page.
const PATIENCE_MS = 120_000;
// px; browsers draw no picture of any height.
const TALLEST = 12_000;

let failures = 0;
const check = (name, good, detail = "") => {
  if (!good) failures += 1;
  console.log(`${good ? "ok    " : "FAILED"} ${name}${detail === "" ? "" : `: ${detail}`}`);
};
const none = (name, found) => check(name, found.length === 0, found.slice(0, 5).join("; "));

// A fresh browser with its own empty profile for every way to look at the page.
const noise = [];
async function look(name, options, body) {
  const context = await chromium.launchPersistentContext(mkdtempSync(join(given.work, "profile-")), {
    executablePath: given.browser,
    args: FLAGS,
    viewport: DESK,
    ...options,
  });
  try {
    const page = context.pages()[0] ?? (await context.newPage());
    page.on("console", (m) => { if (["error", "warning"].includes(m.type())) noise.push(`${name}: ${m.text()}`); });
    page.on("pageerror", (e) => noise.push(`${name}: ${e.message}`));
    page.on("request", (r) => {
      if (r.url() !== here && !/^(data|blob):/.test(r.url())) noise.push(`${name}: asks for ${r.url()}`);
    });
    page.setDefaultTimeout(PATIENCE_MS);
    await page.goto(here, { waitUntil: "load" });
    await body(page);
  } catch (error) {
    check(name, false, error.message);
  } finally {
    await context.close();
  }
}
const shot = async (page, name, node) => {
  if (!given.shots) return;
  const path = join(given.shots, `${name}.png`);
  if (node) return page.locator(node).screenshot({ path, timeout: PATIENCE_MS });
  const [width, height] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.scrollHeight]);
  await page.screenshot({ path, fullPage: true, timeout: PATIENCE_MS, clip: { x: 0, y: 0, width, height: Math.min(height, TALLEST) } });
};

const here = pathToFileURL(file).href;
const VIEW = "#funicular-view";
const grounds = {};

await look("light", { colorScheme: "light" }, async (page) => {
  none("headings: one h1 first, no level skipped", await page.evaluate(inside.headings));
  none("every picture has a name", await page.evaluate(inside.unnamedPictures));
  none("every control has a name", await page.evaluate(inside.unnamedControls));
  none("no id twice, every reference to an id leads somewhere", await page.evaluate(inside.ids));
  none("no table without headings", await page.evaluate(inside.tables));
  check("the page names its language and title", await page.evaluate(() => document.documentElement.lang !== "" && document.title !== ""));
  if (!given.fragment) {
    const maths = await page.evaluate(inside.maths);
    none(`formulas: ${maths.count} of MathML, all drawn`, maths.wrong);
    check("there are formulas", maths.count > 0);
    const json = join(dirname(file), "results.json");
    if (existsSync(json)) {
      const numbers = JSON.parse(readFileSync(json, "utf8")).equations.map((e) => e.number);
      none(`each of the ${new Set(numbers).size} numbers of audited equations stands in the page`, await page.evaluate(inside.missingNumbers, [...new Set(numbers)]));
    }
  }
  grounds.light = await page.evaluate(inside.colours);
  check("contrast of text, light", grounds.light.contrast >= CONTRAST, grounds.light.contrast.toFixed(1));
  await shot(page, "light");
  await shot(page, "view-light", VIEW);
});

await look("dark", { colorScheme: "dark" }, async (page) => {
  grounds.dark = await page.evaluate(inside.colours);
  check("contrast of text, dark", grounds.dark.contrast >= CONTRAST, grounds.dark.contrast.toFixed(1));
  check("light and dark differ", grounds.light.ground !== grounds.dark.ground, `${grounds.light.ground}, ${grounds.dark.ground}`);
  await shot(page, "dark");
  await page.getByRole("button", { name: "E2", exact: true }).click();
  await page.waitForFunction((t) => document.querySelector(t).textContent.includes("E2:"), "#funicular-view-readout", { timeout: TRAVEL_MS });
  await shot(page, "view-dark-E2", VIEW);
});

for (const viewport of PHONES) {
  await look(`phone ${viewport.width}`, { viewport, hasTouch: true, isMobile: true }, async (page) => {
    none(`nothing wider than ${viewport.width} px`, await page.evaluate(inside.overflow));
    none(`every verdict is in sight at ${viewport.width} px`, await page.evaluate(inside.verdictsOutOfSight));
    none(`what scrolls sideways shows it at ${viewport.width} px`, await page.evaluate(inside.unsignedScrollers));
    await shot(page, `phone-${viewport.width}`);
    await shot(page, `view-phone-${viewport.width}`, VIEW);
  });
}

await look("by hand", { reducedMotion: "reduce" }, async (page) => {
  const readout = page.locator("#funicular-view-readout");
  const read = () => readout.innerText();
  const slope = async () => Number((await read()).match(/slope ([+\u2212][\d.]+) mgl/)[1].replace("\u2212", "-"));
  const changed = async (name, action, wanted = /./) => {
    const before = await read();
    await action();
    const after = await read();
    check(name, before !== after && wanted.test(after), after.replaceAll("\n", " "));
  };
  check("the readout is announced", (await readout.getAttribute("aria-live")) === "polite");

  await changed("button (x)", () => page.getByRole("button", { name: "(x)", exact: true }).click(), /\(x\): .* no equilibrium/);
  check("V has a slope at (x)", Math.abs(await slope()) > 0.8, String(await slope()));
  for (const name of ["E1", "E1'", "E2", "E2'"]) {
    await changed(`button ${name}`, () => page.getByRole("button", { name, exact: true }).click(), new RegExp(`${name}: an equilibrium`));
    check(`V has no slope at ${name}`, Math.abs(await slope()) < 1e-4, String(await slope()));
    const arrows = await page.locator("#funicular-view-chain polygon.arrow:not(.weight)").count();
    check(`the ground bears the chain at ${name}`, arrows === 2, `${arrows} arrows`);
  }
  await page.getByRole("button", { name: "(x)", exact: true }).click();
  check("nothing bears the chain at (x)", (await page.locator("#funicular-view-chain polygon.arrow:not(.weight)").count()) === 0);

  const slide = (id, value) => () => page.locator(id).evaluate((node, to) => {
    node.value = to;
    node.dispatchEvent(new Event("input", { bubbles: true }));
  }, value);
  await changed("slider along the curve", slide("#funicular-view-place", "100"));
  await changed("slider about OD", slide("#funicular-view-turn", "90"), /Turned 90/);
  for (const [id, what] of [["place", "along the curve"], ["turn", "about OD"], ["energy", "in the picture of V"], ["chain", "in the picture of the chain"]]) {
    await page.locator(`#funicular-view-${id}`).focus();
    for (const key of ["ArrowRight", "ArrowLeft", "PageUp"]) await changed(`${key} ${what}`, () => page.keyboard.press(key));
  }
  await page.locator("#funicular-view-energy").focus();
  await changed("Home in the picture of V", () => page.keyboard.press("Home"), /E1:/);
  await changed("Home in the picture of the chain", async () => { await page.locator("#funicular-view-chain").focus(); await page.keyboard.press("Home"); }, /Turned 0/);

  const pull = (id, from, to) => async () => {
    await page.locator(id).scrollIntoViewIfNeeded();
    const box = await page.locator(id).boundingBox();
    const spot = ([x, y]) => [box.x + x * box.width, box.y + y * box.height];
    await page.mouse.move(...spot(from));
    await page.mouse.down();
    await page.mouse.move(...spot(to), { steps: 12 });
    await page.mouse.up();
  };
  await changed("drag in the picture of the chain", pull("#funicular-view-chain", [0.4, 0.5], [0.7, 0.5]), /Turned \u2212?\d+/);
  await changed("drag in the picture of V", pull("#funicular-view-energy", [0.6, 0.8], [0.75, 0.6]));
  const rested = await read();
  await page.mouse.move(10, 10);
  check("a pointer that is up drags nothing", rested === (await read()));

  await page.locator("#funicular-view-energy").focus();
  const ring = await page.locator("#funicular-view-energy").evaluate((node) => getComputedStyle(node).outlineStyle);
  check("the focus is visible", ring !== "none", ring);
  none("still no id twice", await page.evaluate(inside.ids));
  none("still every picture has a name", await page.evaluate(inside.unnamedPictures));
});

await look("without scripts", { javaScriptEnabled: false }, async (page) => {
  check("without scripts: the table instead", await page.locator(`${VIEW} .fallback table`).isVisible());
  check("without scripts: no dead controls", !(await page.locator(`${VIEW} .live`).isVisible()));
});

await look("print", {}, async (page) => {
  await page.emulateMedia({ media: "print" });
  check("print: the pictures", await page.locator("#funicular-view-energy").isVisible());
  check("print: no controls", !(await page.locator("#funicular-view-place").isVisible()));
  // What is wider than the paper makes the browser shrink all of it.
  await page.setViewportSize(PAPER);
  const [wide, room] = await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
  check("print: nothing wider than the paper", wide <= room, `${wide} px in ${room}`);
  const pdf = await page.pdf({ format: "A4", ...(given.shots ? { path: join(given.shots, "print.pdf") } : {}) });
  check("print: a PDF", pdf.subarray(0, 5).toString() === "%PDF-", `${pdf.length} bytes`);
  await shot(page, "view-print", VIEW);
});

none("no message in the console, no request", noise);
console.log(failures === 0 ? "all checks passed" : `${failures} checks failed`);
process.exitCode = failures === 0 ? 0 : 1;
