// Takes the pictures of pages for the documentation: pages.mjs BAHNWERK [FOLDER, by default docs/pictures]. Every page in light colours at 1280 × 800, a job's on
// a phone, too; each file has at most 150 kB.
import { writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { launch } from '../../tests/browser/chromium.mjs';
import { decode, encodeWithPalette } from '../../tests/browser/png.mjs';
import { example, root, Service, snake } from '../../tests/browser/service.mjs';
import { Tabs } from '../../tests/browser/tab.mjs';
import { Visit } from '../../tests/browser/visit.mjs';

const [binary, folder = join(root, 'docs/pictures')] = process.argv.slice(2);
const most = 150_000;
const named = (file, name, reference) => ({ ...example(file), name, reference });
const documents = {
  sheet: named('parts/sheet.ngc', 'sheet', 'WO-4711'),
  stages: { ...named('bracket.json', 'bracket, coarse and fine', 'WO-4712') },
  slot: named('stator_slot.json', 'stator slot', 'WO-4713'),
  coil: named('rotor_coil.json', 'rotor coil', 'WO-4714'),
  law: named('tolerance_boxes.json', 'tolerance boxes', 'WO-4715'),
  probe: named('probe_space.json', 'probe path in space', 'WO-4716'),
};
documents.stages.spec.machine = example('machines/md1.json');

const service = await Service.start(resolve(binary), '--workers', '2'), empty = await Service.start(resolve(binary));
const browser = await launch(), tabs = new Tabs(browser);
let failed = false;

/** Takes a picture of what a window shows of `path`, from `selector` on where one is named. */
async function picture(name, path, { of = service, selector, ...options } = {}) {
  const visit = await Visit.open(tabs, of, path, options);
  await visit.quiet();
  if (selector) await visit.read(`document.querySelector(${JSON.stringify(selector)})?.scrollIntoView()`);
  await visit.quiet();
  const file = encodeWithPalette(decode(await visit.page.screenshot({ animations: 'disabled', scale: 'css' })));
  writeFileSync(join(folder, `page_${name}.png`), file);
  console.log(`page_${name}.png: ${(file.length / 1000).toFixed(0)} kB${file.length > most ? ', which is too large' : ''}`);
  failed ||= file.length > most;
  await visit.close().catch((error) => {
    failed = true;
    console.error(`${name}: ${error.message}`);
  });
}

try {
  const ids = {};
  for (const [name, document] of Object.entries(documents)) ids[name] = (await service.planned(document)).id;
  const failing = (await service.ended((await service.post({ ...snake(20000), name: 'a plan that takes too long', time_budget: 0.05 })).id)).id;
  await picture('first_open', '/', { of: empty });
  await picture('jobs', '/');
  await picture('job', `/jobs/${ids.sheet}`);
  await picture('job_phone', `/jobs/${ids.sheet}`, { size: 'phone' });
  await picture('curves', `/jobs/${ids.sheet}`, { selector: '#curves' });
  await picture('verification', `/jobs/${ids.sheet}`, { selector: '#verification' });
  await picture('coarse_fine', `/jobs/${ids.stages}`, { selector: '#kind' });
  await picture('fill_factor', `/jobs/${ids.slot}`, { selector: '#kind' });
  await picture('winding', `/jobs/${ids.coil}`, { selector: '#path' });
  await picture('motion_law', `/jobs/${ids.law}`, { selector: '#kind' });
  await picture('probe_path', `/jobs/${ids.probe}`, { selector: '#path' });
  await picture('failed', `/jobs/${failing}`);
  await picture('new', `/new?from=${ids.sheet}`);
  await picture('compare', `/compare?a=${ids.sheet}&b=${ids.stages}`);
} finally {
  await browser.close();
  await Service.removeAll();
}
process.exit(failed ? 1 : 0);
