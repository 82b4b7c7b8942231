// Tests that run inside VS Code, in its extension host, with the real server. `test/run.mjs` starts them.
//
// Log lines that begin with `@` are for the runner: `@test …` is for the reader, the others ask the browser for something.

import * as vscode from "vscode";

import { restricted, trusted } from "./basics";
import { commands } from "./commands";
import { api, runAll, type Test } from "./harness";
import { looks } from "./looks";
import { typing } from "./typing";

/** The tests of a session; GCHECK_TESTS picks those whose suite and name, `typing: …`, fit a pattern. */
function chosen(): Test[] {
  if (!vscode.workspace.isTrusted) {
    return restricted;
  }
  const pattern = new RegExp(process.env.GCHECK_TESTS ?? "");
  const suites = { basics: trusted, commands, looks, typing };
  return Object.entries(suites).flatMap(([suite, tests]) => tests.filter(([name]) => pattern.test(`${suite}: ${name}`)));
}

export async function run(): Promise<void> {
  await api();
  await runAll(chosen());
}
