/** The jobs that the list shows: pages of the service put together, in their order, without gaps. */
export type State = "queued" | "running" | "succeeded" | "failed" | "cancelled";

export interface ListedJob {
  id: string;
  kind: string;
  name: string | null;
  reference: string | null;
  state: State;
  progress: { fraction: number; stage: string; message: string; remaining: number | null };
  queue: { ahead: number } | null;
  created_at: string;
  duration?: number | null; // s, of the planned motion
}

export interface ListPage {
  jobs: ListedJob[];
  next: string | null; // cursor of the page behind this one
  counts: Record<State, number>;
}

export const isFinal = (state: State): boolean => state !== "queued" && state !== "running";

export class JobList {
  jobs: ListedJob[] = [];
  /** Cursor behind the last known job; null: there is none behind it; undefined: nothing is known yet. */
  next: string | null | undefined = undefined;
  constructor(readonly oldestFirst: boolean) {}

  /** Whether `a` stands before `b`. Ids grow with time. */
  private before(a: string, b: string): boolean {
    return this.oldestFirst ? a < b : a > b;
  }

  /** Puts a page in, which is all there is behind `cursor` (null: from the first) up to its `next`: what is known of that part and is not in the page any more
   *  was removed. Where more jobs have come than a page holds, the list begins again with the page. */
  merge(cursor: string | null, page: ListPage): void {
    const first = this.jobs[0];
    if (this.next === undefined || (cursor === null && page.next !== null && first && this.before(page.next, first.id))) {
      this.jobs = [...page.jobs];
      this.next = page.next;
      return;
    }
    const end = page.next;
    const head = cursor === null ? [] : this.jobs.filter((job) => !this.before(cursor, job.id));
    const tail = end === null ? [] : this.jobs.filter((job) => this.before(end, job.id));
    this.jobs = [...head, ...page.jobs, ...tail];
    if (end === null || (this.next !== null && !this.before(end, this.next))) this.next = end;
  }

  /** Returns the cursors of the pages of `size` jobs, behind the first one, that have jobs which may still change. */
  unsettled(size: number): string[] {
    const cursors: string[] = [];
    for (let at = size; at < this.jobs.length; ++at) {
      if (isFinal(this.jobs[at]!.state)) continue;
      cursors.push(this.jobs[at - 1]!.id);
      at += size - 1;
    }
    return cursors;
  }
}
