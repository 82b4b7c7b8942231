// Looks at a page of `gcheck plot` in a real browser, as a person would, and prints what it saw as JSON.
//
//   node look.mjs TOOLS CHROMIUM PAGE.html FOLDER
//
// TOOLS is the folder with `node_modules/playwright-core`; pictures for people go to FOLDER.

import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";
import path from "node:path";

const [tools, executablePath, file, pictures] = process.argv.slice(2);
const { chromium } = createRequire(path.resolve(tools, "package.json"))("playwright-core");

// Without a graphics card the browser draws by itself.
const args = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const browser = await chromium.launch({ executablePath, headless: true, args });
const seen = { problems: [], requests: [] };
try {
  const page = await browser.newPage({ viewport: { width: 1200, height: 800 }, colorScheme: "light" });
  page.setDefaultTimeout(60000);
  page.on("console", (message) => { if (message.type() === "error") seen.problems.push(message.text()); });
  page.on("pageerror", (error) => seen.problems.push(error.message));
  page.on("request", (request) => seen.requests.push(request.url().split("/").pop()));

  const rest = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const picture = async (name) => {
    await rest();
    return page.screenshot({ path: path.join(pictures, `${name}.png`), timeout: 60000 });
  };
  // Colours of the view with how often each is seen, the most frequent first.
  const colors = async (name) => {
    const png = (await picture(name)).toString("base64");
    return page.evaluate(async (png) => {
      const image = new Image(), paper = document.createElement("canvas").getContext("2d");
      image.src = `data:image/png;base64,${png}`;
      await image.decode();
      const { x, y, width, height } = document.getElementById("canvas").getBoundingClientRect();
      paper.canvas.width = width; paper.canvas.height = height;
      paper.drawImage(image, -x, -y);
      const counts = new Map(), { data } = paper.getImageData(0, 0, width, height);
      for (let i = 0; i < data.length; i += 4) {
        const key = `${data[i]},${data[i + 1]},${data[i + 2]}`;
        counts.set(key, (counts.get(key) ?? 0) + 1);
      }
      return [...counts].sort((a, b) => b[1] - a[1]);
    }, png);
  };
  const text = (selector) => page.locator(selector).innerText();

  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector(".source .line");
  await picture("first");
  seen.title = await page.title();
  seen.summary = await text("#summary");
  seen.legend = (await text("#legend")).split("\n");
  seen.notes = await page.locator("#notes").innerText();
  seen.message = await page.locator(".message").count();
  seen.boldElements = await page.locator(".source b, header b, #findings b").count();
  seen.lines = await page.locator(".source .code").allInnerTexts();
  seen.findings = await page.locator("#findings button").allInnerTexts();
  seen.marked = await page.locator(".source .line.marked").count();

  // A line is clicked: its moves are shown.
  await page.locator('.source .line[data-line="8"]').click();
  await rest();
  seen.readoutOfLine8 = await text("#readout");
  seen.chosen = await page.locator(".source .line.chosen .number").innerText();
  await picture("line");

  // From above, the middle of the first cut is clicked: its line is chosen.
  await page.keyboard.press("Escape");
  await page.locator("#canvas").focus();
  await page.keyboard.press("1");
  await rest();
  const box = await page.locator("#canvas").boundingBox();
  seen.picked = null;
  for (let y = box.y + box.height - 20; y > box.y + box.height / 2 && !seen.picked; y -= 5) {
    await page.mouse.click(box.x + box.width * 0.45, y);
    await rest();
    if (await page.locator(".source .line.chosen").count()) seen.picked = await text("#readout");
  }
  await picture("top");

  // A finding is clicked.
  if (seen.findings.length) {
    await page.keyboard.press("n");
    await rest();
    seen.lineOfFinding = await page.locator(".source .line.chosen .number").innerText();
  }

  // Play begins at the start and can be stopped.
  await page.keyboard.press("Escape");
  const clock = async () => (await text("#clock")).split(" / ")[0];
  seen.clockAtEnd = await clock();
  await page.locator("#canvas").focus();
  await page.keyboard.press("Space");
  await page.waitForFunction(() => document.getElementById("play").textContent === "Pause");
  await page.waitForFunction(() => Number(document.getElementById("time").value) > 0);
  await page.keyboard.press("Space");
  seen.playStops = await text("#play");
  seen.clockInPlay = await clock();
  await page.keyboard.press("Home");
  seen.clockAtStart = await clock();
  await page.keyboard.press(".");
  seen.afterOneStep = await text("#readout");
  await page.keyboard.press("End");

  // A tool is hidden: its colour is gone from the view; the background changes with the theme.
  // The legend is blue in places as well.
  const blues = (counts) => counts.reduce((sum, [color, count]) => {
    const [red, green, blue] = color.split(",").map(Number);
    return blue > 180 && blue > red + 100 && green > red ? sum + count : sum;
  }, 0);
  await page.keyboard.press("1");
  const shown = await colors("tools");
  seen.backgroundLight = shown[0][0];
  seen.blueWithTool = blues(shown);
  await page.locator("#legend input").first().uncheck();
  seen.blueWithoutTool = blues(await colors("hidden"));
  await page.locator("#legend input").first().check();
  await page.locator("#theme").click();
  seen.theme = await page.evaluate(() => document.documentElement.dataset.theme);
  await page.keyboard.press("4");
  await picture("dark");

  // A telephone.
  await page.setViewportSize({ width: 420, height: 760 });
  await picture("narrow");
  seen.scrollsSideways = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
} finally {
  await browser.close();
}
console.log(JSON.stringify(seen));
