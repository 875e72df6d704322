/** The page of a job: its panels share one view. */
import { byId } from "./base/dom";
import { startPage } from "./base/page";
import { plannedJob } from "./base/planned_job";
import { mountCurves } from "./charts/mount";
import { mountKind } from "./kinds/mount";
import { mountPath } from "./path/mount";

startPage();
const job = plannedJob(), page = byId("job");
const curves = byId("curves"), path = byId("path"), kind = byId("kind");
if (job && curves) mountCurves(curves, job);
if (job && path) mountPath(path, job);
if (kind && page?.dataset.id && page.dataset.kind) mountKind(kind, page.dataset.kind, page.dataset.id, job);
