// Forms: every example of every kind goes into its form and comes out as it was; numbers with a point or a comma; alternatives by their naming members.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { load, readJson, root } from './support.mjs';

const model = await load('forms/model.ts'), schemas = await load('forms/schema.ts');
const read = (...parts) => readJson(parts.join('/'));
const kinds = ['contour', 'fill_factor', 'motion_law', 'probe_path', 'winding'];
const schemaOf = Object.fromEntries([...kinds, 'job'].map((name) => [name, read('schemas', `${name}.json`)]));
const files = (folder) => readdirSync(join(root, folder)).filter((name) => name.endsWith('.json'));

function* documents() {
  for (const file of files('examples')) yield [file, read('examples', file)];
  for (const file of files('examples/feeds')) if (read('examples/feeds', file).spec) yield [file, read('examples/feeds', file)];
  for (const file of files('examples/parts')) if (read('examples/parts', file).spec) yield [file, read('examples/parts', file)];
  for (const file of files('schemas/examples/job')) yield [file, read('schemas/examples/job', file)];
  for (const kind of kinds)
    for (const file of files(`schemas/examples/${kind}`)) yield [`${kind}/${file}`, { kind, spec: read(`schemas/examples/${kind}`, file) }];
}

const nodes = function* (node) {
  if (!node) return;
  yield node;
  if (node.form === 'object') for (const member of node.members.values()) yield* nodes(member);
  if (node.form === 'list') for (const entry of node.entries) yield* nodes(entry);
  if (node.form === 'variant') yield* nodes(node.nodes[node.at]);
};

test('every example goes through the form of its kind without loss', () => {
  let count = 0;
  for (const [name, document] of documents()) {
    const form = model.jobForm(schemaOf.job, schemaOf[document.kind], document);
    assert.deepEqual(JSON.parse(JSON.stringify(model.valueOf(form))), JSON.parse(JSON.stringify(document)), name); // -0 is 0 in JSON
    for (const node of nodes(form)) assert.equal(model.faultOf(node), null, name);
    ++count;
  }
  assert.ok(count >= 50, `${count} documents`);
});

test('fields of examples are fields, not JSON, but for maps and long lists', () => {
  const raw = new Set();
  for (const [, document] of documents())
    for (const node of nodes(model.jobForm(schemaOf.job, schemaOf[document.kind], document)))
      if (node.form === 'raw' && node.text !== '' && !(JSON.parse(node.text).length > model.mostEntries)) raw.add(node.schema.title ?? node.schema.description?.slice(0, 40));
  assert.deepEqual([...raw].filter((name) => name !== 'Cutter radii'), []);
});

test('a number has a point or a comma as decimal sign, and none for thousands', () => {
  const node = model.formOf({ type: 'number' }, {}, 1.5);
  for (const [text, value] of [['2,5', 2.5], ['2.5', 2.5], [' 1e-3 ', 0.001], ['1.000,5', '1.000,5'], ['1,000.5', '1,000.5'], ['x', 'x']]) {
    node.text = text;
    assert.equal(model.valueOf(node), value);
    assert.equal(model.faultOf(node), typeof value === 'number' ? null : 'number', text);
  }
});

test('an empty field is absent, or null where the document had null', () => {
  assert.equal(model.valueOf(model.formOf({ type: ['number', 'null'] }, {}, null)), null);
  assert.equal(model.valueOf(model.formOf({ type: ['number', 'null'] }, {}, undefined)), undefined);
  const node = model.formOf({ type: ['number', 'null'] }, {}, 3);
  node.text = '';
  assert.equal(model.valueOf(node), undefined);
});

test('another alternative keeps what both have and names itself', () => {
  const machine = model.formOf(schemaOf.winding.properties.machine, schemaOf.winding, read('schemas/examples/winding/complete.json').machine);
  assert.equal(machine.form, 'variant');
  const before = model.valueOf(machine), at = machine.branches.findIndex((branch) => branch.properties.type.const === 'vertical');
  model.choose(machine, at);
  const after = model.valueOf(machine);
  assert.equal(after.type, 'vertical');
  assert.deepEqual(after.axes, before.axes);
  assert.equal(after.l1, undefined);
  model.choose(machine, 0);
  assert.deepEqual(model.valueOf(machine), before);
});

test('points are lines of numbers', () => {
  const schema = schemaOf.probe_path.properties.points, node = model.formOf(schema, schemaOf.probe_path, [[0, 0.5], [1, 2]]);
  assert.equal(node.text, '0  0.5\n1  2');
  node.text = '0 0,5; 3\n\n1, 2';
  assert.deepEqual(model.valueOf(node), [[0, 0.5, 3], [1, 2]]);
});

test('a pointer finds its field, or what is above it', () => {
  const document = read('examples/bracket.json');
  const form = model.jobForm(schemaOf.job, schemaOf.contour, document);
  assert.equal(model.nodeAt(form, '/spec/machine/axes/x/velocity').node.form, 'number');
  assert.deepEqual(model.nodeAt(form, '/spec/machine/axes/q/velocity').rest, ['q', 'velocity']);
});

test('units come from the schema', () => {
  assert.equal(schemas.unitOf(schemaOf.probe_path.$defs.axis.properties.snap), 'mm/s⁴');
  assert.equal(schemas.unitOf(schemaOf.probe_path.properties.speed), 'mm/s');
  assert.equal(schemas.unitOf(schemaOf.probe_path.properties.method), '');
  assert.equal(schemas.unitOf(schemaOf.job.properties.time_budget), 's');
});

test('a file is what it says, not what it is called', async () => {
  const { decode, recognise } = await load('forms/files.ts');
  const bytes = (text) => new TextEncoder().encode(text);
  assert.deepEqual(decode(bytes('G1 X1 (ä)')), { text: 'G1 X1 (ä)', encoding: 'utf-8' });
  assert.deepEqual(decode(new Uint8Array([0x28, 0xe4, 0x29])), { text: '(ä)', encoding: 'windows-1252' });
  const binary = decode(new Uint8Array([...bytes('AutoCAD Binary DXF\r\n'), 26, 0, 1, 2]));
  assert.equal(binary.encoding, 'base64');
  assert.equal(recognise(binary.text, binary.encoding).what, 'dxf');
  for (const name of ['bracket.dxf', 'gear.dxf', 'sheet.dxf', 'lettering.dxf'])
    assert.equal(recognise(decode(readFileSync(join(root, 'examples/parts', name))).text, 'utf-8').what, 'dxf', name);
  for (const name of ['bracket.ngc', 'gear.ngc', 'thread.ngc', 'blades.ngc'])
    assert.equal(recognise(decode(readFileSync(join(root, 'examples/parts', name))).text, 'utf-8').what, 'gcode', name);
  for (const [name, document] of documents()) {
    const whole = recognise(JSON.stringify(document), 'utf-8'), spec = recognise(JSON.stringify(document.spec), 'utf-8');
    assert.deepEqual(whole, { what: 'job', document: JSON.parse(JSON.stringify(document)) }, name);
    assert.equal(spec.what === 'job' ? spec.document.kind : spec.what, document.kind, name);
  }
  for (const name of ['laser.json', 'robot.json', 'md1.json']) assert.equal(recognise(JSON.stringify(read('examples/machines', name)), 'utf-8').what, 'machine', name);
  assert.equal(recognise('{"a": 1', 'utf-8').what, 'bad-json');
  assert.equal(recognise('{"a": 1}', 'utf-8').what, 'unknown-json');
});

test('German shows and takes a comma', async () => {
  const german = await load('forms/model.ts', 'de');
  const node = german.formOf({ type: 'array', items: { type: 'array', items: { type: 'number' } } }, {}, [[0.5, 1e-7]]);
  assert.equal(node.text, '0,5  1e-7');
  assert.deepEqual(german.valueOf(node), [[0.5, 1e-7]]);
});
