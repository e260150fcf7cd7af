// A player of motions on one floor. A motion's positions are whole numbers of `step` metres from `origin`, two
// bytes each, frame by frame; 65535 is a point that is not there.
function decoded(motion) {
  const bytes = Uint8Array.from(atob(motion.positions), letter => letter.charCodeAt(0));
  const whole = new Uint16Array(bytes.buffer), all = new Float32Array(whole.length);
  for (let i = 0; i < whole.length; ++i) all[i] = whole[i] === 65535 ? NaN : motion.origin[i % 3] + whole[i] * motion.step;
  const count = motion.points.length, point = (frame, p) => { const at = (frame * count + p) * 3; return [all[at], all[at + 1], all[at + 2]]; };
  return { ...motion, all, count, point, duration: motion.frames / motion.fps, frame: time => Math.max(0, Math.min(motion.frames - 1, Math.floor(time * motion.fps + 1e-4))) };
}
const is_there = p => p[0] === p[0];
const middle_of = list => [0, 1, 2].map(axis => list.reduce((sum, p) => sum + p[axis], 0) / list.length);

// Where a motion is at a time, for the camera: the root, or the mean of what is there.
function centre(motion, frame) {
  if (motion.bones.length && is_there(motion.point(frame, motion.body))) return motion.point(frame, motion.body);
  const there = []; for (let p = 0; p < motion.count; ++p) { const at = motion.point(frame, p); if (is_there(at)) there.push(at); }
  return there.length ? middle_of(there) : [0, 0, 0];
}

function player(shown) {
  const motions = shown.motions.map(decoded), two = motions.length > 1;
  const duration = Math.max(...motions.map(m => m.duration)), fps = Math.max(...motions.map(m => m.fps));
  const tints = two ? ["before", "after"] : ["after"];
  const box = make("div", "player"), stage = make("div", "stage"), canvas = make("canvas"), pen = canvas.getContext("2d");
  box.tabIndex = 0;
  const state = { time: 0, playing: false, speed: 1, mode: two ? "overlay" : "after", follow: true, trails: true, yaw: 0, pitch: 0.16, far: 4, pan: [0, 0], joint: motions.at(-1).body, quantity: "height" };
  const seen = () => motions.filter((m, i) => !two || state.mode === "overlay" || state.mode === "apart" || (state.mode === "before" ? i === 0 : i === 1));

  // The floor lies where the lowest points come to rest; sizes follow the figure's.
  const lows = [], tall = [];
  for (const m of motions) for (let f = 0; f < m.frames; f += Math.max(1, m.frames >> 7)) {
    let low = Infinity, high = -Infinity;
    for (let p = 0; p < m.count; ++p) { const y = m.point(f, p)[1]; if (y < low) low = y; if (y > high) high = y; }
    if (low < Infinity) { lows.push(low); tall.push(high - low); }
  }
  lows.sort((a, b) => a - b); tall.sort((a, b) => a - b);
  const tallness = Math.max(1e-3, tall[tall.length >> 1] || 1);
  let floor = lows[Math.floor(lows.length * 0.05)] || 0;
  if (Math.abs(floor) < 0.08 * tallness) floor = 0;

  // Seen from the side of where it goes, a little from ahead.
  function first_view() {
    const m = motions.at(-1), a = centre(m, 0), b = centre(m, m.frames - 1), x = b[0] - a[0], z = b[2] - a[2];
    state.yaw = Math.hypot(x, z) > 0.5 * tallness ? Math.atan2(x, z) - Math.PI / 2 + 0.6 : 0.6;
    state.pitch = 0.16; state.far = 2.15 * tallness; state.pan = [0, 0];
  }
  first_view();

  function camera() {
    const w = stage.clientWidth, h = stage.clientHeight, list = seen();
    const spots = list.map(m => centre(m, state.follow ? m.frame(state.time) : 0)), at = middle_of(spots);
    const cy = Math.cos(state.yaw), sy = Math.sin(state.yaw), cp = Math.cos(state.pitch), sp = Math.sin(state.pitch);
    // Two that walk far apart are both wanted in the picture.
    const spread = state.mode === "apart" ? 0.9 * tallness : Math.max(0, ...spots.map(p => Math.hypot(p[0] - at[0], p[2] - at[2])));
    const far = state.far + 1.2 * spread, focal = 1.25 * h;
    const look = [at[0], floor + 0.5 * tallness, at[2]];
    const project = p => {
      const x = p[0] - look[0], y = p[1] - look[1], z = p[2] - look[2];
      const right = x * cy - z * sy, ahead = x * sy + z * cy, depth = far - y * sp - ahead * cp;
      return depth < 0.05 * tallness ? null : [w / 2 + state.pan[0] + focal * right / depth, h / 2 + state.pan[1] - focal * (y * cp - ahead * sp) / depth, depth];
    };
    return { w, h, at, far, focal, project, right: [cy, 0, -sy] };
  }
  // Side by side: both in the middle, moved apart across the view.
  function shift(m, cam) {
    if (state.mode !== "apart" || !two) return [0, 0, 0];
    const p = centre(m, state.follow ? m.frame(state.time) : 0), side = (m === motions[0] ? -0.55 : 0.55) * tallness;
    return [cam.at[0] - p[0] + side * cam.right[0], 0, cam.at[2] - p[2] + side * cam.right[2]];
  }

  function draw_floor(cam) {
    const cell = tallness > 40 ? 50 : tallness > 4 ? 5 : tallness > 0.4 ? 0.5 : 0.05, reach = 14;
    const gx = Math.round(cam.at[0] / cell), gz = Math.round(cam.at[2] / cell);
    pen.lineWidth = 1; pen.strokeStyle = color("--grid");
    for (let i = -reach; i <= reach; ++i) for (let j = -reach; j < reach; ++j) {
      const fade = 1 - Math.hypot(i, j + 0.5) / reach;
      if (fade <= 0) continue;
      pen.globalAlpha = fade * 0.9;
      for (const turned of [false, true]) {
        const k = turned ? gz + i : gx + i, a = turned ? [(gx + j) * cell, floor, k * cell] : [k * cell, floor, (gz + j) * cell], b = turned ? [(gx + j + 1) * cell, floor, k * cell] : [k * cell, floor, (gz + j + 1) * cell];
        const p = cam.project(a), q = cam.project(b);
        if (p && q) { pen.beginPath(); pen.moveTo(p[0], p[1]); pen.lineTo(q[0], q[1]); pen.stroke(); }
      }
    }
    pen.globalAlpha = 1;
  }
  function draw_trail(m, tint, cam, off) {
    const step = Math.max(1, Math.round(m.frames / 300)), now = m.frame(state.time);
    pen.lineWidth = 1.5; pen.strokeStyle = color(`--${tint}`); pen.lineJoin = "round";
    for (const past of [false, true]) {
      pen.globalAlpha = past ? 0.9 : 0.3; pen.beginPath();
      let begun = false;
      for (let f = past ? 0 : now; f <= (past ? now : m.frames - 1); f += step) {
        const p = centre(m, f), q = cam.project([p[0] + off[0], floor, p[2] + off[2]]);
        if (q) { begun ? pen.lineTo(q[0], q[1]) : pen.moveTo(q[0], q[1]); begun = true; } else begun = false;
      }
      pen.stroke();
    }
    pen.globalAlpha = 1;
  }
  // Limbs as tapered pieces, the farthest first; left paler, right darker.
  function pieces_of(m, tint, cam, off, onto_floor) {
    const f = m.frame(state.time), scale = cam.focal, list = [];
    const at = p => { const q = m.point(f, p); return [q[0] + off[0], onto_floor ? floor : q[1], q[2] + off[2]]; };
    for (const [a, b, ra, rb] of m.bones) {
      const pa = at(a), pb = at(b);
      if (!is_there(pa) || !is_there(pb)) continue;
      const p = cam.project(pa), q = cam.project(pb);
      if (p && q) list.push({ p, q, rp: Math.max(1.2, ra * scale / p[2]), rq: Math.max(1.2, rb * scale / q[2]), depth: (p[2] + q[2]) / 2, tint, side: m.sides ? m.sides[b] : 0 });
    }
    if (!m.bones.length || m.dots)
      for (let i = 0; i < m.count; ++i) { const pi = at(i); if (!is_there(pi)) continue; const p = cam.project(pi); if (p) list.push({ p, q: p, rp: Math.max(1.6, 0.009 * tallness * scale / p[2]), rq: 0, depth: p[2] - 0.01, tint, side: 0 }); }
    return list;
  }
  function trace(piece) {
    const { p, q, rp, rq } = piece, dx = q[0] - p[0], dy = q[1] - p[1], length = Math.hypot(dx, dy);
    if (length < 1e-3 || Math.abs(rp - rq) >= length) { const big = rp > rq ? p : q; pen.moveTo(big[0] + Math.max(rp, rq), big[1]); pen.arc(big[0], big[1], Math.max(rp, rq), 0, 2 * Math.PI); return; }
    const along = Math.atan2(dy, dx), open = Math.acos((rp - rq) / length);
    pen.moveTo(p[0] + rp * Math.cos(along + open), p[1] + rp * Math.sin(along + open));
    pen.arc(p[0], p[1], rp, along + open, along - open + 2 * Math.PI);
    pen.arc(q[0], q[1], rq, along - open, along + open);
    pen.closePath();
  }

  function draw() {
    const w = stage.clientWidth, h = stage.clientHeight, dots = devicePixelRatio || 1;
    if (!w) return;
    if (canvas.width !== Math.round(w * dots) || canvas.height !== Math.round(h * dots)) { canvas.width = Math.round(w * dots); canvas.height = Math.round(h * dots); }
    pen.setTransform(dots, 0, 0, dots, 0, 0);
    pen.clearRect(0, 0, w, h);
    const cam = camera(), list = seen();
    draw_floor(cam);
    const limbs = [];
    for (const m of list) {
      const off = shift(m, cam), tint = tints[motions.indexOf(m)];
      if (state.trails) draw_trail(m, tint, cam, off);
      // One shape, so that limbs above one another don't darken it.
      pen.fillStyle = `rgba(${color("--shadow")},0.16)`; pen.beginPath();
      for (const piece of pieces_of(m, tint, cam, off, true)) trace(piece);
      pen.fill();
      limbs.push(...pieces_of(m, tint, cam, off, false));
    }
    limbs.sort((a, b) => b.depth - a.depth);
    const paper = color("--card"), fills = {};
    for (const tint of tints) fills[tint] = [color(`--${tint}`), color(`--${tint}-dark`)];
    for (const piece of limbs) {
      pen.beginPath(); trace(piece);
      pen.fillStyle = fills[piece.tint][piece.side > 0 ? 1 : 0];
      pen.fill();
      pen.lineWidth = 1; pen.strokeStyle = paper; pen.stroke();
    }
    const frame = Math.min(Math.floor(state.time * fps + 1e-4), Math.round(duration * fps) - 1);
    time.textContent = `${state.time.toFixed(2)} of ${duration.toFixed(2)} s · frame ${frame}`;
    slider.value = frame;
    box.dataset.time = state.time;
    curve.draw();
  }

  // Height and speed of a joint along time, both motions.
  const curve = curve_of(motions, tints, state, duration, floor, time => seek(time));
  const legend = make("div", "legend"), how = make("div", "how faint", "drag: orbit · shift-drag: pan · wheel: zoom · double-click: reset");
  motions.forEach((m, i) => { const swatch = make("span", "swatch"); swatch.style.background = `var(--${tints[i]})`; legend.append(make("div", "", swatch, make("b", "", two ? (i ? "after " : "before ") : ""), m.name, make("span", "faint", `  ${m.frames_of_clip} frames, ${m.duration.toFixed(2)} s`))); });
  stage.append(canvas, legend, how);
  const play = make("button", "play", "Play"), back = make("button", "", "◂"), on = make("button", "", "▸");
  const slider = Object.assign(make("input"), { type: "range", min: 0, max: Math.max(0, Math.round(duration * fps) - 1), step: 1, value: 0 }), time = make("span", "time faint");
  back.title = "one frame back"; on.title = "one frame on"; slider.setAttribute("aria-label", "time");
  const speed = make("select", "", ...[0.1, 0.25, 0.5, 1, 2].map(s => Object.assign(make("option", "", s + "×"), { value: s, selected: s === 1 })));
  speed.title = "speed";
  const bar = make("div", "bar", play, back, on, slider, time, speed), options = make("div", "bar");
  const modes = make("span", "segments");
  if (two) {
    for (const [mode, word] of [["overlay", "Overlay"], ["apart", "Side by side"], ["before", "Before"], ["after", "After"]]) {
      const button = make("button", mode === state.mode ? "on" : "", word);
      button.dataset.mode = mode;
      button.onclick = () => { state.mode = mode; modes.querySelectorAll("button").forEach(other => other.classList.toggle("on", other === button)); draw(); };
      modes.append(button);
    }
    options.append(modes);
  }
  const tick = (word, name) => { const input = Object.assign(make("input"), { type: "checkbox", checked: state[name] }); input.onchange = () => { state[name] = input.checked; draw(); }; options.append(make("label", "", input, word)); };
  tick("follow", "follow"); tick("trails", "trails");
  options.append(curve.choice);
  box.append(stage, bar, options, curve.box);

  let last = 0;
  const seek = to => { state.time = Math.max(0, Math.min(duration - 1e-6, to)); draw(); };
  const move = frames => { pause(); seek((Math.round(state.time * fps) + frames) / fps); };
  const pause = () => { state.playing = false; play.textContent = "Play"; };
  function step(now) {
    if (!state.playing || !box.isConnected) return;
    state.time += state.speed * Math.min(0.1, Math.max(0, now - last) / 1000);
    last = now;
    if (state.time >= duration) state.time %= duration;
    draw();
    requestAnimationFrame(step);
  }
  play.onclick = () => {
    if (state.playing) return pause();
    state.playing = true; play.textContent = "Pause"; last = performance.now();
    requestAnimationFrame(step);
  };
  back.onclick = () => move(-1); on.onclick = () => move(1);
  speed.onchange = () => state.speed = +speed.value;
  slider.oninput = () => seek(slider.value / fps);
  box.onkeydown = event => {
    if (event.target.tagName === "SELECT") return;
    const acts = { " ": () => play.onclick(), ArrowLeft: () => move(-1), ArrowRight: () => move(1), b: () => { const want = state.mode === "before" ? "after" : "before"; modes.querySelector(`[data-mode=${want}]`)?.click(); } };
    if (!acts[event.key] || (event.key === " " && event.target.tagName === "BUTTON")) return;
    event.preventDefault(); acts[event.key]();
  };
  canvas.onpointerdown = event => {
    canvas.setPointerCapture(event.pointerId); box.focus({ preventScroll: true });
    canvas.onpointermove = at => {
      if (at.shiftKey || event.button !== 0) { state.pan[0] += at.movementX; state.pan[1] += at.movementY; }
      else { state.yaw -= at.movementX * 0.008; state.pitch = Math.max(-0.2, Math.min(1.5, state.pitch + at.movementY * 0.006)); }
      draw();
    };
  };
  canvas.onpointerup = canvas.onpointercancel = () => canvas.onpointermove = null;
  canvas.oncontextmenu = event => event.preventDefault();
  canvas.ondblclick = () => { first_view(); draw(); };
  canvas.addEventListener("wheel", event => { event.preventDefault(); state.far = Math.max(0.6 * tallness, Math.min(30 * tallness, state.far * Math.exp(event.deltaY * 0.001))); draw(); }, { passive: false });
  redraws.push(draw);
  return { box, draw, pause };
}

function draw_players() {
  if (!data.players.length) return;
  section("Motion", data.players.length === 1 ? data.players[0].name : "");
  const tabs = make("div", "tabs"), all = data.players.map(player), place = make("div");
  const choose = chosen => {
    all.forEach(one => one.pause());
    tabs.querySelectorAll("button").forEach((button, i) => button.classList.toggle("on", i === chosen));
    place.replaceChildren(all[chosen].box);
    all[chosen].draw();
  };
  data.players.forEach((shown, i) => { const tab = make("button", "", shown.name); tab.onclick = () => choose(i); tabs.append(tab); });
  if (all.length > 1) main.append(tabs);
  card(place);
  choose(0);
}
