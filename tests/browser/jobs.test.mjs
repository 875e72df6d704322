// The list of jobs: filters, endless pages, and what is done with one job, with those ticked and with all that match.
import { assert, example, snake, test } from './support.mjs';

const shown = (page, count) => page.locator(`html[data-jobs="${count}"]`).waitFor({ state: 'attached' });
const line = (more) => ({ ...example('line.json'), ...more });

test('filters stand in the address, which makes the same list again', async ({ own, visit }) => {
  const service = await own();
  for (const name of ['bracket left', 'bracket right', 'cover']) await service.planned(line({ name }));
  await service.planned({ ...snake(3), name: 'bracket snake' });
  const page = await visit('/', { service });
  await shown(page, 4);
  await page.locator('input[name=text]').fill('bracket');
  await shown(page, 3);
  await page.locator('select[name=sort]').selectOption('oldest');
  await page.locator('tbody tr').first().filter({ hasText: 'bracket left' }).waitFor();
  const address = await page.address();
  assert.equal(address.search, '?text=bracket&sort=oldest');
  const again = await visit(address.pathname + address.search, { service });
  await shown(again, 3);
  assert.equal(await again.locator('input[name=text]').inputValue(), 'bracket');
  await again.locator('#states a[data-state=failed]').click();
  await shown(again, 0);
  await again.locator('#none').waitFor();
  await again.page.goBack();
  await shown(again, 3);
});

test('more than a page of jobs comes by itself, and follows what changes', async ({ own, visit }) => {
  const service = await own('--workers', '0');
  for (let i = 0; i < 60; ++i) await service.post(line({ name: `part ${i}` }));
  const page = await visit('/', { service });
  await shown(page, 50);
  await page.locator('#more').scrollIntoViewIfNeeded();
  await shown(page, 60);
  await page.locator('tbody tr').last().filter({ hasText: 'part 0' }).waitFor();
  await page.locator('tbody tr').last().locator('.status').filter({ hasText: 'next' }).waitFor();
  await service.post(line({ name: 'a new one' }));
  await page.locator('tbody tr').first().filter({ hasText: 'a new one' }).waitFor();
  await shown(page, 61);
  await page.locator('#states a[data-state=queued] b').filter({ hasText: '61' }).waitFor();
});

test('one job is cancelled, planned once more and deleted, after a question', async ({ own, visit }) => {
  const service = await own('--workers', '0');
  const { id } = await service.post(line({ name: 'only' }));
  await service.post(line({ name: 'other' }));
  const page = await visit('/', { service });
  const row = page.locator(`tr[data-id="${id}"]`);
  await row.getByRole('button', { name: /^Cancel/ }).click();
  await page.page.locator('dialog').getByRole('button', { name: 'Change nothing' }).click();
  assert.equal((await service.job(id)).state, 'queued');
  await row.getByRole('button', { name: /^Cancel/ }).click();
  await page.page.locator('dialog').getByRole('button', { name: 'Cancel', exact: true }).click();
  await row.locator('.state.cancelled').waitFor();
  await row.getByRole('button', { name: /^Retry/ }).click();
  await page.page.locator('dialog').getByRole('button', { name: 'Retry', exact: true }).click();
  await page.locator('tr[data-id]').filter({ hasText: 'only' }).locator('.state.queued').waitFor(); // a new job of the same document
  await row.getByRole('button', { name: /^Delete/ }).click();
  await page.page.locator('dialog').getByRole('button', { name: 'Delete', exact: true }).click();
  await row.waitFor({ state: 'detached' });
});

test('all that match are counted, changed and told, and no others', async ({ own, visit }) => {
  const service = await own('--workers', '0');
  for (let i = 0; i < 70; ++i) await service.post(line({ name: i % 7 === 0 ? `keep ${i}` : `go ${i}` }));
  const page = await visit('/?text=go', { service });
  await page.locator('#matching').check();
  await page.locator('#bulk [data-action=cancel]').click();
  await page.page.locator('dialog').getByRole('button', { name: 'Cancel 60' }).click();
  await page.locator('dialog').filter({ hasText: '60 cancelled.' }).getByRole('button', { name: 'Close' }).click();
  await page.locator('#states a[data-state=cancelled] b').filter({ hasText: '60' }).waitFor();
  const { counts } = await service.ask('/v1/jobs');
  assert.deepEqual([counts.cancelled, counts.queued], [60, 10]);
});

test('those ticked by the keyboard are deleted', async ({ own, visit }) => {
  const service = await own('--workers', '0');
  const ids = [];
  for (let i = 0; i < 4; ++i) ids.push((await service.post(line({ name: `part ${i}` }))).id);
  const page = await visit('/', { service });
  await shown(page, 4);
  for (const key of ['j', 'x', 'j', 'x']) await page.page.keyboard.press(key);
  await page.locator('#bulk .count').filter({ hasText: '2 selected' }).waitFor();
  await page.locator('#bulk [data-action=delete]').click();
  await page.page.locator('dialog').getByRole('button', { name: 'Delete 2' }).click();
  await page.page.locator('dialog').getByRole('button', { name: 'Close' }).click();
  await shown(page, 2);
  const { jobs } = await service.ask('/v1/jobs');
  assert.deepEqual(jobs.map((job) => job.id), [ids[1], ids[0]]);
  await page.page.keyboard.press('?');
  await page.locator('dialog').filter({ hasText: 'next job' }).waitFor();
});
