// For work on pages: node server/web/dev.mjs http://127.0.0.1:8080 8090 serves what the service at the first address serves, except for the files of
// pages, which are bundled from the sources at each request.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, existsSync } from "node:fs";
import http from "node:http";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";

const [service, port] = process.argv.slice(2);
const here = path.dirname(fileURLToPath(import.meta.url));
const out = mkdtempSync(path.join(tmpdir(), "pages-"));
const types = { ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml" };
let bundled = 0;

function bundle() {
  if (Date.now() - bundled < 1000) return;
  execFileSync("sh", [path.join(here, "bundle.sh"), out], { stdio: "inherit" });
  bundled = Date.now();
}

http
  .createServer((request, response) => {
    const asset = /^\/assets\/[^/]+\/([\w.-]+)$/.exec(request.url);
    if (asset) {
      try {
        bundle();
      } catch {
        // esbuild has said what is wrong; the last bundle is served.
      }
      const file = path.join(out, asset[1]);
      if (!existsSync(file)) return response.writeHead(404).end();
      response.writeHead(200, { "Content-Type": types[path.extname(file)], "Cache-Control": "no-store" });
      return response.end(readFileSync(file));
    }
    const to = new URL(request.url, service);
    // The same-site rules of the service compare Host and Origin.
    const headers = { ...request.headers, host: to.host };
    if (headers.origin) headers.origin = to.origin;
    const forwarded = http.request(to, { method: request.method, headers }, (answer) => {
      response.writeHead(answer.statusCode, answer.headers);
      answer.pipe(response);
    });
    forwarded.on("error", () => response.writeHead(502).end());
    response.on("close", () => forwarded.destroy());
    request.pipe(forwarded);
  })
  .listen(Number(port), "127.0.0.1", () => console.log(`http://127.0.0.1:${port}`));
