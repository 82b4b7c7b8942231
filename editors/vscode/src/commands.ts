// The commands of the palette.

import * as path from "node:path";

import * as vscode from "vscode";

import type { ToolpathPreview } from "./preview/panel";
import type { Server } from "./server";

/** Pages that `gcheck explain` prints, as read-only documents. */
const EXPLAIN = "gcheck-explain";

export function registerCommands(server: Server, preview: ToolpathPreview): vscode.Disposable[] {
  const command = (name: string, run: (...args: never[]) => unknown) =>
    vscode.commands.registerCommand(`gcheck.${name}`, run);
  return [
    command("restart", () => server.restart()),
    command("showOutput", () => server.showOutput()),
    command("showToolpath", () => preview.show()),
    command("selectControl", () => selectControl(server)),
    command("explainRule", (subject?: string) => explain(server, subject)),
    command("stateAtCursor", () => showAnswer(server, "gcheck/stateAt", "state")),
    command("showSyntaxTree", () => showAnswer(server, "gcheck/syntaxTree", "syntax tree")),
    command("fixAll", () => vscode.commands.executeCommand("editor.action.fixAll")),
    vscode.workspace.registerTextDocumentContentProvider(EXPLAIN, {
      provideTextDocumentContent: (uri) => explanation(server, uri),
    }),
  ];
}

interface Control {
  name: string;
  title: string;
}

async function selectControl(server: Server): Promise<void> {
  const document = vscode.window.activeTextEditor?.document;
  const listed = server.run(["controls", "--output-format", "json"]);
  if (listed === undefined) {
    void vscode.window.showErrorMessage("gcheck does not answer; see its output.");
    return;
  }
  const controls = JSON.parse(listed) as Control[];
  const picked = await vscode.window.showQuickPick(
    controls.map((control) => ({ label: control.name, description: control.title })),
    { title: "Control", placeHolder: "Which control runs the program?" },
  );
  if (picked === undefined) {
    return;
  }
  const places = [
    ...(document?.languageId === "gcode"
      ? [{ label: "This program", description: "a comment in its first lines", place: "comment" as const }]
      : []),
    { label: "Programs without one", description: "the setting gcheck.control", place: "setting" as const },
  ];
  const where = await vscode.window.showQuickPick(places, { title: "For which programs?" });
  if (where?.place === "comment" && document !== undefined) {
    await server.request("workspace/executeCommand", {
      command: "gcheck.setControl",
      arguments: [server.address(document).uri, picked.label],
    });
  } else if (where?.place === "setting") {
    const target =
      vscode.workspace.workspaceFolders === undefined
        ? vscode.ConfigurationTarget.Global
        : vscode.ConfigurationTarget.Workspace;
    await vscode.workspace.getConfiguration("gcheck").update("control", picked.label, target);
  }
}

async function explain(server: Server, given?: string): Promise<void> {
  const subject = given ?? (await ask());
  if (subject === undefined || subject.trim() === "") {
    return;
  }
  const folder = vscode.window.activeTextEditor?.document.uri.fsPath;
  const query = folder === undefined ? "" : path.dirname(folder);
  const uri = vscode.Uri.from({ scheme: EXPLAIN, path: `${subject.trim()}.md`, query });
  if ((await explanation(server, uri)) === undefined) {
    void vscode.window.showInformationMessage(`gcheck knows no rule or code "${subject}".`);
    return;
  }
  await vscode.commands.executeCommand("markdown.showPreviewToSide", uri);
}

/** Asks what to explain; what stands at the cursor is the first guess. */
async function ask(): Promise<string | undefined> {
  const editor = vscode.window.activeTextEditor;
  const at = editor?.selection.active;
  const finding = editor && at && vscode.languages.getDiagnostics(editor.document.uri).find((d) => d.range.contains(at));
  const code = typeof finding?.code === "object" ? finding.code.value : finding?.code;
  const word = editor && at && editor.document.getWordRangeAtPosition(at);
  const value = code === undefined ? word && editor.document.getText(word) : String(code);
  return vscode.window.showInputBox({ title: "Explain", prompt: "A rule or a code, such as G143", value });
}

async function explanation(server: Server, uri: vscode.Uri): Promise<string | undefined> {
  return server.run(["explain", uri.path.replace(/\.md$/, "")], uri.query === "" ? undefined : uri.query);
}

/** Asks the server about the cursor's place and shows what it says. */
async function showAnswer(server: Server, method: string, what: string): Promise<void> {
  const editor = vscode.window.activeTextEditor;
  if (editor === undefined) {
    return;
  }
  const answer = await server.request<unknown>(method, {
    textDocument: server.address(editor.document),
    position: editor.selection.active,
  });
  if (answer === undefined) {
    void vscode.window.showInformationMessage(`gcheck has no ${what} for this place.`);
    return;
  }
  const isText = typeof answer === "string";
  const content = isText ? answer : JSON.stringify(answer, undefined, 2);
  const document = await vscode.workspace.openTextDocument({ content, language: isText ? "plaintext" : "json" });
  await vscode.window.showTextDocument(document, { viewColumn: vscode.ViewColumn.Beside, preview: true });
}
