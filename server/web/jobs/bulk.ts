/** One action on many jobs: what can be done with which, one request each, a few at a time, and stopped between two. */
import type { ListedJob, State } from "./list";

export type Action = "cancel" | "retry" | "delete";

/** Whether a job in that state can be cancelled, planned once more, or deleted. */
export function possible(action: Action, state: State): boolean {
  if (action === "cancel") return state === "queued" || state === "running";
  if (action === "retry") return state === "failed" || state === "cancelled";
  return state !== "running";
}

/** Returns the request of an action on a job: its method and address. */
export function requestOf(action: Action, id: string): { method: string; path: string } {
  return action === "delete"
    ? { method: "DELETE", path: `/v1/jobs/${id}` }
    : { method: "POST", path: `/v1/jobs/${id}/${action}` };
}

export interface Outcome {
  done: number;
  left: number; // not tried, after a stop
  refused: { id: string; reason: string }[];
}

/** Calls `act` for every id, `parallel` at a time; `told` after each. Stops before the next one once `stopped` says so. */
export async function forAll(
  ids: readonly string[], act: (id: string) => Promise<void>, parallel: number, stopped: () => boolean, told: (outcome: Readonly<Outcome>) => void,
): Promise<Outcome> {
  const outcome: Outcome = { done: 0, left: ids.length, refused: [] };
  let next = 0;
  const worker = async (): Promise<void> => {
    while (next < ids.length && !stopped()) {
      const id = ids[next++]!;
      --outcome.left;
      try {
        await act(id);
        ++outcome.done;
      } catch (error) {
        outcome.refused.push({ id, reason: error instanceof Error ? error.message : String(error) });
      }
      told(outcome);
    }
  };
  await Promise.all(Array.from({ length: Math.min(parallel, ids.length) }, worker));
  return outcome;
}

/** Reads all jobs of a filter, page by page; `told` gets the number so far. Returns null where `stopped` said so. */
export async function collect(
  page: (cursor: string | null) => Promise<{ jobs: ListedJob[]; next: string | null }>, stopped: () => boolean, told: (count: number) => void,
): Promise<ListedJob[] | null> {
  const jobs: ListedJob[] = [];
  let cursor: string | null = null;
  do {
    const answer: { jobs: ListedJob[]; next: string | null } = await page(cursor);
    if (stopped()) return null;
    jobs.push(...answer.jobs);
    told(jobs.length);
    cursor = answer.next;
  } while (cursor !== null);
  return jobs;
}
