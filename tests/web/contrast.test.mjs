// Colours of pages: contrast by WCAG 2.1 (1.4.3 for text, 1.4.11 for what is drawn), and how far apart lines' colours are for the colour-blind, by the
// matrices of Machado, Oliveira and Fernandes (2009) for the lack of one kind of cone.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { web } from './support.mjs';

const style = readFileSync(join(web, 'style.css'), 'utf8');
const dark = style.indexOf('@media (prefers-color-scheme: dark)');
const variables = (text) => Object.fromEntries([...text.matchAll(/--([a-z0-9-]+): *(#[0-9a-f]{3,6})\b/g)].map(([, name, value]) => [name, value]));
const light = variables(style.slice(0, dark));
const schemes = { light, dark: { ...light, ...variables(style.slice(dark)) } };

const linear = (hex) => {
  const full = hex.length === 4 ? hex.replace(/[0-9a-f]/g, '$&$&') : hex;
  return [1, 3, 5].map((at) => parseInt(full.slice(at, at + 2), 16) / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
};
const luminance = (hex) => linear(hex).reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
const contrast = (a, b) => {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
};
const times = (matrix, vector) => matrix.map((row) => row.reduce((sum, value, i) => sum + value * vector[i], 0));

const sights = {
  'all cones': [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  protanopia: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  deuteranopia: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.01182, 0.04294, 0.968881]],
  tritanopia: [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.3039]],
};
const lab = (rgb) => {
  const xyz = times([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.072175], [0.0193339, 0.119192, 0.9503041]], rgb.map((c) => Math.min(1, Math.max(0, c))));
  const [x, y, z] = xyz.map((value, i) => value / [0.95047, 1, 1.08883][i]).map((t) => (t > 216 / 24389 ? Math.cbrt(t) : (24389 / 27 / 116) * t + 16 / 116));
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
};

const texts = [['text', 'back'], ['text', 'panel'], ['soft', 'back'], ['soft', 'panel'], ['link', 'back'], ['link', 'panel'], ['good', 'good-back'],
  ['bad', 'bad-back'], ['busy', 'busy-back'], ['text', 'idle-back']];
const lines = (colours) => Object.keys(colours).filter((name) => /^c\d$/.test(name));

for (const [scheme, colours] of Object.entries(schemes)) {
  test(`${scheme}: text has a contrast of 4.5 and more, frames and focus 3`, () => {
    for (const [front, back] of texts) assert.ok(contrast(colours[front], colours[back]) >= 4.5, `${front} on ${back}: ${contrast(colours[front], colours[back])}`);
    for (const front of ['focus', 'strong']) assert.ok(contrast(colours[front], colours.back) >= 3, `${front}: ${contrast(colours[front], colours.back)}`);
  });
  test(`${scheme}: colours of lines differ for whoever lacks a kind of cone`, () => {
    const names = lines(colours);
    assert.ok(names.length >= 6);
    let least = [Infinity];
    for (const [sight, matrix] of Object.entries(sights)) {
      const seen = names.map((name) => lab(times(matrix, linear(colours[name]))));
      for (let i = 0; i < seen.length; ++i) for (let k = 0; k < i; ++k) {
        const distance = Math.hypot(...seen[i].map((value, at) => value - seen[k][at]));
        if (distance < least[0]) least = [distance, sight, names[k], names[i]];
      }
    }
    assert.ok(least[0] >= 10, least.join(', '));
  });
}
