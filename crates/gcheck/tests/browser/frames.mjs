// Turns the view of a large page with the pointer, and prints how long frames take, in milliseconds, as JSON.
//
//   node frames.mjs TOOLS CHROMIUM PAGE.html FOLDER
//
// As look.mjs.

import { open } from "./browser.mjs";

const [tools, executablePath, file, pictures] = process.argv.slice(2);
const { browser, page, seen, rest, picture, text } = await open(tools, executablePath, file, pictures);
try {
  await rest();
  seen.summary = await text("#summary");
  seen.frames = await page.evaluate(async () => {
    const canvas = document.getElementById("canvas"), { width, height } = canvas.getBoundingClientRect();
    const next = () => new Promise(requestAnimationFrame);
    const point = (name, x) => canvas.dispatchEvent(new PointerEvent(name, { pointerId: 1, clientX: x, clientY: height / 2, buttons: 1, bubbles: true, isPrimary: true }));
    canvas.setPointerCapture = () => {};
    point("pointerdown", width / 2);
    const times = [];
    let before = await next();
    for (let i = 0; i < 80; i++) {
      point("pointermove", width / 2 + 40 * Math.sin(i / 5));
      const now = await next();
      // How much is drawn at once is learned in the first ones.
      if (i >= 20) times.push(now - before);
      before = now;
    }
    point("pointerup", width / 2);
    return times.sort((a, b) => a - b).map(Math.round);
  });
  await new Promise((resolve) => setTimeout(resolve, 3000));
  await picture("million");
} finally {
  await browser.close();
}
console.log(JSON.stringify(seen));
