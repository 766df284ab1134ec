// Bundles the viewer and the explorer into the Python packages; `npm ci && npm run build` in this folder.
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

const folder = process.argv[2];
// Both are classic scripts, because a page that opens from disk may load no module. The viewer's last line, and nothing
// else, makes an ES module of it, for pages and notebooks that import it; the explorer's pages leave this line out.
const exported = "const { mount, render } = globalThis.wingbeatViewer; export { mount }; export default { render };";
for (const [entry, name, place, footer] of [
  ["src/index.js", "viewer", "../src/wingbeat/viewer", { js: exported }],
  ["src/explorer.js", "explorer", "../src/wingbeat_explorer", {}],
]) {
  await build({
    entryPoints: [entry],
    absWorkingDir: here.pathname,
    outfile: `${folder ?? place}/${name}.js`,
    bundle: true,
    minify: true,
    format: "iife",
    target: "es2022",
    loader: { ".css": "text" },
    legalComments: "inline",
    banner: { js: `// wingbeat ${name}, made by viewer/build.mjs; sources sha256:${sha256}` },
    footer,
    logLevel: "warning",
  });
}
