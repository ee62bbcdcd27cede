// Chromium without a window, spoken to through a pipe (Chrome DevTools Protocol): no package is needed for it.
import {spawn, spawnSync} from 'node:child_process';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

// The program, or null where there is none. CHROMIUM names one.
export function findChromium() {
  const names = process.env.CHROMIUM ? [process.env.CHROMIUM] : ['chromium', 'chromium-browser', 'google-chrome'];
  return names.find((name) => spawnSync(name, ['--version'], {stdio: 'ignore'}).status === 0) ?? null;
}

export class Browser {
  #process;
  #profile = mkdtempSync(join(tmpdir(), 'frustum-pages-'));
  #last = 0;
  #waiting = new Map();
  #listeners = [];
  #session;

  static async start(program) {
    const browser = new Browser();
    await browser.#open(program);
    return browser;
  }

  async #open(program) {
    this.#process = spawn(program, [
      '--headless=new', '--no-sandbox', '--remote-debugging-pipe', `--user-data-dir=${this.#profile}`,
      '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--hide-scrollbars',
      '--force-color-profile=srgb', '--disable-background-networking', '--no-first-run', 'about:blank',
    ], {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    let rest = '';
    this.#process.stdio[4].on('data', (bytes) => {
      const parts = (rest + bytes).split('\0');
      rest = parts.pop();
      parts.forEach((part) => this.#receive(JSON.parse(part)));
    });
    const {targetInfos} = await this.send('Target.getTargets');
    const {targetId} = targetInfos.find((target) => target.type === 'page');
    this.#session = (await this.send('Target.attachToTarget', {targetId, flatten: true})).sessionId;
    for (const domain of ['Page', 'Runtime', 'Log', 'Network', 'DOM']) await this.send(`${domain}.enable`);
  }

  #receive(message) {
    const waiting = this.#waiting.get(message.id);
    if (waiting) {
      this.#waiting.delete(message.id);
      message.error ? waiting.reject(new Error(`${waiting.method}: ${message.error.message}`))
                    : waiting.resolve(message.result);
    }
    if (message.method) this.#listeners.forEach((listen) => listen(message.method, message.params));
  }

  send(method, params = {}) {
    const id = ++this.#last;
    this.#process.stdio[3].write(`${JSON.stringify({id, method, params, sessionId: this.#session})}\0`);
    return new Promise((resolve, reject) => this.#waiting.set(id, {resolve, reject, method}));
  }
  on(listen) { this.#listeners.push(listen); }

  // Until the page has loaded and drawn.
  async load(url) {
    const loaded = new Promise((resolve) => {
      const listen = (method) => {
        if (method !== 'Page.loadEventFired') return;
        this.#listeners.splice(this.#listeners.indexOf(listen), 1);
        resolve();
      };
      this.on(listen);
    });
    await this.send('Page.navigate', {url});
    await loaded;
  }
  async evaluate(expression) {
    const {result, exceptionDetails} =
        await this.send('Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true});
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }
  size(width, height, mobile = false) {
    return this.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: 1, mobile});
  }

  async close() {
    const ended = new Promise((resolve) => this.#process.once('exit', resolve));
    await this.send('Browser.close').catch(() => {});
    await ended;
    rmSync(this.#profile, {recursive: true, force: true, maxRetries: 5});
  }
}
