// The view "Machine State": what `gcheck/stateAt` answers for the cursor, as a tree that follows it.

import * as vscode from "vscode";

import type { Server } from "./server";
import { type Axes, pointText, type Side, type State } from "./state";

/** Milliseconds without a move of the cursor after which the state is asked for. */
const PAUSE = 120;

/** A row of the view. */
export interface Row {
  label: string;
  /** What it is, beside the label. */
  description?: string;
  tooltip?: string;
  /** A click shows this line, from 0, of the file; of the program itself where none is named. */
  at?: { line: number; file?: string };
  rows?: Row[];
  /** Its rows are hidden until somebody opens it. */
  isClosed?: boolean;
}

export class MachineState implements vscode.TreeDataProvider<Row>, vscode.Disposable {
  private readonly changed = new vscode.EventEmitter<void>();
  private readonly view: vscode.TreeView<Row>;
  private readonly subscriptions: vscode.Disposable[];
  private shown: Row[] = [];
  private document: vscode.TextDocument | undefined;
  private timer: NodeJS.Timeout | undefined;
  private asking: vscode.CancellationTokenSource | undefined;

  readonly onDidChangeTreeData = this.changed.event;

  constructor(private readonly server: Server) {
    this.view = vscode.window.createTreeView("gcheck.machineState", { treeDataProvider: this, showCollapseAll: true });
    const soon = (document: vscode.TextDocument | undefined) => {
      if (document?.languageId === "gcode") {
        this.refreshSoon();
      }
    };
    this.subscriptions = [
      this.changed,
      this.view,
      this.view.onDidChangeVisibility(() => this.refreshSoon()),
      server.onStarted(() => this.refreshSoon()),
      vscode.window.onDidChangeActiveTextEditor((editor) => soon(editor?.document)),
      vscode.window.onDidChangeTextEditorSelection((change) => soon(change.textEditor.document)),
      vscode.commands.registerCommand("gcheck.revealLine", (at: { line: number; file?: string }) => this.reveal(at)),
    ];
    this.refreshSoon();
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.asking?.cancel();
    for (const subscription of this.subscriptions) {
      subscription.dispose();
    }
  }

  getTreeItem(row: Row): vscode.TreeItem {
    const { Collapsed, Expanded, None } = vscode.TreeItemCollapsibleState;
    const item = new vscode.TreeItem(row.label, row.rows === undefined ? None : row.isClosed === true ? Collapsed : Expanded);
    // What is opened or closed by hand stays so while the cursor moves.
    item.id = row.rows === undefined ? undefined : row.label;
    item.description = row.description;
    item.tooltip = row.tooltip ?? [row.label, row.description].filter(Boolean).join("  ");
    if (row.at !== undefined) {
      item.command = { command: "gcheck.revealLine", title: "Show the Line", arguments: [row.at] };
    }
    return item;
  }

  getChildren(row?: Row): Row[] {
    return row === undefined ? this.shown : (row.rows ?? []);
  }

  /** What the view shows, for tests. */
  rows(): readonly Row[] {
    return this.shown;
  }

  private refreshSoon(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.refresh(), PAUSE);
  }

  private async refresh(): Promise<void> {
    const editor = vscode.window.activeTextEditor;
    // The cursor may be in another kind of file: what was shown last stays.
    if (!this.view.visible || editor?.document.languageId !== "gcode") {
      return;
    }
    this.asking?.cancel();
    const asking = new vscode.CancellationTokenSource();
    this.asking = asking;
    const { document, selection } = editor;
    const position = { line: selection.active.line, character: selection.active.character };
    try {
      const parameters = { textDocument: this.server.address(document), position };
      const state = await this.server.request<State>("gcheck/stateAt", parameters, asking.token);
      if (!asking.token.isCancellationRequested) {
        this.show(document, state);
      }
    } catch {
      // An edit came between, and its own question comes after it.
    } finally {
      asking.dispose();
      if (this.asking === asking) {
        this.asking = undefined;
      }
    }
  }

  private show(document: vscode.TextDocument, state: State | undefined): void {
    this.document = document;
    this.shown = state === undefined ? [] : rowsOf(state);
    this.view.description = state === undefined ? undefined : `${state.after === null ? "before" : "after"} line ${state.line + 1}`;
    this.view.message = state === undefined ? "No path of the program comes to the cursor." : (state.assumed ?? undefined);
    this.changed.fire();
  }

  private async reveal({ line, file }: { line: number; file?: string }): Promise<void> {
    if (this.document === undefined) {
      return;
    }
    const uri = file === undefined || file === "" ? this.document.uri : vscode.Uri.joinPath(this.document.uri, "..", file);
    const range = new vscode.Range(line, 0, line, 0);
    await vscode.window.showTextDocument(uri, { selection: range, preserveFocus: false });
  }
}

/** The state as rows: after the block, where the program goes on. */
export function rowsOf(state: State): Row[] {
  const side = state.after ?? state.before;
  const groups: (Row | undefined)[] = [
    position(side),
    tool(side),
    group("Offsets", [
      row("work offset", side.workOffset, pointText(side.origin)),
      row("shift", pointText(nonZero(side.shift))),
      row("length in effect", pointText(nonZero(side.length))),
    ]),
    group("Modes", side.modes.map(({ group: title, codes, setAt }) => ({
      label: codes.join(" or "),
      description: setAt === null ? title : `${title}, line ${setAt.line + 1}`,
      at: setAt === null ? undefined : { line: setAt.line },
    }))),
    group("Variables", side.variables.map(({ name, value }) => ({ label: name, description: value })), true),
    group("Calls", state.calls.map(({ text, file, line }) => ({
      label: text,
      description: file === "" ? `line ${line}` : `${file}, line ${line}`,
      at: { line: line - 1, file },
    }))),
  ];
  return groups.filter((row) => row !== undefined);
}

/** Each axis in work and machine coordinates. */
function position(side: Side): Row | undefined {
  const shown = (value: number | null | undefined) => (value === null || value === undefined ? "?" : String(value));
  const axes = Object.keys(side.work).filter((axis) => side.work[axis] !== null || side.machine[axis] !== null);
  const unit = (axis: string) => ("ABC".includes(axis) ? "°" : ` ${side.units}`);
  const rows = axes.map((axis) => {
    const tip = side.tip[axis];
    const differs = tip !== null && tip !== undefined && tip !== side.work[axis] ? `, tip ${shown(tip)}` : "";
    return {
      label: `${axis === "X" && side.diameter ? "X Ø" : axis} ${shown(side.work[axis])}`,
      description: `machine ${shown(side.machine[axis])}${differs}`,
      tooltip: `${axis} in work coordinates ${shown(side.work[axis])}${unit(axis)}, in machine coordinates ${shown(side.machine[axis])}${unit(axis)}`,
    };
  });
  return group("Position", rows.length > 0 ? rows : [{ label: "not known" }]);
}

function tool(side: Side): Row | undefined {
  const length = (value: number | null | undefined) => (value === null || value === undefined ? null : `${value} ${side.units}`);
  const speed = [side.speed, side.surfaceSpeed].filter(Boolean).join(", ");
  const feed = [side.feed, side.chipLoad].filter(Boolean).join(", ");
  return group("Tool", [
    row(side.tool === null ? "tool not known" : `T${side.tool}`, side.toolIs?.name ?? ""),
    row("called for", side.selectedTool === side.tool ? null : side.selectedTool && `T${side.selectedTool}`),
    row("length", length(side.toolIs?.length), side.lengthOffset && `H${side.lengthOffset}`),
    row("diameter", length(side.toolIs?.diameter), side.cutterOffset && `D${side.cutterOffset}`),
    row("feed", feed),
    row("speed", speed),
    row(side.spindle, ""),
  ]);
}

/** A row with what is told of it; none without a description, but the empty one. */
function row(label: string, first: string | null | undefined, second?: string | null): Row | undefined {
  const told = [first, second].filter((part) => part !== null && part !== undefined && part !== "");
  if (told.length === 0 && first !== "") {
    return undefined;
  }
  return { label, description: told.join("  ") };
}

function group(label: string, rows: (Row | undefined)[], isClosed = false): Row | undefined {
  const told = rows.filter((row) => row !== undefined);
  return told.length > 0 ? { label, rows: told, isClosed } : undefined;
}

function nonZero(axes: Axes): Axes {
  return Object.fromEntries(Object.entries(axes).filter(([, value]) => value !== 0));
}
