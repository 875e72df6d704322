/** Calls of the service's interface by a page. */
import { working } from "./work";

/** What a proxy puts before the addresses, "" in most cases; a page carries it in data-base, with a slash at its end. */
const base = typeof document === "undefined" ? "" : (document.body.dataset.base ?? "/").replace(/\/$/, "");

/** Returns an address of this service, e.g. at("/v1/jobs"). */
export const at = (path: string): string => base + path;

/** A problem document [RFC 9457]. */
export interface Problem {
  type: string;
  title: string;
  status?: number;
  detail?: string;
  errors?: { pointer: string; message: string; line?: number }[];
}

export class Refused extends Error {
  constructor(readonly status: number, readonly problem: Problem) {
    super(problem.detail ?? problem.title);
  }
}

/** Returns the answer to a request of an address of this service. Throws Refused with the problem for a status of 400 and more. Who reads the answer's body
 *  counts that as work (work.ts), as the functions below do. */
export const ask = (path: string, options: RequestInit = {}): Promise<Response> => working(request(path, options));

async function request(path: string, options: RequestInit): Promise<Response> {
  const headers = new Headers(options.headers);
  if (!headers.has("Accept")) headers.set("Accept", "application/json");
  const response = await fetch(at(path), { ...options, headers, credentials: "same-origin" });
  if (response.ok) return response;
  const text = await response.text();
  let problem: Problem = { type: "", title: response.statusText, status: response.status };
  try {
    problem = JSON.parse(text) as Problem;
  } catch {
    // A proxy's own answer is no document.
  }
  throw new Refused(response.status, problem);
}

const read = async <T>(path: string, options: RequestInit): Promise<T> => (await request(path, options)).json() as Promise<T>;

export const getJson = <T>(path: string, signal?: AbortSignal): Promise<T> => working(read<T>(path, signal ? { signal } : {}));

export function postJson<T>(path: string, document: unknown, headers: Record<string, string> = {}, signal?: AbortSignal): Promise<T> {
  const body = typeof document === "string" ? document : JSON.stringify(document);
  return working(read<T>(path, { method: "POST", body, headers: { "Content-Type": "application/json", ...headers }, ...(signal ? { signal } : {}) }));
}

export const getText = (path: string): Promise<string> => working(request(path, {}).then((response) => response.text()));

/** Numbers that came as f32, with the names of the columns and the headers. */
export interface Columns {
  names: string[];
  data: Float32Array<ArrayBuffer>;
  headers: Headers;
}

async function columns(path: string, options: RequestInit): Promise<Columns> {
  const response = await request(path, options), bytes = await response.arrayBuffer();
  return { names: (response.headers.get("X-Columns") ?? "").split(","), data: new Float32Array(bytes), headers: response.headers };
}

/** Returns the numbers of an answer with format=f32. */
export const getColumns = (path: string, signal?: AbortSignal): Promise<Columns> =>
  working(columns(path, { headers: { Accept: "application/octet-stream" }, ...(signal ? { signal } : {}) }));
