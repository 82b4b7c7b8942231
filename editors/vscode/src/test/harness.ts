// What tests inside VS Code have in common: files, waiting, the questions of an editor, and what only the browser can do.
//
// The browser is asked by lines in the log, `@KIND ID JSON`; its answer is the file `ID.json` in the folder that
// GCHECK_ANSWERS names. `test/run.mjs` is the other side.

import * as assert from "node:assert/strict";
import * as fs from "node:fs";
import * as path from "node:path";

import * as vscode from "vscode";

import type { Api } from "../extension";
import { OFFERED } from "./offered";

/** A test: the fact that it proves, the proof, and what it uses of all that the extension adds to VS Code. */
export type Test = [string, () => Promise<void>, string[]?];

/** What a test uses, for the page docs/dev/editor-tests.md: the test fails when it did not. */
export function uses(...names: string[]): string[] {
  return names;
}

/** What a test has used so far: commands, settings, keys, actions by title, lenses. */
const used = new Set<string>();

/** Keeps in mind that a test used something. */
export function use(name: string): void {
  used.add(name);
}

/** Keeps in mind that an action changed the program, or ran. */
export function useAction(title: string): void {
  used.add(`action: ${title}`);
}

const executeCommand = vscode.commands.executeCommand;
/** Commands that ran are used; a view is used when it has the focus. */
vscode.commands.executeCommand = ((command: string, ...rest: unknown[]) => {
  use(command.replace(/\.focus$/, ""));
  if (command === "workbench.action.openWalkthrough") {
    use(`walkthrough ${String(rest[0]).split("#")[1]}`);
  }
  return executeCommand(command, ...rest);
}) as typeof executeCommand;

/** Settings that changed are used. */
function watchSettings(): vscode.Disposable {
  const extension = vscode.extensions.getExtension("gcheck.gcheck");
  const names = Object.keys(extension?.packageJSON.contributes.configuration.properties ?? {});
  assert.ok(names.length > 0, "the extension has settings");
  return vscode.workspace.onDidChangeConfiguration((change) => {
    for (const name of names.filter((name) => change.affectsConfiguration(name))) {
      use(name);
    }
  });
}

/** Does a title fit one with `…` for what depends on the place? */
function fits(title: string, pattern: string): boolean {
  const escaped = pattern.split("…").map((part) => part.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"));
  return new RegExp(`^${escaped.join("[^]*")}`).test(title);
}

/** Was something used that a test says it uses? */
function isUsed(name: string): boolean {
  const [, kind, rest] = /^(action|lens) (.*)$/.exec(name) ?? [];
  const all = [...used];
  if (kind === "action") {
    const pattern = OFFERED[rest ?? ""];
    assert.ok(pattern, `there is an action ${rest}`);
    return all.some((one) => one.startsWith("action: ") && fits(one.slice("action: ".length), pattern));
  }
  if (kind === "lens") {
    const pattern = rest === "program" ? /^lens: .*\d:\d\d in all/ : /^lens: T\d+ /;
    return all.some((one) => pattern.test(one));
  }
  return used.has(name);
}

/** Milliseconds for what takes a moment on a busy machine. */
const PATIENCE = 60_000;

export async function pause(milliseconds: number): Promise<void> {
  await new Promise((resolve) => setTimeout(resolve, milliseconds));
}

/** Asks until there is an answer. */
export async function until<T>(
  what: string,
  ask: () => T | undefined | Promise<T | undefined>,
  patience = PATIENCE,
): Promise<T> {
  const end = Date.now() + patience;
  for (;;) {
    const answer = await ask();
    if (answer !== undefined) {
      return answer;
    }
    if (Date.now() > end) {
      throw new Error(`waited in vain for ${what}`);
    }
    await pause(50);
  }
}

let asked = 0;

/** Has the browser do something, and waits for it. */
export async function browser<T>(kind: string, what: unknown = null, patience = PATIENCE): Promise<T> {
  asked += 1;
  const answers = process.env.GCHECK_ANSWERS;
  assert.ok(answers, "the runner names a folder for answers");
  const file = path.join(answers, `${asked}.json`);
  console.log(`@${kind} ${asked} ${JSON.stringify(what)}`);
  const text = await until(`the browser to ${kind}`, () => (fs.existsSync(file) ? fs.readFileSync(file, "utf8") : undefined), patience);
  const answer = JSON.parse(text) as { failed?: string; result?: T };
  assert.equal(answer.failed, undefined, `the browser could not ${kind}`);
  return answer.result as T;
}

/** A picture of the window, for people to look at. */
export async function picture(name: string): Promise<void> {
  await browser("screenshot", name);
}

/** Presses keys in the window: characters, and names such as `Enter` or `Control+z`. */
export async function press(keys: string[], delay: [number, number] = [40, 60]): Promise<void> {
  keys.forEach((key) => use(`key ${key.toLowerCase()}`));
  await browser("press", { keys, delay }, PATIENCE + keys.length * (delay[1] + 1_000));
}

/** What the window shows beside the text. */
export interface Widgets {
  /** Rows of the list of what may be typed, as they are read aloud. */
  rows: string[];
  /** How many of them are chosen. */
  focused: number;
  /** Help for the block. */
  help: string;
  hover: string;
  lenses: string[];
  /** Messages and dialogs. */
  messages: string;
  /** A list or a field to type into is open above the text. */
  dialog: boolean;
}

export async function widgets(): Promise<Widgets> {
  const seen = await browser<Widgets>("widgets");
  seen.lenses.forEach((lens) => use(`lens: ${lens.trim()}`));
  return seen;
}

/** The characters of a text as keys. */
export function characters(text: string): string[] {
  return [...text].map((c) => (c === "\n" ? "Enter" : c));
}

export function folder(): string {
  const root = vscode.workspace.workspaceFolders?.[0]?.uri.fsPath;
  assert.ok(root, "the runner opens a folder");
  return root;
}

/** Opens a program of the folder. */
export async function open(name: string): Promise<vscode.TextEditor> {
  const document = await vscode.workspace.openTextDocument(path.join(folder(), name));
  return vscode.window.showTextDocument(document, { viewColumn: vscode.ViewColumn.One, preview: false });
}

/** Makes a program of the folder and opens it. */
export async function create(name: string, text: string): Promise<vscode.TextEditor> {
  const file = path.join(folder(), name);
  fs.mkdirSync(path.dirname(file), { recursive: true });
  fs.writeFileSync(file, text);
  return open(name);
}

/** Gives the keyboard to the editor. */
export async function focus(): Promise<void> {
  await vscode.commands.executeCommand("workbench.action.focusActiveEditorGroup");
}

/** Puts the text back as it is on disk, and closes all editors. */
export async function closeAll(): Promise<void> {
  for (const document of vscode.workspace.textDocuments.filter((d) => d.isDirty)) {
    await vscode.window.showTextDocument(document);
    await vscode.commands.executeCommand("workbench.action.files.revert");
  }
  await vscode.commands.executeCommand("workbench.action.closeAllEditors");
}

/** Where a text is in a program; `within` counts from there. */
export function place(document: vscode.TextDocument, text: string, within = 0): vscode.Position {
  const at = document.getText().indexOf(text);
  assert.ok(at >= 0, `the program has ${text}`);
  return document.positionAt(at + within);
}

/** Puts the cursor at a text. */
export function goTo(editor: vscode.TextEditor, text: string, within = 0): vscode.Position {
  const at = place(editor.document, text, within);
  editor.selection = new vscode.Selection(at, at);
  editor.revealRange(editor.selection);
  return at;
}

export async function edit(document: vscode.TextDocument, change: (edit: vscode.WorkspaceEdit) => void): Promise<void> {
  const edit = new vscode.WorkspaceEdit();
  change(edit);
  assert.ok(await vscode.workspace.applyEdit(edit), `${document.fileName} can be edited`);
}

export function rule(diagnostic: vscode.Diagnostic): string {
  return String(typeof diagnostic.code === "object" ? diagnostic.code.value : diagnostic.code);
}

export function finding(document: vscode.TextDocument, id: string): vscode.Diagnostic | undefined {
  return vscode.languages.getDiagnostics(document.uri).find((diagnostic) => rule(diagnostic) === id);
}

export async function api(): Promise<Api> {
  const extension = vscode.extensions.getExtension<Api>("gcheck.gcheck");
  assert.ok(extension, "the extension is installed");
  return extension.activate();
}

/** Asks one of VS Code's own questions about a document until the list is not empty. */
export async function askList<T>(command: string, document: vscode.TextDocument, ...more: unknown[]): Promise<T[]> {
  return until(command, async () => {
    const answer = await vscode.commands.executeCommand<T[] | undefined>(command, document.uri, ...more);
    return answer !== undefined && answer.length > 0 ? answer : undefined;
  });
}

/** The text of the hover at a place. */
export async function hoverText(document: vscode.TextDocument, at: vscode.Position): Promise<string> {
  const hovers = await askList<vscode.Hover>("vscode.executeHoverProvider", document, at);
  return hovers.flatMap((hover) => hover.contents).map((c) => (typeof c === "string" ? c : c.value)).join("\n");
}

/** Runs a test, and says by what it failed. */
async function failureOf([, test, says]: Test): Promise<string | undefined> {
  used.clear();
  try {
    await test();
    const unused = (says ?? []).filter((name) => !isUsed(name));
    assert.deepEqual(unused, [], `the test uses what it says; it used ${[...used].join("; ")}`);
    return undefined;
  } catch (error) {
    return error instanceof Error ? error.stack ?? error.message : String(error);
  }
}

/**
 * Runs tests one after the other; complains when one failed.
 *
 * A test that fails is run once more: a browser on a busy machine may lose a click or show a list too late. The first failure
 * is printed all the same, so that a test that often needs two tries is seen.
 */
export async function runAll(tests: Test[]): Promise<void> {
  const failed: string[] = [];
  let twice = 0;
  watchSettings();
  for (const test of tests) {
    const [name] = test;
    const start = Date.now();
    const seconds = () => `${((Date.now() - start) / 1000).toFixed(1)} s`;
    const first = await failureOf(test);
    if (first === undefined) {
      console.log(`@test ok ${name} (${seconds()})`);
      continue;
    }
    await closeAll();
    const second = await failureOf(test);
    if (second === undefined) {
      twice += 1;
      console.log(`@test ok at the second try: ${name} (${seconds()}); at the first: ${first}`);
    } else {
      failed.push(name);
      console.log(`@test FAILED ${name}: ${first}\nat the second try: ${second}`);
    }
  }
  if (failed.length > 0) {
    throw new Error(`${failed.length} of ${tests.length} tests failed: ${failed.join("; ")}`);
  }
  console.log(`@test ${tests.length} of ${tests.length} passed${twice > 0 ? `, ${twice} of them at the second try` : ""}`);
}
