// Checks of the page of a system (`funicular page`) in a real browser; see `run`.
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { parseArgs } from "node:util";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import * as inside from "./inside.mjs";

const { values: given, positionals } = parseArgs({
  allowPositionals: true,
  options: { browser: { type: "string" }, work: { type: "string" }, shots: { type: "string" } },
});
const here = pathToFileURL(positionals[0]).href;
let failures = 0;
const check = (name, good, detail = "") => {
  if (!good) failures += 1;
  console.log(`${good ? "ok    " : "FAILED"} ${name}${detail === "" ? "" : `: ${detail}`}`);
};

// A page with equilibria and what moves, at a desk and in dark on a phone, each kind of what is on it in its way.
for (const [name, options] of [
  ["desk", { viewport: { width: 1280, height: 900 }, colorScheme: "light" }],
  ["phone", { viewport: { width: 390, height: 844 }, colorScheme: "dark", hasTouch: true, isMobile: true }],
]) {
  const context = await chromium.launchPersistentContext(mkdtempSync(join(given.work, "profile-")), {
    executablePath: given.browser,
    args: ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"],
    ...options,
  });
  const page = context.pages()[0] ?? (await context.newPage());
  const noise = [];
  page.on("console", (m) => { if (["error", "warning"].includes(m.type())) noise.push(m.text()); });
  page.on("pageerror", (e) => noise.push(e.stack));
  page.on("request", (r) => { if (r.url() !== here && !/^(data|blob):/.test(r.url())) noise.push(`asks for ${r.url()}`); });
  await page.goto(here, { waitUntil: "load" });
  const drawn = () => page.evaluate(() => document.getElementById("scene").toDataURL());
  const shown = (id) => page.evaluate((id) => !document.getElementById(id).hidden, id);
  const now = () => page.textContent("#now");
  const none = async (what, fault) => {
    const found = await page.evaluate(fault);
    check(`${name}: ${what}`, found.length === 0, found.slice(0, 3).join("; "));
  };
  const shot = async (what) => {
    if (given.shots) await page.screenshot({ path: join(given.shots, `system-${name}-${what}.png`), fullPage: true });
  };
  const groups = await page.evaluate(() =>
    [...document.querySelectorAll("#show optgroup")].map((g) => [g.label, g.querySelector("option").value]));
  const choose = (label) => page.selectOption("#show", groups.find((g) => g[0] === label)[1]);
  const has = (label) => groups.some((g) => g[0] === label);
  check(`${name}: what is shown is in groups`, groups.length >= 2, groups.map((g) => g[0]).join(", "));
  await none("nothing is wider than the screen", inside.overflow);
  const { contrast } = await page.evaluate(inside.colours);
  check(`${name}: contrast of text`, contrast >= 4.5, contrast.toFixed(1));
  // By the keyboard alone.
  const front = await drawn();
  await page.focus("#scene");
  await page.keyboard.press("ArrowLeft");
  check(`${name}: an arrow key turns the view`, (await drawn()) !== front);
  const turned = await drawn(), box = await page.locator("#scene").boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 40, box.y + box.height / 2 + 30, { steps: 4 });
  await page.mouse.up();
  check(`${name}: a hand turns it`, (await drawn()) !== turned);
  const force = () => page.textContent("#members tr:first-child .number");
  const before = await force();
  check(`${name}: forces and rungs stand in tables`, Number(before) !== 0 && (await page.locator("#rungs tr").count()) === 5, before);
  if (has("Load cases")) {
    await choose("Load cases");
    check(`${name}: a load case has forces of its own`, (await force()) !== before);
  }
  for (const [label, over] of [["Load paths", /^loads = /], ["Study", / = /]]) {
    if (!has(label)) continue;
    await choose(label);
    check(`${name}: ${label}: a curve, its numbers and no table of members`,
      (await page.locator("#charts canvas").count()) > 0 && (await shown("numbers")) && !(await shown("facts")));
    const start = await now();
    await page.focus("#slider");
    await page.keyboard.press("ArrowRight");
    const next = await now();
    check(`${name}: ${label}: the slider moves along it`, next !== start && over.test(next), next);
    check(`${name}: ${label}: it says what it is`, /^A (load path|study)/.test(await page.textContent("#about")));
    const plot = page.locator("#charts canvas").first();
    await plot.scrollIntoViewIfNeeded();
    const at = await plot.boundingBox();
    await page.mouse.move(at.x + at.width - 20, at.y + 30);
    await page.mouse.down();
    await page.mouse.up();
    check(`${name}: ${label}: a point of the curve is pressed`, (await now()) !== next, await now());
    await shot(label);
  }
  if (has("Motion")) {
    await choose("Motion");
    const start = await now();
    check(`${name}: a motion waits until it is played`, start.startsWith("time / s = 0,"), start);
    await page.focus("#scene");
    await page.keyboard.press(" ");
    check(`${name}: while it plays not every frame is read out`, (await page.getAttribute("#now", "aria-live")) === "off");
    await page.waitForFunction((start) => document.getElementById("now").textContent !== start, start);
    await page.keyboard.press(" ");
    const rests = await now();
    check(`${name}: the space bar plays and pauses`, (await page.getAttribute("#now", "aria-live")) === "polite" && rests !== start, rests);
    await page.focus("#play");
    await page.keyboard.press("ArrowRight");
    check(`${name}: an arrow key goes to the next time`, (await now()) !== rests, await now());
    check(`${name}: the slider is read out`, /^time/.test(await page.getAttribute("#slider", "aria-valuetext")));
    await page.check("#forced");
    await shot("Motion");
  }
  await none("every picture has a name", inside.unnamedPictures);
  await none("every control has a name", inside.unnamedControls);
  await none("no id twice", inside.ids);
  await none("headings", inside.headings);
  await page.evaluate(() => document.querySelectorAll("details").forEach((one) => { one.open = true; }));
  await none("nothing is wider than the screen with all details open", inside.overflow);
  await choose("Equilibria");
  await page.evaluate(() => {
    const shows = document.getElementById("show"), modes = document.getElementById("mode");
    for (const option of shows.options) {
      if (modes.options.length > 1) break;
      shows.value = option.value;
      shows.onchange();
    }
  });
  await page.selectOption("#mode", { index: 1 });
  const still = await drawn();
  await page.click("#play");
  await page.waitForTimeout(400);
  check(`${name}: a mode moves`, (await drawn()) !== still, await now());
  await page.click("#play");
  await shot("mode");
  await page.emulateMedia({ media: "print" });
  check(`${name}: print: the picture, without buttons`, (await page.locator("#scene").isVisible()) && !(await page.locator("#play").isVisible()));
  await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
  const paper = await page.evaluate(inside.colours);
  check(`${name}: print: on white`, paper.ground === "rgb(253, 253, 251)" && paper.contrast >= 4.5, paper.ground);
  await shot("print");
  check(`${name}: no error, no request`, noise.length === 0, noise.join("; "));
  await context.close();
}

// Whoever wants no motion gets none without asking for it.
const context = await chromium.launchPersistentContext(mkdtempSync(join(given.work, "profile-")), {
  executablePath: given.browser,
  args: ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"],
  reducedMotion: "reduce",
});
const page = context.pages()[0] ?? (await context.newPage());
// As pages are written that move from the start.
const moving = join(given.work, "moving.html");
writeFileSync(moving, readFileSync(positionals[0], "utf8").replace('"play":false', '"play":true'));
await page.goto(pathToFileURL(moving).href, { waitUntil: "load" });
const first = await page.textContent("#now");
await page.waitForTimeout(300);
check("without motion it waits", (await page.textContent("#play")) === "Play" && (await page.textContent("#now")) === first, first);
await context.close();
process.exitCode = failures > 0 ? 1 : 0;
