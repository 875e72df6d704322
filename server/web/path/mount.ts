/** The path of a plan, in the plane or in space. */
import type { PlannedJob } from "../base/planned_job";

/** Draws the path into the section of the page. */
export function mountPath(_section: HTMLElement, _job: PlannedJob): void {}
