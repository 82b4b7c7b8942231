// The toolpath beside the text: a panel that follows the active program.

import * as path from "node:path";

import * as vscode from "vscode";

import type { Server } from "../server";
import type { Alarm, FromPage, ToPage, Toolpath } from "./messages";

/** Milliseconds without an edit after which the toolpath is computed again. */
const PAUSE = 400;

export class ToolpathPreview implements vscode.Disposable {
  private panel: vscode.WebviewPanel | undefined;
  private document: vscode.TextDocument | undefined;
  private timer: NodeJS.Timeout | undefined;
  private asking: vscode.CancellationTokenSource | undefined;
  private readonly subscriptions: vscode.Disposable[];
  private readonly drawnEmitter = new vscode.EventEmitter<{ pieces: number; alarms: number }>();

  /** The page has drawn so many pieces, and names so many alarms that the picture goes past. */
  readonly onDrawn = this.drawnEmitter.event;

  constructor(
    private readonly context: vscode.ExtensionContext,
    private readonly server: Server,
  ) {
    this.subscriptions = [
      this.drawnEmitter,
      server.onStarted(() => void this.refresh()),
      vscode.workspace.onDidChangeTextDocument((change) => {
        if (change.document === this.document) {
          this.refreshSoon();
        }
      }),
      vscode.window.onDidChangeActiveTextEditor((editor) => {
        if (this.panel !== undefined && editor?.document.languageId === "gcode" && editor.document !== this.document) {
          this.document = editor.document;
          void this.refresh();
        }
      }),
      vscode.window.onDidChangeTextEditorSelection((change) => {
        const selection = change.selections[0];
        if (change.textEditor.document === this.document && selection !== undefined) {
          this.post({ kind: "lines", first: selection.start.line + 1, last: selection.end.line + 1 });
        }
      }),
    ];
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.asking?.cancel();
    this.panel?.dispose();
    for (const subscription of this.subscriptions) {
      subscription.dispose();
    }
  }

  /** Opens the panel beside the active program. */
  show(): void {
    const editor = vscode.window.activeTextEditor;
    if (editor?.document.languageId === "gcode") {
      this.document = editor.document;
    }
    if (this.panel === undefined) {
      this.panel = this.open();
    } else {
      this.panel.reveal(undefined, true);
      void this.refresh();
    }
  }

  private open(): vscode.WebviewPanel {
    const dist = vscode.Uri.joinPath(this.context.extensionUri, "dist");
    const media = vscode.Uri.joinPath(this.context.extensionUri, "media");
    const panel = vscode.window.createWebviewPanel(
      "gcheck.toolpath",
      "Toolpath",
      { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true },
      { enableScripts: true, retainContextWhenHidden: true, localResourceRoots: [dist, media] },
    );
    panel.webview.onDidReceiveMessage((message: FromPage) => this.receive(message));
    panel.onDidDispose(() => {
      this.panel = undefined;
      this.asking?.cancel();
    });
    const script = panel.webview.asWebviewUri(vscode.Uri.joinPath(dist, "preview.js"));
    const style = panel.webview.asWebviewUri(vscode.Uri.joinPath(media, "preview.css"));
    const policy = `default-src 'none'; script-src ${panel.webview.cspSource}; style-src ${panel.webview.cspSource};`;
    panel.webview.html = `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<title>Toolpath</title>
<link rel="stylesheet" href="${style}">
</head>
<body>
<div id="scene"><canvas id="canvas" tabindex="0" aria-label="Toolpath"></canvas></div>
<p id="nothing" role="status"></p>
<div id="figures" aria-live="polite"></div>
<div id="side"><div id="tools"></div><div id="alarms" role="status"></div></div>
<div id="readout" role="status"></div>
<div id="controls">
<button id="back" title="Back a block (Page Up); a move: ," aria-label="Back a block">‹</button>
<button id="play" title="Play or pause (space)" aria-label="Play">▶</button>
<button id="on" title="On a block (Page Down); a move: ." aria-label="On a block">›</button>
<button id="next-tool" title="To the end of the next tool (T)" aria-label="Next tool">T›</button>
<input id="time" type="range" min="0" max="1000" value="1000" aria-label="Place in the run">
<select id="speed" aria-label="Speed">
<option value="1">1×</option><option value="10" selected>10×</option><option value="100">100×</option>
</select>
<select id="view" aria-label="View">
<option value="iso">Isometric</option><option value="top">Top (XY)</option><option value="front">Front (XZ)</option>
<option value="side">Side (YZ)</option><option value="lathe">Lathe (ZX)</option>
</select>
<label><input id="rapids" type="checkbox" checked> rapids</label>
<button id="fit" title="Show all (F)">Fit</button>
</div>
<script src="${script}"></script>
</body>
</html>`;
    return panel;
  }

  private receive(message: FromPage): void {
    switch (message.kind) {
      case "ready":
        void this.refresh();
        break;
      case "line":
        void this.reveal(message.file, message.line);
        break;
      case "at":
        this.follow(message.file, message.line);
        break;
      case "drawn":
        this.drawnEmitter.fire({ pieces: message.pieces, alarms: message.alarms });
        break;
    }
  }

  /** The cursor goes along with a run that is played or stepped, where its file is visible; the keyboard stays with the picture. */
  private follow(file: string, line: number): void {
    const isMeant = (document: vscode.TextDocument) =>
      file === "" ? document === this.document : path.basename(document.fileName) === path.basename(file);
    const editor = vscode.window.visibleTextEditors.find((editor) => isMeant(editor.document));
    if (editor !== undefined) {
      const start = new vscode.Position(Math.min(Math.max(line - 1, 0), editor.document.lineCount - 1), 0);
      editor.selection = new vscode.Selection(start, start);
      editor.revealRange(editor.selection, vscode.TextEditorRevealType.InCenterIfOutsideViewport);
    }
  }

  /** Shows the line of a move; that of a called program is opened. */
  private async reveal(file: string, line: number): Promise<void> {
    if (this.document === undefined) {
      return;
    }
    const isOwn = file === "" || path.basename(file) === path.basename(this.document.fileName);
    const folder = path.dirname(this.document.fileName);
    const uri = isOwn ? this.document.uri : vscode.Uri.file(path.resolve(folder, file));
    const document = await vscode.workspace.openTextDocument(uri);
    const column = vscode.window.visibleTextEditors.find((editor) => editor.document === document)?.viewColumn;
    const range = document.lineAt(Math.min(Math.max(line - 1, 0), document.lineCount - 1)).range;
    await vscode.window.showTextDocument(document, {
      viewColumn: column ?? vscode.ViewColumn.One,
      selection: range,
      preserveFocus: false,
    });
  }

  private refreshSoon(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.refresh(), PAUSE);
  }

  private async refresh(): Promise<void> {
    const { panel, document } = this;
    if (panel === undefined || document === undefined) {
      this.nothing("Open a part program to see its toolpath.");
      return;
    }
    const name = path.basename(document.fileName);
    panel.title = `Toolpath: ${name}`;
    this.asking?.cancel();
    const asking = new vscode.CancellationTokenSource();
    this.asking = asking;
    try {
      const parameters = { textDocument: this.server.address(document), position: { line: 0, character: 0 } };
      const toolpath = await this.server.request<Toolpath>("gcheck/toolpath", parameters, asking.token);
      if (asking.token.isCancellationRequested) {
        return;
      }
      if (toolpath === undefined || toolpath.data.count === 0) {
        // With moves of which none is drawn, the notes name the cause.
        const why = toolpath !== undefined && toolpath.moves > 0 ? "Nothing can be drawn." : "The program makes no move.";
        const notes = (toolpath?.notes ?? []).filter((note) => note !== toolpath?.stopped);
        this.nothing([why, toolpath?.stopped].filter(Boolean).join("\n"), toolpath?.alarms, notes);
      } else {
        this.post({ kind: "toolpath", name, toolpath });
      }
    } catch (error) {
      if (!asking.token.isCancellationRequested) {
        this.nothing(String(error));
      }
    } finally {
      if (this.asking === asking) {
        this.asking = undefined;
      }
      asking.dispose();
    }
  }

  private nothing(why: string, alarms: Alarm[] = [], notes: string[] = []): void {
    this.post({ kind: "nothing", why, alarms, notes });
  }

  private post(message: ToPage): void {
    void this.panel?.webview.postMessage(message);
  }
}
