// The playground: a program that is typed, and what gcheck knows of it.
//
// Knows: the elements of the page, which question follows which. Must not know: how anything is computed or drawn. Every text
// of a program goes into the page as text, never as markup.

import { Superseded, createClient } from "./client.js";
import { createEditor } from "./editor.js";
import { markdown } from "./markdown.js";
import { createPicture } from "./picture.js";

/** Milliseconds after the last key until the program is read. */
const REST = 150;
/** Milliseconds after the last move of the cursor until its state is asked. */
const CURSOR_REST = 80;
const UNREACHABLE = "unreachable-block";

const byId = (id) => document.getElementById(id);
const make = (name, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
};

let client = null;
// Counts texts and choices of a control: an answer for an older one is not shown.
let version = 0;
// The version of which nothing more is asked, because a question about it failed.
let failed = -1;
let findings = [];
// The picture is seen from where it was, unless the program is another one.
let isFresh = true;
let typing = 0, moving = 0;

const picture = createPicture({
  onPick(line) {
    const text = editor.text().split("\n")[line - 1] ?? "";
    editor.goTo({ start: { line, column: 1 }, end: { line, column: text.length + 1 } }, { focus: false });
  },
});
const editor = createEditor(byId("editor"), {
  onInput() {
    clearTimeout(typing);
    typing = setTimeout(read, REST);
  },
  onCursor({ line }) {
    picture.chooseLine(line);
    choose(line);
    clearTimeout(moving);
    moving = setTimeout(askState, CURSOR_REST);
  },
});

function problem(words) {
  byId("problem").hidden = !words;
  byId("problem").textContent = words;
}

const question = () => ({ text: editor.text(), control: byId("control").value });

/** Asks for everything that is shown of the text. */
async function read() {
  clearTimeout(typing);
  const asked = ++version;
  const of = question(), isNew = isFresh;
  const isOld = () => asked !== version;
  byId("status").textContent = "reading…";
  try {
    const { answer, took } = await client.ask("check", of);
    if (isOld()) return;
    problem("");
    showFindings(answer, took);
    askState();
    const path = await client.ask("toolpath", of);
    if (isOld()) return;
    picture.setMarks(findings.map(({ severity, span }) => ({ severity, line: span.start.line })));
    picture.show(path.answer, { keep: !isNew });
    isFresh = false;
  } catch (error) {
    if (error instanceof Superseded || isOld()) return;
    failed = asked;
    const isChecked = byId("findings").dataset.version === String(asked);
    problem(error.message);
    if (!isChecked) {
      findings = [];
      editor.setMarks([]);
      picture.setMarks([]);
      byId("reading").textContent = "";
      byId("status").textContent = "no findings are known";
      byId("findings-title").textContent = "Findings";
      byId("findings").replaceChildren();
    }
    byId("state").replaceChildren();
    picture.fail("There is no picture of this program.");
    isFresh = true;
  }
}

// --- Findings

const count = (number, word) => `${number.toLocaleString("en")} ${word}${number === 1 || word === "info" ? "" : "s"}`;

function words(list, more) {
  const counts = ["error", "warning", "info", "hint"].map((name) => [list.filter((finding) => finding.severity === name).length, name]);
  const parts = counts.filter(([number]) => number).map(([number, name]) => count(number, name));
  return [...parts, ...(more ? [`${more.toLocaleString("en")} more`] : [])].join(", ") || "no findings";
}

const BECAUSE = {
  chosen: () => "",
  comment: (because) => `, named by ${because}`,
  shown: (because) => `, detected from ${because}`,
  guessed: (because) => `, guessed from ${because}: no finding is above a warning`,
  usual: () => ", the usual one: the program does not show its control",
};

function showFindings({ control, findings: list, more, suppressed, outOfFuel }, took) {
  findings = list;
  byId("findings").dataset.version = version;
  byId("reading").textContent = `${control.title}${BECAUSE[control.source](control.because)}`;
  const said = words(list, more);
  byId("status").textContent = `${said} · ${Math.max(Math.round(took), 1)} ms`;
  byId("findings-title").textContent = list.length ? `Findings: ${said}` : "Findings";
  const remarks = [
    ...(list.length ? [] : [editor.text().trim() ? "gcheck finds nothing to say about this program." : "Type a program, or choose a sample."]),
    ...(more ? [`${more.toLocaleString("en")} more findings are not listed; \`gcheck check\` lists them.`] : []),
    ...(suppressed ? [`Comments of the program silence ${count(suppressed, "finding")}.`] : []),
    ...(outOfFuel ? ["The program has more paths than gcheck follows; on the rest it is silent."] : []),
  ];
  byId("findings").replaceChildren(
    ...list.map((finding, index) => row(finding, index)),
    ...remarks.map((remark) => make("li", { className: "none", textContent: remark })),
  );
  editor.setMarks(list.map(({ span, severity, message, rule }) => ({ span, severity, message, faded: rule === UNREACHABLE })));
  choose(editor.cursor().line);
}

/** A finding in the list; what more there is to say of it shows while it is chosen. */
function row({ rule, page, severity, span, message, label, related, notes, help }, index) {
  const { line, column } = span.start;
  const button = make("button", { type: "button" }, `${severity}: `, ...inline(message), make("small", { textContent: `line ${line}, column ${column} · ${rule}` }));
  button.addEventListener("click", () => editor.goTo(span));
  const places = related.map((place) => {
    const jump = make("button", { type: "button", textContent: `line ${place.span.start.line}` });
    jump.addEventListener("click", () => editor.goTo(place.span));
    return make("p", {}, jump, ` ${place.message}`);
  });
  const link = make("a", { href: page, target: "_blank", rel: "noopener", textContent: "About this rule" });
  const more = make("div", { className: "more" },
    ...(label ? [make("p", {}, ...inline(label))] : []),
    ...places,
    ...notes.map((note) => make("p", {}, "note: ", ...inline(note))),
    ...(help ? [make("p", {}, "help: ", ...inline(help))] : []),
    make("p", {}, link));
  const item = make("li", {}, button, more);
  item.dataset.severity = severity;
  item.dataset.index = index;
  return item;
}

/** Words of a finding, in which only code is marked. */
const inline = (text) => text.split("`").map((part, i) => (i % 2 ? make("code", { textContent: part }) : part));

/** Marks the findings of a line in the list. */
function choose(line) {
  let first = null;
  for (const item of byId("findings").querySelectorAll("li[data-index]")) {
    const { start, end } = findings[item.dataset.index].span;
    const isChosen = start.line <= line && line <= end.line;
    item.classList.toggle("chosen", isChosen);
    if (isChosen) first ??= item;
  }
  first?.scrollIntoView({ block: "nearest" });
}

/** Goes to the next finding after the cursor, or to the one before it. */
function nextFinding(by) {
  if (!findings.length) return;
  const { line, column } = editor.cursor();
  const isAfter = ({ span: { start } }) => start.line > line || (start.line === line && start.column > column);
  const isBefore = ({ span: { start } }) => start.line < line || (start.line === line && start.column < column);
  const next = by > 0 ? findings.find(isAfter) ?? findings[0] : findings.findLast(isBefore) ?? findings.at(-1);
  editor.goTo(next.span);
}

document.addEventListener("keydown", (event) => {
  if (event.key !== "F8" || event.ctrlKey || event.altKey || event.metaKey) return;
  event.preventDefault();
  nextFinding(event.shiftKey ? -1 : 1);
});

// --- The state at the cursor

async function askState() {
  clearTimeout(moving);
  const asked = version, at = editor.cursor();
  if (asked === failed) return;
  try {
    const { answer } = await client.ask("hover", { ...question(), ...at });
    if (asked !== version) return;
    byId("state-title").textContent = `At the cursor: line ${at.line}, column ${at.column}`;
    byId("state").replaceChildren(...(answer ? markdown(answer.markdown) : [make("p", { className: "none", textContent: "There is no block here." })]));
  } catch (error) {
    if (error instanceof Superseded || asked !== version) return;
    failed = asked;
    problem(error.message);
  }
}

// --- The start

async function samples() {
  const response = await fetch("samples.json");
  return response.ok ? response.json() : [];
}

async function start() {
  const [started, list] = await Promise.all([createClient(), samples()]);
  client = started;
  byId("control").append(...client.ready.controls.map(({ name, title }) => make("option", { value: name, textContent: `${name} – ${title}` })));
  byId("samples").append(...list.map(({ title }, index) => make("option", { value: index, textContent: title })));
  const load = (text) => {
    editor.setText(text);
    isFresh = true;
    read();
  };
  byId("samples").addEventListener("change", ({ target }) => {
    if (target.value === "") return;
    byId("control").value = "";
    load(list[target.value].text);
  });
  byId("control").addEventListener("change", () => { isFresh = true; read(); });
  const { text, blocks } = client.ready.limits;
  byId("footer").append(` It reads up to ${text / 1024} KB, and draws ${blocks.toLocaleString("en")} blocks of a run.`);
  byId("loading").remove();
  byId("main").hidden = false;
  if (list.length) byId("samples").value = "0";
  load(list[0]?.text ?? "");
}

start().catch((error) => {
  byId("loading")?.remove();
  problem(`The playground cannot start: ${error.message}`);
});
