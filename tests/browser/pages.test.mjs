// What holds on every page, in both sizes, both schemes, both languages: nothing on the console, nothing against the policy, no request to elsewhere, no
// scrolling sideways, nothing serious or critical for axe. Each visit checks the first three when it closes.
import { assert, colours, example, snake, test } from './support.mjs';

const job = (document) => async (service) => `/jobs/${(await service.planned(document)).id}`;

// A name of 200 characters without a space, with marks that turn the direction of writing.
const strange = { ...example('line.json'), name: '\u202e<b>&amp;\u2067' + 'Ж'.repeat(190), reference: '\u200f' + 'R'.repeat(99) };

async function failed(service) {
  const { id } = await service.post({ ...snake(20000), time_budget: 0.05 });
  const { state } = await service.ended(id);
  assert.equal(state, 'failed');
  return `/jobs/${id}`;
}

const pages = {
  'jobs': async (service) => (await service.planned('bracket.json')) && '/',
  'contour in the plane': job('bracket.json'),
  'coarse and fine': job('parts/fine_sheet.json'),
  'fill factor': job('stator_slot.json'),
  'winding': job('rotor_coil.json'),
  'motion law': job('tolerance_boxes.json'),
  'cam': job('radial_cam.json'),
  'probe path': job('probe_space.json'),
  'a strange name': job(strange),
  'a failed job': failed,
  'a problem': async () => '/problems/infeasible',
  'the form': async () => '/new',
  'the form of a job': async (service) => `/new?from=${(await service.planned('bracket.json')).id}`,
  'a comparison': async (service) => `/compare?a=${(await service.planned('bracket.json')).id}&b=${(await service.planned('line.json')).id}`,
  'a comparison of nothing': async () => '/compare',
  'a page that does not exist': async () => '/nowhere',
};

const sections = new Set(['coarse and fine', 'fill factor', 'winding', 'motion law', 'cam', 'probe path']);

// A page is loaded once in each size and language, by halves in light and in dark, and follows the other scheme. Axe, which takes longest, where all differ.
const loads = [
  { size: 'desk', lang: 'en', schemes: ['light', 'dark'], axe: 'light' },
  { size: 'desk', lang: 'de', schemes: ['dark', 'light'] },
  { size: 'phone', lang: 'en', schemes: ['dark', 'light'] },
  { size: 'phone', lang: 'de', schemes: ['light', 'dark'], axe: 'dark' },
];

/** Fails where a canvas of the kind is blank as it is shown. */
async function expectPictures(page) {
  const picture = await page.pixels('#kind', { scale: 'css' }), section = await page.locator('#kind').boundingBox(), density = picture.width / section.width;
  for (const canvas of await page.locator('#kind canvas:not(.above)').all()) {
    const box = await canvas.boundingBox(), label = await canvas.getAttribute('aria-label');
    const part = picture.part(...[box.x - section.x, box.y - section.y, box.width - 1, box.height - 1].map((each) => Math.floor(each * density)));
    assert.ok(colours(part) > 2, `${label}: blank`);
  }
}

/** Visits a page in all variants; `kind`: whether it has a section of its kind. */
async function visitAll(visit, path, { kind = false, ...options } = {}) {
  for (const { schemes, axe, ...variant } of loads) {
    const page = await visit(path, { ...variant, scheme: schemes[0], ...options });
    await page.quiet();
    assert.equal(await page.locator('html').getAttribute('lang'), variant.lang);
    if (kind) {
      await page.locator('#kind').scrollIntoViewIfNeeded();
      await page.locator('#kind h2').first().waitFor();
      await page.quiet();
    }
    const drawn = {};
    for (const scheme of schemes) {
      await page.scheme(scheme);
      await page.expectNoSidewaysScroll();
      drawn[scheme] = await page.canvases();
      for (const { label, blank } of drawn[scheme]) assert.ok(!blank, `${page.variant()}: ${label}: blank`);
      if (axe !== scheme) continue;
      await page.axe();
      if (kind) await expectPictures(page);
    }
    assert.equal(drawn.light.length, drawn.dark.length);
    drawn.light.forEach(({ label, sum }, k) => assert.notEqual(sum, drawn.dark[k].sum, `${page.variant()}: ${label}: the same in light and dark`));
    await page.close();
  }
}

for (const [name, path] of Object.entries(pages))
  test(name, async ({ service, visit }) => {
    const address = await path(service);
    await visitAll(visit, address, { kind: sections.has(name), ...(address === '/nowhere' ? { expect: { status: [404] } } : {}) });
  });

test('the first open', async ({ own, visit }) => visitAll(visit, '/', { service: await own() }));

// What cannot be used on paper is not printed.
test('a job on paper', async ({ service, visit }) => {
  const page = await visit(await job('bracket.json')(service), { scheme: 'dark' });
  await page.quiet();
  await page.page.emulateMedia({ media: 'print' });
  assert.ok(await page.locator('[data-verdict]').isVisible());
  assert.equal(await page.locator('button').filter({ visible: true }).count(), 0, 'buttons on paper');
});
