// Bundles the viewer into the Python package; `npm ci && npm run build` in this folder.
// A digest of all that goes in stands in the first line, so that a test can tell a bundle that is out of date.
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readFileSync, readdirSync } from "node:fs";

const here = new URL(".", import.meta.url);
const inputs = ["build.mjs", "package.json", ...readdirSync(new URL("src", here)).sort().map((name) => `src/${name}`)];
const digest = createHash("sha256");
for (const name of inputs) digest.update(`${name}\n`).update(readFileSync(new URL(name, here)));

await build({
  entryPoints: ["src/index.js"],
  absWorkingDir: here.pathname,
  outfile: process.argv[2] ?? "../src/wingbeat/viewer/viewer.js",
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  loader: { ".css": "text" },
  legalComments: "inline",
  banner: { js: `// wingbeat viewer, made by viewer/build.mjs; sources sha256:${digest.digest("hex")}` },
  logLevel: "warning",
});
