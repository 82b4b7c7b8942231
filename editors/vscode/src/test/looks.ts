// How programs look: colours in light, dark and high contrast, pictures for people, a file of four hundred thousand lines.

import * as assert from "node:assert/strict";
import * as fs from "node:fs";
import * as path from "node:path";

import * as vscode from "vscode";

import { browser, closeAll, focus, folder, goTo, open, pause, picture, place, type Test, until } from "./harness";

/** A theme of each kind, by the names of its pictures. */
const THEMES: [string, string][] = [
  ["dark", "Default Dark Modern"],
  ["light", "Default Light Modern"],
  ["contrast", "Default High Contrast"],
];

/** Programs of each kind: below the fixtures, with a place worth a look. */
const PROGRAMS: [string, string, string][] = [
  ["mill", "clean/haas-mill/bracket.nc", "G83"],
  ["lathe", "clean/haas-lathe/bushing.nc", "G71"],
  ["five-axis", "tour/impeller.nc", "G143"],
  ["macro", "clean/haas-mill/manifold.nc", "#101=#101"],
  ["faulty", "tour/bracket.nc", "G83"],
];

/** A fixture as a program of the workspace, with the configuration beside it. */
function copied(name: string): string {
  const fixtures = process.env.GCHECK_FIXTURES;
  assert.ok(fixtures, "the runner names the folder of programs");
  const target = path.join("looks", name);
  fs.mkdirSync(path.dirname(path.join(folder(), target)), { recursive: true });
  fs.copyFileSync(path.join(fixtures, name), path.join(folder(), target));
  const configuration = path.join(fixtures, path.dirname(name), "gcheck.toml");
  if (fs.existsSync(configuration)) {
    fs.copyFileSync(configuration, path.join(folder(), path.dirname(target), "gcheck.toml"));
  }
  return target;
}

async function withTheme(theme: string, test: () => Promise<void>): Promise<void> {
  const workbench = () => vscode.workspace.getConfiguration("workbench");
  const before = workbench().get<string>("colorTheme");
  await workbench().update("colorTheme", theme, vscode.ConfigurationTarget.Global);
  try {
    await pause(1_500);
    await test();
  } finally {
    await workbench().update("colorTheme", before, vscode.ConfigurationTarget.Global);
  }
}

/** The colours of words in the text once the server has told what they are. */
async function colorsOf(words: string[]): Promise<Record<string, string>> {
  return until("colours", async () => {
    const colors = await browser<Record<string, string | null>>("colors", words);
    return Object.values(colors).includes(null) ? undefined : (colors as Record<string, string>);
  });
}

/** The ground of the toolpath in each of the themes: red, green and blue. */
const GROUNDS: Record<string, (parts: number[]) => boolean> = {
  dark: (parts) => Math.max(...parts) < 60,
  light: (parts) => Math.min(...parts) > 235,
  contrast: (parts) => Math.max(...parts) === 0,
};

export const looks: Test[] = [
  ...THEMES.map(([name, theme]): Test => [
    `the toolpath has the colours of ${theme}`,
    async () => {
      await withTheme(theme, async () => {
        for (const [kind, program] of PROGRAMS) {
          await open(copied(program));
          await vscode.commands.executeCommand("gcheck.showToolpath");
          const isRight = GROUNDS[name] ?? (() => false);
          await until("the ground", async () => {
            const ground = await browser<string>("inToolpath", { do: "ground" }).catch(() => "");
            return ground !== "" && isRight(ground.split(",").map(Number)) ? true : undefined;
          });
          await picture(`vscode-toolpath-${kind}-${name}`);
          await closeAll();
        }
      });
    },
  ]),
  ...THEMES.map(([name, theme]): Test => [
    `rapid, feed, arc and cycle have colours of their own in ${theme}`,
    async () => {
      await withTheme(theme, async () => {
        await open("part.nc");
        const colors = await colorsOf(["G00", "G01", "G02", "G81"]);
        assert.equal(new Set(Object.values(colors)).size, 4, JSON.stringify(colors));
        await closeAll();
        for (const [kind, program, at] of PROGRAMS) {
          const editor = await open(copied(program));
          goTo(editor, at, 1);
          await until("tokens", async () => {
            const tokens = await vscode.commands.executeCommand<vscode.SemanticTokens | undefined>(
              "vscode.provideDocumentSemanticTokens",
              editor.document.uri,
            );
            return tokens;
          });
          await focus();
          await vscode.commands.executeCommand("editor.action.showHover");
          await pause(1_000);
          await picture(`vscode-${kind}-${name}`);
          await closeAll();
        }
      });
    },
  ]),
  [
    "a program of 400,000 lines has colours, hover and hints",
    async () => {
      const lines = ["%", "O1020 (LARGE)", "(gcheck: control=haas-mill)", "G21 G17 G40 G49 G80 G90 G54", "T1 M6", "G43 H1 Z5.", "S9000 M3", "G00 X0. Y0."];
      for (let i = 0; i < 400_000; i++) {
        lines.push(i % 50 === 0 ? `G01 X${(i % 90) / 10 + 1}. F900.`.replace(/(\.\d+)\./, "$1") : `X${((i * 7) % 9000) / 100 + 0.005} Y${((i * 3) % 7000) / 100 + 0.005}`);
      }
      lines.push("G00 Z50.", "M30", "%", "");
      fs.writeFileSync(path.join(folder(), "large.nc"), lines.join("\n"));
      const start = Date.now();
      const editor = await open("large.nc");
      const top = await colorsOf(["G00", "G01", "X"]);
      console.log(`@test    its first colours come after ${((Date.now() - start) / 1000).toFixed(1)} s`);
      assert.equal(new Set(Object.values(top)).size, 3, JSON.stringify(top));
      // Far down, too, where only what is in view is told.
      const at = new vscode.Position(300_008, 1);
      editor.selection = new vscode.Selection(at, at);
      editor.revealRange(editor.selection, vscode.TextEditorRevealType.InCenter);
      await until("colours far down", async () => {
        const colors = await browser<Record<string, string | null>>("colors", ["G01", "X"]);
        return colors.G01 === top.G01 && colors.X === top.X ? true : undefined;
      });
      const hovers = await vscode.commands.executeCommand<vscode.Hover[]>("vscode.executeHoverProvider", editor.document.uri, place(editor.document, "G43", 1));
      assert.ok(hovers.length > 0, "a hover");
      await picture("vscode-large");
      await closeAll();
      fs.rmSync(path.join(folder(), "large.nc"));
    },
  ],
];
