// A text field for programs: line numbers, underlined findings, the line of the cursor.
//
// Knows: lines and columns from 1, as findings have them. Must not know: where findings come from. The field is a plain
// textarea; what is drawn lies below it, in the same letters, and only of the lines that are seen. Every text goes in as text.
//
//   const editor = createEditor(host, { onInput(text), onCursor({ line, column }) });
//
// `text()`, `setText(text)`, `cursor()`, `setMarks([{ span, severity, message, faded }])`, `goTo(span, { focus })`.

const LINE = 20;
/** Characters of a line that are drawn below the field. */
const MOST_COLUMNS = 2000;
const SEVERITIES = ["hint", "info", "warning", "error"];
const worst = (marks) => marks.reduce((a, b) => (SEVERITIES.indexOf(b.severity) > SEVERITIES.indexOf(a.severity) ? b : a));

const make = (name, properties = {}, ...children) => {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
};

export function createEditor(host, { onInput, onCursor }) {
  const gutter = make("div", { className: "gutter", ariaHidden: "true" });
  const layer = make("div", { className: "marks", ariaHidden: "true" });
  const field = make("textarea", { id: "text", wrap: "off", spellcheck: false, autocapitalize: "characters", autocomplete: "off", ariaLabel: "Program text" });
  field.setAttribute("autocorrect", "off");
  host.append(gutter, make("div", { className: "paper" }, layer, field));

  let lines = [""], starts = [0], marks = [], byLine = new Map(), at = { line: 1, column: 1 }, frame = 0;

  function read() {
    lines = field.value.split("\n");
    starts = [];
    let offset = 0;
    for (const line of lines) { starts.push(offset); offset += line.length + 1; }
    gutter.style.width = `${Math.max(String(lines.length).length, 2) + 4}ch`;
  }

  function placeOf(offset) {
    let low = 0, high = starts.length - 1;
    while (low < high) {
      const middle = Math.ceil((low + high) / 2);
      if (starts[middle] <= offset) low = middle; else high = middle - 1;
    }
    return { line: low + 1, column: offset - starts[low] + 1 };
  }

  const offsetOf = ({ line, column }) => {
    const index = Math.min(Math.max(line, 1), lines.length) - 1;
    return starts[index] + Math.min(Math.max(column - 1, 0), lines[index].length);
  };

  /** The part of a line that a mark covers, from 0; one that covers nothing is drawn at a character. */
  function partOf(mark, line) {
    const { start, end } = mark.span, length = (lines[line - 1] ?? "").length;
    let from = line === start.line ? start.column - 1 : 0, to = line === end.line ? end.column - 1 : length;
    from = Math.min(from, length);
    if (to <= from) { to = Math.min(from + 1, length); from = Math.max(to - 1, 0); }
    return [from, Math.min(to, length, MOST_COLUMNS)];
  }

  function marksOf(line) {
    return (byLine.get(line) ?? []).concat(marks.filter((mark) => mark.isLong && mark.span.start.line <= line && line <= mark.span.end.line));
  }

  function drawSoon() {
    if (!frame) frame = requestAnimationFrame(() => { frame = 0; draw(); });
  }

  function draw() {
    const first = Math.max(Math.floor(field.scrollTop / LINE) - 2, 0);
    const last = Math.min(first + Math.ceil(field.clientHeight / LINE) + 4, lines.length);
    const numbers = [], rows = [];
    for (let index = first; index < last; index++) {
      const line = index + 1, top = `${index * LINE - field.scrollTop}px`, here = marksOf(line);
      const number = make("div", { textContent: line }), row = make("div");
      for (const element of [number, row]) {
        element.style.top = top;
        if (line === at.line) element.classList.add("now");
      }
      row.style.left = `${-field.scrollLeft}px`;
      if (here.length) {
        number.dataset.severity = worst(here).severity;
        row.append(...piecesOf(line, here));
      }
      numbers.push(number);
      rows.push(row);
    }
    gutter.replaceChildren(...numbers);
    layer.replaceChildren(...rows);
  }

  /** The text of a line in pieces; where marks overlap the worst is shown. */
  function piecesOf(line, here) {
    const text = lines[line - 1].slice(0, MOST_COLUMNS);
    const parts = here.map((mark) => ({ mark, part: partOf(mark, line) }));
    const cuts = [...new Set([0, text.length, ...parts.flatMap(({ part }) => part)])].filter((cut) => cut <= text.length).sort((a, b) => a - b);
    return cuts.slice(1).map((to, i) => {
      const from = cuts[i], over = parts.filter(({ part }) => part[0] <= from && to <= part[1]).map(({ mark }) => mark);
      if (!over.length) return text.slice(from, to);
      const shown = worst(over), piece = make("span", { textContent: text.slice(from, to) });
      piece.dataset.severity = shown.severity;
      if (over.every((mark) => mark.faded)) piece.classList.add("faded");
      piece.words = over.map((mark) => `${mark.severity}: ${mark.message}`).join("\n");
      return piece;
    });
  }

  function moved() {
    const back = field.selectionDirection === "backward";
    const place = placeOf(back ? field.selectionStart : field.selectionEnd);
    if (place.line === at.line && place.column === at.column) return;
    at = place;
    drawSoon();
    onCursor(at);
  }

  field.addEventListener("input", () => {
    read();
    moved();
    drawSoon();
    onInput(field.value);
  });
  document.addEventListener("selectionchange", () => { if (document.activeElement === field) moved(); });
  for (const name of ["keyup", "pointerup", "select", "focus"]) field.addEventListener(name, moved);
  field.addEventListener("scroll", draw);
  // The words of a finding where the pointer rests; the list of findings has them for everybody else.
  field.addEventListener("pointermove", ({ clientX, clientY }) => {
    const isUnder = ({ left, right, top, bottom }) => left <= clientX && clientX < right && top <= clientY && clientY < bottom;
    const piece = [...layer.querySelectorAll("span")].find((span) => isUnder(span.getBoundingClientRect()));
    const words = piece?.words ?? "";
    if (field.title !== words) field.title = words;
  });
  new ResizeObserver(drawSoon).observe(field);
  read();
  drawSoon();

  return {
    field,
    text: () => field.value,
    cursor: () => at,
    setText(text) {
      field.value = text;
      read();
      marks = [];
      byLine = new Map();
      field.setSelectionRange(0, 0);
      field.scrollTo(0, 0);
      at = { line: 1, column: 1 };
      drawSoon();
    },
    setMarks(list) {
      marks = list.map((mark) => ({ ...mark, isLong: mark.span.end.line > mark.span.start.line }));
      byLine = new Map();
      for (const mark of marks) {
        if (mark.isLong) continue;
        const { line } = mark.span.start;
        if (!byLine.has(line)) byLine.set(line, []);
        byLine.get(line).push(mark);
      }
      drawSoon();
    },
    goTo({ start, end }, { focus = true } = {}) {
      if (focus) field.focus({ preventScroll: true });
      field.setSelectionRange(offsetOf(start), offsetOf(end), "backward");
      const top = (start.line - 1) * LINE;
      if (top < field.scrollTop + LINE || top > field.scrollTop + field.clientHeight - 2 * LINE) {
        field.scrollTop = Math.max(top - field.clientHeight / 3, 0);
      }
      // The first column is in sight, or the field scrolls sideways as if it were typed in.
      if (start.column < 40) field.scrollLeft = 0;
      moved();
      drawSoon();
    },
  };
}
