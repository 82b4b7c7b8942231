// The page of the preview: the viewer, and its controls.

import { createViewer, type Drawing, lengthText, type Place, THEMES, type Viewer } from "gcheck-viewer";

import { clock } from "./clock";
import type { Alarm, FromPage, ToPage, Toolpath } from "./messages";

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
const tools = element("tools");
const play = element<HTMLButtonElement>("play");
const time = element<HTMLInputElement>("time");
const speed = element<HTMLSelectElement>("speed");
const view = element<HTMLSelectElement>("view");
const rapids = element<HTMLInputElement>("rapids");
const readout = element("readout");

let viewer: Viewer | undefined;
let drawing: Drawing | undefined;

function theme(): Record<string, string> {
  const isLight = document.body.classList.contains("vscode-light") || document.body.classList.contains("vscode-high-contrast-light");
  const own = isLight ? THEMES.light : THEMES.dark;
  const background = getComputedStyle(document.body).getPropertyValue("--vscode-editor-background").trim();
  return /^#[0-9a-f]{6}$/i.test(background) ? { ...own, background } : own;
}

function show(toolpath: Toolpath): void {
  nothing.textContent = "";
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
    });
    viewer.setTheme(theme());
    viewer.setSpeed(Number(speed.value));
    if (drawing.lathe) {
      view.value = "lathe";
    }
  } else {
    viewer.setData(drawing);
  }
  viewer.showRapids(rapids.checked);
  describe(toolpath);
  legend(drawing);
  list(toolpath.alarms);
  host.postMessage({ kind: "drawn", pieces: viewer.pieces(), alarms: alarms.childElementCount });
}

/** Where the tool is, and how long it has been on its way. */
function read(place: Place, duration: number): void {
  if (drawing === undefined) {
    return;
  }
  const { units, diameter } = drawing;
  const axes = ["X", "Y", "Z"].map((axis, index) => {
    const value = (place.point[index] ?? 0) * (axis === "X" && diameter ? 2 : 1);
    return `${axis} ${lengthText(value, units)}`;
  });
  const tool = place.tool?.number == null ? [] : [`T${place.tool.number}`];
  const left = clock(Math.max(duration - place.seconds, 0));
  readout.textContent = [`line ${place.line}`, ...axes, ...tool, `${clock(place.seconds)}, ${left} left`].join("  ");
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
    ...passed.slice(0, 8).map((alarm) => {
      const button = Object.assign(document.createElement("button"), { textContent: alarm.words, title: "Show the line" });
      button.addEventListener("click", () => host.postMessage({ kind: "line", file: alarm.file, line: alarm.line }));
      return button;
    }),
  );
  if (passed.length > 8) {
    alarms.append(Object.assign(document.createElement("div"), { textContent: `and ${passed.length - 8} more` }));
  }
}

/** Extents of the cut, time, and what a reader has to know. */
function describe(toolpath: Toolpath): void {
  const { data, travel, seconds, notes } = toolpath;
  const lines: string[] = [];
  const box = data.cut ?? data.all;
  ["X", "Y", "Z"].forEach((axis, index) => {
    const [low, high] = [box?.[0][index], box?.[1][index]];
    if (low === undefined || high === undefined) {
      return;
    }
    const factor = axis === "X" && data.diameter ? 2 : 1;
    lines.push(`${axis} ${lengthText(low * factor, data.units)} … ${lengthText(high * factor, data.units)}`);
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
    lines.push(`time ${clock(seconds)}`);
  }
  figures.replaceChildren(
    ...[...lines, ...notes].map((line) => Object.assign(document.createElement("div"), { textContent: line })),
  );
}

function legend(drawing: Drawing): void {
  const rows = drawing.tools.map((tool, index) => {
    const label = document.createElement("label");
    const box = Object.assign(document.createElement("input"), { type: "checkbox", checked: true });
    box.addEventListener("change", () => viewer?.showTool(index, box.checked));
    const swatch = document.createElement("span");
    swatch.className = "swatch";
    swatch.style.background = tool.color;
    const name = [tool.number === null ? "no tool" : `T${tool.number}`, tool.name].filter(Boolean).join(" ");
    label.append(box, swatch, ` ${name}`);
    return label;
  });
  tools.replaceChildren(...rows);
}

window.addEventListener("message", (event: MessageEvent<ToPage>) => {
  const message = event.data;
  switch (message.kind) {
    case "toolpath":
      show(message.toolpath);
      break;
    case "nothing":
      // What was drawn before belongs to another text.
      viewer?.destroy();
      viewer = undefined;
      drawing = undefined;
      canvas.getContext("webgl2")?.clear(WebGL2RenderingContext.COLOR_BUFFER_BIT);
      tools.replaceChildren();
      figures.replaceChildren();
      nothing.textContent = [message.why, ...message.notes].join("\n");
      list(message.alarms);
      break;
    case "lines":
      viewer?.select(0, message.first, message.last);
      break;
  }
});

play.addEventListener("click", () => (viewer?.isPlaying() ? viewer.pause() : viewer?.play()));
time.addEventListener("input", () => viewer?.goToTime((Number(time.value) / 1000) * viewer.duration()));
speed.addEventListener("change", () => viewer?.setSpeed(Number(speed.value)));
view.addEventListener("change", () => viewer?.setView(view.value));
rapids.addEventListener("change", () => viewer?.showRapids(rapids.checked));
element("fit").addEventListener("click", () => viewer?.fit());
const KEYS: Record<string, () => void> = {
  " ": () => play.click(),
  ",": () => viewer?.step(-1),
  ".": () => viewer?.step(1),
  PageUp: () => viewer?.stepBlock(-1),
  PageDown: () => viewer?.stepBlock(1),
  T: () => viewer?.stepTool(-1),
  t: () => viewer?.stepTool(1),
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
new MutationObserver(() => viewer?.setTheme(theme())).observe(document.body, { attributes: true, attributeFilter: ["class"] });

host.postMessage({ kind: "ready" });
