// What one chooses of a picture: colours, tools, operations, a range of Z, measures, pictures to keep.
//
// Knows: the viewer, the elements that it makes. Must not know: the page around it, program text, where a picture is saved.
//
//   const panel = createPanel(host, viewer, { save(name, blob), hasFormer, turned() });
//
// `hasFormer` where programs are edited: there is a switch for the former path. `turned` is called when a rotary axis is drawn in
// another way, so that lines are chosen and findings are marked again. `panel.refresh()` after other data,
// `panel.look()` at `onLook`, `panel.measured(state)` at `onMeasure`. What was hidden stays hidden while it has the same name. The
// panel's elements have classes and no style; every text goes in as text.

import { lengthText, timeText, toolText } from "./viewer/words.js";

/** An element with properties and children. */
export const make = (name, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
};

/** Operations that have a row; further ones are shown and cannot be hidden. */
const MOST_OPERATIONS = 500;

/** A group that opens and closes. */
function group(title, open, ...children) {
  return make("details", { open, className: "group" }, make("summary", { textContent: title }), ...children);
}

/** A row with a box to tick. */
function tick(words, checked, change, ...more) {
  const box = make("input", { type: "checkbox", checked });
  box.addEventListener("change", () => change(box.checked));
  return make("label", { className: "row" }, box, ...more, make("span", { className: "name", textContent: words }));
}

/** The legend of colours: rows of values, or a bar with numbers at its side. */
function legendOf({ title, rows, colors, ticks }) {
  const parts = title ? [make("div", { className: "title", textContent: title })] : [];
  if (colors.length) {
    const bar = make("div", { className: "bar" }), numbers = make("div", { className: "numbers" });
    bar.style.background = `linear-gradient(to top, ${colors.join(", ")})`;
    for (const { at, words } of [...ticks].reverse()) {
      const number = make("span", { textContent: words });
      number.style.bottom = `${at * 100}%`;
      numbers.append(number);
    }
    parts.push(make("div", { className: "scale" }, bar, numbers));
  }
  for (const { color, words } of rows) {
    const swatch = make("i", {});
    swatch.style.borderColor = color;
    parts.push(make("div", { className: "row" }, swatch, make("span", { textContent: words })));
  }
  return parts;
}

/** The two ends of the heights that are shown, in the units of the program. */
function createHeights(viewer) {
  const box = make("div", { className: "heights" });
  let chosen = [null, null];

  function tell() { viewer.setHeights(...chosen); }

  function refresh(keep) {
    if (!keep) chosen = [null, null];
    box.replaceChildren();
    const range = viewer.heightRange(), { units } = viewer.data(), inMm = units === "inch" ? 25.4 : 1;
    if (!range || range[0] >= range[1]) {
      chosen = [null, null];
      box.append(make("p", { textContent: "All moves are at one Z." }));
      tell();
      return;
    }
    const ends = ["from", "to"].map((name, end) => {
      const words = `Z ${name}, ${units}`, [low, high] = range;
      const slider = make("input", { type: "range", min: 0, max: 1000, step: 1, ariaLabel: `${words}, slider` });
      const number = make("input", { type: "number", step: "any", ariaLabel: words });
      const show = () => {
        const value = chosen[end] ?? range[end];
        slider.value = Math.round((value - low) / (high - low) * 1000);
        slider.setAttribute("aria-valuetext", `${lengthText(value, units)} ${units}`);
        number.value = lengthText(value, units);
      };
      const set = (value) => {
        // An end that is as far out as can be holds nothing back, and the ends do not pass each other.
        const other = chosen[1 - end] ?? range[1 - end], limited = end ? Math.max(value, other) : Math.min(value, other);
        chosen[end] = end ? (limited >= high ? null : limited) : (limited <= low ? null : limited);
        tell();
      };
      slider.addEventListener("input", () => { set(low + (high - low) * slider.value / 1000); number.value = lengthText(chosen[end] ?? range[end], units); });
      slider.addEventListener("change", show);
      number.addEventListener("change", () => { if (number.value !== "") set(Number(number.value) * inMm); show(); });
      show();
      return { row: make("div", { className: "end" }, make("span", { textContent: `Z ${name}` }), slider, number), show };
    });
    const all = make("button", { type: "button", textContent: "All of Z" });
    all.addEventListener("click", () => { chosen = [null, null]; ends.forEach(({ show }) => show()); tell(); });
    box.append(...ends.map(({ row }) => row), all);
    tell();
  }

  return { box, refresh };
}

/** Puts the panel into `host`. */
export function createPanel(host, viewer, { save, hasFormer = false, turned = null }) {
  const hidden = { tools: new Set(), sections: new Set() };
  let rapids = true, former = true;
  // By index: what tools and operations are called. Of operations with one name each has a number.
  let toolNames = [], sectionNames = [];

  /** Shows what is not hidden: one pass over the path, whatever changed. */
  function filter() {
    const indexesOf = (names, out) => names.flatMap((name, index) => out.has(name) ? [index] : []);
    viewer.setHidden(indexesOf(toolNames, hidden.tools), indexesOf(sectionNames.slice(0, MOST_OPERATIONS), hidden.sections));
  }

  const show = (set, name, yes) => { set[yes ? "delete" : "add"](name); filter(); };

  // --- Colours and tools
  const choice = make("select", { ariaLabel: "Colour by" }), legend = make("div", { className: "legend" });
  choice.addEventListener("change", () => viewer.setColoring(choice.value));
  const tools = make("div", { className: "tools" });
  const bar = (color, className = "") => { const made = make("i", { className }); if (color) made.style.borderColor = color; return made; };

  function fillTools() {
    const byTool = viewer.coloring() === "tool";
    toolNames = viewer.data().tools.map(toolText);
    const rows = toolNames.map((words, index) => {
      const color = byTool ? viewer.toolColor(index) : null;
      return tick(words, !hidden.tools.has(words), (yes) => show(hidden.tools, words, yes), bar(color, byTool ? "" : "plain"));
    });
    const rapid = tick("Rapid moves", rapids, (yes) => { rapids = yes; viewer.showRapids(yes); }, bar(viewer.rapidColor(), "dashed"));
    rapid.classList.add("rapids");
    const before = tick("Former path", former, (yes) => { former = yes; viewer.showFormer(yes); }, bar(viewer.formerColor(), "thin"));
    before.title = "What the last edit took away from the path";
    tools.replaceChildren(...rows, rapid, ...(hasFormer ? [before] : []));
  }

  function look() {
    choice.replaceChildren(...viewer.colorings().map(([value, textContent]) => make("option", { value, textContent })));
    choice.value = viewer.coloring();
    legend.replaceChildren(...legendOf(viewer.legend()));
    fillTools();
  }

  // --- Operations
  const rows = make("div", { className: "rows" }), operations = group("Operations", false);
  const allOf = (words, yes) => {
    const button = make("button", { type: "button", textContent: words });
    button.addEventListener("click", () => {
      rows.querySelectorAll("input").forEach((box) => { box.checked = yes; });
      hidden.sections = new Set(yes ? [] : sectionNames.slice(0, MOST_OPERATIONS));
      filter();
    });
    return button;
  };
  operations.append(make("div", { className: "buttons" }, allOf("All", true), allOf("None", false)), rows);

  function fillOperations() {
    const { tools: known, files } = viewer.data(), sections = viewer.sections();
    operations.hidden = sections.length < 2;
    const counts = new Map();
    sectionNames = sections.map(({ name, tool, file }) => {
      const key = `${name} ${known[tool]?.number} ${file}`, count = (counts.get(key) ?? 0) + 1;
      counts.set(key, count);
      return `${key} ${count}`;
    });
    rows.replaceChildren(...sections.slice(0, MOST_OPERATIONS).map(({ name, tool, file, first, last, seconds }, index) => {
      const of = known[tool], words = name ?? (of ? toolText(of) : "moves"), key = sectionNames[index];
      const row = tick(words, !hidden.sections.has(key), (yes) => show(hidden.sections, key, yes));
      const lines = first === last ? `line ${first}` : `lines ${first} to ${last}`, number = of?.number == null ? "" : `T${of.number}, `;
      row.append(make("small", { textContent: `${number}${file > 0 && files[file] ? `${files[file]}, ` : ""}${lines}, ${timeText(seconds)}` }));
      return row;
    }));
  }

  // --- A rotary axis
  const ways = make("select", { ariaLabel: "Rotary axis" }), rotary = group("Rotary axis", true, make("label", { className: "row" }, ways));
  let way = "still";
  rotary.title = "Drawn about the zero of the program";
  ways.addEventListener("change", () => {
    way = ways.value;
    viewer.setRotary(way);
    refresh({ keep: true });
    turned?.();
  });

  function fillRotary() {
    const known = viewer.rotaryWays();
    rotary.hidden = known.length === 0;
    ways.replaceChildren(...known.map(([value, textContent]) => make("option", { value, textContent })));
    ways.value = way;
  }

  // --- Heights, measures, pictures
  const heights = createHeights(viewer);
  const measure = make("button", { type: "button", textContent: "Measure", title: "Measure between two places (M)", ariaPressed: "false" });
  measure.addEventListener("click", () => viewer.measure.toggle());
  const hint = make("p", {}), result = make("dl", { className: "result" }), spoken = make("div", { className: "measured" }, hint, result);
  spoken.setAttribute("role", "status");
  const takes = [["start", "Start"], ["middle", "Middle"], ["end", "End"], ["centre", "Centre"]].map(([is, textContent]) => {
    const button = make("button", { type: "button", textContent, title: `Take the ${is} of the move that is chosen` });
    button.addEventListener("click", () => { if (!viewer.measure.take(is)) hint.textContent = `The chosen move has no ${is}: choose another.`; });
    return button;
  });

  let told = "";

  function measured({ isOn, picks, rows }) {
    // The pointer moves on and on, and a screen reader says what is written here.
    const news = JSON.stringify([isOn, picks.map(({ words, text }) => [words, text]), rows]);
    if (news === told) return;
    told = news;
    measure.ariaPressed = String(isOn);
    const next = ["Click a place, or choose a move and take its start, middle, end or centre.", "Now the second place.", ""][picks.length];
    hint.textContent = isOn ? next : "";
    const places = picks.map(({ words, text }, i) => ({ name: `${i ? "to" : "from"} ${words}`, value: text }));
    result.replaceChildren(...[...places, ...rows].flatMap(({ name, value }) => [make("dt", { textContent: name }), make("dd", { textContent: value })]));
    // A place has more numbers than there is room for beside its name.
    result.querySelectorAll(`:nth-child(-n + ${2 * places.length})`).forEach((part) => part.classList.add("place"));
  }

  const pictureName = () => (viewer.data().files[0] || "toolpath").replace(/^.*[\\/]/, "").replace(/\.[^.]*$/, "") || "toolpath";
  const failure = make("p", {});
  failure.setAttribute("role", "status");
  const pictures = [["PNG", () => viewer.png()], ["SVG", async () => new Blob([viewer.svg(pictureName())], { type: "image/svg+xml" })]].map(([kind, draw]) => {
    const button = make("button", { type: "button", textContent: kind, title: `Save the view as ${kind}` });
    button.addEventListener("click", async () => {
      failure.textContent = "";
      try {
        await save(`${pictureName()}.${kind.toLowerCase()}`, await draw());
      } catch (error) {
        failure.textContent = `No picture is saved: ${error.message}.`;
      }
    });
    return button;
  });

  host.replaceChildren(
    group("Colour", true, make("label", { className: "row" }, make("span", { textContent: "by" }), choice), legend),
    group("Tools", true, tools),
    rotary,
    operations,
    group("Range of Z", false, heights.box),
    group("Measure", true, measure, spoken, make("div", { className: "takes" }, ...takes)),
    group("Picture", true, make("div", { className: "buttons" }, ...pictures), failure),
  );

  /** Shows what the viewer has now. What was hidden stays so while the same program is drawn again. */
  function refresh({ keep = true } = {}) {
    if (!keep) {
      hidden.tools.clear();
      hidden.sections.clear();
    }
    look();
    fillRotary();
    fillOperations();
    heights.refresh(keep);
    measured(viewer.measure.state());
    viewer.showRapids(rapids);
    viewer.showFormer(former);
    filter();
  }

  refresh();
  return { refresh, look, measured, toggleRapids: () => tools.querySelector(".rapids input")?.click() };
}
