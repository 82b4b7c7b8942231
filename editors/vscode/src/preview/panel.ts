// The toolpath beside the text: a panel that follows the active program.

import * as path from "node:path";

import * as vscode from "vscode";

import type { Server } from "../server";
import type { Alarm, FromPage, Note, ToPage, Toolpath } from "./messages";

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
          this.choose(selection);
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
<div id="work">
<div id="scene"><canvas id="canvas" tabindex="0" role="img" aria-label="Toolpath in three dimensions; arrows turn it, Shift and arrows move it"></canvas>
<p id="nothing" role="status"></p></div>
<div id="side"><div id="figures"></div><div id="choices" role="group" aria-label="Options"></div></div>
</div>
<div id="told"><div id="alarms" role="status"></div><div id="notes" aria-live="polite"></div></div>
<div id="readout" role="status"></div>
<div id="controls">
<button id="back" title="Back a block (Page Up); a move: ," aria-label="Back a block">‹</button>
<button id="play" title="Play or pause (space)" aria-label="Play">▶</button>
<button id="on" title="On a block (Page Down); a move: ." aria-label="On a block">›</button>
<button id="next-tool" title="To the end of the next tool (T)" aria-label="Next tool">T›</button>
<button id="next-operation" title="To the end of the next operation (S)" aria-label="Next operation">S›</button>
<input id="time" type="range" min="0" max="1000" value="1000" aria-label="Place in the run">
<select id="speed" aria-label="Speed"></select>
<select id="view" aria-label="View">
<option value="iso">Isometric</option><option value="top">Top (XY)</option><option value="front">Front (XZ)</option>
<option value="side">Side (YZ)</option><option value="lathe">Lathe (ZX)</option>
</select>
<button id="fit" title="Show all (F)">Fit</button>
<button id="zoom" title="Zoom to the moves of the chosen lines (Z)">Zoom</button>
<button id="options" title="Colours, tools, range of Z, measures (O)" aria-controls="side" aria-expanded="true">Options</button>
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
      case "save":
        void this.save(message.name, message.bytes);
        break;
      case "drawn":
        this.drawnEmitter.fire({ pieces: message.pieces, alarms: message.alarms });
        break;
    }
  }

  /** The cursor goes along with a run that is played or stepped, where its file is visible; the keyboard stays with the picture. */
  private follow(file: string, line: number): void {
    const wanted = this.addressOf(file)?.toString();
    const editor = vscode.window.visibleTextEditors.find((editor) => editor.document.uri.toString() === wanted);
    if (editor !== undefined) {
      const start = new vscode.Position(Math.min(Math.max(line - 1, 0), editor.document.lineCount - 1), 0);
      editor.selection = new vscode.Selection(start, start);
      editor.revealRange(editor.selection, vscode.TextEditorRevealType.InCenterIfOutsideViewport);
    }
  }

  /** The address of a file as the path names it: nothing for the program itself, else a path from its folder. */
  private addressOf(file: string): vscode.Uri | undefined {
    const own = this.document?.uri;
    if (own === undefined || file === "") {
      return own;
    }
    return path.isAbsolute(file) ? vscode.Uri.file(file) : vscode.Uri.joinPath(own, "..", file);
  }

  /** Shows the line of a move; that of a called program is opened. */
  private async reveal(file: string, line: number): Promise<void> {
    const uri = this.addressOf(file);
    if (uri === undefined) {
      return;
    }
    const document = await vscode.workspace.openTextDocument(uri);
    const column = vscode.window.visibleTextEditors.find((editor) => editor.document === document)?.viewColumn;
    const range = document.lineAt(Math.min(Math.max(line - 1, 0), document.lineCount - 1)).range;
    await vscode.window.showTextDocument(document, {
      viewColumn: column ?? vscode.ViewColumn.One,
      selection: range,
      preserveFocus: false,
    });
  }

  /** Asks where a picture of the view is to be, and writes it. */
  private async save(suggested: string, bytes: Uint8Array): Promise<void> {
    const stem = this.document === undefined ? "toolpath" : path.parse(this.document.fileName).name;
    const name = `${stem}${path.extname(suggested)}`;
    const folder = this.document?.uri.scheme === "file" || this.document?.uri.scheme === "vscode-remote"
      ? vscode.Uri.joinPath(this.document.uri, "..")
      : vscode.workspace.workspaceFolders?.[0]?.uri;
    const filters: Record<string, string[]> = name.endsWith(".svg") ? { "SVG picture": ["svg"] } : { "PNG picture": ["png"] };
    const defaultUri = folder === undefined ? undefined : vscode.Uri.joinPath(folder, name);
    const uri = await vscode.window.showSaveDialog({ defaultUri, filters, title: "Save the view" });
    if (uri === undefined) {
      return;
    }
    try {
      await vscode.workspace.fs.writeFile(uri, bytes);
    } catch (error) {
      void vscode.window.showErrorMessage(`The picture could not be saved: ${String(error)}`);
    }
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
        const notes = (toolpath?.notes ?? []).filter((note) => note.words !== toolpath?.stopped);
        this.nothing([why, toolpath?.stopped].filter(Boolean).join("\n"), toolpath?.alarms, notes);
      } else {
        this.post({ kind: "toolpath", uri: document.uri.toString(), toolpath });
        // What is chosen in the text is chosen in the new path as well.
        const editor = vscode.window.visibleTextEditors.find((editor) => editor.document === document);
        if (editor !== undefined) {
          this.choose(editor.selection);
        }
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

  /** The moves of the lines of a selection are the chosen ones. */
  private choose(selection: vscode.Selection): void {
    this.post({ kind: "lines", first: selection.start.line + 1, last: selection.end.line + 1 });
  }

  private nothing(why: string, alarms: Alarm[] = [], notes: Note[] = []): void {
    this.post({ kind: "nothing", why, alarms, notes });
  }

  private post(message: ToPage): void {
    void this.panel?.webview.postMessage(message);
  }
}
