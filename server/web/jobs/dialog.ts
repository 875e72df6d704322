/** The dialog that counts the jobs of an action, asks, carries it out and says what became of it. */
import de from "../texts/de/jobs.json";
import en from "../texts/en/jobs.json";
import { ask } from "../base/api";
import { fill, h } from "../base/dom";
import { texts } from "../base/texts";
import { collect, forAll, possible, requestOf, type Action, type Outcome } from "./bulk";
import type { ListedJob } from "./list";

const t = texts(en, de);
const atOnce = 4; // requests

/** Where the jobs come from: those ticked, or pages of all that match. */
export type Source = ListedJob[] | ((cursor: string | null) => Promise<{ jobs: ListedJob[]; next: string | null }>);

/** Carries an action out; resolves when the dialog is closed, with whether anything was changed. */
export function actOn(action: Action, source: Source): Promise<boolean> {
  const dialog = h("dialog", { "aria-label": t(action), class: "bulk" });
  let stopped = false, changed = false, working = false;
  const button = (label: string, act: () => void, style = ""): HTMLButtonElement => h("button", { type: "button", class: style, click: act }, label);
  const close = (): void => dialog.close();
  const show = (title: string, lines: (string | HTMLElement)[], buttons: HTMLElement[]): void => {
    fill(dialog, h("h2", {}, title), ...lines.map((line) => (typeof line === "string" ? h("p", {}, line) : line)), h("div", { class: "buttons" }, ...buttons));
    buttons[buttons.length - 1]?.focus();
  };

  const done = (outcome: Outcome): void => {
    const lines: string[] = [t(`done_${action}`, { n: outcome.done })];
    const first = outcome.refused[0];
    if (first) lines.push(t("refused", { n: outcome.refused.length, reason: first.reason }));
    if (outcome.left > 0) lines.push(t("stopped", { n: outcome.left }));
    if (!first && outcome.left === 0 && Array.isArray(source) && source.length === 1) return close();
    show(t(action), lines, [button(t("close"), close, "primary")]);
  };

  const carryOut = async (jobs: ListedJob[]): Promise<void> => {
    working = changed = true;
    const bar = h("progress", { max: jobs.length, value: 0, "aria-label": t("progress") });
    const count = h("p", { "aria-live": "polite" }, t("doing", { done: 0, n: jobs.length }));
    show(t(action), [bar, count], [button(t("stop"), () => (stopped = true))]);
    const outcome = await forAll(
      jobs.map((job) => job.id),
      async (id) => {
        const { method, path } = requestOf(action, id);
        await ask(path, { method });
      },
      atOnce, () => stopped,
      ({ left }) => {
        bar.value = jobs.length - left;
        count.textContent = t("doing", { done: jobs.length - left, n: jobs.length });
      },
    );
    working = false;
    done(outcome);
  };

  const confirm = (jobs: ListedJob[]): void => {
    const can = jobs.filter((job) => possible(action, job.state));
    if (can.length === 0) return show(t(action), [t("nothing_to_do")], [button(t("close"), close, "primary")]);
    const lines: (string | HTMLElement)[] = [];
    if (can.length === 1) lines.push(h("p", {}, h("bdi", {}, can[0]!.name || can[0]!.id)));
    if (can.length < jobs.length) lines.push(t("cannot", { n: jobs.length - can.length }));
    const one = can.length === 1;
    const go = button(one ? t(action) : t(`do_${action}`, { n: can.length }), () => void carryOut(can), action === "retry" ? "primary" : "danger");
    show(one ? t(`ask_${action}_one`) : t(`ask_${action}`, { n: can.length }), lines, [go, button(t("keep"), close)]);
  };

  return new Promise((resolve) => {
    dialog.addEventListener("cancel", (event) => {
      stopped = true;
      if (working) event.preventDefault(); // what has begun is told first
    });
    dialog.addEventListener("close", () => {
      stopped = true;
      dialog.remove();
      resolve(changed);
    });
    document.body.append(dialog);
    dialog.showModal();
    if (Array.isArray(source)) return confirm(source);
    const count = h("p", { "aria-live": "polite" }, t("counting", { n: 0 }));
    show(t(action), [count], [button(t("stop"), close)]);
    void collect(source, () => stopped, (n) => (count.textContent = t("counting", { n })))
      .then((jobs) => jobs && confirm(jobs))
      .catch((error: Error) => show(t(action), [error.message], [button(t("close"), close, "primary")]));
  });
}
