// The graph in columns, from what has no input to what nobody waits for. Wires that span several columns get a
// place of their own in each, so that they pass between nodes.
function layers(names, links) {
  const into = Object.fromEntries(names.map(name => [name, []]));
  for (const [from, , to] of links) if (into[to] && into[from]) into[to].push(from);
  const depth = {}, visit = (name, above) => {
    if (depth[name] !== undefined) return depth[name];
    if (above.has(name)) return 0;
    above.add(name);
    depth[name] = Math.max(-1, ...into[name].map(from => visit(from, above))) + 1;
    above.delete(name);
    return depth[name];
  };
  names.forEach(name => visit(name, new Set()));
  // A source stands beside what it feeds, not far to the left of it.
  const out = Object.fromEntries(names.map(name => [name, []]));
  for (const to of names) for (const from of into[to]) out[from].push(to);
  for (const name of names) if (!into[name].length && out[name].length) depth[name] = Math.min(...out[name].map(to => depth[to])) - 1;
  const columns = [], place = (id, column) => (columns[column] = columns[column] || []).push(id);
  names.forEach(name => place(name, depth[name]));
  const near = {}, join = (a, b) => { (near[a] = near[a] || { left: [], right: [] }).right.push(b); (near[b] = near[b] || { left: [], right: [] }).left.push(a); };
  const ways = links.map(([from, port, to, input, type]) => {
    if (!into[to] || !into[from]) return null;
    const way = [from];
    for (let column = depth[from] + 1; column < depth[to]; ++column) { const id = "\0" + from + "\0" + port + "\0" + column; if (!columns[column].includes(id)) { place(id, column); } way.push(id); }
    way.push(to);
    for (let i = 1; i < way.length; ++i) join(way[i - 1], way[i]);
    return { from, port, to, input, type, way };
  }).filter(way => way);
  for (let c = 0; c < columns.length; ++c) columns[c] = columns[c] || [];
  // Neighbours near one another: columns are sorted by the mean place of what they are linked to, to and fro.
  for (let sweep = 0; sweep < 12; ++sweep) {
    const right = sweep % 2 === 0, order = right ? [...columns.keys()].slice(1) : [...columns.keys()].slice(0, -1).reverse();
    for (const c of order) {
      const spot = new Map(columns[c + (right ? -1 : 1)].map((id, i) => [id, i]));
      const rank = new Map(columns[c].map((id, i) => {
        const beside = (near[id] ? near[id][right ? "left" : "right"] : []).filter(other => spot.has(other));
        return [id, beside.length ? beside.reduce((sum, other) => sum + spot.get(other), 0) / beside.length : i];
      }));
      columns[c].sort((a, b) => rank.get(a) - rank.get(b));
    }
  }
  return { columns, near, ways };
}

function heights(columns, near, tall, thin) {
  const y = {}, gap = (a, b) => ((a[0] === "\0" ? thin : tall) + (b[0] === "\0" ? thin : tall)) / 2;
  for (const column of columns) column.forEach((id, i) => y[id] = i === 0 ? 0 : y[column[i - 1]] + gap(column[i - 1], id));
  for (let sweep = 0; sweep < 24; ++sweep) {
    for (const column of sweep % 2 ? columns : [...columns].reverse()) {
      const wish = column.map(id => {
        const beside = near[id] ? [...near[id].left, ...near[id].right] : [];
        return beside.length ? beside.reduce((sum, other) => sum + y[other], 0) / beside.length : y[id];
      });
      // Wishes pushed apart from above and from below; the mean keeps the column where it wants to be.
      const down = [], up = [];
      column.forEach((id, i) => down[i] = i ? Math.max(wish[i], down[i - 1] + gap(column[i - 1], id)) : wish[i]);
      for (let i = column.length - 1; i >= 0; --i) up[i] = i < column.length - 1 ? Math.min(wish[i], up[i + 1] - gap(column[i], column[i + 1])) : wish[i];
      column.forEach((id, i) => y[id] = (down[i] + up[i]) / 2);
    }
  }
  const least = Math.min(...Object.values(y));
  for (const id in y) y[id] -= least;
  return y;
}

const type_tints = { Motion: "#2b7bd3", Points: "#1d9a78", Warp: "#c4912a", Stats: "#7a5cc2", Components: "#c8374f", Contacts: "#4b9fae", Character: "#a0648c", Metrics: "#7d8894" };

function draw_graph() {
  // What nothing is linked to and nobody needed (samples inside nested graphs, say) is only named.
  const known = new Set(Object.keys(report.nodes)), links = data.links.filter(link => known.has(link[0]) && known.has(link[2]));
  const linked = new Set(links.flatMap(link => [link[0], link[2]])), names = [...known].filter(name => linked.has(name) || report.nodes[name].state !== "skipped");
  const others = [...known].filter(name => !names.includes(name));
  if (!names.length) return;
  const { columns, near, ways } = layers(names, links);
  const W = 150, H = 50, X = W + 34, y = heights(columns, near, H + 16, 14), x = {};
  columns.forEach((column, c) => column.forEach(id => x[id] = c * X));
  const width = (columns.length - 1) * X + W + 4, height = Math.max(...names.map(name => y[name])) + H + 4;
  const picture = svg("svg", { viewBox: `-2 -2 ${width} ${height}`, id: "picture" });
  const most = Math.max(1e-9, ...names.map(name => report.nodes[name].seconds));
  const wires = ways.map(way => {
    let [px, py] = [x[way.from] + W, y[way.from] + H / 2], d = `M${px} ${py}`;
    for (const id of way.way.slice(1)) {
      const qx = x[id], qy = y[id] + H / 2, bend = (qx - px) / 2;
      d += `C${px + bend} ${py} ${qx - bend} ${qy} ${qx} ${qy}`;
      [px, py] = [qx, qy];
      if (id !== way.to) { px += W; d += `L${px} ${py}`; }
    }
    const wire = svg("path", { d, class: "link", stroke: type_tints[way.type] || "var(--faint)" });
    wire.append(svg("title", {}, `${way.from}.${way.port} → ${way.to}.${way.input} (${way.type || "?"})`));
    picture.append(wire);
    return { ...way, wire };
  });
  const detail = make("div", "detail faint", "Click a node for its outputs, keys and messages.");
  const states = { done: "--good", failed: "--bad", blocked: "--bad", missing: "--bad", cancelled: "--bad" };
  for (const name of names) {
    const node = report.nodes[name], box = svg("g", { class: "node", transform: `translate(${x[name]},${y[name]})` });
    box.append(svg("rect", { class: "box", width: W, height: H, rx: 6 }), svg("rect", { width: 4, height: H - 10, x: 5, y: 5, rx: 2, fill: `var(${states[node.state] || "--line"})` }));
    const slash = name.lastIndexOf("/"), shown = name.slice(slash + 1), outer = name.slice(0, slash + 1), fit = (text, room) => text.length > room ? text.slice(0, room - 1) + "…" : text;
    const title = svg("text", { x: 16, y: 18 });
    if (outer) title.append(svg("tspan", { fill: "var(--faint)" }, fit(outer, 10)));
    title.append(svg("tspan", { "font-weight": 600 }, fit(shown, outer ? 11 : 18)));
    box.append(title, svg("text", { x: 16, y: 33, class: "small" }, fit(node.type, 15)));
    const hits = Object.values(node.outputs).map(output => output.cached).filter(cached => cached !== "no");
    const note = hits.length ? hits[0] : node.state === "done" ? seconds(node.seconds) : node.state;
    const words = svg("text", { x: W - 8, y: 33, class: "small", "text-anchor": "end" }, note);
    if (hits.length || states[node.state] === "--bad") words.style.fill = hits.length ? "var(--good)" : "var(--bad)";
    box.append(words);
    if (!hits.length && node.state === "done") box.append(svg("rect", { x: 16, y: 40, height: 4, rx: 2, width: Math.max(2, (W - 24) * node.seconds / most), fill: "var(--accent)", opacity: 0.75 }));
    box.append(svg("title", {}, `${name}: ${node.type}, ${node.state}, ${seconds(node.seconds)}`));
    box.onclick = () => {
      picture.querySelectorAll(".node.on").forEach(other => other.classList.remove("on"));
      box.classList.add("on");
      for (const { from, to, wire } of wires) { wire.classList.toggle("near", from === name || to === name); wire.classList.toggle("dim", from !== name && to !== name); }
      detail.className = "detail";
      detail.replaceChildren(make("b", "", name), node.type + ", ", make("span", node.state, node.state), ", " + seconds(node.seconds));
      for (const [port, output] of Object.entries(node.outputs))
        detail.append(make("div", "faint", port + ": " + (output.cached === "no" ? "computed" : "from the " + output.cached + " cache") + ", " + size(output.bytes) + ", key ", make("span", "mono", output.key)));
      for (const told of node.diagnostics) detail.append(make("div", told.severity, told.severity + ": " + told.message + (told.hint ? " – " + told.hint : "")));
    };
    picture.append(box);
  }
  const hits = names.filter(name => Object.values(report.nodes[name].outputs).some(output => output.cached !== "no")).length;
  const types = [...new Set(links.map(link => link[4]).filter(type => type))].sort();
  section("Graph", `${names.length} nodes, ${hits} from a cache; bars show where the time went`);
  const view = make("div", "scroll", picture), legend = make("span", "faint");
  view.style.cssText = "padding:16px;max-height:640px";
  for (const type of types) { const key = make("span", "swatch"); key.style.background = type_tints[type] || "var(--faint)"; legend.append(key, type + "\u2003"); }
  const bar = make("div", "bar", legend);
  if (others.length) legend.append("not needed: " + others.join(", "));
  card(view, bar, detail);
  // As large as it fits, but never so small that it can't be read.
  redraws.push(() => { const scale = Math.min(1, Math.max(0.8, (view.clientWidth - 34) / width)); picture.setAttribute("width", width * scale); picture.setAttribute("height", height * scale); });
  redraws.at(-1)();
}
