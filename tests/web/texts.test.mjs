import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { load, readJson, web } from './support.mjs';

const areas = (language) => readdirSync(join(web, 'texts', language)).sort();
const placeholders = (text) => [...text.matchAll(/\{(\w+)\}/g)].map(([, name]) => name).sort();

test('both languages have the same areas, keys and values to fill in', () => {
  assert.deepEqual(areas('de'), areas('en'));
  for (const area of areas('en')) {
    const en = readJson(`server/web/texts/en/${area}`), de = readJson(`server/web/texts/de/${area}`);
    assert.deepEqual(Object.keys(de).sort(), Object.keys(en).sort(), area);
    for (const key of Object.keys(en)) {
      assert.ok(en[key].trim() && de[key].trim(), `${area}, ${key}: an empty text`);
      assert.deepEqual([...new Set(placeholders(de[key]))], [...new Set(placeholders(en[key]))], `${area}, ${key}`);
    }
  }
});

test('values are filled in by name, and what is unknown stays', async () => {
  const { filled } = await load('base/texts.ts');
  assert.equal(filled('{time}, {gap} to gain, {time}', { time: '3 s', gap: 0 }), '3 s, 0 to gain, 3 s');
  assert.equal(filled('{other}', { time: 1 }), '{other}');
});
