// What the views of kinds compute: splines, outlines, ranges of charts, reasons, regions over time.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load } from './support.mjs';

const near = (a, b, tolerance = 1e-9) => assert.ok(Math.abs(a - b) <= tolerance, `${a} is not ${b}`);

test('de Boor gives the points of a polynomial, at its ends, too', async () => {
  const { splinePoint, splineLine } = await load('kinds/bspline.ts');
  // x = u, y = u² on [0, 4] with a knot at 2: control points by the blossom.
  const spline = { degree: 2, knots: [0, 0, 0, 2, 4, 4, 4], points: [[0, 0], [1, 0], [3, 8], [4, 16]] };
  for (const u of [0, 0.5, 1.9999, 2, 3.3, 4]) {
    const [x, y] = splinePoint(spline, u);
    near(x, u);
    near(y, u * u);
  }
  assert.deepEqual(splinePoint(spline, 9), splinePoint(spline, 4));
  assert.equal(splineLine(spline, 8).length, 9);
});

test('a law in Bernstein form has the derivatives of its polynomial, by time', async () => {
  const { lawLine } = await load('kinds/bernstein.ts');
  // s = x³ over 90 deg, which take 0.5 s.
  const pieces = [{ begin: 0, end: 90, bernstein: [0, 0, 0, 1] }], rate = 180;
  for (const [order, value] of [[0, 1 / 8], [1, (3 / 4) * 2], [2, 3 * 4], [3, 6 * 8]]) {
    const { x, low } = lawLine(pieces, order, rate, 2);
    assert.deepEqual(x, [0, 45, 90]);
    near(low[1], value, 1e-12);
  }
  assert.equal(lawLine(pieces, 4, rate, 2).low[1], 0);
});

test('arcs turn the way they are told to', async () => {
  const { arcAngles, holdOutline } = await load('kinds/outline.ts');
  const { nothing } = await load('kinds/plane.ts');
  const quarter = { to: [0, 1], center: [0, 0], direction: 'ccw' };
  near(arcAngles([1, 0], quarter).to, Math.PI / 2);
  near(arcAngles([1, 0], { ...quarter, direction: 'cw' }).to, -1.5 * Math.PI);
  near(arcAngles([1, 0], { ...quarter, to: [1, 0] }).to, 2 * Math.PI);
  const extent = nothing();
  holdOutline(extent, [{ from: [1, 0], arc: { to: [-1, 0], center: [0, 0], direction: 'ccw' } }, { line: [1, 0] }]);
  near(extent.y1, 1, 1e-9);
  near(extent.y0, 0, 1e-9);
});

test('a plane shows everything in the middle, and its bar is round', async () => {
  const { placing, barLength } = await load('kinds/plane.ts');
  const at = placing({ x0: -10, y0: 0, x1: 10, y1: 5 }, 228, 128);
  near(at.scale, 10);
  near(at.x(-10), 14);
  near(at.x(10), 214);
  near((at.y(0) + at.y(5)) / 2, 64);
  assert.ok(at.y(0) > at.y(5));
  assert.equal(barLength(10, 100), 10);
  assert.equal(barLength(3, 100), 20);
  near(barLength(4000, 100), 0.02, 1e-12);
});

test('axes of charts hold curves, ranges and the limits that are near', async () => {
  const { axisRange, valuesAt } = await load('kinds/chart.ts'), { lastAtMost } = await load('base/search.ts');
  const curve = { name: '', colour: '', x: [0, 1, 2, 3], low: [0, 1, -2, 4] };
  const shown = axisRange({ curves: [curve], rules: [{ value: 5, colour: '' }, { value: 100, colour: '' }] }, 0, 3);
  assert.ok(shown.from < -2 && shown.to > 5 && shown.to < 10);
  assert.ok(axisRange({ curves: [curve] }, 0, 1).to < 1.2);
  assert.ok(axisRange({ curves: [], boxes: [{ x0: 1, x1: 1, y0: -Infinity, y1: 7, colour: '' }] }, 0, 2).to > 7);
  assert.equal(axisRange({ curves: [{ ...curve, low: [0, 1, 2, 3] }], zero: true }, 0, 3).from, 0);
  const flat = axisRange({ curves: [{ ...curve, low: [3, 3, 3, 3] }] }, 0, 3);
  assert.ok(flat.from < 3 && flat.to > 3);
  assert.equal(lastAtMost([0, 1, 1, 2], 1), 2);
  assert.equal(lastAtMost([1, 2], 0), -1);
  assert.deepEqual(valuesAt(curve, 1.5), { low: -0.5, high: -0.5 });
  assert.deepEqual(valuesAt({ ...curve, high: [0, 3, -1, 4] }, 1.5), { low: 1, high: 3 });
  assert.equal(valuesAt(curve, -1), null);
});

test('an envelope is read by its columns, and a curve without spread is a line', async () => {
  const { envelopeOf, curveOf } = await load('kinds/parts.ts');
  const envelope = envelopeOf({ names: ['index', 'x_min', 'x_max', 'v_min', 'v_max'], data: Float32Array.from([0, 1, 1, 2, 3, 64, 5, 5, 7, 9]), headers: new Headers() });
  assert.deepEqual([...envelope.rows], [0, 64]);
  assert.deepEqual([...curveOf(envelope, 'x', envelope.rows, '', '').low], [1, 5]);
  assert.equal(curveOf(envelope, 'x', envelope.rows, '', '').high, undefined);
  assert.deepEqual([...curveOf(envelope, 'v', envelope.rows, '', '').high], [3, 9]);
  assert.equal(curveOf(envelope, 'q9', envelope.rows, '', ''), null);
});

test('ranges of a law are boxes, numbers are dots at the angles of the plan', async () => {
  const { asked } = await load('kinds/motion_law.ts');
  const points = [
    { at: 0, position: 0, section: { velocity: { min: 0 } } },
    { at: { min: 60, max: 110 }, position: { min: 12, max: 15 }, velocity: { max: 4 } },
    { at: { min: 200, max: 220 } },
  ];
  const angles = [0, 80, 210], position = asked(points, angles, 360, 'position'), velocity = asked(points, angles, 360, 'velocity');
  assert.deepEqual(position.dots.map(({ x, y }) => [x, y]), [[0, 0]]);
  assert.deepEqual(position.boxes.map(({ x0, x1, y0, y1 }) => [x0, x1, y0, y1]), [[60, 110, 12, 15], [200, 220, -Infinity, Infinity]]);
  assert.deepEqual(velocity.boxes.map(({ x0, x1, y0, y1 }) => [x0, x1, y0, y1]), [[0, 80, 0, 0], [60, 110, -Infinity, 4]]);
});

test('a layout says which wire cannot be laid and why; layouts without a value come last', async () => {
  for (const [language, says] of [['en', /Wire 7 is pushed out when wire 9 is laid/], ['de', /Draht 7 wird verdrängt, wenn Draht 9/]]) {
    const { reasons } = await load('kinds/fill_factor.ts', language);
    const layout = { count: 12, blocked_by: [], slips: { wire: 7, laid: 9, reason: 'pushed_out', unsupported: 0 }, windable: { wires: 8, turns: 8, ends_by: 'pushed_out' } };
    const [only, ...others] = reasons(layout);
    assert.equal(only.wire, 7);
    assert.match(only.text, says);
    assert.equal(others.length, 0);
    assert.deepEqual(reasons({ count: 12, windable: { wires: 12, turns: 12, ends_by: null } }), []);
    assert.equal(reasons({ count: 12, windable: { wires: 5, turns: 5, ends_by: 'no_support' } })[0].wire, 6);
    assert.equal(reasons({ count: 12, blocked_by: [{ part: 'needle', passage: 'opening', needed: 3, clear: 2.5 }] })[0].wire, null);
  }
  const { sorted } = await load('kinds/fill_factor.ts');
  const list = [{ count: 3 }, { count: 9, bound: 9 }, { count: 5, bound: 7 }].map((each) => ({ algorithm: 'raabe', wire: { copper: 1, outer: 1 }, ...each }));
  assert.deepEqual(sorted(list, 3, true).map((each) => each.count), [9, 5, 3]);
  assert.deepEqual(sorted(list, 4, false).map((each) => each.bound), [7, 9, undefined]);
});

test('regions follow each other without a hole, with what is between them', async () => {
  const { stretches } = await load('kinds/winding.ts');
  const point = (region, end, time) => ({ coil: 1, turn: 1, region, end, position: [0, 0, 0], time });
  const list = stretches([point('slot', 'begin', 0.5), point('slot', 'end', 1), point('head_bottom', 'begin', 1.5), point('head_bottom', 'end', 2)], 3);
  assert.deepEqual(list.map((each) => [each.region, each.from, each.to]), [['link', 0, 0.5], ['slot', 0.5, 1], ['link', 1, 1.5], ['head_bottom', 1.5, 2], ['link', 2, 3]]);
  assert.deepEqual(stretches([point('slot', 'begin', undefined), point('slot', 'end', undefined)], 3), []);
});

test('another setting of smoothness changes nothing else of the document', async () => {
  const { withSmoothness, roughness } = await load('kinds/contour.ts');
  const document = { kind: 'contour', name: 'part', priority: 3, callback: { url: 'http://x' }, spec: { contour: { gcode: 'G0' }, machine: { coarse: {}, fine: {}, redundancy: { method: 'iterative', stretch: 1.01, trades: false } } } };
  const other = withSmoothness(document, 0.5, 'WO-1', 'smoothness 0.5');
  assert.deepEqual(other.spec.machine.redundancy, { method: 'joint', trades: false, smoothness: 0.5 });
  assert.deepEqual([other.name, other.reference, other.priority, other.callback], ['part, smoothness 0.5', 'WO-1', 3, null]);
  assert.deepEqual(other.spec.contour, document.spec.contour);
  assert.equal(document.spec.machine.redundancy.stretch, 1.01);
  assert.equal(roughness({ x: 1, y: 2 }), 3);
});

test('phases are summed by their kind', async () => {
  const { phaseTimes } = await load('kinds/probe_path.ts');
  assert.deepEqual([...phaseTimes([{ kind: 'turn', start: 0, end: 1 }, { kind: 'hold', start: 1, end: 4 }, { kind: 'turn', start: 4, end: 4.5 }])], [['turn', 1.5], ['hold', 3]]);
});
