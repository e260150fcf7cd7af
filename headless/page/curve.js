// A joint's height or speed along time below the player, with the moment that it shows.
function curve_of(motions, tints, state, duration, floor, seek) {
  const box = make("div", "curve"), canvas = make("canvas"), pen = canvas.getContext("2d");
  const names = [...new Set(motions.flatMap(m => m.points))], usual = motions.at(-1).points[motions.at(-1).body];
  const joint = make("select", "", ...names.map(name => Object.assign(make("option", "", name), { selected: name === usual })));
  const quantity = make("select", "", ...["height", "speed"].map(name => make("option", "", name)));
  joint.title = quantity.title = "drawn below";
  const choice = make("span", "", "plot ", quantity, " of ", joint);
  box.append(canvas);

  const series = (m, name) => {
    const p = m.points.indexOf(name);
    if (p < 0) return [];
    const list = [];
    for (let f = 0; f < m.frames; ++f) {
      if (quantity.value === "height") { list.push(m.point(f, p)[1] - floor); continue; }
      const a = m.point(Math.max(0, f - 1), p), b = m.point(Math.min(m.frames - 1, f + 1), p), frames = Math.min(m.frames - 1, f + 1) - Math.max(0, f - 1);
      list.push(frames ? Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) * m.fps / frames : 0);
    }
    return list;
  };
  let known = "", lines = [];
  const left = 58, right = 16, top = 14, bottom = 22;
  function draw() {
    const w = box.clientWidth, h = canvas.clientHeight, dots = devicePixelRatio || 1, key = joint.value + "/" + quantity.value;
    if (!w) return;
    if (canvas.width !== Math.round(w * dots)) { canvas.width = Math.round(w * dots); canvas.height = Math.round(h * dots); }
    if (known !== key) { known = key; lines = motions.map(m => series(m, joint.value)); }
    pen.setTransform(dots, 0, 0, dots, 0, 0);
    pen.clearRect(0, 0, w, h);
    const all = lines.flat().filter(value => value === value);
    let low = quantity.value === "speed" ? 0 : Math.min(...all), high = Math.max(...all);
    if (!(high - low > 1e-9)) { low -= 0.5; high += 0.5; }
    const x = time => left + (w - left - right) * time / duration, y = value => h - bottom - (h - top - bottom) * (value - low) / (high - low);
    pen.font = '11.5px system-ui, "DejaVu Sans", sans-serif'; pen.fillStyle = color("--faint"); pen.strokeStyle = color("--line"); pen.lineWidth = 1;
    const nice = range => { const power = 10 ** Math.floor(Math.log10(range)); return [1, 2, 5, 10].map(k => k * power).find(step => range / step <= 4.5); };
    const step = nice(high - low), beat = nice(duration / 2);
    pen.textAlign = "right"; pen.textBaseline = "middle";
    for (let value = Math.ceil(low / step) * step; value <= high + 1e-9; value += step) { pen.beginPath(); pen.moveTo(left, y(value)); pen.lineTo(w - right, y(value)); pen.stroke(); pen.fillText(number(Math.round(value / step) * step), left - 8, y(value)); }
    pen.textAlign = "center";
    for (let at = 0; at <= duration + 1e-9; at += beat) pen.fillText(number(Math.round(at / beat) * beat) + " s", Math.min(w - right - 8, x(at)), h - 9);
    pen.save(); pen.translate(13, (h - bottom + top) / 2); pen.rotate(-Math.PI / 2); pen.fillText(quantity.value === "height" ? "height, m" : "speed, m/s", 0, 0); pen.restore();
    lines.forEach((line, i) => {
      const m = motions[i];
      if (motions.length > 1 && ((state.mode === "before" && i) || (state.mode === "after" && !i))) return;
      pen.strokeStyle = color(`--${tints[i]}`); pen.lineWidth = 1.8; pen.lineJoin = "round"; pen.beginPath();
      let down = false;
      line.forEach((value, f) => { if (value !== value) { down = false; return; } down ? pen.lineTo(x(f / m.fps), y(value)) : pen.moveTo(x(f / m.fps), y(value)); down = true; });
      pen.stroke();
    });
    pen.strokeStyle = color("--accent"); pen.lineWidth = 1.5; pen.beginPath(); pen.moveTo(x(state.time), top - 6); pen.lineTo(x(state.time), h - bottom); pen.stroke();
  }
  joint.onchange = quantity.onchange = draw;
  const go = event => seek((event.clientX - canvas.getBoundingClientRect().left - left) / (canvas.clientWidth - left - right) * duration);
  canvas.onpointerdown = event => { canvas.setPointerCapture(event.pointerId); go(event); canvas.onpointermove = go; };
  canvas.onpointerup = canvas.onpointercancel = () => canvas.onpointermove = null;
  return { box, choice, draw };
}
