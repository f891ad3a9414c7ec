// Checks of the page of a system (`funicular page`) in a real browser; see `run`.
import { mkdtempSync } from "node:fs";
import { join } from "node:path";
import { parseArgs } from "node:util";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

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

// A page with the answer, at least one load case and a load path, at a desk and in dark on a phone.
for (const [name, viewport, colorScheme] of [
  ["desk", { width: 1280, height: 900 }, "light"],
  ["phone", { width: 360, height: 740 }, "dark"],
]) {
  const context = await chromium.launchPersistentContext(mkdtempSync(join(given.work, "profile-")), {
    executablePath: given.browser,
    args: ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"],
    viewport, colorScheme,
  });
  const page = context.pages()[0] ?? (await context.newPage());
  const noise = [];
  page.on("console", (m) => { if (["error", "warning"].includes(m.type())) noise.push(m.text()); });
  page.on("pageerror", (e) => noise.push(e.message));
  page.on("request", (r) => { if (r.url() !== here && !/^(data|blob):/.test(r.url())) noise.push(`asks for ${r.url()}`); });
  await page.goto(here, { waitUntil: "load" });
  const drawn = () => page.evaluate(() => document.getElementById("scene").toDataURL());
  const shown = (id) => page.evaluate((id) => !document.getElementById(id).hidden, id);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  check(`${name}: nothing is wider than the screen`, wide <= 0, `${wide} px`);
  // By the keyboard alone.
  const front = await drawn();
  await page.focus("#scene");
  await page.keyboard.press("ArrowLeft");
  check(`${name}: an arrow key turns the view`, (await drawn()) !== front);
  const force = () => page.textContent("#members tr:first-child .number");
  const before = await force();
  check(`${name}: forces and rungs stand in tables`, Number(before) !== 0 && (await page.locator("#rungs tr").count()) === 5, before);
  const groups = await page.evaluate(() =>
    [...document.querySelectorAll("#show optgroup")].map((g) => [g.label, g.querySelector("option").value]));
  const first = (label) => groups.find((g) => g[0] === label)[1];
  check(`${name}: what is shown is in groups`, groups.length === 3, groups.map((g) => g[0]).join(", "));
  await page.selectOption("#show", first("Load cases"));
  check(`${name}: a load case has forces of its own`, (await force()) !== before);
  await page.selectOption("#show", first("Load paths"));
  check(`${name}: a path has its curve and no table`, (await shown("curve")) && !(await shown("facts")));
  const start = await page.textContent("#now");
  await page.focus("#slider");
  await page.keyboard.press("ArrowRight");
  const next = await page.textContent("#now");
  check(`${name}: the slider moves along the path`, next !== start && next.startsWith("loads = "), next);
  await page.selectOption("#show", first("Equilibria"));
  await page.selectOption("#mode", { index: 1 });
  const still = await drawn();
  await page.click("#play");
  await page.waitForTimeout(400);
  check(`${name}: a mode moves`, (await drawn()) !== still, await page.textContent("#now"));
  if (given.shots) await page.screenshot({ path: join(given.shots, `system-${name}.png`), fullPage: true });
  check(`${name}: no error, no request`, noise.length === 0, noise.join("; "));
  await context.close();
}
process.exitCode = failures > 0 ? 1 : 0;
