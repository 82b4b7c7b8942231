// A browser for `:GcheckPath`: opens the address, and says what the page says of the chosen line.
//
//   node follow.mjs TOOLS CHROMIUM PICTURES ADDRESS
//
// Lines on standard output: `says TEXT` whenever the text below the path changes, `title TEXT` whenever the title does. It ends
// when the page has ended.

import * as fs from "node:fs";
import { createRequire } from "node:module";
import * as path from "node:path";

const [tools, executablePath, pictures, address] = process.argv.slice(2);
const { chromium } = createRequire(path.join(tools, "package.json"))("playwright-core");
const browser = await chromium.launch({
  executablePath,
  headless: true,
  args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
page.on("console", (message) => console.log(`log ${message.text()}`));
await page.goto(address);
const shown = { says: "", title: "" };
for (;;) {
  const frame = page.frames().find((frame) => frame.url().includes("/page"));
  const says = await frame?.locator("#readout").innerText({ timeout: 1_000 }).catch(() => "");
  const title = await page.title();
  for (const [kind, text] of Object.entries({ says, title })) {
    if (text && text !== shown[kind]) {
      shown[kind] = text;
      console.log(`${kind} ${text.replaceAll("\n", " ")}`);
      if (kind === "says") {
        fs.mkdirSync(pictures, { recursive: true });
        await page.screenshot({ path: path.join(pictures, "neovim-path.png") });
      }
    }
  }
  if (title.startsWith("ended")) break;
  await new Promise((resolve) => setTimeout(resolve, 50));
}
await browser.close();
