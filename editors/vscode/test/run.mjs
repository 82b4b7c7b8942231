// Runs the tests of src/test inside VS Code: its own server, its workbench in Chromium, its extension host.
//
//   node test/run.mjs TOOLS GCHECK [PICTURES]
//
// TOOLS holds node_modules with code-server and playwright-core; GCHECK is the program; pictures go to PICTURES.
// CHROMIUM names the browser when it is not /usr/bin/chromium.

import { spawn } from "node:child_process";
import * as fs from "node:fs";
import { createRequire } from "node:module";
import * as net from "node:net";
import * as os from "node:os";
import * as path from "node:path";
import { fileURLToPath } from "node:url";

const [tools, gcheck, pictures] = process.argv.slice(2).map((argument) => path.resolve(argument));
const extension = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "..");
const require = createRequire(path.join(tools, "package.json"));
const { chromium } = require("playwright-core");
const vscode = path.join(tools, "node_modules/code-server/lib/vscode");

const home = fs.mkdtempSync(path.join(os.tmpdir(), "gcheck-vscode-"));
const workspace = path.join(home, "programs");
fs.cpSync(path.join(extension, "test/programs"), workspace, { recursive: true });
fs.mkdirSync(path.join(home, "user/User"), { recursive: true });
const settings = {
  "security.workspace.trust.enabled": false,
  "workbench.startupEditor": "none",
  "workbench.colorTheme": "Default Dark Modern",
  "telemetry.telemetryLevel": "off",
  "extensions.autoCheckUpdates": false,
  "update.mode": "none",
  "editor.minimap.enabled": false,
  "workbench.tips.enabled": false,
};
fs.writeFileSync(path.join(home, "user/User/settings.json"), JSON.stringify(settings));

const port = await new Promise((resolve) => {
  const probe = net.createServer().listen(0, "127.0.0.1", () => {
    const { port } = probe.address();
    probe.close(() => resolve(port));
  });
});

const server = spawn(
  process.execPath,
  [
    path.join(vscode, "out/server-main.js"),
    "--server-data-dir", path.join(home, "server"),
    "--user-data-dir", path.join(home, "user"),
    "--extensions-dir", path.join(home, "extensions"),
    "--accept-server-license-terms",
    "--host", "127.0.0.1",
    "--port", String(port),
    "--without-connection-token",
    "--telemetry-level", "off",
  ],
  { env: { ...process.env, GCHECK_PATH: gcheck }, stdio: ["ignore", "pipe", "pipe"] },
);
let said = "";
for (const stream of [server.stdout, server.stderr]) {
  stream.on("data", (data) => (said += data));
}

let browser;
async function end(code) {
  await browser?.close().catch(() => undefined);
  server.kill("SIGKILL");
  fs.rmSync(home, { recursive: true, force: true });
  process.exit(code);
}

async function listening() {
  for (let i = 0; i < 600; i++) {
    const answers = await new Promise((resolve) => {
      const socket = net.connect(port, "127.0.0.1", () => (socket.end(), resolve(true)));
      socket.on("error", () => resolve(false));
    });
    if (answers) return;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  throw new Error(`VS Code's server does not listen:\n${said}`);
}

const deadline = setTimeout(async () => {
  console.log(`FAILED: not done after ten minutes\n${said.slice(-2000)}`);
  await page?.screenshot({ path: path.join(pictures ?? os.tmpdir(), "vscode-stuck.png") }).catch(() => undefined);
  await end(1);
}, 600_000);
deadline.unref();

let page;
try {
  await listening();
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    headless: true,
    args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  await page.exposeFunction("codeAutomationLog", async (_type, args) => {
    const line = args.map(String).join(" ");
    const wanted = /^@screenshot (\S+)$/.exec(line);
    if (wanted === null) {
      const told = /^@test (.*)$/s.exec(line);
      if (told !== null) {
        console.log(told[1]);
      } else {
        said += `${line}\n`;
      }
    } else if (pictures !== undefined) {
      fs.mkdirSync(pictures, { recursive: true });
      await new Promise((resolve) => setTimeout(resolve, 1_500));
      await page.screenshot({ path: path.join(pictures, `${wanted[1]}.png`) });
    }
  });
  const exited = new Promise((resolve) => page.exposeFunction("codeAutomationExit", (code) => resolve(code)));
  const remote = (file) => `vscode-remote://127.0.0.1:${port}${file}`;
  const payload = [
    ["extensionDevelopmentPath", remote(extension)],
    ["extensionTestsPath", remote(path.join(extension, "dist/tests.js"))],
  ];
  await page.goto(
    `http://127.0.0.1:${port}/?folder=${encodeURIComponent(workspace)}&payload=${encodeURIComponent(JSON.stringify(payload))}`,
  );
  await end((await exited) === 0 ? 0 : 1);
} catch (error) {
  console.log(`FAILED: ${error.stack ?? error}\n${said.slice(-2000)}`);
  await end(1);
}
