// The list of jobs: pages put together without gaps, and one action on many jobs.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load } from './support.mjs';

const { JobList } = await load('jobs/list.ts'), { forAll, collect, possible, requestOf } = await load('jobs/bulk.ts');

const id = (number) => String(number).padStart(4, '0');
const job = (number, state = 'succeeded') => ({ id: id(number), state, kind: 'contour', name: null, reference: null });
/** What the service answers: at most `size` of the jobs that are there, newest first, behind the cursor. */
const page = (numbers, cursor, size, state) => {
  const all = [...numbers].sort((a, b) => b - a).filter((each) => cursor === null || id(each) < cursor);
  return { jobs: all.slice(0, size).map((each) => job(each, state)), next: all.length > size ? id(all[size - 1]) : null, counts: {} };
};
const ids = (list) => list.jobs.map((each) => Number(each.id));

test('pages follow each other, and what comes and goes takes its place', () => {
  const list = new JobList(false);
  let there = [10, 9, 8, 7, 6, 5, 4, 3, 2, 1];
  list.merge(null, page(there, null, 4));
  assert.deepEqual([ids(list), list.next], [[10, 9, 8, 7], id(7)]);
  list.merge(list.next, page(there, list.next, 4));
  assert.deepEqual([ids(list), list.next], [[10, 9, 8, 7, 6, 5, 4, 3], id(3)]);
  there = [12, 11, ...there.filter((each) => each !== 9)];
  list.merge(null, page(there, null, 4)); // 12 11 10 8
  assert.deepEqual([ids(list), list.next], [[12, 11, 10, 8, 7, 6, 5, 4, 3], id(3)]);
  list.merge(list.next, page(there, list.next, 4));
  assert.deepEqual([ids(list), list.next], [[12, 11, 10, 8, 7, 6, 5, 4, 3, 2, 1], null]);
  there = there.filter((each) => each > 6);
  list.merge(null, page(there, null, 5)); // 12 11 10 8 7, nothing behind
  assert.deepEqual([ids(list), list.next], [[12, 11, 10, 8, 7], null]);
});

test('more new jobs than a page holds begin the list again', () => {
  const list = new JobList(false);
  list.merge(null, page([3, 2, 1], null, 2));
  list.merge(null, page([9, 8, 7, 6, 3, 2, 1], null, 2));
  assert.deepEqual([ids(list), list.next], [[9, 8], id(8)]);
});

test('jobs that may still change behind the first page are read again, each page once', () => {
  const list = new JobList(false);
  list.merge(null, page([9, 8, 7, 6, 5, 4, 3, 2, 1], null, 9));
  for (const at of [3, 4, 7]) list.jobs[at].state = 'running';
  assert.deepEqual(list.unsettled(3), [id(7), id(3)]);
  assert.deepEqual(list.unsettled(9), []);
});

test('an action is possible by the state of a job, and has its request', () => {
  const states = ['queued', 'running', 'succeeded', 'failed', 'cancelled'];
  assert.deepEqual(states.map((state) => possible('cancel', state)), [true, true, false, false, false]);
  assert.deepEqual(states.map((state) => possible('retry', state)), [false, false, false, true, true]);
  assert.deepEqual(states.map((state) => possible('delete', state)), [true, false, true, true, true]);
  assert.deepEqual(requestOf('delete', 'x'), { method: 'DELETE', path: '/v1/jobs/x' });
  assert.deepEqual(requestOf('retry', 'x'), { method: 'POST', path: '/v1/jobs/x/retry' });
});

test('an action on many keeps at its number at a time, tells refusals and stops', async () => {
  let running = 0, most = 0, told = 0;
  const act = async (each) => {
    most = Math.max(most, ++running);
    await new Promise((resolve) => setImmediate(resolve));
    --running;
    if (each === 'c') throw new Error('no');
  };
  const all = await forAll(['a', 'b', 'c', 'd', 'e'], act, 2, () => false, () => ++told);
  assert.deepEqual(all, { done: 4, left: 0, refused: [{ id: 'c', reason: 'no' }] });
  assert.equal(most, 2);
  assert.equal(told, 5);
  let count = 0;
  const stopped = await forAll(['a', 'b', 'd', 'e'], async () => void ++count, 1, () => count >= 2, () => {});
  assert.deepEqual(stopped, { done: 2, left: 2, refused: [] });
});

test('all that match are read page by page, until somebody stops', async () => {
  const numbers = [7, 6, 5, 4, 3, 2, 1], seen = [];
  const jobs = await collect(async (cursor) => page(numbers, cursor, 3), () => false, (count) => seen.push(count));
  assert.deepEqual(jobs.map((each) => Number(each.id)), numbers);
  assert.deepEqual(seen, [3, 6, 7]);
  assert.equal(await collect(async (cursor) => page(numbers, cursor, 3), () => seen.length > 3, (count) => seen.push(count)), null);
});
