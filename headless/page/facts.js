// What every part of the page draws with.
const data = JSON.parse(document.getElementById("data").textContent), report = data.report;
const main = document.querySelector("main");
const make = (tag, kind, ...inside) => {
  const element = document.createElement(tag);
  if (kind) element.className = kind;
  element.append(...inside);
  return element;
};
const svg = (tag, attributes, text) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const name in attributes) element.setAttribute(name, attributes[name]);
  if (text !== undefined) element.textContent = text;
  return element;
};
const number = value => {
  if (typeof value !== "number") return "not measured";
  const size = Math.abs(value);
  return size >= 1e5 || (size !== 0 && size < 1e-4) ? value.toExponential(2).replace("-", "−").replace("e+", "e") : String(+value.toPrecision(4)).replace("-", "−");
};
const seconds = value => value >= 10 ? value.toFixed(1) + " s" : value >= 1 ? value.toFixed(2) + " s" : value >= 1e-3 ? (value * 1e3).toFixed(value >= 0.1 ? 0 : 1) + " ms" : value > 0 ? "<1 ms" : "0 s";
const size = bytes => bytes >= 1 << 20 ? (bytes / (1 << 20)).toFixed(1) + " MiB" : bytes >= 1024 ? (bytes / 1024).toFixed(1) + " KiB" : bytes + " bytes";
const color = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const cell = (kind, ...inside) => make("td", kind, ...inside);
const head = (...names) => make("tr", "", ...names.map(name => name.startsWith(">") ? make("th", "n", name.slice(1)) : make("th", "", name)));
const section = (title, note) => {
  const heading = make("h2", "", title);
  if (note) heading.append(make("small", "", note));
  main.append(heading);
};
const card = (...inside) => { const box = make("div", "card", ...inside); main.append(box); return box; };
const table = (...rows) => { const t = make("table", "", ...rows); card(make("div", "scroll", t)); return t; };
const track = (share, tint, mark) => {
  const fill = make("i"), bar = make("div", "track", fill);
  fill.style.cssText = `width:${(100 * Math.min(1, Math.max(0, share))).toFixed(2)}%;background:var(${tint})`;
  if (mark !== undefined) { const b = make("b"); b.style.left = `calc(${(100 * mark).toFixed(2)}% - 1px)`; bar.append(b); }
  return bar;
};

// Light or dark as the reader's system has it, until told otherwise.
const redraws = [];
{
  const dark = matchMedia("(prefers-color-scheme: dark)"), root = document.documentElement;
  const choose = on => { root.classList.toggle("dark", on); redraws.forEach(redraw => redraw()); };
  dark.addEventListener("change", () => choose(dark.matches));
  document.getElementById("theme").onclick = () => choose(!root.classList.contains("dark"));
  choose(dark.matches);
}
addEventListener("resize", () => redraws.forEach(redraw => redraw()));

const verdicts = { 0: ["Passed", "good"], 1: ["Failed", "bad"], 3: ["Invalid", "bad"], 4: ["Checks failed", "bad"], 5: ["Could not write", "bad"], 124: ["Timed out", "bad"], 130: ["Interrupted", "bad"], 143: ["Interrupted", "bad"] };
function tell_facts(...parts) {
  const [word, tint] = verdicts[report.exit] || ["Failed", "bad"], pill = document.getElementById("verdict");
  document.title = word + ": " + report.graph;
  document.getElementById("title").textContent = report.graph;
  pill.textContent = report.exit ? word + " · exit " + report.exit : word;
  pill.classList.add(tint);
  document.getElementById("facts").textContent = parts.filter(part => part).join(" · ");
}
const said = (name, told) => {
  const where = [told.port || told.param ? name + "." + (told.port || told.param) : name, told.joint ? "joint " + told.joint : "", told.frame !== undefined ? "frame " + told.frame : ""].filter(part => part).join(", ");
  const words = cell("wide", told.message);
  if (told.hint) words.append(make("div", "hint", told.hint));
  return make("tr", "", cell(told.severity, told.severity), cell("mono", where), cell("mono faint code", told.code), words);
};
