// What moves over a number: its curves, and the frame that is shown.
let track = null, now = 0, plots = [], beside = [];
const colours = @REGIONS@, TRAIL = 80, MOST = 60, ROWS = 200;

const short = (x, digits) => x === null || x === undefined ? "none" : Number(x.toPrecision(digits)).toString();
const element = (name, text, kind) => {
  const one = document.createElement(name);
  if (text !== undefined) one.textContent = text;
  if (kind) one.className = kind;
  return one;
};
const across = (one, curve) => curve.x || one.at, upward = (one, curve) => curve.y || one.at;

// A picture for each chart, those of all tracks of the group in it, and a table of the numbers.
function charts() {
  beside = track ? data.tracks.filter(one => one.group === track.group && one.charts.length === track.charts.length) : [];
  const specs = track ? track.charts : [];
  plots = specs.map((chart, c) => {
    const canvas = element("canvas"), all = of => beside.flatMap(one => one.charts[c].curves.flatMap(curve => of(one, curve)));
    const ends = of => all(of).filter(x => x !== null).reduce(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [Infinity, -Infinity]);
    canvas.setAttribute("role", "img");
    const plot = { canvas, c, chart, x: ends(across), y: ends(upward) };
    canvas.setAttribute("aria-label", chart.up + " over " + chart.across + ": " + range(chart.up, plot.y) + ", " + range(chart.across, plot.x) +
      "; the numbers are in the table below");
    canvas.onpointerdown = canvas.onpointermove = event => { if (event.buttons) pick(plot, event); };
    return plot;
  });
  get("charts").replaceChildren(...plots.map(plot => {
    const box = element("figure"), key = element("figcaption");
    plot.chart.curves.forEach((curve, n) => {
      if (!curve.label) return;
      const name = element("span", " " + curve.label), mark = element("b", "\u25cf");
      mark.style.color = colours[n % colours.length];
      name.prepend(mark);
      key.append(name);
    });
    box.append(plot.canvas, key);
    return box;
  }));
  get("parts").hidden = !specs.some(chart => chart.curves.some(curve => curve.stable));
  get("numbers").hidden = !specs.length;
  if (!specs.length) return;
  const columns = specs.flatMap(chart => chart.curves.flatMap(curve => [
    ...(curve.x ? [[chart.across, curve.x]] : []), ...(curve.y ? [[curve.label || chart.up, curve.y]] : [])]));
  const every = Math.ceil(track.at.length / ROWS), rows = track.at.map((_, k) => k).filter(k => k % every === 0 || track.events[k]);
  get("heads").replaceChildren(row([track.over, ...columns.map(([name]) => name), ""], "th"));
  get("values").replaceChildren(...rows.map(k => row([short(track.at[k], 6), ...columns.map(([, all]) => short(all[k], 6)), track.events[k] || ""])));
}

const range = (name, [low, high]) => name + ": " + short(low, 4) + " to " + short(high, 4);

// What differs by rounding alone is the same.
function spot(plot, w, h, x, y) {
  const part = (x, [a, b]) => b - a > 1e-9 * Math.max(Math.abs(a), Math.abs(b)) ? (x - a) / (b - a) : 0.5;
  return [16 + (w - 32) * part(x, plot.x), h - 30 - (h - 58) * part(y, plot.y)];
}

// The curve, in runs that are stable or not; what has no value is a gap.
function line(g, plot, w, h, one, curve, tint) {
  const x = across(one, curve), y = upward(one, curve), has = k => k < x.length && x[k] !== null && y[k] !== null;
  const at = k => spot(plot, w, h, x[k], y[k]), stable = k => !curve.stable || curve.stable[k];
  for (let k = 0; k < x.length;) {
    if (!has(k)) { k++; continue; }
    if (!has(k + 1)) { g.fillStyle = tint; g.beginPath(); g.arc(...at(k), 1.5, 0, 7); g.fill(); }
    const kind = stable(k + 1);
    g.strokeStyle = !curve.stable ? tint : colour(kind ? "pull" : "push");
    g.setLineDash(kind ? [] : [6, 4]);
    g.beginPath();
    g.moveTo(...at(k));
    for (k++; has(k) && stable(k) === kind; k++) g.lineTo(...at(k));
    g.stroke();
    if (has(k)) k--;
  }
  g.setLineDash([]);
}

// A chart with the frame that is shown.
function curves(plot, ink, k) {
  const [g, w, h] = fit(plot.canvas);
  g.clearRect(0, 0, w, h);
  g.lineWidth = 2;
  for (const one of beside) {
    g.globalAlpha = one === track ? 1 : 0.4;
    one.charts[plot.c].curves.forEach((curve, n) => line(g, plot, w, h, one, curve, colours[n % colours.length]));
  }
  g.globalAlpha = 1;
  g.font = "12px system-ui, sans-serif";
  g.fillStyle = ink;
  g.fillText(range(plot.chart.up, plot.y), 6, 14);
  g.textAlign = "right";
  g.fillText(range(plot.chart.across, plot.x), w - 6, h - 8);
  g.textAlign = "left";
  for (const curve of plot.chart.curves) {
    const x = across(track, curve)[k], y = upward(track, curve)[k];
    if (x === null || y === null) continue;
    g.beginPath();
    g.arc(...spot(plot, w, h, x, y), 5, 0, 7);
    g.fill();
  }
}

// The frame next to where a chart is pressed.
function pick(plot, event) {
  const box = plot.canvas.getBoundingClientRect(), at = [event.clientX - box.left, event.clientY - box.top];
  let best = Infinity, next = now;
  for (const curve of plot.chart.curves) track.at.forEach((_, k) => {
    const x = across(track, curve)[k], y = upward(track, curve)[k];
    if (x === null || y === null) return;
    const far = Math.hypot(...spot(plot, box.width, box.height, x, y).map((x, i) => x - at[i]));
    if (far < best) [best, next] = [far, k];
  });
  go(next);
}

function go(k) {
  setPlaying(false);
  now = Math.max(0, Math.min(track.at.length - 1, k));
  draw();
}

function saidOf(k) {
  const words = [track.over + " = " + short(track.at[k], 6)];
  for (const chart of track.charts) for (const curve of chart.curves) {
    if (curve.x) words.push(chart.across + " = " + short(curve.x[k], 6));
    if (curve.y && curve.y[k] !== null) words.push((curve.label || chart.up) + " = " + short(curve.y[k], 4));
    if (curve.stable && chart === track.charts[0]) words.push(curve.stable[k] ? "stable" : "unstable");
  }
  return words.join(", ") + (track.events[k] ? "; " + track.events[k] : "");
}

// Between two times joints are drawn on the straight line: for the eye alone.
function between() {
  const k = Math.floor(now), part = now - k, a = track.x[k], b = track.x[k + 1];
  if (!track.motion || !b || part === 0) return track.x[Math.round(now)];
  return a.map((x, i) => x + part * (b[i] - x));
}

// In its own time where it is a motion.
function forward(seconds, pace, travel) {
  const last = track.at.length - 1, whole = track.motion ? (track.at[last] - track.at[0]) / pace : travel;
  if (last > 0) now += seconds * last / whole;
  if (now > last) now = 0;
}

function trails(g, at) {
  const k = Math.floor(now), here = between();
  g.strokeStyle = "@SKY@";
  g.lineWidth = 1;
  net.held.slice(0, MOST).forEach((held, joint) => {
    if (held) return;
    g.beginPath();
    for (let i = Math.max(0, k - TRAIL); i <= k; i++) g.lineTo(...at(track.x[i], joint));
    g.lineTo(...at(here, joint));
    g.stroke();
  });
}

// Names of joints and forces of members, of the first of many.
function write(g, place, axial, ink) {
  g.font = "12px system-ui, sans-serif";
  g.fillStyle = ink;
  if (get("named").checked) net.names.slice(0, MOST).forEach((name, joint) => {
    const [x, y] = place(joint);
    g.fillText(name, x + 7, y - 7);
  });
  if (axial && get("forced").checked) net.bars.slice(0, MOST).forEach((bar, k) => {
    const [p, q] = [place(bar[0]), place(bar.at(-1))];
    g.fillText(short(axial[k], 3) + " N", (p[0] + q[0]) / 2 + 5, (p[1] + q[1]) / 2 - 5);
  });
}
