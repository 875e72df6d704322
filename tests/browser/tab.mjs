// Tabs of the browser. Visits use them one after another: another page in a tab costs a quarter of what a new tab of a new context costs.
import { settings } from './chromium.mjs';

export const longest = 600_000 * Number(process.env.SLOWER ?? 1); // ms; a test waits for what has to happen, this ends what never will

export class Tab {
  visit = null; // which is told what happens

  /** `options`: size, scheme, lang (chromium.mjs); context: a context of Playwright to share, or further settings of a new one. */
  static async open(browser, options) {
    const tab = new Tab(), shared = options.context && 'newPage' in options.context;
    tab.context = shared ? options.context : await browser.newContext({ ...settings(options), ...options.context });
    if (!shared) tab.owned = tab.context;
    tab.context.setDefaultTimeout(longest);
    tab.page = await tab.context.newPage();
    tab.cdp = await tab.context.newCDPSession(tab.page);
    tab.page.on('console', (line) => tab.visit?.consoleLine(line.text(), line.location().url));
    tab.page.on('pageerror', (error) => tab.visit?.fault(`an uncaught error: ${error.stack ?? error}`));
    tab.page.on('crash', () => tab.visit?.fault('the page crashed'));
    tab.cdp.on('Audits.issueAdded', ({ issue }) => {
      if (issue.code === 'ContentSecurityPolicyIssue') tab.visit?.fault(`against the policy: ${JSON.stringify(issue.details.contentSecurityPolicyIssueDetails)}`);
    });
    for (const event of ['requestWillBeSent', 'requestServedFromCache', 'responseReceived', 'dataReceived', 'loadingFinished', 'loadingFailed'])
      tab.cdp.on(`Network.${event}`, (values) => tab.visit?.network[event](values));
    await Promise.all(['Network', 'Audits', 'Page'].map((domain) => tab.cdp.send(`${domain}.enable`)));
    return tab;
  }

  /** Leaves the page: what it still asks for or says concerns nobody. */
  async leave() {
    this.visit = null;
    await this.page.goto('about:blank');
    await this.context.clearCookies();
  }

  async close() {
    await this.page.close();
    await this.owned?.close();
  }
}

/** The tabs of a run. One that is free is used again by a visit of the same size and language, unless that names a context or wants a fresh one. */
export class Tabs {
  #free = new Map(); // size and language → tabs
  constructor(browser) {
    this.browser = browser;
  }
  async take(options) {
    const { size = 'desk', scheme = 'light', lang = 'en', context, fresh = false } = options, key = context || fresh ? null : `${size} ${lang}`;
    const tab = this.#free.get(key)?.pop() ?? (await Tab.open(this.browser, options));
    tab.key = key;
    await tab.page.emulateMedia({ media: null, colorScheme: scheme });
    return tab;
  }
  async give(tab) {
    if (tab.key === null) return tab.close();
    await tab.leave();
    if (!this.#free.has(tab.key)) this.#free.set(tab.key, []);
    this.#free.get(tab.key).push(tab);
  }
}
