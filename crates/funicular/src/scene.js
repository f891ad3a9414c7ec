"use strict";
// A scene that is turned by dragging, played and paused, with what `draw()` and `advance(seconds)` of the page show.
const get = id => document.getElementById(id);
let data = JSON.parse(get("data").textContent);
const scene = get("scene"), play = get("play");
let turn = 0, tilt = 0.12, playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
let before = null, largest = 0, net = data, middle = [0, 0, 0], reach = 1;

// Of the style sheet, in light and dark.
const colour = name => getComputedStyle(document.documentElement).getPropertyValue("--" + name);

// Put the middle and the reach of the scene around all joints of all frames.
function enclose(frames) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const frame of frames) {
    frame.forEach((x, i) => {
      low[i % 3] = Math.min(low[i % 3], x);
      high[i % 3] = Math.max(high[i % 3], x);
    });
  }
  middle = [0, 1, 2].map(k => (low[k] + high[k]) / 2);
  reach = Math.max(1e-300, Math.hypot(...[0, 1, 2].map(k => high[k] - low[k])) / 2);
}

function fit(canvas) {
  const ratio = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
  canvas.width = Math.round(box.width * ratio);
  canvas.height = Math.round(box.height * ratio);
  const g = canvas.getContext("2d");
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  return [g, box.width, box.height];
}

// A place on the screen: turned about the vertical, then tilted. The reach takes `share` of the canvas.
function onScreen(at, share, w, h) {
  const [x, y, z] = [0, 1, 2].map(k => at[k] - middle[k]);
  const across = x * Math.cos(turn) + y * Math.sin(turn);
  const depth = -x * Math.sin(turn) + y * Math.cos(turn);
  const up = z * Math.cos(tilt) + depth * Math.sin(tilt);
  const scale = share * Math.min(w, h) / reach;
  return [w / 2 + scale * across, h / 2 - scale * up];
}

// From joint to joint of a bar, or of a rope.
function along(g, place, [first, ...others]) {
  g.moveTo(...place(first));
  others.forEach(joint => g.lineTo(...place(joint)));
}

function lines(g, place) {
  g.lineCap = "round";
  g.beginPath();
  net.bars.forEach(bar => along(g, place, bar));
  g.stroke();
}

// Many joints would hide the bars: then only those that are held.
function joints(g, place, ink, held, edge) {
  net.held.forEach((fixed, joint) => {
    if (net.bars.length > 200 && !fixed) return;
    const [x, y] = place(joint);
    g.fillStyle = fixed ? held : ink;
    g.beginPath();
    if (fixed) g.rect(x - 5, y - 5, 10, 10); else g.arc(x, y, 4, 0, 7);
    g.fill();
    if (!edge) return;
    g.strokeStyle = edge;
    g.lineWidth = 1.4;
    g.stroke();
  });
}

// As in the pictures: solid, hollow or dashed, in four widths. What is a billionth of the largest force is none.
function members(g, place, axial, largest) {
  const many = net.bars.length > 200, [paper, pull, push] = ["paper", "pull", "push"].map(colour);
  g.lineCap = "butt";
  net.bars.forEach((joints, bar) => {
    const part = largest > 0 ? axial[bar] / largest : 0, size = Math.abs(part), none = !(size > 1e-9);
    const width = many ? 1 : 1.8 + Math.min(3, Math.floor(4 * size));
    const stroke = (style, wide) => {
      g.strokeStyle = style;
      g.lineWidth = wide;
      g.beginPath();
      along(g, place, joints);
      g.stroke();
    };
    g.setLineDash(none ? [6, 3] : []);
    if (none || part > 0 || many) return stroke(none ? "#777" : part > 0 ? pull : push, width);
    stroke(push, width + 2.6);
    stroke(paper, 0.45 * (width + 2.6));
  });
  g.setLineDash([]);
}

// Of rows too many to be arguments of one call.
function largestOf(rows) {
  return rows.reduce((top, row) => row.reduce((a, f) => Math.max(a, Math.abs(f)), top), 0);
}

// A line of a round length in the lower left corner, as long as it is in the scene.
function scale(g, share, w, h, ink) {
  const metre = share * Math.min(w, h) / reach, ten = 10 ** Math.floor(Math.log10(80 / metre));
  const length = [1, 2, 5, 10].map(k => k * ten).find(length => length * metre >= 80), x = 10 + length * metre;
  // A window without height.
  if (!length) return;
  g.strokeStyle = g.fillStyle = ink;
  g.lineWidth = 1.5;
  g.beginPath();
  for (const [a, b] of [[10, h - 14], [10, h - 6], [10, h - 10], [x, h - 10], [x, h - 14], [x, h - 6]]) g.lineTo(a, b);
  g.stroke();
  g.font = "12px system-ui, sans-serif";
  g.fillText(Number(length.toPrecision(1)) + " m", x + 8, h - 6);
}

function tick(stamp) {
  if (playing && !play.hidden && before !== null) {
    advance((stamp - before) / 1000);
    draw();
  }
  before = stamp;
  requestAnimationFrame(tick);
}

function setPlaying(on) {
  playing = on;
  play.textContent = on ? "Pause" : "Play";
  // Nobody wants every frame read out.
  get("now").setAttribute("aria-live", on ? "off" : "polite");
}

function begin() {
  play.onclick = () => setPlaying(!playing);
  document.addEventListener("keydown", event => {
    if (event.key === " " && !["BUTTON", "SELECT"].includes(event.target.tagName)) {
      event.preventDefault();
      setPlaying(!playing);
    }
  });
  const turned = (across, up) => {
    turn -= across;
    tilt = Math.max(-1.5, Math.min(1.5, tilt + up));
    draw();
  };
  let hand = null;
  scene.onpointerdown = event => {
    scene.setPointerCapture(event.pointerId);
    if (event.isPrimary) hand = [event.clientX, event.clientY];
  };
  scene.onpointermove = event => {
    if (!event.buttons || !event.isPrimary || !hand) return;
    turned(0.01 * (event.clientX - hand[0]), 0.01 * (event.clientY - hand[1]));
    hand = [event.clientX, event.clientY];
  };
  scene.addEventListener("keydown", event => {
    const [across, up] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key] || [];
    if (across === undefined) return;
    event.preventDefault();
    turned(0.1 * across, 0.1 * up);
  });
  // Quarters of a turn about the vertical, and of a tilt.
  document.querySelectorAll("[data-view]").forEach(button => button.onclick = () => {
    [turn, tilt] = button.dataset.view.split(",").map(quarters => quarters * Math.PI / 2);
    draw();
  });
  window.onresize = matchMedia("(prefers-color-scheme: dark)").onchange = () => draw();
  // On paper it is light.
  const paper = on => () => {
    document.documentElement.classList.toggle("paper", on);
    draw();
  };
  [window.onbeforeprint, window.onafterprint] = [paper(true), paper(false)];
  setPlaying(playing);
  draw();
  requestAnimationFrame(tick);
}
