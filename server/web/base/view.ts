/** What all panels of a job's page share: the rows that are shown, the row of the cursor, and whether it is locked. It stands in the address behind #, so
 *  that a link carries it. Panels never talk to each other: they change the view, and all that follow it draw. */
export interface View {
  first: number; // first row that is shown
  count: number; // number of rows that are shown
  row: number | null; // row of the cursor
  locked: boolean; // the cursor stays where it is when the pointer moves
}

export type Follower = (view: Readonly<View>, changed: ReadonlySet<keyof View>) => void;

export class SharedView {
  private view: View;
  private followers = new Set<Follower>();
  /** `total`: number of rows of the series. */
  constructor(readonly total: number, start: Partial<View> = {}) {
    this.view = { first: 0, count: total, row: null, locked: false };
    this.view = this.within({ ...this.view, ...start });
  }
  get(): Readonly<View> {
    return this.view;
  }
  /** Changes some members, within the series, and calls all followers if any has changed. */
  set(part: Partial<View>): void {
    const next = this.within({ ...this.view, ...part });
    const changed = new Set<keyof View>();
    for (const key of Object.keys(next) as (keyof View)[]) if (next[key] !== this.view[key]) changed.add(key);
    if (changed.size === 0) return;
    this.view = next;
    for (const follower of [...this.followers]) follower(next, changed);
  }
  /** Moves the cursor unless it is locked: what a pointer does. */
  point(row: number | null): void {
    if (!this.view.locked) this.set({ row });
  }
  /** Shows `count` rows around `row`, which keeps its place in the picture. */
  zoom(row: number, factor: number): void {
    const { first, count } = this.view;
    const wider = Math.round(Math.min(this.total, Math.max(2, count * factor)));
    this.set({ first: Math.round(row - ((row - first) / count) * wider), count: wider });
  }
  follow(follower: Follower): () => void {
    this.followers.add(follower);
    return () => this.followers.delete(follower);
  }
  private within(view: View): View {
    const count = Math.max(Math.min(2, this.total), Math.min(this.total, Math.round(view.count)));
    const first = Math.max(0, Math.min(this.total - count, Math.round(view.first)));
    const row = view.row === null ? null : Math.max(0, Math.min(this.total - 1, Math.round(view.row)));
    return { first, count, row, locked: view.locked && row !== null };
  }
}

/** Returns the state that the address carries behind #, as written by keepInAddress(). */
export function readAddress(): Record<string, string> {
  return Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
}

/** Writes values into the address behind #, without a new entry in the history; null removes one. Other values stay. */
export function keepInAddress(values: Record<string, string | null>): void {
  const now = new URLSearchParams(location.hash.slice(1));
  for (const [key, value] of Object.entries(values)) value === null ? now.delete(key) : now.set(key, value);
  const text = now.toString();
  if (text !== location.hash.slice(1)) history.replaceState(null, "", location.pathname + location.search + (text ? "#" + text : ""));
}
