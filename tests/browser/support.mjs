// What a file of tests imports: test() declares one, the rest helps to write it. run.mjs starts the browser and the service, and runs what was declared.
export { strict as assert } from 'node:assert';
export { colours } from './png.mjs';
export { example, longSheet, longWinding, snake, Service } from './service.mjs';

export const declared = [];

/** Declares a test. `run` gets {service, binary, visit(path, options), own(...words)}: the service that all tests share, a page of it (Visit), and a service
 *  of the test's own with an empty store, whose pages visit(path, {service}) opens. `counts`: the service is one of which only such tests ask something, one
 *  after another, so that its metrics are what the test has caused. */
export function test(name, options, run = options) {
  declared.push({ name, counts: options.counts === true, run });
}
