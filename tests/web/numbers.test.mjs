import assert from 'node:assert/strict';
import { test } from 'node:test';
import { load } from './support.mjs';

const english = await load('base/numbers.ts'), german = await load('base/numbers.ts', 'de');

test('German numbers have a decimal comma, and no number a sign for thousands', () => {
  assert.equal(english.number(1234.5), '1234.5');
  assert.equal(german.number(1234.5), '1234,5');
  assert.equal(german.fixed(0.25, 3), '0,250');
  assert.equal(german.number(2.5e7), '2,500e7');
});

test('a point and a comma are decimal signs, and signs for thousands no number', () => {
  for (const { parseNumber } of [english, german]) {
    for (const [text, value] of [['1,5', 1.5], ['1.5', 1.5], [' -2 ', -2], ['.5', 0.5], ['1e-3', 1e-3], ['3,', 3]]) assert.equal(parseNumber(text), value, text);
    for (const text of ['1,234.5', '1.234,5', "1'000", '1 000', '', '-', '1e', 'NaN', '0x10']) assert.ok(Number.isNaN(parseNumber(text)), text);
  }
});

test('durations and shares are told in the unit that fits them', () => {
  assert.equal(english.duration(3.31485), '3.315 s');
  assert.equal(english.duration(152.973), '152.97 s');
  assert.equal(german.duration(152.973), '152,97 s');
  assert.equal(english.duration(3599.9), '1 h 0 min');
  assert.equal(english.percent(0.384), '38 %');
  assert.equal(german.percent(0.0123), '1,2 %');
  assert.equal(english.percent(0.00001), '< 0.01 %');
  assert.equal(english.percent(0), '0 %');
});
