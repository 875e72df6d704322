/** What a kind shows beside curves and path. */
import type { PlannedJob } from "../base/planned_job";

/** Fills the section of a job's kind. `job` is null where the kind has no setpoints. */
export function mountKind(_section: HTMLElement, _kind: string, _id: string, _job: PlannedJob | null): void {}
