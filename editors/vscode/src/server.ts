// The language server's process: where it is found, how it is started again.

import * as fs from "node:fs";
import * as path from "node:path";

import * as vscode from "vscode";
import {
  CodeActionResolveRequest,
  LanguageClient,
  type LanguageClientOptions,
  LSPErrorCodes,
  type MessageSignature,
  ResponseError,
  type ServerOptions,
  State,
} from "vscode-languageclient/node";

/** Which control reads a program, as the server says it. */
export interface Status {
  uri: string;
  /** Name of the control: `haas-mill`. */
  control: string;
  /** What the control is, in words. */
  title: string;
  /** How it was chosen: `configuration`, `option`, `comment`, `detected`, `guessed`, `neighbours` or `default`. */
  source: string;
  /** What made it so: a comment, a file. */
  because: string | null;
  /** The configuration file. */
  configuration: string | null;
  /** Why the program is not checked. */
  problem: string | null;
}

/** The command that hovers link to. */
const EXPLAIN = "gcheck.explain";

/** The command that asks for the figures of a change. */
const CHANGE = "gcheck.askAndChange";

/** A client that says why a change is refused, where others say that a request failed. */
class Client extends LanguageClient {
  override handleFailedRequest<T>(
    type: MessageSignature,
    token: vscode.CancellationToken | undefined,
    error: unknown,
    defaultValue: T,
    showNotification = true,
  ): T {
    const isRefused = error instanceof ResponseError && error.code === LSPErrorCodes.RequestFailed;
    if (type.method === CodeActionResolveRequest.method && isRefused) {
      void vscode.window.showWarningMessage(`gcheck: ${error.message}`);
      return defaultValue;
    }
    return super.handleFailedRequest(type, token, error, defaultValue, showNotification);
  }
}

/** Is never cancelled. */
const NEVER = new vscode.CancellationTokenSource().token;

export class Server implements vscode.Disposable {
  private readonly output = vscode.window.createOutputChannel("gcheck");
  private readonly statusEmitter = new vscode.EventEmitter<Status>();
  private readonly startedEmitter = new vscode.EventEmitter<void>();
  private client: LanguageClient | undefined;
  private program: string | undefined;
  private readonly known = new Map<string, Status>();

  /** The server says which control reads a program. */
  readonly onStatus = this.statusEmitter.event;
  /** The server runs, for the first time or again. */
  readonly onStarted = this.startedEmitter.event;

  constructor(private readonly context: vscode.ExtensionContext) {
    context.subscriptions.push(
      vscode.workspace.onDidChangeConfiguration((change) => {
        if (change.affectsConfiguration("gcheck.path")) {
          void this.restart();
        }
      }),
      vscode.workspace.onDidGrantWorkspaceTrust(() => void this.restart()),
      vscode.workspace.onDidCloseTextDocument((document) => this.known.delete(document.uri.toString())),
    );
  }

  dispose(): void {
    void this.client?.stop();
    this.statusEmitter.dispose();
    this.startedEmitter.dispose();
    this.output.dispose();
  }

  async start(): Promise<void> {
    const program = this.find();
    if (program === undefined) {
      const choice = await vscode.window.showErrorMessage(
        "The gcheck program was not found. Install it, or say in the settings where it is.",
        "Open Settings",
      );
      if (choice !== undefined) {
        await vscode.commands.executeCommand("workbench.action.openSettings", "gcheck.path");
      }
      return;
    }
    this.program = program;
    const run: ServerOptions = { command: program, args: ["lsp"] };
    const options: LanguageClientOptions = {
      documentSelector: [
        { scheme: "file", language: "gcode" },
        { scheme: "untitled", language: "gcode" },
        // Whatever the editor takes it for: hover, completion and findings of the configuration.
        { scheme: "file", pattern: "**/{gcheck,.gcheck}.toml" },
      ],
      outputChannel: this.output,
      synchronize: { configurationSection: "gcheck" },
      // Of what a hover says, nothing but this may be run by a click.
      markdown: { isTrusted: { enabledCommands: [EXPLAIN] }, supportHtml: false },
    };
    const client = new Client("gcheck", "gcheck", run, options);
    client.registerFeature({
      fillClientCapabilities(capabilities) {
        capabilities.experimental = { ...capabilities.experimental, gcheck: { explainCommand: EXPLAIN, changeCommand: CHANGE } };
      },
      initialize: () => undefined,
      getState: () => ({ kind: "static" }),
      clear: () => undefined,
    });
    client.onNotification("gcheck/status", (status: Status) => {
      this.known.set(vscode.Uri.parse(status.uri).toString(), status);
      this.statusEmitter.fire(status);
    });
    this.client = client;
    try {
      await client.start();
      this.startedEmitter.fire();
    } catch (error) {
      this.output.appendLine(`${program} does not start: ${String(error)}`);
      void vscode.window.showErrorMessage(`gcheck does not start: ${String(error)}`);
    }
  }

  async restart(): Promise<void> {
    const client = this.client;
    this.client = undefined;
    if (client !== undefined) {
      await client.dispose();
    }
    await this.start();
  }

  showOutput(): void {
    this.output.show(true);
  }

  /** The program that runs, or ran last; `undefined` when none was found. */
  get path(): string | undefined {
    return this.program;
  }

  get isRunning(): boolean {
    return this.client?.state === State.Running;
  }

  /** Asks the server; `undefined` when it does not run or has no answer. */
  async request<T>(
    method: string,
    parameters: object,
    token: vscode.CancellationToken = NEVER,
  ): Promise<T | undefined> {
    if (this.client === undefined || !this.isRunning) {
      return undefined;
    }
    // Without a token the client takes what is `undefined` for a second parameter, and sends a list.
    const answer: T | null = await this.client.sendRequest(method, parameters, token);
    return answer ?? undefined;
  }

  /** What the server said last of a program's control; `undefined` where it said nothing. */
  statusOf(document: vscode.TextDocument): Status | undefined {
    return this.known.get(document.uri.toString());
  }

  /** A document's address as the protocol writes it. */
  address(document: vscode.TextDocument): { uri: string } {
    return { uri: this.client?.code2ProtocolConverter.asUri(document.uri) ?? document.uri.toString() };
  }

  private find(): string | undefined {
    const name = process.platform === "win32" ? "gcheck.exe" : "gcheck";
    const isFile = (file: string | undefined): file is string =>
      file !== undefined && file !== "" && fs.statSync(file, { throwIfNoEntry: false })?.isFile() === true;
    // What a folder names is run only in a folder that is trusted.
    const configured = vscode.workspace.isTrusted
      ? vscode.workspace.getConfiguration("gcheck").get<string>("path")
      : vscode.workspace.getConfiguration("gcheck").inspect<string>("path")?.globalValue;
    // A relative entry of the PATH would be looked up in the folder that is open.
    const folders = (process.env.PATH ?? "").split(path.delimiter).filter((folder) => path.isAbsolute(folder));
    const inPath = folders.map((folder) => path.join(folder, name));
    const bundled = this.context.asAbsolutePath(path.join("server", name));
    return [configured, process.env.GCHECK_PATH, bundled, ...inPath].find(isFile);
  }
}
