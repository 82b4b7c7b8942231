// The extension: starts the server, and adds what the protocol has no words for.

import * as vscode from "vscode";

import { registerCommands } from "./commands";
import { MachineState } from "./machine";
import { Server } from "./server";
import { ControlStatus } from "./status";
import { ToolpathPreview } from "./preview/panel";

/** What tests reach in. */
export interface Api {
  server: Server;
  status: ControlStatus;
  preview: ToolpathPreview;
  machine: MachineState;
}

export async function activate(context: vscode.ExtensionContext): Promise<Api> {
  const server = new Server(context);
  const status = new ControlStatus(server);
  const preview = new ToolpathPreview(context, server);
  const machine = new MachineState(server);
  context.subscriptions.push(server, status, preview, machine, ...registerCommands(server, preview));
  await server.start();
  return { server, status, preview, machine };
}
