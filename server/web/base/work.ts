/** What a page has begun and not finished: requests, timers, frames. <html data-settled> stands while there is nothing of the kind: all that an action leads
 *  to is then on the page. Tests and benchmarks wait for it. Playbacks and looks at the clock are not counted, since they have no end of their own. */
let open = 0;

/** Notes that something has begun; the function that it returns notes its end. */
export function begin(): () => void {
  if (open++ === 0 && typeof document !== "undefined") delete document.documentElement.dataset.settled;
  let ended = false;
  return () => {
    if (ended) return;
    ended = true;
    // What waits for this end goes on first, and may begin something else.
    setTimeout(() => {
      if (--open === 0 && typeof document !== "undefined") document.documentElement.dataset.settled = "";
    });
  };
}

/** Counts as begun until the promise is settled. */
export async function working<T>(promise: Promise<T>): Promise<T> {
  const end = begin();
  try {
    return await promise;
  } finally {
    end();
  }
}

/** Calls something when so many milliseconds have passed since the last start. */
export class Delay {
  private timer: ReturnType<typeof setTimeout> | undefined;
  private end: (() => void) | null = null;
  constructor(private readonly ms: number) {}
  start(act: () => void): void {
    clearTimeout(this.timer);
    this.end ??= begin();
    this.timer = setTimeout(() => {
      const { end } = this;
      this.end = null;
      try {
        act();
      } finally {
        end?.();
      }
    }, this.ms);
  }
  cancel(): void {
    clearTimeout(this.timer);
    this.end?.();
    this.end = null;
  }
}

/** Calls something at the next frame, once, however often it is asked for. */
export class NextFrame {
  private frame = 0;
  private end: (() => void) | null = null;
  constructor(private readonly act: () => void) {}
  ask(): void {
    if (this.end) return;
    this.end = begin();
    this.frame = requestAnimationFrame(() => this.now());
  }
  /** Calls it now, and not at the next frame. */
  now(): void {
    const { end } = this;
    cancelAnimationFrame(this.frame);
    this.end = null;
    try {
      this.act();
    } finally {
      end?.();
    }
  }
}
