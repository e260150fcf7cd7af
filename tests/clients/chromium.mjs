// Chromium without a window, spoken to by the DevTools protocol through pipes: nothing to install but itself.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export class Chromium {
  // Width and height of the page's viewport; `dark`: what the page is told of the reader's system.
  static async open(file, { width = 1280, height = 900, dark = false } = {}) {
    const browser = new Chromium();
    browser.folder = mkdtempSync(join(tmpdir(), "kinegraph_chromium_"));
    const program = process.env.CHROMIUM || "chromium";
    browser.process = spawn(program, ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run", "--disable-extensions", `--user-data-dir=${browser.folder}`, `--window-size=${width},${height}`, "--remote-debugging-pipe", "about:blank"],
      { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    browser.process.on("error", problem => { throw new Error(`${program} can't be started: ${problem.message}`); });
    browser.waiting = new Map();
    browser.events = [];
    browser.count = 0;
    let text = "";
    browser.process.stdio[4].on("data", bytes => {
      text += bytes;
      for (let end; (end = text.indexOf("\0")) >= 0; text = text.slice(end + 1)) browser.#hear(JSON.parse(text.slice(0, end)));
    });
    const { targetInfos } = await browser.ask("Target.getTargets");
    const page = targetInfos.find(target => target.type === "page");
    browser.session = (await browser.ask("Target.attachToTarget", { targetId: page.targetId, flatten: true })).sessionId;
    for (const domain of ["Page", "Runtime", "Network", "Log"]) await browser.ask(`${domain}.enable`);
    await browser.ask("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
    await browser.ask("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }] });
    const loaded = browser.until("Page.loadEventFired");
    await browser.ask("Page.navigate", { url: new URL(`file://${file}`).href });
    await loaded;
    return browser;
  }
  #hear(message) {
    if (message.id) {
      const { done, failed } = this.waiting.get(message.id);
      this.waiting.delete(message.id);
      message.error ? failed(new Error(message.error.message)) : done(message.result);
    } else {
      this.events.push(message);
      for (const listener of [...(this.listeners || [])]) listener(message);
    }
  }
  ask(method, params = {}) {
    const id = ++this.count;
    this.process.stdio[3].write(JSON.stringify({ id, method, params, sessionId: this.session }) + "\0");
    return new Promise((done, failed) => this.waiting.set(id, { done, failed }));
  }
  until(method) {
    this.listeners = this.listeners || new Set();
    return new Promise(done => { const listener = message => { if (message.method === method) { this.listeners.delete(listener); done(message.params); } }; this.listeners.add(listener); });
  }
  // What an expression comes to in the page.
  async value(expression) {
    const { result, exceptionDetails } = await this.ask("Runtime.evaluate", { expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description || exceptionDetails.text}`);
    return result.value;
  }
  // The middle of what a selector finds, brought into view.
  async place(selector) {
    const at = await this.value(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); if (!e) return null; e.scrollIntoView({ block: "center", behavior: "instant" }); const r = e.getBoundingClientRect(); return { x: r.x + r.width / 2, y: r.y + r.height / 2, width: r.width, height: r.height, left: r.x, top: r.y }; })()`);
    if (!at) throw new Error(`nothing on the page is ${selector}`);
    return at;
  }
  async mouse(type, x, y, more = {}) { await this.ask("Input.dispatchMouseEvent", { type, x, y, button: "left", clickCount: 1, ...more }); }
  async click(selector) {
    const { x, y } = await this.place(selector);
    await this.mouse("mouseMoved", x, y, { button: "none" });
    await this.mouse("mousePressed", x, y);
    await this.mouse("mouseReleased", x, y);
  }
  async drag(selector, dx, dy) {
    const { x, y } = await this.place(selector);
    await this.mouse("mousePressed", x, y);
    for (let i = 1; i <= 5; ++i) await this.mouse("mouseMoved", x + dx * i / 5, y + dy * i / 5, { buttons: 1 });
    await this.mouse("mouseReleased", x + dx, y + dy);
  }
  // A PNG of what is seen, or of one element.
  async screenshot(selector) {
    const clip = selector ? await this.place(selector) : undefined;
    const area = clip && { x: clip.left, y: clip.top + await this.value("scrollY"), width: clip.width, height: clip.height, scale: 1 };
    const { data } = await this.ask("Page.captureScreenshot", { format: "png", clip: area, captureBeyondViewport: !selector });
    return Buffer.from(data, "base64");
  }
  complaints() {
    return this.events.filter(({ method, params }) => method === "Runtime.exceptionThrown" || (method === "Log.entryAdded" && params.entry.level === "error") || (method === "Runtime.consoleAPICalled" && params.type === "error")).map(({ params }) => params.exceptionDetails?.exception?.description || params.entry?.text || JSON.stringify(params.args));
  }
  requests() { return this.events.filter(({ method }) => method === "Network.requestWillBeSent").map(({ params }) => params.request.url); }
  async close() {
    const over = new Promise(done => this.process.on("exit", done));
    this.process.stdio[3].write(JSON.stringify({ id: ++this.count, method: "Browser.close" }) + "\0");
    this.waiting.set(this.count, { done() {}, failed() {} });
    await over;
    rmSync(this.folder, { recursive: true, force: true });
  }
}
