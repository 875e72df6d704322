/** What a kind shows beside curves and path. */
import { Refused } from "../base/api";
import { h } from "../base/dom";
import type { PlannedJob } from "../base/planned_job";
import { working } from "../base/work";
import { mountCoarseFine } from "./contour";
import { mountFillFactor } from "./fill_factor";
import { mountMotionLaw } from "./motion_law";
import { t, whenSeen } from "./parts";
import { mountProbePath } from "./probe_path";
import { mountWinding } from "./winding";

/** Fills the section of a job's kind when it comes near to what is seen, so that a page asks for nothing that nobody looks at. `job` is null where the kind
 *  has no setpoints. */
export function mountKind(section: HTMLElement, kind: string, id: string, job: PlannedJob | null): void {
  const mounts: Record<string, () => Promise<void>> = {
    ...(job?.columns.includes("xc") || job?.columns.includes("yc") ? { contour: () => mountCoarseFine(section, id, job!) } : {}),
    fill_factor: () => mountFillFactor(section, id),
    motion_law: () => mountMotionLaw(section, id, job),
    probe_path: () => mountProbePath(section, id, job),
    winding: () => mountWinding(section, id, job),
  };
  const mount = mounts[kind];
  if (!mount) return;
  const waiting = h("p", { class: "soft" }, t("loading"));
  section.append(waiting); // An empty section has no place on the page, and would never be seen.
  whenSeen(section, () => {
    working(mount())
      .catch((error: unknown) => {
        section.append(h("p", { class: "error" }, error instanceof Refused ? `${error.problem.title}: ${error.message}` : t("lost")));
      })
      .finally(() => waiting.remove());
  });
}
