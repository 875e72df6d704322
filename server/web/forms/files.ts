/** Files as people have them: what their bytes say as text, and which of the service's documents they are. */
import type { Json, JsonObject } from "./schema";

export interface ReadText {
  text: string;
  /** How the bytes were read: base64 is a binary DXF, as its schema takes it. */
  encoding: "utf-8" | "windows-1252" | "base64";
}

const binaryDxf = "AutoCAD Binary DXF";

/** Returns bytes as text: UTF-8, else Windows-1252, in which every byte is a character. */
export function decode(bytes: Uint8Array): ReadText {
  if (bytes.length > 22 && String.fromCharCode(...bytes.subarray(0, binaryDxf.length)) === binaryDxf) {
    let binary = "";
    for (let at = 0; at < bytes.length; at += 8192) binary += String.fromCharCode(...bytes.subarray(at, at + 8192));
    return { text: btoa(binary), encoding: "base64" };
  }
  try {
    return { text: new TextDecoder("utf-8", { fatal: true }).decode(bytes), encoding: "utf-8" };
  } catch {
    return { text: new TextDecoder("windows-1252").decode(bytes), encoding: "windows-1252" };
  }
}

export type Content =
  | { what: "gcode" | "dxf"; text: string }
  | { what: "job"; document: JsonObject }
  | { what: "machine"; document: JsonObject }
  | { what: "unknown-json" | "bad-json"; reason: string };

/** Members of a spec by which its kind is known. */
const namingMembers: [kind: string, members: string[]][] = [
  ["contour", ["contour", "machine"]], ["winding", ["part", "coil"]], ["motion_law", ["master", "points"]],
  ["probe_path", ["points", "tolerance"]], ["fill_factor", ["slot"]],
];

/** Returns what a text is: by its first character and words, not by the name of its file, which often lies. */
export function recognise(text: string, encoding: ReadText["encoding"]): Content {
  if (encoding === "base64") return { what: "dxf", text };
  const start = text.replace(/^\uFEFF/, "").trimStart();
  if (start.startsWith("{")) {
    let document: Json;
    try {
      document = JSON.parse(start) as Json;
    } catch (error) {
      return { what: "bad-json", reason: (error as Error).message };
    }
    const object = document as JsonObject;
    if (typeof object.kind === "string" && object.spec && typeof object.spec === "object") return { what: "job", document: object };
    const kind = namingMembers.find(([, members]) => members.every((name) => name in object));
    if (kind) return { what: "job", document: { kind: kind[0], spec: object } };
    if (object.axes || (object.coarse && object.fine)) return { what: "machine", document: object };
    return { what: "unknown-json", reason: Object.keys(object).slice(0, 6).join(", ") };
  }
  // A DXF is pairs of lines, a code and a value; its first pair begins a section, or is a comment (999).
  return /^(0\s*\r?\n\s*SECTION|999\s*\r?\n)/.test(start) ? { what: "dxf", text } : { what: "gcode", text };
}
