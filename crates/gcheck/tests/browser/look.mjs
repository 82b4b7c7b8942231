// Looks at a page of `gcheck plot` in a real browser, as a person would, and prints what it saw as JSON.
//
//   node look.mjs TOOLS CHROMIUM PAGE.html FOLDER
//
// TOOLS is the folder with `node_modules/playwright-core`; pictures for people go to FOLDER.

import { open, pixels } from "./browser.mjs";

const [tools, executablePath, file, pictures] = process.argv.slice(2);
const { browser, page, seen, rest, picture, colors, text } = await open(tools, executablePath, file, pictures);
try {
  await picture("first");
  seen.title = await page.title();
  seen.summary = await text("#summary");
  seen.tools = await page.locator("#choices .tools label").allInnerTexts();
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
  const blues = (counts) => pixels(counts, (red, green, blue) => blue > 140 && blue > red + 90 && green > red);
  await page.keyboard.press("1");
  const shown = await colors("tools");
  seen.backgroundLight = shown[0][0];
  seen.blueWithTool = blues(shown);
  await page.locator("#choices .tools input").first().uncheck();
  seen.blueWithoutTool = blues(await colors("hidden"));
  await page.locator("#choices .tools input").first().check();
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
