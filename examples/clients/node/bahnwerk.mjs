// A client of the planning service in one file, with nothing but Node (18 or later).
//
//   import { Client } from './bahnwerk.mjs';
//   const client = new Client('http://127.0.0.1:8080');      // where keys are needed: new Client(url, { key: 'bw_…' })
//   const job = await client.submit(document);              // an object, or a job document as text
//   await client.wait(job.id, { onProgress: console.log }); // throws JobFailed unless it succeeded
//   const result = await client.result(job.id);
//   const rows = await client.rows(job.id, { columns: ['x', 'y'] }); // rows.x: a Float64Array
//   const ended = calledJob(headers['bahnwerk-signature'], body, secret); // in a receiver of callbacks
//
// As a program: node bahnwerk.mjs JOB.json [URL] plans a document and prints its result document.
//
// Units are those of the service: mm, s, deg. Every fault that the service reports is a Problem with its document.
import { createHmac, randomUUID, timingSafeEqual } from 'node:crypto';
import { readFile } from 'node:fs/promises';
import { setTimeout as sleep } from 'node:timers/promises';
import { pathToFileURL } from 'node:url';

const final = ['succeeded', 'failed', 'cancelled'];
const retried = [429, 502, 503, 504, 507]; // asking again may help: the service is busy, or restarts behind a proxy

/** What the service refused: `document` is its problem document (RFC 9457), `slug` its type without /problems/. */
export class Problem extends Error {
  constructor(status, document) {
    const faults = (document.errors ?? []).map(({ pointer, message }) => `  ${pointer}: ${message}`);
    super([document.detail ?? document.title ?? `HTTP ${status}`, ...faults].join('\n'));
    this.status = status;
    this.document = document;
    this.slug = (document.type ?? '').split('/').pop();
  }
}

/** A job that failed or was cancelled: `job` is its resource, `document` why. */
export class JobFailed extends Problem {
  constructor(job) {
    super(200, job.error ?? {});
    this.job = job;
  }
}

export class Client {
  /** `patience`: how long a request that found no server, or one that cannot serve now, is repeated, s; 0: not at all.
   *  `key`: sent with every request; by default BAHNWERK_KEY of the environment. Authorities for a server's certificate
   *  beside the known ones are those of Node: NODE_EXTRA_CA_CERTS=ca.pem. */
  constructor(server = 'http://127.0.0.1:8080', { patience = 60, key = process.env.BAHNWERK_KEY } = {}) {
    const url = new URL(server);
    const given = url.username || url.password; // http://USER:PASSWORD@HOST, for a proxy that asks who one is
    const user = `${decodeURIComponent(url.username)}:${decodeURIComponent(url.password)}`;
    this.headers = given ? { Authorization: `Basic ${Buffer.from(user).toString('base64')}` }
      : key ? { Authorization: `Bearer ${key}` } : {};
    url.username = url.password = '';
    this.server = url.href.replace(/\/+$/, '');
    this.patience = patience;
  }

  // Jobs

  /** Posts a job document, gives the job, which is durable then. Without a key of the caller's own one is made, so that
   *  a post whose answer was lost does not make a second job when it is repeated. */
  async submit(document, { idempotencyKey = randomUUID() } = {}) {
    const body = typeof document === 'string' ? document : JSON.stringify(document);
    const headers = { 'Content-Type': 'application/json', 'Idempotency-Key': idempotencyKey };
    return this.#json('/v1/jobs', { method: 'POST', headers, body });
  }

  /** Checks a job document without posting it: {kind, checked, notes, estimate, outline}, or a Problem as a post would
   *  throw it. */
  async check(document) {
    const body = typeof document === 'string' ? document : JSON.stringify(document);
    return this.#json('/v1/check', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body });
  }

  async job(id) {
    return this.#json(path(id));
  }

  /** All jobs, newest first, page by page; filters: state, kind, reference, limit (of a page). */
  async *jobs(filters = {}) {
    for (let cursor; cursor !== null;) {
      const query = new URLSearchParams(cursor ? { ...filters, cursor } : filters);
      const page = await this.#json(`/v1/jobs?${query}`);
      yield* page.jobs;
      cursor = page.next;
    }
  }

  /** The job when it has succeeded; throws JobFailed when it ended otherwise, an Error after `timeout` seconds.
   *  `onProgress` is called with the member progress whenever that has changed. */
  async wait(id, { timeout = Infinity, onProgress } = {}) {
    const until = Date.now() + 1000 * timeout;
    for (let etag; ;) {
      const seconds = Math.min(60, Math.max(1, Math.round((until - Date.now()) / 1000)));
      const headers = { Prefer: `wait=${seconds}` };
      if (onProgress && etag) headers['If-None-Match'] = etag;
      const answer = await this.#request(path(id), { headers });
      if (answer.status !== 304) {
        const job = JSON.parse(textOf(answer));
        etag = answer.headers.get('ETag');
        onProgress?.(job.progress);
        if (job.state === 'succeeded') return job;
        if (final.includes(job.state)) throw new JobFailed(job);
      }
      if (Date.now() >= until) throw new Error(`job ${id} has not ended after ${timeout} s`);
    }
  }

  /** The job's events, {id, name, data}, until it has ended, over broken connections and restarts of the service: each
   *  connection says which event it had last. `retry`: pause before the next one, s; by default what the service asks. */
  async *events(id, { retry } = {}) {
    let last, giveUp, pause = 3;
    for (; ;) {
      const abort = new AbortController();
      try {
        const headers = { ...this.headers, Accept: 'text/event-stream' };
        if (last !== undefined) headers['Last-Event-ID'] = last;
        const response = await fetch(this.server + path(id, '/events'), { headers, signal: abort.signal });
        if (response.status === 204) return;
        if (!response.ok) throw await problemOf(response);
        for await (const item of readEvents(response.body)) {
          giveUp = undefined; // something came: the service lives
          if (item.retry !== undefined) {
            pause = item.retry;
            continue;
          }
          last = item.id;
          yield item;
          if (item.name === 'state' && final.includes(item.data.state)) return;
        }
      } catch (error) {
        giveUp = this.#giveUpAt(giveUp, error);
      } finally {
        abort.abort();
      }
      await sleep(1000 * (retry ?? pause));
    }
  }

  async cancel(id) {
    return this.#json(path(id, '/cancel'), { method: 'POST' });
  }

  async delete(id) {
    await this.#request(path(id), { method: 'DELETE' });
  }

  // Results

  /** The job document, as posted. */
  async spec(id) {
    return textOf(await this.#request(path(id, '/spec')));
  }

  /** The result document, or some members of it: parts: ['summary', 'details.slowest']. */
  async result(id, { parts } = {}) {
    return this.#json(path(id, parts ? `/result?${new URLSearchParams({ parts: parts.join(',') })}` : '/result'));
  }

  /** Blocks, segments or lines of a contour with their times and what they lose, page by page. */
  async *blocks(id, { by = 'block', sort = 'start' } = {}) {
    for (let first = 0, total = 1; first < total; ) {
      const page = await this.#json(path(id, `/blocks?${new URLSearchParams({ by, sort, first, count: 1000 })}`));
      yield* page.blocks;
      first += page.blocks.length;
      total = page.total;
    }
  }

  /** The path in few vertices, which are rows: {tolerance, columns, values}. Query: points or tolerance, box: [x0, y0,
   *  x1, y1], first, count, of, columns. */
  async path(id, query = {}) {
    return this.#json(path(id, `/path?${new URLSearchParams(query)}`));
  }

  /** The bodies among which the motion takes place: part, tools, needle and laid wires of a winding, tube of a probe
   *  path, range of fine axes in space. {bodies, movers, frame, place, box}. */
  async scene(id) {
    return this.#json(path(id, '/scene'));
  }

  /** Setpoints: an object with one Float64Array per column. Every `every`-th of the `count` rows from `first` on, by
   *  default to the end. */
  async rows(id, { columns, first = 0, count, every = 1 } = {}) {
    const query = new URLSearchParams({ first, every });
    if (count !== undefined) query.set('count', count);
    if (columns) query.set('columns', columns.join(','));
    const headers = { Accept: 'application/octet-stream' };
    const answer = await this.#request(path(id, `/setpoints?${query}`), { headers });
    const names = answer.headers.get('X-Columns').split(',');
    const view = new DataView(answer.body);
    const length = view.byteLength / 8 / names.length;
    const column = (k) => Float64Array.from({ length }, (_, row) => view.getFloat64(8 * (row * names.length + k), true));
    return Object.fromEntries(names.map((name, k) => [name, column(k)]));
  }

  /** Which limits kept the motion from being faster: `limits` with time and share of each; with `points` also shares
   *  in that many intervals. */
  async limits(id, { first = 0, count, points } = {}) {
    const query = new URLSearchParams({ first });
    if (count !== undefined) query.set('count', count);
    if (points !== undefined) query.set('points', points);
    return this.#json(path(id, `/limits?${query}`));
  }

  /** submit, wait, result. */
  async plan(document, options) {
    const job = await this.submit(document);
    await this.wait(job.id, options);
    return this.result(job.id);
  }

  // Requests

  async #json(target, options) {
    return JSON.parse(textOf(await this.#request(target, options)));
  }

  /** {status, headers, body} of the answer; repeats what found no server, broke off, or found one that cannot serve. */
  async #request(target, options = {}) {
    for (let giveUp; ;) {
      let pause = 1;
      try {
        const headers = { ...this.headers, ...options.headers };
        const response = await fetch(this.server + target, { ...options, headers });
        if (response.status < 400)
          return { status: response.status, headers: response.headers, body: await response.arrayBuffer() };
        pause = retryAfter(response.headers.get('Retry-After'));
        throw await problemOf(response);
      } catch (error) {
        giveUp = this.#giveUpAt(giveUp, error);
      }
      await sleep(Math.min(1000 * pause, Math.max(0, giveUp - Date.now())));
    }
  }

  /** When to stop repeating; throws `error` where that has passed, or where repeating cannot help. */
  #giveUpAt(giveUp, error) {
    const lost = error instanceof TypeError; // what fetch throws for connections
    if (!lost && !(error instanceof Problem && retried.includes(error.status))) throw error;
    const until = giveUp ?? Date.now() + 1000 * this.patience;
    if (Date.now() >= until) throw error;
    return until;
  }
}

const path = (id, rest = '') => `/v1/jobs/${encodeURIComponent(id)}${rest}`;

const textOf = (answer) => new TextDecoder().decode(answer.body);

/**
 * The job that a callback tells of. `signature`: the header Bahnwerk-Signature; `body`: the text or bytes as they came.
 * Throws unless it was signed with the secret, at most `tolerance` s ago.
 */
export function calledJob(signature, body, secret, { tolerance = 300 } = {}) {
  const parts = Object.fromEntries((signature ?? '').split(',').map((part) => part.split('=')));
  const expected = createHmac('sha256', secret).update(`${parts.t}.`).update(body).digest();
  const given = Buffer.from(parts.v1 ?? '', 'hex');
  if (given.length !== expected.length || !timingSafeEqual(given, expected))
    throw new Error('the signature is not that of the secret');
  if (!(Math.abs(Date.now() / 1000 - Number(parts.t)) <= tolerance)) throw new Error('the call is too old');
  return JSON.parse(body.toString());
}

/** Seconds to wait, from either form of Retry-After: a number of seconds or a date; 1 without one. */
function retryAfter(value) {
  if (value === null) return 1;
  if (/^\d+(\.\d+)?$/.test(value)) return Number(value);
  const seconds = (Date.parse(value) - Date.now()) / 1000;
  return Number.isNaN(seconds) ? 1 : Math.min(3600, Math.max(0.1, seconds));
}

async function problemOf(response) {
  const document = await response.json().catch(() => ({})); // a proxy's page is no problem document
  return new Problem(response.status, document);
}

/** {retry: seconds} and {id, name, data} from the bytes of an event stream; what breaks off is no event. */
export async function* readEvents(chunks) {
  const decoder = new TextDecoder();
  let rest = '', id = '', name = 'message', data = [];
  for await (const chunk of chunks) {
    const lines = (rest + decoder.decode(chunk, { stream: true })).split('\n');
    rest = lines.pop();
    for (const raw of lines) {
      const line = raw.replace(/\r$/, '');
      if (line === '') {
        if (data.length) yield { id, name, data: JSON.parse(data.join('\n')) };
        name = 'message';
        data = [];
        continue;
      }
      const [, field, value] = /^([^:]*):? ?(.*)$/.exec(line);
      if (field === 'id') id = value;
      else if (field === 'event') name = value;
      else if (field === 'data') data.push(value);
      else if (field === 'retry' && /^\d+$/.test(value)) yield { retry: Number(value) / 1000 };
    }
  }
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const [job, server] = process.argv.slice(2);
  if (!job) {
    console.error('node bahnwerk.mjs JOB.json [URL]');
    process.exit(2);
  }
  const onProgress = ({ fraction, stage }) => console.error(`${Math.round(100 * fraction)} % ${stage}`);
  try {
    const document = await readFile(job, 'utf8');
    console.log(JSON.stringify(await new Client(server, { patience: 10 }).plan(document, { onProgress })));
  } catch (error) {
    console.error(error.message);
    process.exitCode = error instanceof Problem ? 1 : 3;
  }
}
