// Every command, setting, key and action of the extension, used on a real program as somebody uses it.

import * as assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import * as fs from "node:fs";
import * as path from "node:path";

import * as vscode from "vscode";

import type { Row } from "../machine";

import {
  api,
  askList,
  browser,
  characters,
  closeAll,
  create,
  finding,
  focus,
  folder,
  goTo,
  hoverText,
  open,
  pause,
  picture,
  place,
  press,
  rule,
  type Test,
  until,
  use,
  useAction,
  uses,
  type Widgets,
  widgets,
} from "./harness";

/** A program with something for every action. */
const ACTIONS = `%
O1010 (ACTIONS)
(gcheck: control=fanuc-mill)
G21 G17 G40 G49 G80 G90 G54
T1 M6
S1000 M3
G43 H1 Z5.
G0 X10 Y5
G1 Z-1. F100.
G2 X20. Y15. R20.
G0 Z5.
G98 G81 X30. Y5. Z-3. R1. F50.
G80
N15 G0 Z50
IF [#500 EQ 1.] GOTO 15
G1 X1.
M30
%
`;

/** A program in inches with something for every change that is proved. */
const PROVED = `%
O1019 (PROVED)
(gcheck: control=fanuc-mill)
G20 G17 G40 G49 G80 G90 G54
T1 M6
S1000 M3
G43 H1 Z1.
G0 X1. Y0.
Z0.1
G1 Z-0.5 F5.
G0 Z0.1
X2.
G1 Z-0.5
G0 Z0.1
G91
G1 X0.5 F10.
Y0.25
G90
#1=0
WHILE [#1 LT 2] DO1
G1 X[#1+1.] F10.
#1=#1+1
END1
G81 X3. Y1. Z-0.5 R0.1 F5.
G80
G0 Z1.
M30
%
`;

/** One in millimetres with two tools, for the changes that fit it. */
const PROVED_METRIC = `%
O1020 (SECOND)
(gcheck: control=fanuc-mill)
G21 G17 G40 G49 G80 G90 G54
T1 M6
S1000 M3
G43 H1 Z25.4
G0 X10. Y5.
G1 Z-1. F127.
X20.
G0 Z25.4
T2 M6
S2000 M3
G43 H2 Z25.4
G1 X25.4 F50.8
M30
%
`;

/** Two tools, each with all that it needs. */
const SECTIONS = `%
O1022 (SECTIONS)
(gcheck: control=fanuc-mill)
G21 G17 G40 G49 G80 G90 G54
(MILL)
T1 M6
S1000 M3
G90 G0 X10. Y5.
G43 H1 Z25.
G1 Z-1. F127.
X20.
G0 Z25.
G91 G28 Z0. M5
(DRILL)
T2 M6
S2000 M3
G90 G0 X15. Y5.
G43 H2 Z25.
G99 G81 Z-5. R2. F90.
G80
G91 G28 Z0. M5
M30
%
`;

/** Each change that is proved: its action, its title, the program that it changes, and what it makes of some lines. */
const CHANGES: [string, RegExp, string, RegExp][] = [
  ["expand-cycle", /^Write canned cycles as plain moves/, PROVED, /^END1\nG0 X3\. Y1\.\nG1 Z-0\.5 F5\.\nG0 Z0\.1\n/m],
  ["fold-cycle", /^Write drilled holes as canned cycles/, PROVED, /^G99 G81 X1\. Y0\. Z-0\.5 R0\.1 F5\.\nX2\.\nG80 G98\n/m],
  ["unroll-loop", /^Write loops turn by turn/, PROVED, /^G90\n#1=0\nG1 X1\. F10\.\n[^]*^G1 X2\. F10\.\n/m],
  ["absolute", /^Write increments as absolute/, PROVED, /^G90\nG1 X2\.5 F10\.\nY0\.25\n/m],
  ["incremental", /^Write absolute coordinates as increments/, PROVED_METRIC, /^G91 G1 Z-26\.4 F127\.\nX10\.\n/m],
  ["mm", /^Write the program in millimetres/, PROVED, /^G21 [^]*^G1 Z-12\.7 F127\.\nG0 Z2\.54\nX50\.8\n/m],
  ["inch", /^Write the program in inches/, PROVED_METRIC, /^G20 [^]*^G43 H2 Z1\.\nG1 X1\. F2\.\n/m],
  ["safe-start", /^Insert safe start lines/, PROVED_METRIC, /^G0 Z25\.4\nG21 G17 G90 G94 G40 G80\nT2 M6\n/m],
  ["feeds-90", /^Scale the feeds to 90/, PROVED, /^G1 Z-0\.5 F4\.5\n[^]*^G1 X0\.5 F9\.\n/m],
  ["feeds-110", /^Scale the feeds to 110/, PROVED, /^G1 Z-0\.5 F5\.5\n[^]*^G1 X0\.5 F11\.\n/m],
  ["speeds-90", /^Scale the spindle speeds to 90/, PROVED_METRIC, /^S900 M3\n[^]*^S1800 M3\n/m],
  ["speeds-110", /^Scale the spindle speeds to 110/, PROVED_METRIC, /^S1100 M3\n[^]*^S2200 M3\n/m],
  ["mirror-x", /^Mirror the path at X0/, PROVED, /^G0 X-1\. Y0\.\n[^]*^G81 X-3\. Y1\. /m],
  ["mirror-y", /^Mirror the path at Y0/, PROVED_METRIC, /^G0 X10\. Y-5\.\n/m],
  ["rotate-90", /^Rotate the path by 90/, PROVED, /^G0 X0\. Y1\.\n[^]*^G81 X-1\. Y3\. /m],
  ["rotate-180", /^Rotate the path by 180/, PROVED_METRIC, /^G0 X-10\. Y-5\.\n[^]*^X-20\.\n/m],
  ["rotate-270", /^Rotate the path by 270/, PROVED_METRIC, /^G0 X5\. Y-10\.\n[^]*^Y-20\.\n/m],
];

/** The text of the page that the extension shows beside the program. */
async function answerPage(title: string): Promise<string> {
  return until(`the page ${title}`, () => {
    const shown = vscode.window.visibleTextEditors.find(
      ({ document }) => document.uri.scheme === "gcheck-answer" && document.uri.path.startsWith(title),
    );
    return shown === undefined || shown.document.getText() === "" ? undefined : shown.document.getText();
  });
}

/** Sets something for the folder while a test runs. */
async function withSetting(name: string, value: unknown, test: () => Promise<void>): Promise<void> {
  const settings = () => vscode.workspace.getConfiguration("gcheck");
  await settings().update(name, value, vscode.ConfigurationTarget.Workspace);
  try {
    await test();
  } finally {
    await settings().update(name, undefined, vscode.ConfigurationTarget.Workspace);
  }
}

/** Nothing that the window shows is an error. */
async function noComplaint(): Promise<void> {
  const { messages } = await widgets();
  assert.equal(messages, "", "no message is shown");
}

/** The hints from a line on: feed and speed are told in the first of what is in view. */
async function hints(document: vscode.TextDocument, from: number): Promise<string[]> {
  const view = new vscode.Range(from, 0, document.lineCount, 0);
  const all = await vscode.commands.executeCommand<vscode.InlayHint[]>("vscode.executeInlayHintProvider", document.uri, view);
  return all.map(({ label }) => (typeof label === "string" ? label : label.map((part) => part.value).join("")));
}

/** Waits until the hints from a line on are as they should be. */
async function hintsBecome(document: vscode.TextDocument, from: number, what: string, are: (labels: string[]) => boolean): Promise<void> {
  let seen: string[] = [];
  try {
    await until(what, async () => {
      seen = await hints(document, from);
      return are(seen) ? true : undefined;
    }, 20_000);
  } catch (error) {
    throw new Error(`there are ${seen.join("; ")}`, { cause: error });
  }
}

/** The actions at a text, by title. */
async function actionsAt(document: vscode.TextDocument, text: string): Promise<vscode.CodeAction[]> {
  const at = place(document, text);
  const range = new vscode.Range(at, at.translate(0, text.length));
  return askList<vscode.CodeAction>("vscode.executeCodeActionProvider", document, range);
}

/** Makes a change that is proved when it is chosen, and gives the program after it; the program is put back. */
async function afterProof(document: vscode.TextDocument, range: vscode.Range, title: RegExp): Promise<string> {
  const kind = vscode.CodeActionKind.RefactorRewrite.value;
  const all = 100;
  const offered = await askList<vscode.CodeAction>("vscode.executeCodeActionProvider", document, range, kind, all);
  const action = offered.find((action) => title.test(action.title));
  assert.ok(action?.edit, `${title} is offered and proved; there are: ${offered.map((one) => one.title).join("; ")}`);
  assert.ok(await vscode.workspace.applyEdit(action.edit));
  useAction(action.title);
  const after = document.getText();
  await vscode.commands.executeCommand("workbench.action.files.revert");
  // All changes of the list were proved for this, and those that were refused said why.
  await vscode.commands.executeCommand("notifications.clearAll");
  return after;
}

/** Does an action at a text, and gives the program after it; the program is put back. */
async function afterAction(document: vscode.TextDocument, text: string, title: RegExp): Promise<string> {
  const offered = await actionsAt(document, text);
  const action = offered.find((action) => title.test(action.title));
  assert.ok(action?.edit, `${title} is offered; there are: ${offered.map((one) => one.title).join("; ")}`);
  assert.ok(await vscode.workspace.applyEdit(action.edit));
  useAction(action.title);
  const after = document.getText();
  await vscode.commands.executeCommand("workbench.action.files.revert");
  return after;
}

/** The status bar, once it says something that fits. */
async function statusSays(fits: RegExp): Promise<{ text: string; tooltip: string }> {
  const { status } = await api();
  return until(`the status ${fits}`, () => (fits.test(status.shown?.tooltip ?? "") ? status.shown : undefined));
}

export const commands: Test[] = [
  [
    "Show State at Cursor tells modes, places and what set them",
    async () => {
      const editor = await open("part.nc");
      goTo(editor, "X2.5", 1);
      await vscode.commands.executeCommand("gcheck.showState");
      const text = await answerPage("State in part.nc");
      assert.match(text, /^line 9: X2\.5\nevery path comes here\n\nBEFORE\n/);
      assert.match(text, /position, work +X0\.75 Y0\.75 Z-0\.25/);
      assert.match(text, /\nAFTER\n[^]*position, work +X2\.5 Y0\.75 Z-0\.25/);
      assert.match(text, /\nG1 +motion, set in line 8\n/);
      assert.match(text, /\ntool +1\b/);
      assert.match(text, /\nfeed +F12 inch\/min\n/);
      await noComplaint();
      await picture("vscode-state");
      await closeAll();
    },
    uses("gcheck.showState"),
  ],
  [
    "Machine State follows the cursor, and its modes lead to where they were set",
    async () => {
      const editor = await open("part.nc");
      await vscode.commands.executeCommand("gcheck.machineState.focus");
      await focus();
      const { machine } = await api();
      const rows = async (label: string, what: (rows: readonly Row[]) => boolean) =>
        until(`the machine state with ${label}`, () => {
          const found = machine.rows().find((row) => row.label === label)?.rows;
          return found !== undefined && what(found) ? found : undefined;
        });
      goTo(editor, "X2.5", 1);
      const position = await rows("Position", (found) => found.some((row) => row.label === "X 2.5"));
      assert.ok(position.some((row) => row.label === "Y 0.75"));
      const modes = await rows("Modes", (found) => found.some((row) => row.label === "G1"));
      const at = modes.find((row) => row.label === "G1")?.at;
      assert.equal(at?.line, 7);
      await picture("vscode-machine-state");
      await vscode.commands.executeCommand("gcheck.revealLine", at);
      await until("the cursor in line 8", () => (vscode.window.activeTextEditor?.selection.active.line === 7 ? true : undefined));
      await noComplaint();
      await closeAll();
    },
    uses("gcheck.machineState"),
  ],
  [
    "Show Syntax Tree shows the tree of the block",
    async () => {
      const editor = await open("part.nc");
      goTo(editor, "G02", 1);
      await vscode.commands.executeCommand("gcheck.showSyntaxTree");
      const text = await answerPage("Syntax Tree of part.nc");
      assert.match(text, /^BLOCK /);
      assert.match(text, /"G02"/);
      await noComplaint();
      await closeAll();
    },
    uses("gcheck.showSyntaxTree"),
  ],
  [
    "Select Control writes a comment into this program",
    async () => {
      const { document } = await create("control.nc", "%\nO1011\nG0 X1.\nM30\n%\n");
      await focus();
      void vscode.commands.executeCommand("gcheck.selectControl");
      await pause(1_000);
      await picture("vscode-select-control");
      await press([...characters("haas-lathe"), "Enter"]);
      await pause(1_000);
      await press([...characters("This"), "Enter"]);
      await until("the comment", () => (document.getText().includes("(gcheck: control=haas-lathe)") ? true : undefined));
      assert.equal(document.lineAt(2).text, "(gcheck: control=haas-lathe)");
      const status = await statusSays(/comment/);
      assert.equal(status.text, "$(circuit-board) haas-lathe");
      assert.match(status.tooltip, /^Haas lathe.*: named by a comment of the program\. Click to change\.$/);
      await noComplaint();
      await closeAll();
    },
    uses("gcheck.selectControl"),
  ],
  [
    "Select Control sets the control of all programs",
    async () => {
      await create("control.nc", "%\nO1011\nG0 X1.\nM30\n%\n");
      await focus();
      void vscode.commands.executeCommand("gcheck.selectControl");
      await pause(1_000);
      await press([...characters("linuxcnc"), "Enter"]);
      await pause(1_000);
      await press([...characters("All"), "Enter"]);
      const status = await statusSays(/settings/);
      assert.equal(status.text, "$(circuit-board) linuxcnc");
      assert.equal(vscode.workspace.getConfiguration("gcheck").get("control"), "linuxcnc");
      await vscode.workspace.getConfiguration("gcheck").update("control", undefined, vscode.ConfigurationTarget.Workspace);
      await statusSays(/a guess/);
      await closeAll();
    },
    uses("gcheck.selectControl", "gcheck.control"),
  ],
  [
    "the status bar says how the control was chosen, and what keeps a program from being checked",
    async () => {
      await create("mill/gcheck.toml", 'control = "haas-mill"\n');
      await create("mill/a.nc", "%\nO1012\nG0 X1.\nM30\n%\n");
      const named = await statusSays(/gcheck\.toml/);
      assert.equal(named.tooltip, "Haas mill (classic control and NGC): named by gcheck.toml. Click to change.");
      fs.writeFileSync(path.join(folder(), "mill/gcheck.toml"), 'control = "haas-mil"\n');
      const broken = await statusSays(/haas-mil`/);
      assert.equal(broken.text, "$(error) not checked");
      fs.writeFileSync(path.join(folder(), "mill/gcheck.toml"), 'control = "haas-mill"\n');
      await statusSays(/named by gcheck\.toml/);
      await closeAll();
    },
  ],
  [
    "Explain Rule or Code shows a page, from the palette and from a hover",
    async () => {
      const editor = await open("part.nc");
      goTo(editor, "G43", 1);
      await vscode.commands.executeCommand("gcheck.explain", "G43");
      const page = await until("the page", async () => {
        const text = await browser<string>("frames");
        return text.includes("tool length") ? text : undefined;
      });
      assert.match(page, /G43 tool length/);
      await picture("vscode-explain");
      await vscode.commands.executeCommand("gcheck.explain", "unknown-code");
      await until("the rule's page", async () => ((await browser<string>("frames")).includes("Why it matters") ? true : undefined));
      // Without a subject it asks, and the word at the cursor is the first guess.
      await closeAll();
      goTo(await open("part.nc"), "G43", 1);
      await focus();
      void vscode.commands.executeCommand("gcheck.explain");
      await pause(1_000);
      await press(["Enter"]);
      await until("the page again", async () => ((await browser<string>("frames")).includes("tool length") ? true : undefined));
      await closeAll();
      const hover = await hoverText((await open("part.nc")).document, place((await open("part.nc")).document, "G43", 1));
      assert.match(hover, /\[All about G43\]\(command:gcheck\.explain\?/);
      await vscode.commands.executeCommand("gcheck.explain", "no-such-rule");
      await until("the message", async () => ((await widgets()).messages.includes("knows no rule and no code") ? true : undefined));
      await vscode.commands.executeCommand("notifications.clearAll");
      await closeAll();
    },
    uses("gcheck.explain"),
  ],
  [
    "Apply All Safe Fixes changes what has a fix that changes no move",
    async () => {
      const { document } = await create("fixes.nc", "%\nO1013\n(gcheck: control=haas-mill)\nG21 G17 G40 G49 G80 G90 G54\nG00 G00 X10. Y10.\nG00 G00 X20. Y10.\nM30\n%\n");
      await until("the finding", () => finding(document, "code-given-twice"));
      await vscode.commands.executeCommand("gcheck.fixAll");
      await until("the fixes", () => (document.getText().includes("\nG00 X10. Y10.\nG00 X20. Y10.\n") ? true : undefined));
      await until("no finding", () => (finding(document, "code-given-twice") === undefined ? true : undefined));
      await closeAll();
    },
    uses("gcheck.fixAll"),
  ],
  [
    "Show Output shows what the server said",
    async () => {
      await vscode.commands.executeCommand("gcheck.showOutput");
      await until("the output", () =>
        vscode.window.visibleTextEditors.some(({ document }) => document.uri.scheme === "output") ? true : undefined,
      );
      await vscode.commands.executeCommand("workbench.action.closePanel");
    },
    uses("gcheck.showOutput"),
  ],
  [
    "Tab takes the first entry of a list, Enter the one that somebody moved to, and else begins a line",
    async () => {
      const { document } = await create("keys.nc", "(gcheck: control=haas-mill)\n");
      await focus();
      await press(["Control+End", "G", "8"], [200, 300]);
      const list = await until("the list", async () => {
        const seen = await widgets();
        return seen.rows.length > 2 ? seen : undefined;
      });
      assert.equal(list.focused, 0, "nothing is chosen before somebody chooses");
      assert.match(list.rows[0] ?? "", /^G80.*canned cycle off/, list.rows.join("; "));
      await picture("vscode-list");
      await press(["Tab", " ", "G", "8", "ArrowDown", "ArrowDown", "Enter", "Enter", "G", "8", "1", "Enter", "G", "8", "Escape", "Enter"], [200, 300]);
      assert.deepEqual(document.getText().split("\n").slice(1), ["G80 G81", "G81", "G8", ""]);
      await closeAll();
    },
    uses("key enter", "key tab"),
  ],
  [
    "a list opens neither after a blank nor for a number, and says what its rows are",
    async () => {
      await create("list.nc", "(gcheck: control=haas-mill)\n");
      await focus();
      await press(["Control+End", ...characters("G00 X1. ")], [150, 200]);
      assert.deepEqual((await widgets()).rows, []);
      await press(characters("Y2"), [150, 200]);
      assert.deepEqual((await widgets()).rows, []);
      await press(["Enter", ...characters("G83 Z-1. ")], [150, 200]);
      await press(["Control+Space"], [500, 600]);
      const { rows } = await until<Widgets>("the list", async () => {
        const seen = await widgets();
        return seen.rows.length > 0 ? seen : undefined;
      });
      assert.match(rows[0] ?? "", /^R.*R plane/, `words of the cycle come first: ${rows.join("; ")}`);
      await picture("vscode-words");
      await closeAll();
    },
  ],
  [
    "help for a block comes while a word is missing, and goes when the block is complete",
    async () => {
      await create("help.nc", "(gcheck: control=haas-mill)\nG54 G90 G20\n");
      await focus();
      await press(["Control+End", ...characters("G83 ")], [150, 200]);
      await until("help", async () => ((await widgets()).help.includes("G83") ? true : undefined));
      await press(characters("Z-1. R0.1 "), [150, 200]);
      await picture("vscode-help");
      assert.match((await widgets()).help, /depth of one peck|feed rate/);
      await press(characters("Q0.1 F8. "), [150, 200]);
      await until("help to go", async () => ((await widgets()).help === "" ? true : undefined));
      await press(["Enter", ...characters("G00 X1. ")], [150, 200]);
      assert.equal((await widgets()).help, "", "a move that lacks nothing has no help");
      await closeAll();
    },
  ],
  [
    "help for a call shows the arguments that the macro reads",
    async () => {
      await create("O9010.nc", "%\nO9010 (BORE)\n(A=#1 DIAMETER)\n(Z=#26 DEPTH)\nIF [#9 EQ #0] THEN #9=100.\nG0 X#1\nG1 Z#26 F#9\nM99\n%\n");
      await create("macro.nc", "(gcheck: control=fanuc-mill)\nG21 G90 G54\n");
      await focus();
      await press(["Control+End", ...characters("G65 P9010 ")], [150, 200]);
      const help = await until("help", async () => {
        const { help } = await widgets();
        return help.includes("A=#1") ? help : undefined;
      });
      assert.match(help, /G65 P \[L\] A=#1 \[F=#9\] Z=#26/);
      assert.match(help, /DIAMETER/);
      await picture("vscode-macro-help");
      await press(characters("A20. Z-5. "), [150, 200]);
      await until("help to go", async () => ((await widgets()).help === "" ? true : undefined));
      await closeAll();
    },
  ],
  [
    "every kind of action changes the program as its title says",
    async () => {
      const { document } = await create("actions.nc", ACTIONS);
      await until("the finding", () => finding(document, "missing-decimal-point"));
      const lines = (text: string) => text.split("\n");
      assert.match(await afterAction(document, "X10 Y5", /^Write a decimal point/), /^G0 X10\. Y5\.[^]*G0 Z50$/m);
      assert.ok(lines(await afterAction(document, "X10 Y5", /^Fix all 2 `missing-decimal-point` findings/)).includes("G0 X10. Y5."));
      assert.match(await afterAction(document, "X10 Y5", /^Ignore `missing-decimal-point` on this line/), /gcheck: ignore missing-decimal-point/);
      assert.match(await afterAction(document, "X10 Y5", /^Ignore `missing-decimal-point` in this file/), /gcheck: ignore-file missing-decimal-point/);
      assert.match(await afterAction(document, "R20.", /^Write this arc with its centre/), /^G2 X20\. Y15\. I/m);
      assert.ok(lines(await afterAction(document, "G0 Z5.", /^Add block delete to this block/)).includes("/G0 Z5."));
      assert.match(await afterAction(document, "O1010", /^Renumber blocks in tens/), /^N(\d+0) G0 Z50$[^]*GOTO \1$/m);
      assert.ok(lines(await afterAction(document, "O1010", /^Write 3 numbers with decimal points/)).includes("G0 X0.01 Y0.005"));
      assert.ok(lines(await afterAction(document, "O1010", /^Write decimal points after 3 numbers/)).includes("G0 X10. Y5."));
      const offered = await actionsAt(document, "X10 Y5");
      const explain = offered.find(({ title }) => title === "Explain `missing-decimal-point`");
      assert.equal(explain?.command?.command, "gcheck.explain");
      await vscode.commands.executeCommand(explain.command.command, ...(explain.command.arguments ?? []));
      useAction(explain.title);
      await until("the page", async () => ((await browser<string>("frames")).includes("missing-decimal-point") ? true : undefined));
      await closeAll();
    },
    uses("action fix", "action fix-rule", "action ignore-line", "action ignore-file", "action explain", "action arc-by-centre", "action add-block-delete", "action renumber-in-tens", "action write-counted", "action add-points"),
  ],
  [
    "changes with proof are made where the cursor is, of a selection and of the whole program",
    async () => {
      const { document } = await create("proved.nc", ACTIONS.replace("X10 Y5", "X10. Y5.").replace("Z50\n", "Z50.\n").replace(/^IF .*\n/m, ""));
      const cycle = place(document, "G81");
      const atCursor = await afterProof(document, new vscode.Range(cycle, cycle), /^Write this cycle as plain moves, with proof$/);
      assert.match(atCursor, /^G98$\n^G0 X30\.[^]*^G0?1 Z-3\. F50\.$[^]*^G80$/m);
      const cut = document.lineAt(place(document, "G1 Z-1.").line).range;
      const slower = await afterProof(document, cut, /^Scale the feeds to 90 % in the selected lines, with proof$/);
      assert.match(slower, /^G1 Z-1\. F90\.$\n^G2 X20\. Y15\. R20\. F100\.$/m);
      const top = new vscode.Range(0, 0, 0, 0);
      const mirrored = await afterProof(document, top, /^Mirror the path at X0 .*, with proof$/);
      assert.match(mirrored, /^G0 X-10\. Y5\.$[^]*^G3 X-20\. Y15\. R20\.$/m);
      await closeAll();
    },
  ],
  [
    "every change with a proof makes of the program what its title says",
    async () => {
      for (const [name, title, text, result] of CHANGES) {
        const { document } = await create(`change-${name}.nc`, text);
        const after = await afterProof(document, new vscode.Range(0, 0, 0, 0), title);
        assert.match(after, result, `${name} gives\n${after}`);
        await closeAll();
        fs.rmSync(document.fileName);
      }
    },
    uses(
      "action expand-cycle",
      "action fold-cycle",
      "action unroll-loop",
      "action absolute",
      "action incremental",
      "action mm",
      "action inch",
      "action safe-start",
      "action feeds-90",
      "action feeds-110",
      "action speeds-90",
      "action speeds-110",
      "action mirror-x",
      "action mirror-y",
      "action rotate-90",
      "action rotate-180",
      "action rotate-270",
    ),
  ],
  [
    "the section of a tool moves up and down as a whole, with its comments",
    async () => {
      const { document } = await create("sections.nc", SECTIONS);
      const at = (text: string) => new vscode.Range(place(document, text), place(document, text));
      const drilledFirst = /G54\n\(DRILL\)\nT2 M6\n[^]*G80\nG91 G28 Z0\. M5\n\(MILL\)\nT1 M6\n[^]*G91 G28 Z0\. M5\nM30\n/;
      const down = await afterProof(document, at("G1 Z-1."), /^Move this tool section down, with proof$/);
      assert.match(down, drilledFirst);
      const up = await afterProof(document, at("T2 M6"), /^Move this tool section up, with proof$/);
      assert.match(up, drilledFirst);
      await closeAll();
    },
    uses("action section-up", "action section-down"),
  ],
  [
    "a change that is refused when it is chosen says why, and no request fails",
    async () => {
      const { document } = await create("refused.nc", PROVED);
      const kind = vscode.CodeActionKind.RefactorRewrite.value;
      const offered = await askList<vscode.CodeAction>("vscode.executeCodeActionProvider", document, new vscode.Range(0, 0, 0, 0), kind, 100);
      const increments = offered.find(({ title }) => title.startsWith("Write absolute coordinates as increments"));
      assert.ok(increments !== undefined && increments.edit === undefined, "nothing is changed");
      const said = await until("the reason", async () => {
        const { messages } = await widgets();
        return messages.includes("cannot write increments: line 21: this block runs more than once") ? messages : undefined;
      });
      assert.doesNotMatch(said, /Request .* failed/);
      await picture("vscode-refused");
      await vscode.commands.executeCommand("notifications.clearAll");
      await closeAll();
    },
  ],
  [
    "an arc with a centre is written with its radius, and a block without its slash",
    async () => {
      const text = "%\nO1021\n(gcheck: control=haas-mill)\nG21 G17 G90 G54\nG0 X0. Y0.\nG2 X10. Y10. I10. J0. F100.\n/G0 Z50.\nM30\n%\n";
      const { document } = await create("arc.nc", text);
      assert.match(await afterAction(document, "I10.", /^Write this arc with its radius$/), /^G2 X10\. Y10\. R10\. F100\.$/m);
      assert.match(await afterAction(document, "G0 Z50.", /^Remove block delete from this block$/), /^G0 Z50\.$/m);
      await closeAll();
    },
    uses("action arc-by-radius", "action remove-block-delete"),
  ],
  [
    "all fixes that change no move are one action",
    async () => {
      const text = "%\nO1022\n(gcheck: control=haas-mill)\nG21 G17 G40 G49 G80 G90 G54\nG00 G00 X10. Y10.\nG00 G00 X20. Y10.\nM30\n%\n";
      const { document } = await create("all.nc", text);
      await until("the finding", () => finding(document, "code-given-twice"));
      assert.match(await afterAction(document, "X20.", /^Fix all \d+ findings whose fixes change no move$/), /\nG00 X10\. Y10\.\nG00 X20\. Y10\.\n/);
      await closeAll();
    },
    uses("action fix-all"),
  ],
  [
    "the action that numbers the blocks again asks how",
    async () => {
      const text = "%\nO1023\n(gcheck: control=haas-mill)\nG21 G17 G40 G49 G80 G90 G54\nGOTO 7\nN3 G0 X5.\nN7 G0 X1.\nM30\n%\n";
      const { document } = await create("again.nc", text);
      await focus();
      const kind = vscode.CodeActionKind.RefactorRewrite.value;
      const offered = await askList<vscode.CodeAction>("vscode.executeCodeActionProvider", document, new vscode.Range(0, 0, 0, 0), kind);
      const action = offered.find(({ title }) => title.startsWith("Number the blocks again"));
      assert.ok(action?.command, offered.map(({ title }) => title).join("; "));
      void vscode.commands.executeCommand(action.command.command, ...(action.command.arguments ?? []));
      useAction(action.title);
      await until("the question", async () => ((await widgets()).dialog ? true : undefined));
      await pause(500);
      await press([...characters("50:50"), "Enter"]);
      await until("the numbers", () => (document.getText().includes("GOTO 100\nN50 G0 X5.\nN100 G0 X1.\n") ? true : undefined));
      await closeAll();
    },
    uses("action renumber"),
  ],
  [
    "findings of a rule that repeats are folded, and shown one by one with the setting",
    async () => {
      const blocks = Array.from({ length: 12 }, (_, i) => `G00 G00 X${i}.`).join("\n");
      const text = `%\nO1024\n(gcheck: control=haas-mill)\nG21 G17 G40 G49 G80 G90 G54\n${blocks}\nM30\n%\n`;
      const { document } = await create("repeats.nc", text);
      const twice = () => vscode.languages.getDiagnostics(document.uri).filter((found) => rule(found) === "code-given-twice");
      const folded = await until("the findings", () => (twice().length === 6 ? twice() : undefined));
      assert.ok(folded.some(({ message }) => /and 7 more of code-given-twice, lines 10 to 16/.test(message)), folded.map(({ message }) => message).join("; "));
      await withSetting("foldRepeats", false, async () => {
        await until("each finding", () => (twice().length === 12 ? true : undefined));
      });
      await until("the fold", () => (twice().length === 6 ? true : undefined));
      await closeAll();
    },
    uses("gcheck.foldRepeats"),
  ],
  [
    "Shift Path asks how far, and changes the selected lines or the program with its proof",
    async () => {
      const text = ACTIONS.replace("X10 Y5", "X10. Y5.").replace("Z50\n", "Z50.\n").replace(/^IF .*\n/m, "");
      const editor = await create("shift.nc", text);
      const { document } = editor;
      await focus();
      void vscode.commands.executeCommand("gcheck.shiftPath");
      await until("the question", async () => ((await widgets()).dialog ? true : undefined));
      await pause(500);
      await press([...characters("X10 Y-0.1in"), "Enter"]);
      await until("the shift", () => (document.getText().includes("G0 X20. Y2.46") ? true : undefined));
      assert.match(document.getText(), /^G2 X30\. Y12\.46 R20\.$[^]*^G98 G81 X40\. Y2\.46 Z-3\. R1\. F50\.$/m);
      await vscode.commands.executeCommand("undo");
      assert.equal(document.getText(), text);
      const cycle = document.lineAt(place(document, "G98 G81").line).range;
      editor.selection = new vscode.Selection(cycle.start, cycle.end);
      // As somebody takes the action: its command asks.
      const kind = vscode.CodeActionKind.RefactorRewrite.value;
      const offered = await askList<vscode.CodeAction>("vscode.executeCodeActionProvider", document, cycle, kind);
      const action = offered.find(({ title }) => title.startsWith("Shift the path in the selected lines"));
      assert.ok(action?.command, offered.map(({ title }) => title).join("; "));
      void vscode.commands.executeCommand(action.command.command, ...(action.command.arguments ?? []));
      useAction(action.title);
      await until("the question", async () => ((await widgets()).dialog ? true : undefined));
      await pause(500);
      await picture("vscode-shift");
      await press([...characters("Z-1"), "Enter"]);
      await until("the shift", () => (document.getText().includes("Z-4. R0.") ? true : undefined));
      assert.equal(document.getText().replace("Z-4. R0.", "Z-3. R1."), text, "nothing else changes");
      await noComplaint();
      await vscode.commands.executeCommand("workbench.action.files.revert");
      await closeAll();
    },
    uses("gcheck.shiftPath", "action translate"),
  ],
  [
    "a shift that cannot be proved says why, and changes nothing",
    async () => {
      const text = "%\nO1016\n(gcheck: control=haas-mill)\nG21 G17 G40 G49 G80 G90 G54\nG0 X1.\nGOTO 77\nM30\n%\n";
      const { document } = await create("unproved.nc", text);
      await focus();
      void vscode.commands.executeCommand("gcheck.shiftPath");
      await until("the question", async () => ((await widgets()).dialog ? true : undefined));
      await pause(500);
      await press([...characters("X10"), "Enter"]);
      await until("the reason", async () => ((await widgets()).messages.includes("cannot shift the path") ? true : undefined));
      assert.equal(document.getText(), text);
      await vscode.commands.executeCommand("notifications.clearAll");
      await closeAll();
    },
  ],
  [
    "Renumber Blocks asks for the first number and the step",
    async () => {
      const text = "%\nO1017\n(gcheck: control=haas-mill)\nG21 G17 G40 G49 G80 G90 G54\nGOTO 7\nN3 G0 X5.\nN7 G0 X1.\nM30\n%\n";
      const { document } = await create("numbers.nc", text);
      await focus();
      void vscode.commands.executeCommand("gcheck.renumber");
      await until("the question", async () => ((await widgets()).dialog ? true : undefined));
      await pause(500);
      await press([...characters("100:5"), "Enter"]);
      await until("the numbers", () => (document.getText().includes("N105 G0 X1.") ? true : undefined));
      assert.match(document.getText(), /^GOTO 105\nN100 G0 X5\.\nN105 G0 X1\.$/m);
      await noComplaint();
      await vscode.commands.executeCommand("workbench.action.files.revert");
      await closeAll();
    },
    uses("gcheck.renumber"),
  ],
  [
    "gcheck.toml has hover, completion and findings, without any other extension",
    async () => {
      const text = 'control = "haas-mill"\n\n[machine]\nunits = "mm"\nmax_rpm = 8000\n\n[tools]\n3 = { length = 80.0 }\n\n[offsets]\nG54 = { X = -400.0 }\n\n[codes]\nM51 = { title = "door" }\n';
      const editor = await create("shop/gcheck.toml", text);
      const { document } = editor;
      assert.match(await hoverText(document, place(document, "max_rpm", 1)), /machine\.max_rpm[^]*number[^]*Highest spindle speed, in 1\/min/);
      assert.match(await hoverText(document, place(document, "haas-mill", 1)), /Haas mill/);
      // Typed as somebody types, with the list open: what is typed stays, and Tab takes a row.
      goTo(editor, "max_rpm");
      await focus();
      await press(["End", "Enter", ...characters("tool_changer = ")], [100, 180]);
      await press(['"', "a"], [200, 300]);
      const { rows } = await until<Widgets>("the list", async () => {
        const seen = await widgets();
        return seen.rows.some((row) => row.startsWith("arm")) ? seen : undefined;
      });
      await picture("vscode-configuration");
      assert.ok(!rows.some((row) => row.startsWith("carousel") && rows.indexOf(row) === 0), rows.join("; "));
      await press(["Tab", "End", "Enter", ...characters("max_fe")], [200, 300]);
      await until("the keys", async () => ((await widgets()).rows.some((row) => row.startsWith("max_feed")) ? true : undefined));
      await press(["Tab"], [200, 300]);
      await until("the key", () => (document.getText().includes("max_feed = ") ? true : undefined));
      await press([...characters("fast"), "Escape"], [100, 180]);
      assert.match(document.getText(), /^max_rpm = 8000\ntool_changer = "arm"\nmax_feed = fast$/m);
      const wrong = () => vscode.languages.getDiagnostics(document.uri);
      await until("the finding", () => wrong().find(({ range }) => range.start.line === 6));
      await press(["Backspace", "Backspace", "Backspace", "Backspace", ...characters("5000")], [100, 180]);
      await until("the finding to go", () => (wrong().length === 0 ? true : undefined));
      assert.ok(await document.save());
      await noComplaint();
    },
  ],
  [
    "tools, work offsets and codes of the shop lead to their entries in gcheck.toml",
    async () => {
      const { document } = await create("shop/part.nc", "%\nO1018\nT3 M6\nG90 G54 G0 X0.\nG43 H3 Z5.\nM51\nM30\n%\n");
      for (const [word, key] of [["T3", "3"], ["H3", "3"], ["G54", "G54"], ["M51", "M51"]] as const) {
        const target = await until(`the entry of ${word}`, async () => {
          const found = await vscode.commands.executeCommand<(vscode.Location | vscode.LocationLink)[]>(
            "vscode.executeDefinitionProvider",
            document.uri,
            place(document, word, 1),
          );
          return found[0];
        });
        const [uri, range] = "targetUri" in target ? [target.targetUri, target.targetRange] : [target.uri, target.range];
        assert.equal(path.basename(uri.fsPath), "gcheck.toml");
        const configuration = await vscode.workspace.openTextDocument(uri);
        assert.equal(configuration.getText(range), key);
      }
      await closeAll();
      fs.rmSync(path.join(folder(), "shop"), { recursive: true });
    },
  ],
  [
    "lenses are above the tools, and go with their setting",
    async () => {
      const { document } = await open("pocket.nc");
      const lenses = await askList<vscode.CodeLens>("vscode.executeCodeLensProvider", document);
      const titles = lenses.map((lens) => lens.command?.title ?? "");
      assert.match(titles[0] ?? "", /^\d+:\d\d in all/, titles.join("; "));
      assert.ok(titles.some((title) => /^T1 · 10 mm end mill · \d+:\d\d · X -?\d/.test(title)), titles.join("; "));
      const inText = async () => (await widgets()).lenses;
      // The editor draws the lenses of the lines that are in view.
      await vscode.commands.executeCommand("cursorTop");
      await until("lenses in the text", async () => ((await inText()).length > 0 ? true : undefined));
      await withSetting("codeLens", false, async () => {
        await until("no lenses", async () => ((await inText()).length === 0 ? true : undefined));
      });
      await closeAll();
    },
    uses("gcheck.codeLens", "lens program", "lens tool"),
  ],
  [
    "each kind of hint is shown, and goes with its setting",
    async () => {
      const text = "%\nO1014\n(gcheck: control=haas-mill)\n(T5 REAMER)\nG21 G17 G40 G49 G80 G90 G54\nT5 M6\nS900 M3\nG43 H5 Z5.\n#100=2.\n#101=#100*2.\nG0 X0. Y0.\nG94 F100.\nG1 Z-1.\nS800\nX#101\nG91 X3.\nG90\nM30\n%\n";
      const { document } = await create("hints.nc", text);
      const kinds: [string, RegExp, string][] = [
        ["feed", /^F100 mm\/min$/, "G1 Z-1."],
        ["speed", /^S900 rpm$/, "G1 Z-1."],
        ["values", /^= 4$/, "%"],
        ["positions", /^→ X7$/, "%"],
        ["tools", /^REAMER$/, "%"],
      ];
      const has = (labels: string[], pattern: RegExp) => labels.some((label) => pattern.test(label));
      for (const [kind, pattern, first] of kinds) {
        const from = place(document, first).line;
        await hintsBecome(document, from, kind, (labels) => has(labels, pattern));
        await withSetting(`inlayHints.${kind}`, false, async () => {
          await hintsBecome(document, from, `no ${kind}`, (labels) => !has(labels, pattern) && labels.length > 0);
        });
        await hintsBecome(document, from, `${kind} again`, (labels) => has(labels, pattern));
      }
      await picture("vscode-hints");
      await closeAll();
    },
    uses("gcheck.inlayHints.feed", "gcheck.inlayHints.speed", "gcheck.inlayHints.values", "gcheck.inlayHints.positions", "gcheck.inlayHints.tools"),
  ],
  [
    "gcheck.run checks when a program is saved",
    async () => {
      await withSetting("run", "onSave", async () => {
        const editor = await create("run.nc", "%\nO1015\n(gcheck: control=haas-mill)\nG21 G17 G40 G49 G80 G90 G54\nG0 X1.\nM30\n%\n");
        await pause(2_000);
        await editor.edit((change) => change.replace(new vscode.Range(4, 0, 4, 2), "G999"));
        await pause(2_000);
        assert.equal(finding(editor.document, "unknown-code"), undefined, "nothing is found before it is saved");
        await editor.document.save();
        await until("the finding", () => finding(editor.document, "unknown-code"));
      });
      await closeAll();
    },
    uses("gcheck.run"),
  ],
  [
    "gcheck.configPath names the configuration of all programs",
    async () => {
      const { document } = await open("part.nc");
      await until("the finding", () => finding(document, "unknown-code"));
      const file = path.join(folder(), "other.toml");
      fs.writeFileSync(file, 'control = "haas-mill"\n[rules]\nunknown-code = "off"\n');
      await withSetting("configPath", file, async () => {
        await until("no finding", () => (finding(document, "unknown-code") === undefined ? true : undefined));
      });
      await until("the finding again", () => finding(document, "unknown-code"));
      await closeAll();
    },
    uses("gcheck.configPath"),
  ],
  [
    "gcheck.path names the server",
    async () => {
      const { server } = await api();
      const bundled = server.path;
      assert.ok(bundled);
      const other = path.join(folder(), "gcheck-elsewhere");
      fs.copyFileSync(bundled, other);
      const { document } = await open("part.nc");
      await withSetting("path", other, async () => {
        await until("the other server", () => (server.path === other && server.isRunning ? true : undefined));
        await until("the finding", () => finding(document, "unknown-code"));
      });
      await until("the bundled server", () => (server.path === bundled && server.isRunning ? true : undefined));
      await until("the finding", () => finding(document, "unknown-code"));
      fs.rmSync(other);
      await closeAll();
    },
    uses("gcheck.path"),
  ],
  [
    "gcheck.trace.server writes the messages",
    async () => {
      await withSetting("trace.server", "messages", async () => {
        const { document } = await open("part.nc");
        // What a channel holds is in a file that VS Code writes by a library which is not there in every installation.
        const output: { appendLine(line: string): void } = Reflect.get((await api()).server, "output");
        const told: string[] = [];
        const appendLine = output.appendLine.bind(output);
        output.appendLine = (line) => (told.push(line), appendLine(line));
        await hoverText(document, place(document, "G43", 1));
        assert.ok(told.some((line) => line.includes("textDocument/hover")), told.join("\n"));
        output.appendLine = appendLine;
      });
      await vscode.commands.executeCommand("workbench.action.closePanel");
      await closeAll();
    },
    uses("gcheck.trace.server"),
  ],
  [
    "the problem matcher reads what the command line prints",
    async () => {
      const { server } = await api();
      const matcher = vscode.extensions.getExtension("gcheck.gcheck")?.packageJSON.contributes.problemMatchers[0];
      use(`problem matcher ${matcher.name}`);
      let printed = "";
      try {
        printed = execFileSync(server.path ?? "", ["check", "--output-format", "concise", "part.nc"], { cwd: folder(), encoding: "utf8" });
      } catch (error) {
        printed = String((error as { stdout: string }).stdout);
      }
      const found = printed.split("\n").map((line) => new RegExp(matcher.pattern.regexp).exec(line)).find((match) => match?.[5] === "unknown-code");
      assert.ok(found, printed);
      assert.deepEqual([found[1], found[2], found[4]], ["part.nc", "6", "error"]);
    },
    uses("problem matcher gcheck"),
  ],
  [
    "a program in capitals that comes or goes on disk is noticed",
    async () => {
      const { document } = await create("caller.nc", "%\nO1016\n(gcheck: control=haas-mill)\nG21 G17 G40 G49 G80 G90 G54\nM98 P4711\nM30\n%\n");
      await until("the finding", () => finding(document, "missing-program") ?? vscode.languages.getDiagnostics(document.uri).find((d) => d.message.includes("4711")));
      fs.writeFileSync(path.join(folder(), "O4711.NC"), "%\nO4711\nG0 X1.\nM99\n%\n");
      await until("the finding to go", () =>
        vscode.languages.getDiagnostics(document.uri).some((d) => d.message.includes("4711")) ? undefined : true,
      );
      await closeAll();
    },
  ],
  [
    "the walkthrough opens",
    async () => {
      await vscode.commands.executeCommand("workbench.action.openWalkthrough", "gcheck.gcheck#start", false);
      await pause(2_000);
      await picture("vscode-walkthrough");
      await closeAll();
    },
    uses("walkthrough start"),
  ],
];
