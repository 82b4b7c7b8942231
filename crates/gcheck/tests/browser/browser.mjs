// A browser with a page of `gcheck plot`, and what tests see in it.
//
// Knows: Playwright, pixels. Must not know: what is tested.

import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";
import path from "node:path";

/** Opens a page; `seen` collects what goes wrong and what is asked for. */
export async function open(tools, executablePath, file, pictures, options = {}) {
  const { chromium } = createRequire(path.resolve(tools, "package.json"))("playwright-core");
  // Without a graphics card the browser draws by itself.
  const args = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
  const browser = await chromium.launch({ executablePath, headless: true, args });
  const page = await browser.newPage({ viewport: { width: 1200, height: 800 }, colorScheme: "light", ...options });
  page.setDefaultTimeout(60000);
  const seen = { problems: [], requests: [] };
  page.on("console", (message) => { if (message.type() === "error") seen.problems.push(message.text()); });
  page.on("pageerror", (error) => seen.problems.push(error.message));
  page.on("request", (request) => { if (!request.url().startsWith("blob:")) seen.requests.push(request.url().split("/").pop()); });
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector(".source .line");

  const rest = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const picture = async (name) => {
    await rest();
    return page.screenshot({ path: path.join(pictures, `${name}.png`), timeout: 60000 });
  };
  /** Colours of the view with how often each is seen, the most frequent first. */
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
  return { browser, page, seen, rest, picture, colors, text };
}

/** How many pixels have a colour that `is` says: red, green and blue from 0 to 255. */
export function pixels(counts, is) {
  return counts.reduce((sum, [color, count]) => is(...color.split(",").map(Number)) ? sum + count : sum, 0);
}
