// What somebody meets who has just installed the service.
import { assert, test } from './support.mjs';

for (const { size, lang } of [{ size: 'desk', lang: 'en' }, { size: 'phone', lang: 'de' }])
  test(`an empty store, one click, a plan with its reasons: ${size}, ${lang}`, async ({ own, visit }) => {
    const service = await own();
    const page = await visit('/', { service, size, lang });
    const click = { en: /plan this example/i, de: /dieses beispiel planen/i }[lang];
    await page.page.getByRole('button', { name: click }).first().click();
    await page.locator('[data-verdict]').waitFor();
    // The reasons: what limits the motion, with shares of its time.
    await page.locator('#why').filter({ hasText: /\d+ %/ }).waitFor();
    const { jobs } = await service.ask('/v1/jobs');
    assert.equal(jobs.length, 1);
    assert.equal(jobs[0].state, 'succeeded');
    assert.equal((await page.address()).pathname, `/jobs/${jobs[0].id}`);
  });
