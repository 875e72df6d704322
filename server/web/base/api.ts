/** Calls of the service's interface by a page. */

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

/** Returns the answer to a request of an address of this service. Throws Refused with the problem for a status of 400 and more. */
export async function ask(path: string, options: RequestInit = {}): Promise<Response> {
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

export const getJson = async <T>(path: string, signal?: AbortSignal): Promise<T> =>
  (await ask(path, signal ? { signal } : {})).json() as Promise<T>;

export async function postJson<T>(path: string, document: unknown, headers: Record<string, string> = {}): Promise<T> {
  const body = typeof document === "string" ? document : JSON.stringify(document);
  return (await ask(path, { method: "POST", body, headers: { "Content-Type": "application/json", ...headers } })).json() as Promise<T>;
}

/** Numbers that came as f32, with the names of the columns and the headers. */
export interface Columns {
  names: string[];
  data: Float32Array;
  headers: Headers;
}

/** Returns the numbers of an answer with format=f32. */
export async function getColumns(path: string, signal?: AbortSignal): Promise<Columns> {
  const response = await ask(path, { headers: { Accept: "application/octet-stream" }, ...(signal ? { signal } : {}) });
  const bytes = await response.arrayBuffer();
  return { names: (response.headers.get("X-Columns") ?? "").split(","), data: new Float32Array(bytes), headers: response.headers };
}
