// Uses the viewer without a page around it, as an editor does: other data, no data, an end; prints what it saw as JSON.
//
//   node viewer.mjs TOOLS CHROMIUM PAGE.html FOLDER
//
// As look.mjs; of the page only its data are used, and the viewer's modules come from the sources.

import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const [tools, executablePath, file, pictures] = process.argv.slice(2);
const sources = path.resolve(import.meta.dirname, "../../../gcheck-toolpath/src/plot");
const { chromium } = createRequire(path.resolve(tools, "package.json"))("playwright-core");
const browser = await chromium.launch({ executablePath, headless: true, args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"] });
const seen = { problems: [] };
try {
  const page = await browser.newPage({ viewport: { width: 800, height: 600 } });
  page.on("pageerror", (error) => seen.problems.push(error.message));
  const html = "<!DOCTYPE html><body style='margin:0'><div id='stage' style='position:relative;width:800px;height:600px'><canvas id='canvas' style='width:100%;height:100%'></canvas></div><div id='choices'></div>";
  await page.route("**/*", (route) => {
    const name = new URL(route.request().url()).pathname.slice(1);
    if (!name) return route.fulfill({ contentType: "text/html", body: html });
    if (!name.endsWith(".js")) return route.fulfill({ status: 404 });
    return route.fulfill({ contentType: "text/javascript", body: fs.readFileSync(path.join(sources, name)) });
  });
  await page.goto("http://viewer.test/");
  const data = JSON.parse(fs.readFileSync(file, "utf8").split('id="data">')[1].split("</script>")[0]).toolpath;
  Object.assign(seen, await page.evaluate(async (data) => {
    const { createViewer } = await import("/viewer.js");
    const { createPanel } = await import("/panel.js");
    const seen = {}, canvas = document.getElementById("canvas");
    const rest = async (frames = 3) => { for (let i = 0; i < frames; i++) await new Promise(requestAnimationFrame); };
    const refusal = (change) => { try { createViewer(canvas, { ...data, ...change }).destroy(); return "drawn"; } catch (error) { return error.message; } };
    /** Data of a path through some points, cut in a second each. */
    const through = (points, more = {}) => ({
      version: 2, units: "mm", lathe: false, diameter: false, tools: [{ number: 1, name: null, color: "#0072b2" }], files: [""], count: points.length,
      points: new Float32Array(points.flat()), seconds: new Float32Array(points.map((point, i) => i)), lines: new Uint32Array(points.map((point, i) => i + 1)),
      kinds: new Uint8Array(points.map((point, i) => i ? 2 : 0)), toolOf: new Uint8Array(points.length), fileOf: null, driveOf: null, drives: [], rotary: null,
      thinned: false, cut: [[0, 0, 0], [10, 10, 0]], all: [[0, 0, 0], [10, 10, 0]], ...more,
    });
    /** Pixels of the path's canvas that are not ground. */
    const ink = async () => {
      await rest();
      const paper = document.createElement("canvas").getContext("2d");
      [paper.canvas.width, paper.canvas.height] = [canvas.width, canvas.height];
      paper.drawImage(canvas, 0, 0);
      const { data: bytes } = paper.getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 0; i < bytes.length; i += 4) if (Math.max(Math.abs(bytes[i] - bytes[0]), Math.abs(bytes[i + 1] - bytes[1]), Math.abs(bytes[i + 2] - bytes[2])) > 12) count++;
      return count;
    };

    // Data that are cut short, and a run of no points.
    seen.short = refusal({ points: data.points.slice(0, 8) });
    seen.endless = refusal({ kinds: "AAAAAAAA" });

    // Calls of WebGL and frames are counted.
    const gl = canvas.getContext("webgl2"), alive = new Set();
    const { createTexture, deleteTexture, texImage2D } = WebGL2RenderingContext.prototype;
    let uploads = 0;
    gl.createTexture = () => { const made = createTexture.call(gl); alive.add(made); return made; };
    gl.deleteTexture = (texture) => { alive.delete(texture); deleteTexture.call(gl, texture); };
    gl.texImage2D = (...all) => { uploads++; texImage2D.apply(gl, all); };

    // The end, while the run is played and the view turns.
    for (let i = 0; i < 3; i++) {
      const viewer = createViewer(canvas, data);
      viewer.play();
      await rest();
      canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: 100, cancelable: true }));
      viewer.destroy();
    }
    seen.texturesAfterwards = alive.size;
    seen.inkAfterwards = await ink();
    await new Promise((done) => setTimeout(done, 250));
    seen.inkLater = await ink();
    seen.overlaysAfterwards = document.querySelectorAll(".toolpath-overlay").length;

    // The panel: all operations are hidden at once, and words for screen readers come when there is news.
    let panel = null, hovers = 0;
    const viewer = createViewer(canvas, data, { onMeasure: (state) => { hovers++; panel?.measured(state); }, onLook: () => panel?.look() });
    panel = createPanel(document.getElementById("choices"), viewer, { save() {}, hasFormer: true });
    const button = (words) => [...document.querySelectorAll("#choices button")].find((one) => one.textContent === words);
    seen.operations = document.querySelectorAll("#choices .rows input").length;
    uploads = 0;
    button("None").click();
    seen.uploadsOfNone = uploads;
    button("All").click();
    viewer.measure.start();
    let news = 0;
    hovers = 0;
    const watcher = new MutationObserver(() => news++);
    watcher.observe(document.querySelector("#choices .measured"), { childList: true, subtree: true, characterData: true });
    for (let x = 300; x < 500; x += 20) {
      canvas.dispatchEvent(new PointerEvent("pointermove", { clientX: x, clientY: 300, bubbles: true }));
      await rest(2);
    }
    Object.assign(seen, { hovers, newsOfHover: news });
    watcher.disconnect();
    viewer.measure.stop();

    // A block is half typed and the program makes no move: view, colours and filters are there for the next one.
    viewer.setView("top");
    viewer.setColoring("feed");
    document.querySelector("#choices .tools input").click();
    const withOneTool = await ink();
    viewer.clear();
    seen.inkOfNothing = await ink();
    seen.piecesOfNothing = viewer.pieces();
    viewer.setData(data, { keep: true, former: true });
    panel.refresh({ keep: true });
    seen.afterNothing = { coloring: viewer.coloring(), isTicked: document.querySelector("#choices .tools input").checked, isAsBefore: await ink() === withOneTool };

    // A picture without a graphics card.
    const loss = gl.getExtension("WEBGL_lose_context");
    loss.loseContext();
    await rest();
    button("PNG").click();
    await rest();
    seen.lost = document.querySelector("#choices details:last-child p").textContent;
    loss.restoreContext();
    await new Promise((done) => canvas.addEventListener("webglcontextrestored", done));
    seen.inkIsBack = await ink() === withOneTool;

    // An edit: the former path stays where it was another one.
    viewer.setView("top");
    viewer.setData(through([[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]]), { keep: false });
    panel.refresh({ keep: false });
    viewer.setView("top");
    viewer.setData(through([[0, 0, 0], [10, 0, 0], [5, 5, 0], [0, 10, 0]]), { keep: true, former: true });
    const both = await ink();
    const inSvg = () => viewer.svg("an edit").includes("#9c8abb");
    seen.former = { isInSvg: inSvg() };
    const switches = [...document.querySelectorAll("#choices .tools label")];
    seen.switches = switches.map((label) => label.textContent);
    switches.at(-1).querySelector("input").click();
    const newOnly = await ink();
    seen.former.isInSvgWithoutSwitch = inSvg();
    switches.at(-1).querySelector("input").click();
    viewer.setData(through([[0, 0, 0], [10, 0, 0], [5, 5, 0], [0, 10, 0]]), { keep: true, former: true });
    Object.assign(seen.former, { isSeen: both > newOnly + 100, staysWithoutNews: await ink() === both });
    viewer.setData(through([[0, 0, 0], [10, 0, 0], [5, 5, 0], [0, 10, 0]]), { keep: false });
    viewer.setView("top");
    seen.former.isInSvgOfAnotherProgram = inSvg();

    // What is around the path: the tool in its size, zeros, the travel, which the path crosses in X.
    const around = {
      tools: [{ number: 1, name: null, color: "#0072b2", diameter: 4 }], travel: [[-2, 8], [-5, 15]],
      zeros: [{ name: "G54", at: [0, 0, 0] }, { name: "G55", at: [6, 4, 0] }],
    };
    const square = [[0, 0, 0], [10, 0, 0], [10, 10, 0], [0, 10, 0]];
    const words = () => [...viewer.svg("around").matchAll(/<text[^>]*>([^<]*)</g)].map(([, text]) => text);
    const rings = () => [...viewer.svg("around").matchAll(/<path d="([^"]*)"/g)].filter(([, way]) => way.split("L").length > 30).length;
    viewer.setData(through(square, around), { keep: false });
    viewer.setView("iso");
    seen.around = { words: words().filter((text) => /^G5|travel/.test(text)), before: rings() };
    viewer.goToTime(1.5);
    seen.around.rings = rings();
    seen.around.ink = await ink() > 0;
    viewer.setData(through(square, { ...around, lathe: true }), { keep: true });
    viewer.goToTime(1.5);
    seen.around.ringsOnLathe = rings();
    viewer.setData(through(square, { ...around, rotary: { axes: "B", values: new Float32Array([0, 30, 30, 30]) } }), { keep: true });
    viewer.goToTime(1.5);
    seen.around.ringsOfTilted = rings();
    viewer.setData(through(square), { keep: false });

    // The axes turn while the tool moves.
    const values = new Float32Array([0, 90]);
    viewer.setData(through([[0, 0, 0], [10, 0, 0]], { rotary: { axes: "A", values } }));
    viewer.goToTime(0.25);
    seen.turning = [viewer.place().point[0], viewer.place().angles[0].degrees];
    viewer.goToTime(1);
    seen.turned = viewer.place().angles[0].degrees;
    viewer.setData(through([[0, 0, 0], [10, 0, 0]], { rotary: { axes: "A", values: new Float32Array([NaN, 90]) } }));
    viewer.goToTime(0.25);
    seen.turningFromUnknown = viewer.place().angles[0].degrees;
    return seen;
  }, data));
  await page.screenshot({ path: path.join(pictures, "viewer.png") });
} finally {
  await browser.close();
}
console.log(JSON.stringify(seen));
