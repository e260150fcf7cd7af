// What was measured: a row a metric with a bar for each node, and the joints behind it.
function draw_checks() {
  if (!report.checks.length) return;
  const failed = report.checks.filter(check => !check.passed).length;
  section("Checks", failed ? `${failed} of ${report.checks.length} failed` : "all passed");
  const rows = report.checks.map(check => {
    const most = Math.max(Math.abs(check.value || 0), Math.abs(check.limit || 0)) * 1.15 || 1, bar = cell("");
    bar.style.width = "220px";
    if (typeof check.value === "number" && typeof check.limit === "number") bar.append(track(Math.abs(check.value) / most, check.passed ? "--good" : "--bad", Math.abs(check.limit) / most));
    return make("tr", "", cell(check.passed ? "passed" : "failed", check.passed ? "✓ passed" : "✗ failed"), cell("", check.node), cell("mono", check.rule), cell("n", number(check.value)), cell("n", number(check.limit)), bar);
  });
  table(head("", "node", "rule", ">measured", ">limit", "measured against the limit"), ...rows);
}

function draw_metrics() {
  const nodes = data.metrics_order.filter(node => Object.keys(report.metrics[node] || {}).length);
  if (!nodes.length) return;
  const value = (node, name) => report.metrics[node][name], names = [...new Set(nodes.flatMap(node => Object.keys(report.metrics[node])))];
  const whole = names.filter(name => !name.includes(".") || !names.includes(name.split(".")[0])), parts = {};
  for (const name of names) { const dot = name.indexOf("."); if (dot > 0 && names.includes(name.slice(0, dot))) (parts[name.slice(0, dot)] = parts[name.slice(0, dot)] || []).push(name); }
  const tint = i => nodes.length === 1 ? "--after" : i === 0 ? "--before" : i === 1 ? "--after" : "--accent";
  const paired = nodes.length === 2;
  section("Metrics", Object.keys(parts).length ? "click one for its joints" : "");
  const t = table(head("metric", ...nodes.map(node => ">" + node), ...(paired ? [">change"] : []), "", "unit"));
  for (const name of whole) {
    const values = nodes.map(node => value(node, name)), most = Math.max(...values.map(v => Math.abs(v || 0)), 1e-9), plot = cell("wide");
    plot.style.minWidth = "260px";
    values.forEach((v, i) => { if (typeof v === "number") { const bar = track(Math.abs(v) / most, tint(i)); bar.style.marginTop = i ? "3px" : "4px"; plot.append(bar); } });
    const row = make("tr", parts[name] ? "more" : "plain", cell("", name), ...values.map(v => cell("n", number(v))));
    if (paired) { const [a, b] = values, known = typeof a === "number" && typeof b === "number" && Math.abs(a) > 1e-12; row.append(cell("n faint", known ? (b >= a ? "+" : "−") + number(Math.abs(100 * (b - a) / Math.abs(a))) + " %" : "")); }
    row.append(plot, cell("faint", data.units[name] || ""));
    t.append(row);
    if (!parts[name]) continue;
    row.onclick = () => {
      if (row.classList.toggle("open")) row.after(joints_of(name));
      else row.nextSibling.remove();
    };
  }
  function joints_of(name) {
    const grid = make("div", "joints"), most = Math.max(...parts[name].flatMap(part => nodes.map(node => Math.abs(value(node, part) || 0))), 1e-9);
    for (const part of parts[name]) {
      const label = part.slice(name.length + 1), bars = make("div", "pair"), numbers = make("div", "num");
      nodes.forEach((node, i) => { const v = value(node, part); bars.append(track(Math.abs(v || 0) / most, tint(i))); });
      numbers.textContent = number(value(nodes.at(-1), part));
      numbers.title = nodes.map(node => node + ": " + number(value(node, part))).join("\n");
      const word = make("div", "label", label); word.title = label;
      grid.append(make("div", "", word, bars, numbers));
    }
    const inside = cell("", grid); inside.colSpan = nodes.length + (paired ? 4 : 3); inside.style.padding = 0;
    return make("tr", "", inside);
  }
}
