import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load } from './support.mjs';

const { readPath, chordSpeeds, placeAt, vertexBefore, extentsOf } = await load('path/path_data.ts');
const { countAtMost } = await load('base/search.ts');
const { pick } = await load('path/picking.ts');
const { PlaneView } = await load('path/projection.ts');
const { sequential, speedRange, colouring, steps } = await load('path/colours.ts');
const { chordsByColour } = await load('path/drawing.ts');
const { needsPart, partQuery, addIntervals } = await load('path/source.ts');

// row, begin, x, y, v, mode: a rapid to (10, 0), a cut to (10, 10), another polyline from row 400.
const vertices = [[0, 1, 0, 0, 0, 0], [100, 0, 10, 0, 900, 0], [300, 0, 10, 10, 50, 1], [400, 1, 20, 20, 50, 1], [4000000000, 0, 30, 20, 100, 1]];
const names = ['row', 'begin', 'x', 'y', 'v', 'mode'];
function bytes(list) {
  const out = new ArrayBuffer(list.length * names.length * 4);
  list.forEach((vertex, i) => vertex.forEach((value, k) => (k === 0 ? new Uint32Array(out) : new Float32Array(out)).fill(value, i * names.length + k, i * names.length + k + 1)));
  return out;
}
const path = readPath(names, bytes(vertices), 0.01);
path.columns.speed = Float32Array.from([0, 900, 50, 0, 100]);
const size = { width: 400, height: 400 }, plane = new PlaneView(size, 15, 10, 10);

test('rows of an answer are whole numbers of four bytes, everything else floats', () => {
  assert.deepEqual([...path.rows], [0, 100, 300, 400, 4000000000]);
  assert.deepEqual([path.dimension, ...path.begin], [2, 1, 0, 0, 1, 0]);
  assert.deepEqual([...path.columns.v], [0, 900, 50, 50, 100]);
  assert.deepEqual(extentsOf(path), { low: [0, 0, 0], high: [30, 20, 0] });
});

test('a row lies on the chord of its vertices, and nowhere between two polylines', () => {
  assert.deepEqual(placeAt(path, 50), [5, 0, 0]);
  assert.deepEqual(placeAt(path, 200), [10, 5, 0]);
  assert.deepEqual(placeAt(path, 300), [10, 10, 0]);
  assert.equal(placeAt(path, 350), null);
  assert.equal(vertexBefore(path, 299), 1);
  assert.equal(countAtMost([1, 2, 2, 5], 2), 3);
});

test('the nearest chord within reach is picked, hidden ones and gaps are not', () => {
  const matrix = plane.matrix(), [sx, sy] = [200 + (10 - 15) * 10, 200 - (5 - 10) * 10];
  assert.deepEqual(pick(path, matrix, sx + 3, sy, 12), { row: 200, distance: 3 });
  assert.equal(pick(path, matrix, sx + 13, sy, 12), null);
  assert.equal(pick(path, matrix, 200, 200 - 5 * 10, 12), null); // between (10, 10) and (20, 20), where no chord is
  const rapid = [200 - 100, 300]; // (5, 0)
  assert.equal(pick(path, matrix, ...rapid, 12).row, 50);
  assert.equal(pick(path, matrix, ...rapid, 12, (i) => path.columns.mode[i] > 0.5), null);
});

const lightness = ([r, g, b]) => {
  const [x, y, z] = [r, g, b].map((c) => c / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
  return 116 * Math.cbrt(0.2126 * x + 0.7152 * y + 0.0722 * z) - 16;
};

test('the lightness of the speed scale grows evenly in both schemes, and stands out from the ground', () => {
  for (const dark of [false, true]) {
    const values = Array.from({ length: 21 }, (_, k) => lightness(sequential(k / 20, dark)));
    const growth = (values[20] - values[0]) / 20;
    for (let k = 1; k <= 20; ++k) assert.ok(values[k] - values[k - 1] > 0.5 * growth && values[k] - values[k - 1] < 1.6 * growth, `${dark}, ${k}`);
    if (dark) assert.ok(values[0] > 25);
    else assert.ok(values[20] < 80);
  }
});

test('the scale spans the speeds of the cuts, and rapids are grey', () => {
  assert.deepEqual(speedRange(path), [50, 100]);
  const palette = { dark: false, rapid: 'grey', other: 'other', distinct: ['a', 'b', 'c'] };
  const { kind, colours } = colouring(path, 'speed', palette, [50, 100], new Map());
  assert.equal(colours[kind[1]], 'grey');
  assert.deepEqual([kind[2], kind[4]], [2, 2 + steps - 1]);
  const limited = { ...path, columns: { ...path.columns, limit: Float32Array.from([7, 7, 3, 3, 9]) } };
  const byLimit = colouring(limited, 'limit', palette, [0, 1], new Map([[7, 'blue'], [3, 'red']]));
  assert.deepEqual([1, 2, 4].map((i) => byLimit.colours[byLimit.kind[i]]), ['blue', 'red', 'other']);
});

test('chords are drawn by colour; what is outside of the picture is left out, rows that are not shown are faint', () => {
  const plain = { kind: new Uint16Array(5), colours: ['c'] };
  const all = chordsByColour(path, plane.matrix(), size, plain, { rapids: true, first: 0, end: 5e9 });
  assert.equal(all.drawn[0].length / 4, 3);
  assert.deepEqual(all.drawn[0].slice(0, 4), [50, 300, 150, 300]);
  const some = chordsByColour(path, plane.matrix(), size, plain, { rapids: false, first: 350, end: 5e9 });
  assert.deepEqual([some.drawn[0].length / 4, some.faint.length / 4], [1, 1]);
  const close = new PlaneView(size, 5, 0, 100);
  assert.equal(chordsByColour(path, close.matrix(), size, plain, { rapids: true, first: 0, end: 5e9 }).drawn[0].length / 4, 1);
});

test('a part is asked for where half a pixel is exceeded, and not again within it', () => {
  const whole = { ...path, tolerance: 0.1 }, box = [0, 0, 10, 10], part = { path: { ...path, tolerance: 0.001 }, box: [-1, -1, 11, 11], scale: 10 };
  assert.equal(needsPart(whole, null, box, 4), false);
  assert.equal(needsPart(whole, null, box, 10), true);
  assert.equal(needsPart(whole, part, box, 10), false);
  assert.equal(needsPart(whole, part, [0, 0, 12, 10], 10), true);
  assert.equal(needsPart(whole, part, [1, 1, 1.5, 1.5], 1000), true);
});

test('a part is asked for within half a pixel, by levels as far as they go, and never for too many vertices', () => {
  const box = [0, 0, 30, 30];
  assert.equal(partQuery({ ...path, tolerance: 1 }, box, 4), 'tolerance=0.1250');
  assert.equal(partQuery({ ...path, tolerance: 1 }, box, 40), 'points=1200');
  const dense = { count: 12000, x: new Float32Array(12000).fill(5), y: new Float32Array(12000).fill(5), tolerance: 0.2 };
  assert.equal(partQuery(dense, box, 4), 'tolerance=0.8000');
});

test('a chord has the limit of the interval in which its middle row lies', () => {
  const coloured = { ...path, columns: {} };
  addIntervals(coloured, [0, 60, 250, 1000], { limit: [4, 5, 6, 7] });
  assert.deepEqual([...coloured.columns.limit], [4, 4, 5, 6, 7]);
});

test('the speed of a chord is its length by its time', () => {
  const speeds = chordSpeeds(path, 0.001);
  assert.deepEqual([...speeds].slice(0, 4), [0, 100, 50, 0]);
});
