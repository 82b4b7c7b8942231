// Uses every option of a page of `gcheck plot` in a real browser, and prints what it saw as JSON.
//
//   node options.mjs TOOLS CHROMIUM PAGE.html FOLDER
//
// As look.mjs; what is downloaded goes to FOLDER as well.

import fs from "node:fs";
import path from "node:path";

import { open, pixels } from "./browser.mjs";

const [tools, executablePath, file, pictures] = process.argv.slice(2);
const { browser, page, seen, rest, picture, colors, text } = await open(tools, executablePath, file, pictures);

const isGround = (r, g, b) => r > 235 && g > 235 && b > 235;
const isRapid = (r, g, b) => r > 190 && g < 70 && b < 80;
/** Pixels that something is drawn on. */
const drawn = async (name) => {
  // The ring around a view with the focus is not a part of the path.
  await page.evaluate(() => document.activeElement.blur());
  return pixels(await colors(name), (...color) => !isGround(...color));
};
const openGroup = (name) => page.locator("#choices summary", { hasText: name }).evaluate((summary) => { summary.parentElement.open = true; });
const colorBy = async (name) => { await page.locator('#choices select[aria-label="Colour by"]').selectOption(name); await rest(); };
const legend = async () => (await text("#choices .legend")).split("\n").map((line) => line.trim()).filter(Boolean);
const chooseLine = async (line) => { await page.locator(`.source .line[data-line="${line}"]`).click(); await rest(); };

/** Boxes of elements that are seen; pairs of them that overlap, by their names. */
const overlaps = (selector) => page.evaluate((selector) => {
  const name = (element) => element.ariaLabel || element.textContent.trim() || element.id;
  const seen = [...document.querySelectorAll(selector)].filter((element) => element.checkVisibility() && element.getClientRects().length);
  const boxes = seen.map((element) => ({ name: name(element), box: element.getBoundingClientRect() }));
  const cross = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1;
  return boxes.flatMap((one, i) => boxes.slice(i + 1).filter((other) => cross(one.box, other.box)).map((other) => `${one.name} / ${other.name}`));
}, selector);

/** Saves the view; the path of the file. */
async function saved(kind) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#choices button", { hasText: kind }).click()]);
  const to = path.join(pictures, download.suggestedFilename());
  await download.saveAs(to);
  return { name: download.suggestedFilename(), to };
}

/** Words of the picture that cover each other. */
const coveredWords = (svg) => page.evaluate((svg) => {
  const host = document.createElement("div");
  host.append(document.importNode(new DOMParser().parseFromString(svg, "image/svg+xml").documentElement, true));
  document.body.append(host);
  const all = [...host.querySelectorAll("text")].map((element) => ({ words: element.textContent, box: element.getBBox() }));
  host.remove();
  const cross = ({ box: a }, { box: b }) => a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
  return { words: all.map(({ words }) => words), covered: all.flatMap((one, i) => all.slice(i + 1).filter((other) => cross(one, other)).map((other) => `${one.words} / ${other.words}`)) };
}, svg);

try {
  // Where the tool is: feed, speed, tool, time that is left.
  await page.locator("#canvas").focus();
  await page.keyboard.press("Home");
  for (let i = 0; i < 4; i++) await page.keyboard.press(".");
  seen.readout = await text("#readout");
  await page.keyboard.press("End");
  seen.speeds = (await text("#speed")).split("\n").map((line) => line.trim());

  // Colours: each row of a legend is a colour of the view, in the order of its values.
  await page.keyboard.press("4");
  await rest();
  seen.redOfRapids = pixels(await colors("tool"), isRapid);
  await page.keyboard.press("r");
  seen.redWithoutRapids = pixels(await colors("without-rapids"), isRapid);
  await colorBy("feed");
  seen.feeds = await legend();
  const swatches = await page.locator("#choices .legend i").evaluateAll((all) => all.map((one) => getComputedStyle(one).borderTopColor.match(/\d+/g).map(Number)));
  const counts = await colors("feed");
  // A line is thin, so that its colour is mixed with the ground, and steep or far moves are darker.
  const way = (color) => color.map((part) => 251 - part), size = (color) => Math.hypot(...color);
  const isLike = (color, swatch) => [1, 0.85, 0.7].some((shade) => {
    const [a, b] = [way(color), way(swatch.map((part) => part * shade))];
    return size(a) > 90 && (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / size(a) / size(b) > 0.995;
  });
  seen.pixelsOfFeeds = swatches.map((swatch) => pixels(counts, (...color) => isLike(color, swatch)));
  await colorBy("height");
  seen.heights = await legend();
  await colorBy("time");
  seen.times = await legend();
  await page.keyboard.press("4");
  seen.colorsByTime = (await colors("time")).filter(([color, count]) => count > 20 && !isGround(...color.split(",").map(Number))).length;
  await colorBy("spindle");
  seen.spindle = await legend();
  await picture("spindle");
  await colorBy("tool");
  await page.locator("#canvas").focus();
  await page.keyboard.press("r");

  // Heights: what is below is not drawn, and comes back.
  await page.keyboard.press("2");
  await openGroup("Range of Z");
  seen.drawnAtAllHeights = await drawn("all-heights");
  await page.locator('#choices input[type=number]').first().fill("0");
  await page.keyboard.press("Tab");
  seen.drawnAboveZero = await drawn("above-zero");
  seen.numberOfHeight = await page.locator('#choices input[type=number]').first().inputValue();
  await page.locator('#choices input[type=range]').first().focus();
  for (let i = 0; i < 4; i++) await page.keyboard.press("PageUp");
  seen.sliderOfHeight = await page.locator('#choices input[type=range]').first().getAttribute("aria-valuetext");
  await page.locator("#choices button", { hasText: "All of Z" }).click();
  seen.drawnAtAllHeightsAgain = await drawn("all-heights-again");

  // Operations: one is hidden, none is shown, all are.
  await page.locator("#canvas").focus();
  await page.keyboard.press("1");
  await openGroup("Operations");
  seen.operations = await page.locator("#choices .rows label").allInnerTexts();
  seen.drawnWithAll = await drawn("with-all");
  await page.locator("#choices .rows input").first().uncheck();
  seen.drawnWithoutOne = await drawn("without-one");
  await page.locator("#choices button", { hasText: "None" }).click();
  seen.drawnWithNone = await drawn("with-none");
  await page.locator("#choices button", { hasText: /^All$/ }).click();
  seen.drawnWithAllAgain = await drawn("with-all-again");

  // A measure with the keyboard alone: from the end of one line to the end of the next, and a centre.
  await page.locator("#canvas").focus();
  await page.keyboard.press("m");
  seen.measureBegins = await page.locator("#choices button", { hasText: "Measure" }).getAttribute("aria-pressed");
  await chooseLine(8);
  await page.locator("#canvas").focus();
  await page.keyboard.press("Enter");
  await chooseLine(9);
  await page.locator("#canvas").focus();
  await page.keyboard.press("Enter");
  seen.measured = (await text("#choices .result")).split("\n").map((line) => line.trim()).filter(Boolean);
  await picture("measured");
  await chooseLine(20);
  await page.locator("#choices button", { hasText: "Centre" }).click();
  seen.centre = (await text("#choices .result")).split("\n").map((line) => line.trim()).filter(Boolean);
  await chooseLine(8);
  await page.locator("#choices button", { hasText: "Centre" }).click();
  seen.noCentre = await text("#choices .measured p");
  await page.keyboard.press("Escape");
  seen.measureEnds = await page.locator("#choices button", { hasText: "Measure" }).getAttribute("aria-pressed");
  seen.nothingMeasured = await page.locator("#choices .result dt").count();

  // With the pointer: a click near the end of a move takes the end.
  await page.keyboard.press("Escape");
  await page.locator("#canvas").focus();
  await page.keyboard.press("1");
  await page.keyboard.press("m");
  const box = await page.locator("#canvas").boundingBox();
  seen.clicked = null;
  for (let y = box.y + box.height - 10; y > box.y + box.height / 2 && !seen.clicked; y -= 4) {
    for (let x = box.x + box.width - 30; x > box.x + box.width / 2 && !seen.clicked; x -= 24) {
      await page.mouse.click(x, y);
      const words = await page.locator("#choices .result").innerText();
      if (words.includes("end")) seen.clicked = words.split("\n").map((line) => line.trim()).filter(Boolean);
    }
  }
  await page.keyboard.press("Escape");

  // What is chosen fills the view.
  await page.locator("#canvas").focus();
  await page.keyboard.press("4");
  await chooseLine(27);
  const black = (counts) => pixels(counts, (r, g, b) => r + g + b < 12);
  const before = black(await colors("chosen"));
  await page.locator("#canvas").focus();
  await page.keyboard.press("z");
  seen.chosenGrows = [before, black(await colors("zoomed"))];
  await page.keyboard.press("Escape");

  // Pictures to keep: the PNG shows what the view shows, the SVG has its lines and words, and no words cover each other.
  await page.locator("#canvas").focus();
  await page.keyboard.press("4");
  await rest();
  const png = await saved("PNG");
  seen.png = { name: png.name, start: [...fs.readFileSync(png.to).subarray(0, 8)] };
  const inView = await colors("as-png");
  const inPng = await page.evaluate(async (png) => {
    const image = new Image(), paper = document.createElement("canvas").getContext("2d");
    image.src = `data:image/png;base64,${png}`;
    await image.decode();
    [paper.canvas.width, paper.canvas.height] = [image.width, image.height];
    paper.drawImage(image, 0, 0);
    const counts = new Map(), { data } = paper.getImageData(0, 0, image.width, image.height);
    for (let i = 0; i < data.length; i += 4) {
      const key = `${data[i]},${data[i + 1]},${data[i + 2]}`;
      counts.set(key, (counts.get(key) ?? 0) + 1);
    }
    return [...counts].sort((a, b) => b[1] - a[1]);
  }, fs.readFileSync(png.to).toString("base64"));
  seen.inkOfView = pixels(inView, (...color) => !isGround(...color));
  seen.inkOfPng = pixels(inPng, (...color) => !isGround(...color));
  seen.svgs = [];
  for (const key of ["4", "1", "2", "3"]) {
    await page.locator("#canvas").focus();
    await page.keyboard.press(key);
    await rest();
    const svg = await saved("SVG"), content = fs.readFileSync(svg.to, "utf8");
    seen.svgs.push({ name: svg.name, dashed: content.includes("stroke-dasharray=\"5 4\""), ...await coveredWords(content) });
  }

  // Themes, names, the ring of the focus.
  await page.locator("#theme").click();
  await page.locator("#theme").click();
  const contrast = await colors("contrast");
  seen.contrast = [await page.evaluate(() => document.documentElement.dataset.theme), contrast[0][0]];
  await picture("contrast");
  seen.nameless = await page.evaluate(() => [...document.querySelectorAll("button, input, select, summary, canvas[tabindex], [role=listbox]")]
    .filter((element) => !(element.ariaLabel || element.getAttribute("aria-label") || element.closest("label")?.textContent.trim() || element.textContent.trim()))
    .map((element) => element.outerHTML.slice(0, 80)));
  seen.ringless = [];
  await page.locator("#panel").focus();
  for (let i = 0; i < 25; i++) {
    await page.keyboard.press("Tab");
    const bare = await page.evaluate(() => { const style = getComputedStyle(document.activeElement); return style.outlineStyle === "none" ? document.activeElement.outerHTML.slice(0, 60) : null; });
    if (bare) seen.ringless.push(bare);
  }

  // The theme is that of the system until somebody chooses one.
  const fresh = await browser.newPage();
  await fresh.goto(page.url());
  seen.themesOfSystem = [];
  for (const media of [{ contrast: "more", colorScheme: "light" }, { contrast: "more", colorScheme: "dark" }, { contrast: null, forcedColors: "active", colorScheme: "light" }, { forcedColors: null, colorScheme: "dark" }, { colorScheme: "light" }]) {
    await fresh.emulateMedia(media);
    // Queries are answered before a frame is drawn.
    seen.themesOfSystem.push(await fresh.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(document.documentElement.dataset.theme))))));
  }
  await fresh.close();

  // People who want little motion see steps.
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.locator("#speed").selectOption({ index: 1 });
  await page.locator("#canvas").focus();
  await page.keyboard.press("Home");
  seen.steps = await page.evaluate(async () => {
    const values = new Set();
    document.getElementById("play").click();
    for (const end = performance.now() + 1400; performance.now() < end;) {
      await new Promise(requestAnimationFrame);
      values.add(document.getElementById("time").value);
    }
    document.getElementById("play").click();
    return values.size;
  });

  // A telephone: nothing covers anything, and the options open over the path.
  await page.setViewportSize({ width: 320, height: 640 });
  await rest();
  seen.closedByItself = !await page.locator("#choices").isVisible();
  seen.overlapsWhenNarrow = await overlaps("header button, header h1, .views button, .transport button, .transport input, .transport select, #clock, #readout, .source, #findings");
  seen.scrollsSideways = await page.evaluate(() => document.documentElement.scrollWidth > innerWidth);
  await picture("narrow-320");
  await page.locator("#panel").click();
  await rest();
  seen.optionsOfNarrow = await page.locator("#choices").evaluate((choices) => { const { left, right } = choices.getBoundingClientRect(); return left >= 0 && right <= innerWidth && choices.scrollWidth <= choices.clientWidth; });
  seen.overlapsInOptions = await overlaps("#choices button, #choices input, #choices select, #choices summary");
  await picture("narrow-320-options");
} finally {
  await browser.close();
}
console.log(JSON.stringify(seen));
