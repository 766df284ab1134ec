// Bundles the viewer and the explorer into the Python package; `npm ci && npm run build` in this folder.
// A digest of all that goes in stands in the first lines, so that a test can tell a bundle that is out of date.
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readFileSync, readdirSync } from "node:fs";

const here = new URL(".", import.meta.url);
const sources = readdirSync(new URL("src", here), { recursive: true }).filter((name) => /\.\w+$/.test(name));
const inputs = ["build.mjs", "package.json", ...sources.sort().map((name) => `src/${name}`)];
const digest = createHash("sha256");
for (const name of inputs) digest.update(`${name}\n`).update(readFileSync(new URL(name, here)));
const sha256 = digest.digest("hex");

const folder = process.argv[2] ?? "../src/wingbeat/viewer";
// The explorer is a classic script: a page that opens from disk may load no module.
for (const [entry, name, format] of [
  ["src/index.js", "viewer", "esm"],
  ["src/explorer.js", "explorer", "iife"],
]) {
  await build({
    entryPoints: [entry],
    absWorkingDir: here.pathname,
    outfile: `${folder}/${name}.js`,
    bundle: true,
    minify: true,
    format,
    target: "es2022",
    loader: { ".css": "text" },
    legalComments: "inline",
    banner: { js: `// wingbeat ${name}, made by viewer/build.mjs; sources sha256:${sha256}` },
    logLevel: "warning",
  });
}
