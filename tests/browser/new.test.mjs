// A job is made on a page: from an example, a file, another job; checked while it is written.
import { readFileSync, readdirSync } from 'node:fs';
import { assert, example, test } from './support.mjs';

const refused = { expect: { status: [422], console: [/422/] } }; // what the check answers to a fault
const good = (page) => page.locator('#verdict .state.succeeded').waitFor();
const field = (page, pointer) => page.locator(`[data-pointer="${pointer}"] > input`);

const descriptions = new URL('../../server/web/texts/descriptions/', import.meta.url);
const german = new Set(readdirSync(descriptions).flatMap((name) => Object.values(JSON.parse(readFileSync(new URL(name, descriptions), 'utf8')))));

for (const name of ['bracket', 'stator_slot', 'rotor_coil', 'radial_cam', 'probe_space'])
  test(`the example ${name} is posted from its form as it is, and described in German`, async ({ own, visit }) => {
    const service = await own('--workers', '0');
    const page = await visit(`/new?example=${name}&lang=de`, { service });
    await good(page);
    const said = await page.read(`[...document.querySelectorAll('#form .help p, #form .add[title]')].map((each) => each.title || each.textContent)`);
    assert.ok(said.length > 10, `${said.length} descriptions`);
    assert.deepEqual(said.filter((text) => !german.has(text)), []);
    await page.page.getByRole('button', { name: 'Planen' }).click();
    await page.page.waitForURL(/\/jobs\/[0-9a-f-]{36}/);
    const { jobs } = await service.ask('/v1/jobs');
    assert.deepEqual(await service.ask(`/v1/jobs/${jobs[0].id}/spec`), example(`${name}.json`));
  });

test('faults stand at their fields, and a comma is a decimal sign', async ({ own, visit }) => {
  const service = await own('--workers', '0');
  const page = await visit('/new?example=bracket&lang=de', { service, ...refused });
  await good(page);
  const speed = field(page, '/spec/machine/axes/x/velocity');
  await speed.fill('1.800,5');
  await page.locator('[data-pointer="/spec/machine/axes/x/velocity"] .fault').filter({ hasText: /\S/ }).waitFor();
  await page.locator('.faults').getByRole('button', { name: '/spec/machine/axes/x/velocity' }).click();
  await speed.fill('1800,5');
  await good(page);
  await page.page.getByRole('button', { name: 'Planen' }).click();
  await page.page.waitForURL(/\/jobs\//);
  const { jobs } = await service.ask('/v1/jobs');
  assert.equal((await service.ask(`/v1/jobs/${jobs[0].id}/spec`)).spec.machine.axes.x.velocity, 1800.5);
});

test('a program that is not UTF-8 is read all the same, and its faults name their lines', async ({ own, visit }) => {
  const service = await own('--workers', '0');
  const page = await visit('/new', { service, ...refused });
  await good(page);
  const bytes = Buffer.concat([Buffer.from('G21 G90\nG0 X10 (M'), Buffer.from([0xe4, 0x80]), Buffer.from(')\nG1 X50 F6000\nG987\nG1 Y30\n')]);
  await page.locator('#file').setInputFiles({ name: 'teil.txt', mimeType: 'text/plain', buffer: bytes });
  await page.locator('.notice').filter({ hasText: 'Windows-1252' }).waitFor();
  const program = page.locator('[data-pointer="/spec/contour/gcode"] textarea');
  assert.match(await program.inputValue(), /Mä€/);
  await page.locator('.faults').getByRole('button', { name: 'line 4' }).click();
  await program.fill((await program.inputValue()).replace('G987\n', ''));
  await good(page);
  await page.locator('canvas.outline').waitFor();
});

test('drawings and documents are recognised, whatever they are called', async ({ own, visit }) => {
  const service = await own('--workers', '0');
  const page = await visit('/new', { service });
  await good(page);
  const give = (text) => page.locator('#file').setInputFiles({ name: 'file.bin', mimeType: 'application/octet-stream', buffer: Buffer.from(text) });
  await give(example('parts/bracket.dxf').spec.contour.dxf);
  await page.locator('.notice').filter({ hasText: 'It is a drawing.' }).waitFor();
  await give(JSON.stringify(example('probe_space.json')));
  await field(page, '/spec/speed').waitFor();
  await give('{"kind": ');
  await page.locator('.notice.bad').waitFor();
});

test('a job is posted again with changes, from the field that is to be changed', async ({ own, visit }) => {
  const service = await own('--workers', '0');
  const { id } = await service.post({ ...example('probe_space.json'), name: 'first' });
  const page = await visit(`/new?from=${id}#/spec/tolerance`, { service });
  await good(page);
  await page.locator('[data-pointer="/spec/tolerance"] > input:focus').fill('0.5');
  await good(page);
  await page.page.getByRole('button', { name: 'Plan it' }).click();
  await page.page.waitForURL(/\/jobs\//);
  const { jobs } = await service.ask('/v1/jobs');
  assert.equal(jobs.length, 2);
  const before = await service.ask(`/v1/jobs/${id}/spec`), after = await service.ask(`/v1/jobs/${jobs[0].id}/spec`);
  before.spec.tolerance = 0.5;
  assert.deepEqual(after, before);
});

test('a machine is chosen, and its alternative comes with it', async ({ own, visit }) => {
  const service = await own('--workers', '0');
  const page = await visit('/new?example=stator_coil', { service });
  await good(page);
  await page.locator('#machine').selectOption('vertical');
  await page.locator('[data-pointer="/spec/machine"] > select option:checked').filter({ hasText: 'vertical' }).waitFor({ state: 'attached' });
  assert.ok(!page.requests.some(({ url }) => url.includes('descriptions')), 'a page in English loads no German');
  await page.page.getByRole('button', { name: 'Plan it' }).click();
  await page.page.waitForURL(/\/jobs\//);
  const { jobs } = await service.ask('/v1/jobs');
  assert.deepEqual((await service.ask(`/v1/jobs/${jobs[0].id}/spec`)).spec.machine, await service.ask('/v1/machines/vertical'));
});
