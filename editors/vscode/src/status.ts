// The item of the status bar that says which control reads the program.

import * as vscode from "vscode";

import type { Server, Status } from "./server";

const SOURCES: Record<string, string> = {
  configuration: "named by gcheck.toml",
  option: "named by the settings",
  comment: "named by a comment of the program",
  detected: "guessed from the program",
  default: "nobody named one",
};

export class ControlStatus implements vscode.Disposable {
  private readonly item = vscode.languages.createLanguageStatusItem("gcheck.control", { language: "gcode" });
  private readonly bar = vscode.window.createStatusBarItem("gcheck.control", vscode.StatusBarAlignment.Right, 90);
  private readonly known = new Map<string, Status>();
  private readonly subscriptions: vscode.Disposable[];

  constructor(server: Server) {
    this.item.name = "Control";
    this.item.command = { command: "gcheck.selectControl", title: "Change" };
    this.bar.name = "gcheck: control";
    this.bar.command = "gcheck.selectControl";
    this.subscriptions = [
      this.item,
      this.bar,
      server.onStatus((status) => {
        this.known.set(vscode.Uri.parse(status.uri).toString(), status);
        this.show();
      }),
      vscode.window.onDidChangeActiveTextEditor(() => this.show()),
      vscode.workspace.onDidCloseTextDocument((document) => this.known.delete(document.uri.toString())),
    ];
    this.show();
  }

  dispose(): void {
    for (const subscription of this.subscriptions) {
      subscription.dispose();
    }
  }

  private show(): void {
    const document = vscode.window.activeTextEditor?.document;
    const status = document && this.known.get(document.uri.toString());
    if (document?.languageId !== "gcode" || status === undefined) {
      this.bar.hide();
      return;
    }
    const how = SOURCES[status.source] ?? status.source;
    this.item.text = status.control;
    this.item.detail = how;
    this.bar.text = `$(circuit-board) ${status.control}`;
    this.bar.tooltip = `${status.title}: ${how}. Click to change.`;
    this.bar.show();
  }
}
