// Checks of the gallery as pages (`funicular cases --html DIR`) in a real browser; see `run`.
import { existsSync, mkdtempSync } from "node:fs";
import { dirname, join } from "node:path";
import { parseArgs } from "node:util";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const { values: given, positionals } = parseArgs({
  allowPositionals: true,
  options: { browser: { type: "string" }, work: { type: "string" }, shots: { type: "string" } },
});
const folder = dirname(positionals[0]);
let failures = 0;
const check = (name, good, detail = "") => {
  if (!good) failures += 1;
  console.log(`${good ? "ok    " : "FAILED"} ${name}${detail === "" ? "" : `: ${detail}`}`);
};

for (const [name, viewport, colorScheme] of [
  ["desk", { width: 1280, height: 900 }, "light"],
  ["phone", { width: 390, height: 844 }, "dark"],
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
  page.on("requestfailed", (r) => noise.push(`fails to load ${r.url()}`));
  await page.goto(pathToFileURL(positionals[0]).href, { waitUntil: "load" });
  // Pictures are loaded as they come into sight.
  await page.evaluate(() => Promise.all([...document.images].map((one) => { one.loading = "eager"; return one.decode().catch(() => {}); })));
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  check(`${name}: nothing is wider than the screen`, wide <= 0, `${wide} px`);
  const cases = await page.locator("article").count();
  const bare = await page.evaluate(() => [...document.querySelectorAll("article")].filter((one) => {
    const picture = one.querySelector("img");
    return !picture?.complete || picture.naturalWidth === 0 || picture.alt === "" || !one.querySelector("p");
  }).map((one) => one.querySelector("h2").textContent));
  check(`${name}: every case has its picture and its answer in words`, cases > 30 && bare.length === 0, `${cases} cases ${bare}`);
  const links = await page.evaluate(() => [...document.querySelectorAll("article a")].map((a) => a.getAttribute("href")));
  const missing = links.filter((link) => !existsSync(join(folder, link)));
  check(`${name}: every link leads to a file of the folder`, links.length >= 2 * cases && missing.length === 0, `${links.length} links ${missing}`);
  const dark = await page.evaluate(() => matchMedia("(prefers-color-scheme: dark)").matches);
  const ground = await page.evaluate(() => {
    const canvas = Object.assign(document.createElement("canvas"), { width: 1, height: 1 }).getContext("2d");
    canvas.fillStyle = getComputedStyle(document.body).color;
    canvas.fillRect(0, 0, 1, 1);
    return canvas.getImageData(0, 0, 1, 1).data[0];
  });
  check(`${name}: the text is dark on white and light on dark`, dark ? ground > 200 : ground < 60, String(ground));
  if (given.shots) await page.screenshot({ path: join(given.shots, `gallery-${name}.png`) });
  // One page of a case, as it is opened from here.
  await page.click("article a[href$='.html']");
  await page.waitForSelector("#scene");
  check(`${name}: a page of a case opens`, (await page.locator("#rungs tr").count()) === 5);
  check(`${name}: nothing is refused and nothing fails`, noise.length === 0, noise.join("; "));
  await context.close();
}
process.exit(failures === 0 ? 0 : 1);
