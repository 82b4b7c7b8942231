// Bundles the extension, the script of its preview, and the tests that run inside VS Code.

import * as esbuild from "esbuild";

const production = process.argv.includes("--production");

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
  alias: { "gcheck-viewer": "../../crates/gcheck-toolpath/src/plot/viewer.js" },
  platform: "browser",
  format: "iife",
  target: "es2022",
});

if (!production) {
  await esbuild.build({
    ...shared,
    entryPoints: { tests: "src/test/index.ts" },
    outdir: "dist",
    platform: "node",
    format: "cjs",
    target: "node20",
    external: ["vscode"],
  });
}
