/** The ribbon of limits and the curves over time or path length. */
import type { PlannedJob } from "../base/planned_job";

/** Draws ribbon and curves into the section of the page. */
export function mountCurves(_section: HTMLElement, _job: PlannedJob): void {}
