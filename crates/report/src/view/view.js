(() => {
  "use strict";
  const root = document.getElementById("funicular-view");
  const data = JSON.parse(document.getElementById("funicular-view-data").textContent);
  const part = (name) => document.getElementById("funicular-view-" + name);
  const [chain, energy, turn, place, readout] = ["chain", "energy", "turn", "place", "readout"].map(part);
  const still = window.matchMedia("(prefers-reduced-motion: reduce)");
  const RAD = Math.PI / 180;
  const COUNT = data.curve.length;
  const HOME = data.states[0].at;
  // How far above the horizon the chain is seen from.
  const ABOVE = 14 * RAD;
  const TURN_STEP = 5, TURN_LEAP = 45, PLACE_LEAP = 25, TRAVEL_MS = 600;
  // A drag follows the curve: it looks for the pointer no farther than this many samples on.
  const REACH = 40;
  const state = { at: HOME, turned: 25, travel: 0 };

  const wrap = (k) => ((k % COUNT) + COUNT) % COUNT;
  const named = (k) => data.states.find((s) => s.at === k);
  const signed = (x, digits) => {
    const text = Math.abs(x).toFixed(digits);
    return (x < 0 && Number(text) !== 0 ? "\u2212" : "+") + text;
  };
  const degrees = (x) => (x < 0 ? "\u2212" : "") + Math.abs(x).toFixed(3) + "\u00b0";

  const around = () => `${state.turned}\u00b0`.replace("-", "\u2212");

  const make = (parent, tag, attributes, text) => {
    const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const key in attributes) node.setAttribute(key, attributes[key]);
    if (text !== undefined) node.textContent = text;
    parent.append(node);
    return node;
  };
  const line = (parent, kind, [x1, y1], [x2, y2]) => make(parent, "line", { class: kind, x1, y1, x2, y2 });
  const arrow = (parent, kind, from, to) => {
    const [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    const length = Math.hypot(dx, dy);
    if (length < 1) return;
    const [ux, uy] = [dx / length, dy / length];
    const head = Math.min(9, length);
    const neck = [to[0] - head * ux, to[1] - head * uy];
    line(parent, kind, from, neck);
    const wing = 0.42 * head;
    make(parent, "polygon", {
      class: kind,
      points: [to, [neck[0] - wing * uy, neck[1] + wing * ux], [neck[0] + wing * uy, neck[1] - wing * ux]].join(" "),
    });
  };

  // The chain. Its plane is turned by `turned`; screen x to the right, y down, no perspective.
  const UNIT = 132, TOP = [180, 110], PER_MG = 0.33, HIDDEN = 6, BESIDE = 11;
  const project = ([out, up]) => {
    const psi = state.turned * RAD;
    const [right, towards] = [out * Math.cos(psi), out * Math.sin(psi)];
    return [TOP[0] + UNIT * right, TOP[1] + UNIT * (-up * Math.cos(ABOVE) + towards * Math.sin(ABOVE))];
  };
  const jointsOf = (angles) => {
    const joints = [[0, 0]];
    for (const angle of angles) {
      const [out, up] = joints[joints.length - 1];
      joints.push([out + Math.sin(angle * RAD), up - Math.cos(angle * RAD)]);
    }
    return joints;
  };
  const drawChain = () => {
    chain.replaceChildren();
    const known = named(state.at);
    const joints = jointsOf(data.curve[state.at].slice(0, 3));
    const [o, , , d] = joints.map(project);
    line(chain, "grid", o, d);
    for (const [out, up] of joints.slice(1, 3)) {
      const [cx, cy] = project([0, up]);
      const rx = UNIT * Math.abs(out);
      make(chain, "ellipse", { class: "turn", cx, cy, rx, ry: rx * Math.sin(ABOVE) });
    }
    for (const [x, y] of [o, d]) {
      make(chain, "path", { class: "line", d: `M${x - 14} ${y}h28m-28 0l-5 6m12 -6l-5 6m12 -6l-5 6m12 -6l-5 6` });
    }
    for (let k = 0; k < 3; k++) {
      const axial = known && known.axial_mg ? known.axial_mg[k] : 0;
      const kind = axial > 0 ? "bar pull" : axial < 0 ? "bar push" : "bar";
      line(chain, kind, project(joints[k]), project(joints[k + 1]));
      const middle = joints[k].map((x, i) => (x + joints[k + 1][i]) / 2);
      // A bar that hangs straight down would hide its weight.
      const upright = Math.abs(project(joints[k])[0] - project(joints[k + 1])[0]) < HIDDEN;
      const [from, to] = [project(middle), project([middle[0], middle[1] - PER_MG])];
      for (const end of upright ? [from, to] : []) end[0] += BESIDE;
      arrow(chain, "arrow weight", from, to);
    }
    if (known && known.ground_mg) {
      for (const [joint, force] of [[joints[0], known.ground_mg[0]], [joints[3], known.ground_mg[1]]]) {
        arrow(chain, "arrow", project(joint), project(joint.map((x, i) => x + PER_MG * force[i])));
      }
    }
    joints.forEach((joint, k) => {
      const [x, y] = project(joint);
      make(chain, "circle", { class: "joint", cx: x, cy: y, r: 5 });
      const side = k % 3 === 0 ? -1.6 : Math.sign(x - TOP[0]) || 1;
      make(chain, "text", { x: x + 18 * side, y: y + 4, "text-anchor": "middle" }, "OABD"[k]);
    });
    make(chain, "text", { class: "small quiet", x: 8, y: 442 }, `turned ${around()} about OD`);
  };

  // The energy over theta.
  const BOX = { left: 50, right: 414, top: 14, bottom: 352 };
  const LARGEST = data.largest_theta_deg;
  const values = data.curve.map((p) => p[3]);
  const [LOW, HIGH] = [Math.min(...values) - 0.12, Math.max(...values) + 0.12];
  const px = (theta) => BOX.left + ((theta / LARGEST / 1.06 + 1) / 2) * (BOX.right - BOX.left);
  const py = (v) => BOX.bottom - ((v - LOW) / (HIGH - LOW)) * (BOX.bottom - BOX.top);
  const spots = data.curve.map((p) => [px(p[0]), py(p[3])]);
  // px per rad over px per mgl, to draw a slope as it looks.
  const STEEP = (py(0) - py(1)) / (px(1 / RAD) - px(0));
  for (let theta = -60; theta <= 60; theta += 30) {
    line(energy, "grid", [px(theta), BOX.top], [px(theta), BOX.bottom]);
    make(energy, "text", { class: "small", x: px(theta), y: BOX.bottom + 18, "text-anchor": "middle" }, `${theta}\u00b0`.replace("-", "\u2212"));
  }
  for (let fifth = Math.ceil(LOW * 5); fifth <= HIGH * 5; fifth++) {
    line(energy, "grid", [BOX.left, py(fifth / 5)], [BOX.right, py(fifth / 5)]);
    make(energy, "text", { class: "small", x: BOX.left - 6, y: py(fifth / 5) + 4, "text-anchor": "end" }, (fifth / 5).toFixed(1));
  }
  make(energy, "text", { x: (BOX.left + BOX.right) / 2, y: BOX.bottom + 40, "text-anchor": "middle" }, "theta");
  make(energy, "text", { x: 0, y: 0, "text-anchor": "middle", transform: `translate(13 ${(BOX.top + BOX.bottom) / 2}) rotate(-90)` }, "V / mgl");
  make(energy, "polygon", { class: "curve", points: spots.join(" ") });
  for (const [theta, v] of data.scan) line(energy, "scan", [px(theta), py(v) - 5], [px(theta), py(v) + 5]);
  for (const known of data.states) {
    const [x, y] = spots[known.at];
    // (ix) lies under the disc of E1; marks of its own would only cover those.
    if (known.kind === "step") continue;
    const beside = known.kind === "false";
    if (beside) make(energy, "path", { class: "false", d: `M${x - 6} ${y - 6}l12 12m0 -12l-12 12` });
    else make(energy, "circle", { class: "equilibrium", cx: x, cy: y, r: 6 });
    const [right, down] = beside ? [22, 5] : [0, known.kind === "minimum" ? 20 : -11];
    make(energy, "text", { x: x + right, y: y + down, "text-anchor": "middle" }, known.name);
  }
  const moving = make(energy, "g", {});
  const drawEnergy = () => {
    moving.replaceChildren();
    const [x, y] = spots[state.at];
    const slope = data.curve[state.at][4];
    const rise = slope === null ? 1e9 : slope * STEEP;
    const half = 46 / Math.hypot(1, rise);
    line(moving, "tangent", [x - half, y + half * rise], [x + half, y - half * rise]);
    make(moving, "circle", { class: "here", cx: x, cy: y, r: 5.5 });
  };

  const describe = () => {
    const [theta, alpha, beta, v, slope] = data.curve[state.at];
    const known = named(state.at);
    const what = known ? `${known.name}: ${known.says}` : "a closed chain that does not rest: nothing here balances it";
    return [
      `theta ${degrees(theta)}, alpha ${degrees(alpha)}, beta ${degrees(beta)}; V = ${v.toFixed(5)} mgl; ` +
        `slope ${slope === null ? "without bound" : signed(slope, 4) + " mgl/rad"}.`,
      what + ".",
    ];
  };
  const buttons = data.states.map((known) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = known.name;
    button.addEventListener("click", () => travel(known.at));
    part("states").append(button);
    return button;
  });
  const show = () => {
    drawChain();
    drawEnergy();
    const [numbers, what] = describe();
    readout.replaceChildren(numbers, document.createElement("br"), what, document.createElement("br"), `Turned ${around()} about OD.`);
    place.value = state.at;
    turn.value = state.turned;
    turn.setAttribute("aria-valuetext", `${state.turned} degrees`);
    chain.setAttribute("aria-valuenow", state.turned);
    chain.setAttribute("aria-valuetext", `turned ${state.turned} degrees; ${what}`);
    for (const slider of [place, energy]) slider.setAttribute("aria-valuetext", numbers + " " + what);
    energy.setAttribute("aria-valuenow", state.at);
    data.states.forEach((known, k) => buttons[k].setAttribute("aria-pressed", String(known.at === state.at)));
  };
  const go = (k) => {
    cancelAnimationFrame(state.travel);
    readout.setAttribute("aria-busy", "false");
    state.at = wrap(k);
    show();
  };
  // The chain moves to the next state through closed chains, the shorter way round.
  const travel = (goal) => {
    cancelAnimationFrame(state.travel);
    if (still.matches) return go(goal);
    const from = state.at;
    const way = wrap(goal - from + COUNT / 2) - COUNT / 2;
    const began = performance.now();
    const step = (now) => {
      const done = Math.min(1, Math.max(0, (now - began) / TRAVEL_MS));
      const eased = done * done * (3 - 2 * done);
      state.at = done < 1 ? wrap(Math.round(from + way * eased)) : goal;
      // Only the end of the way is read aloud.
      readout.setAttribute("aria-busy", String(done < 1));
      show();
      if (done < 1) state.travel = requestAnimationFrame(step);
    };
    state.travel = requestAnimationFrame(step);
  };
  const turnTo = (angle) => {
    state.turned = Math.round(((((angle + 180) % 360) + 360) % 360) - 180);
    show();
  };

  place.addEventListener("input", () => go(Number(place.value)));
  turn.addEventListener("input", () => turnTo(Number(turn.value)));
  const keys = (node, move, leap, home) => node.addEventListener("keydown", (event) => {
    const moves = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: leap, PageDown: -leap };
    if (event.key === "Home") home();
    else if (event.key in moves) move(moves[event.key]);
    else return;
    event.preventDefault();
  });
  keys(energy, (k) => go(state.at + k), PLACE_LEAP, () => go(HOME));
  keys(chain, (k) => turnTo(state.turned + TURN_STEP * k), TURN_LEAP / TURN_STEP, () => turnTo(0));

  // Where in the coordinates of the picture a pointer is.
  const pointer = (node, event) => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(node.getScreenCTM().inverse());
    return [at.x, at.y];
  };
  const drag = (node, start, move) => {
    let last = null;
    node.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      last = pointer(node, event);
      node.setPointerCapture(event.pointerId);
      start(last);
    });
    node.addEventListener("pointermove", (event) => {
      if (!last) return;
      const now = pointer(node, event);
      move(now, last);
      last = now;
    });
    for (const end of ["pointerup", "pointercancel"]) node.addEventListener(end, () => { last = null; });
  };
  const nearest = (candidates, [x, y]) => {
    let best = state.at, least = Infinity;
    for (const k of candidates) {
      const distance = Math.hypot(spots[k][0] - x, spots[k][1] - y);
      if (distance < least) [best, least] = [k, distance];
    }
    return best;
  };
  const about = (reach) => Array.from({ length: 2 * reach + 1 }, (_, k) => wrap(state.at + k - reach));
  drag(energy, (at) => go(nearest(data.curve.keys(), at)), (at) => go(nearest(about(REACH), at)));
  // What is in front follows the pointer: a half turn is as wide as the picture.
  drag(chain, () => {}, (now, before) => { if (now[0] !== before[0]) turnTo(state.turned - (now[0] - before[0]) / 2); });

  for (const slider of [place, energy]) {
    slider.setAttribute(slider === place ? "max" : "aria-valuemax", COUNT - 1);
  }
  root.classList.add("running");
  show();
})();
