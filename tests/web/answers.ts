// Each type of an answer that modules of pages declare can be had from what the OpenAPI document says. Compiled, not run: where the compiler finds a fault
// here, a page reads what the service does not send.
import type { components } from "served";
import type { Problem } from "../../server/web/base/api";
import type { Limit } from "../../server/web/base/planned_job";
import type { ListedJob, ListPage } from "../../server/web/jobs/list";
import type { Page } from "../../server/web/path/program";

type Served = components["schemas"];

export const problem = (served: Served["Problem"]): Problem => served;
export const limit = (served: Served["LimitTimes"]["limits"][number]): Limit => served;
export const shares = (served: NonNullable<Served["LimitTimes"]["points"]>): { index: number[]; shares: number[][] } => served;
// With by=segment each entry has its segment.
export const block = (served: Served["Blocks"]["blocks"][number] & { segment: number }): Page["blocks"][number] => served;
export const job = (served: Served["Job"]): ListedJob => served;
export const counts = (served: Served["JobList"]): Pick<ListPage, "next" | "counts"> => served;
