// PNG (ISO/IEC 15948): the pixels of a screenshot, as Chromium writes it, 8 bits per sample without interlacing; and pictures for the documentation.
import assert from 'node:assert/strict';
import { deflateSync, inflateSync } from 'node:zlib';

const paeth = (a, b, c) => {
  const p = a + b - c, pa = Math.abs(p - a), pb = Math.abs(p - b), pc = Math.abs(p - c);
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
};

/** Undoes the filter of a line in place: `line` and the one above it, of `samples` bytes per pixel. */
function unfilter(filter, line, above, samples) {
  const { length } = line;
  if (filter === 1) for (let i = samples; i < length; ++i) line[i] += line[i - samples];
  else if (filter === 2) for (let i = 0; i < length; ++i) line[i] += above[i];
  else if (filter === 3) for (let i = 0; i < length; ++i) line[i] += ((i < samples ? 0 : line[i - samples]) + above[i]) >> 1;
  else if (filter === 4)
    for (let i = 0; i < length; ++i) line[i] += i < samples ? above[i] : paeth(line[i - samples], above[i], above[i - samples]);
}

/** Returns {width, height, at(x, y) → [red, green, blue], colour(x, y) → the same as one number, part(x, y, width, height) → such a picture of a part}. */
export function decode(file) {
  const width = file.readUInt32BE(16), height = file.readUInt32BE(20), samples = { 2: 3, 6: 4 }[file[25]];
  assert.ok(file[24] === 8 && samples && file[28] === 0, 'a PNG of 8 bits per sample, RGB or RGBA, without interlacing');
  const packed = [];
  for (let at = 8; at < file.length; at += 12 + file.readUInt32BE(at))
    if (file.toString('latin1', at + 4, at + 8) === 'IDAT') packed.push(file.subarray(at + 8, at + 8 + file.readUInt32BE(at)));
  const stride = width * samples, lines = inflateSync(Buffer.concat(packed)), line = (y) => lines.subarray(y * (stride + 1) + 1, (y + 1) * (stride + 1));
  for (let y = 0, above = new Uint8Array(stride); y < height; above = line(y++)) unfilter(lines[y * (stride + 1)], line(y), above, samples);
  const part = (left, top, width, height) => {
    const first = (x, y) => (top + y) * (stride + 1) + 1 + (left + x) * samples;
    return {
      width, height,
      at: (x, y) => [...lines.subarray(first(x, y), first(x, y) + 3)],
      colour: (x, y) => lines.readUIntBE(first(x, y), 3),
      part: (x, y, w, h) => part(left + x, top + y, w, h),
    };
  };
  return part(0, 0, width, height);
}

/** Returns the number of different colours, 1 of a blank picture; counting ends at `enough`. */
export function colours({ width, height, colour }, enough = 64) {
  const found = new Set();
  for (let y = 0; y < height; ++y) for (let x = 0; x < width && found.size < enough; ++x) found.add(colour(x, y));
  return found.size;
}

const crcs = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let bit = 0; bit < 8; ++bit) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});
function chunk(name, data) {
  const out = Buffer.alloc(data.length + 12);
  out.writeUInt32BE(data.length, 0);
  out.write(name, 4, 'latin1');
  data.copy(out, 8);
  let crc = 0xffffffff;
  for (const byte of out.subarray(4, data.length + 8)) crc = crcs[(crc ^ byte) & 255] ^ (crc >>> 8);
  out.writeUInt32BE((crc ^ 0xffffffff) >>> 0, data.length + 8);
  return out;
}

/** Returns a PNG with a palette of 256 colours, a quarter of the size: the most frequent ones, each other pixel as the nearest of them. Pages have few
 *  colours; what loses some are the edges of text and curves. */
export function encodeWithPalette({ width, height, at }) {
  const counts = new Map(), pixels = new Uint32Array(width * height);
  for (let y = 0, i = 0; y < height; ++y)
    for (let x = 0; x < width; ++x, ++i) {
      const [r, g, b] = at(x, y);
      pixels[i] = (r << 16) | (g << 8) | b;
      counts.set(pixels[i], (counts.get(pixels[i]) ?? 0) + 1);
    }
  const palette = [...counts].sort((a, b) => b[1] - a[1] || a[0] - b[0]).slice(0, 256).map(([colour]) => colour);
  const numbers = new Map(palette.map((colour, number) => [colour, number]));
  const nearest = (colour) => {
    let best = 0, least = Infinity;
    palette.forEach((other, number) => {
      const distance = ((colour >> 16) - (other >> 16)) ** 2 + (((colour >> 8) & 255) - ((other >> 8) & 255)) ** 2 + ((colour & 255) - (other & 255)) ** 2;
      if (distance < least) [best, least] = [number, distance];
    });
    return best;
  };
  const lines = Buffer.alloc(height * (width + 1));
  pixels.forEach((colour, i) => {
    let number = numbers.get(colour);
    if (number === undefined) numbers.set(colour, (number = nearest(colour)));
    lines[i + Math.floor(i / width) + 1] = number;
  });
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 3, 0, 0, 0], 8);
  const colours = Buffer.from(palette.flatMap((colour) => [colour >> 16, (colour >> 8) & 255, colour & 255]));
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', head), chunk('PLTE', colours), chunk('IDAT', deflateSync(lines, { level: 9 })), chunk('IEND', Buffer.alloc(0))]);
}
