#!/usr/bin/env node
// The HTML report in a real browser, used as a person uses it: the graph is drawn, Play is pressed and the
// skeleton moves, time is scrubbed, before and after are chosen, the view is turned. No network is asked.
//
//     tests/clients/report_page PROGRAM [FOLDER]      (PROGRAM: build/release/bin/kinegraph; screenshots go to FOLDER)
//
// Needs chromium (scripts/install clients), or $CHROMIUM.
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { Chromium } from "./chromium.mjs";

const home = resolve(dirname(fileURLToPath(import.meta.url)), "../.."), program = resolve(process.argv[2] || "build/release/bin/kinegraph"), pictures = process.argv[3];
const folder = mkdtempSync(join(tmpdir(), "kinegraph_page_"));
let failed = 0;
const holds = (what, good, found = "") => { failed += !good; console.log(`${good ? "ok    " : "FAILED"} ${what}${good ? "" : `: ${found}`}`); };
const wait = milliseconds => new Promise(done => setTimeout(done, milliseconds));
const kinegraph = (exit, ...words) => {
  const done = spawnSync(program, [...words, "--progress", "none"], { cwd: folder, encoding: "utf8" });
  if (done.status !== exit) throw new Error(`kinegraph ${words.join(" ")}: exit ${done.status}, not ${exit}\n${done.stderr}`);
};
const keep = async (page, name) => { if (pictures) { mkdirSync(pictures, { recursive: true }); writeFileSync(join(pictures, name + ".png"), await page.screenshot()); } };

// The limbs' pixels of one colour of the canvas: where they are, as text with a letter for each.
const limbs = (page, tint) => page.value(`(() => {
  const canvas = document.querySelector(".stage canvas"), { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const probe = document.createElement("canvas").getContext("2d"); probe.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("${tint}"); probe.fillRect(0, 0, 1, 1);
  const [r, g, b] = probe.getImageData(0, 0, 1, 1).data; let text = "";
  for (let i = 0; i < data.length; i += 4) text += data[i + 3] > 250 && Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) < 12 ? "#" : ".";
  return text; })()`);
const count = text => text.split("#").length - 1;
const moved = (a, b) => { let changes = 0; for (let i = 0; i < a.length; ++i) changes += a[i] !== b[i]; return changes; };
const time = page => page.value("+document.querySelector('.player').dataset.time");

async function a_run() {
  kinegraph(0, "run", join(home, "graphs/style_transfer.kg.json"), "--out", folder, "--html", "page.html", "--report", "report.json");
  const report = JSON.parse(readFileSync(join(folder, "report.json"), "utf8")), page = await Chromium.open(join(folder, "page.html"));
  await keep(page, "run");
  holds("the page asks for nothing but itself", page.requests().every(url => url.startsWith("file://") && url.endsWith("page.html")), page.requests().join(" "));
  const drawn = await page.value("[...document.querySelectorAll('#picture .node > title')].map(title => title.textContent.split(':')[0]).sort().join()");
  holds("every node of the report is drawn", drawn === Object.keys(report.nodes).sort().join(), drawn);
  holds("nothing is wider than 1280 pixels", await page.value("document.documentElement.scrollWidth") <= 1280, await page.value("document.documentElement.scrollWidth"));
  const words = await page.value("document.body.innerText");
  for (const needed of ["skate < 0.02", "style_distance", "walk_made_sneaky.bvh", "passed", ...Object.keys(report.nodes)]) holds(`it tells ${needed}`, words.includes(needed), "not on the page");

  const before = await limbs(page, "--after");
  holds("a skeleton stands there", count(before) > 1000, `${count(before)} pixels of it`);
  await wait(300);
  holds("and stands still", moved(before, await limbs(page, "--after")) === 0, "it moved by itself");
  await page.click(".player .play");
  await wait(900);
  const during = await limbs(page, "--after"), then = await time(page);
  holds("Play moves the skeleton", then > 0.2 && moved(before, during) > 500, `${then} s, ${moved(before, during)} pixels changed`);
  await page.click(".player .play");
  const held = await time(page), still = await limbs(page, "--after");
  await wait(300);
  holds("Pause holds it", held === await time(page) && moved(still, await limbs(page, "--after")) === 0, `${held} s, then ${await time(page)} s`);

  const slider = await page.place(".player input[type=range]");
  await page.mouse("mousePressed", slider.left + slider.width * 0.8, slider.y);
  await page.mouse("mouseReleased", slider.left + slider.width * 0.8, slider.y);
  const scrubbed = await time(page);
  holds("the slider scrubs", Math.abs(scrubbed - 2.4) < 0.1 && moved(still, await limbs(page, "--after")) > 500, `${scrubbed} s`);
  const unturned = await limbs(page, "--after");
  await page.drag(".stage canvas", 220, 40);
  holds("dragging orbits", moved(unturned, await limbs(page, "--after")) > 500 && await time(page) === scrubbed, `${moved(unturned, await limbs(page, "--after"))} pixels changed`);

  await page.click("[data-mode=before]");
  holds("Before shows that alone", count(await limbs(page, "--before")) > 1000 && count(await limbs(page, "--after")) === 0, "");
  await page.click("[data-mode=after]");
  holds("After shows that alone", count(await limbs(page, "--before")) === 0 && count(await limbs(page, "--after")) > 1000, "");
  await page.click("[data-mode=apart]");
  holds("side by side shows both", count(await limbs(page, "--before")) > 1000 && count(await limbs(page, "--after")) > 1000, "");

  await page.click("#picture .node:last-of-type");
  holds("a click on a node tells its key", /key\s+[0-9a-f]{32}/.test(await page.value("document.querySelector('.detail').innerText")), await page.value("document.querySelector('.detail').innerText"));
  await page.click("tr.more");
  holds("a click on a metric opens its joints", await page.value("document.querySelectorAll('.joints > div').length") > 10, "none");
  const paper = () => page.value("getComputedStyle(document.body).backgroundColor"), light = await paper();
  await page.click("#theme");
  holds("light becomes dark", light !== await paper(), light);
  await keep(page, "run_used");
  holds("the browser complains of nothing", page.complaints().length === 0, page.complaints().join("; "));
  await page.close();
}

async function in_a_narrow_window() {
  const page = await Chromium.open(join(folder, "page.html"), { width: 390 });
  await keep(page, "narrow");
  holds("nothing is wider than 390 pixels", await page.value("document.documentElement.scrollWidth") <= 390, await page.value("document.documentElement.scrollWidth"));
  const told = "[...document.querySelectorAll('.told td.wide')]";
  holds("what is told stands in the window", await page.value(`${told}.length > 0 && ${told}.every(cell => cell.getBoundingClientRect().right <= 390)`), "it is cut off");
  const before = await limbs(page, "--after");
  await page.click(".player .play");
  await wait(900);
  holds("Play moves the skeleton there too", moved(before, await limbs(page, "--after")) > 300, `${moved(before, await limbs(page, "--after"))} pixels changed`);
  await page.close();
}

async function a_failing_run_from_the_cache() {
  const graph = join(home, "graphs/style_transfer.kg.json"), cache = join(folder, "cache");
  kinegraph(0, "run", graph, "--out", folder, "--cache", cache);
  kinegraph(4, "run", graph, "--out", folder, "--cache", cache, "--set", "check.rules=[\"skate < -1\"]", "--html", "page.html");
  const page = await Chromium.open(join(folder, "page.html"), { dark: true });
  await keep(page, "failing_dark");
  const words = await page.value("document.body.innerText");
  holds("a failed check is told first, with rule and limit", words.includes("Checks failed · exit 4") && words.indexOf("skate < -1") < words.indexOf("Motion"), words.slice(0, 300));
  holds("what came from the cache is marked", words.includes("from a cache") && await page.value("document.querySelectorAll('.chip.hit').length") > 3, "no hits");
  holds("a dark system gets a dark page", await page.value("document.documentElement.classList.contains('dark')"), "light");
  holds("the browser complains of nothing", page.complaints().length === 0, page.complaints().join("; "));
  await page.close();
}

async function a_batch() {
  kinegraph(0, "batch", join(home, "graphs/style_transfer.kg.json"), "--each", `walk.file=${home}/graphs/clips/[jrw]*.bvh`, "--out", join(folder, "batch"), "--html", "batch.html");
  const page = await Chromium.open(join(folder, "batch.html"));
  await keep(page, "batch");
  const words = await page.value("document.body.innerText");
  for (const needed of ["3 items: 3 done", "jaunty", "run", "walk", "style_distance"]) holds(`a batch's page tells ${needed}`, words.includes(needed), words.slice(0, 300));
  holds("a dot for each item and node", await page.value("document.querySelectorAll('.plots .card:last-child circle').length") === 6, await page.value("document.querySelectorAll('.plots .card:last-child circle').length"));
  holds("the browser complains of nothing", page.complaints().length === 0, page.complaints().join("; "));
  await page.close();
}

try {
  await a_run();
  await in_a_narrow_window();
  await a_failing_run_from_the_cache();
  await a_batch();
} finally {
  rmSync(folder, { recursive: true, force: true });
}
if (failed) { console.log(`tests/clients/report_page: ${failed} failed`); process.exit(1); }
console.log("The report page does in Chromium what it should.");
