// Tests that run inside VS Code, in its extension host, with the real server. `test/run.mjs` starts them.
//
// The runner watches the log: `@test …` is for the reader, `@screenshot NAME` asks for a picture. VS Code says the rest.

import * as assert from "node:assert/strict";
import * as path from "node:path";

import * as vscode from "vscode";

import type { Api } from "../extension";

const WAIT = 60_000;

async function until<T>(what: string, ask: () => T | undefined | Promise<T | undefined>): Promise<T> {
  const end = Date.now() + WAIT;
  for (;;) {
    const answer = await ask();
    if (answer !== undefined) {
      return answer;
    }
    if (Date.now() > end) {
      throw new Error(`waited in vain for ${what}`);
    }
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

function folder(): string {
  const root = vscode.workspace.workspaceFolders?.[0]?.uri.fsPath;
  assert.ok(root, "the runner opens a folder");
  return root;
}

async function open(name: string): Promise<vscode.TextEditor> {
  const document = await vscode.workspace.openTextDocument(path.join(folder(), name));
  return vscode.window.showTextDocument(document, vscode.ViewColumn.One);
}

function rule(diagnostic: vscode.Diagnostic): string {
  return String(typeof diagnostic.code === "object" ? diagnostic.code.value : diagnostic.code);
}

function finding(document: vscode.TextDocument, id: string): vscode.Diagnostic | undefined {
  return vscode.languages.getDiagnostics(document.uri).find((diagnostic) => rule(diagnostic) === id);
}

function place(document: vscode.TextDocument, text: string): vscode.Position {
  const at = document.getText().indexOf(text);
  assert.ok(at >= 0, `the program has ${text}`);
  return document.positionAt(at);
}

async function picture(name: string): Promise<void> {
  console.log(`@screenshot ${name}`);
  await new Promise((resolve) => setTimeout(resolve, 2_500));
}

async function api(): Promise<Api> {
  const extension = vscode.extensions.getExtension<Api>("gcheck.gcheck");
  assert.ok(extension, "the extension is installed");
  return extension.activate();
}

async function edit(document: vscode.TextDocument, change: (edit: vscode.WorkspaceEdit) => void): Promise<void> {
  const edit = new vscode.WorkspaceEdit();
  change(edit);
  assert.ok(await vscode.workspace.applyEdit(edit), `${document.fileName} can be edited`);
}

type Test = [string, () => Promise<void>];

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
const restricted: Test[] = [
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

const trusted: Test[] = [
  theBundledServerRuns,
  aFindingAppears,
  [
    "hover tells a code and the state",
    async () => {
      const { document } = await open("part.nc");
      const hovers = await until("hover", async () => {
        const all = await vscode.commands.executeCommand<vscode.Hover[]>(
          "vscode.executeHoverProvider",
          document.uri,
          place(document, "G43"),
        );
        return all.length > 0 ? all : undefined;
      });
      const text = hovers.flatMap((hover) => hover.contents).map((c) => (typeof c === "string" ? c : c.value)).join("\n");
      assert.match(text, /G43/);
      assert.match(text, /tool length/i);
      assert.ok(text.indexOf("before:") < text.indexOf("| word |"), `the state stands above the words:\n${text}`);
      const editor = await open("part.nc");
      const at = place(document, "G43").translate(0, 1);
      editor.selection = new vscode.Selection(at, at);
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
      const fix = actions.find((action) => action.edit !== undefined && action.title.includes("take the second"));
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
      const ask = async <T>(what: string, command: string, ...more: unknown[]): Promise<T[]> =>
        until(what, async () => {
          const answer = await vscode.commands.executeCommand<T[] | undefined>(command, document.uri, ...more);
          return answer !== undefined && answer.length > 0 ? answer : undefined;
        });
      const symbols = await ask<vscode.DocumentSymbol>("symbols", "vscode.executeDocumentSymbolProvider");
      const names = symbols.flatMap((symbol) => [symbol, ...symbol.children]).map((symbol) => symbol.name);
      assert.ok(names.some((name) => name.includes("T1")), `T1 is in the outline; there are ${names.join(", ")}`);
      await ask("folding", "vscode.executeFoldingRangeProvider");
      await ask("lenses", "vscode.executeCodeLensProvider");
      const whole = new vscode.Range(0, 0, document.lineCount, 0);
      await ask("hints", "vscode.executeInlayHintProvider", whole);
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
      const { preview } = await api();
      const editor = await open("pocket.nc");
      let pieces = 0;
      const subscription = preview.onDrawn((count) => (pieces = count));
      await vscode.commands.executeCommand("gcheck.showToolpath");
      await until("the drawing", () => (pieces > 20 ? true : undefined));
      subscription.dispose();
      const at = place(editor.document, "G03");
      editor.selection = new vscode.Selection(at, at);
      await picture("vscode-toolpath");
    },
  ],
  [
    "a click on a move goes to its line",
    async () => {
      const editor = await open("pocket.nc");
      const top = new vscode.Position(0, 0);
      editor.selection = new vscode.Selection(top, top);
      console.log("@click-path");
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
      await vscode.commands.executeCommand("gcheck.restart");
      assert.ok(server.isRunning);
      await until("the finding", () => finding(document, "unknown-code"));
      await picture("vscode-findings");
    },
  ],
];

export async function run(): Promise<void> {
  await api();
  const tests = vscode.workspace.isTrusted ? trusted : restricted;
  const failed: string[] = [];
  for (const [name, test] of tests) {
    try {
      await test();
      console.log(`@test ok ${name}`);
    } catch (error) {
      failed.push(name);
      console.log(`@test FAILED ${name}: ${error instanceof Error ? error.stack ?? error.message : String(error)}`);
    }
  }
  if (failed.length > 0) {
    throw new Error(`${failed.length} of ${tests.length} tests failed: ${failed.join("; ")}`);
  }
  console.log(`@test ${tests.length} of ${tests.length} passed`);
}
