#include "headless/html_page.h"

namespace kinegraph {

std::string_view html_page_start() {
  return R"PAGE(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1">
<title>Kinegraph report</title>
<style>
:root{--bg:#fbfbfa;--ink:#23272b;--faint:#7b838a;--line:#dcdfe2;--card:#fff;--good:#2c7a51;--bad:#b3362c;--warn:#9a6700;--a:#3a6ea5;--b:#c8641b}
@media(prefers-color-scheme:dark){:root{--bg:#191b1d;--ink:#e4e6e8;--faint:#8d959c;--line:#34383c;--card:#222528;--good:#5fbf8b;--bad:#f0796e;--warn:#d9a53a;--a:#7fb2e5;--b:#f0a060}}
body{font:14px/1.45 system-ui,sans-serif;margin:0 auto;max-width:1180px;padding:24px;background:var(--bg);color:var(--ink)}
h1{font-size:20px;margin:0 0 2px}h2{font-size:15px;margin:28px 0 8px}.faint{color:var(--faint)}
table{border-collapse:collapse;width:100%;background:var(--card)}th,td{text-align:left;padding:4px 10px;border-bottom:1px solid var(--line);vertical-align:top}
th{font-weight:600;color:var(--faint)}td.n{text-align:right;font-variant-numeric:tabular-nums}
.done,.passed{color:var(--good)}.failed,.blocked,.missing,.cancelled{color:var(--bad)}.error{color:var(--bad)}.warning{color:var(--warn)}.info{color:var(--faint)}
.card{background:var(--card);border:1px solid var(--line);border-radius:6px;overflow:auto}
canvas{display:block;width:100%;height:420px;touch-action:none;cursor:grab}
.bar{display:flex;gap:12px;align-items:center;padding:8px 12px;border-top:1px solid var(--line)}
button{font:inherit;padding:3px 14px;border:1px solid var(--line);border-radius:4px;background:var(--bg);color:var(--ink);cursor:pointer}
input[type=range]{flex:1}.key{display:inline-block;width:12px;height:3px;vertical-align:middle;margin-right:5px}
svg text{font:12px system-ui,sans-serif;fill:var(--ink)}
</style></head><body>
<h1 id="title">Kinegraph report</h1><div id="facts" class="faint"></div>
<div id="players"></div>
<h2>Graph</h2><div class="card" id="graph"></div>
<div id="checks"></div>
<div id="metrics"></div>
<h2>Nodes</h2><table id="nodes"></table>
<div id="said"></div>
<div id="files"></div>
<script type="application/json" id="data">)PAGE";
}

std::string_view html_page_end() {
  return R"PAGE(</script>
<script>
"use strict";
const data = JSON.parse(document.getElementById("data").textContent), report = data.report;
const make = (tag, text, kind) => { const e = document.createElement(tag); if (text !== undefined) e.textContent = text; if (kind) e.className = kind; return e; };
const at = id => document.getElementById(id);
const number = v => v === null || v === undefined ? "not measured" : Math.abs(v) >= 1e5 || (v !== 0 && Math.abs(v) < 1e-4) ? v.toExponential(3) : String(+v.toPrecision(5));
const row = (table, cells, tag) => { const r = make("tr"); for (const c of cells) { const e = make(tag || "td", c.text !== undefined ? c.text : c, c.kind); r.append(e); } table.append(r); return r; };
const section = (id, title) => { const t = make("table"); at(id).append(make("h2", title), t); return t; };
const color = name => getComputedStyle(document.documentElement).getPropertyValue(name);

document.title = report.graph + " – Kinegraph";
at("title").textContent = report.graph;
at("facts").textContent = "exit " + report.exit + " · " + report.seconds.toFixed(2) + " s · " + report.threads.used + " of " + report.threads.allowed + " threads · kinegraph " + report.version;

// Nodes: state, seconds as a bar, where results came from.
{
  const table = at("nodes"), names = Object.keys(report.nodes), most = Math.max(1e-9, ...names.map(n => report.nodes[n].seconds));
  row(table, ["node", "type", "state", { text: "seconds", kind: "n" }, "", "outputs"], "th");
  for (const name of names) {
    const n = report.nodes[name];
    const outputs = Object.entries(n.outputs).map(([port, o]) => port + (o.cached === "no" ? "" : " (" + o.cached + ")")).join(", ");
    const r = row(table, [name, n.type, { text: n.state, kind: n.state }, { text: n.seconds.toFixed(3), kind: "n" }, "", outputs]);
    const bar = make("div"); bar.style.cssText = "height:8px;margin-top:6px;border-radius:2px;background:var(--a);width:" + (120 * n.seconds / most) + "px"; r.children[4].append(bar);
  }
}
// What was said.
{
  const all = [];
  for (const [name, n] of Object.entries(report.nodes)) for (const d of n.diagnostics) all.push([name, d]);
  for (const d of report.diagnostics || []) all.push(["", d]);
  if (all.length) {
    const table = section("said", "Diagnostics");
    for (const [name, d] of all)
      row(table, [{ text: d.severity, kind: d.severity }, name + (d.port ? "." + d.port : "") + (d.param ? "." + d.param : ""), d.code,
        d.message + (d.joint ? " (joint " + d.joint + ")" : "") + (d.frame !== undefined ? " (frame " + d.frame + ")" : "") + (d.hint ? " – " + d.hint : "")]);
  }
}
if (report.checks.length) {
  const table = section("checks", "Checks");
  row(table, ["", "node", "rule", { text: "measured", kind: "n" }, { text: "limit", kind: "n" }], "th");
  for (const c of report.checks)
    row(table, [{ text: c.passed ? "passed" : "failed", kind: c.passed ? "passed" : "failed" }, c.node, c.rule, { text: number(c.value), kind: "n" }, { text: number(c.limit), kind: "n" }]);
}
// Metrics side by side; a bar is drawn to the largest of its row.
{
  const nodes = Object.keys(report.metrics).filter(n => Object.keys(report.metrics[n]).length);
  if (nodes.length) {
    const table = section("metrics", "Metrics"), names = [...new Set(nodes.flatMap(n => Object.keys(report.metrics[n])))];
    const plain = names.filter(n => !n.includes(".")), detailed = names.filter(n => n.includes("."));
    row(table, ["metric", ...nodes], "th");
    const add = (into, name) => {
      const most = Math.max(...nodes.map(n => Math.abs(report.metrics[n][name] || 0)), 1e-300);
      const r = row(into, [name, ...nodes.map(n => number(report.metrics[n][name]))]);
      nodes.forEach((n, i) => { const v = report.metrics[n][name]; if (typeof v !== "number") return;
        const bar = make("div"); bar.style.cssText = "height:5px;border-radius:2px;background:" + (i % 2 ? "var(--b)" : "var(--a)") + ";width:" + (160 * Math.abs(v) / most) + "px"; r.children[i + 1].append(bar); });
    };
    plain.forEach(n => add(table, n));
    if (detailed.length) {
      const more = make("details"), inner = make("table"); more.append(make("summary", detailed.length + " more, by joint and kind"), inner); at("metrics").append(more);
      detailed.forEach(n => add(inner, n));
    }
  }
}
if (report.files.length) {
  const table = section("files", "Files");
  for (const f of report.files) row(table, [f.path, f.node, { text: f.bytes + " bytes", kind: "n" }, f.sha256.slice(0, 16) + "…"]);
}
// The graph: a column for each step from the sources.
{
  const names = Object.keys(report.nodes), into = {}, depth = {};
  for (const n of names) into[n] = [];
  for (const [from, , to] of data.links) if (into[to]) into[to].push(from);
  const deep = (n, seen) => depth[n] !== undefined ? depth[n] : seen.has(n) ? 0 : depth[n] = (seen.add(n), into[n].length ? 1 + Math.max(...into[n].map(f => into[f] ? deep(f, seen) : 0)) : 0);
  names.forEach(n => deep(n, new Set()));
  const columns = []; for (const n of names) (columns[depth[n]] = columns[depth[n]] || []).push(n);
  for (let c = 1; c < columns.length; ++c) { // near what leads to them
    const place = {}; (columns[c - 1] || []).forEach((n, i) => place[n] = i);
    const mean = n => { const k = into[n].filter(f => f in place); return k.length ? k.reduce((s, f) => s + place[f], 0) / k.length : 1e3; };
    (columns[c] = columns[c] || []).sort((a, b) => mean(a) - mean(b));
  }
  const W = 190, H = 58, spot = {}; let tallest = 1;
  columns.forEach((list, c) => { tallest = Math.max(tallest, list.length); list.forEach((n, i) => spot[n] = [16 + c * W, 16 + i * H]); });
  const ns = "http://www.w3.org/2000/svg", svg = document.createElementNS(ns, "svg");
  const width = 16 + columns.length * W, height = 16 + tallest * H;
  svg.setAttribute("width", width); svg.setAttribute("height", height); svg.setAttribute("viewBox", "0 0 " + width + " " + height);
  const add = (tag, attributes, text) => { const e = document.createElementNS(ns, tag); for (const k in attributes) e.setAttribute(k, attributes[k]); if (text) e.textContent = text; svg.append(e); return e; };
  for (const [from, port, to, input] of data.links) {
    if (!spot[from] || !spot[to]) continue;
    const [x, y] = [spot[from][0] + 150, spot[from][1] + 20], [u, v] = [spot[to][0], spot[to][1] + 20];
    add("path", { d: `M${x} ${y}C${x + 30} ${y} ${u - 30} ${v} ${u} ${v}`, fill: "none", stroke: "var(--faint)", "stroke-width": 1.3 }).append(Object.assign(document.createElementNS(ns, "title"), { textContent: from + "." + port + " → " + to + "." + input }));
  }
  const tint = { done: "var(--good)", failed: "var(--bad)", blocked: "var(--bad)", missing: "var(--bad)" };
  for (const n of names) {
    const [x, y] = spot[n], node = report.nodes[n], cached = Object.values(node.outputs).some(o => o.cached !== "no");
    add("rect", { x, y, width: 150, height: 40, rx: 5, fill: "var(--bg)", stroke: tint[node.state] || "var(--line)", "stroke-width": 1.4, "stroke-dasharray": cached ? "4 3" : "" })
      .append(Object.assign(document.createElementNS(ns, "title"), { textContent: n + ": " + node.type + ", " + node.state + (cached ? ", from the cache" : "") + ", " + node.seconds.toFixed(3) + " s" }));
    add("text", { x: x + 8, y: y + 17 }, n.length > 21 ? "…" + n.slice(-20) : n);
    add("text", { x: x + 8, y: y + 32, style: "fill:var(--faint);font-size:11px" }, node.type + (node.seconds >= 0.0005 ? "  " + node.seconds.toFixed(3) + " s" : ""));
  }
  at("graph").append(svg);
}
// A player: motions on one floor, an orbit camera; drag turns, wheel nears.
function player(pair) {
  const box = make("div", undefined, "card player"), canvas = make("canvas"), bar = make("div", undefined, "bar");
  const play = make("button", "Play", "play"), slider = Object.assign(make("input"), { type: "range", min: 0, step: 1, value: 0 }), time = make("span", "", "faint time");
  bar.append(play, slider, time); box.append(canvas, bar);
  at("players").append(make("h2", pair.name), box);
  const keys = make("div", undefined, "faint"); const tints = pair.motions.length > 1 ? ["--a", "--b"] : ["--b"];
  pair.motions.forEach((m, i) => { const k = make("span", undefined, "key"); k.style.background = "var(" + tints[i] + ")"; const s = make("label"); const on = Object.assign(make("input"), { type: "checkbox", checked: true }); on.onchange = () => { m.hidden = !on.checked; draw(); }; s.append(on, k, (pair.motions.length > 1 ? (i ? "after: " : "before: ") : "") + m.name + "   "); keys.append(s); });
  box.after(keys);
  const seconds = Math.max(...pair.motions.map(m => m.frames / m.fps)), fps = Math.max(...pair.motions.map(m => m.fps));
  slider.max = Math.max(0, Math.round(seconds * fps) - 1);
  // The floor is the lowest point; the camera looks at what moves.
  let low = 1e9; for (const m of pair.motions) for (let i = 1; i < m.positions.length; i += 3) low = Math.min(low, m.positions[i] / 1000);
  let yaw = 0.9, pitch = 0.18, zoom = 1, now = 0, playing = false, last = 0;
  const joint = (m, t, j) => { const f = Math.min(m.frames - 1, Math.floor(t * m.fps + 1e-6)), at = (f * m.joints.length + j) * 3; return [m.positions[at] / 1000, m.positions[at + 1] / 1000, m.positions[at + 2] / 1000]; };
  function draw() {
    const scale = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
    if (canvas.width !== Math.round(w * scale)) { canvas.width = Math.round(w * scale); canvas.height = Math.round(h * scale); }
    const g = canvas.getContext("2d"); g.setTransform(scale, 0, 0, scale, 0, 0); g.clearRect(0, 0, w, h);
    const seen = pair.motions.filter(m => !m.hidden), all = seen.length ? seen : pair.motions;
    const centre = [0, 0]; all.forEach(m => { const p = joint(m, now, 0); centre[0] += p[0] / all.length; centre[1] += p[2] / all.length; });
    const cy = Math.cos(yaw), sy = Math.sin(yaw), cp = Math.cos(pitch), sp = Math.sin(pitch), far = 4.2 / zoom, focal = h * 1.55;
    const project = p => { const x = p[0] - centre[0], y = p[1] - low - 0.9, z = p[2] - centre[1]; const a = x * cy - z * sy, b = x * sy + z * cy; const v = y * cp - b * sp, d = far - y * sp - b * cp; return d < 0.05 ? null : [w / 2 + focal * a / d, h / 2 - focal * v / d, d]; };
    const line = (p, q) => { p = project(p); q = project(q); if (p && q) { g.moveTo(p[0], p[1]); g.lineTo(q[0], q[1]); } };
    g.lineWidth = 1; g.strokeStyle = color("--line"); g.beginPath();
    const gx = Math.round(centre[0]), gz = Math.round(centre[1]);
    for (let i = -4; i <= 4; ++i) { line([gx + i, low, gz - 4], [gx + i, low, gz + 4]); line([gx - 4, low, gz + i], [gx + 4, low, gz + i]); }
    g.stroke();
    pair.motions.forEach((m, i) => {
      if (m.hidden) return;
      g.lineCap = "round"; g.lineWidth = 1.5; g.globalAlpha = 0.35; g.strokeStyle = color(tints[i]); g.beginPath();
      for (let f = 1; f < m.frames; f += Math.max(1, Math.round(m.frames / 200))) { const a = joint(m, (f - 1) / m.fps, 0), b = joint(m, f / m.fps, 0); line([a[0], low, a[2]], [b[0], low, b[2]]); }
      g.stroke(); g.globalAlpha = 1; g.lineWidth = 4; g.beginPath();
      for (let j = 0; j < m.joints.length; ++j) if (m.parents[j] >= 0) line(joint(m, now, m.parents[j]), joint(m, now, j));
      g.stroke(); g.fillStyle = color(tints[i]);
      for (let j = 0; j < m.joints.length; ++j) { const p = project(joint(m, now, j)); if (p) { g.beginPath(); g.arc(p[0], p[1], 3, 0, 7); g.fill(); } }
    });
    time.textContent = now.toFixed(2) + " / " + seconds.toFixed(2) + " s"; box.dataset.time = now;
  }
  function step(stamp) { if (!playing) return; now += Math.min(0.1, (stamp - last) / 1000); last = stamp; if (now >= seconds) now %= seconds; slider.value = Math.round(now * fps); draw(); requestAnimationFrame(step); }
  play.onclick = () => { playing = !playing; play.textContent = playing ? "Pause" : "Play"; if (playing) { last = performance.now(); requestAnimationFrame(step); } };
  slider.oninput = () => { now = Math.min(seconds - 1e-6, slider.value / fps); draw(); };
  canvas.onpointerdown = e => { canvas.setPointerCapture(e.pointerId); canvas.onpointermove = m => { yaw += m.movementX * 0.01; pitch = Math.max(-0.3, Math.min(1.5, pitch + m.movementY * 0.01)); draw(); }; };
  canvas.onpointerup = () => canvas.onpointermove = null;
  canvas.onwheel = e => { e.preventDefault(); zoom = Math.max(0.2, Math.min(6, zoom * Math.exp(-e.deltaY * 0.001))); draw(); };
  addEventListener("resize", draw); draw();
}
data.players.forEach(player);
</script></body></html>
)PAGE";
}

}  // namespace kinegraph
