// What is looked at inside the page. Each function is sent to the browser by itself, so it names nothing
// outside of it; each returns the faults it finds.

export function headings() {
  const levels = [...document.querySelectorAll("h1, h2, h3, h4, h5, h6")].map((h) => [Number(h.tagName[1]), h.textContent.trim()]);
  const wrong = [];
  if (levels.filter(([level]) => level === 1).length !== 1 || levels[0][0] !== 1) wrong.push("not one h1 at the top");
  levels.forEach(([level, text], k) => {
    if (text === "") wrong.push(`empty h${level}`);
    if (k > 0 && level > levels[k - 1][0] + 1) wrong.push(`h${level} "${text}" after h${levels[k - 1][0]}`);
  });
  return wrong;
}

export function unnamedPictures() {
  const named = (node) => {
    const by = (node.getAttribute("aria-labelledby") ?? "").split(/\s+/).filter(Boolean);
    if (by.length > 0) return by.every((id) => (document.getElementById(id)?.textContent ?? "").trim() !== "");
    if ((node.getAttribute("aria-label") ?? "").trim() !== "") return true;
    if (node.tagName === "IMG") return (node.getAttribute("alt") ?? "").trim() !== "";
    return (node.querySelector(":scope > title")?.textContent ?? "").trim() !== "";
  };
  return [...document.querySelectorAll("svg, img, canvas")]
    .filter((node) => !node.closest("[aria-hidden='true']") && !(named(node) && (node.tagName === "IMG" || node.hasAttribute("role"))))
    .map((node) => node.outerHTML.slice(0, 120));
}

export function unnamedControls() {
  return [...document.querySelectorAll("button, input, select, textarea, a, [role='slider']")]
    .filter((node) => !node.labels?.length && (node.textContent + (node.getAttribute("aria-label") ?? "")).trim() === "")
    .map((node) => node.outerHTML.slice(0, 120));
}

export function ids() {
  const wrong = [];
  const seen = new Set();
  for (const { id } of document.querySelectorAll("[id]")) {
    if (seen.has(id)) wrong.push(`#${id} twice`);
    seen.add(id);
  }
  for (const name of ["aria-labelledby", "aria-describedby", "for"]) {
    for (const node of document.querySelectorAll(`[${name}]`)) {
      for (const id of node.getAttribute(name).split(/\s+/)) if (!seen.has(id)) wrong.push(`${name}="${id}"`);
    }
  }
  for (const link of document.querySelectorAll("a[href^='#']")) {
    const id = decodeURIComponent(link.getAttribute("href").slice(1));
    if (!seen.has(id)) wrong.push(`href="#${id}"`);
  }
  return wrong;
}

// Verdicts that cannot be seen without scrolling sideways.
export function verdictsOutOfSight() {
  const room = document.documentElement.clientWidth;
  return [...document.querySelectorAll(".verdict")]
    .filter((node) => {
      const { left, right, width } = node.getBoundingClientRect();
      return width === 0 || left < 0 || right > room;
    })
    .map((node) => `${node.textContent.trim()} in ${node.closest("tr, article")?.textContent.trim().slice(0, 60)}`);
}

// Boxes that go on beyond their edge without a sign of it.
export function unsignedScrollers() {
  return [...document.querySelectorAll(".scroll, pre")]
    .filter((node) => node.scrollWidth > node.clientWidth + 1 && !getComputedStyle(node).backgroundAttachment.includes("local"))
    .map((node) => node.getAttribute("aria-label") ?? node.textContent.trim().slice(0, 60));
}

export function tables() {
  return [...document.querySelectorAll("table")]
    .filter((table) => table.querySelector("th") === null)
    .map((table) => table.outerHTML.slice(0, 120));
}

export function maths() {
  const all = [...document.querySelectorAll("math")];
  const wrong = [];
  for (const math of all) {
    const { width, height } = math.getBoundingClientRect();
    if (width === 0 || height === 0 || math.textContent.trim() === "") wrong.push(`not drawn: ${math.outerHTML.slice(0, 120)}`);
    if (math.querySelector("merror")) wrong.push(`in error: ${math.textContent.slice(0, 120)}`);
  }
  for (const formula of document.querySelectorAll(".formula")) {
    if (!formula.querySelector("math")) wrong.push(`a formula without MathML: ${formula.textContent.slice(0, 120)}`);
  }
  // LaTeX that was not turned into MathML. Listings and data may have backslashes.
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const { parentElement: parent, data: text } = walker.currentNode;
    if (parent.closest("script, style, pre, code, annotation")) continue;
    const left = text.match(/\\[a-zA-Z]{2,}|\$\$/);
    if (left) wrong.push(`LaTeX left over: ${text.slice(Math.max(0, left.index - 20), left.index + 40)}`);
  }
  return { count: all.length, wrong };
}

export function missingNumbers(numbers) {
  const text = document.body.innerText.replace(/\s+/g, " ");
  return numbers.filter((number) => !text.includes(number));
}

export function overflow() {
  const width = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth <= width) return [];
  const boxed = (node) => node.parentElement && (["auto", "scroll", "hidden"].includes(getComputedStyle(node.parentElement).overflowX) || boxed(node.parentElement));
  const wide = [...document.body.querySelectorAll("*")]
    .filter((node) => node.getBoundingClientRect().right > width + 1 && !boxed(node))
    .map((node) => `${node.tagName.toLowerCase()}.${node.getAttribute("class") ?? ""} reaches ${Math.round(node.getBoundingClientRect().right)} px`);
  return [`the page is ${document.documentElement.scrollWidth} px wide`, ...wide];
}

export function colours() {
  const style = getComputedStyle(document.body);
  const parse = (colour) => colour.match(/[\d.]+/g).slice(0, 3).map(Number);
  const luminance = (colour) => {
    const [r, g, b] = parse(colour).map((c) => (c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const [a, b] = [luminance(style.backgroundColor), luminance(style.color)].sort((x, y) => y - x);
  return { ground: style.backgroundColor, contrast: (a + 0.05) / (b + 0.05) };
}
