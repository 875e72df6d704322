// What a page says about its work: <html data-settled>.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load } from './support.mjs';

const { begin, Delay, NextFrame, working } = await load('base/work.ts');
const dataset = {};
globalThis.document = { documentElement: { dataset } };
const frames = new Map();
globalThis.requestAnimationFrame = (act) => frames.set(frames.size + 1, act).size;
globalThis.cancelAnimationFrame = (frame) => frames.delete(frame);
const settled = () => 'settled' in dataset;
const soon = () => new Promise((done) => setTimeout(done));

test('a page is settled when all that has begun has ended, each once', async () => {
  const one = begin(), other = begin();
  one();
  one();
  await soon();
  assert.ok(!settled());
  other();
  assert.ok(!settled());
  await soon();
  assert.ok(settled());
});

test('what waits for an end and begins something keeps the page busy', async () => {
  let end;
  void working(Promise.resolve())
    .then(() => {})
    .then(() => (end = begin()));
  assert.ok(!settled());
  await soon();
  await soon();
  assert.ok(!settled());
  end();
  await soon();
  assert.ok(settled());
});

test('work that fails has ended, too', async () => {
  await assert.rejects(working(Promise.reject(new Error('lost'))), /lost/);
  await soon();
  assert.ok(settled());
});

test('a delay calls the last of what it was started with, once, and nothing when it is cancelled', async () => {
  const delay = new Delay(5), called = [];
  delay.start(() => called.push('first'));
  delay.start(() => called.push('second'));
  assert.ok(!settled());
  while (!settled()) await soon();
  assert.deepEqual(called, ['second']);
  delay.start(() => called.push('third'));
  delay.cancel();
  while (!settled()) await soon();
  assert.deepEqual(called, ['second']);
});

test('a frame draws once however often it is asked for, and not again after it was drawn now', async () => {
  let drawn = 0;
  const frame = new NextFrame(() => ++drawn);
  frame.ask();
  frame.ask();
  assert.equal(frames.size, 1);
  const [act] = frames.values();
  frames.clear();
  act();
  assert.equal(drawn, 1);
  frame.ask();
  frame.now();
  assert.equal(drawn, 2);
  assert.equal(frames.size, 0);
  await soon();
  assert.ok(settled());
});
