// How fast the page of a job is: medians of fresh browsers, with the machine and its load.
//
//     tests/bench/pages BAHNWERK [--browsers 7] [--only sheet|winding]
//
// verdict      from the navigation's start until the element [data-verdict] is painted
// interactive  until everything is drawn (<html data-segments>) and the page takes the next event
// zoom, first  from a turn of the wheel over #curves canvas until a frame shows the picture moved
// zoom, last   until the curves are drawn with the finer data that it asked for
// zoom, path   until the picture of the path shows what part of it the curves show
// playback     frames per second and milliseconds of script per frame, five seconds from a click on #play
//
// Frames of a browser without a screen come from a timer of 60 Hz, drawn by software. Exit 1: a page lacks what is measured.
import { cpus, loadavg, totalmem } from 'node:os';
import { resolve } from 'node:path';
import { launch, settings } from '../browser/chromium.mjs';
import { longestWinding, longSheet, Service } from '../browser/service.mjs';
import { settled } from '../browser/visit.mjs';

const [path, ...words] = process.argv.slice(2);
const option = (name, otherwise) => (words.includes(name) ? words[words.indexOf(name) + 1] : otherwise);
const browsers = Number(option('--browsers', 7)), only = option('--only', '');
const limits = { verdict: 200, interactive: 1000, 'zoom, first': 100, 'zoom, last': 100, 'zoom, path': null, 'frames/s': 50, 'script/frame': 2 };
const sleep = (ms) => new Promise((done) => setTimeout(done, ms));
const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

// Runs in every page, in a world of its own beside the page's modules; times are milliseconds since the navigation.
const watcher = `
  globalThis.seen = { verdict: null, drawn: [], curves: [], wheel: null, moved: null, frames: 0 };
  const next = (then) => { const { port1, port2 } = new MessageChannel(); port1.onmessage = () => then(performance.now()); port2.postMessage(0); };
  const painted = (then) => requestAnimationFrame(() => next(then));
  let found = false;
  new MutationObserver((changes) => {
    if (!found && document.querySelector('[data-verdict]')) { found = true; painted((now) => (seen.verdict = now)); }
    if (changes.some(({ attributeName }) => attributeName === 'data-segments')) next((now) => seen.drawn.push(now));
    if (changes.some(({ target }) => target.matches?.('#curves .chart canvas'))) next((now) => seen.curves.push(now)); // their descriptions
  }).observe(document, { childList: true, subtree: true, attributes: true, attributeFilter: ['data-segments', 'aria-label'] });
  addEventListener('wheel', (event) => { seen.wheel = event.timeStamp; painted((now) => (seen.moved = now)); }, { capture: true, passive: true });
  const count = () => { ++seen.frames; requestAnimationFrame(count); };
  globalThis.countFrames = () => requestAnimationFrame(count);
`;

/** Opens the page in a fresh browser; returns {figure: value}, and names in `missing` what the page lacks. */
async function measure(url, missing) {
  const browser = await launch(), out = {};
  try {
    const context = await browser.newContext(settings());
    context.setDefaultTimeout(60_000);
    const page = await context.newPage(), cdp = await context.newCDPSession(page);
    for (const domain of ['Page', 'Runtime', 'Performance']) await cdp.send(`${domain}.enable`);
    await cdp.send('Page.addScriptToEvaluateOnNewDocument', { source: watcher, worldName: 'bench' });
    let contextId;
    cdp.on('Runtime.executionContextCreated', ({ context: { name, id } }) => name === 'bench' && (contextId = id));
    const read = async (expression) => (await cdp.send('Runtime.evaluate', { expression, contextId, returnByValue: true, awaitPromise: true })).result.value;
    const metrics = async () => Object.fromEntries((await cdp.send('Performance.getMetrics')).metrics.map(({ name, value }) => [name, value]));
    const has = async (selector) => (await page.locator(selector).count()) > 0 || (missing.add(selector), false);

    await page.goto(url, { waitUntil: 'commit' });
    await page.waitForLoadState('load');
    await read(settled);
    const shown = await read('seen');
    if (await has('[data-verdict]')) out.verdict = shown.verdict;
    if (shown.drawn.length === 0) missing.add('html[data-segments]');
    else out.interactive = shown.drawn.at(-1);

    if (await has('#curves canvas')) {
      const curves = page.locator('#curves canvas').first();
      await curves.scrollIntoViewIfNeeded();
      const box = await curves.boundingBox(), steps = [];
      await page.mouse.move(box.x + box.width * 0.4, box.y + box.height / 2);
      for (let step = 0; step < 8; ++step) {
        await read('seen.drawn = [], seen.curves = [], seen.moved = null');
        await page.mouse.wheel(0, -120);
        await read(settled);
        const { wheel, moved, drawn, curves: finer } = await read('seen');
        steps.push({ first: moved - wheel, last: finer.length ? finer.at(-1) - wheel : NaN, path: drawn.length ? drawn.at(-1) - wheel : NaN });
      }
      for (const each of ['first', 'last', 'path']) out[`zoom, ${each}`] = median(steps.map((step) => step[each]));
    }
    await has('#path canvas');
    if (await has('#play')) {
      await page.locator('#play').click();
      await sleep(500);
      await read('countFrames()');
      const before = await metrics(), frames = await read('seen.frames');
      await sleep(5000);
      const after = await metrics(), drawn = (await read('seen.frames')) - frames;
      out['frames/s'] = drawn / (after.Timestamp - before.Timestamp);
      out['script/frame'] = ((after.ScriptDuration - before.ScriptDuration) / drawn) * 1000;
    }
  } finally {
    await browser.close();
  }
  return out;
}

const documents = Object.entries({ sheet: longSheet(), winding: longestWinding() }).filter(([name]) => !only || name === only);
const service = await Service.start(resolve(path), '--workers', '1');
const load = () => loadavg().map((value) => value.toFixed(1)).join(' ');
console.log(`${cpus().length} × ${cpus()[0].model}, ${(totalmem() / 2 ** 30).toFixed(0)} GiB, Node ${process.version}, load before ${load()}`);
const missing = new Set();
try {
  for (const [name, document] of documents) {
    const { id } = await service.planned(document);
    const { setpoints } = await service.ask(`/v1/jobs/${id}/result?parts=setpoints`);
    const runs = [];
    for (let i = 0; i < browsers; ++i) runs.push(await measure(`${service.url}/jobs/${id}`, missing));
    console.log(`\n${name}: ${setpoints.count} rows, medians of ${browsers} browsers, load ${load()}`);
    for (const [figure, limit] of Object.entries(limits)) {
      const values = runs.map((run) => run[figure]).filter(Number.isFinite);
      if (values.length === 0) {
        console.log(`  ${figure.padEnd(14)} not measured`);
        continue;
      }
      const many = figure.startsWith('frames'), wanted = limit === null ? '' : `; wanted at ${many ? 'least' : 'most'} ${limit}`;
      console.log(`  ${figure.padEnd(14)} ${median(values).toFixed(1).padStart(8)} ${many ? '/s' : 'ms'}   (${values[0].toFixed(1)} to ${values.at(-1).toFixed(1)}${wanted})`);
    }
  }
} finally {
  await service.remove();
}
if (missing.size) console.log(`\nThe page of a job lacks: ${[...missing].join(', ')}`);
process.exit(missing.size ? 1 : 0);
