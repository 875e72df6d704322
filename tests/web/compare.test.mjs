// Two motions along one path: where time is won or lost, and figures side by side.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load, readJson } from './support.mjs';

const near = (a, b, tolerance = 1e-9) => assert.ok(Math.abs(a - b) <= tolerance, `${a} is not ${b}`);
// A motion over 100 mm in rows of 1 ms, at so many mm/s in the first and in the second half.
const motion = (alongPath, first, second) => {
  const rows = [], s = [];
  let way = 0, row = 0;
  while (way < 100) {
    rows.push(row++);
    s.push(way);
    way += 0.001 * (way < 50 ? first : second);
  }
  return alongPath(rows, 0.001, s, { row, s: 100 });
};

test('Δt falls where b is faster and rises where it is slower', async () => {
  const { alongPath, difference, places, timeAt } = await load('compare/along.ts');
  const a = motion(alongPath, 100, 100), b = motion(alongPath, 200, 50), both = difference(a, b, 100);
  near(timeAt(a, 25), 0.25, 1e-6);
  near(both.delta[50], -0.25, 2e-3);
  near(both.delta[100], b.duration - a.duration);
  near(both.delta[100], 0.25, 4e-3);
  const [lost, won] = places(both, 5);
  assert.ok(lost.gain > 0 && won.gain < 0);
  near(lost.from, 0.5, 0.02);
  near(won.to, 0.5, 0.02);
  near(lost.gain + won.gain, both.delta[100], 1e-6);
});

test('equal motions differ nowhere', async () => {
  const { alongPath, difference, places } = await load('compare/along.ts');
  const a = motion(alongPath, 100, 70), both = difference(a, a, 200);
  assert.ok(both.delta.every((each) => each === 0));
  assert.deepEqual(places(both, 5), []);
});

test('a rest counts where the path goes on, and paths of different lengths are laid upon each other by their share', async () => {
  const { alongPath, difference, sameLength } = await load('compare/along.ts');
  const a = alongPath([0, 10, 20], 0.1, [0, 10, 10], { row: 30, s: 20 }), b = alongPath([0, 10], 0.1, [0, 20], { row: 20, s: 40 });
  const both = difference(a, b, 4);
  near(both.delta[2], 0);
  near(both.delta[3], -1, 1e-9);
  near(both.delta[4], -1, 1e-9);
  assert.equal(sameLength(a, b), false);
  assert.equal(sameLength(a, alongPath([0], 1, [0], { row: 1, s: 20.01 })), true);
});

test('the way of a motion without a column s is the integral of its speed', async () => {
  const { integrated } = await load('compare/along.ts');
  const { s, end } = integrated([0, 1, 2], 0.5, [0, 2, 4], [0, 2, 4], 2);
  assert.deepEqual([...s], [0, 0.5, 2]);
  near(end, 2);
});

test('figures of both parts stand beside each other, those of one alone, too', async () => {
  const { compareFigures } = await load('compare/figures.ts');
  const list = compareFigures(['summary', 'bound'], { summary: { duration: 2, coarse_smoothness: { x: 4 }, method: 'a' }, bound: { basis: 'a long sentence that is no figure, and so it is left out' } }, { summary: { duration: 3, coarse_smoothness: { x: 2, y: 1 } } });
  assert.deepEqual(list.map((each) => [each.path, each.a, each.b, each.difference, each.share]), [
    ['summary.duration', 2, 3, 1, 0.5], ['summary.coarse_smoothness.x', 4, 2, -2, -0.5], ['summary.coarse_smoothness.y', null, 1, null, null], ['summary.method', 'a', null, null, null],
  ]);
});

test('units come from the schemas of results', async () => {
  const { describedUnit, unitOf } = await load('compare/figures.ts');
  assert.equal(describedUnit('Length of the path, mm.'), 'mm');
  assert.equal(describedUnit('The integral of a_c² dt, of axis xc, mm²/s³.'), 'mm²/s³');
  assert.equal(describedUnit('Iterations, no unit (1).'), '');
  const schema = (kind) => readJson(`schemas/${kind}.result.json`);
  assert.equal(unitOf(schema('contour'), ['summary', 'duration']), 's');
  assert.equal(unitOf(schema('contour'), ['summary', 'coarse_smoothness', 'x']), 'mm²/s³');
  assert.equal(unitOf(schema('winding'), ['summary', 'resistance']), 'Ω');
  assert.equal(unitOf(schema('fill_factor'), ['summary', 'wire', 'copper']), 'mm');
  assert.equal(unitOf(schema('winding'), ['summary', 'coils']), '');
});
