// Each type of an answer that modules of pages declare can be had from what the OpenAPI document says. Compiled, not run: where the compiler finds a fault
// here, a page reads what the service does not send.
import type { components } from "served";
import type { Problem } from "../../server/web/base/api";
import type { LimitsAnswer } from "../../server/web/base/planned_job";

type Served = components["schemas"];

export const problem = (served: Served["Problem"]): Problem => served;
export const limits = (served: Served["LimitTimes"]): LimitsAnswer => served;
