// Many items: what became of each, how long it took, and where each stands in every metric.
function draw_batch() {
  const items = Object.entries(report.items), wrong = ([, item]) => item.state !== "done" && item.state !== "skipped";
  const took = ([, item]) => item.started === undefined ? 0 : item.ended - item.started, counts = {};
  for (const [, item] of items) counts[item.state] = (counts[item.state] || 0) + 1;
  tell_facts(`${items.length} items: ` + Object.entries(counts).map(([state, count]) => count + " " + state).join(", "), seconds(report.ended - report.started), "kinegraph " + report.version);

  const bad = items.filter(wrong);
  if (bad.length) {
    section("What went wrong", `${bad.length} of ${items.length} items`);
    const rows = [];
    for (const [name, item] of bad) {
      const told = item.report || {}, before = rows.length;
      for (const check of told.checks || []) if (!check.passed) rows.push(make("tr", "", cell("failed", item.state), cell("", name), cell("", check.node), cell("wide", make("span", "mono", check.rule), `: measured ${number(check.value)}, limit ${number(check.limit)}`)));
      for (const [node, one] of Object.entries(told.nodes || {})) for (const words of one.diagnostics) if (words.severity === "error" && words.code !== "blocked") rows.push(make("tr", "", cell("failed", item.state), cell("", name), cell("", node), cell("wide", words.message, make("div", "hint", words.hint || ""))));
      if (rows.length === before) rows.push(make("tr", "", cell("failed", item.state), cell("", name), cell("", ""), cell("wide faint", item.cause || (item.exit ? "exit " + item.exit : ""))));
    }
    table(head("", "item", "node", ""), ...rows);
  }

  const metrics = {};
  for (const [name, item] of items) for (const [node, all] of Object.entries((item.report || {}).metrics || {})) for (const [metric, value] of Object.entries(all))
    if (!metric.includes(".") && typeof value === "number") { const plot = metrics[metric] = metrics[metric] || {}; (plot[node] = plot[node] || []).push([value, name]); }
  if (Object.keys(metrics).length) {
    const measured = [...new Set(Object.values(metrics).flatMap(plot => Object.keys(plot)))].sort();
    section("Metrics", "a dot an item; hold the pointer over one for its name");
    const plots = make("div", "plots");
    main.append(plots);
    for (const metric of Object.keys(metrics).sort()) plots.append(make("div", "card", make("b", "", metric), strip(metrics[metric], measured)));
  }

  section("Items");
  const most = Math.max(1e-9, ...items.map(took));
  table(head("item", "state", ">time", "", "checks", "files"), ...items.map(pair => {
    const [name, item] = pair, told = item.report || {}, checks = told.checks || [], bar = cell("", ...(took(pair) > 0 ? [track(took(pair) / most, "--accent")] : []));
    bar.style.width = "200px";
    const failed = checks.filter(check => !check.passed).length;
    return make("tr", "", cell("", name), cell(wrong(pair) ? "failed" : "done", item.state), cell("n", took(pair) ? seconds(took(pair)) : ""), bar, cell(failed ? "failed" : "", checks.length ? `${checks.length - failed} of ${checks.length} passed` : ""), cell("faint", (told.files || []).map(file => file.path).join(", ")));
  }));
}

// Values of all items on one axis, a line of dots a node; `order`: all nodes, so that each has one colour everywhere.
function strip(nodes, order) {
  const names = order.filter(name => nodes[name]), W = 360, row = 30, all = names.flatMap(name => nodes[name].map(pair => pair[0]));
  let low = Math.min(0, ...all), high = Math.max(...all);
  if (!(high > low)) high = low + 1;
  const x = value => 78 + (W - 100) * (value - low) / (high - low), picture = svg("svg", { viewBox: `0 0 ${W} ${names.length * row + 26}`, width: "100%" });
  names.forEach((name, i) => {
    const y = 16 + i * row, sorted = nodes[name].map(pair => pair[0]).sort((a, b) => a - b), middle = sorted[sorted.length >> 1];
    picture.append(svg("text", { x: 0, y: y + 4, class: "small" }, name.length > 11 ? name.slice(0, 10) + "…" : name), svg("line", { x1: 78, x2: W - 22, y1: y, y2: y, stroke: "var(--line)" }));
    nodes[name].forEach(([value, item], k) => { const dot = svg("circle", { cx: x(value), cy: y + (k * 7919 % 11 - 5), r: 3.2, fill: `var(${order.indexOf(name) % 2 ? "--accent" : "--after"})`, opacity: 0.65 }); dot.append(svg("title", {}, `${item}: ${number(value)}`)); picture.append(dot); });
    picture.append(svg("line", { x1: x(middle), x2: x(middle), y1: y - 10, y2: y + 10, stroke: "var(--ink)", "stroke-width": 1.5 }));
  });
  const base = names.length * row + 18;
  picture.append(svg("text", { x: x(low), y: base, class: "small" }, number(low)), svg("text", { x: W - 22, y: base, class: "small", "text-anchor": "end" }, number(high)));
  return picture;
}

report.format === "kinegraph-batch-report" ? draw_batch() : draw_run();
