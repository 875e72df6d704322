/** What the panels of a job's page know of a planned job. The service writes it into the page, so that it costs no request. */
import { getJson, Refused } from "./api";
import type { Scene } from "./scene";
import { SharedView, readAddress } from "./view";

/** One limit of GET /v1/jobs/{id}/limits. */
export interface Limit {
  id: number;
  name: string;
  unit: string | null;
  value: number | null;
  column: string | null; // column of setpoints that the limit is on
  time: number;
  share: number;
  lowest?: number | null; // where it is not the negative of `value`
  intervals?: { first: number; count: number; value: number | null; lowest?: number | null }[];
}

export interface LimitsAnswer {
  limits: Limit[];
  index?: number[]; // first row of each interval
  shares?: number[][]; // share of time of each limit in each interval
}

export interface PlannedJob {
  id: string;
  kind: string;
  rows: number;
  cycle: number; // unit of the independent variable per row: s, or degrees of a law over an angle
  seconds: number; // s per row; over an angle: at the master's nominal speed
  independent: string; // "time", or the name of the master's position
  unit: string; // unit of the independent variable: "s", "deg" or "mm"
  columns: string[];
  units: string[]; // one per column, "1" for numbers
  view: SharedView;
  /** Answers GET …/limits?points=400 of the whole series; asked once, whoever needs it first. */
  limits(): Promise<LimitsAnswer>;
  /** Answers GET …/scene, asked once; null where the service has none. */
  scene(): Promise<Scene | null>;
}

/** Number of intervals of the overview. */
export const overviewPoints = 400;

/** Returns the answer of GET …/limits to a query. */
export async function askLimits(id: string, query: string, signal?: AbortSignal): Promise<LimitsAnswer> {
  const { limits, points } = await getJson<{ limits: Limit[]; points?: { index: number[]; shares: number[][] } }>(`/v1/jobs/${id}/limits?${query}`, signal);
  return { limits, ...points };
}

/** Returns the planned job of this page, null where the page's job has no setpoints. */
export function plannedJob(): PlannedJob | null {
  const element = document.getElementById("job");
  const { id, kind, rows, cycle, seconds, independent, unit, columns, units } = element?.dataset ?? {};
  if (!id || !kind || !rows || !cycle || !columns) return null;
  const state = readAddress();
  const number = (name: string): number | undefined => (name in state ? Number(state[name]) : undefined);
  const view = new SharedView(Number(rows), {
    ...(number("first") !== undefined ? { first: number("first")! } : {}),
    ...(number("count") !== undefined ? { count: number("count")! } : {}),
    ...(number("row") !== undefined ? { row: number("row")!, locked: state.locked === "1" } : {}),
  });
  let limits: Promise<LimitsAnswer> | undefined, scene: Promise<Scene | null> | undefined;
  const askScene = async (): Promise<Scene | null> => {
    try {
      return await getJson<Scene>(`/v1/jobs/${id}/scene`);
    } catch (error) {
      if (error instanceof Refused) return null;
      throw error;
    }
  };
  return {
    id, kind, rows: Number(rows), cycle: Number(cycle), columns: columns.split(","), view,
    seconds: Number(seconds ?? cycle), independent: independent ?? "time", unit: unit ?? "s", units: (units ?? "").split(","),
    scene: () => (scene ??= askScene()),
    limits: () => (limits ??= askLimits(id, `points=${overviewPoints}`)),
  };
}
