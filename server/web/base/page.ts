/** What every page has: times told relative to now, and the list of keys behind "?". */
import de from "../texts/de/shell.json";
import en from "../texts/en/shell.json";
import { h } from "./dom";
import { language, texts } from "./texts";
import { begin } from "./work";

const t = texts(en, de);

/** Returns how long ago a time was, in its largest unit; a day and more is the local date. */
export function ago(then: Date, now: Date): string {
  const seconds = Math.max(0, Math.round((now.getTime() - then.getTime()) / 1000));
  if (seconds < 60) return t("ago_seconds", { n: seconds });
  if (seconds < 3600) return t("ago_minutes", { n: Math.floor(seconds / 60) });
  if (seconds < 86400) return t("ago_hours", { n: Math.floor(seconds / 3600) });
  return then.toLocaleString(language, { dateStyle: "short", timeStyle: "short" });
}

/** Writes all times below an element: relative, with UTC in the title; a touch changes to local time and back. */
export function showTimes(root: ParentNode = document): void {
  for (const time of root.querySelectorAll<HTMLTimeElement>("time[datetime]")) {
    const then = new Date(time.dateTime);
    if (!time.title) {
      time.title = time.textContent ?? "";
      time.addEventListener("click", () => {
        time.classList.toggle("local");
        showTimes(time.parentElement!);
      });
    }
    time.textContent = time.classList.contains("local")
      ? then.toLocaleString(language, { dateStyle: "short", timeStyle: "medium" })
      : ago(then, new Date());
  }
}

const keys = new Map<string, { does: string; act: (event: KeyboardEvent) => void }>();

/** Gives a key of the page a meaning, unless somebody types into a field; "?" lists all. `key`: as KeyboardEvent.key. */
export function onKey(key: string, does: string, act: (event: KeyboardEvent) => void): void {
  keys.set(key, { does, act });
}

function listKeys(): void {
  const dialog = h("dialog", { "aria-label": t("keys") }, h("h2", {}, t("keys")));
  const list = h("dl", { class: "keys" });
  for (const [key, { does }] of keys) list.append(h("dt", {}, h("kbd", {}, key === " " ? "␣" : key)), h("dd", {}, does));
  dialog.append(list, h("form", { method: "dialog" }, h("button", {}, t("close"))));
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}

/** Starts what every page has. */
export function startPage(): void {
  const loaded = begin();
  if (document.readyState === "complete") loaded();
  else addEventListener("load", loaded, { once: true });
  showTimes();
  setInterval(() => document.visibilityState === "visible" && showTimes(), 10_000);
  onKey("?", t("keys"), listKeys);
  document.addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || target.closest("input:not([type=checkbox]):not([type=range]), textarea, select, dialog")) return;
    const key = keys.get(event.key);
    if (!key) return;
    event.preventDefault();
    key.act(event);
  });
}
