// Runs the tests of pages with one browser and one service: run.mjs BAHNWERK [WORD…], those whose file or name has all words. A failed test leaves a picture
// of each of its pages in build/browser.
import { mkdirSync, readdirSync, rmSync } from 'node:fs';
import { availableParallelism, cpus } from 'node:os';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { launch } from './chromium.mjs';
import { root, Service } from './service.mjs';
import { declared } from './support.mjs';
import { Tabs } from './tab.mjs';
import { Visit } from './visit.mjs';

const [path, ...words] = process.argv.slice(2);
if (!path) throw new Error('run.mjs BAHNWERK [WORD…]');
const binary = resolve(path), here = dirname(fileURLToPath(import.meta.url)), pictures = join(root, 'build/browser');
const started = Date.now();
const seconds = (from) => ((Date.now() - from) / 1000).toFixed(1) + ' s';

for (const file of readdirSync(here).filter((name) => name.endsWith('.test.mjs')).sort()) {
  const before = declared.length;
  await import(pathToFileURL(join(here, file)));
  for (const each of declared.slice(before)) each.name = `${file.replace('.test.mjs', '')}: ${each.name}`;
}
const chosen = declared.filter(({ name }) => words.every((word) => name.includes(word)));
if (chosen.length === 0) throw new Error(`No test has the words ${words.join(' ')}.`);

const stop = async (code) => {
  await Service.removeAll();
  process.exit(code);
};
process.on('SIGINT', () => stop(130));
process.on('SIGTERM', () => stop(143));

rmSync(pictures, { recursive: true, force: true });
const browser = await launch(), tabs = new Tabs(browser);
const start = () => Service.start(binary, '--workers', '2');
const shared = await start();
const failures = [];

async function runTest({ name, run }, service) {
  const begun = Date.now(), visits = [], own = [];
  const visit = async (path, { service: of = service, ...options } = {}) => {
    const opened = await Visit.open(tabs, of, path, options);
    visits.push(opened);
    return opened;
  };
  const startOwn = async (...words) => {
    own.push(await Service.start(binary, ...words));
    return own.at(-1);
  };
  let failure;
  try {
    await run({ service, binary, browser, visit, own: startOwn });
  } catch (error) {
    failure = error;
    mkdirSync(pictures, { recursive: true });
    for (const [i, { page, faults }] of visits.entries()) {
      await page.screenshot({ path: join(pictures, `${name.replace(/\W+/g, '_')}_${i}.png`), fullPage: true, timeout: 20_000 }).catch(() => {});
      if (faults.length) error.message += `\nfaults of the page:\n${faults.join('\n')}`;
    }
  }
  for (const each of visits)
    await each.close({ failing: failure !== undefined }).catch((error) => (failure ??= error));
  for (const each of own) await each.remove();
  console.log(`${failure ? 'FAILED' : 'ok    '} ${seconds(begun).padStart(7)}  ${name}`);
  if (!failure) return;
  failures.push(name);
  console.log(`${failure.stack ?? failure}\n`.replace(/^/gm, '    '));
}

// As many at a time as there are processors. Those that count at a service run one after another, beside the others; their plans take longest.
const counting = chosen.filter(({ counts }) => counts), others = chosen.filter(({ counts }) => !counts);
const lanes = Math.min(4, availableParallelism?.() ?? cpus().length);
const lane = async (tests, service) => {
  for (let next; (next = tests.shift()); ) await runTest(next, service);
};
const countLane = async () => counting.length > 0 && lane(counting, await start());
await Promise.all([countLane().then(() => lane(others, shared)), ...Array.from({ length: lanes - 1 }, () => lane(others, shared))]);

await browser.close();
if (failures.length) console.log(`Failed: ${failures.join('; ')}. Pictures of their pages: ${pictures}`);
console.log(`${chosen.length - failures.length} of ${chosen.length} tests of pages passed in ${seconds(started)}`);
await stop(failures.length ? 1 : 0);
