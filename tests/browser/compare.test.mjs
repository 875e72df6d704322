// Two jobs side by side.
import { assert, colours, example, test } from './support.mjs';

const slower = () => {
  const document = example('bracket.json');
  document.name = 'bracket, half the acceleration';
  for (const axis of Object.values(document.spec.machine.axes)) if (axis.acceleration) axis.acceleration /= 2;
  return document;
};
const pair = async (service) => `/compare?a=${(await service.planned('bracket.json')).id}&b=${(await service.planned(slower())).id}`;

test('two plans of one part: which is faster, where, at one cursor', async ({ service, visit }) => {
  const page = await visit(await pair(service));
  await page.locator('[data-verdict]').filter({ hasText: 'B takes' }).waitFor();
  await page.locator('#compare canvas').first().waitFor();
  await page.quiet();
  assert.ok(colours(await page.pixels('#compare canvas')) > 2);
  await page.page.keyboard.press('ArrowRight');
  await page.locator('.told').filter({ hasText: 'Δt =' }).waitFor();
  await page.page.keyboard.press('+');
  const link = await page.address(), read = await page.locator('.told').innerText();
  assert.match(link.hash, /at=.*from=|from=.*at=/);
  await page.close();
  // The link carries everything.
  const again = await visit(link.pathname + link.search + link.hash);
  await again.locator('.told').filter({ hasText: read }).waitFor();
  assert.equal(await again.locator('#compare tr').filter({ hasText: 'duration' }).first().count(), 1);
  await again.close();
});

test('plans of different kinds, a job that is not there, and none chosen are told plainly', async ({ service, visit }) => {
  const a = (await service.planned('bracket.json')).id, b = (await service.planned('tolerance_boxes.json')).id;
  let page = await visit(`/compare?a=${a}&b=${b}`);
  await page.locator('.remark').filter({ hasText: 'different kinds' }).waitFor();
  assert.equal(await page.locator('#compare canvas').count(), 0);
  await page.close();
  page = await visit(`/compare?a=${a}&b=nothing`, { expect: { status: [404] } });
  await page.locator('.error').filter({ hasText: 'There is no job' }).waitFor();
  await page.close();
  page = await visit('/compare');
  await page.locator('#compare select').first().selectOption(a);
  await page.locator('#compare select').nth(1).selectOption(b);
  await page.page.getByRole('button', { name: 'Compare', exact: true }).click();
  await page.locator('[data-verdict]').waitFor();
  await page.close();
});
