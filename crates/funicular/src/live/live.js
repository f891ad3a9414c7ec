
// What is changed in the file or in the picture is asked of the solvers, and both follow.
const file = get("file"), note = get("note"), past = [], ahead = [];
let last = file.value = data.text, asking = false, next = null, after = null, grabbed = null;

// To the program that gave this page out, or to the notebook around it.
async function fetched(path, question) {
  const answer = await fetch(path, {
    method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(question),
  });
  const text = await answer.text();
  if (!answer.ok) throw new Error(text);
  return text;
}

const answers = new Map();
function told(path, question) {
  return new Promise((done, failed) => {
    answers.set(answers.size, [done, failed]);
    parent.postMessage({ funicular: answers.size - 1, path, question }, "*");
  });
}
if (data.embedded) addEventListener("message", event => {
  const [done, failed] = event.source === parent && answers.get(event.data.funicular) || [];
  if (done) event.data.error ? failed(new Error(event.data.error)) : done(event.data.text);
});
const post = data.embedded ? told : fetched;
const ask = async question => JSON.parse(await post("ask", question));

// One question at a time, and of those that wait the newest.
async function put(...both) {
  next = both;
  if (asking) return;
  asking = true;
  while (next) {
    const [question, then] = next;
    next = null;
    try {
      then(await ask(question));
    } catch (error) {
      note.textContent = "No answer from the program (" + error.message + "). The file stays here; change it to ask again.";
    }
  }
  asking = false;
  const then = after;
  after = null;
  if (then) then();
}

function remember() {
  if (file.value !== last) {
    past.push(last);
    ahead.length = 0;
    last = file.value;
  }
  get("undo").disabled = !past.length;
  get("redo").disabled = !ahead.length;
}

// The whole answer: all equilibria that are known, load cases, modes, proofs.
function show(reply) {
  note.textContent = reply.error || "";
  if (!reply.data) return;
  const first = !items.length;
  data = reply.data;
  get("words").querySelector("pre").textContent = reply.words;
  get("words").hidden = !reply.words;
  get("joints").replaceChildren(...data.names.map(name => new Option(name)));
  fill();
  if (first) begin();
}

function settle() {
  remember();
  put({ text: file.value }, show);
}

function change(what) {
  put({ text: file.value, change: what }, reply => {
    file.value = reply.text;
    remember();
    show(reply);
  });
}

function step(from, to) {
  if (!from.length) return;
  to.push(last);
  last = file.value = from.pop();
  settle();
}

function give(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}

const place = joint => shape.x.slice(3 * joint, 3 * joint + 3);
const absolute = at => at.map((x, i) => x + data.reference[i]);
const spotOf = (joint, box) => onScreen(place(joint), share, box.width, box.height);

function nearest(event) {
  if (!shape || mode || !items.length) return null;
  const box = scene.getBoundingClientRect();
  const far = joint => {
    const [x, y] = spotOf(joint, box);
    return Math.hypot(event.clientX - box.left - x, event.clientY - box.top - y);
  };
  const joint = data.held.reduce((best, _, k) => far(k) < far(best) ? k : best, 0);
  return far(joint) < 14 ? joint : null;
}

// Where the pointer is in the plane of the screen through the joint, m, to a hundredth of the scene or less.
function under(event) {
  const box = scene.getBoundingClientRect(), [x, y] = spotOf(grabbed.joint, box), at = place(grabbed.joint);
  const metre = share * Math.min(box.width, box.height) / reach;
  const right = (event.clientX - box.left - x) / metre, up = (y - event.clientY + box.top) / metre;
  const s = Math.sin(turn), c = Math.cos(turn);
  const step = [right * c - up * s * Math.sin(tilt), right * s + up * c * Math.sin(tilt), up * Math.cos(tilt)];
  const unit = 10 ** Math.floor(Math.log10(reach / 100));
  const round = x => Number((Math.round(x / unit) * unit).toPrecision(12));
  return absolute(at.map((x, i) => x + step[i])).map((x, i) => Math.abs(step[i]) > 1e-12 ? round(x) : x);
}

// The shape that follows the hand, seen from where the others are.
function follow(reply) {
  note.textContent = reply.error || "";
  if (!reply.data || !grabbed || !reply.data.shapes.length) return;
  const [moved] = reply.data.shapes;
  shape.x = moved.x.map((x, i) => x + reply.data.reference[i % 3] - data.reference[i % 3]);
  shape.axial = moved.axial;
  largest = largestOf([shape.axial]);
  if (grabbed.held) file.value = reply.text;
  draw();
}

function drag(event) {
  const joint = data.names[grabbed.joint], at_m = under(event), near_m = data.held.map((_, k) => absolute(place(k)));
  const question = grabbed.held ? { change: { joint: { name: joint, at_m } } } : { held: { joint, at_m } };
  put({ text: last, quick: true, near_m, ...question }, follow);
}

scene.addEventListener("pointerdown", event => {
  const joint = nearest(event);
  if (joint === null) return;
  setPlaying(false);
  grabbed = { joint, held: data.held[joint] === 1 };
}, true);
scene.addEventListener("pointermove", event => {
  if (!grabbed) {
    scene.style.cursor = nearest(event) === null ? "" : "move";
    return;
  }
  event.stopImmediatePropagation();
  drag(event);
}, true);
for (const name of ["pointerup", "pointercancel"]) scene.addEventListener(name, () => {
  if (!grabbed) return;
  const done = () => {
    grabbed = null;
    settle();
  };
  // What the hand did last is answered first.
  if (asking) after = done; else done();
});

let pause = 0;
file.oninput = () => {
  clearTimeout(pause);
  pause = setTimeout(settle, 300);
};
document.addEventListener("keydown", event => {
  if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z" || event.target.tagName === "INPUT") return;
  event.preventDefault();
  if (event.shiftKey) step(ahead, past); else step(past, ahead);
});
get("undo").onclick = () => step(past, ahead);
get("redo").onclick = () => step(ahead, past);
get("save").onclick = () => give(new Blob([file.value], { type: "application/toml" }), "system.toml");
get("keep").onclick = async () => {
  try {
    give(new Blob([await post("page", { text: file.value })], { type: "text/html" }), "system.html");
  } catch (error) {
    note.textContent = error.message;
  }
};
const number = text => text.trim() === "" ? undefined : Number(text);
const words = text => text.trim().split(/[\s,]+/).filter(word => word);
get("joint").onsubmit = event => {
  event.preventDefault();
  const form = new FormData(event.target), at = words(form.get("at_m")).map(Number);
  if (at.length && (at.length !== 3 || at.some(Number.isNaN))) {
    note.textContent = "A place has three numbers: x y z.";
    return;
  }
  change({ joint: { name: form.get("name"), mass_kg: number(form.get("mass_kg")), at_m: at.length ? at : undefined } });
};
get("member").onsubmit = event => {
  event.preventDefault();
  const form = new FormData(event.target), via = words(form.get("via"));
  const [from, ...others] = [form.get("from"), ...via, form.get("to")].map(name => data.names.indexOf(name));
  let length_m = number(form.get("length_m"));
  // As long as its ends are apart in the picture.
  if (length_m === undefined && shape && [from, ...others].every(k => k >= 0)) {
    let before = from;
    length_m = 0;
    for (const k of others) {
      length_m += Math.hypot(...place(k).map((x, i) => x - place(before)[i]));
      before = k;
    }
    length_m = Number(length_m.toPrecision(6));
  }
  change({ member: { from: form.get("from"), to: form.get("to"), via, kind: form.get("kind"), length_m } });
};
remember();
note.textContent = data.error || "";
if (data.names) get("joints").replaceChildren(...data.names.map(name => new Option(name)));
