// Whole programs, typed key by key as people type: what stands in the editor afterwards is what was typed.

import * as assert from "node:assert/strict";
import * as fs from "node:fs";
import * as path from "node:path";

import * as vscode from "vscode";

import { characters, closeAll, create, focus, folder, press, type Test } from "./harness";

/** Milliseconds from key to key of somebody who types well. */
const HUMAN: [number, number] = [100, 180];

/** The programs of the fixtures, by folder. */
interface Program {
  /** Below the folder of the workspace. */
  name: string;
  text: string;
}

/** Those that every run types: of each kind of control one, with cycles, macros, subprograms. */
const SOME = ["haas-mill/sleeve.nc", "haas-lathe/pin.nc", "linuxcnc/probe.ngc"];

/** A program that is typed with slips: cycles, macros, blanks at the end of a line. */
const CORRECTED = `%
O1007 (CORRECTED)
#100=4. (DEPTH)
T1 M06
G00 G90 G54 X0. Y0. S5000 M03
G43 H01 Z25. M08
G98 G83 Z-#100 R2. Q1.5 F150.
X-40.
G80
G00 Z50. 
IF [#100 EQ 4.] GOTO 90
M98 P2000
N90 G28 G91 Z0.
M30
%`;

/** A configuration that is typed, with keys and values of every kind. */
const CONFIGURATION = `control = "haas-mill"
# the mill in the corner
[machine]
units = "mm"
axes = ["X", "Y", "Z"]
travel.X = [-762.0, 0.0]
rapid = { X = 25400.0, Y = 25400.0, Z = 18000.0 }
max_rpm = 8100
[settings]
162 = false
"34" = 6.0
[variables]
"#500" = 2.5
[tools]
3 = { length = 80.0, diameter = 10 }
[offsets]
G54 = { X = -400.0, Y = -200.0 }
"G154 P2" = { X = 1.0 }
[codes]
M51 = { title = "door" }
[rules]
select = ["recommended", "strict"]
unknown-code = "off"
words = "hint"
[[overrides]]
files = ["lathe/**"]
control = "haas-lathe"
`;

/**
 * The programs to type. Blanks at the start of a line are left out, because VS Code puts them there itself; a comment that
 * is never closed too, because VS Code closes it.
 */
function programs(): Program[] {
  const fixtures = process.env.GCHECK_FIXTURES;
  assert.ok(fixtures, "the runner names the folder of programs");
  const found: Program[] = [];
  for (const group of ["clean", "tour"]) {
    for (const name of fs.readdirSync(path.join(fixtures, group), { recursive: true, encoding: "utf8" }).sort()) {
      if (/\.(nc|ngc)$/.test(name) && !(group === "tour" && name === "shaft.nc")) {
        const lines = fs.readFileSync(path.join(fixtures, group, name), "utf8").split("\n");
        found.push({ name, text: lines.map((line) => line.trimStart()).join("\n") });
      }
    }
  }
  return process.env.GCHECK_TYPING === "all" ? found : found.filter(({ name }) => SOME.includes(name));
}

/** Complains at the first line that is not as it was typed. */
function checkText(document: vscode.TextDocument, typed: string): void {
  const is = document.getText().split(/\r?\n/);
  const wanted = typed.split("\n");
  const at = wanted.findIndex((line, index) => line !== is[index]);
  const shown = (lines: string[]) => lines.slice(Math.max(at - 1, 0), at + 2).join("⏎");
  assert.ok(at < 0 && is.length === wanted.length, `line ${at + 1}: typed ${shown(wanted)}, but there is ${shown(is)}`);
}

/** An empty program where its control is known, with the keyboard on it. */
async function empty(name: string): Promise<vscode.TextEditor> {
  const fixtures = process.env.GCHECK_FIXTURES ?? "";
  const control = path.join(fixtures, "clean", path.dirname(name), "gcheck.toml");
  const target = path.join(folder(), "typing", path.dirname(name));
  fs.mkdirSync(target, { recursive: true });
  if (path.dirname(name) !== "." && fs.existsSync(control)) {
    fs.copyFileSync(control, path.join(target, "gcheck.toml"));
  }
  const editor = await create(path.join("typing", name), "");
  await focus();
  return editor;
}

/** The keys of a text, with a slip now and then that is put right at once. */
function withSlips(text: string): string[] {
  const keys: string[] = [];
  text.split("\n").forEach((line, index, lines) => {
    const end = index + 1 < lines.length ? ["Enter"] : [];
    const half = Math.ceil(line.length / 2);
    switch (index % 6) {
      case 0: // A wrong key.
        keys.push(...characters(line), "G", "Backspace", "4", "Backspace", ...end);
        break;
      case 1: // Back to the middle and on at the end.
        keys.push(...characters(line), "ArrowLeft", "ArrowLeft", "ArrowRight", "End", ...end);
        break;
      case 2: // What was typed last is undone.
        keys.push(...characters(line), "ArrowLeft", "End", "9", "Control+z", "End", ...end);
        break;
      case 3: // Undone and done again.
        keys.push(...characters(line), "Control+z", "Control+y", "End", ...end);
        break;
      case 4: // The first character is typed again, in front of the others.
        keys.push(...characters(line), ...(line === "" ? [] : ["Home", "Delete", ...characters(line.slice(0, 1)), "End"]), ...end);
        break;
      default: // A look at the line above, in the middle of the line.
        keys.push(...characters(line.slice(0, half)), " ", "Backspace", "Escape", "ArrowUp", "ArrowDown", ...characters(line.slice(half)), ...end);
    }
  });
  return keys;
}

export const typing: Test[] = [
  ...programs().map(({ name, text }): Test => [
    `${name} is typed, and is there as it was typed`,
    async () => {
      const { document } = await empty(name);
      await press(characters(text), HUMAN);
      checkText(document, text);
      await closeAll();
    },
  ]),
  [
    "a program is typed with slips and corrections, and is there as it was meant",
    async () => {
      const text = CORRECTED;
      const { document } = await empty("haas-mill/corrected.nc");
      await press(withSlips(text), HUMAN);
      checkText(document, text);
      await closeAll();
    },
  ],
  [
    "a configuration is typed, and is there as it was typed",
    async () => {
      const { document } = await empty("configuration/gcheck.toml");
      await press(characters(CONFIGURATION), HUMAN);
      checkText(document, CONFIGURATION);
      await closeAll();
    },
  ],
];
