// The form in German: all that the schemas of documents say is there in German, with the same figures, and nothing that they do not say any more.
import assert from 'node:assert/strict';
import { readdirSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { load, readJson, root, web } from './support.mjs';

const files = readdirSync(join(root, 'schemas')).filter((name) => /^\w+\.json$/.test(name) && name !== 'openapi.json').sort();
const schemas = Object.fromEntries(files.map((name) => [name, readJson(`schemas/${name}`)]));
const tables = Object.fromEntries(readdirSync(join(web, 'texts/descriptions')).map((name) => [name, readJson(`server/web/texts/descriptions/${name}`)]));
const german = Object.assign({}, ...Object.values(tables)), fields = readJson('server/web/texts/de/fields.json');

/** Yields a schema and all inside it. */
function* inside(schema) {
  if (typeof schema !== 'object' || schema === null) return;
  yield schema;
  for (const each of [schema.properties, schema.$defs]) for (const member of Object.values(each ?? {})) yield* inside(member);
  for (const each of [schema.items, schema.additionalProperties, ...(schema.oneOf ?? [])]) yield* inside(each);
}
const all = Object.values(schemas).flatMap((schema) => [...inside(schema)]), described = all.filter(({ description }) => description);

/** Asserts that two lists have the same members, and names those that only one has. */
function same(given, wanted, what) {
  const left = (from, other) => [...new Set(from)].filter((each) => !other.includes(each));
  assert.deepEqual({ missing: left(wanted, given), leftOver: left(given, wanted) }, { missing: [], leftOver: [] }, what);
}

test('every description of a schema has a German text, in the table of its schema or of those that several share', () => {
  assert.deepEqual(Object.keys(tables).sort(), [...files, 'shared.json'].sort());
  const wanted = Object.fromEntries(Object.keys(tables).map((name) => [name, []]));
  for (const text of new Set(described.map(({ description }) => description))) {
    const sayers = files.filter((name) => [...inside(schemas[name])].some(({ description }) => description === text));
    wanted[sayers.length > 1 ? 'shared.json' : sayers[0]].push(text);
  }
  for (const [name, table] of Object.entries(tables)) same(Object.keys(table), wanted[name], name);
});

test('no description is anywhere in a schema where the form does not look for it', () => {
  const count = (node) => (typeof node !== 'object' || node === null ? 0
    : Object.entries(node).reduce((sum, [key, each]) => sum + (key === 'description' && typeof each === 'string' ? 1 : count(each)), 0));
  assert.equal(described.length, count(Object.values(schemas)));
});

// Figures and units, names of members (with _ or a point) and of G-code: what is the same in both languages.
const figures = /(?<![\p{L}\d_'.])(?:\d+(?:,\d+)?(?:e-?\d+)?|(?:mm|ms|deg|kg|Hz|°C|[Nms])[²³⁴]?)(?![\p{L}\d_])/gu;
const names = /\b(?!e\.g\.)[A-Za-z]\w*(?:[_.]\w+)+|\b[A-Z]\d+\b|`\w+`/g;
const withComma = (text) => text.replace(/(?<!figure )\b(\d+)\.(\d)/g, '$1,$2');

test('a German text has the figures, units and names of the English one, figures with a decimal comma', () => {
  for (const { description } of described) {
    const text = german[description] ?? '', found = (pattern, from) => (from.match(pattern) ?? []).sort();
    assert.deepEqual(found(figures, text), found(figures, withComma(description)), description);
    same(found(names, text), found(names, description), description);
  }
});

test('a German text explains the values that the English one explains, by the words that the form has for them', () => {
  for (const { description = '', enum: values = [], items } of all)
    for (const value of [...values, ...(items?.enum ?? [])].filter((each) => description.includes(`${each}: `))) {
      const words = Object.keys(fields).filter((name) => name.split('.').at(-1) === value).map((name) => ` (${fields[name]})`);
      assert.ok(['', ...words].some((word) => german[description].includes(`${value}${word}: `)), `${value}: ${german[description]}`);
    }
});

test('every name that the form shows has a word, unless it is a symbol', () => {
  const symbol = /^(?:[a-z]\d?|[A-Z]\d+(?:\.\d)?|\d+|mm|deg)$/;
  const known = all.flatMap(({ properties = {}, enum: values = [], const: value = [], oneOf = [] }) => [
    ...Object.keys(properties), ...values, ...[value].flat(), ...oneOf.filter((each) => each.title && each.const === undefined).map((each) => each.title),
  ]);
  const own = new Set(['kind', 'spec']); // the page's own fields
  const plain = Object.keys(fields).filter((name) => !/^\w+\.\w+$/.test(name)), within = Object.keys(fields).filter((name) => !plain.includes(name));
  assert.deepEqual(known.filter((name) => !own.has(name) && !symbol.test(name) && !plain.includes(name)), []);
  assert.deepEqual([...plain, ...within.flatMap((name) => name.split('.'))].filter((name) => !known.includes(name)), []);
});

test('the module that the form loads has all German texts', async () => {
  assert.deepEqual((await load('descriptions_de.ts')).descriptions, german);
});
