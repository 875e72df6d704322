/** The list of jobs: follows them without a connection of its own, so that any number of tabs can be open; filters stand in the address. */
import de from "./texts/de/jobs.json";
import en from "./texts/en/jobs.json";
import { Refused, at } from "./base/api";
import { byId, fill, h } from "./base/dom";
import { onKey, startPage } from "./base/page";
import { texts } from "./base/texts";
import { Delay, working } from "./base/work";
import type { Action } from "./jobs/bulk";
import { actOn, type Source } from "./jobs/dialog";
import { startFirst } from "./jobs/first";
import { JobList, type ListPage, type ListedJob, type State } from "./jobs/list";
import { JobRow } from "./jobs/row";

const t = texts(en, de);
const pageSize = 50, interval = 2000, afterFailure = 4000; // jobs, ms

const listAddress = (parameters: URLSearchParams): string => at("/") + (parameters.toString() === "" ? "" : "?" + parameters);

const tags = new Map<string, { etag: string; page: ListPage }>();

/** Reads a page of the list with the durations; one that is known costs a 304. */
async function readPage(parameters: URLSearchParams): Promise<ListPage> {
  const address = at("/jobs") + (parameters.toString() === "" ? "" : "?" + parameters);
  const known = tags.get(address);
  const response = await fetch(address, {
    credentials: "same-origin", cache: "no-store",
    headers: { Accept: "application/json", ...(known ? { "If-None-Match": known.etag } : {}) },
  });
  if (response.status === 304 && known) return known.page;
  if (!response.ok) throw new Refused(response.status, await response.json().catch(() => ({ type: "", title: response.statusText })));
  const page = (await response.json()) as ListPage;
  if (tags.size > 100) tags.clear();
  tags.set(address, { etag: response.headers.get("ETag") ?? "", page });
  return page;
}

function follow(tick: () => Promise<void>, failed: (error: unknown) => void): () => void {
  let timer = 0, busy = false, again = false;
  const run = async (): Promise<void> => {
    window.clearTimeout(timer);
    again = true;
    if (busy) return;
    let wait = interval;
    busy = true;
    try {
      // Whoever asks during a look wants another one: its answer may be older than what they have changed.
      while (again && document.visibilityState === "visible") {
        again = false;
        await working(tick());
      }
    } catch (error) {
      failed(error);
      wait = afterFailure;
    }
    busy = false;
    timer = window.setTimeout(run, wait);
  };
  document.addEventListener("visibilitychange", () => document.visibilityState === "visible" && void run());
  void run();
  return () => void run();
}

function startList(): void {
  const body = document.querySelector("#list tbody")!, more = byId("more")!, none = byId("none")!, bulk = byId("bulk")!;
  const form = byId<HTMLFormElement>("filter")!, states = byId("states")!;
  const note = h("p", { class: "notice bad", role: "alert", hidden: true });
  form.after(note);
  body.closest("#list")!.setAttribute("aria-live", "off");

  let filter = new URLSearchParams(), list = new JobList(false), rows = new Map<string, JobRow>(), version = 0;
  const ticked = new Set<string>();

  /** Reads the filter from the address; the language is none. */
  const readFilter = (): void => {
    filter = new URLSearchParams([...new URLSearchParams(location.search)].filter(([name, value]) => name !== "lang" && value !== ""));
    list = new JobList(filter.get("sort") === "oldest");
    ++version;
  };
  const withCursor = (cursor: string | null, size?: number): URLSearchParams => {
    const parameters = new URLSearchParams(filter);
    if (cursor !== null) parameters.set("cursor", cursor);
    if (size) parameters.set("limit", String(size));
    return parameters;
  };

  // What is chosen, and what can be done with it.
  const count = h("span", { class: "count", "aria-live": "polite" });
  const matching = h("input", { type: "checkbox", id: "matching", change: () => showBulk() });
  const matchingLabel = h("span", {});
  const buttons = (["cancel", "retry", "delete"] as const).map((action) => h("button", { type: "button", "data-action": action, click: () => void act(action) }, t(action)));
  bulk.append(count, ...buttons, h("label", {}, matching, " ", matchingLabel));
  const all = h("input", { type: "checkbox", "aria-label": t("tick_all"), change: () => {
    for (const job of list.jobs) all.checked ? ticked.add(job.id) : ticked.delete(job.id);
    showBulk();
  } });
  document.querySelector("#list thead .tick")?.append(all);

  const showBulk = (): void => {
    for (const [id, row] of rows) row.tick.checked = ticked.has(id);
    const filtered = [...filter.keys()].some((name) => !["sort", "cursor", "limit"].includes(name));
    matchingLabel.textContent = filtered ? t("matching_filter") : t("everything");
    count.textContent = matching.checked ? t("all_matching") : t("chosen", { n: ticked.size });
    for (const button of buttons) button.disabled = !matching.checked && ticked.size === 0;
    all.checked = list.jobs.length > 0 && ticked.size >= list.jobs.length;
    all.indeterminate = ticked.size > 0 && !all.checked;
  };
  const act = async (action: Action, one?: ListedJob): Promise<void> => {
    const source: Source = one ? [one]
      : matching.checked ? async (cursor) => readPage(withCursor(cursor, 200))
      : list.jobs.filter((job) => ticked.has(job.id));
    if (!(await actOn(action, source))) return;
    if (!one) {
      ticked.clear();
      matching.checked = false;
    }
    look();
  };

  const draw = (page: ListPage): void => {
    const now = new Map<string, JobRow>();
    let place: Element | null = body.firstElementChild;
    for (const job of list.jobs) {
      const row = rows.get(job.id) ?? new JobRow(job, { act: (action, which) => void act(action, which), ticked: (id, on) => {
        on ? ticked.add(id) : ticked.delete(id);
        showBulk();
      } });
      row.update(job);
      now.set(job.id, row);
      if (place === row.element) place = place.nextElementSibling;
      else body.insertBefore(row.element, place);
    }
    while (place) {
      const next: Element | null = place.nextElementSibling;
      place.remove();
      place = next;
    }
    rows = now;
    for (const id of [...ticked]) if (!rows.has(id)) ticked.delete(id);
    none.hidden = list.jobs.length > 0;
    const total = Object.values(page.counts).reduce((sum, each) => sum + each, 0);
    for (const chip of states.querySelectorAll<HTMLAnchorElement>("a")) {
      const state = chip.dataset.state as State | "";
      chip.querySelector("b")!.textContent = String(state === "" ? total : page.counts[state]);
      const parameters = new URLSearchParams(filter);
      parameters.delete("cursor");
      state === "" ? parameters.delete("state") : parameters.set("state", state);
      chip.href = listAddress(parameters);
      (filter.get("state") ?? "") === state ? chip.setAttribute("aria-current", "true") : chip.removeAttribute("aria-current");
    }
    const cursor = filter.get("cursor");
    fill(more, cursor && h("a", { href: firstPage() }, t("first_page")), " ",
      list.next && h("a", { rel: "next", href: at("/") + "?" + withCursor(list.next) }, t("next_page")));
    document.documentElement.dataset.jobs = String(list.jobs.length);
    showBulk();
  };
  const firstPage = (): string => {
    const parameters = new URLSearchParams(filter);
    parameters.delete("cursor");
    return listAddress(parameters);
  };

  const tick = async (): Promise<void> => {
    const current = version, base = filter.get("cursor");
    const page = await readPage(withCursor(base));
    if (current !== version) return;
    list.merge(null, page);
    for (const cursor of list.unsettled(Number(filter.get("limit") ?? pageSize))) {
      const part = await readPage(withCursor(cursor));
      if (current !== version) return;
      list.merge(cursor, part);
    }
    note.hidden = true;
    draw(page);
    if (Object.values(page.counts).every((each) => each === 0) && filter.toString() === "") location.reload(); // the last job is gone
  };
  const look = follow(tick, (error) => {
    note.textContent = error instanceof Refused ? error.message : t("offline");
    note.hidden = false;
    if (error instanceof Refused && error.status === 401) location.reload();
  });

  let loading = false;
  const readMore = async (): Promise<void> => {
    if (loading || !list.next) return;
    loading = true;
    const current = version, cursor = list.next;
    try {
      const page = await readPage(withCursor(cursor));
      if (current === version) {
        list.merge(cursor, page);
        draw(page);
      }
    } catch {
      // The link stays; the list says below that the service does not answer.
    }
    loading = false;
  };
  const loadMore = (): Promise<void> => working(readMore());
  new IntersectionObserver((entries) => entries.some((entry) => entry.isIntersecting) && void loadMore(), { rootMargin: "300px" }).observe(more);
  more.addEventListener("click", (event) => {
    if (!(event.target as Element).closest("a[rel=next]")) return;
    event.preventDefault();
    void loadMore();
  });

  // Filters change the address and the list, not the page.
  const go = (address: string, push: boolean): void => {
    push ? history.pushState(null, "", address) : history.replaceState(null, "", address);
    changed();
  };
  const changed = (): void => {
    readFilter();
    ticked.clear();
    matching.checked = false;
    for (const name of ["text", "kind", "sort"]) {
      const field = form.elements.namedItem(name) as HTMLInputElement | HTMLSelectElement;
      if (field !== document.activeElement) field.value = filter.get(name) ?? "";
    }
    look();
  };
  const typed = new Delay(300); // ms
  const apply = (push: boolean): void => {
    typed.cancel();
    const parameters = new URLSearchParams(filter);
    parameters.delete("cursor");
    for (const name of ["text", "kind", "sort"]) {
      const value = (form.elements.namedItem(name) as HTMLInputElement).value.trim();
      value === "" ? parameters.delete(name) : parameters.set(name, value);
    }
    if (parameters.toString() !== filter.toString()) go(listAddress(parameters), push);
  };
  form.querySelector("button")?.classList.add("visually-hidden");
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    apply(true);
  });
  form.addEventListener("change", () => apply(true));
  form.addEventListener("input", () => {
    typed.start(() => apply(false));
  });
  states.addEventListener("click", (event) => {
    const chip = (event.target as Element).closest("a");
    if (!chip || event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    go(chip.href, true);
  });
  window.addEventListener("popstate", changed);

  // Keys.
  const step = (by: number): void => {
    const links = [...body.querySelectorAll<HTMLAnchorElement>("th a")];
    const here = links.findIndex((link) => link.closest("tr")!.contains(document.activeElement));
    links[Math.max(0, Math.min(links.length - 1, here < 0 ? 0 : here + by))]?.focus();
  };
  onKey("j", t("next_row"), () => step(1));
  onKey("k", t("previous_row"), () => step(-1));
  onKey("x", t("tick_key"), () => rows.get(document.activeElement?.closest("tr")?.dataset.id ?? "")?.tick.click());
  onKey("/", t("focus_search"), () => (form.elements.namedItem("text") as HTMLInputElement).focus());
  onKey("n", t("new_key"), () => (location.href = at("/new")));

  readFilter();
  showBulk();
}

startPage();
const first = byId("first");
if (first) {
  startFirst(first);
  follow(async () => {
    const page = await readPage(new URLSearchParams());
    if (page.jobs.length > 0) location.reload();
  }, () => undefined);
} else {
  startList();
}
