// Called by node.sh with URL, PROXY, EXAMPLES and WORK in the environment.
import assert from 'node:assert/strict';
import { createHmac, randomUUID } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import test from 'node:test';

const { URL: url, PROXY: proxy, EXAMPLES: examples, WORK: work } = process.env;
const { calledJob, Client, JobFailed, Problem, readEvents } = await import(`${examples}/clients/node/bahnwerk.mjs`);
const line = JSON.parse(readFileSync(`${examples}/line.json`, 'utf8'));
const text = (name) => readFileSync(`${work}/${name}.json`, 'utf8');
const client = new Client(`${url}/`);
const failure = async (promise) => promise.then(() => assert.fail('no error'), (error) => error);
const all = async (items) => {
  const list = [];
  for await (const item of items) list.push(item);
  return list;
};

test('plans from document to result', async () => {
  const seen = [];
  const job = await client.submit(line);
  const done = await client.wait(job.id, { onProgress: (progress) => seen.push(progress) });
  assert.equal(done.state, 'succeeded');
  assert.equal(seen.at(-1).fraction, 1);
  const result = await client.result(job.id);
  assert.ok(result.verification.passed);
  assert.deepEqual(JSON.parse(await client.spec(job.id)), line);
  assert.deepEqual((await client.plan(JSON.stringify(line))).summary, result.summary);
});

test('names the place of a fault', async () => {
  const error = await failure(client.submit(text('wrong')));
  assert.ok(error instanceof Problem);
  assert.deepEqual([error.status, error.slug], [422, 'schema-violation']);
  assert.match(error.message, /\/spec\/contour\/blocks\/0\/feed: /);
});

test('says why a job failed', async () => {
  const job = await client.submit(text('budget'));
  const error = await failure(client.wait(job.id));
  assert.ok(error instanceof JobFailed);
  assert.deepEqual([error.slug, error.job.state], ['budget-exhausted', 'failed']);
});

test('repeats a post without a second job', async () => {
  const idempotencyKey = randomUUID();
  const first = await client.submit(line, { idempotencyKey });
  assert.equal((await client.submit(line, { idempotencyKey })).id, first.id);
  assert.notEqual((await client.submit(line)).id, first.id);
});

test('lists all pages and deletes', async () => {
  const reference = randomUUID();
  const ids = [];
  for (let i = 0; i < 3; ++i) ids.unshift((await client.submit({ ...line, reference })).id);
  assert.deepEqual((await all(client.jobs({ reference, limit: 2 }))).map((job) => job.id), ids);
  await client.wait(ids[0]);
  await client.delete(ids[0]);
  assert.equal((await failure(client.job(ids[0]))).status, 404);
});

test('stops waiting', async () => {
  const job = await client.submit(text('long'));
  assert.match((await failure(client.wait(job.id, { timeout: 0 }))).message, /has not ended/);
  await client.cancel(job.id);
  assert.equal((await failure(client.wait(job.id))).slug, 'cancelled');
});

test('lives through a restart behind a proxy', async () => {
  const asked = [];
  const answers = [[502, {}], [504, {}], [503, { 'Retry-After': new Date(Date.now() + 1000).toUTCString() }]];
  const server = createServer((request, response) => {
    const [status, headers] = answers[asked.length] ?? [200, {}];
    asked.push(request.headers.authorization);
    response.writeHead(status, headers).end(status === 200 ? '{"id":"x","state":"queued"}' : '<html>Bad Gateway</html>');
  });
  await new Promise((listening) => server.listen(0, '127.0.0.1', listening));
  const restarting = new Client(`http://me:p%40ss@127.0.0.1:${server.address().port}`);
  assert.equal((await restarting.job('x')).state, 'queued');
  assert.deepEqual(asked, Array(4).fill('Basic bWU6cEBzcw=='));
  server.closeAllConnections?.();
  server.close();
});

test('gives up where no server is', async () => {
  const nobody = new Client('http://127.0.0.1:1', { patience: 0 });
  assert.ok((await failure(nobody.job('x'))) instanceof TypeError);
  assert.ok((await failure(all(nobody.events('x')))) instanceof TypeError);
});

test('follows events over broken connections', async () => {
  const follower = new Client(proxy);
  const job = await follower.submit(text('long'));
  const events = [];
  for await (const event of follower.events(job.id, { retry: 0.01 })) {
    events.push(event);
    if (events.length === 3) await follower.cancel(job.id);
  }
  const ids = events.map((event) => Number(event.id));
  assert.deepEqual(ids, [...new Set(ids)].sort((a, b) => a - b), 'nothing comes twice or out of order');
  assert.equal(events[0].name, 'state');
  assert.equal(events.at(-1).data.state, 'cancelled');
});

test('a job that has ended has one event', async () => {
  const job = await client.submit(line);
  await client.wait(job.id);
  assert.deepEqual((await all(client.events(job.id))).map((event) => event.data.state), ['succeeded']);
});

test('reads streams however they are cut', async () => {
  const bytes = new TextEncoder().encode('retry: 250\n\n: comment\nid: 4\r\nevent: progress\r\ndata: {"a":\r\ndata: "ü"}\r\n\r\nid: 5\ndata: {}\nda');
  const cut = async function* (size) {
    for (let i = 0; i < bytes.length; i += size) yield bytes.slice(i, i + size);
  };
  for (const size of [1, 7, 1000])
    assert.deepEqual(await all(readEvents(cut(size))), [{ retry: 0.25 }, { id: '4', name: 'progress', data: { a: 'ü' } }]);
});

test('gives columns', async () => {
  const job = await client.submit(line);
  await client.wait(job.id);
  const { setpoints } = await client.result(job.id);
  const rows = await client.rows(job.id);
  assert.ok(rows.vx instanceof Float64Array);
  for (const column of Object.values(rows)) assert.equal(column.length, setpoints.count);
  assert.deepEqual([rows.x[0], rows.x.at(-1), rows.vx.at(-1)], [0, 100, 0]);
  const part = await client.rows(job.id, { columns: ['vx', 'x'], first: 10, count: 8, every: 2 });
  assert.deepEqual(Object.keys(part), ['vx', 'x']);
  assert.deepEqual([...part.x], [10, 12, 14, 16].map((row) => rows.x[row]));
  assert.equal((await failure(client.rows(job.id, { columns: ['nonsense'] }))).status, 422);
  const { limits, points } = await client.limits(job.id, { points: 5 });
  assert.ok(Math.abs(limits.reduce((sum, limit) => sum + limit.share, 0) - 1) < 1e-12);
  assert.equal(points.shares[0].length, 5);
});

test('checks who calls', () => {
  const body = '{"id": "x"}', now = Math.floor(Date.now() / 1000);
  const signed = (t, text = body, secret = 's') => `t=${t},v1=${createHmac('sha256', secret).update(`${t}.${text}`).digest('hex')}`;
  assert.deepEqual(calledJob(signed(now), body, 's'), { id: 'x' });
  for (const wrong of [signed(now, body, 'r'), signed(now, '{}'), signed(now - 1000), '', undefined, 't=1', 'v1=00'])
    assert.throws(() => calledJob(wrong, body, 's'));
});

test('a line has two vertices and one block', async () => {
  assert.equal((await client.check(line)).kind, 'contour');
  const job = await client.submit(line);
  await client.wait(job.id);
  const path = await client.path(job.id, { tolerance: 0.01, box: [-1, -1, 101, 1], columns: ['v', 'block'] });
  assert.deepEqual(path.values.x, [0, 100]);
  assert.deepEqual((await all(client.blocks(job.id, { by: 'segment', sort: 'lost' }))).map((block) => block.length), [100]);
  assert.deepEqual(Object.keys(await client.result(job.id, { parts: ['summary'] })), ['summary']);
});
