// Bundles the extension, the script of its preview, and the tests that run inside VS Code.
//
//   node build.mjs [--production] [--tests]
//
// `--production` makes what is packed and given to users, without tests and maps; `--tests` makes the tests beside it.

import * as fs from "node:fs";

import * as esbuild from "esbuild";

const production = process.argv.includes("--production");
const tests = !production || process.argv.includes("--tests");

// All of it is packed, so that nothing may be left of another build.
fs.rmSync("dist", { recursive: true, force: true });

const shared = {
  bundle: true,
  minify: production,
  sourcemap: !production,
  logLevel: "warning",
};

await esbuild.build({
  ...shared,
  entryPoints: { extension: "src/extension.ts" },
  outdir: "dist",
  platform: "node",
  format: "cjs",
  target: "node20",
  external: ["vscode"],
});

await esbuild.build({
  ...shared,
  entryPoints: { preview: "src/preview/page.ts" },
  outdir: "dist",
  // One viewer draws the page of `gcheck plot` and this preview.
  alias: {
    "gcheck-panel": "../../crates/gcheck-toolpath/src/plot/panel.js",
    "gcheck-viewer": "../../crates/gcheck-toolpath/src/plot/viewer.js",
  },
  platform: "browser",
  format: "iife",
  target: "es2022",
});

if (tests) {
  await esbuild.build({
    ...shared,
    minify: false,
    entryPoints: { tests: "src/test/index.ts" },
    outdir: "dist-tests",
    platform: "node",
    format: "cjs",
    target: "node20",
    external: ["vscode"],
  });
}
