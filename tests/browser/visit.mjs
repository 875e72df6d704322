// One page that a test has open: what it loads, what goes wrong in it, and what can be asked about it. The pages' policy forbids eval, so nothing here
// goes through Playwright's evaluate(): locators, and the browser's own protocol, which the policy does not concern.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { decode } from './png.mjs';
import { longest } from './tab.mjs';

const axeSource = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

// Resolves when the page has settled: <html data-settled> says that it has no request, timer or frame of its own under way (server/web/base/work.ts). Two frames
// come first, since a browser gives turns of the wheel to a page with the next one; an observer of our own, since those of the page have been told by then
// what has come into view.
export const settled = `new Promise((done) => {
  const root = document.documentElement, is = () => 'settled' in root.dataset;
  const look = () => requestAnimationFrame(() => requestAnimationFrame(() => new IntersectionObserver((_, own) => {
    own.disconnect();
    is() ? done() : wait();
  }).observe(root)));
  const wait = () => new MutationObserver((_, own) => {
    if (!is()) return;
    own.disconnect();
    look();
  }).observe(root, { attributes: true });
  look();
})`;

const dataTypes = new Set(['XHR', 'Fetch', 'EventSource', 'WebSocket', 'Other']);

export class Visit {
  faults = []; // what went wrong and was not expected, in words
  requests = []; // {url, type, status, bytes}: bytes over the wire, head and packed body
  #open = new Map(); // requests under way, by their id
  #ended = () => {}; // called when one of them ends
  #closed = false;

  /** Opens `path` in one of the tabs. Options: size, scheme, lang (chromium.mjs); expect: {status: [404], console: [/text/]}, faults that the test means to see;
   *  fresh: nothing is in the browser's cache; context: a context of Playwright to share, as of tabs, or further settings of a new one. */
  static async open(tabs, service, path, options = {}) {
    const visit = new Visit();
    Object.assign(visit, { tabs, service, options, tab: await tabs.take(options) });
    visit.tab.visit = visit;
    await visit.goto(path);
    return visit;
  }

  get page() {
    return this.tab.page;
  }
  get cdp() {
    return this.tab.cdp;
  }

  async goto(path) {
    this.path = path;
    await this.page.goto(this.service.url + path);
  }

  /** Expects faults from now on: {status: [503], console: [/text/]}. */
  expect(expected) {
    this.options = { ...this.options, expect: expected };
  }

  fault(text) {
    this.faults.push(`${this.path}: ${text}`);
  }
  consoleLine(text, place = '') {
    if (/GPU stall due to ReadPixels/.test(text)) return; // space is drawn and composed by the processor here
    const expected = this.options.expect ?? {};
    if ((expected.console ?? []).some((pattern) => pattern.test(text))) return;
    const status = /^Failed to load resource: .*status of (\d+)/.exec(text);
    if (status && (expected.status ?? []).includes(Number(status[1]))) return;
    this.fault(`on the console: ${text}${place ? ` (${place})` : ''}`);
  }

  network = {
    requestWillBeSent: ({ requestId, request, type, redirectResponse }) => {
      if (redirectResponse) this.#end(requestId);
      const url = new URL(request.url);
      if (url.protocol === 'blob:' || url.protocol === 'data:') return;
      if (url.origin !== this.service.url) this.fault(`a request to ${url.origin}`);
      const entry = { url: url.pathname + url.search, method: request.method, type, status: 0, bytes: 0, cached: false };
      entry.again = this.requests.some((other) => other.url === entry.url && other.method === entry.method);
      this.requests.push(entry);
      this.#open.set(requestId, entry);
    },
    requestServedFromCache: ({ requestId }) => {
      const entry = this.#open.get(requestId);
      if (entry) entry.cached = true;
    },
    responseReceived: ({ requestId, response, type }) => {
      const entry = this.#open.get(requestId);
      if (!entry) return;
      entry.status = response.status;
      entry.type = type;
      entry.cached ||= Boolean(response.fromDiskCache);
      entry.bytes = response.encodedDataLength;
      if (response.status >= 400 && !(this.options.expect?.status ?? []).includes(response.status)) this.fault(`${entry.method} ${entry.url} answered ${response.status}`);
    },
    dataReceived: ({ requestId, encodedDataLength }) => {
      const entry = this.#open.get(requestId);
      if (entry) entry.bytes += encodedDataLength;
    },
    loadingFinished: ({ requestId, encodedDataLength }) => this.#end(requestId, encodedDataLength),
    // What a page stops, or leaves behind as it is left, is no fault; what the network lost stands on the console, too.
    loadingFailed: ({ requestId }) => this.#end(requestId),
  };
  #end(id, bytes) {
    const entry = this.#open.get(id);
    if (entry && bytes !== undefined && !entry.cached) entry.bytes = bytes;
    this.#open.delete(id);
    this.#ended();
  }

  /** Returns the value of an expression in the page; a promise is awaited. */
  async read(expression) {
    const { result, exceptionDetails } = await this.cdp.send('Runtime.evaluate', { expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
    return result.value;
  }

  /** Returns the page's address when all that was done to it has settled. Playwright's own url() follows what a script writes into it some time later. */
  async address() {
    await this.quiet();
    return new URL(await this.read('location.href'));
  }

  /** Waits until all that was done to the page has led to is there: answers, drawings, the address. Pictures count, too; streams of events do not, nor what is
   *  asked once more: pages look for changes again and again. */
  async quiet() {
    const pending = () => [...this.#open.values()].filter(({ type, again }) => type !== 'EventSource' && !again);
    let late;
    const patience = new Promise((_, fail) => {
      late = setTimeout(() => fail(new Error(`${this.path} does not settle; under way: ${pending().map(({ url }) => url).join(' ') || 'no request'}`)), longest);
    });
    try {
      for (;;) {
        await Promise.race([this.read(settled), patience]);
        if (pending().length === 0) return;
        await Promise.race([new Promise((ended) => (this.#ended = ended)), patience]);
      }
    } finally {
      clearTimeout(late);
    }
  }

  /** Returns {count, bytes} of the requests since the `from`th that went over the wire; without `data`, only document, modules, styles and pictures count. The
   *  favicon, which the browser asks for once and when it likes, does not. */
  traffic({ from = 0, data = true } = {}) {
    const counted = this.requests.slice(from).filter(({ url, type, cached }) => !cached && !url.endsWith('/favicon.svg') && (data || !dataTypes.has(type)));
    return { count: counted.length, bytes: counted.reduce((sum, { bytes }) => sum + bytes, 0), list: counted.map(({ method, url, bytes }) => `${method} ${url} ${bytes}`) };
  }

  /** Fails where the page is wider than the window, and names what reaches furthest. */
  async expectNoSidewaysScroll() {
    const { width } = this.page.viewportSize(), { cssContentSize } = await this.cdp.send('Page.getLayoutMetrics');
    if (cssContentSize.width <= width) return;
    const widest = await this.read(`[...document.body.querySelectorAll('*')].map((e) => [e.getBoundingClientRect().left + Math.max(e.offsetWidth ?? 0, e.scrollWidth), e])
      .sort((a, b) => b[0] - a[0]).slice(0, 4).map(([right, e]) => e.tagName.toLowerCase() + (e.id && '#' + e.id) + ' to ' + Math.round(right)).join(', ')`);
    assert.fail(`${this.path}, ${this.variant()}: ${cssContentSize.width} px wide in a window of ${width} px: ${widest}`);
  }

  /** Fails where axe finds something serious or critical. Axe runs in a world of its own beside the page's modules. */
  async axe() {
    const { frameTree } = await this.cdp.send('Page.getFrameTree');
    const { executionContextId: contextId } = await this.cdp.send('Page.createIsolatedWorld', { frameId: frameTree.frame.id, worldName: 'axe' });
    const run = async (expression) => {
      const { result, exceptionDetails } = await this.cdp.send('Runtime.evaluate', { expression, contextId, returnByValue: true, awaitPromise: true });
      if (exceptionDetails) throw new Error(`axe: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
      return result.value;
    };
    await run(axeSource);
    const found = JSON.parse(
      await run(`axe.run(document, { resultTypes: ['violations'] }).then(({ violations }) => JSON.stringify(violations
        .filter(({ impact }) => impact === 'serious' || impact === 'critical')
        .map(({ id, impact, help, nodes }) => impact + ', ' + id + ': ' + help + '\\n' + nodes.slice(0, 5).map((node) => '    ' + node.html.slice(0, 200) + '\\n      ' +
          node.failureSummary.replace(/\\s+/g, ' ')).join('\\n') + (nodes.length > 5 ? '\\n    and ' + (nodes.length - 5) + ' more' : ''))))`),
    );
    assert.equal(found.length, 0, `${this.path}, ${this.variant()}: axe found\n${found.join('\n')}`);
  }

  /** Changes the system's colours to 'light' or 'dark', and waits until the page has followed. */
  async scheme(scheme) {
    if (scheme === (this.options.scheme ?? 'light')) return;
    this.options = { ...this.options, scheme };
    await this.page.emulateMedia({ colorScheme: scheme });
    await this.quiet();
  }

  variant() {
    const { size = 'desk', scheme = 'light', lang = 'en' } = this.options;
    return `${size}, ${scheme}, ${lang}`;
  }

  /** Returns the pixels of what a selector or locator finds, as shown: png.mjs; with `scale: 'css'` one for each CSS pixel, whatever the screen has. */
  async pixels(target, options = {}) {
    const locator = typeof target === 'string' ? this.page.locator(target).first() : target;
    return decode(await locator.screenshot({ animations: 'disabled', ...options }));
  }

  /** Returns {label, blank, sum} of all canvases that are shown and drawn on in two dimensions; `sum` is a number of their pixels that is another one where these are
   *  others. What is shown of a canvas is a matter of pixels(). */
  canvases() {
    return this.read(`[...document.querySelectorAll('canvas:not(.above, .layer)')].filter((each) => each.checkVisibility() && each.width > 1 && each.getContext('2d')).map((each) => {
      const copy = new OffscreenCanvas(Math.min(each.width, 400), Math.min(each.height, 200)), pen = copy.getContext('2d', { willReadFrequently: true });
      pen.drawImage(each, 0, 0, copy.width, copy.height);
      let sum = 0, blank = true;
      for (const pixel of new Uint32Array(pen.getImageData(0, 0, copy.width, copy.height).data.buffer)) {
        sum = (Math.imul(sum, 31) + pixel) | 0;
        blank &&= pixel === 0;
      }
      return { label: each.getAttribute('aria-label') ?? each.className, blank, sum };
    })`);
  }

  locator(selector, options) {
    return this.page.locator(selector, options);
  }

  /** Ends the visit; faults that were not expected fail the test. A tab in which something went wrong is not used again. */
  async close({ failing = false } = {}) {
    if (this.#closed) return;
    this.#closed = true;
    if (failing || this.faults.length > 0) await this.tab.close();
    else await this.tabs.give(this.tab);
    if (!failing) assert.equal(this.faults.length, 0, `${this.faults.length} faults (${this.variant()}):\n${this.faults.join('\n')}`);
  }
}
