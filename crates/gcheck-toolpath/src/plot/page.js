// The page around the viewer: program text, findings, play, the panel.
//
// Knows: the elements of page.html, the page's data. Must not know: how the path is drawn. Every text of the program goes into
// the page as text, never as markup.

import { THEMES, createViewer, placeText, speedsFor } from "./viewer.js";
import { createPanel, make } from "./panel.js";
import { axesOf, coordinateText, timeText } from "./viewer/words.js";

const LINE = 18;
const page = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

const sources = page.sources.map(({ name, text }) => {
  const lines = text === null ? null : text.split(/\r\n|\r|\n/);
  if (lines?.at(-1) === "" && lines.length > 1) lines.pop();
  return { name, lines };
});
const SEVERITIES = ["hint", "info", "warning", "error"];
// By file and line: the findings there, the worst one first.
const found = new Map();
for (const finding of page.findings) {
  const key = `${finding.file}:${finding.line}`;
  if (!found.has(key)) found.set(key, []);
  found.get(key).push(finding);
}
for (const list of found.values()) list.sort((a, b) => SEVERITIES.indexOf(b.severity) - SEVERITIES.indexOf(a.severity));

let viewer = null;
let panel = null;
let shown = 0;            // the file in the list
let chosen = null;        // { file, line }
let now = null;           // where the tool is: { file, line }

const coordinate = (value, axis) => coordinateText(page.toolpath, value, axis);

byId("title").textContent = page.title;
const facts = [
  page.control,
  `${page.moves.toLocaleString("en")} moves`,
  timeText(page.seconds),
  ...(page.toolpath.cut ? axesOf(page.toolpath).map((axis) => `${axis === 0 && page.toolpath.diameter ? "X Ø" : "XYZ"[axis]} ${coordinate(page.toolpath.cut[0][axis], axis)} to ${coordinate(page.toolpath.cut[1][axis], axis)}`) : []),
  page.toolpath.units,
];
byId("summary").append(...facts.flatMap((words, i) => [i ? " · " : "", make("span", { textContent: words })]));
if (page.notes.length) {
  byId("notes").hidden = false;
  byId("notes").append(...page.notes.map(({ words, file, line }) => make("li", {}, file === null ? words : make("button", { textContent: words, onclick: () => choose(file, line) }))));
}

// --- The program's text: only the lines that are seen are elements.

const list = byId("source");
const room = make("div");
list.append(room);
let drawn = 0;

function drawLines() {
  if (!drawn) drawn = requestAnimationFrame(() => { drawn = 0; drawLinesNow(); });
}

function drawLinesNow() {
  const lines = sources[shown]?.lines;
  room.replaceChildren();
  if (!lines) {
    room.style.height = "";
    room.append(make("p", { textContent: sources.length ? "The text of this file is too long to be shown here." : "", style: "padding: 0 12px" }));
    return;
  }
  room.style.height = `${lines.length * LINE}px`;
  const first = Math.max(Math.floor(list.scrollTop / LINE) - 4, 0);
  const last = Math.min(first + Math.ceil(list.clientHeight / LINE) + 8, lines.length);
  const width = `${Math.max(String(lines.length).length, 3) + 5}ch`;
  for (let i = first; i < last; i++) {
    const here = found.get(`${shown}:${i + 1}`);
    const row = make("div", { className: "line", id: `line-${i + 1}` },
      make("span", { className: "number", textContent: i + 1 }), make("span", { className: "code", textContent: lines[i].slice(0, 2000) || " " }));
    row.style.top = `${i * LINE}px`;
    row.firstChild.style.minWidth = width;
    row.setAttribute("role", "option");
    row.dataset.line = i + 1;
    const isChosen = chosen?.file === shown && chosen.line === i + 1;
    row.setAttribute("aria-selected", isChosen);
    if (isChosen) row.classList.add("chosen");
    if (now?.file === shown && now.line === i + 1) row.classList.add("now");
    if (here) {
      row.classList.add("marked");
      row.style.setProperty("--mark", `var(--${here[0].severity})`);
      row.title = here.map((finding) => `${finding.severity}: ${finding.message} [${finding.rule}]`).join("\n");
    }
    room.append(row);
  }
}

function showFile(file) {
  if (file === shown) return;
  shown = file;
  byId("files").value = file;
  list.scrollTop = 0;
  drawLines();
}

/** Scrolls a line into sight, if it is not. */
function reveal(line) {
  const top = (line - 1) * LINE;
  if (top < list.scrollTop + LINE || top > list.scrollTop + list.clientHeight - 2 * LINE) {
    list.scrollTop = Math.max(top - list.clientHeight / 3, 0);
  }
}

/** Chooses a line: in the list, and its moves in the view. */
function choose(file, line, { moves = true } = {}) {
  chosen = { file, line };
  showFile(file);
  reveal(line);
  drawLines();
  list.setAttribute("aria-activedescendant", `line-${line}`);
  const place = moves ? viewer?.select(file, line) : null;
  for (const button of byId("findings").querySelectorAll("button")) {
    const finding = page.findings[button.dataset.index];
    button.classList.toggle("chosen", finding.file === file && finding.line === line);
  }
  if (place) say(place);
  else byId("readout").replaceChildren(make("b", { textContent: `line ${line}` }), " moves nothing");
}

function chooseNothing() {
  chosen = null;
  viewer?.select(null);
  viewer?.goTo(viewer.pieces());
  drawLines();
}

list.addEventListener("scroll", drawLines);
list.addEventListener("click", (event) => {
  const row = event.target.closest(".line");
  if (row) choose(shown, Number(row.dataset.line));
});
list.addEventListener("keydown", (event) => {
  const count = sources[shown]?.lines?.length ?? 0, here = chosen?.file === shown ? chosen.line : 0;
  const rows = Math.max(Math.floor(list.clientHeight / LINE) - 1, 1);
  const to = { ArrowDown: here + 1, ArrowUp: here - 1, PageDown: here + rows, PageUp: here - rows, Home: 1, End: count }[event.key];
  if (to === undefined || !count || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  event.stopPropagation();
  choose(shown, Math.min(Math.max(to, 1), count));
});
new ResizeObserver(drawLines).observe(list);
if (sources.length > 1) {
  byId("files").hidden = false;
  byId("files").append(...sources.map((source, i) => make("option", { value: i, textContent: source.name })));
  byId("files").addEventListener("change", (event) => showFile(Number(event.target.value)));
}

// --- Findings

if (page.findings.length) {
  const counts = [...SEVERITIES].reverse().map((name) => [name, page.findings.filter((finding) => finding.severity === name).length]);
  const words = counts.filter(([, count]) => count).map(([name, count]) => `${count} ${name}${count > 1 && name !== "info" ? "s" : ""}`);
  const entries = page.findings.slice(0, 1000).map((finding, i) => {
    const button = make("button", {}, make("span", { textContent: `${finding.message} ` }),
      make("small", { textContent: `${sources.length > 1 ? `${sources[finding.file].name}, ` : ""}line ${finding.line} · ${finding.rule}` }));
    button.dataset.index = i;
    button.style.setProperty("--mark", `var(--${finding.severity})`);
    button.addEventListener("click", () => choose(finding.file, finding.line));
    return make("li", {}, button);
  });
  byId("findings").hidden = false;
  byId("findings").append(make("h2", { textContent: words.join(", ") }), make("ol", {}, ...entries));
}

function nextFinding(by) {
  if (!page.findings.length) return;
  const at = page.findings.findIndex((finding) => finding.file === chosen?.file && finding.line === chosen.line);
  const next = page.findings[(Math.max(at, by < 0 ? 0 : -1) + by + page.findings.length) % page.findings.length];
  choose(next.file, next.line);
}

// --- The view

function say(place) {
  const strong = ["line", "point"];
  const parts = placeText(viewer.data(), place, viewer.duration());
  byId("readout").replaceChildren(...parts.flatMap(({ is, words }, i) => [i ? " · " : "", strong.includes(is) ? make("b", { textContent: words }) : words]));
}

const slider = byId("time");
const callbacks = {
  onPick(place) {
    if (!place) { chosen = null; viewer.select(null); drawLines(); return; }
    choose(place.file, place.line);
    say(place);
  },
  onProgress(place) {
    slider.value = place.seconds;
    showClock(place.seconds);
    say(place);
    now = { file: place.file, line: place.line };
    showFile(place.file);
    reveal(place.line);
    drawLines();
  },
  onPlay(isPlaying) { byId("play").textContent = isPlaying ? "Pause" : "Play"; },
  onMeasure(state) { panel?.measured(state); },
  onLook() { panel?.look(); },
};

function showClock(seconds) {
  const words = `${timeText(seconds)} / ${timeText(viewer?.duration() ?? 0)}`;
  byId("clock").textContent = words;
  slider.setAttribute("aria-valuetext", words);
}

/** Gives a picture to the browser's downloads. */
function save(name, blob) {
  const link = make("a", { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

const LOOKS = { light: "light", dark: "dark", contrast: "high contrast, dark", contrastLight: "high contrast, light" };
const [strong, forced, dark] = ["(prefers-contrast: more)", "(forced-colors: active)", "(prefers-color-scheme: dark)"].map((what) => matchMedia(what));
/** What the system asks for. */
const lookOfSystem = () => strong.matches || forced.matches ? (dark.matches ? "contrast" : "contrastLight") : dark.matches ? "dark" : "light";
let look = lookOfSystem(), isChosenLook = false;
for (const query of [strong, forced, dark]) query.addEventListener("change", () => { if (!isChosenLook) { look = lookOfSystem(); setTheme(); } });
function setTheme() {
  document.documentElement.dataset.theme = look;
  byId("theme").title = `Theme: ${LOOKS[look]}`;
  viewer?.setTheme(THEMES[look]);
}
setTheme();
try {
  viewer = createViewer(byId("canvas"), page.toolpath, callbacks);
  setTheme();
  viewer.setMarks(page.findings);
  const turned = () => {
    viewer.setMarks(page.findings);
    if (chosen) choose(chosen.file, chosen.line);
  };
  panel = createPanel(byId("choices"), viewer, { save, turned });
  if (page.toolpath.count === 0) byId("stage").append(make("div", { className: "message", textContent: page.notes.map(({ words }) => words).join("\n") }));
} catch (error) {
  byId("stage").append(make("div", { className: "message", textContent: `The path cannot be drawn: ${error.message}.` }));
}

const VIEW_NAMES = page.toolpath.lathe ? [["lathe", "ZX"], ["front", "XZ"], ["top", "XY"], ["iso", "3D"]] : [["top", "Top"], ["front", "Front"], ["side", "Side"], ["iso", "3D"]];
byId("views").append(
  ...VIEW_NAMES.map(([name, words]) => make("button", { textContent: words, onclick: () => viewer?.setView(name) })),
  make("button", { textContent: "Fit", title: "Fit all that is shown (F)", onclick: () => viewer?.fit() }),
  make("button", { textContent: "Zoom to chosen", title: "Fit the moves that are chosen (Z)", onclick: () => viewer?.fitSelection() }),
);
const panelButton = byId("panel");
function showPanel(yes) {
  byId("choices").hidden = !yes;
  panelButton.setAttribute("aria-expanded", yes);
}
panelButton.addEventListener("click", () => showPanel(byId("choices").hidden));
// Where there is room for the path beside it.
const wide = matchMedia("(min-width: 1001px)");
wide.addEventListener("change", () => showPanel(wide.matches));
showPanel(wide.matches);

// --- Play

const duration = viewer?.duration() ?? 0;
slider.max = duration;
slider.value = duration;
showClock(duration);
const speeds = speedsFor(duration);
byId("speed").append(...speeds.map(({ factor, words, usual }) => make("option", { value: factor, textContent: words, selected: usual })));
viewer?.setSpeed(Number(byId("speed").value));
byId("speed").addEventListener("change", (event) => viewer?.setSpeed(Number(event.target.value)));
slider.addEventListener("input", () => { viewer?.pause(); viewer?.goToTime(Number(slider.value)); });
const toggle = () => viewer && (viewer.isPlaying() ? viewer.pause() : viewer.play());
const step = (by) => { viewer?.pause(); viewer?.step(by); };
byId("play").addEventListener("click", toggle);
byId("back").addEventListener("click", () => step(-1));
byId("forth").addEventListener("click", () => step(1));

// --- Keys and theme

byId("theme").addEventListener("click", () => {
  const looks = Object.keys(LOOKS);
  look = looks[(looks.indexOf(look) + 1) % looks.length];
  isChosenLook = true;
  setTheme();
});
byId("help").addEventListener("click", () => byId("keys").showModal());
const leave = () => (viewer?.measure.state().isOn ? viewer.measure.stop() : chooseNothing());
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || byId("keys").open) return;
  const isField = event.target.matches("select, input:not([type=checkbox])");
  const isButton = event.target.matches("button, summary, input[type=checkbox]");
  // A number is typed, and a list is searched by letters.
  if (isField && event.key !== "Escape" && event.target.type !== "range") return;
  const keys = {
    ",": () => step(-1), ".": () => step(1), n: () => nextFinding(1), p: () => nextFinding(-1),
    f: () => viewer?.fit(), z: () => viewer?.fitSelection(), m: () => viewer?.measure.toggle(), r: () => panel?.toggleRapids(),
    o: () => showPanel(byId("choices").hidden), "?": () => byId("keys").showModal(), Escape: leave,
    t: () => { viewer?.pause(); viewer?.stepTool(event.shiftKey ? -1 : 1); },
    s: () => { viewer?.pause(); viewer?.stepOperation(event.shiftKey ? -1 : 1); },
    1: () => viewer?.setView("top"), 2: () => viewer?.setView("front"), 3: () => viewer?.setView("side"),
    4: () => viewer?.setView("iso"), 5: () => viewer?.setView("lathe"),
    ...(isButton ? {} : { " ": toggle }),
    ...(isField ? {} : { Home: () => viewer?.goTo(0), End: () => viewer?.goTo(viewer.pieces()) }),
  };
  const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!action) return;
  event.preventDefault();
  action();
});
drawLines();

// --- The address: `#line=12` chooses that line of the program, for links and for editors that follow their cursor.

function followAddress() {
  const line = Number(/^#line=(\d{1,9})$/.exec(location.hash)?.[1] ?? 0);
  if (line > 0 && line <= (sources[0]?.lines?.length ?? line)) choose(0, line);
}
addEventListener("hashchange", followAddress);
followAddress();
