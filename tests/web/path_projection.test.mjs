import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load } from './support.mjs';

const { PlaneView, SpaceView, at, niceLength } = await load('path/projection.ts');
const size = { width: 800, height: 500 }, extents = { low: [-10, 5, 0], high: [190, 55, 30] };
const near = (a, b, tolerance = 1e-9) => a.forEach((value, k) => assert.ok(Math.abs(value - b[k]) <= tolerance, `${a} is not ${b}`));

test('the plane shows all of the extents in its middle, y upwards', () => {
  const view = new PlaneView(size);
  view.fit(extents, 20);
  near(at(view.matrix(), 90, 30, 0), [400, 250]);
  near(at(view.matrix(), -10, 30, 0), [20, 250]);
  assert.ok(at(view.matrix(), 0, 55, 0)[1] < 250);
});

test('a zoom keeps the point below the pointer, a pan moves by its pixels', () => {
  const view = new PlaneView(size);
  view.fit(extents);
  const below = view.toWorld(123, 45);
  view.zoom(123, 45, 7.5);
  near(at(view.matrix(), ...below, 0), [123, 45]);
  view.pan(-30, 12);
  near(at(view.matrix(), ...below, 0), [93, 57]);
  const [x0, y0, x1, y1] = view.box();
  near([...at(view.matrix(), x0, y1, 0), ...at(view.matrix(), x1, y0, 0)], [0, 0, 800, 500]);
});

test('the directions of a view in space are at right angles, and from above it is the plane', () => {
  const view = new SpaceView(size, [1, 2, 3], 2, 0.7, 0.4), { right, up, eye } = view.axes();
  const dot = (a, b) => a.reduce((sum, value, k) => sum + value * b[k], 0);
  near([dot(right, up), dot(up, eye), dot(eye, right), dot(right, right), dot(up, up), dot(eye, eye)], [0, 0, 0, 1, 1, 1]);
  const above = new SpaceView(size, [90, 30, 0], 3, 0, Math.PI / 2), plane = new PlaneView(size, 90, 30, 3);
  near(at(above.matrix(), 100, 20, 17), at(plane.matrix(), 100, 20, 0), 1e-9);
});

test('a turn keeps the target in the middle, a zoom in space the point below the pointer', () => {
  const view = new SpaceView(size);
  view.fit(extents);
  view.orbit(100, -40);
  near(at(view.matrix(), ...view.target), [400, 250]);
  const { right, up } = view.axes(), place = view.target.map((value, k) => value + 20 * right[k] - 9 * up[k]), [sx, sy] = at(view.matrix(), ...place);
  view.zoom(sx, sy, 4);
  near(at(view.matrix(), ...place), [sx, sy], 1e-6);
});

test('the box of a view in space has all that it shows, within the extents', () => {
  const view = new SpaceView(size, [50, 30, 10], 20, 0.4, 0.9), [x0, y0, x1, y1] = view.box(extents);
  for (const z of [0, 15, 30])
    for (const [dx, dy] of [[0, 0], [5, 3], [-7, 2]]) {
      const [sx, sy] = at(view.matrix(), 50 + dx, 30 + dy, z);
      if (sx < 0 || sy < 0 || sx > size.width || sy > size.height) continue;
      assert.ok(50 + dx >= x0 && 50 + dx <= x1 && 30 + dy >= y0 && 30 + dy <= y1);
    }
  assert.ok(x0 >= -10 && y0 >= 5 && x1 <= 190 && y1 <= 55);
  assert.deepEqual(new SpaceView(size, [50, 30, 10], 20, 0.4, 0).box(extents), [-10, 5, 190, 55]);
});

test('scale bars have lengths of 1, 2 and 5 times a power of ten', () => {
  for (const [most, length] of [[1, 1], [1.99, 1], [2, 2], [4.9, 2], [5, 5], [9.99, 5], [10, 10], [0.0731, 0.05], [1000, 1000]])
    assert.ok(Math.abs(niceLength(most) / length - 1) < 1e-12, `${most}: ${niceLength(most)}`);
});
