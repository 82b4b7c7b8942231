// The commands of the palette.

import * as path from "node:path";

import * as vscode from "vscode";

import type { ToolpathPreview } from "./preview/panel";
import type { Server } from "./server";
import { type State, stateText } from "./state";

/** What the server says of a place, as read-only documents: closing them asks nothing. */
const ANSWER = "gcheck-answer";

export function registerCommands(server: Server, preview: ToolpathPreview): vscode.Disposable[] {
  const answers = new Answers();
  const command = (name: string, run: (...args: never[]) => unknown) =>
    vscode.commands.registerCommand(`gcheck.${name}`, run);
  return [
    answers,
    command("showToolpath", () => preview.show()),
    command("showState", () => showState(server, answers)),
    command("selectControl", () => selectControl(server)),
    command("explain", (subject?: string, control?: string) => explain(server, answers, subject, control)),
    command("fixAll", () => vscode.commands.executeCommand("editor.action.fixAll")),
    command("shiftPath", () => changeActive(server, "translate")),
    command("renumber", () => changeActive(server, "renumber")),
    command("askAndChange", (asked: AskedChange) => askAndChange(server, asked)),
    command("showSyntaxTree", () => showSyntaxTree(server, answers)),
    command("restartServer", () => server.restart()),
    command("showOutput", () => server.showOutput()),
    vscode.workspace.registerTextDocumentContentProvider(ANSWER, answers),
  ];
}

interface Control {
  name: string;
  title: string;
}

async function selectControl(server: Server): Promise<void> {
  const document = vscode.window.activeTextEditor?.document;
  const controls = await server.request<Control[]>("gcheck/controls", {});
  if (controls === undefined) {
    await doesNotRun(server);
    return;
  }
  const picked = await vscode.window.showQuickPick(
    controls.map((control) => ({ label: control.name, description: control.title })),
    { title: "Control", placeHolder: "Which control runs the program?", matchOnDescription: true },
  );
  if (picked === undefined) {
    return;
  }
  const places = [
    ...(document?.languageId === "gcode"
      ? [{ label: "This program", description: "a comment in its first lines", place: "comment" as const }]
      : []),
    { label: "All programs", description: "the setting gcheck.control", place: "setting" as const },
  ];
  const where = await vscode.window.showQuickPick(places, { title: "For which programs?" });
  if (where?.place === "comment" && document !== undefined) {
    await server.request("workspace/executeCommand", {
      command: "gcheck.setControl",
      arguments: [{ uri: server.address(document).uri, control: picked.label }],
    });
  } else if (where?.place === "setting") {
    const target =
      vscode.workspace.workspaceFolders === undefined
        ? vscode.ConfigurationTarget.Global
        : vscode.ConfigurationTarget.Workspace;
    await vscode.workspace.getConfiguration("gcheck").update("control", picked.label, target);
  }
}

/** A change of a program that needs figures. */
interface AskedChange {
  /** As the protocol writes it. */
  uri: string;
  /** What is selected, as the protocol writes it. */
  range?: object | null;
  change: "translate" | "renumber";
}

/** Changes the program of the active editor: the lines that are selected, or all. */
async function changeActive(server: Server, change: AskedChange["change"]): Promise<void> {
  const editor = vscode.window.activeTextEditor;
  if (editor?.document.languageId !== "gcode") {
    return;
  }
  const { start, end, isEmpty } = editor.selection;
  const place = ({ line, character }: vscode.Position) => ({ line, character });
  const range = isEmpty || change === "renumber" ? null : { start: place(start), end: place(end) };
  await askAndChange(server, { uri: server.address(editor.document).uri, range, change });
}

/** Asks for the figures of a change, and has the server prove and make it. */
async function askAndChange(server: Server, asked: AskedChange): Promise<void> {
  const figures = asked.change === "translate" ? await askShift(asked.range != null) : await askNumbering();
  if (figures === undefined) {
    return;
  }
  if (!server.isRunning) {
    await doesNotRun(server);
    return;
  }
  try {
    const done = await vscode.window.withProgress(
      { location: vscode.ProgressLocation.Window, title: "Proving the change" },
      () =>
        server.request<{ claim: string }>("workspace/executeCommand", {
          command: "gcheck.changePath",
          arguments: [{ ...asked, ...figures }],
        }),
    );
    if (done !== undefined) {
      vscode.window.setStatusBarMessage(`gcheck: ${done.claim}`, 10_000);
    }
  } catch (error) {
    // The reason why the change is not made, in the server's words.
    void vscode.window.showErrorMessage(error instanceof Error ? error.message : String(error));
  }
}

/** The lengths of a shift, each as it is typed; `undefined` where the text is not a shift. */
function readShift(text: string): Record<string, string> | undefined {
  const word = /([XYZ])\s*([-+]?(?:\d+\.?\d*|\.\d+)\s*(?:mm|inch|in)?)(?=[\sXYZ,;]|$)[\s,;]*/giy;
  const shift: Record<string, string> = {};
  let end = 0;
  for (let found = word.exec(text.trim()); found !== null; found = word.exec(text.trim())) {
    const [, axis = "", length = ""] = found;
    shift[axis.toLowerCase()] = length.replaceAll(" ", "").replace(/^\+/, "").toLowerCase();
    end = word.lastIndex;
  }
  return end > 0 && end === text.trim().length ? shift : undefined;
}

async function askShift(isPart: boolean): Promise<Record<string, string> | undefined> {
  const text = await vscode.window.showInputBox({
    title: isPart ? "Shift the Path in the Selected Lines" : "Shift the Path",
    prompt: "How far along which axes: X10 Y-2.5. In the unit of the program, or with mm or in: Z0.5in",
    value: "X0 Y0 Z0",
    validateInput: (text) => (readShift(text) === undefined ? "Write axes with lengths, such as X10 Y-2.5" : undefined),
  });
  return text === undefined ? undefined : readShift(text);
}

async function askNumbering(): Promise<{ start: number; step: number } | undefined> {
  const read = (text: string) => /^\s*([1-9]\d{0,8})\s*[:, ]\s*([1-9]\d{0,8})\s*$/.exec(text);
  const text = await vscode.window.showInputBox({
    title: "Renumber the Blocks",
    prompt: "The first number and the step, as in 10:10",
    value: "10:10",
    validateInput: (text) => (read(text) === null ? "Write the first number and the step, as in 10:10" : undefined),
  });
  const numbers = text === undefined ? null : read(text);
  return numbers === null ? undefined : { start: Number(numbers[1]), step: Number(numbers[2]) };
}

/** Says that there is nobody to answer, and offers to start the server. */
async function doesNotRun(server: Server): Promise<void> {
  const choice = await vscode.window.showErrorMessage("The gcheck server does not run.", "Restart", "Show Output");
  if (choice === "Restart") {
    await server.restart();
  } else if (choice === "Show Output") {
    server.showOutput();
  }
}

/** Shows all about a rule, or about a code as a control reads it: that of the active program where none is named. */
async function explain(server: Server, answers: Answers, given?: string, control?: string): Promise<void> {
  const subject = (given ?? (await ask()))?.trim();
  if (subject === undefined || subject === "") {
    return;
  }
  if (!server.isRunning) {
    await doesNotRun(server);
    return;
  }
  const document = vscode.window.activeTextEditor?.document;
  const about =
    control === undefined && document?.languageId === "gcode"
      ? { subject, textDocument: server.address(document) }
      : { subject, control };
  const page = await server.request<string>("gcheck/explain", about);
  if (page === undefined) {
    void vscode.window.showInformationMessage(`gcheck knows no rule and no code "${subject}".`);
    return;
  }
  await vscode.commands.executeCommand("markdown.showPreviewToSide", answers.put(`${subject}.md`, page));
}

/** Asks what to explain; the rule of the finding at the cursor, or the word there, is the first guess. */
async function ask(): Promise<string | undefined> {
  const editor = vscode.window.activeTextEditor;
  const at = editor?.selection.active;
  const finding = editor && at && vscode.languages.getDiagnostics(editor.document.uri).find((d) => d.range.contains(at));
  const code = typeof finding?.code === "object" ? finding.code.value : finding?.code;
  const word = editor && at && editor.document.getWordRangeAtPosition(at);
  const value = code === undefined ? word && editor.document.getText(word) : String(code);
  return vscode.window.showInputBox({ title: "Explain", prompt: "A rule or a code, such as G143", value });
}

async function showState(server: Server, answers: Answers): Promise<void> {
  const editor = vscode.window.activeTextEditor;
  const state = editor && (await askAtCursor<State>(server, editor, "gcheck/stateAt"));
  if (editor !== undefined && state !== undefined) {
    const block = editor.document.lineAt(Math.min(state.line, editor.document.lineCount - 1)).text;
    await answers.show(`State in ${path.basename(editor.document.fileName)}`, stateText(state, block));
  }
}

async function showSyntaxTree(server: Server, answers: Answers): Promise<void> {
  const editor = vscode.window.activeTextEditor;
  const tree = editor && (await askAtCursor<string>(server, editor, "gcheck/syntaxTree"));
  if (editor !== undefined && tree !== undefined) {
    await answers.show(`Syntax Tree of ${path.basename(editor.document.fileName)}`, tree);
  }
}

/** Asks the server about the cursor's place; says so where it has no answer. */
async function askAtCursor<T>(server: Server, editor: vscode.TextEditor, method: string): Promise<T | undefined> {
  if (!server.isRunning) {
    await doesNotRun(server);
    return undefined;
  }
  const answer = await server.request<T>(method, {
    textDocument: server.address(editor.document),
    position: { line: editor.selection.active.line, character: editor.selection.active.character },
  });
  if (answer === undefined) {
    void vscode.window.showInformationMessage("No path of the program comes to this line.");
  }
  return answer;
}

/** Pages with what the server said; a page of the same title takes the place of the one before. */
class Answers implements vscode.TextDocumentContentProvider, vscode.Disposable {
  private readonly texts = new Map<string, string>();
  private readonly changed = new vscode.EventEmitter<vscode.Uri>();
  readonly onDidChange = this.changed.event;

  dispose(): void {
    this.changed.dispose();
  }

  provideTextDocumentContent(uri: vscode.Uri): string {
    return this.texts.get(uri.path) ?? "";
  }

  /** Keeps a page, and gives its address. */
  put(title: string, text: string): vscode.Uri {
    const uri = vscode.Uri.from({ scheme: ANSWER, path: title });
    this.texts.set(uri.path, text);
    this.changed.fire(uri);
    return uri;
  }

  /** Shows a page beside the program. */
  async show(title: string, text: string): Promise<void> {
    const document = await vscode.workspace.openTextDocument(this.put(title, text));
    await vscode.window.showTextDocument(document, {
      viewColumn: vscode.ViewColumn.Beside,
      preview: true,
      preserveFocus: true,
    });
  }
}
