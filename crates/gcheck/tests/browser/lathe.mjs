// Measures on the page of a lathe in a real browser, and prints what it saw as JSON.
//
//   node lathe.mjs TOOLS CHROMIUM PAGE.html FOLDER
//
// As look.mjs.

import { open } from "./browser.mjs";

const [tools, executablePath, file, pictures] = process.argv.slice(2);
const { browser, page, seen, rest, picture, text } = await open(tools, executablePath, file, pictures);
try {
  const line = (words) => page.locator(".source .line", { hasText: words }).first().click();
  await page.locator("#canvas").focus();
  await page.keyboard.press("m");
  await line("X30. Z-25.");
  await page.locator("#choices button", { hasText: "Start" }).click();
  await page.locator("#choices button", { hasText: /^End$/ }).click();
  await rest();
  seen.measured = (await text("#choices .result")).split("\n").map((words) => words.trim()).filter(Boolean).slice(4);
  seen.feed = (await text("#readout")).split(" · ").find((words) => words.startsWith("F"));
  await picture("lathe-measured");
} finally {
  await browser.close();
}
console.log(JSON.stringify(seen));
