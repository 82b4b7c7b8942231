// The page of the preview: the viewer, and its controls.

import { createPanel, type Panel } from "gcheck-panel";
import { createViewer, type Drawing, lengthText, type Place, placeText, speedsFor, THEMES, timeText, type Viewer } from "gcheck-viewer";

import type { Alarm, FromPage, Note, ToPage, Toolpath } from "./messages";

declare function acquireVsCodeApi(): { postMessage(message: FromPage): void };

const host = acquireVsCodeApi();

function element<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (found === null) {
    throw new Error(`the page has no #${id}`);
  }
  return found as T;
}

const canvas = element<HTMLCanvasElement>("canvas");
const nothing = element("nothing");
const figures = element("figures");
const alarms = element("alarms");
const notes = element("notes");
const choices = element("choices");
const side = element("side");
const options = element<HTMLButtonElement>("options");
const play = element<HTMLButtonElement>("play");
const time = element<HTMLInputElement>("time");
const speed = element<HTMLSelectElement>("speed");
const view = element<HTMLSelectElement>("view");
const readout = element("readout");

let viewer: Viewer | undefined;
let panel: Panel | undefined;
let drawing: Drawing | undefined;

function theme(): Record<string, string | number> {
  const has = (name: string) => document.body.classList.contains(name);
  const isLight = has("vscode-light") || has("vscode-high-contrast-light");
  const isContrast = has("vscode-high-contrast") || has("vscode-high-contrast-light");
  const own = isContrast ? (isLight ? THEMES.contrastLight : THEMES.contrast) : isLight ? THEMES.light : THEMES.dark;
  const background = getComputedStyle(document.body).getPropertyValue("--vscode-editor-background").trim();
  return /^#[0-9a-f]{6}$/i.test(background) ? { ...own, background } : own;
}

/** The address of the program that was drawn last. */
let shown = "";

function show(uri: string, toolpath: Toolpath): void {
  nothing.textContent = "";
  choices.hidden = false;
  drawing = toolpath.data;
  if (viewer === undefined) {
    viewer = createViewer(canvas, drawing, {
      onPick(place) {
        if (place !== null) {
          host.postMessage({ kind: "line", file: drawing?.files[place.file] ?? "", line: place.line });
        }
      },
      onProgress(place) {
        const duration = viewer?.duration() ?? 0;
        time.value = String(duration > 0 ? Math.round((place.seconds / duration) * 1000) : 1000);
        read(place, duration);
        follow(place);
      },
      onPlay(isPlaying) {
        play.textContent = isPlaying ? "⏸" : "▶";
        play.ariaLabel = isPlaying ? "Pause" : "Play";
      },
      onMeasure(state) {
        panel?.measured(state);
      },
      onLook() {
        panel?.look();
      },
    });
    viewer.setTheme(theme());
    view.value = drawing.lathe ? "lathe" : "iso";
    panel = createPanel(choices, viewer, { save, hasFormer: true, turned: chooseAgain });
  } else {
    // While somebody types the picture is seen from where it was.
    const keep = uri === shown;
    viewer.setData(drawing, { keep, former: keep });
    if (!keep) {
      view.value = drawing.lathe ? "lathe" : "iso";
    }
    panel?.refresh({ keep });
  }
  shown = uri;
  // The tool is at the end of the new path.
  time.value = "1000";
  time.ariaValueText = null;
  readout.textContent = "";
  offerSpeeds(viewer.duration());
  describe(toolpath);
  list(toolpath.alarms);
  host.postMessage({ kind: "drawn", pieces: viewer.pieces(), alarms: alarms.childElementCount });
}

/** The lines that are chosen in the editor. */
let lines: { first: number; last: number } | undefined;

function chooseAgain(): void {
  if (lines !== undefined) {
    viewer?.select(Math.max(drawing?.files.indexOf("") ?? 0, 0), lines.first, lines.last);
  }
}

/** The editor asks where to, and writes the picture. */
async function save(name: string, blob: Blob): Promise<void> {
  host.postMessage({ kind: "save", name, bytes: new Uint8Array(await blob.arrayBuffer()) });
}

let chosenSpeed: string | undefined;

/** Speeds that fit the length of the run; the one that somebody chose stays. */
function offerSpeeds(duration: number): void {
  const speeds = speedsFor(duration);
  speed.replaceChildren(...speeds.map(({ factor, words }) => Object.assign(document.createElement("option"), { value: String(factor), textContent: words })));
  const wanted = speeds.find(({ words }) => words === chosenSpeed) ?? speeds.find(({ usual }) => usual);
  speed.selectedIndex = wanted === undefined ? 0 : speeds.indexOf(wanted);
  viewer?.setSpeed(Number(speed.value));
}

/** Where the tool is, and how long it has been on its way. */
function read(place: Place, duration: number): void {
  if (drawing !== undefined) {
    const parts = placeText(drawing, place, duration);
    readout.textContent = parts.map(({ words }) => words).join("  ");
    time.ariaValueText = `${timeText(place.seconds)} of ${timeText(duration)}`;
  }
}

/** Milliseconds between two lines that the editor is told while the run is played. */
const PACE = 80;

let followed = "";
let waiting: number | undefined;
let newest: { file: string; line: number } | undefined;

/** Tells the editor the line; the last one always, others no faster than it can show them. */
function follow(place: Place): void {
  newest = { file: drawing?.files[place.file] ?? "", line: place.line };
  waiting ??= window.setTimeout(() => {
    waiting = undefined;
    const key = `${newest?.file}:${newest?.line}`;
    if (newest !== undefined && key !== followed) {
      followed = key;
      host.postMessage({ kind: "at", ...newest });
    }
  }, PACE);
}

/** What the picture goes past, each with a link to its line. */
function list(passed: Alarm[]): void {
  alarms.replaceChildren(
    ...passed.slice(0, 8).map((alarm) => link(alarm.words, alarm.file, alarm.line)),
  );
  if (passed.length > 8) {
    alarms.append(Object.assign(document.createElement("div"), { textContent: `and ${passed.length - 8} more` }));
  }
}

/** Extents of the cut, time, and what a reader has to know whether the options are open or not. */
function describe(toolpath: Toolpath): void {
  const { data, travel, seconds } = toolpath;
  const lines: string[] = [];
  const box = data.cut ?? data.all;
  ["X", "Y", "Z"].forEach((axis, index) => {
    const [low, high] = [box?.[0][index], box?.[1][index]];
    if (low === undefined || high === undefined) {
      return;
    }
    const factor = axis === "X" && data.diameter ? 2 : 1;
    lines.push(`${factor === 2 ? "X Ø" : axis} ${lengthText(low * factor, data.units)} … ${lengthText(high * factor, data.units)}`);
  });
  ["X", "Y", "Z"].forEach((axis, index) => {
    const range = travel[index];
    const [low, high] = [data.all?.[0][index], data.all?.[1][index]];
    // Where the work stands on the table is not known here; that the path is longer than the travel is.
    if (range && low !== undefined && high !== undefined && high - low > range[1] - range[0]) {
      lines.push(`${axis} needs more than the machine's travel`);
    }
  });
  if (seconds > 0) {
    lines.push(`time ${timeText(seconds)}`);
  }
  figures.replaceChildren(...lines.map((textContent) => Object.assign(document.createElement("div"), { textContent })));
  tell(toolpath.notes);
}

/** Sentences beside the picture; those that speak of a block lead to it. */
function tell(told: Note[]): void {
  notes.replaceChildren(
    ...told.map(({ words, file, line }) =>
      file === null || line === null ? Object.assign(document.createElement("div"), { textContent: words }) : link(words, file, line),
    ),
  );
}

function link(textContent: string, file: string, line: number): HTMLButtonElement {
  const button = Object.assign(document.createElement("button"), { textContent, title: "Show the line" });
  button.addEventListener("click", () => host.postMessage({ kind: "line", file, line }));
  return button;
}

window.addEventListener("message", (event: MessageEvent<ToPage>) => {
  const message = event.data;
  switch (message.kind) {
    case "toolpath":
      show(message.uri, message.toolpath);
      break;
    case "nothing":
      // What was drawn before belongs to another text. View, colours and filters stay for the next one: a block is half typed.
      viewer?.clear();
      drawing = undefined;
      choices.hidden = true;
      time.value = "1000";
      readout.textContent = "";
      figures.replaceChildren();
      nothing.textContent = message.why;
      tell(message.notes);
      list(message.alarms);
      break;
    case "lines":
      lines = { first: message.first, last: message.last };
      chooseAgain();
      break;
  }
});

play.addEventListener("click", () => (viewer?.isPlaying() ? viewer.pause() : viewer?.play()));
time.addEventListener("input", () => viewer?.goToTime((Number(time.value) / 1000) * viewer.duration()));
speed.addEventListener("change", () => {
  chosenSpeed = speed.selectedOptions[0]?.textContent ?? undefined;
  viewer?.setSpeed(Number(speed.value));
});
view.addEventListener("change", () => viewer?.setView(view.value));
element("fit").addEventListener("click", () => viewer?.fit());
element("zoom").addEventListener("click", () => viewer?.fitSelection());

function showOptions(yes: boolean): void {
  side.hidden = !yes;
  options.ariaExpanded = String(yes);
}

options.addEventListener("click", () => showOptions(side.hidden));
// Where there is room for the path beside it.
const wide = window.matchMedia("(min-width: 561px)");
wide.addEventListener("change", () => showOptions(wide.matches));
showOptions(wide.matches);

const KEYS: Record<string, () => void> = {
  " ": () => play.click(),
  ",": () => viewer?.step(-1),
  ".": () => viewer?.step(1),
  PageUp: () => viewer?.stepBlock(-1),
  PageDown: () => viewer?.stepBlock(1),
  T: () => viewer?.stepTool(-1),
  t: () => viewer?.stepTool(1),
  S: () => viewer?.stepOperation(-1),
  s: () => viewer?.stepOperation(1),
  r: () => panel?.toggleRapids(),
  o: () => options.click(),
};
canvas.addEventListener("keydown", (event) => {
  const act = event.ctrlKey || event.metaKey || event.altKey ? undefined : KEYS[event.key];
  if (act !== undefined) {
    event.preventDefault();
    act();
  }
});
element("back").addEventListener("click", () => viewer?.stepBlock(-1));
element("on").addEventListener("click", () => viewer?.stepBlock(1));
element("next-tool").addEventListener("click", () => viewer?.stepTool(1));
element("next-operation").addEventListener("click", () => viewer?.stepOperation(1));
// The panel is left with Escape, and a measure is ended wherever the keyboard is.
document.addEventListener("keydown", (event) => {
  if (event.key === "Escape" && viewer?.measure.state().isOn) {
    viewer.measure.stop();
    canvas.focus();
  }
});
new MutationObserver(() => viewer?.setTheme(theme())).observe(document.body, { attributes: true, attributeFilter: ["class"] });

host.postMessage({ kind: "ready" });
