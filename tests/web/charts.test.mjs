// Charts without a page: ticks, intervals, axes, stretches, columns.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load } from './support.mjs';

const { ticks, angleTicks } = await load('charts/ticks.ts');
const { timeTicks, clock } = await load('charts/time_ticks.ts');
const { Envelope, axisRange, fillIntervals, lineOfRows } = await load('charts/intervals.ts');
const { longestStretch, around } = await load('charts/stretches.ts');
const { chartColumns, defaultColumns } = await load('charts/columns.ts');
const { pointsFor } = await load('charts/chart_data.ts');
const { limitLines } = await load('charts/curve.ts');
const { proportional, pathLength } = await load('charts/abscissa.ts');

test('ticks of seconds are told apart down to a microsecond', () => {
  for (const width of [1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 1, 10, 59])
    for (const from of [0, 1 / 3, 152.97]) {
      const { values, step, text } = timeTicks(from, from + width, 8);
      assert.ok(values.length >= 3 && values.length <= 9, `${values.length} ticks of ${width} from ${from}`);
      const texts = values.map(text);
      assert.equal(new Set(texts).size, texts.length, texts.join(' '));
      values.forEach((value, k) => {
        assert.ok(value >= from - 1e-12 && value <= from + width + 1e-12);
        if (k > 0) assert.ok(Math.abs(value - values[k - 1] - step) < step * 1e-6);
        assert.ok(Math.abs(Number(texts[k]) - value) < step * 0.01, `${texts[k]} for ${value}`);
      });
    }
});

test('ticks of long times are whole minutes and hours', () => {
  assert.deepEqual(timeTicks(0, 600, 6).values, [0, 120, 240, 360, 480, 600]);
  assert.deepEqual(timeTicks(3500, 7300, 4).values, [3600, 4800, 6000, 7200]);
  assert.equal(clock(3600), '1:00:00');
  assert.equal(clock(150), '2:30');
});

test('ticks of an empty or endless range are few', () => {
  for (const [from, to] of [[1, 1], [0, Infinity], [NaN, 2]]) assert.ok(ticks(from, to, 5).values.length <= 1);
  assert.deepEqual(angleTicks(0, 360, 8).values, [0, 45, 90, 135, 180, 225, 270, 315, 360]);
});

/** An envelope of rows [first, end) of one column, from functions of the interval. */
function envelope(first, end, starts, least, most) {
  const data = starts.flatMap((row, i) => [row, least(i), most(i)]);
  return new Envelope({ names: ['index', 'a_min', 'a_max'], data: new Float32Array(data), headers: null }, first, end);
}

test('an interval is found by any of its rows', () => {
  const e = envelope(10, 40, [10, 17, 30], (i) => i, (i) => i + 1);
  assert.deepEqual([0, 10, 16, 17, 29, 30, 39, 99].map((row) => e.find(row)), [0, 0, 0, 1, 1, 2, 2, 2]);
  assert.equal(e.row(3), 40);
  assert.deepEqual(e.range('a', 12, 18), [0, 2]);
  assert.equal(e.range('a', 40, 50), null);
  assert.equal(e.range('b', 10, 20), null);
  assert.equal(e.exact, false);
  assert.equal(envelope(3, 5, [3, 4], () => 0, () => 0).exact, true);
});

test('each interval is one rectangle, which reaches its least and largest value and touches the one before', () => {
  const e = envelope(0, 40, [0, 10, 20, 30], (i) => [0, 2, 5, -5][i], (i) => [1, 3, 6, -4][i]);
  const drawn = [];
  const segments = fillIntervals(e, 'a', 0, 40, { x: (row) => row, y: (value) => -value }, 0.1, (...rect) => drawn.push(rect));
  assert.equal(segments, 4);
  assert.deepEqual(drawn, [[0, -1, 10, 1], [10, -3, 10, 2], [20, -6, 10, 3], [30, -5, 10, 10]]);
});

test('intervals narrower than a pixel share a rectangle, so that a picture never has more than pixels', () => {
  const n = 5000, e = envelope(0, n, Array.from({ length: n }, (_, i) => i), (i) => -(i % 7), (i) => i % 5);
  const drawn = [];
  const segments = fillIntervals(e, 'a', 0, n, { x: (row) => row / 10, y: (value) => value }, 1, (...rect) => drawn.push(rect));
  assert.ok(segments <= 500, `${segments} rectangles`);
  for (const [x, , width] of drawn) assert.ok(width >= 1 && x + width <= n / 10 + 1);
});

test('a constant is a line of the least thickness around its value', () => {
  const e = envelope(0, 10, [0, 5], () => 3, () => 3);
  const drawn = [];
  fillIntervals(e, 'a', 0, 10, { x: (row) => row, y: (value) => value }, 2, (...rect) => drawn.push(rect));
  assert.deepEqual(drawn, [[0, 2, 5, 2], [5, 2, 5, 2]]);
});

test('a derivative that the series lacks is a difference, where every row is known', () => {
  const e = new Envelope({ names: ['index', 'ax_min', 'ax_max'], data: new Float32Array([0, 1, 1, 1, 3, 3, 2, 2, 2]), headers: null }, 0, 3, 0.5);
  assert.deepEqual([0, 1, 2].map((i) => e.most(i, 'd:ax')), [4, -2, -2]);
  assert.deepEqual(e.range('d:ax', 0, 3), [-2, 4]);
  assert.equal(new Envelope({ names: ['index', 'ax_min', 'ax_max'], data: new Float32Array([0, 1, 1, 2, 3, 3]), headers: null }, 0, 4, 0.5).has('d:ax'), false);
});

test('a line of few rows passes all of them and their neighbours outside the picture', () => {
  const e = envelope(0, 6, [0, 1, 2, 3, 4, 5], (i) => i, (i) => i);
  const points = [];
  assert.equal(lineOfRows(e, 'a', 2, 4, { x: (row) => row, y: (value) => value }, (x, y) => points.push([x, y])), 3);
  assert.deepEqual(points, [[1, 1], [2, 2], [3, 3], [4, 4]]);
});

test('an axis is never empty and keeps a zero that is near', () => {
  for (const [low, high] of [[0, 0], [5, 5], [1e9, 1e9], [-3, 3], [0, 10], [99, 100], [Infinity, -Infinity]]) {
    const [from, to] = axisRange(low, high);
    assert.ok(to > from && Number.isFinite(from) && Number.isFinite(to));
    if (low <= high) assert.ok(from <= low && to >= high);
  }
  assert.equal(axisRange(1, 10)[0], 0);
  assert.ok(axisRange(99, 100)[0] > 90);
});

test('the longest stretch of a limit is found, and shown with its neighbourhood', () => {
  const index = [0, 10, 20, 30, 40];
  assert.deepEqual(longestStretch(index, [1, 0, 0.6, 0.9, 0], 50), { first: 20, count: 20 });
  assert.deepEqual(longestStretch(index, [0, 0.01, 0, 0, 0.2], 50), { first: 40, count: 10 });
  assert.equal(longestStretch(index, [0, 0, 0, 0, 0], 50), null);
  assert.deepEqual(around({ first: 100, count: 20 }), { first: 80, count: 60 });
});

test('columns of every kind are told apart by axis and derivative', () => {
  const of = (names, kind) => Object.fromEntries(chartColumns(names, names.map(() => 'mm'), kind).map((each) => [each.name, `${each.quantity} ${each.axis}`.trim()]));
  const contour = of(['x', 'y', 'vx', 'vy', 'ax', 'ay', 's', 'v', 'mode', 'block'], 'contour');
  assert.deepEqual(contour, { x: 'position x', y: 'position y', vx: 'velocity x', vy: 'velocity y', ax: 'acceleration x', ay: 'acceleration y', s: 'position', v: 'velocity', 'd:ax': 'jerk x', 'd:ay': 'jerk y', use: 'use' });
  const stages = of(['x', 'vx', 'ax', 'xc', 'xf', 'vxc', 'vxf', 'axc', 'axf'], 'contour');
  assert.equal(stages.axf, 'acceleration xf');
  assert.equal(stages.xc, 'position xc');
  const law = of(['phi', 's', 'v', 'a', 'j'], 'motion_law');
  assert.deepEqual(law, { s: 'position', v: 'velocity', a: 'acceleration', j: 'jerk', 'd:j': 'snap', use: 'use' });
  const winding = of(['q1', 'vq1', 'aq1', 'jq1', 'x', 'phi', 'v', 'brake'], 'winding');
  assert.deepEqual(winding, { q1: 'position q1', vq1: 'velocity q1', aq1: 'acceleration q1', jq1: 'jerk q1', 'd:jq1': 'snap q1', x: 'position x', phi: 'position phi', v: 'velocity', brake: 'other brake', use: 'use' });
  assert.deepEqual(defaultColumns(chartColumns(['x', 'vx', 'ax', 'v'], ['mm', 'mm/s', 'mm/s²', 'mm/s'], 'contour'), 'contour'), ['v', 'ax', 'use']);
});

test('an answer stays below 90 kB and its rows below 20 000, whatever is shown', () => {
  for (const columns of [1, 4, 10, 25]) for (const pixels of [100, 390, 1280, 4000]) {
    const points = pointsFor(pixels, columns);
    assert.ok(points >= 50 && points * 32 < 20_000);
    assert.ok(points * (1 + 2 * columns) * 4 <= 90_000);
  }
});

test('lines of a limit stand in the chart of its own column and unit, per block where it changes', () => {
  const column = { name: 'ax', unit: 'mm/s²', quantity: 'acceleration', axis: 'x' };
  const limit = { id: 3, name: 'acceleration x', unit: 'mm/s²', value: 16, column: 'ax', time: 1, share: 1 };
  assert.deepEqual(limitLines(limit, column, 100), [[0, 100, 16], [0, 100, -16]]);
  assert.deepEqual(limitLines({ ...limit, lowest: -2 }, column, 100), [[0, 100, 16], [0, 100, -2]]);
  assert.deepEqual(limitLines({ ...limit, unit: 'mm/s³' }, column, 100), []);
  assert.deepEqual(limitLines({ ...limit, intervals: [{ first: 5, count: 10, value: 7 }, { first: 15, count: 5, value: null }] }, column, 100), [[5, 15, 7], [5, 15, -7]]);
});

test('rows are mapped to path length and back', () => {
  const time = proportional(0.001);
  assert.equal(time.row(time.value(123)), 123);
  const e = new Envelope({ names: ['index', 's_min', 's_max'], data: new Float32Array([0, 0, 4, 10, 4, 4, 20, 4, 10]), headers: null }, 0, 30);
  const over = pathLength({ whole: e, detail: null, parts: () => [{ envelope: e, from: 0, to: 30 }] }, 0, 30);
  assert.equal(over.value(5), 2);
  assert.equal(over.value(15), 4); // a dwell
  assert.equal(over.value(30), 10);
  assert.equal(over.row(2), 5);
  assert.equal(over.row(7), 25);
});
