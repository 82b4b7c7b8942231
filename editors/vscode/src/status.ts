// The item of the status bar that says which control reads the program.

import * as path from "node:path";

import * as vscode from "vscode";

import type { Server, Status } from "./server";

/** How the control was chosen, in words. */
function how(status: Status): string {
  const file = status.configuration === null ? "gcheck.toml" : path.basename(status.configuration);
  switch (status.source) {
    case "configuration":
      return `named by ${file}`;
    case "option":
      return "named by the settings";
    case "comment":
      return "named by a comment of the program";
    case "detected":
      return status.because === null ? "detected from the program" : `detected from the program: ${status.because}`;
    case "guessed":
      return `guessed from the program (${status.because ?? "little"}): no finding is above a warning`;
    case "neighbours":
      return `guessed from its neighbours (${status.because ?? "most"}): no finding is above a warning`;
    case "default":
      return "a guess: nothing in the program names one";
    default:
      return status.source;
  }
}

export class ControlStatus implements vscode.Disposable {
  private readonly item = vscode.languages.createLanguageStatusItem("gcheck.control", { language: "gcode" });
  private readonly bar = vscode.window.createStatusBarItem("gcheck.control", vscode.StatusBarAlignment.Right, 90);
  private readonly subscriptions: vscode.Disposable[];

  constructor(private readonly server: Server) {
    this.item.name = "Control";
    this.item.command = { command: "gcheck.selectControl", title: "Change" };
    this.bar.name = "gcheck: control";
    this.bar.command = "gcheck.selectControl";
    this.subscriptions = [
      this.item,
      this.bar,
      server.onStatus(() => this.show()),
      vscode.window.onDidChangeActiveTextEditor(() => this.show()),
    ];
    this.show();
  }

  dispose(): void {
    for (const subscription of this.subscriptions) {
      subscription.dispose();
    }
  }

  /** What the bar says: its text and what a pointer on it shows; `undefined` where it is hidden. For tests. */
  get shown(): { text: string; tooltip: string } | undefined {
    const status = this.current();
    return status && { text: this.bar.text, tooltip: String(this.bar.tooltip) };
  }

  private current(): Status | undefined {
    const document = vscode.window.activeTextEditor?.document;
    return document?.languageId === "gcode" ? this.server.statusOf(document) : undefined;
  }

  private show(): void {
    const status = this.current();
    if (status === undefined) {
      this.bar.hide();
      return;
    }
    const isBroken = status.problem !== null;
    this.item.text = status.control;
    this.item.detail = status.problem ?? how(status);
    this.item.severity = isBroken ? vscode.LanguageStatusSeverity.Error : vscode.LanguageStatusSeverity.Information;
    this.bar.text = isBroken ? "$(error) not checked" : `$(circuit-board) ${status.control}`;
    this.bar.tooltip = status.problem ?? `${status.title}: ${how(status)}. Click to change.`;
    this.bar.show();
  }
}
