function draw_run() {
  const outputs = Object.values(report.nodes).flatMap(node => Object.values(node.outputs)), hits = outputs.filter(output => output.cached !== "no").length;
  tell_facts(seconds(report.seconds), `${report.threads.used} of ${report.threads.allowed} threads`, outputs.length ? `${hits} of ${outputs.length} outputs from a cache` : "", report.files.length + (report.files.length === 1 ? " file" : " files"), "kinegraph " + report.version);
  // What went wrong comes first.
  const broken = report.exit !== 0 && report.exit !== 4;
  if (broken) draw_diagnostics();
  if (report.exit) draw_checks();
  draw_players();
  if (!report.exit) draw_checks();
  draw_metrics();
  draw_graph();
  draw_times();
  if (!broken) draw_diagnostics();
  draw_files();
}
