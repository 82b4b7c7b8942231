// The page around the viewer: program text, findings, legend, play.
//
// Knows: the elements of page.html, the page's data. Must not know: how the path is drawn (`createViewer` stands before this
// in the same script). Every text of the program goes into the page as text, never as markup.

const LINE = 18;
const page = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const make = (name, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
};

const sources = page.sources.map(({ name, text }) => {
  const lines = text === null ? null : text.split(/\r\n|\r|\n/);
  if (lines?.at(-1) === "" && lines.length > 1) lines.pop();
  return { name, lines };
});
const units = page.toolpath.units;
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
let shown = 0;            // the file in the list
let chosen = null;        // { file, line }
let now = null;           // where the tool is: { file, line }

// On most lathes there is no Y.
const AXES = [0, 1, 2].filter((axis) => axis !== 1 || !page.toolpath.lathe || page.toolpath.all?.some((end) => end[1] !== 0));
const coordinate = (value, axis) => lengthText(axis === 0 && page.toolpath.diameter ? 2 * value : value, units);
const timeText = (seconds) => {
  const whole = Math.round(seconds), pad = (n) => String(n).padStart(2, "0");
  const [hours, minutes] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60];
  return hours ? `${hours}:${pad(minutes)}:${pad(whole % 60)}` : `${minutes}:${pad(whole % 60)}`;
};

byId("title").textContent = page.title;
byId("summary").textContent = [
  page.control,
  `${page.moves.toLocaleString("en")} moves`,
  timeText(page.seconds),
  ...(page.toolpath.cut ? AXES.map((axis) => `${"XYZ"[axis]} ${coordinate(page.toolpath.cut[0][axis], axis)} to ${coordinate(page.toolpath.cut[1][axis], axis)}`) : []),
  units,
].join(" · ");
if (page.notes.length) {
  byId("notes").hidden = false;
  byId("notes").append(...page.notes.map((note) => make("li", { textContent: note })));
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

const KINDS = ["", "rapid", "feed", "arc", "probe", "with the spindle"];

function say(place) {
  const tool = place.tool?.number == null ? "" : ` · T${place.tool.number}`;
  byId("readout").replaceChildren(
    make("b", { textContent: `line ${place.line}` }),
    ` ${KINDS[place.kind]} to `,
    make("b", { textContent: AXES.map((axis) => `${"XYZ"[axis]}${coordinate(place.point[axis], axis)}`).join(" ") }),
    `${tool} · ${timeText(place.seconds)}`,
  );
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
    byId("clock").textContent = `${timeText(place.seconds)} / ${timeText(viewer.duration())}`;
    say(place);
    now = { file: place.file, line: place.line };
    showFile(place.file);
    reveal(place.line);
    drawLines();
  },
  onPlay(isPlaying) { byId("play").textContent = isPlaying ? "Pause" : "Play"; },
};

let dark = matchMedia("(prefers-color-scheme: dark)").matches;
function setTheme() {
  document.documentElement.dataset.theme = dark ? "dark" : "light";
  viewer?.setTheme(dark ? THEMES.dark : THEMES.light);
}
setTheme();
try {
  viewer = createViewer(byId("canvas"), page.toolpath, callbacks);
  page.toolpath = { ...page.toolpath, points: null, seconds: null, lines: null, kinds: null, toolOf: null, fileOf: null };
  setTheme();
  viewer.setMarks(page.findings);
  if (page.toolpath.count === 0) byId("stage").append(make("div", { className: "message", textContent: page.notes[0] ?? "" }));
} catch (error) {
  byId("stage").append(make("div", { className: "message", textContent: `The path cannot be drawn: ${error.message}.` }));
}

const VIEW_NAMES = page.toolpath.lathe ? [["lathe", "ZX"], ["front", "XZ"], ["top", "XY"], ["iso", "3D"]] : [["top", "Top"], ["front", "Front"], ["side", "Side"], ["iso", "3D"]];
byId("views").append(
  ...VIEW_NAMES.map(([name, words]) => make("button", { textContent: words, onclick: () => viewer?.setView(name) })),
  make("button", { textContent: "Fit", title: "Fit (F)", onclick: () => viewer?.fit() }),
);
const legend = byId("legend");
const entry = (words, color, className, change) => {
  const box = make("input", { type: "checkbox", checked: true, onchange: (event) => change(event.target.checked) });
  const bar = make("i", { className });
  bar.style.borderColor = color;
  legend.append(make("label", {}, box, bar, make("span", { textContent: words })));
  return box;
};
page.toolpath.tools.forEach((tool, i) => {
  const number = tool.number === null ? "unknown tool" : tool.number === 0 ? "no tool" : `T${tool.number}`;
  entry(tool.name ? `${number} ${tool.name}` : number, tool.color, "", (yes) => viewer?.showTool(i, yes));
});
const rapids = entry("rapid moves", "#7d8894", "dashed", (yes) => viewer?.showRapids(yes));

// --- Play

const duration = viewer?.duration() ?? 0;
slider.max = duration;
slider.value = duration;
byId("clock").textContent = `${timeText(duration)} / ${timeText(duration)}`;
const speeds = [0.5, 1, 2, 5, 10, 20, 50, 100, 500, 1000];
// As fast as shows the whole in about half a minute.
const usual = speeds.find((speed) => duration / speed <= 40) ?? speeds.at(-1);
byId("speed").append(...speeds.map((speed) => make("option", { value: speed, textContent: `${speed}×`, selected: speed === usual })));
viewer?.setSpeed(usual);
byId("speed").addEventListener("change", (event) => viewer?.setSpeed(Number(event.target.value)));
slider.addEventListener("input", () => { viewer?.pause(); viewer?.goToTime(Number(slider.value)); });
const toggle = () => viewer && (viewer.isPlaying() ? viewer.pause() : viewer.play());
const step = (by) => { viewer?.pause(); viewer?.step(by); };
byId("play").addEventListener("click", toggle);
byId("back").addEventListener("click", () => step(-1));
byId("forth").addEventListener("click", () => step(1));

// --- Keys and theme

byId("theme").addEventListener("click", () => { dark = !dark; setTheme(); });
byId("help").addEventListener("click", () => byId("keys").showModal());
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || byId("keys").open) return;
  const isField = event.target.matches("select, input");
  const isButton = event.target.matches("button, input[type=checkbox]");
  const keys = {
    ",": () => step(-1), ".": () => step(1), n: () => nextFinding(1), p: () => nextFinding(-1),
    f: () => viewer?.fit(), r: () => rapids.click(), "?": () => byId("keys").showModal(), Escape: chooseNothing,
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
