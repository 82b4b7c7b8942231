// The features of the protocol, each once, with the real server.

import * as assert from "node:assert/strict";
import * as fs from "node:fs";
import * as path from "node:path";

import * as vscode from "vscode";

import { api, askList, browser, closeAll, create, edit, finding, focus, folder, goTo, hoverText, open, picture, place, press, type Test, until, uses, widgets } from "./harness";

const aFindingAppears: Test = [
  "a finding appears, with a link to its page",
  async () => {
    const { document } = await open("part.nc");
    const found = await until("the finding", () => finding(document, "unknown-code"));
    assert.equal(document.getText(found.range), "G54.1");
    assert.equal(found.source, "gcheck");
    assert.ok(typeof found.code === "object" && found.code.target.toString().includes("unknown-code"));
  },
];

const theBundledServerRuns: Test = [
  "the server of the package runs",
  async () => {
    const { server } = await api();
    const extension = vscode.extensions.getExtension("gcheck.gcheck");
    assert.equal(server.path, extension && path.join(extension.extensionPath, "server", "gcheck"));
    assert.ok(server.isRunning);
  },
];

/** In a folder that nobody has said to trust, and that names a server of its own. */
export const restricted: Test[] = [
  [
    "the folder is not trusted, and what it sets is not read",
    async () => {
      assert.equal(vscode.workspace.isTrusted, false);
      const set = vscode.workspace.getConfiguration("gcheck");
      assert.notEqual(set.inspect("path")?.workspaceValue, "", "the folder names a server");
      assert.equal(set.get("path"), "");
    },
  ],
  theBundledServerRuns,
  aFindingAppears,
];

/** Opens a program of more than twenty moves with its toolpath beside it. */
async function drawn(name: string): Promise<vscode.TextEditor> {
  const { preview } = await api();
  const editor = await open(name);
  let pieces = 0;
  const subscription = preview.onDrawn((drawing) => (pieces = drawing.pieces));
  await vscode.commands.executeCommand("gcheck.showToolpath");
  await until("the drawing", () => (pieces > 20 ? true : undefined));
  subscription.dispose();
  return editor;
}

export const trusted: Test[] = [
  theBundledServerRuns,
  aFindingAppears,
  [
    "hover tells a code and the state",
    async () => {
      const { document } = await open("part.nc");
      const text = await hoverText(document, place(document, "G43"));
      assert.match(text, /G43/);
      assert.match(text, /tool length/i);
      assert.match(text, /^\*\*G43\*\*[^]*Z1`[^]*in effect: [^]*---[^]*here or earlier `H`/, "the state is above what manuals tell");
      // The findings of the line are the editor's to show.
      assert.doesNotMatch(await hoverText(document, place(document, "G54.1", 1)), /unknown code/);
      goTo(await open("part.nc"), "G43", 1);
      await focus();
      await vscode.commands.executeCommand("editor.action.showHover");
      await picture("vscode-hover");
    },
  ],
  [
    "a fix clears its finding",
    async () => {
      const { document } = await open("fixable.nc");
      const found = await until("the finding", () => finding(document, "code-given-twice"));
      const actions = await vscode.commands.executeCommand<vscode.CodeAction[]>(
        "vscode.executeCodeActionProvider",
        document.uri,
        found.range,
        vscode.CodeActionKind.QuickFix.value,
        20,
      );
      const fix = actions.find((action) => action.edit !== undefined && action.title.startsWith("Remove the second"));
      assert.ok(fix?.edit, `a fix is offered; there are: ${actions.map((action) => action.title).join(", ")}`);
      assert.ok(await vscode.workspace.applyEdit(fix.edit));
      await until("the finding to go", () => (finding(document, "code-given-twice") === undefined ? true : undefined));
    },
  ],
  [
    "findings follow typing",
    async () => {
      const { document } = await open("typed.nc");
      await until("no finding", () => (vscode.languages.getDiagnostics(document.uri).length === 0 ? true : undefined));
      await edit(document, (change) => change.replace(document.uri, new vscode.Range(4, 0, 4, 3), "G999"));
      await until("the finding", () => finding(document, "unknown-code"));
      await edit(document, (change) => change.replace(document.uri, new vscode.Range(4, 0, 4, 4), "G01"));
      await until("the finding to go", () => (finding(document, "unknown-code") === undefined ? true : undefined));
    },
  ],
  [
    "a program is renamed across files",
    async () => {
      const { document } = await open("main.nc");
      const change = await until("rename", async () => {
        const answer = await vscode.commands.executeCommand<vscode.WorkspaceEdit>(
          "vscode.executeDocumentRenameProvider",
          document.uri,
          place(document, "P2000").translate(0, 1),
          "2500",
        );
        return answer.size > 0 ? answer : undefined;
      });
      const files = change.entries().map(([uri]) => path.basename(uri.fsPath)).sort();
      assert.deepEqual(files, ["O2000.nc", "main.nc"]);
      assert.ok(await vscode.workspace.applyEdit(change));
      assert.match(document.getText(), /M98 P2500/);
    },
  ],
  [
    "go to definition crosses files",
    async () => {
      await vscode.commands.executeCommand("workbench.action.files.revert");
      const { document } = await open("calls.nc");
      const [target] = await until("definition", async () => {
        const found = await vscode.commands.executeCommand<(vscode.Location | vscode.LocationLink)[]>(
          "vscode.executeDefinitionProvider",
          document.uri,
          place(document, "P3000").translate(0, 1),
        );
        return found.length > 0 ? found : undefined;
      });
      const uri = target && ("targetUri" in target ? target.targetUri : target.uri);
      assert.equal(uri && path.basename(uri.fsPath), "O3000.nc");
    },
  ],
  [
    "symbols, folding, tokens, completion, hints and lenses are there",
    async () => {
      const { document } = await open("part.nc");
      const symbols = await askList<vscode.DocumentSymbol>("vscode.executeDocumentSymbolProvider", document);
      const names = symbols.flatMap((symbol) => [symbol, ...symbol.children]).map((symbol) => symbol.name);
      assert.ok(names.some((name) => name.includes("T1")), `T1 is in the outline; there are ${names.join(", ")}`);
      await askList("vscode.executeFoldingRangeProvider", document);
      await askList("vscode.executeCodeLensProvider", document);
      const whole = new vscode.Range(0, 0, document.lineCount, 0);
      await askList("vscode.executeInlayHintProvider", document, whole);
      const tokens = await vscode.commands.executeCommand<vscode.SemanticTokens>(
        "vscode.provideDocumentSemanticTokens",
        document.uri,
      );
      assert.ok(tokens.data.length > 0, "semantic tokens");
      const list = await vscode.commands.executeCommand<vscode.CompletionList>(
        "vscode.executeCompletionItemProvider",
        document.uri,
        place(document, "G43").translate(0, 1),
      );
      const labels = list.items.map((item) => (typeof item.label === "string" ? item.label : item.label.label));
      assert.ok(labels.some((label) => label.startsWith("G81")), `G81 is offered; there are ${labels.slice(0, 20).join(" ")}`);
    },
  ],
  [
    "the toolpath is drawn beside the text",
    async () => {
      goTo(await drawn("pocket.nc"), "G03");
      await picture("vscode-toolpath");
    },
    uses("gcheck.showToolpath"),
  ],
  [
    "the options of the toolpath colour, cut, measure and save it",
    async () => {
      const editor = await drawn("pocket.nc");
      const inToolpath = (what: object) => browser<string>("inToolpath", what);
      // The page is too narrow for them to be open from the start.
      await inToolpath({ do: "click", at: "#options" });
      const legend = await inToolpath({ do: "choose", at: "#choices select", with: "feed", read: "#choices .legend" });
      assert.match(legend, /^Feed along the path, mm\/min\n/);
      await picture("vscode-toolpath-feed");
      await inToolpath({ do: "choose", at: "#choices select", with: "height" });
      await picture("vscode-toolpath-height");
      await inToolpath({ do: "choose", at: "#choices select", with: "tool" });
      // The centre of a circle, by the line that the cursor is in.
      goTo(editor, "G03 I-20.");
      await until("the line to be chosen", async () => {
        const said = await inToolpath({ do: "click", at: "#choices button:text-is('Centre')", read: "#choices .measured" });
        return said.includes("centre of the arc, R 20.000") ? true : undefined;
      });
      await inToolpath({ do: "press", at: "#canvas", with: "Escape" });
      assert.equal(await inToolpath({ read: "#choices .result" }), "", "Escape ends the measure");
      const wanted = path.join(path.dirname(editor.document.fileName), "pocket.png");
      await inToolpath({ do: "click", at: "#choices button:text-is('PNG')" });
      await until("the dialog", async () => ((await widgets()).dialog ? true : undefined));
      await picture("vscode-toolpath-save");
      await press(["Enter"]);
      const bytes = await until("the picture", () => (fs.existsSync(wanted) ? fs.readFileSync(wanted) : undefined));
      assert.deepEqual([...bytes.subarray(1, 4)], [..."PNG"].map((letter) => letter.charCodeAt(0)));
      fs.rmSync(wanted);
      await inToolpath({ do: "click", at: "#options" });
    },
  ],
  [
    "a program that makes no move for a while keeps the options of its toolpath",
    async () => {
      const { preview } = await api();
      const editor = await open("pocket.nc");
      const whole = editor.document.getText();
      const inToolpath = (what: object) => browser<string>("inToolpath", what);
      const replace = (text: string) =>
        editor.edit((edit) => edit.replace(new vscode.Range(0, 0, editor.document.lineCount, 0), text));
      let pieces = 0;
      const subscription = preview.onDrawn((drawn) => (pieces = drawn.pieces));
      await vscode.commands.executeCommand("gcheck.showToolpath");
      await until("the drawing", () => (pieces > 20 ? true : undefined));
      await inToolpath({ do: "choose", at: "#view", with: "top" });
      await inToolpath({ do: "click", at: "#options" });
      await inToolpath({ do: "choose", at: "#choices select", with: "feed" });
      await inToolpath({ do: "press", at: "#canvas", with: " " });
      await replace("%\nO1006\n(gcheck: control=haas-mill)\nM30\n%\n");
      await until("the message", async () =>
        (await inToolpath({ read: "#nothing" })).startsWith("The program makes no move.") ? true : undefined);
      assert.equal(await inToolpath({ read: "#readout" }), "", "nothing is played");
      pieces = 0;
      await replace(whole.replace("G03 I-20.", "G03 I-19."));
      await until("the drawing to come back", () => (pieces > 20 ? true : undefined));
      assert.match(await inToolpath({ read: "#choices .legend" }), /^Feed along the path, mm\/min\n/);
      assert.match(await inToolpath({ read: "#choices .tools" }), /Former path/);
      assert.equal(await inToolpath({ read: "#view" }), "top");
      await picture("vscode-toolpath-former");
      await inToolpath({ do: "choose", at: "#choices select", with: "tool" });
      await inToolpath({ do: "click", at: "#options" });
      subscription.dispose();
      await vscode.commands.executeCommand("workbench.action.files.revert");
    },
  ],
  [
    "keys step through the toolpath by operations and tools, and the cursor goes along",
    async () => {
      const { preview } = await api();
      const text = "%\nO1\n(gcheck: control=haas-mill)\nG21 G90 G54\nT1 M6 (END MILL)\nG0 X0. Y0. S900 M3\nG43 H1 Z5.\n(SLOT)\nG1 Z-1. F100.\nY20.\nG0 Z5.\n(STEP)\nX30.\nG1 Z-2.\nG0 Z50.\nT2 M6 (DRILL)\nG0 X5. Y5. S500 M3\nG43 H2 Z5.\nG1 Z-3. F50.\nG0 Z50.\nM30\n%\n";
      let pieces = 0;
      const subscription = preview.onDrawn((drawn) => (pieces = drawn.pieces));
      const editor = await create("steps.nc", text);
      await vscode.commands.executeCommand("gcheck.showToolpath");
      await until("the drawing", () => (pieces > 6 ? true : undefined));
      const key = (name: string) => browser<string>("inToolpath", { do: "press", at: "#canvas", with: name, read: "#readout" });
      assert.match(await key("S"), /^line 15 /, "to the end of the operation before");
      assert.match(await key("S"), /^line 11 /);
      await until("the cursor", () => (editor.selection.active.line === 10 ? true : undefined));
      assert.match(await key("s"), /^line 15 /);
      assert.match(await key("t"), /^line 20 /, "to the end of the next tool");
      assert.match(await key("T"), /^line 15 /);
      assert.match(await browser<string>("inToolpath", { do: "click", at: "#next-operation", read: "#readout" }), /^line 20 /);
      await picture("vscode-toolpath-steps");
      subscription.dispose();
      await closeAll();
      fs.rmSync(path.join(folder(), "steps.nc"));
    },
  ],
  [
    "programs of one name in two folders have a view each",
    async () => {
      const { preview } = await api();
      const program = (y: number) => `%\nO1\n(gcheck: control=haas-mill)\nG21 G90 G54\nT1 M6\nG0 X0. Y0. S900 M3\nG43 H1 Z5.\nG1 Z-1. F100.\nY${y}.\nG0 Z50.\nM30\n%\n`;
      const inToolpath = (what: object) => browser<string>("inToolpath", what);
      let drawings = 0;
      const subscription = preview.onDrawn(() => drawings++);
      await create("one/same.nc", program(10));
      await vscode.commands.executeCommand("gcheck.showToolpath");
      await until("the drawing", () => (drawings > 0 ? true : undefined));
      await inToolpath({ do: "choose", at: "#view", with: "top" });
      drawings = 0;
      await create("two/same.nc", program(20));
      await until("the other drawing", () => (drawings > 0 ? true : undefined));
      assert.equal(await inToolpath({ read: "#view" }), "iso");
      subscription.dispose();
      await closeAll();
      for (const name of ["one", "two"]) {
        fs.rmSync(path.join(folder(), name), { recursive: true });
      }
    },
  ],
  [
    "an alarm marks the picture and leaves the rest of it",
    async () => {
      const { preview } = await api();
      const editor = await open("pocket.nc");
      let drawn = { pieces: 0, alarms: 0 };
      const subscription = preview.onDrawn((news) => (drawn = news));
      await vscode.commands.executeCommand("gcheck.showToolpath");
      await until("the drawing", () => (drawn.pieces > 20 && drawn.alarms === 0 ? true : undefined));
      const whole = drawn.pieces;
      await editor.edit((edit) => edit.insert(place(editor.document, "G03").with({ character: 0 }), "GOTO 77\n"));
      await until("the mark", () => (drawn.alarms > 0 ? true : undefined));
      assert.ok(drawn.pieces >= whole, `${drawn.pieces} of ${whole} pieces are left`);
      await picture("vscode-alarm");
      await vscode.commands.executeCommand("undo");
      await until("the mark to go", () => (drawn.alarms === 0 ? true : undefined));
      subscription.dispose();
    },
  ],
  [
    "a click on a move goes to its line",
    async () => {
      const editor = await open("pocket.nc");
      const top = new vscode.Position(0, 0);
      editor.selection = new vscode.Selection(top, top);
      await browser("clickPath");
      const line = await until("the cursor to move", () => {
        const line = vscode.window.activeTextEditor?.selection.active.line ?? 0;
        return line > 0 ? line : undefined;
      });
      // From the left the outermost circle comes first.
      assert.equal(editor.document.lineAt(line).text, "G03 I-20.");
      await picture("vscode-click");
    },
  ],
  [
    "the server is started again",
    async () => {
      const { server } = await api();
      const { document } = await open("part.nc");
      await vscode.commands.executeCommand("gcheck.restartServer");
      assert.ok(server.isRunning);
      await until("the finding", () => finding(document, "unknown-code"));
      await picture("vscode-findings");
    },
    uses("gcheck.restartServer"),
  ],
];

