// Packs the extension, installs it into VS Code's own server, and runs the tests of src/test in its extension host, with
// its workbench in Chromium: what runs is what users get, the server in the package included.
//
//   node test/run.mjs TOOLS GCHECK [PICTURES]
//
// `node build.mjs --production --tests` comes before. TOOLS holds node_modules with code-server and playwright-core; GCHECK
// is the program that is packed; pictures go to PICTURES. Variables of the environment: CHROMIUM names the browser when it
// is not /usr/bin/chromium; GCHECK_TYPING=all types all programs, not some; GCHECK_TESTS=PATTERN runs
// the tests whose suite and name fit, such as `commands: Show`.

import { spawn, spawnSync } from "node:child_process";
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
/** Minutes after which something is stuck: typing all programs as slowly as people do takes most of an hour. */
const PATIENCE = process.env.GCHECK_TYPING === "all" ? 90 : 20;

const home = fs.mkdtempSync(path.join(os.tmpdir(), "gcheck-vscode-"));
const installed = path.join(home, "extensions");
const answers = path.join(home, "answers");
fs.mkdirSync(answers);
const environment = {
  ...process.env,
  GCHECK_ANSWERS: answers,
  GCHECK_FIXTURES: path.resolve(extension, "../../fixtures"),
};
// Nothing but the package tells where a server is.
delete environment.GCHECK_PATH;

let said = "";
let server;
let browser;
let page;

/** Runs a program to its end; complains with what it says when it fails. */
function runs(program, args, options = {}) {
  const result = spawnSync(program, args, { encoding: "utf8", env: environment, ...options });
  if (result.status !== 0) {
    throw new Error(`${program} ${args.join(" ")} failed:\n${result.error ?? ""}${result.stdout}${result.stderr}`);
  }
  return result.stdout;
}

/** Packs what the release packs, with the program under test as its server. */
function packed() {
  const stage = path.join(home, "package");
  for (const part of fs.readdirSync(extension)) {
    if (!["node_modules", "server", "src", "test", "dist-tests"].includes(part) && !part.endsWith(".vsix")) {
      fs.cpSync(path.join(extension, part), path.join(stage, part), { recursive: true });
    }
  }
  const bundled = path.join(stage, "server/gcheck");
  fs.mkdirSync(path.dirname(bundled));
  fs.copyFileSync(gcheck, bundled);
  // What tests are built with has symbols that take longer to pack than the tests to run.
  spawnSync("strip", [bundled]);
  const file = path.join(home, "gcheck.vsix");
  const vsce = path.join(extension, "node_modules/@vscode/vsce/vsce");
  const target = `${process.platform}-${process.arch}`;
  runs(process.execPath, [vsce, "package", "--no-dependencies", "--target", target, "--out", file], { cwd: stage });
  return file;
}

/** Where VS Code keeps its things in a session. */
function folders(name) {
  return [
    "--server-data-dir", path.join(home, name, "server"),
    "--user-data-dir", path.join(home, name, "user"),
    "--extensions-dir", installed,
    "--accept-server-license-terms",
  ];
}

function install(file) {
  const told = runs(process.execPath, [
    path.join(vscode, "out/server-main.js"), ...folders("install"), "--install-extension", file,
  ]);
  if (!told.includes("successfully installed")) {
    throw new Error(`the package is not installed:\n${told}`);
  }
  console.log("ok the package is installed");
}

/** A program that leaves a note when it is run. */
function intruder() {
  const program = path.join(home, "intruder");
  fs.writeFileSync(program, `#!/bin/sh\ntouch '${home}/intruded'\nexec '${gcheck}' "$@"\n`, { mode: 0o755 });
  return program;
}

async function freePort() {
  return new Promise((resolve) => {
    const probe = net.createServer().listen(0, "127.0.0.1", () => {
      const { port } = probe.address();
      probe.close(() => resolve(port));
    });
  });
}

async function listening(port) {
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

async function picture(name) {
  if (pictures !== undefined) {
    fs.mkdirSync(pictures, { recursive: true });
    await new Promise((resolve) => setTimeout(resolve, 1_500));
    await page.screenshot({ path: path.join(pictures, `${name}.png`) });
  }
}

/** The canvas of the toolpath and the frame around it. */
async function toolpath() {
  const found = await Promise.all(page.frames().map((frame) => frame.$("#canvas").catch(() => null)));
  const canvas = found.find((element) => element !== null);
  const frame = await canvas?.ownerFrame();
  if (!canvas || !frame) {
    throw new Error("no frame shows a toolpath");
  }
  return { canvas, frame };
}

/** Does something in the page of the toolpath, and gives what a part of it says or has as its value: `do` is click, choose, fill, press, ground or nothing. */
async function inToolpath({ do: what, at, with: value, read }) {
  const { frame } = await toolpath();
  if (at !== undefined) await frame.locator(at).first().scrollIntoViewIfNeeded();
  if (what === "click") await frame.locator(at).first().click();
  if (what === "choose") await frame.locator(at).first().selectOption(value);
  if (what === "fill") await frame.locator(at).first().fill(value);
  if (what === "press") await frame.locator(at).first().press(value);
  if (what === "ground") {
    // A corner of the drawing, as red, green and blue.
    return frame.evaluate(() => {
      const paper = document.createElement("canvas").getContext("2d");
      paper.drawImage(document.getElementById("canvas"), 0, 0);
      return [...paper.getImageData(2, 2, 1, 1).data].slice(0, 3).join(",");
    });
  }
  if (read === undefined) return null;
  return frame.locator(read).first().evaluate((element) => (element.matches("select, input") ? element.value : element.innerText));
}

/** Clicks from the left edge of the toolpath towards its middle, until the editor's cursor goes to another line. */
async function clickPath() {
  const { canvas, frame } = await toolpath();
  await frame.selectOption("#view", "top");
  await frame.click("#fit");
  // VS Code says where the cursor is while the text has the focus, not while the toolpath has it.
  const cursor = async () => (await page.locator('[id="status.editor.selection"]').allTextContents()).join("");
  const { x: left, y: top, width, height } = await canvas.boundingBox();
  for (let x = 2; x < width / 2; x += 5) {
    await page.mouse.click(left + x, top + height / 2);
    await new Promise((resolve) => setTimeout(resolve, 100));
    if (/^Ln (?!1,)/.test(await cursor())) return;
  }
}

/** Presses keys with a pause after each, as long as somebody takes who types. */
async function press({ keys, delay: [least, most] }) {
  // The same pauses in each run, and no two alike.
  let seed = 1;
  for (const key of keys) {
    await (key.length === 1 ? page.keyboard.type(key) : page.keyboard.press(key));
    seed = (seed * 48_271) % 2_147_483_647;
    await new Promise((resolve) => setTimeout(resolve, least + (seed % (most - least + 1))));
  }
}

/** What the workbench shows beside the text: the rows of a list, the help for a block, a hover, a message. */
async function widgets() {
  return page.evaluate(() => {
    const seen = (selector) =>
      [...document.querySelectorAll(selector)].filter((element) => element.getClientRects().length > 0);
    const text = (selector) => seen(selector).map((element) => element.innerText).join("\n");
    return {
      rows: seen(".suggest-widget.visible .monaco-list-row").map((row) => row.getAttribute("aria-label") ?? ""),
      focused: seen(".suggest-widget.visible .monaco-list-row.focused").length,
      help: text(".parameter-hints-widget.visible"),
      hover: text(".monaco-hover:not(.hidden)"),
      lenses: seen(".codelens-decoration").map((lens) => lens.innerText),
      dialog: seen(".quick-input-widget").length > 0,
      messages: text(".notification-toast, .monaco-dialog-box"),
    };
  });
}

/** The colours of words in the text that is shown, each of its first occurrence. */
async function colors(words) {
  return page.evaluate((words) => {
    const spans = [...document.querySelectorAll(".editor-instance .view-line span span")];
    const color = (word) => {
      const span = spans.find((span) => span.textContent.trim().startsWith(word));
      return span === undefined ? null : getComputedStyle(span).color;
    };
    return Object.fromEntries(words.map((word) => [word, color(word)]));
  }, words);
}

/** All text of pages inside the window. */
async function frames() {
  const texts = await Promise.all(
    page.frames().slice(1).map((frame) => frame.evaluate(() => document.body?.innerText ?? "").catch(() => "")),
  );
  return texts.join("\n");
}

/** What tests ask of the browser. */
const deeds = { screenshot: picture, clickPath, inToolpath, press, widgets, colors, frames };

/** A line of the log: for the reader, a question of a test, or of VS Code itself. */
async function logged(line) {
  const [, what, rest] = /^@(\S+) ?(.*)$/s.exec(line) ?? [];
  if (what === "test") {
    console.log(rest);
  } else if (what in deeds) {
    const [, id, parameters] = /^(\d+) (.*)$/s.exec(rest);
    let answer;
    try {
      answer = { result: (await deeds[what](JSON.parse(parameters))) ?? null };
    } catch (error) {
      answer = { failed: String(error.stack ?? error) };
    }
    const file = path.join(answers, `${id}.json`);
    // Whoever waits for it is to see it whole.
    fs.writeFileSync(`${file}.new`, JSON.stringify(answer));
    fs.renameSync(`${file}.new`, file);
  } else {
    said += `${line}\n`;
  }
}

/** A session with VS Code: true when its tests pass. */
async function session(name, settings, prepare = () => {}) {
  const workspace = path.join(home, name, "programs");
  fs.cpSync(path.join(extension, "test/programs"), workspace, { recursive: true });
  prepare(workspace);
  const own = path.join(home, name, "user/User/settings.json");
  fs.mkdirSync(path.dirname(own), { recursive: true });
  const usual = {
    "workbench.startupEditor": "none",
    "workbench.colorTheme": "Default Dark Modern",
    "telemetry.telemetryLevel": "off",
    "extensions.autoCheckUpdates": false,
    "update.mode": "none",
    "editor.minimap.enabled": false,
    "workbench.tips.enabled": false,
    // In a browser VS Code saves by itself.
    "files.autoSave": "off",
  };
  fs.writeFileSync(own, JSON.stringify({ ...usual, ...settings }));
  // VS Code runs tests for an extension under development only: this one does nothing.
  const nothing = path.join(home, "nothing");
  fs.mkdirSync(nothing, { recursive: true });
  const manifest = { name: "nothing", publisher: "test", version: "0.0.1", engines: { vscode: "*" } };
  fs.writeFileSync(path.join(nothing, "package.json"), JSON.stringify(manifest));

  const port = await freePort();
  server = spawn(
    process.execPath,
    [
      path.join(vscode, "out/server-main.js"), ...folders(name),
      "--host", "127.0.0.1",
      "--port", String(port),
      "--without-connection-token",
      "--telemetry-level", "off",
    ],
    { env: environment, stdio: ["ignore", "pipe", "pipe"] },
  );
  for (const stream of [server.stdout, server.stderr]) {
    stream.on("data", (data) => (said += data));
  }
  await listening(port);
  page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  await page.exposeFunction("codeAutomationLog", (_type, args) =>
    logged(args.map(String).join(" ")).catch((error) => console.log(`FAILED: ${error.stack ?? error}`)),
  );
  fs.rmSync(answers, { recursive: true, force: true });
  fs.mkdirSync(answers);
  const exited = new Promise((resolve) => page.exposeFunction("codeAutomationExit", (code) => resolve(code)));
  const remote = (file) => `vscode-remote://127.0.0.1:${port}${file}`;
  const payload = [
    ["extensionDevelopmentPath", remote(nothing)],
    ["extensionTestsPath", remote(path.join(extension, "dist-tests/tests.js"))],
  ];
  const query = `folder=${encodeURIComponent(workspace)}&payload=${encodeURIComponent(JSON.stringify(payload))}`;
  await page.goto(`http://127.0.0.1:${port}/?${query}`);
  const code = await exited;
  await page.close();
  server.kill("SIGKILL");
  return code === 0;
}

async function end(code) {
  await browser?.close().catch(() => undefined);
  server?.kill("SIGKILL");
  fs.rmSync(home, { recursive: true, force: true });
  process.exit(code);
}

const deadline = setTimeout(async () => {
  console.log(`FAILED: not done after ${PATIENCE} minutes\n${said.slice(-2000)}`);
  await page?.screenshot({ path: path.join(pictures ?? os.tmpdir(), "vscode-stuck.png") }).catch(() => undefined);
  await end(1);
}, PATIENCE * 60_000);
deadline.unref();

try {
  install(packed());
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    headless: true,
    args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
  });
  const trusted = await session("trusted", { "security.workspace.trust.enabled": false });
  // The folder names a server of its own, and nobody has said that the folder is to be trusted.
  const restricted = await session(
    "restricted",
    { "security.workspace.trust.startupPrompt": "never", "security.workspace.trust.banner": "never" },
    (workspace) => {
      fs.mkdirSync(path.join(workspace, ".vscode"));
      const settings = JSON.stringify({ "gcheck.path": intruder() });
      fs.writeFileSync(path.join(workspace, ".vscode/settings.json"), settings);
    },
  );
  const intruded = fs.existsSync(path.join(home, "intruded"));
  console.log(`${intruded ? "FAILED" : "ok"} a program that the folder names is not run`);
  const passed = trusted && restricted && !intruded;
  console.log(passed ? "all tests passed" : `FAILED\n${said.slice(-2000)}`);
  await end(passed ? 0 : 1);
} catch (error) {
  console.log(`FAILED: ${error.stack ?? error}\n${said.slice(-2000)}`);
  await end(1);
}
