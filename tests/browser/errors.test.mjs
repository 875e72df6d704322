// What a browser meets where something is wrong: pages that say what to do.
import { assert, test } from './support.mjs';

for (const [address, status, says] of [['/jobs/nobody', 404, 'There is no job nobody'], ['/?state=lost', 422, '/query/state'], ['/nothing', 404, 'nothing at /nothing']])
  test(`${address} is a page`, async ({ service, visit }) => {
    for (const [lang, what] of [['en', 'What to do'], ['de', 'Was zu tun ist']]) {
      const page = await visit(address, { lang, size: 'phone', expect: { status: [status], console: [new RegExp(String(status))] } });
      await page.locator('h2').filter({ hasText: what }).waitFor();
      assert.match(await page.locator('main').innerText(), new RegExp(says.replace(/[?]/g, '\\?')));
      await page.expectNoSidewaysScroll();
      await page.axe();
      await page.close();
    }
    await service.ask('/v1/jobs');
  });
