// The page of a job: what it says at first sight, ribbon and curves, verification, jobs that run or have failed.
import { assert, colours, example, lasting, snake, test, yielding } from './support.mjs';

/** Returns what the address carries when the page has settled; `holds` says what that must be. */
async function address(page, holds) {
  const state = Object.fromEntries(new URLSearchParams((await page.address()).hash.slice(1)));
  assert.ok(holds(state), `the address carries ${JSON.stringify(state)}, not ${holds}`);
  return state;
}

for (const [lang, duration, word] of [['en', /3\.31\d s/, 'good'], ['de', /3,31\d s/, 'gut']])
  test(`verdict, duration and the first reason are on the first screen of a phone: ${lang}`, async ({ service, visit }) => {
    const { id } = await service.planned('bracket.json');
    const page = await visit(`/jobs/${id}`, { size: 'phone', lang });
    const verdict = page.locator('[data-verdict]');
    assert.match(await verdict.innerText(), duration);
    assert.ok((await verdict.innerText()).includes(word));
    const box = await verdict.boundingBox();
    assert.ok(box.y + box.height < page.page.viewportSize().height * 0.6, `the verdict ends at ${box.y + box.height}`);
  });

test('without a script the page has verdict, reasons, checks and downloads', async ({ service, visit }) => {
  const { id } = await service.planned('bracket.json');
  const page = await visit(`/jobs/${id}`, { context: { javaScriptEnabled: false } });
  for (const selector of ['[data-verdict] .big', '#why .limits meter', '#why .slowest tr', '#verification .checks meter', '#bound meter', '#downloads a[href*="format=csv"]'])
    assert.ok(await page.locator(selector).count(), selector);
});

test('ribbon and curves are drawn, each with a name for who cannot see it, and as a table', async ({ service, visit }) => {
  const { id } = await service.planned('bracket.json');
  const page = await visit(`/jobs/${id}`);
  await page.quiet();
  for (const selector of ['.ribbon', '.overview', '.chart canvas']) assert.ok(colours(await page.pixels(`#curves ${selector}`)) > 2, `${selector} is blank`);
  for (const canvas of await page.locator('#curves .chart canvas').all()) assert.match(await canvas.getAttribute('aria-label'), /from .* to .*rows 0 to/);
  await page.locator('#curves summary', { hasText: 'table' }).click();
  await page.quiet();
  assert.ok((await page.locator('#curves details table tbody tr').count()) >= 20);
});

test('a limit in the table of reasons shows the place where it holds, and the address carries it', async ({ service, visit }) => {
  const { id } = await service.planned('bracket.json');
  const page = await visit(`/jobs/${id}`);
  await page.locator('#why tr[data-limit] button').first().click();
  const state = await address(page, ({ row, count }) => row && count);
  assert.equal(state.locked, '1');
  const { pathname, hash } = await page.address(), again = await visit(pathname + hash);
  await again.quiet();
  assert.deepEqual(await address(again, ({ row }) => row), state);
  assert.equal(await again.locator('.readout').innerText(), await page.locator('.readout').innerText());
});

test('slowest blocks and places of checks set the cursor', async ({ service, visit }) => {
  const { id } = await service.planned('bracket.json');
  const page = await visit(`/jobs/${id}`);
  await page.locator('#why .slowest button').first().click();
  const block = await address(page, ({ row }) => row);
  await page.locator('#verification td[data-at] button').first().click();
  const check = await address(page, ({ row }) => row && row !== block.row);
  assert.equal(check.locked, '1');
});

test('keys zoom, move the cursor row by row and show the whole again', async ({ service, visit }) => {
  const { id } = await service.planned('bracket.json');
  const page = await visit(`/jobs/${id}`), { keyboard } = page.page;
  await page.quiet();
  const rows = Number(await page.locator('#job').getAttribute('data-rows'));
  await keyboard.press('ArrowRight');
  const { row } = await address(page, (state) => state.row);
  await keyboard.press('ArrowRight');
  await address(page, (state) => Number(state.row) === Number(row) + 1);
  await keyboard.press('ArrowLeft');
  await address(page, (state) => state.row === row);
  await keyboard.press('+');
  const closer = await address(page, (state) => state.count);
  assert.ok(Number(closer.count) <= rows / 2 + 1);
  assert.ok(Number(closer.first) <= Number(row) && Number(row) < Number(closer.first) + Number(closer.count), 'the cursor stays in the picture');
  await keyboard.press('Home');
  await address(page, (state) => !state.count);
  await keyboard.press('Escape');
  await address(page, (state) => !state.row);
});

test('a drag shows what it has covered, a click holds the cursor', async ({ service, visit }) => {
  const { id } = await service.planned('bracket.json');
  const page = await visit(`/jobs/${id}`), { mouse } = page.page;
  await page.quiet();
  const chart = page.locator('#curves .chart canvas').first();
  await chart.scrollIntoViewIfNeeded();
  const rows = Number(await page.locator('#job').getAttribute('data-rows')), box = await chart.boundingBox();
  await mouse.move(box.x + box.width * 0.4, box.y + 20);
  await mouse.down();
  await mouse.move(box.x + box.width * 0.6, box.y + 20, { steps: 3 });
  await mouse.up();
  const part = await address(page, ({ count }) => count);
  assert.ok(Math.abs(Number(part.count) / rows - 0.2) < 0.05, `${part.count} of ${rows} rows`);
  await mouse.click(box.x + box.width / 2, box.y + 20);
  const { row } = await address(page, ({ locked }) => locked);
  assert.ok(Math.abs((Number(row) - Number(part.first)) / Number(part.count) - 0.5) < 0.06);
});

test('columns are chosen by boxes, curves drawn over path length, and a link carries both', async ({ service, visit }) => {
  const { id } = await service.planned('bracket.json');
  const page = await visit(`/jobs/${id}`);
  await page.quiet();
  await page.locator('#curves summary', { hasText: 'curves' }).click();
  await page.locator('#curves input[value=x]').check();
  await page.locator('#curves select').selectOption('s');
  await address(page, ({ x, cols }) => x === 's' && cols?.split(',').includes('x'));
  const { pathname, hash } = await page.address(), again = await visit(pathname + hash);
  await again.quiet();
  assert.equal(await again.locator('#curves select').inputValue(), 's');
  assert.ok(await again.locator('#curves .chart-head', { hasText: 'position x' }).count());
});

test('a law over an angle has its angle below the curves, and no path', async ({ service, visit }) => {
  const { id } = await service.planned('tolerance_boxes.json');
  const page = await visit(`/jobs/${id}`);
  await page.quiet();
  assert.equal(await page.locator('#job').getAttribute('data-unit'), 'deg');
  assert.equal(await page.locator('#curves .chart').count(), 4); // s v a j
  await page.page.keyboard.press('ArrowRight');
  await page.locator('.readout', { hasText: '°' }).waitFor();
});

test('a slot without setpoints has its verdict and no curves', async ({ service, visit }) => {
  const { id } = await service.planned('stator_slot.json');
  const page = await visit(`/jobs/${id}`);
  await page.quiet();
  assert.match(await page.locator('[data-verdict]').innerText(), /\d+ wires/);
  assert.equal(await page.locator('#curves').count(), 0);
});

test('a waiting job shows its place and becomes the planned page without loading again', async ({ own, visit }) => {
  const service = await own(...yielding);
  const before = await service.post(lasting()), { id } = await service.post(snake(200));
  const page = await visit(`/jobs/${id}`, { service });
  await page.locator('#live .times').filter({ hasText: /next/ }).waitFor();
  await service.ask(`/v1/jobs/${before.id}/cancel`, { method: 'POST' });
  await page.locator('#why .limits').waitFor();
  await page.locator('#curves .chart canvas').first().waitFor();
  assert.equal(page.requests.filter(({ type }) => type === 'Document').length, 1);
  assert.equal(await page.locator('#live').count(), 0);
  await page.quiet();
});

test('a running job is cancelled by its button, and can be planned again', async ({ own, visit }) => {
  const service = await own(...yielding);
  const { id } = await service.post(lasting());
  const page = await visit(`/jobs/${id}`, { service });
  await page.locator('#live .stage').filter({ hasText: /\S/ }).waitFor(); // what it does
  await page.locator('#live progress[value]').waitFor();
  await page.locator('#cancel').click();
  await page.locator('#problem').waitFor();
  assert.equal((await service.job(id)).state, 'cancelled');
  await page.locator('#retry').click();
  await page.page.waitForURL((url) => url.pathname !== `/jobs/${id}`);
  await page.locator('#live').waitFor();
});

test('a failed job says what to change and links to its form', async ({ service, visit }) => {
  const { id } = await service.post({ ...snake(20000), time_budget: 0.05 });
  await service.ended(id);
  const page = await visit(`/jobs/${id}`, { lang: 'de' });
  assert.match(await page.locator('#problem').innerText(), /time_budget/);
  assert.match(await page.locator('#problem').innerText(), /Zeit oder Speicher/);
  assert.equal(await page.locator(`#problem a[href="/new?from=${id}"]`).count(), 1);
});

test('what would make a contour faster is planned by a button and shown as bars', async ({ own, visit }) => {
  const service = await own();
  const document = example('bracket.json');
  const { id } = await service.planned(document);
  const page = await visit(`/jobs/${id}`, { service });
  await page.locator('#what-if').click();
  await page.page.waitForURL((url) => url.pathname !== `/jobs/${id}`);
  await page.locator('#why .what-if meter').first().waitFor();
});
