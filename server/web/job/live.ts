/** A job that has not ended: its progress as it is made, a button that cancels it, and its whole page once it has ended. */
import { ask, at, getJson, postJson, Refused } from "../base/api";
import { append, byId, h } from "../base/dom";
import { duration } from "../base/numbers";
import { texts } from "../base/texts";
import { working } from "../base/work";
import de from "../texts/de/job.json";
import en from "../texts/en/job.json";

const t = texts(en, de);

interface Progress {
  fraction: number;
  stage: string;
  message: string;
  remaining?: number | null; // s
}
interface JobResource {
  id: string;
  state: "queued" | "running" | "succeeded" | "failed" | "cancelled";
  progress: Progress;
  started_at: string | null;
  queue?: { ahead: number } | null;
}
const ended = (state: string): boolean => state !== "queued" && state !== "running";

/** Returns a time in whole seconds: "12 s", "3 min 5 s". */
export function wholeSeconds(seconds: number): string {
  return seconds < 600 ? (seconds < 60 ? `${Math.round(seconds)} s` : `${Math.floor(Math.round(seconds) / 60)} min ${Math.round(seconds) % 60} s`) : duration(seconds);
}

/** Returns the page's address again as a document. XMLHttpRequest parses HTML, which the policy forbids for text. */
function getPage(): Promise<Document> {
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    request.open("GET", location.pathname + location.search);
    request.setRequestHeader("Accept", "text/html");
    request.responseType = "document";
    request.onload = () => (request.response instanceof Document ? resolve(request.response) : reject(new Error("no page")));
    request.onerror = () => reject(new Error("no answer"));
    request.send();
  });
}

/** Keeps the page of a job up to date until the job has ended; then `ended` starts the page that has taken its place. */
export function followJob(id: string, begin: () => void): void {
  const live = byId("live");
  if (!live) return;
  const bar = live.querySelector("progress"), stage = live.querySelector<HTMLElement>(".stage");
  const times = h("p", { class: "times", role: "status" }), trouble = h("p", { class: "error", hidden: true });
  const cancel = h("button", { type: "button", id: "cancel", click: () => void stop() }, t("cancel"));
  append(live, times, h("p", {}, cancel), trouble);
  let job: JobResource | null = null, clock = 0; // ms that the service's clock is ahead of this one
  let over = false, asking = false;

  const show = (): void => {
    if (!job) return;
    const { fraction, stage: name, message, remaining } = job.progress, running = job.state === "running";
    for (const state of document.querySelectorAll<HTMLElement>("[data-verdict] .state, #facts .state")) {
      state.className = `state ${job.state}`;
      state.textContent = t(`state_${job.state}`) + (running ? ` ${Math.floor(fraction * 100 + 1e-9)} %` : "");
      // The service wrote the share behind the state.
      if (state.nextSibling?.nodeType === Node.TEXT_NODE) state.nextSibling.textContent = " ";
    }
    if (bar) running ? (bar.value = fraction) : bar.removeAttribute("value");
    if (stage) stage.textContent = running ? [stageName(name), message].filter((text) => text !== "").join(" · ") : "";
    const parts: string[] = [];
    if (running && job.started_at) parts.push(t("elapsed", { time: wholeSeconds(Math.max(0, (Date.now() + clock - Date.parse(job.started_at)) / 1000)) }));
    if (running && remaining != null) parts.push(t("remaining", { time: wholeSeconds(remaining) }));
    if (job.state === "queued" && job.queue) parts.push(job.queue.ahead > 0 ? t("ahead", { n: job.queue.ahead }) : t("next"));
    times.textContent = parts.join(" · ");
  };
  const become = async (): Promise<void> => {
    if (over) return;
    over = true;
    clearInterval(ticking);
    clearInterval(looking);
    try {
      const page = await working(getPage()), next = page.querySelector("main"), main = document.querySelector("main");
      if (!next || !main || page.querySelector("#live")) throw new Error("not the page of a job that has ended");
      main.replaceWith(document.adoptNode(next));
      document.title = page.title;
      begin();
    } catch {
      location.reload();
    }
  };
  const take = (next: JobResource): void => {
    job = next;
    show();
    if (ended(next.state)) void become();
  };
  const readJob = async (): Promise<void> => {
    const answer = await ask(`/v1/jobs/${id}`), date = Date.parse(answer.headers.get("Date") ?? "");
    if (Number.isFinite(date)) clock = date - Date.now();
    take((await answer.json()) as JobResource);
  };
  const read = (): Promise<void> => working(readJob());
  const stop = async (): Promise<void> => {
    cancel.disabled = true;
    try {
      await ask(`/v1/jobs/${id}/cancel`, { method: "POST" });
      await read();
    } catch (error) {
      cancel.disabled = false;
      trouble.hidden = false;
      trouble.textContent = error instanceof Refused ? error.message : String(error);
    }
  };
  const ticking = window.setInterval(show, 1000);
  // Not a stream of events: browsers allow six connections to a host, and the page of a seventh tab would not load.
  const look = async (): Promise<void> => {
    if (asking || over) return;
    asking = true;
    try {
      await read();
    } catch {
      // The service may be back at the next look.
    } finally {
      asking = false;
    }
  };
  const looking = window.setInterval(() => document.visibilityState === "visible" && void look(), 1000);
  document.addEventListener("visibilitychange", () => document.visibilityState === "visible" && void look());
  void look();
}

function stageName(name: string): string {
  const key = `stage_${name}`;
  return key in en ? t(key as keyof typeof en & string) : name;
}

/** Adds a button that posts something and goes on to the job that came of it. */
function offer(place: Element, id: string, label: string, busy: string, post: () => Promise<string>): void {
  const trouble = h("span", { class: "soft", role: "status" });
  const act = async (): Promise<void> => {
    button.disabled = true;
    trouble.textContent = busy;
    try {
      location.assign(at(`/jobs/${await post()}`));
    } catch (error) {
      button.disabled = false;
      trouble.textContent = error instanceof Error ? error.message : String(error);
    }
  };
  const button = h("button", { type: "button", id, click: () => void act() }, label);
  place.append(h("p", { class: "no-print" }, button, " ", trouble));
}

/** A button that plans a job's document again with the question what would make it faster. */
export function offerWhatIf(id: string, why: HTMLElement): void {
  offer(why, "what-if", t("plan_what_if"), t("planning"), async () => {
    const document = await getJson<{ spec: { planning?: Record<string, unknown> } }>(`/v1/jobs/${id}/spec`);
    document.spec.planning = { ...document.spec.planning, what_if: true };
    return (await postJson<{ id: string }>("/v1/jobs", document)).id;
  });
}

/** A button that plans the document of a job again that failed or was cancelled. */
export function offerRetry(id: string, place: HTMLElement): void {
  offer(place, "retry", t("retry"), "", async () => ((await (await ask(`/v1/jobs/${id}/retry`, { method: "POST" })).json()) as { id: string }).id);
}
