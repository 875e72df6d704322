// What pages cost, in numbers that do not depend on a clock: requests, bytes over the wire, rows of setpoints that the service reads, segments drawn.
import { assert, longSheet, longWinding, test } from './support.mjs';

const kB = 1000;
const rowsRead = (service) => service.metric('bahnwerk_setpoint_rows_read_total');

function atMost(what, value, limit, list = []) {
  assert.ok(value <= limit, `${what}: ${value}, at most ${limit}\n${list.join('\n')}`);
}

/** Opens a page with an empty cache and returns it when all is drawn. */
async function opened(visit, path, selector) {
  const page = await visit(path, { fresh: true });
  await page.locator(selector).filter({ visible: true }).first().waitFor();
  await page.quiet();
  return page;
}

async function drawnSegments(page) {
  const segments = await page.locator('html').getAttribute('data-segments');
  assert.ok(segments, 'the page does not say how many segments it drew: <html data-segments>');
  return Number(segments);
}

test('a million rows: few requests, bytes, rows and segments, whole and zoomed in', { counts: true }, async ({ service, visit }) => {
    const { id } = await service.planned(longSheet());
    let rows = await rowsRead(service);
    const page = await opened(visit, `/jobs/${id}`, '#curves canvas');
    const { count, bytes, list } = page.traffic();
    atMost('requests', count, 9, list); // and one for the favicon
    atMost('bytes', bytes, 800 * kB, list);
    atMost('rows read', (await rowsRead(service)) - rows, 20_000);
    atMost('segments drawn', await drawnSegments(page), 30_000);
    // By the wheel from the whole down to some hundred rows, each step by itself.
    const curves = page.locator('#curves canvas').first();
    await curves.scrollIntoViewIfNeeded();
    const box = await curves.boundingBox();
    await page.page.mouse.move(box.x + box.width * 0.4, box.y + box.height / 2);
    for (let step = 0; step < 24; ++step) {
      const from = page.requests.length;
      rows = await rowsRead(service);
      await page.page.mouse.wheel(0, -120);
      await page.quiet();
      const cost = page.traffic({ from });
      atMost(`requests of zoom step ${step}`, cost.count, 2, cost.list);
      atMost(`bytes of zoom step ${step}`, cost.bytes, 120 * kB, cost.list);
      atMost(`rows read for zoom step ${step}`, (await rowsRead(service)) - rows, 20_000, cost.list);
      atMost(`segments of zoom step ${step}`, await drawnSegments(page), 30_000);
    }
    assert.ok(page.traffic().count > count, 'zooming in asked for finer data');
  });

for (const [name, document, limit] of [['in the plane', longSheet(), 110], ['in space', 'probe_space.json', 270]])
  test(`the page of a job ${name} is small without its data`, async ({ service, visit }) => {
    const { id } = await service.planned(document);
    const page = await opened(visit, `/jobs/${id}`, '#path canvas');
    const { bytes, list } = page.traffic({ data: false });
    atMost('bytes', bytes, limit * kB, list);
  });

test('a winding of 80 000 rows: few rows are read until all is drawn', { counts: true }, async ({ service, visit }) => {
  const { id } = await service.planned(longWinding());
  const rows = await rowsRead(service);
  const page = await opened(visit, `/jobs/${id}`, '#path canvas');
  await page.locator('#kind').scrollIntoViewIfNeeded();
  await page.locator('#kind h2').first().waitFor();
  await page.quiet();
  atMost('rows read', (await rowsRead(service)) - rows, 20_000, page.traffic().list);
});

test('the list of jobs is small', async ({ own, visit }) => {
  const many = await own('--workers', '1');
  const { id } = await many.planned('line.json');
  for (let i = 0; i < 60; ++i) await many.post({ kind: 'contour', name: `part ${i} of a batch`, reference: `WO-${4700 + i}`, spec: (await many.ask(`/v1/jobs/${id}/spec`)).spec });
  const page = await visit('/', { service: many, fresh: true });
  await page.quiet();
  const { bytes, list } = page.traffic({ data: false });
  atMost('bytes', bytes, 60 * kB, list);
});
