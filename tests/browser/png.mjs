// Pixels of a screenshot: PNG (ISO/IEC 15948) of 8 bits per sample without interlacing, as Chromium writes it.
import assert from 'node:assert/strict';
import { inflateSync } from 'node:zlib';

const paeth = (a, b, c) => {
  const p = a + b - c, pa = Math.abs(p - a), pb = Math.abs(p - b), pc = Math.abs(p - c);
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
};

/** Returns {width, height, at(x, y) → [red, green, blue]}. */
export function decode(file) {
  const width = file.readUInt32BE(16), height = file.readUInt32BE(20), samples = { 2: 3, 6: 4 }[file[25]];
  assert.ok(file[24] === 8 && samples && file[28] === 0, 'a PNG of 8 bits per sample, RGB or RGBA, without interlacing');
  const packed = [];
  for (let at = 8; at < file.length; at += 12 + file.readUInt32BE(at))
    if (file.toString('latin1', at + 4, at + 8) === 'IDAT') packed.push(file.subarray(at + 8, at + 8 + file.readUInt32BE(at)));
  const lines = inflateSync(Buffer.concat(packed)), stride = width * samples, pixels = Buffer.alloc(height * stride);
  for (let y = 0; y < height; ++y) {
    const filter = lines[y * (stride + 1)];
    for (let i = 0; i < stride; ++i) {
      const left = i < samples ? 0 : pixels[y * stride + i - samples], up = y ? pixels[(y - 1) * stride + i] : 0;
      const corner = y && i >= samples ? pixels[(y - 1) * stride + i - samples] : 0;
      const predicted = [0, left, up, (left + up) >> 1, paeth(left, up, corner)][filter];
      pixels[y * stride + i] = lines[y * (stride + 1) + 1 + i] + predicted;
    }
  }
  const at = (x, y) => [...pixels.subarray(y * stride + x * samples, y * stride + x * samples + 3)];
  return { width, height, at };
}

/** Returns the number of different colours: 1 of a blank picture. */
export function colours({ width, height, at }) {
  const found = new Set();
  for (let y = 0; y < height; ++y) for (let x = 0; x < width; ++x) found.add(at(x, y).join());
  return found.size;
}
