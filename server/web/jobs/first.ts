/** The first open, without any job: one click plans an example, a file goes to the form. */
import de from "../texts/de/jobs.json";
import en from "../texts/en/jobs.json";
import { at, getText, postJson } from "../base/api";
import { append, byId, h } from "../base/dom";
import { texts } from "../base/texts";
import { keepFile } from "../forms/handover";

const t = texts(en, de);

/** Posts an example of the service, and returns the address of its page. */
export async function planExample(name: string): Promise<string> {
  const job = await postJson<{ id: string }>("/v1/jobs", await getText(`/v1/examples/${name}`));
  return at(`/jobs/${job.id}`);
}

export function startFirst(root: HTMLElement): void {
  for (const button of root.querySelectorAll<HTMLButtonElement>("button[data-example]"))
    button.addEventListener("click", async () => {
      const label = button.textContent;
      button.disabled = true;
      button.textContent = t("posting");
      try {
        location.href = await planExample(button.dataset.example!);
      } catch (error) {
        button.disabled = false;
        button.textContent = label;
        button.after(h("p", { class: "notice bad", role: "alert" }, (error as Error).message));
      }
    });

  const drop = byId("drop");
  if (drop) {
    const open = async (file: File): Promise<void> => {
      await keepFile(file);
      location.href = at("/new") + "#file";
    };
    const input = h("input", { type: "file", id: "file", class: "visually-hidden", change: () => input.files?.[0] && void open(input.files[0]) });
    const choose = h("button", { type: "button", class: "primary", click: () => input.click() }, t("choose_file"));
    input.setAttribute("aria-label", t("choose_file"));
    input.tabIndex = -1;
    drop.insertBefore(h("p", {}, choose, input), drop.lastElementChild);
    drop.addEventListener("dragover", (event) => {
      event.preventDefault();
      drop.classList.add("over");
    });
    drop.addEventListener("dragleave", () => drop.classList.remove("over"));
    drop.addEventListener("drop", (event) => {
      event.preventDefault();
      drop.classList.remove("over");
      const file = event.dataTransfer?.files[0];
      if (file) void open(file);
    });
  }

  const curl = byId("curl");
  if (curl) {
    const copy = h("button", { type: "button", click: async () => {
      const range = document.createRange();
      range.selectNodeContents(curl);
      getSelection()?.removeAllRanges();
      getSelection()?.addRange(range);
      await navigator.clipboard?.writeText(curl.textContent ?? "").catch(() => undefined);
      copy.textContent = t("copied");
    } }, t("copy"));
    append(curl.parentElement!, copy);
  }
}
