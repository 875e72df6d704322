// What a client in TypeScript writes with the types that are generated from the OpenAPI document. Compiled, not run: an error of the compiler is a
// fault of the document, and each line that must not compile says so.
import type { components, operations, paths } from './api.js';

type Job = components['schemas']['Job'];
type Problem = components['schemas']['Problem'];

export function summary(job: Job): string {
  const state: 'queued' | 'running' | 'succeeded' | 'failed' | 'cancelled' = job.state;
  const fraction: number = job.progress.fraction;
  const name: string | null = job.name;
  const why: string = job.error?.detail ?? '';
  return `${job.id} ${name} ${state} ${fraction} ${why}`;
}

export const faults = (problem: Problem): string[] => (problem.errors ?? []).map(({ pointer, message }) => `${pointer}: ${message}`);

// The document of a post, with the contour's members.
type Document = paths['/v1/jobs']['post']['requestBody']['content']['application/json'];
export const document: Document = {
  kind: 'contour',
  spec: {
    contour: { start: [0, 0], blocks: [{ mode: 'cut', feed: 1800, segments: [{ line: [100, 0] }] }] },
    machine: {
      kinematics: 'cartesian',
      axes: { x: { velocity: 1800, acceleration: 16000 }, y: { velocity: 1800, acceleration: 16000 } },
      cycle_time: 0.001,
    },
    planning: { method: 'time_optimal' },
  },
};

export type Accepted = operations['createJob']['responses'][202]['content']['application/json'];
export const accepted = (job: Accepted): Job => job;
export type Health = paths['/healthz']['get']['responses'][200]['content']['application/json'];
export const build = (health: Health): string | undefined => health.commit;
export const query: operations['getSetpoints']['parameters']['query'] = { first: 0, count: 10, columns: 'x,y' };

// @ts-expect-error: a state that no job has
export const wrongState: Job['state'] = 'finished';
// @ts-expect-error: a member that a job has not
export const wrongMember = (job: Job) => job.progress.percent;
// @ts-expect-error: a document without its kind
export const wrongDocument: Document = { spec: {} };
