// The real service for tests of pages: a process with a store of its own on a free port, and what is asked of it by HTTP.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

export const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const ended = new Set(['succeeded', 'failed', 'cancelled']);

/** Returns a shipped document, 'bracket.json'; of a program or a drawing, 'parts/sheet.ngc', the document of the laser that cuts it. */
export function example(name) {
  const text = readFileSync(join(root, 'examples', name), 'utf8');
  if (name.endsWith('.json')) return JSON.parse(text);
  const document = example('parts/laser.json');
  document.name = name.replace(/.*\//, '');
  document.spec.contour = name.endsWith('.dxf') ? { dxf: text, feed: 100 } : { gcode: text };
  return document;
}

/** Documents of the sizes that tests and benchmark name: 1.02 million rows, and windings of 70 and 200 turns. */
export function longSheet() {
  const document = example('parts/sheet.ngc');
  document.name = 'sheet, a million rows';
  document.spec.machine.cycle_time = 0.00015;
  return document;
}
export function longWinding() {
  const document = example('stator_coil.json');
  document.name = 'coil of 70 turns'; // the layout of its wire has no more places
  document.spec.coil.turns = 70;
  return document;
}
export function longestWinding() {
  const document = example('stator_coil.json');
  document.name = 'coil of 200 turns'; // of a thinner wire, which has so many places
  document.spec.wire = 0.5;
  document.spec.coil.turns = 200;
  return document;
}

/** A contour of `arcs` half circles, about 1 ms of planning for each: a job that lasts. */
export function snake(arcs) {
  const axis = { velocity: 1800, acceleration: 16000 };
  const segments = Array.from({ length: arcs }, (_, i) => ({ arc: { to: [2 * i + 2, 0], center: [2 * i + 1, 0], direction: i % 2 ? 'ccw' : 'cw' } }));
  return {
    kind: 'contour',
    name: `${arcs} half circles`,
    spec: {
      contour: { start: [0, 0], blocks: [{ mode: 'cut', segments }] },
      machine: { kinematics: 'cartesian', axes: { x: axis, y: axis }, cycle_time: 0.001 },
      planning: { method: 'time_optimal' },
    },
  };
}

export class Service {
  static #running = new Set();
  #planned = new Map(); // text of a document → its job

  /** Starts a service; `words` are further ones of its command line. It listens when this returns. */
  static async start(binary, ...words) {
    const service = new Service();
    service.folder = mkdtempSync(join(tmpdir(), 'bahnwerk-pages-'));
    service.binary = binary;
    service.words = words;
    Service.#running.add(service);
    await service.resume('127.0.0.1:0');
    return service;
  }

  /** Starts the process again after end(), at the same address and with the same store. */
  async resume(listen = this.address) {
    const store = `sqlite:${join(this.folder, 'store.db')}`;
    this.process = spawn(this.binary, ['serve', '--listen', listen, '--store', store, '--worker-nice', '0', ...this.words], { stdio: ['ignore', 'ignore', 'pipe'] });
    this.log = [];
    this.gone = new Promise((done) => this.process.once('exit', done));
    const lines = createInterface(this.process.stderr);
    this.address = await new Promise((listens, fails) => {
      this.process.once('error', fails);
      this.process.once('exit', (code) => fails(new Error(`the service ended with ${code}:\n${this.log.join('\n')}`)));
      lines.on('line', (line) => {
        this.log.push(line);
        if (line.includes('"listening"')) listens(JSON.parse(line).address);
      });
    });
    this.url = `http://${this.address}`;
  }

  async end(signal = 'SIGTERM') {
    this.process.kill(signal);
    await this.gone;
  }

  async remove() {
    await this.end('SIGKILL');
    rmSync(this.folder, { recursive: true, force: true });
    Service.#running.delete(this);
  }

  static removeAll() {
    return Promise.all([...Service.#running].map((service) => service.remove()));
  }

  /** Asks for `path`; an answer of 400 or above fails. Returns the document of a JSON answer, the text of any other. */
  async ask(path, options = {}) {
    const answer = await fetch(this.url + path, options);
    const text = await answer.text();
    assert.ok(answer.ok, `${options.method ?? 'GET'} ${path}: ${answer.status} ${text.slice(0, 500)}`);
    return /json/.test(answer.headers.get('content-type') ?? '') ? JSON.parse(text) : text;
  }

  /** Posts a document and returns the job's resource at once. */
  post(document) {
    return this.ask('/v1/jobs', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(document) });
  }

  job(id) {
    return this.ask(`/v1/jobs/${id}`);
  }

  /** Waits for the end of a job and returns its resource. */
  async ended(id) {
    for (;;) {
      const job = await this.ask(`/v1/jobs/${id}`, { headers: { Prefer: 'wait=30' } });
      if (ended.has(job.state)) return job;
    }
  }

  /** Returns the succeeded job of a document, or of a shipped one by its name; tests that ask for the same one get the same job. */
  planned(document) {
    if (typeof document === 'string') return this.planned(example(document));
    const text = JSON.stringify(document);
    if (!this.#planned.has(text))
      this.#planned.set(
        text,
        (async () => {
          const job = await this.ended((await this.post(document)).id);
          assert.equal(job.state, 'succeeded', `${document.name ?? document.kind}: ${JSON.stringify(job.error)}`);
          return job;
        })(),
      );
    return this.#planned.get(text);
  }

  /** Returns a metric's value, summed over its labels. */
  async metric(name) {
    const lines = (await this.ask('/metrics')).split('\n').filter((line) => line.startsWith(`${name} `) || line.startsWith(`${name}{`));
    assert.ok(lines.length, `the service has no metric ${name}`);
    return lines.reduce((sum, line) => sum + Number(line.slice(line.lastIndexOf(' '))), 0);
  }
}
