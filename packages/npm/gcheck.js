#!/usr/bin/env node
// Starts the binary of gcheck for this system. It is in a package of its own, which npm installs as an optional
// dependency of this one.
"use strict";

const { spawnSync } = require("node:child_process");

const system = `${process.platform}-${process.arch}`;
const name = `@SCOPE@/cli-${system}`;

function find() {
  if (process.env.GCHECK_BINARY) {
    return process.env.GCHECK_BINARY;
  }
  try {
    return require.resolve(`${name}/bin/gcheck${process.platform === "win32" ? ".exe" : ""}`);
  } catch {
    console.error(
      `gcheck: the package ${name} with the binary for this system is not installed.\n` +
        `Either gcheck is not built for ${system}, or npm left optional dependencies out (--omit=optional).\n` +
        "Install it again with optional dependencies, build gcheck from source, or name a binary in GCHECK_BINARY.",
    );
    return undefined;
  }
}

const binary = find();
if (binary === undefined) {
  process.exitCode = 1;
} else {
  const { status, signal, error } = spawnSync(binary, process.argv.slice(2), { stdio: "inherit" });
  if (error) {
    console.error(`gcheck: cannot start ${binary}: ${error.message}`);
    process.exitCode = 1;
  } else if (signal) {
    process.kill(process.pid, signal);
  } else {
    process.exitCode = status;
  }
}
