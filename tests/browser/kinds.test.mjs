// What a job's page shows of its kind, driven as somebody drives it.
import { assert, example, test } from './support.mjs';

/** Brings the section of the kind into view and waits until it is there. */
async function kindOf(page) {
  await page.locator('#kind').scrollIntoViewIfNeeded();
  await page.locator('#kind h2').first().waitFor();
  await page.quiet();
}

test('fill_factor: a click on the map draws that layout, the slider lays its wires, the address carries both', async ({ service, visit }) => {
  const { id } = await service.planned('stator_slot.json');
  const page = await visit(`/jobs/${id}`);
  await kindOf(page);
  const cell = page.locator('button.heat').nth(7), title = await cell.getAttribute('title');
  await cell.click();
  await page.quiet();
  assert.equal(await cell.getAttribute('aria-pressed'), 'true');
  const most = Number(/: (\d+)/.exec(title)[1]);
  await page.locator('#kind input[type=range]').press('Home');
  await page.locator('#kind output').filter({ hasText: `0 of ${most}` }).waitFor();
  await page.locator('#kind input[type=range]').press('ArrowRight');
  const label = `1 of ${most}`;
  await page.locator('#kind output').filter({ hasText: label }).waitFor();
  const { pathname, search, hash } = await page.address();
  assert.match(hash, /laid=1/);
  await page.close();
  const again = await visit(pathname + search + hash);
  await kindOf(again);
  await again.locator('#kind output').filter({ hasText: label }).waitFor();
  // Sorted by wires: the first row has the most.
  await again.locator('table.sortable thead button').nth(3).click();
  const counts = (await again.locator('table.sortable tbody tr td:nth-child(4)').allInnerTexts()).map(Number);
  assert.deepEqual(counts, [...counts].sort((a, b) => b - a));
  await again.close();
});

test('coarse and fine: five further plans, one click each to compare', async ({ own, visit }) => {
  const service = await own();
  const document = { kind: 'contour', name: 'one', reference: 'trade-1', spec: JSON.parse(JSON.stringify(example('parts/fine_sheet.json').spec)) };
  document.spec.contour = { points: [[0, 0], [30, 0], [30, 20], [10, 30], [0, 0]], closed: false, feed: 300 };
  document.spec.planning = { method: 'time_optimal', corner: { mode: 'blend', tolerance: 0.05 } };
  const { id } = await service.planned(document);
  const page = await visit(`/jobs/${id}`, { service });
  await kindOf(page);
  await page.page.getByRole('button', { name: 'Plan five settings' }).click();
  await page.locator('#kind [role=status]').filter({ hasText: 'All five are done' }).waitFor();
  const { jobs } = await service.ask('/v1/jobs?reference=trade-1');
  assert.equal(jobs.length, 6);
  assert.deepEqual(new Set(jobs.map((each) => each.state)), new Set(['succeeded']));
  await page.locator('#kind summary', { hasText: 'As a table' }).first().click();
  await page.quiet();
  assert.equal(await page.locator('#kind a', { hasText: 'Compare' }).count(), 5);
  await page.close();
});

test('motion_law: the tables of controllers say how far they are from the law', async ({ service, visit }) => {
  const { id } = await service.planned('tolerance_boxes.json');
  const page = await visit(`/jobs/${id}`);
  await kindOf(page);
  await page.page.getByRole('button', { name: 'Measure the differences' }).click();
  await page.page.getByRole('button', { name: 'Measure the differences' }).waitFor({ state: 'detached' });
  const texts = await page.locator('#kind tr:has(a[href*="layout="]) td:last-child').allInnerTexts();
  assert.equal(texts.length, 9);
  assert.ok(texts.every((each) => each !== '…'), texts.join('; '));
  await page.close();
});
