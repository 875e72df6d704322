// Pages that stay open: many at once, and while the service is away.
import { assert, lasting, snake, test, yielding } from './support.mjs';
import { settings } from './chromium.mjs';

const refused = { console: [/ERR_(CONNECTION_REFUSED|CONNECTION_RESET|EMPTY_RESPONSE|INCOMPLETE_CHUNKED_ENCODING)/] };

// A browser has six connections to a service for all its tabs.
test('seven tabs of a running job, and of the list, are all alive', async ({ own, browser, visit }) => {
  const service = await own(...yielding);
  const { id } = await service.post(lasting());
  const context = await browser.newContext(settings());
  const tabs = [];
  for (let i = 0; i < 7; ++i) for (const path of [`/jobs/${id}`, '/']) tabs.push(await visit(path, { service, context }));
  for (const tab of tabs) await tab.locator('.state.running').first().waitFor();
  await service.ask(`/v1/jobs/${id}/cancel`, { method: 'POST' });
  for (const tab of tabs) {
    await tab.page.bringToFront();
    await tab.locator('.state.cancelled').first().waitFor();
  }
  for (const tab of tabs) await tab.close();
  await context.close();
});

test('a list goes on when the service has come back', async ({ own, visit }) => {
  const service = await own('--workers', '1');
  await service.planned('line.json');
  const page = await visit('/', { service });
  await page.locator('.state.succeeded').first().waitFor();
  await page.quiet();
  page.expect(refused);
  await service.end();
  await page.page.getByRole('alert').filter({ visible: true }).first().waitFor();
  await service.resume();
  const { id } = await service.planned({ ...snake(10), name: 'after the pause' });
  await page.locator(`a[href="/jobs/${id}"]`).first().waitFor();
  await page.page.getByRole('alert').filter({ visible: true }).first().waitFor({ state: 'hidden' });
});

test('the page of a job goes on when the service has come back', async ({ own, visit }) => {
  const service = await own(...yielding);
  const { id } = await service.post(lasting());
  const page = await visit(`/jobs/${id}`, { service });
  await page.locator('.state.running').first().waitFor();
  page.expect(refused);
  await service.end('SIGKILL');
  await service.resume();
  await service.ask(`/v1/jobs/${id}/cancel`, { method: 'POST' });
  await page.locator('.state.cancelled').first().waitFor();
  assert.equal((await service.job(id)).state, 'cancelled');
});
