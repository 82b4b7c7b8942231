// The toolpath, its views and its run.
//
// Knows: the viewer of `gcheck plot`, the elements of the page that belong to it. Must not know: where the path comes from.
//
//   const picture = createPicture({ onPick(line) });
//
// `show(toolpath, { keep })`, `fail(words)`, `chooseLine(line)`, `setMarks([{ line, severity }])`.

import { THEMES, createViewer, placeText, speedsFor, timeText } from "./plot/viewer.js";

const byId = (id) => document.getElementById(id);
const MILL = [["top", "Top"], ["front", "Front"], ["side", "Side"], ["iso", "3D"]];
const LATHE = [["lathe", "ZX"], ["front", "XZ"], ["top", "XY"], ["iso", "3D"]];

export function createPicture({ onPick }) {
  const [slider, play, clock, readout, message, notes] = ["time", "play", "clock", "readout", "message", "notes"].map(byId);
  let viewer = null, isLathe = null, ownFile = 0, line = null, marks = [];

  const queries = ["(prefers-color-scheme: dark)", "(prefers-contrast: more)", "(forced-colors: active)"].map((query) => matchMedia(query));
  function theme() {
    const [isDark, isStrong, isForced] = queries.map((query) => query.matches);
    return isStrong || isForced ? (isDark ? THEMES.contrast : THEMES.contrastLight) : isDark ? THEMES.dark : THEMES.light;
  }
  for (const query of queries) query.addEventListener("change", () => viewer?.setTheme(theme()));

  const say = (place) => { readout.textContent = placeText(viewer.data(), place, viewer.duration()).map(({ words }) => words).join(" · "); };

  function tell(seconds) {
    const words = `${timeText(seconds)} / ${timeText(viewer.duration())}`;
    clock.textContent = words;
    slider.setAttribute("aria-valuetext", words);
  }

  const callbacks = {
    onPick(place) {
      if (!place) { viewer.select(null); readout.textContent = ""; return; }
      say(place);
      if (place.file === ownFile) onPick(place.line);
    },
    onProgress(place) {
      slider.value = place.seconds;
      tell(place.seconds);
      say(place);
    },
    onPlay(isPlaying) { play.textContent = isPlaying ? "Pause" : "Play"; },
  };

  function offerViews(lathe) {
    if (lathe === isLathe) return;
    isLathe = lathe;
    const button = (words, onclick) => Object.assign(document.createElement("button"), { type: "button", textContent: words, onclick });
    byId("views").replaceChildren(
      ...(lathe ? LATHE : MILL).map(([name, words]) => button(words, () => viewer?.setView(name))),
      button("Fit", () => viewer?.fit()),
    );
  }

  play.addEventListener("click", () => viewer && (viewer.isPlaying() ? viewer.pause() : viewer.play()));
  slider.addEventListener("input", () => { viewer?.pause(); viewer?.goToTime(Number(slider.value)); });

  const picture = {
    show(toolpath, { keep }) {
      const { data } = toolpath;
      const list = [...toolpath.notes.map((note) => note.words), ...toolpath.alarms.map((alarm) => alarm.words)];
      notes.hidden = !list.length;
      notes.replaceChildren(...list.map((words) => Object.assign(document.createElement("li"), { textContent: words })));
      ownFile = Math.max(data.files.indexOf(""), 0);
      const isEmpty = data.count === 0;
      message.textContent = isEmpty ? "Nothing moves, as far as gcheck knows." : "";
      byId("run").textContent = isEmpty ? "" : `${toolpath.moves.toLocaleString("en")} moves · ${timeText(toolpath.seconds)} · ${data.units}`;
      offerViews(data.lathe);
      if (viewer) {
        viewer.pause();
        viewer.setData(data, { keep });
      } else {
        try {
          viewer = createViewer(byId("canvas"), data, callbacks);
        } catch (error) {
          message.textContent = `The path cannot be drawn: ${error.message}.`;
          return;
        }
        viewer.setTheme(theme());
      }
      const duration = viewer.duration();
      slider.max = duration;
      slider.value = duration;
      tell(duration);
      const speeds = speedsFor(duration);
      viewer.setSpeed((speeds.find(({ usual }) => usual) ?? speeds[0]).factor);
      picture.setMarks(marks);
      picture.chooseLine(line);
    },
    /** There is no path for this text; the last one would be a lie. */
    fail(words) {
      viewer?.clear();
      slider.max = slider.value = 0;
      slider.removeAttribute("aria-valuetext");
      clock.textContent = "";
      message.textContent = words;
      notes.hidden = true;
      readout.textContent = byId("run").textContent = "";
    },
    /** Chooses the moves of a line. */
    chooseLine(wanted) {
      line = wanted;
      const place = viewer && line !== null ? viewer.select(ownFile, line) : null;
      if (place) say(place); else readout.textContent = "";
    },
    setMarks(wanted) {
      marks = wanted;
      viewer?.setMarks(marks.map((mark) => ({ ...mark, file: ownFile })));
    },
  };
  return picture;
}
