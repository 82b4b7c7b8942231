// Uses the playground in a real browser, as a person would, and prints what it saw as JSON.
//
//   node look.mjs TOOLS CHROMIUM FOLDER PICTURES
//
// TOOLS is the folder with `node_modules/playwright-core`, FOLDER what `cargo xtask playground` made; pictures for people go to
// PICTURES. Knows: Playwright, how files are handed out. Must not know: what is right.

import { createReadStream, existsSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import path from "node:path";

const [tools, executablePath, folder, pictures] = process.argv.slice(2);
const { chromium } = createRequire(path.resolve(tools, "package.json"))("playwright-core");

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json", ".wasm": "application/wasm" };
const server = createServer((request, response) => {
  const file = path.join(folder, path.normalize(new URL(request.url, "http://localhost").pathname));
  if (!existsSync(file) || !statSync(file).isFile()) { response.writeHead(404).end(); return; }
  response.writeHead(200, { "content-type": TYPES[path.extname(file)] ?? "application/octet-stream" });
  createReadStream(file).pipe(response);
});
await new Promise((listening) => server.listen(0, "127.0.0.1", listening));
const origin = `http://127.0.0.1:${server.address().port}`;

const args = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const browser = await chromium.launch({ executablePath, headless: true, args });
const seen = { problems: [], strangers: [] };

/** The page, with its workers where the test can reach them. */
async function open(options) {
  const page = await browser.newPage({ viewport: { width: 1360, height: 860 }, ...options });
  page.setDefaultTimeout(30000);
  page.on("console", (message) => { if (message.type() === "error") seen.problems.push(message.text()); });
  page.on("pageerror", (error) => seen.problems.push(error.message));
  page.on("request", (request) => { if (!/^(blob|data):/.test(request.url()) && !request.url().startsWith(origin)) seen.strangers.push(request.url()); });
  await page.addInitScript(() => {
    const Plain = Worker;
    window.workers = [];
    window.Worker = class extends Plain {
      constructor(...given) { super(...given); window.workers.push(this); }
    };
  });
  await page.goto(`${origin}/index.html`);
  await page.locator("#main").waitFor({ state: "visible" });
  return page;
}

const text = (page, selector) => page.locator(selector).innerText();
const settled = (page) => page.waitForFunction(() => / ms$/.test(document.getElementById("status").textContent));
/** Types a program; the answer is what the page says when it has read it. */
async function type(page, program) {
  await page.waitForFunction(() => !document.getElementById("status").textContent.startsWith("reading"));
  await page.evaluate(() => { document.getElementById("status").textContent = ""; });
  await page.locator("#text").fill(program);
  await settled(page);
  return text(page, "#status");
}
const drawn = (page) => page.waitForFunction(() => document.getElementById("run").textContent !== "");
const rest = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
async function picture(page, name) {
  await rest(page);
  await page.screenshot({ path: path.join(pictures, `${name}.png`) });
}

try {
  const page = await open({ colorScheme: "light" });
  await settled(page);
  await drawn(page);
  seen.samples = await page.locator("#samples option").allInnerTexts();
  seen.controls = await page.locator("#control option").count();
  seen.firstReading = await text(page, "#reading");
  seen.firstFindings = await page.locator("#findings li[data-index]").count();
  await page.locator("#findings button").first().click();
  await page.locator("#state code").first().waitFor();
  await picture(page, "light");

  // A program is typed: it is hostile, and has a mistake.
  await page.selectOption("#control", "haas-mill");
  seen.status = await type(page, "%\nO1 (</script><img src=x onerror=alert(1)><b>BOLD</b>)\nG21 G90 G54\nT1 M6\nG0 X0. Y0. Z5.\nG1 X50.\nX50. Y30.\nM30\n%\n");
  seen.markup = await page.locator("#editor b, #editor img, #findings b, #findings img, #state img").count();
  seen.findings = await page.locator("#findings li[data-index] > button").allInnerTexts();
  await page.locator(".marks span").first().waitFor();
  seen.marked = await page.locator(".marks span").allInnerTexts();

  // A finding is clicked: the cursor goes there, and the state there is shown.
  await page.locator('#findings button:has-text("feed-missing")').click();
  await page.waitForFunction(() => document.getElementById("state-title").textContent.includes("line 6"));
  seen.chosen = await page.locator("#text").evaluate((field) => field.value.slice(field.selectionStart, field.selectionEnd));
  seen.focus = await page.evaluate(() => document.activeElement.id);
  seen.state = await text(page, "#state");
  await drawn(page);
  seen.run = await text(page, "#run");
  seen.readout = await text(page, "#readout");
  await page.locator("#text").press("Control+Home");
  await page.waitForFunction(() => document.getElementById("state-title").textContent.endsWith("line 1, column 1"));
  await page.keyboard.press("F8");
  await page.waitForFunction(() => !document.getElementById("state-title").textContent.endsWith("line 1, column 1"));
  seen.afterF8 = await text(page, "#state-title");

  // The mistake is corrected by hand.
  await page.locator('#findings button:has-text("feed-missing")').click();
  await page.keyboard.press("End");
  await page.keyboard.type(" F200.");
  await page.locator('#findings button:has-text("feed-missing")').waitFor({ state: "detached" });
  seen.corrected = (await page.locator("#text").inputValue()).split("\n")[5];

  // Nothing, and too much.
  seen.empty = await type(page, "");
  await page.locator("#text").evaluate((field) => { field.value = "G0 X1.\n".repeat(300000); field.dispatchEvent(new Event("input")); });
  await page.locator("#problem").waitFor({ state: "visible" });
  seen.tooLong = await text(page, "#problem");

  // The module panics: the page says so and goes on with another worker.
  await type(page, "O1\nG0 X1.\nM30\n");
  seen.workersBefore = await page.evaluate(() => window.workers.length);
  seen.panicAnswer = await page.evaluate(() => new Promise((answered) => {
    const worker = window.workers.at(-1), post = worker.postMessage.bind(worker);
    // The next check panics in its place; a question about the text before may still be under way.
    worker.postMessage = (message) => post(message.ask === "check" ? { id: message.id, ask: "panic" } : message);
    const field = document.getElementById("text"), problem = document.getElementById("problem");
    new MutationObserver(() => { if (!problem.hidden) answered(problem.textContent); }).observe(problem, { attributes: true, childList: true });
    field.value += "\n";
    field.dispatchEvent(new Event("input"));
  }));
  seen.workersAfter = await page.evaluate(() => window.workers.length);
  seen.afterPanic = await type(page, "O1\nG0 X1.\nM30\n");
  seen.problemAfterPanic = await page.locator("#problem").isVisible();

  // A question that has no answer in time is given up, and the next one has its answer.
  await page.evaluate(() => {
    const worker = window.workers.at(-1), post = worker.postMessage.bind(worker);
    // No check has an answer.
    worker.postMessage = (message) => { if (message.ask !== "check") post(message); };
  });
  await page.locator("#text").fill("O2\nG0 X1.\nM30\n");
  await page.locator("#problem").waitFor({ state: "visible" });
  seen.tooSlow = await text(page, "#problem");
  seen.clockOfNothing = [await text(page, "#clock"), await page.locator("#time").evaluate((slider) => slider.max)];
  seen.workersAfterWaiting = await page.evaluate(() => window.workers.length);
  seen.afterWaiting = await type(page, "O1\nG0 X1.\nM30\n");

  // How long 1,000 lines take, in a page that has read nothing of them.
  let surface = "%\nO1\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\nG0 G90 G54 X0. Y0. S2000 M3\nG43 H1 Z10.\nG1 Z-1. F500.\n";
  for (let i = 0; i < 989; i++) surface += `X${(Math.sin(i) * 50).toFixed(3)} Y${(i / 10).toFixed(3)} Z${(Math.cos(i) - 1).toFixed(3)}\n`;
  surface += "G0 Z50.\nM5\nM30\n%\n";
  const other = await open({ colorScheme: "dark" });
  await settled(other);
  await drawn(other);
  await other.locator("#text").press("Control+Home");
  await other.keyboard.press("F8");
  await other.locator("#state code").first().waitFor();
  await picture(other, "dark");
  await other.selectOption("#control", "fanuc-mill");
  seen.lines = surface.split("\n").length - 1;
  const took = async (program) => Number(/(\d+) ms$/.exec(await type(other, program))[1]);
  seen.millisecondsFirst = await took(surface);
  await type(other, "O1\nM30\n");
  seen.milliseconds = await took(surface.replaceAll("Y", " Y"));
  await other.selectOption("#samples", "1");
  await settled(other);
  await drawn(other);
  await picture(other, "lathe");
  await other.selectOption("#samples", "2");
  await settled(other);
  await drawn(other);
  await picture(other, "plate");
  await other.setViewportSize({ width: 420, height: 900 });
  await picture(other, "narrow");
  seen.sideways = await other.evaluate(() => document.documentElement.scrollWidth > innerWidth);
} finally {
  await browser.close();
  server.close();
}
console.log(JSON.stringify(seen));
