// Turns the part on a page of a program with a rotary axis, steps from operation to operation, and opens the page at a line, in a
// real browser; prints what it saw as JSON.
//
//   node rotary.mjs TOOLS CHROMIUM PAGE.html FOLDER
//
// As look.mjs.

import { open, pixels } from "./browser.mjs";

const [tools, executablePath, file, pictures] = process.argv.slice(2);
const { browser, page, seen, rest, picture, colors, text } = await open(tools, executablePath, file, pictures);
const isGround = (r, g, b) => r > 235 && g > 235 && b > 235;
const line = (number) => page.locator(`.source .line[data-line="${number}"]`).click();
const ways = page.locator('#choices select[aria-label="Rotary axis"]');
try {
  seen.ways = await ways.locator("option").allInnerTexts();
  // The end of the first hole, in each way: as the program has it, and where it is drawn.
  seen.readouts = {};
  seen.drawn = {};
  seen.ink = {};
  for (const way of ["still", "around", "unrolled"]) {
    await ways.selectOption(way);
    await line(16);
    await rest();
    seen.readouts[way] = (await text("#readout")).split(" · ").find((words) => words.startsWith("X"));
    await page.locator("#choices button", { hasText: "Measure" }).click();
    await page.locator("#choices button", { hasText: /^End$/ }).click();
    await rest();
    seen.drawn[way] = (await text("#choices .result")).split("\n").map((words) => words.trim()).filter(Boolean)[1];
    await page.locator("#canvas").focus();
    await page.keyboard.press("Escape");
    await page.keyboard.press("Escape");
    await page.keyboard.press("f");
    seen.ink[way] = pixels(await colors(`rotary-${way}`), (...color) => !isGround(...color));
  }
  // Half of the way of a turn: X, Z and A of the program, whatever is drawn.
  await ways.selectOption("around");
  await page.locator("#canvas").focus();
  await page.keyboard.press("Home");
  seen.operations = [];
  for (const key of ["s", "s", "Shift+S"]) {
    await page.keyboard.press(key);
    await rest();
    seen.operations.push((await text("#readout")).split(" · ")[0]);
  }
  // The address chooses a line, and another one when it changes.
  seen.addresses = [];
  for (const hash of ["#line=11", "#line=16", "#line=99999", "#line=x"]) {
    await page.evaluate((hash) => { location.hash = hash; }, hash);
    await rest();
    seen.addresses.push((await text("#readout")).split(" · ")[0]);
  }
} finally {
  await browser.close();
}
console.log(JSON.stringify(seen));
