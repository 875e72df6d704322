/** The page of a job: its panels share one view. */
import { byId } from "./base/dom";
import { showTimes, startPage } from "./base/page";
import { plannedJob } from "./base/planned_job";
import { mountCurves } from "./charts/mount";
import { followJob, offerRetry, offerWhatIf } from "./job/live";
import { linkPlaces } from "./job/places";
import { mountKind } from "./kinds/mount";
import { mountPath } from "./path/mount";

/** Makes what the service has written alive. Called again when a job has ended: its page then takes the place of the one that followed it. */
function mountPage(): void {
  const page = byId("job"), id = page?.dataset.id;
  if (!page || !id) return;
  const job = plannedJob();
  const curves = byId("curves"), path = byId("path"), kind = byId("kind"), why = byId("why"), problem = byId("problem");
  if (job && curves) mountCurves(curves, job);
  if (job && path) mountPath(path, job);
  if (job) linkPlaces(job);
  if (kind && page.dataset.kind) mountKind(kind, page.dataset.kind, id, job);
  // Not for coarse and fine axes, which have no such answer.
  if (job && why && job.kind === "contour" && !why.querySelector(".what-if") && !job.columns.includes("xc")) offerWhatIf(id, why);
  if (problem) offerRetry(id, problem);
  followJob(id, () => {
    showTimes();
    mountPage();
  });
}

startPage();
mountPage();
