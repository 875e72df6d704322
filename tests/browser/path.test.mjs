// The picture of a path, its playback and its program.
import { assert, colours, example, longSheet, test } from './support.mjs';

// A rectangle of 100 by 60 mm that is cut, and a rapid move to it from (0, 30).
const axis = { velocity: 1000, acceleration: 10000 };
const program = {
  kind: 'contour',
  name: 'rectangle',
  spec: {
    contour: { gcode: 'G90 G21\nG0 X0 Y30\nG0 X50\nG0 Y0\nG1 X100 F6000\nG1 Y60\nG1 X0\nG1 Y0\nG1 X50\nM2\n' },
    machine: { kinematics: 'cartesian', axes: { x: axis, y: axis }, cycle_time: 0.001 },
    planning: { method: 'time_optimal' },
  },
};
const margin = 28; // px around a path that is shown as a whole
const sides = [[25, 0], [75, 0], [100, 30], [50, 60], [0, 15]];

/** Returns where a point, mm, is in the picture, px from its corner, while the whole path is shown. */
async function placing(page) {
  const { width, height } = await page.locator('.path-picture').boundingBox(), inner = [width - 2, height - 2]; // without the frame
  const scale = Math.min((inner[0] - 2 * margin) / 100, (inner[1] - 2 * margin) / 60);
  return (x, y) => [1 + inner[0] / 2 + (x - 50) * scale, 1 + inner[1] / 2 - (y - 30) * scale];
}

/** Returns how far apart the largest and the least of red, green and blue are, at the most colourful pixel within 3 px. */
function strength(pixels, [x, y], density = 1) {
  let most = 0;
  for (let dx = -3; dx <= 3; ++dx)
    for (let dy = -3; dy <= 3; ++dy) {
      const here = pixels.at(Math.round((x + dx) * density), Math.round((y + dy) * density));
      most = Math.max(most, Math.max(...here) - Math.min(...here));
    }
  return most;
}

async function open(service, visit, document, options) {
  const { id } = await service.planned(document);
  const page = await visit(`/jobs/${id}`, options);
  await page.locator('#path #play').waitFor();
  await page.quiet();
  await page.locator('.path-picture').scrollIntoViewIfNeeded();
  return page;
}

for (const size of ['desk', 'phone'])
  test(`the path is drawn where it lies, and rapids can be hidden (${size})`, async ({ service, visit }) => {
    const page = await open(service, visit, program, { size }), density = size === 'phone' ? 2 : 1, white = [255, 255, 255];
    const place = await placing(page), at = (pixels, x, y, dy = 0) => pixels.at(Math.floor(place(x, y)[0] * density), Math.floor(place(x, y)[1] * density) + dy);
    const isWhite = (rgb) => rgb.join() === white.join(), rapid = (pixels) => [-2, -1, 0, 1, 2].some((dy) => !isWhite(at(pixels, 25, 30, dy)));
    let pixels = await page.pixels('.path-picture');
    for (const side of sides) assert.ok(strength(pixels, place(...side), density) > 40, `nothing at ${side}`);
    assert.deepEqual(at(pixels, 75, 45), white);
    assert.ok(rapid(pixels));
    await page.locator('#path-rapids').uncheck();
    await page.quiet();
    pixels = await page.pixels('.path-picture');
    assert.ok(!rapid(pixels));
    assert.ok(strength(pixels, place(75, 0), density) > 40);
  });

test('a click on the path sets the cursor, and shows the line of the program', async ({ service, visit }) => {
  const page = await open(service, visit, program);
  const place = await placing(page), [x, y] = place(100, 30);
  await page.locator('.path-picture').click({ position: { x, y } });
  await page.locator('.path-lines li[aria-current]', { hasText: 'G1 Y60' }).waitFor();
  await page.quiet();
  const text = await page.locator('.path-readout').innerText(), found = /x (\S+) · y (\S+)/.exec(text);
  assert.ok(Math.abs(Number(found[1]) - 100) < 0.01 && Math.abs(Number(found[2]) - 30) < 1, text);
  // A line that is clicked sets the cursor to its begin.
  await page.locator('.path-lines button', { hasText: 'G1 X0' }).click();
  await page.locator('.path-lines li[aria-current]', { hasText: 'G1 X0' }).waitFor();
  await page.quiet();
  assert.match(await page.locator('.path-readout').innerText(), /x (100\.000|99\.9\d\d) · y (60\.000|59\.9\d\d)/);
  assert.match(await page.read('location.hash'), /row=\d+/);
});

test('keys step from line to line', async ({ service, visit }) => {
  const page = await open(service, visit, program);
  const current = (text) => page.locator('.path-lines li[aria-current]', { hasText: text }).waitFor();
  await page.locator('.path-lines button', { hasText: 'G1 Y60' }).click();
  await current('G1 Y60');
  for (const [key, text] of [['.', 'G1 X0'], [',', 'G1 Y60'], [',', 'G1 X100']]) {
    await page.page.keyboard.press(key);
    await current(text);
  }
});

test('a playback goes to the last row and ends', async ({ service, visit }) => {
  const page = await open(service, visit, program);
  await page.locator('#play-speed').selectOption('10');
  await page.locator('#play').click();
  await page.locator('#play[aria-pressed=false]').waitFor();
  await page.quiet();
  const slider = page.locator('#play-position');
  assert.equal(await slider.inputValue(), await slider.getAttribute('max'));
  assert.match(await page.locator('.path-readout').innerText(), /x 50\.000 · y 0\.000/);
  await page.locator('#play-by').selectOption('line');
  await page.locator('#play').click();
  await page.locator('#play[aria-pressed=false]').waitFor();
  await page.locator('.path-lines li[aria-current]', { hasText: 'G1 X50' }).waitFor();
});

test('each colouring has its legend, and stands in the address', async ({ service, visit }) => {
  const page = await open(service, visit, program);
  for (const by of ['limit', 'use', 'block', 'tool', 'speed']) {
    await page.locator('#path-colour').selectOption(by);
    await page.quiet();
    assert.ok(colours(await page.pixels('.path-picture')) > 3, by);
    assert.ok((await page.locator('.path-legend').innerText()).length > 3, by);
    assert.equal((await page.read('location.hash')).includes(`colour=${by}`), by !== 'speed');
  }
});

test('keys move and scale the picture, and Home shows all again', async ({ service, visit }) => {
  const page = await open(service, visit, program);
  const place = await placing(page);
  await page.locator('.path-picture').focus();
  for (const key of ['+', '+', 'ArrowLeft', 'ArrowUp']) await page.page.keyboard.press(key);
  await page.quiet();
  assert.match(await page.read('location.hash'), /plane=/);
  await page.page.keyboard.press('Home');
  await page.quiet();
  assert.doesNotMatch(await page.read('location.hash'), /plane=/);
  const pixels = await page.pixels('.path-picture');
  for (const side of sides) assert.ok(strength(pixels, place(...side)) > 40, `nothing at ${side}`);
});

test('a path in space is drawn in space and in the plane', async ({ service, visit }) => {
  const page = await open(service, visit, example('helix.json'));
  assert.ok(await page.locator('input[name=path-view][value=space]').isChecked());
  assert.equal(await page.locator('.path-picture canvas:visible').count(), 2);
  assert.ok(colours(await page.pixels('.path-picture')) > 10);
  await page.locator('input[name=path-view][value=plane]').check();
  await page.quiet();
  assert.ok(colours(await page.pixels('.path-picture')) > 5);
  assert.match(await page.read('location.hash'), /view=plane/);
});

test('a motion law has no path', async ({ service, visit }) => {
  const { id } = await service.planned('rest_in_rest.json');
  const page = await visit(`/jobs/${id}`);
  await page.quiet();
  assert.equal(await page.locator('.path-picture').count(), 0);
});

test('a zoom into the path of a million rows asks once, and for little', { counts: true }, async ({ service, visit }) => {
  const page = await open(service, visit, longSheet());
  const { width, height } = await page.locator('.path-picture').boundingBox();
  await page.locator('.path-picture').hover({ position: { x: width * 0.4, y: height * 0.4 } });
  await page.quiet();
  for (let step = 0; step < 6; ++step) {
    const from = page.requests.length;
    await page.page.mouse.wheel(0, -700);
    await page.quiet();
    const { count, bytes, list } = page.traffic({ from });
    assert.ok(count <= 1 && bytes <= 120_000, list.join('\n'));
    assert.ok(Number(await page.read('document.documentElement.dataset.segments')) <= 30_000);
  }
});
