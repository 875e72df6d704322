// One page that a test has open: what it loads, what goes wrong in it, and what can be asked about it. The pages' policy forbids eval, so nothing here
// goes through Playwright's evaluate(): locators, and the browser's own protocol, which the policy does not concern.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { settings } from './chromium.mjs';
import { decode } from './png.mjs';

const axeSource = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

const dataTypes = new Set(['XHR', 'Fetch', 'EventSource', 'WebSocket', 'Other']);

export class Visit {
  faults = []; // what went wrong and was not expected, in words
  requests = []; // {url, type, status, bytes}: bytes over the wire, head and packed body
  #open = new Map(); // requests under way, by their id

  /** Opens `path`. Options: size, scheme, lang (chromium.mjs); expect: {status: [404], console: [/text/]}, faults that the test means to see; context:
   *  a context of Playwright to share, as of tabs, or further settings of a new one. */
  static async open(browser, service, path, options = {}) {
    const visit = new Visit();
    visit.service = service;
    visit.options = options;
    const shared = options.context && 'newPage' in options.context;
    visit.context = shared ? options.context : await browser.newContext({ ...settings(options), ...options.context });
    if (!shared) visit.owned = visit.context;
    visit.context.setDefaultTimeout(600_000 * Number(process.env.SLOWER ?? 1)); // a test waits for what has to happen; this ends what never will
    visit.page = await visit.context.newPage();
    await visit.#watch();
    await visit.goto(path);
    return visit;
  }

  async goto(path) {
    this.path = path;
    await this.page.goto(this.service.url + path);
  }

  /** Expects faults from now on: {status: [503], console: [/text/]}. */
  expect(expected) {
    this.options = { ...this.options, expect: expected };
  }

  #fault(text) {
    this.faults.push(`${this.path}: ${text}`);
  }
  #consoleLine(text, place = '') {
    if (/GPU stall due to ReadPixels/.test(text)) return; // space is drawn and composed by the processor here
    const expected = this.options.expect ?? {};
    if ((expected.console ?? []).some((pattern) => pattern.test(text))) return;
    const status = /^Failed to load resource: .*status of (\d+)/.exec(text);
    if (status && (expected.status ?? []).includes(Number(status[1]))) return;
    this.#fault(`on the console: ${text}${place ? ` (${place})` : ''}`);
  }

  async #watch() {
    this.page.on('console', (line) => this.#consoleLine(line.text(), line.location().url));
    this.page.on('pageerror', (error) => this.#fault(`an uncaught error: ${error.stack ?? error}`));
    this.page.on('crash', () => this.#fault('the page crashed'));
    this.cdp = await this.context.newCDPSession(this.page);
    this.cdp.on('Audits.issueAdded', ({ issue }) => {
      if (issue.code === 'ContentSecurityPolicyIssue') this.#fault(`against the policy: ${JSON.stringify(issue.details.contentSecurityPolicyIssueDetails)}`);
    });
    this.cdp.on('Network.requestWillBeSent', ({ requestId, request, type, redirectResponse }) => {
      if (redirectResponse) this.#end(requestId);
      const url = new URL(request.url);
      if (url.protocol === 'blob:' || url.protocol === 'data:') return;
      if (url.origin !== this.service.url) this.#fault(`a request to ${url.origin}`);
      const entry = { url: url.pathname + url.search, method: request.method, type, status: 0, bytes: 0, cached: false };
      entry.again = this.requests.some((other) => other.url === entry.url && other.method === entry.method);
      this.requests.push(entry);
      this.#open.set(requestId, entry);
    });
    this.cdp.on('Network.requestServedFromCache', ({ requestId }) => {
      const entry = this.#open.get(requestId);
      if (entry) entry.cached = true;
    });
    this.cdp.on('Network.responseReceived', ({ requestId, response, type }) => {
      const entry = this.#open.get(requestId);
      if (!entry) return;
      entry.status = response.status;
      entry.type = type;
      entry.cached ||= Boolean(response.fromDiskCache);
      entry.bytes = response.encodedDataLength;
      if (response.status >= 400 && !(this.options.expect?.status ?? []).includes(response.status)) this.#fault(`${entry.method} ${entry.url} answered ${response.status}`);
    });
    this.cdp.on('Network.dataReceived', ({ requestId, encodedDataLength }) => {
      const entry = this.#open.get(requestId);
      if (entry) entry.bytes += encodedDataLength;
    });
    this.cdp.on('Network.loadingFinished', ({ requestId, encodedDataLength }) => this.#end(requestId, encodedDataLength));
    // What a page stops, or leaves behind as it is left, is no fault; what the network lost stands on the console, too.
    this.cdp.on('Network.loadingFailed', ({ requestId }) => this.#end(requestId));
    await Promise.all(['Network', 'Audits', 'Page'].map((domain) => this.cdp.send(`${domain}.enable`)));
  }
  #end(id, bytes) {
    const entry = this.#open.get(id);
    if (entry && bytes !== undefined && !entry.cached) entry.bytes = bytes;
    this.#open.delete(id);
  }

  /** Returns the value of an expression in the page; a promise is awaited. */
  async read(expression) {
    const { result, exceptionDetails } = await this.cdp.send('Runtime.evaluate', { expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
    return result.value;
  }

  /** Waits until the page asks for nothing new any more and has drawn: no request was under way, and none began, while it was idle ten times in a row.
   *  Streams of events do not count, nor what is asked once more: pages look for changes again and again. */
  async quiet() {
    const fresh = (requests) => [...requests].filter(({ type, again }) => type !== 'EventSource' && !again).length;
    for (let idle = 0, seen = -1; idle < 10; ) {
      await this.read('new Promise((done) => requestAnimationFrame(() => setTimeout(() => requestIdleCallback(done), 50)))');
      const now = fresh(this.requests);
      idle = fresh(this.#open.values()) || now !== seen ? 0 : idle + 1;
      seen = now;
    }
  }

  /** Returns {count, bytes} of the requests since the `from`th that went over the wire; without `data`, only document, modules, styles and pictures count. */
  traffic({ from = 0, data = true } = {}) {
    const counted = this.requests.slice(from).filter(({ type, cached }) => !cached && (data || !dataTypes.has(type)));
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

  variant() {
    const { size = 'desk', scheme = 'light', lang = 'en' } = this.options;
    return `${size}, ${scheme}, ${lang}`;
  }

  /** Returns the pixels of what a selector or locator finds, as shown: png.mjs. */
  async pixels(target) {
    const locator = typeof target === 'string' ? this.page.locator(target).first() : target;
    return decode(await locator.screenshot({ animations: 'disabled' }));
  }

  locator(selector, options) {
    return this.page.locator(selector, options);
  }

  /** Closes the page; faults that were not expected fail the test. */
  async close({ failing = false } = {}) {
    await this.page.close();
    await this.owned?.close();
    if (!failing) assert.equal(this.faults.length, 0, `${this.faults.length} faults (${this.variant()}):\n${this.faults.join('\n')}`);
  }
}
