// Modules of server/web in Node: bundled by esbuild, as they are for pages, and imported.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

export const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
export const web = join(root, 'server/web');
const folder = mkdtempSync(join(tmpdir(), 'bahnwerk-web-'));
process.on('exit', () => rmSync(folder, { recursive: true, force: true }));
let loaded = 0;

/** Returns the exports of a module, load('base/numbers.ts'), in a language: modules read it from the page that they are loaded in. Each call loads it anew. */
export async function load(module, language = 'en') {
  const file = join(folder, `${loaded++}.mjs`);
  execFileSync('esbuild', [join(web, module), '--bundle', '--format=esm', '--target=es2020', '--log-level=warning', `--outfile=${file}`,
    '--alias:three=/usr/share/javascript/three/build/three.module.js'], { stdio: 'inherit' });
  globalThis.document = { documentElement: { lang: language }, body: { dataset: {} } };
  try {
    return await import(pathToFileURL(file));
  } finally {
    delete globalThis.document;
  }
}

export const readJson = (path) => JSON.parse(readFileSync(join(root, path), 'utf8'));
