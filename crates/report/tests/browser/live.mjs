// Checks of `funicular serve` in a real browser, and of what it refuses; see `run`.
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { connect } from "node:net";
import { join } from "node:path";
import { parseArgs } from "node:util";
import { chromium } from "playwright-core";

const { values: given, positionals } = parseArgs({
  allowPositionals: true,
  options: { browser: { type: "string" }, work: { type: "string" }, shots: { type: "string" } },
});
let failures = 0;
const check = (name, good, detail = "") => {
  if (!good) failures += 1;
  console.log(`${good ? "ok    " : "FAILED"} ${name}${detail === "" ? "" : `: ${detail}`}`);
};

const file = join(given.work, "lamp.toml");
writeFileSync(file, `name = "a lamp"  # of 10 kg
gravity_m_s2 = 10
[joints]
A = { at_m = [-3, 0, 0] }  # to the left
B = { at_m = [3, 0, 0] }
P = { mass_kg = 10 }
[[bars]]
kind = "cable"
from = "A"
to = "P"
length_m = 5
mass_kg = 0
[[bars]]
kind = "cable"
from = "B"
to = "P"
length_m = 5
mass_kg = 0
`);
async function serve(path, port) {
  const program = spawn(positionals[0], ["serve", path, "--port", String(port)], { stdio: ["ignore", "pipe", "inherit"] });
  const line = await new Promise((found) => program.stdout.once("data", (bytes) => found(String(bytes))));
  return [program, Number(/127\.0\.0\.1:(\d+)/.exec(line)[1])];
}
let [program, port] = await serve(file, 0);
const here = `http://127.0.0.1:${port}/`;

// What is not the page's own is refused.
const status = (path, headers, body = "", method = "POST") => new Promise((found) => {
  const asked = request({ host: "127.0.0.1", port, path, method, headers }, (answer) => { answer.resume(); found(answer.statusCode); });
  asked.on("error", (error) => found(error.code));
  asked.end(body);
});
const json = { "content-type": "application/json" }, host = `127.0.0.1:${port}`;
const question = JSON.stringify({ text: "" });
for (const [name, wanted, ...what] of [
  ["the page", 200, "/", {}, "", "GET"],
  ["its questions", 200, "/ask", { ...json, origin: `http://${host}` }, question],
  ["another origin", 403, "/ask", { ...json, origin: "http://example.com" }, question],
  ["another host", 403, "/", { host: "example.com" }, "", "GET"],
  ["a form", 415, "/ask", { "content-type": "text/plain" }, question],
  ["another file", 404, "/etc/passwd", {}, "", "GET"],
  ["another method", 405, "/ask", json, "", "GET"],
  ["no question", 400, "/ask", json, "{"],
  ["an unknown key", 400, "/ask", json, JSON.stringify({ text: "", path: "/etc/passwd" })],
  ["too long a body", 413, "/ask", { ...json, "content-length": 2000000 }, ""],
  ["a body in pieces", 411, "/ask", { ...json, "transfer-encoding": "chunked" }, question],
]) {
  const found = await status(...what);
  check(`${name}: ${wanted}`, found === wanted, String(found));
}
const raw = (text) => new Promise((found) => {
  const socket = connect(port, "127.0.0.1", () => socket.write(text));
  let said = "";
  socket.on("data", (bytes) => { said += bytes; });
  socket.on("close", () => found(said));
  socket.on("error", () => found("closed"));
});
check("no HTTP is answered", (await raw("\0\0\r\n\r\n")).startsWith("HTTP/1.1 400"));
check("a head without end is answered", (await raw(`GET / HTTP/1.1\r\nx: ${"a".repeat(20000)}`)).startsWith("HTTP/1.1 431"));
const files = await fetch(`${here}ask`, { method: "POST", headers: json, body: JSON.stringify({ text: 'bars_file = "/etc/passwd"\nanchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }' }) });
const refused = await files.json();
check("no other file is read", refused.data === null && refused.error.includes("bars_file"), refused.error);
const big = await fetch(`${here}ask`, { method: "POST", headers: json, body: JSON.stringify({
  text: "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\nbars = [{ length_m = 1, mass_kg = 1, count = 3000000 }]" }) });
const large = await big.json();
check("a system that is too large is refused", large.data === null && /count|2000/.test(large.error), large.error);

const context = await chromium.launchPersistentContext(mkdtempSync(join(given.work, "profile-")), {
  executablePath: given.browser,
  args: ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"],
  viewport: { width: 1280, height: 900 }, acceptDownloads: true,
});
const page = context.pages()[0] ?? (await context.newPage());
const noise = [];
page.on("pageerror", (e) => noise.push(e.message));
page.on("console", (m) => { if (m.type() === "error" && !m.text().includes("ERR_CONNECTION")) noise.push(m.text()); });
page.on("request", (r) => { if (!r.url().startsWith(here) && !/^(data|blob):/.test(r.url())) noise.push(`asks for ${r.url()}`); });
await page.goto(here, { waitUntil: "load" });
const text = () => page.inputValue("#file");
const note = () => page.textContent("#note");
const force = async () => Number(await page.textContent("#members tr:first-child .number"));
const soon = async (name, wanted) => {
  for (let k = 0; k < 100; k++) {
    if (await wanted()) return check(name, true);
    await page.waitForTimeout(50);
  }
  check(name, false, `${await force()} N, ${await note()}, ${await text()}`);
};
const near = (x, y) => Math.abs(x - y) < 1e-3 * y;
check("the file and its forces stand on the page", (await text()).includes("# to the left") && near(await force(), 62.5));
check("the answer is proved", (await page.textContent("#rungs")).includes("optimal"));

// The picture moves the file: anchor A two metres to the right, where the cables pull with 50 N / (8^0.5 / 3) = 53.03 N.
const spot = (name) => page.evaluate((name) => {
  const joint = data.names.indexOf(name), box = scene.getBoundingClientRect();
  const at = onScreen(shape.x.slice(3 * joint, 3 * joint + 3), share, box.width, box.height);
  return [at[0] + box.left, at[1] + box.top, share * Math.min(box.width, box.height) / reach];
}, name);
await page.click("[data-view='0,0']");
const drag = async (name, right, up, before = async () => {}) => {
  const [x, y, metre] = await spot(name);
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 1; k <= 10; k++) await page.mouse.move(x + right * metre * k / 10, y - up * metre * k / 10);
  await before();
  await page.mouse.up();
};
await drag("A", 2, 0);
const moved = async () => /A = \{ at_m = \[(-?[\d.]+), /.exec(await text());
await soon("a dragged anchor moves in the file, and its comment stays", async () => {
  const found = await moved();
  return found && Math.abs(Number(found[1]) + 1) < 0.1 && (await text()).includes("# to the left");
});
await soon("the forces follow", async () => {
  const half = (3 - Number((await moved())[1])) / 2;
  return near(await force(), 50 / Math.sqrt(1 - (half / 5) ** 2));
});
await page.click("#undo");
await soon("undo puts it back", async () => (await text()).includes("[-3, 0, 0]") && near(await force(), 62.5));
await page.click("#redo");
await soon("redo moves it again", async () => !(await text()).includes("[-3, 0, 0]") && !near(await force(), 62.5));
await page.click("#undo");
await soon("undone again", async () => near(await force(), 62.5));
const place = () => page.evaluate(() => shape.x.slice(6, 9).map((x, i) => x + data.reference[i]));
let held = null;
const before = await text();
const isThere = ([x, , z]) => Math.abs(x - 1) < 0.1 && Math.abs(z + 2.5) < 0.1;
await drag("P", 1, 1.5, async () => {
  for (let k = 0; k < 200; k++) {
    held = await place();
    if (isThere(held)) break;
    await page.waitForTimeout(50);
  }
});
check("a free joint is held by hand", isThere(held), held.join(" "));
await soon("let go, it hangs again, and the file is as it was", async () => Math.abs((await place())[2] + 4) < 1e-5 && (await text()) === before);

// The file moves the picture.
await page.fill("#file", before.replace("mass_kg = 10", "mass_kg = 20"));
await soon("typing doubles the mass and the force", async () => near(await force(), 125));
await page.fill("#file", "nonsense =");
await soon("what is wrong is said, and the picture stays", async () => (await note()).length > 10 && near(await force(), 125));
await page.keyboard.press("Control+z");
await soon("Ctrl+Z takes it back", async () => (await note()) === "" && (await text()).includes("mass_kg = 20"));

// Forms: a rope over the lamp, and a joint with a cable.
const put = async (form, values) => {
  for (const [name, value] of Object.entries(values)) await page.fill(`#${form} [name=${name}]`, value);
};
await put("member", { from: "A", to: "B", via: "P", length_m: "9" });
await page.click("#member button");
await soon("a shorter rope over the lamp takes the load", async () =>
  near(Number(await page.textContent("#members tr:nth-last-child(1) .number")), 100 / Math.sqrt(1 - (3 / 4.5) ** 2)));
await put("joint", { name: "C", at_m: "0 0 3" });
await page.click("#joint button");
await soon("a joint without a member is refused by its name", async () => (await note()).includes('"C"'));
await put("member", { from: "C", to: "P", via: "", length_m: "6" });
await page.click("#member button");
await soon("its cable holds the lamp", async () => near(Number(await page.textContent("#members tr:nth-last-child(1) .number")), 200));
if (given.shots) await page.screenshot({ path: join(given.shots, "live-desk.png") });
const download = async (button) => {
  const [file] = await Promise.all([page.waitForEvent("download"), page.click(button)]);
  return readFileSync(await file.path(), "utf8");
};
check("the file is saved", (await download("#save")) === (await text()));
const kept = await download("#keep");
check("the page is saved, and asks for nothing", kept.startsWith("<!DOCTYPE html>") && !kept.includes("fetch("));

// A second tab, and a phone.
const other = await context.newPage();
await other.setViewportSize({ width: 360, height: 740 });
await other.goto(here, { waitUntil: "load" });
const wide = await other.evaluate(() => document.documentElement.scrollWidth - innerWidth);
check("a second tab begins with the file; nothing is wider than a phone", (await other.inputValue("#file")) === before && wide <= 0, `${wide} px`);
if (given.shots) await other.screenshot({ path: join(given.shots, "live-phone.png"), fullPage: true });
await other.close();

// How many shapes a second while the hand moves a net of 98 cables.
const net = [];
for (let i = 0; i < 8; i++) for (let j = 0; j < 8; j++) {
  const edge = [0, 7].includes(i) && [0, 7].includes(j);
  net.push(`n${i}${j} = ${edge ? `{ at_m = [${i}, ${j}, ${(i + j) / 10}] }` : "{ mass_kg = 1 }"}`);
}
const cables = [];
for (let i = 0; i < 8; i++) for (let j = 0; j < 8; j++) for (const [a, b] of [[i + 1, j], [i, j + 1]]) {
  if (a < 8 && b < 8 && cables.length < 112) cables.push(`[[bars]]\nkind = "cable"\nfrom = "n${i}${j}"\nto = "n${a}${b}"\nlength_m = 1.1\nmass_kg = 0\n`);
}
await page.fill("#file", `[joints]\n${net.join("\n")}\n${cables.join("")}`);
await soon("a net of 112 cables", async () => (await page.evaluate(() => data.bars.length)) === 112 && (await note()) === "");
const [speed, drawing] = await page.evaluate(async () => {
  const near_m = data.held.map((_, k) => absolute(place(k))), all = [], drawn = [];
  const median = times => times.sort((a, b) => a - b)[times.length >> 1];
  for (let k = 0; k < 60; k++) {
    const started = performance.now();
    const { data: { shapes: [moved] } } =
      await ask({ text: file.value, quick: true, near_m, change: { joint: { name: "n77", at_m: [7, 7 + 0.001 * k, 1.4] } } });
    all.push(performance.now() - started);
    [shape.x, shape.axial] = [moved.x, moved.axial];
    draw();
    drawn.push(performance.now() - started - all.at(-1));
  }
  return [median(all), median(drawn)];
});
console.log(`      ${speed.toFixed(1)} ms for a shape of it, ${drawing.toFixed(1)} ms to draw it`);

// The program ends and comes back.
program.kill();
await page.waitForTimeout(100);
await page.fill("#file", before);
await soon("without the program it is said so, and the text stays", async () => (await note()).includes("No answer") && (await text()) === before);
[program] = await serve(file, port);
await page.fill("#file", before + " ");
await soon("when it is back, it answers", async () => (await note()) === "" && near(await force(), 62.5));
check("no error, no request elsewhere", noise.length === 0, noise.join("; "));
check("the file on the disk is as it was", readFileSync(file, "utf8") === before);
await context.close();
program.kill();
process.exitCode = failures > 0 ? 1 : 0;
