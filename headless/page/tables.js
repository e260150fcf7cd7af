function draw_diagnostics() {
  const rows = [];
  for (const told of report.diagnostics || []) rows.push(said(told.node || "", told));
  for (const [name, node] of Object.entries(report.nodes)) for (const told of node.diagnostics) rows.push(said(name, told));
  if (!rows.length) return;
  const rank = row => ["error", "warning"].indexOf(row.firstChild.textContent) + 1 || 3;
  section("Diagnostics");
  table(head("", "where", "code", ""), ...rows.sort((a, b) => rank(a) - rank(b))).className = "told";
}

function draw_times() {
  const nodes = Object.entries(report.nodes).sort((a, b) => b[1].seconds - a[1].seconds);
  if (!nodes.length) return;
  const most = Math.max(1e-9, nodes[0][1].seconds), sum = nodes.reduce((all, [, node]) => all + node.seconds, 0);
  section("Nodes", `${seconds(sum)} of computing in ${seconds(report.seconds)}`);
  table(head("node", "type", "state", ">time", "", "outputs"), ...nodes.map(([name, node]) => {
    const outputs = cell(""), bar = cell("", ...(node.seconds > 0 ? [track(node.seconds / most, "--accent")] : []));
    bar.style.width = "180px";
    for (const [port, output] of Object.entries(node.outputs)) outputs.append(make("span", output.cached === "no" ? "chip" : "chip hit", port + (output.cached === "no" ? "" : " · " + output.cached) + (output.bytes ? " · " + size(output.bytes) : "")));
    return make("tr", "", cell("", name), cell("faint", node.type), cell(node.state, node.state), cell("n", seconds(node.seconds)), bar, outputs);
  }));
}

function draw_files() {
  if (!report.files.length) return;
  section("Files");
  table(head("path", "node", ">size", "SHA-256"), ...report.files.map(file => make("tr", "", cell("", file.path), cell("faint", file.node), cell("n", size(file.bytes)), cell("mono faint", file.sha256))));
}
