import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load } from './support.mjs';

const { PlaybackClock, rowsPerSecond } = await load('path/clock.ts');
const { Slices, stepFor, valuesAt, sliceRows } = await load('path/slices.ts');
const { Program, toolsOf, windowSegments } = await load('path/program.ts');

test('a playback by time takes the time of the motion, divided by its speed', () => {
  const clock = new PlaybackClock(10001, 0.001);
  clock.start();
  clock.tick(5000);
  for (let now = 5000; now <= 6000; now += 20) clock.tick(now);
  assert.ok(Math.abs(clock.row - 1000) < 1e-6);
  clock.speed = 0.1;
  for (let now = 6000; now <= 7000; now += 20) clock.tick(now);
  assert.ok(Math.abs(clock.row - 1100) < 1e-6);
  clock.speed = 100;
  for (let now = 7000; now <= 7200; now += 20) clock.tick(now);
  assert.deepEqual([clock.row, clock.playing], [10000, false]);
  clock.start();
  assert.equal(clock.row, 0);
});

test('a frame that comes late does not jump', () => {
  const clock = new PlaybackClock(100001, 0.001);
  clock.start();
  clock.tick(0);
  clock.tick(60000);
  assert.ok(Math.abs(clock.row - 250) < 1e-6);
});

test('by rows, the same number goes by in every second; by lines each takes the same time', () => {
  const rows = new PlaybackClock(1000, 0.001);
  rows.by = 'row';
  rows.start();
  for (let now = 0; now <= 1000; now += 100) rows.tick(now);
  assert.ok(Math.abs(rows.row - rowsPerSecond) < 1e-6);

  const lines = [{ first: 0, end: 10 }, { first: 10, end: 510 }, { first: 510, end: 999 }], clock = new PlaybackClock(1000, 0.001);
  const line = (row) => lines.find(({ end }) => row < end) ?? null;
  clock.by = 'line';
  clock.start();
  for (let now = 0; now <= 1000; now += 100) clock.tick(now, line);
  assert.ok(Math.abs(clock.row - 10) < 1e-6);
  for (let now = 1000; now <= 1500; now += 100) clock.tick(now, line);
  assert.ok(Math.abs(clock.row - 260) < 1e-6);
  // A line that is not known yet holds the playback.
  const held = new PlaybackClock(1000, 0.001);
  held.by = 'line';
  held.start();
  for (let now = 0; now <= 1000; now += 100) held.tick(now, () => null);
  assert.deepEqual([held.row, held.playing], [0, true]);
});

test('values lie between the rows of a slice, and nowhere outside', () => {
  const slice = { first: 100, every: 10, count: 3, names: ['x', 'y'], values: Float32Array.from([0, 5, 10, 5, 10, 25]) }, out = new Float64Array(2);
  assert.deepEqual([...valuesAt(slice, 100, out)], [0, 5]);
  assert.deepEqual([...valuesAt(slice, 115, out)], [10, 15]);
  assert.deepEqual([...valuesAt(slice, 120, out)], [10, 25]);
  assert.equal(valuesAt(slice, 99, out), null);
  assert.equal(valuesAt(slice, 121, out), null);
});

test('slices are asked for once, and the next one before it is needed', async () => {
  const asked = [];
  const slices = new Slices(100000, async (first, every, count) => {
    asked.push([first, every, count]);
    return { first, every, count, names: ['x'], values: new Float32Array(count) };
  });
  const settled = () => new Promise((done) => setImmediate(done));
  assert.equal(slices.at(0, 1000), null);
  assert.equal(slices.at(1, 1000), null);
  await settled();
  assert.deepEqual(asked, [[0, stepFor(1000), sliceRows / stepFor(1000)]]);
  assert.notEqual(slices.at(2, 1000), null);
  assert.equal(asked.length, 1);
  assert.notEqual(slices.at(8000, 1000), null);
  await settled();
  assert.equal(asked.length, 2);
  assert.notEqual(slices.at(8100, 1000), null);
  assert.notEqual(slices.at(17000, 1000), null);
  assert.equal(asked.length, 2);
  // What would be played in less than a second is drawn on the chords of the picture.
  assert.equal(slices.at(90000, 1e6), null);
  assert.equal(asked.length, 2);
});

test('after a failure nothing is asked for during some frames', async () => {
  let asked = 0;
  const slices = new Slices(1000, async () => {
    ++asked;
    throw new Error('no service');
  });
  for (let frame = 0; frame < 100; ++frame) {
    slices.at(0, 100);
    await new Promise((done) => setImmediate(done));
  }
  assert.equal(asked, 1);
});

// 30 000 segments; every line has two, and the speed changes a thousandfold on the way.
const segments = [];
for (let k = 0, time = 0; k < 30000; ++k) {
  const length = k < 15000 ? 1e-3 : 1;
  segments.push({ segment: k, line: Math.floor(k / 2) + 1, text: `G1 X${k}`, mode: 'cut', start_time: time, end_time: time + length, length: 1, feed: null, time: length });
  time += length;
}
const end = segments[segments.length - 1].end_time, cycle = 0.0005, rows = Math.round(end / cycle) + 1;
function program() {
  const asked = [];
  const list = new Program(rows, cycle, async (first, count) => {
    asked.push(first);
    return { first, total: segments.length, blocks: segments.slice(first, first + count) };
  });
  const idle = () => new Promise((done) => { const wait = (left) => (left ? setImmediate(wait, left - 1) : done()); wait(200); });
  return { list, asked, idle };
}

test('the line of any row is found by a few questions', async () => {
  for (const row of [0, 3, 29999, 30001, 5_000_000, rows - 1]) {
    const { list, asked, idle } = program();
    list.at(row);
    await idle();
    const visit = list.at(row), time = row * cycle, of = segments.find(({ end_time }) => time < end_time - 1e-9) ?? segments[segments.length - 1];
    assert.equal(visit.number, of.line, `row ${row}`);
    assert.ok(visit.first <= row && row < visit.end);
    assert.ok(asked.length <= 14, `${asked.length} questions`);
  }
});

test('segments of a line that follow one another are one visit, and a step within the window asks nothing', async () => {
  const { list, asked, idle } = program();
  list.at(0);
  await idle();
  assert.equal(asked.length, 1);
  assert.equal(list.visits.length, windowSegments / 2);
  assert.deepEqual([list.visits[0].first, list.visits[0].end, list.visits[1].first], [0, 4, 4]);
  list.at(8);
  await idle();
  assert.equal(asked.length, 1);
});

test('the tool of a line is the last T word up to it, outside of comments', () => {
  const tools = toolsOf('%\nT1 M6\nG0 X0 (T9 is broken)\n; T8\nG1 X5\nN70T12\nG1 Y2');
  assert.deepEqual([1, 2, 3, 4, 5, 6, 7].map(tools), [0, 1, 1, 1, 1, 12, 12]);
});
