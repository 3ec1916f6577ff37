/* build.mjs - the page as one file: scripts bundled by esbuild, the library as gzip in base64, everything inline.
 *
 *   node lab/build.mjs LIBRARY.wasm PAGE.html
 */
import { createHash } from "node:crypto";
import { readFileSync, renameSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";
import { Core } from "./src/core.js";

const MOST_BYTES = 1.1e6;
const here = dirname(fileURLToPath(import.meta.url)), [library, page] = process.argv.slice(2);

async function bundle(entry, define) {
    const done = await build({
        entryPoints: [join(here, "src", entry)], bundle: true, minify: true, write: false, format: "iife", target: "es2022", define,
        charset: "utf8", legalComments: "inline",
    });
    return done.outputFiles[0].text;
}

const wasm = readFileSync(library), core = await Core.open(new WebAssembly.Module(wasm));
const worker = await bundle("worker.js", {});
const loader = await bundle("loader.js", {}), script = await bundle("main.js", { WORKER_SOURCE: JSON.stringify(worker) });
/* The licence of three asks that copies carry it. */
const licence = readFileSync(join(here, "node_modules", "three", "LICENSE"), "utf8").replace(/--+>?/g, "-").trim();
const parts = {
    LICENCE: `This page has parts of three.js:\n${licence}`,
    STYLE: readFileSync(join(here, "style.css"), "utf8").replace(/\/\*.*?\*\//gs, "").replace(/\s+/g, " "),
    STAMP: `festoon ${core.version}, results version ${core.resultsVersion}`,
    WASM: gzipSync(wasm, { level: 9 }).toString("base64"),
    SCRIPT_HASH: `sha256-${createHash("sha256").update(loader).digest("base64")}`,
    PROGRAM: gzipSync(script, { level: 9 }).toString("base64"),
    LOADER: loader,
};
const whole = readFileSync(join(here, "page.html"), "utf8").replace(/%([A-Z_]+)%/g, (all, name) => parts[name] ?? all);
if (Buffer.byteLength(whole) > MOST_BYTES) {
    console.error(`${page}: ${Buffer.byteLength(whole)} bytes are more than ${MOST_BYTES}`);
    process.exit(1);
}
writeFileSync(`${page}.part`, whole);
renameSync(`${page}.part`, page);
console.log(`${page}: ${Math.round(Buffer.byteLength(whole) / 1000)} kB, ${parts.STAMP}`);
