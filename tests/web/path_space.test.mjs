// Bodies of views in space, without a browser.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load } from './support.mjs';

const { drawMoving } = await load('path/space_moving.ts');
const { SpaceView, at } = await load('path/projection.ts');
const { prismEdges } = await load('path/space_bodies.ts');

const square = [[0, 0], [2, 0], [2, 2], [0, 2]];
const round = Array.from({ length: 72 }, (_, k) => [Math.cos((k * Math.PI) / 36), Math.sin((k * Math.PI) / 36)]);

test('a prism has the edges of its faces, and upright ones where its outline turns sharply', () => {
  assert.equal(prismEdges([square], 0, 5).length, 2 * 12);
  assert.equal(prismEdges([round], 0, 5).length, 2 * 144);
  assert.equal(prismEdges([round, square], 0, 5).length, 2 * (144 + 12));
  for (const [x, y, z] of prismEdges([square], -1, 5)) assert.ok(square.some((corner) => corner.join() === [x, y].join()) && (z === -1 || z === 5));
});

/** A pen that notes the lines that it is told to draw. */
function pen() {
  const lines = [], rectangles = [];
  return { lines, rectangles, save() {}, restore() {}, beginPath() {}, closePath() {}, stroke() {}, fill() {},
    moveTo: (x, y) => lines.push([[x, y]]), lineTo: (x, y) => lines.at(-1).push([x, y]), fillRect: (...all) => rectangles.push(all) };
}
const view = new SpaceView({ width: 400, height: 300 }, [10, 20, 30], 2);
const near = (a, b) => a.forEach((each, k) => assert.ok(Math.abs(each - b[k]) < 1e-9, `${a} is not ${b}`));
const needle = { name: 'needle', kind: 'cylinder', moves: 'tool', points: [[-60, 0, 0], [-1, 0, 0]], radius: 1, round_end: true };
const place = { place: [100, 5, 40], coarse: null, phi: 90, psi: 0, row: 0, time: 0 };
const draw = (bodies, where, turns) => {
  const drawn = pen();
  drawMoving(drawn, view, bodies, where, turns, { solid: 'grey', moving: 'blue' });
  return drawn;
};

test('a needle points along its x axis, turned by psi about y and then by phi about z', () => {
  // phi = 90°: x becomes y; psi = 90°: x becomes -z, which phi leaves alone.
  for (const [phi, psi, from, to] of [[0, 0, [40, 5, 40], [99, 5, 40]], [90, 0, [100, -55, 40], [100, 4, 40]], [90, 90, [100, 5, 100], [100, 5, 41]]]) {
    const [line] = draw([needle], { ...place, phi, psi }, true).lines;
    near(line[0], at(view.matrix(), ...from));
    near(line[1], at(view.matrix(), ...to));
  }
});

test('a needle whose direction is not known is not drawn, a head without direction is', () => {
  assert.equal(draw([needle], { ...place, phi: NaN }, true).lines.length, 0);
  const head = { name: 'head', kind: 'points', moves: 'tool', points: [[0, 0, 0]] }, [rectangle] = draw([head], { ...place, phi: NaN }, false).rectangles;
  const [x, y] = at(view.matrix(), ...place.place);
  near(rectangle, [x - 3.5, y - 3.5, 7, 7]);
});

test('what moves with the coarse axes is drawn where these are, what does not move is left out', () => {
  const range = { name: 'fine range', kind: 'extrusion', moves: 'coarse', outline: square, from: 0, to: 1 };
  assert.equal(draw([range], place, false).lines.length, 0);
  const { lines } = draw([range, { ...range, moves: 'none' }], { ...place, coarse: [1, 2, 3] }, false);
  assert.equal(lines.length, 2 + 4);
  near(lines[0][0], at(view.matrix(), 1, 2, 3));
});
