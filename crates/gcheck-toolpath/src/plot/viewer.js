// A toolpath in three dimensions, in WebGL 2.
//
// Knows: points, tools, kinds of moves, a camera, a canvas. Must not know: the page around it, program text, where data comes
// from. It loads nothing and asks nobody; the page of `gcheck plot` and the preview of editors both use it. Its parts are in
// viewer/.
//
//   const viewer = createViewer(canvas, data, callbacks);
//
// The canvas fills a positioned element; what is written on the path is on a canvas that the viewer puts after it.
//
// `data` (`Drawing::to_json` in plot/data.rs writes it), version 2; lengths are millimetres whatever `units` says:
//
//   version    2
//   units      "mm" or "inch": how lengths are shown
//   lathe      true: the first view is ZX, with X up
//   diameter   true: X is shown doubled
//   tools      [{ number: 3 or null, name: "…" or null, color: "#rrggbb", diameter: millimetres or null }]
//   files      ["part.nc", …]
//   count      how many points there are; the arrays have one entry a point, in the order of the run:
//   points     x, y, z; differences in steps of 0.0001 mm
//   seconds    time since the start when the point is reached; differences in steps of 0.001 s
//   lines      line, from 1, of the block that moves to the point; differences
//   kinds      how the point is reached, see KIND; runs
//   toolOf     index in `tools`; runs
//   fileOf     index in `files`; runs; null when there is one file
//   driveOf    index in `drives`; runs; null when nothing is known of feeds
//   drives     [{ feed, mode, along, rpm }]: feed as the program has it, by `mode` in mm a minute ("minute"), mm a turn
//              ("turn") or moves a minute ("inverse"); mm a minute along the path; turns of the spindle a minute, 0 when it is
//              stopped. Each may be null. A rapid move has the feed of the cut before
//   callOf     index in `calls`; runs; null when no program is called; may be missing
//   calls      [[[file, line]]]: the blocks that lead to a point of another program or of a cycle's outline, the outermost
//              first; the first list is empty
//   rotary     null, or { axes: "AC", values }: degrees of the axes that turn, all of the first axis and then all of the next,
//              differences in steps of 0.0001; 1e9 is unknown
//   headings   [{ file, line, name }]: what a comment calls the blocks from a line on, in the order of lines; may be missing
//   changes    [[file, line]]: blocks that change the tool; headings above end there; may be missing
//   thinned    true: a piece may stand for several moves, so that it covers the lines after its start up to its end, and has
//              the feed of the last
//   alarms     [{ file, line, at: [x, y, z] or null }]: blocks at which the control would stop, and where the tool was then; may
//              be missing
//   zeros      [{ name: "G55", at: [x, y, z] }]: the work offsets in which something moves and whose place to the first is known;
//              may be missing
//   travel     [[low, high] or null of X, the same of Y]: how far the machine goes; may be missing
//   cut, all   [[x, y, z], [x, y, z]]: smallest and largest of the moves that cut, and of all moves; null when there are none
//
// An array is a typed array, or base64 of numbers in groups of seven bits (plot/packed.rs): differences to the point before, or
// runs of a length and a value. What ends at point i is piece i. Bytes of a point before base64, which makes 4 of 3: points 5 to
// 6 for moves around a millimetre and 9 for moves around a hundred, seconds 1 to 2, lines 1, rotary 1 to 3 for each axis that
// turns; what comes in runs takes 2 to 4 bytes a run. A long surface is 8 bytes a point, 11 on the wire.
//
// `callbacks`, each optional:
//
//   onPick(place)       a piece was clicked; null: beside all of them
//   onProgress(place)   the tool has come to a place of the run, by play or by `goTo`
//   onPlay(isPlaying)   play began or ended
//   onMeasure(state)    measuring began or ended, or a place was picked
//   onLook()            colours, filters or theme changed, so that legends are different
//
// A place is { piece, file, line, kind, tool, point: [x, y, z], angles: [{ axis, degrees }], seconds, drive }.
//
// The viewer: `setView(name)` of VIEWS, `fit()`, `fitSelection()`, `select(file, first, last)` or `select(null)`, `setMarks([{
// file, line, severity }])`, `goTo(piece)`, `goToTime(seconds)`, `step(by)`, `stepBlock(by)`, `stepTool(by)`,
// `stepOperation(by)`, `play()`, `pause()`, `setSpeed(factor)`; what is shown: `showRapids(yes)`, `setHidden(tools, sections)` by index, `showFormer(yes)`,
// `setHeights(low, high)` in millimetres or null, `setRotary(way)` of `rotaryWays()`, `setColoring(name)` of `colorings()`, `setTheme(THEMES.dark)`; `measure.start()`,
// `stop()`, `take(is)`; pictures: `png()` (a promise of a Blob) and `svg(title)`; `setData(data, { keep, former })`, `clear()`,
// `draw()`, `destroy()`, and to read: `data()`, `place()`, `pieces()`, `duration()`, `isPlaying()`, `sections()`, `legend()`,
// `toolColor(index)`, `heightRange()`. Drag turns, with Shift or another button it shifts; the wheel zooms where it points; on the
// focused canvas arrows turn, with Shift they shift, + and - zoom, F fits, Z fits what is chosen, M measures, 1 to 5 choose a view.

import { KIND, decode, sectionsOf, withoutPoints } from "./viewer/data.js";
import { annotate } from "./viewer/annotate.js";
import { VIEWS, createCamera } from "./viewer/camera.js";
import { THEMES, coloring, coloringsOf, css, onGround, rgb } from "./viewer/colors.js";
import { formerOf } from "./viewer/former.js";
import { between } from "./viewer/geometry.js";
import { createMeasure } from "./viewer/measure.js";
import { CHOSEN, HIDDEN, ROW, createPainter } from "./viewer/painter.js";
import { canvasPaper, svgPaper } from "./viewer/paper.js";
import { pieceNear } from "./viewer/pick.js";
import { drawPieces } from "./viewer/picture.js";
import { drawnWith, rotaryWays } from "./viewer/rotary.js";

export { KIND, THEMES, VIEWS };
export { placeText, lengthText, speedsFor, timeText, toolText } from "./viewer/words.js";

/** Points that are drawn at once wherever the browser runs. */
const SOON = 30000;
/** Milliseconds that a part of a picture may take. */
const BUDGET = 60;
/** Parts that a picture is finished in. */
const MOST_PARTS = 32;
/** Points up to which the pointer shows what a pick would snap to. */
const MOST_HOVERED = 300000;

/** Draws `data` on `canvas`; throws where the browser has no WebGL 2. */
export function createViewer(canvas, data, callbacks = {}) {
  const painter = createPainter(canvas);
  const overlay = document.createElement("canvas");
  overlay.className = "toolpath-overlay";
  overlay.style.cssText = "position:absolute;inset:0;width:100%;height:100%;pointer-events:none";
  canvas.after(overlay);
  const context = overlay.getContext("2d");
  const size = () => [Math.max(canvas.clientWidth, 1), Math.max(canvas.clientHeight, 1)];
  const camera = createCamera(size);

  // The data as they came, and as they are drawn: around a rotary axis, or unrolled.
  let raw, rotaryWay = "still";
  let d, marks, sections, sectionOf, theme = THEMES.dark, findings = [];
  // The data that had points last, and the moves that the ones before had and these do not.
  let drawn = null, former = null, isFormerShown = true;
  // What the colours show, and what they are to show where the data allow it.
  let colors = null, coloringName = "tool", wantedColoring = "tool";
  let hiddenTools = new Set(), hiddenSections = new Set(), rapids = true, section = [-Infinity, Infinity];
  // The first and the last piece that is chosen.
  let selected = null;
  // Where the tool is: on its way to the point `at`, so much of it done, at the time `clock`.
  let at = 0, part = 1, clock = 0, tip = [0, 0, 0];
  // The piece that was chosen or stepped to last.
  let current = 0;
  // All is in the view, and stays so when its size changes; without points it is to be fitted to those that come.
  let isFit = true, isUnfitted = false;
  let playing = false, speed = 10, frame = 0, playFrame = 0, playedAt = 0, moving = 0, isDestroyed = false;
  // Milliseconds that a picture of nothing takes, pieces that are drawn in a millisecond more, what is left of the picture.
  let least = null, pace = 1000, finish = null;

  const last = () => d.count - 1;
  const pointOf = (i) => [d.points[3 * i], d.points[3 * i + 1], d.points[3 * i + 2]];
  /** A point as the program has it. */
  const ownOf = (i) => d.own ? [d.own[3 * i], d.own[3 * i + 1], d.own[3 * i + 2]] : pointOf(i);
  const isHidden = (i) => (marks[2 * i + 1] & HIDDEN) !== 0 || d.kinds[i] === KIND.START || (d.kinds[i] === KIND.RAPID && !rapids);
  // Z is not up on a lathe.
  const steepness = () => d.lathe ? 0 : 0.5;
  const isPart = () => d.count > 1 && at < last();

  function view() {
    const [width, height] = size();
    const numbers = { background: rgb(theme.background), rapid: rgb(theme.rapid), accent: rgb(theme.accent), former: rgb(theme.former), faint: theme.faint };
    // Shaders compare with numbers, and infinity is not one of them everywhere.
    const bounds = section.map((height) => Math.min(Math.max(height, -1e30), 1e30));
    const depth = camera.depth(d.all ?? [[0, 0, 0], [1, 1, 1]]);
    return { camera, width, height, depth, steep: steepness(), theme: numbers, tip, at, last: last(), rapids, section: bounds, heights: colors.heights, selected, former: isFormerShown };
  }

  const scene = () => {
    const [width, height] = size();
    return {
      d, camera, theme, width, height, tip, at, rapids, section, isPart: isPart(), steep: steepness(), measure: measure.state(), heights: colors.heights,
      palette: colors.palette, ground: rgb(theme.background), rapid: rgb(theme.rapid), former: isFormerShown ? former : null,
    };
  };
  const shownFindings = () => findings.map((mark) => ({ ...mark, point: pointOf(mark.piece) }));

  function fitCanvases() {
    const [width, height] = size(), ratio = window.devicePixelRatio || 1;
    for (const one of [canvas, overlay]) {
      const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
      if (one.width !== w || one.height !== h) { one.width = w; one.height = h; }
    }
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
  }

  const spent = (paintThem) => {
    const begin = performance.now();
    paintThem();
    painter.wait();
    return performance.now() - begin;
  };

  /** Points of the path, and of the former one where it is shown. */
  const amount = () => d.count + (isFormerShown ? former?.count ?? 0 : 0);

  /** Draws so many pieces of a large picture; learns how many take a millisecond. */
  function timed(count, paintThem) {
    if (amount() < SOON) { paintThem(); return; }
    least ??= spent(() => painter.begin({ ...view(), last: 0 }, 1));
    const time = spent(paintThem), own = Math.max(time - least, time / 4);
    // One quick part, or a slow one, is not believed at once.
    pace = Math.min(Math.max(count / own, pace / 2, 50), pace * 1.5, 20000);
  }

  /** Paints. Where all pieces would take long, every so many of them first; the rest follows when the view rests. */
  function paint() {
    frame = 0;
    if (painter.isLost()) return;
    if (finish) {
      // Each part takes as long as a picture of nothing as well, so that they are few.
      const part = Math.ceil(Math.max(pace * BUDGET, amount() / MOST_PARTS));
      let isMore = false;
      timed(part, () => { isMore = finish(part); });
      if (isMore) frame = requestAnimationFrame(paint); else finish = null;
      return;
    }
    const most = Math.max(pace * BUDGET, SOON / 2);
    fitCanvases();
    const shown = view(), every = amount() < SOON ? 1 : Math.ceil(amount() / most);
    timed(amount() / every, () => painter.begin(shown, every));
    if (d.count) annotate(canvasPaper(context, theme.background), { ...scene(), marks: shownFindings() });
    if (every > 1 && !moving && !playing) {
      finish = painter.finishing(shown);
      frame = requestAnimationFrame(paint);
    }
  }

  function draw() {
    finish = null;
    if (!frame && !isDestroyed) frame = requestAnimationFrame(paint);
  }

  /** The view moves; when it has rested for a while everything is drawn. */
  function drawMoving() {
    clearTimeout(moving);
    moving = setTimeout(() => { moving = 0; if (amount() >= SOON) draw(); }, 150);
    draw();
  }

  // --- What is shown, and how

  function colorAgain() {
    coloringName = coloringsOf(d).some(([name]) => name === wantedColoring) ? wantedColoring : "tool";
    colors = coloring(d, coloringName, theme);
    for (let i = 0; i < d.count; i++) marks[2 * i] = colors.toneOf(i);
    painter.setPalette(colors.palette);
    painter.setMarks(marks);
    draw();
    callbacks.onLook?.();
  }

  function filterAgain() {
    for (let i = 0; i < d.count; i++) {
      const isOut = hiddenTools.has(d.toolOf[i]) || hiddenSections.has(sectionOf[i]);
      marks[2 * i + 1] = isOut ? marks[2 * i + 1] | HIDDEN : marks[2 * i + 1] & ~HIDDEN;
    }
    painter.setMarks(marks);
    draw();
  }

  /** Does the piece belong to lines of a file: to its block, or to one that calls the block's program? */
  function covers(i, file, first, end) {
    const line = d.lines[i];
    const leads = ([of, from]) => of === file && from >= first && from <= end;
    if (d.callOf?.[i] && d.calls[d.callOf[i]].some(leads)) return true;
    if ((d.fileOf ? d.fileOf[i] : 0) !== file) return false;
    if (line >= first && line <= end) return true;
    const before = d.lines[i - 1];
    return d.thinned && line > end && before < first && (!d.fileOf || d.fileOf[i - 1] === file);
  }

  function select(file, first = 0, end = first) {
    selected = null;
    for (let i = 0; i < d.count; i++) {
      const isChosen = file !== null && i > 0 && d.kinds[i] !== KIND.START && covers(i, file, first, end);
      marks[2 * i + 1] = isChosen ? marks[2 * i + 1] | CHOSEN : marks[2 * i + 1] & ~CHOSEN;
      if (isChosen) selected = [selected ? selected[0] : i, i];
    }
    painter.setMarks(marks);
    draw();
    if (!selected) return null;
    [current] = selected;
    return placeOf(current);
  }

  function setMarks(wanted) {
    const open = new Map();
    for (const mark of wanted) {
      const key = `${mark.file}:${mark.line}`;
      if (!open.has(key)) open.set(key, { ...mark, piece: 0 });
    }
    // One pass: a mark is where the run first comes to its line.
    let left = open.size;
    for (let i = 1; i < d.count && left; i++) {
      if (d.kinds[i] === KIND.START) continue;
      const mark = open.get(`${d.fileOf ? d.fileOf[i] : 0}:${d.lines[i]}`);
      if (mark && !mark.piece) { mark.piece = i; left--; }
    }
    findings = [...open.values()].filter((mark) => mark.piece).slice(0, 1000);
    draw();
  }

  function placeOf(i) {
    const axes = [...(d.rotary?.axes ?? "")];
    const angle = (k, point) => d.rotary.values[k * d.count + point];
    // The axes turn while the tool moves; what nobody knows of the start counts as the end.
    const angleNow = (k) => i === at && part < 1 && Number.isFinite(angle(k, i - 1)) ? angle(k, i - 1) + (angle(k, i) - angle(k, i - 1)) * part : angle(k, i);
    return {
      piece: i, file: d.fileOf ? d.fileOf[i] : 0, line: d.lines[i], kind: d.kinds[i], tool: d.tools[d.toolOf[i]] ?? null,
      point: i === at && part < 1 ? between(ownOf(i - 1), ownOf(i), part) : ownOf(i), seconds: i === at ? clock : d.seconds[i],
      angles: axes.map((axis, k) => ({ axis, degrees: angleNow(k) })),
      drive: d.driveOf ? d.drives[d.driveOf[i]] ?? null : null,
    };
  }

  // --- The run

  function moveTool(piece, done, time, point) {
    [at, part, clock, tip, current] = [piece, done, time, point, piece];
    draw();
    callbacks.onProgress?.(placeOf(at));
  }

  /** The tool at a time. */
  function goToTime(seconds) {
    if (d.count < 2) return;
    const time = Math.min(Math.max(seconds, 0), d.seconds[last()]);
    let low = 1, high = last();
    while (low < high) {
      const middle = (low + high) >> 1;
      if (d.seconds[middle] < time) low = middle + 1; else high = middle;
    }
    const [from, to] = [d.seconds[low - 1], d.seconds[low]];
    const done = d.kinds[low] === KIND.START || to <= from ? 1 : Math.min((time - from) / (to - from), 1);
    moveTool(low, done, time, done === 1 ? pointOf(low) : between(pointOf(low - 1), pointOf(low), done));
  }

  /** The tool at the end of a piece. */
  function goTo(piece) {
    if (d.count < 2) return;
    const to = Math.min(Math.max(piece, 0), last());
    moveTool(to, 1, d.seconds[to], pointOf(to));
  }

  function step(by) {
    let next = at;
    do next += Math.sign(by); while (next > 0 && next < last() && d.kinds[next] === KIND.START);
    goTo(Math.abs(by) > 1 ? at + by : next);
  }

  /** To the end of the next group of pieces, or of the one before. */
  function stepGroup(by, same) {
    let next = at;
    if (by > 0) {
      next++;
      while (next < last() && same(next + 1, next)) next++;
    } else {
      while (next > 0 && same(next, at)) next--;
    }
    goTo(next);
  }

  const stepBlock = (by) => stepGroup(by, (i, j) => d.lines[i] === d.lines[j] && (!d.fileOf || d.fileOf[i] === d.fileOf[j]));
  const stepTool = (by) => stepGroup(by, (i, j) => d.toolOf[i] === d.toolOf[j]);
  const stepOperation = (by) => stepGroup(by, (i, j) => sectionOf[i] === sectionOf[j]);

  function play() {
    if (playing || d.count < 2) return;
    if (at >= last()) goTo(0);
    playing = true;
    playedAt = performance.now();
    // People who asked for little motion see the tool in steps.
    const pause = matchMedia("(prefers-reduced-motion: reduce)").matches ? 500 : 0;
    const tick = (time) => {
      if (!playing) return;
      playFrame = requestAnimationFrame(tick);
      if (time - playedAt < pause) return;
      const passed = Math.min(Math.max(time - playedAt, 0), 250 + 2 * pause);
      playedAt = time;
      goToTime(clock + passed / 1000 * speed);
      if (clock >= d.seconds[last()]) { goTo(last()); stopPlay(); }
    };
    playFrame = requestAnimationFrame(tick);
    callbacks.onPlay?.(true);
  }

  function stopPlay() {
    if (!playing) return;
    playing = false;
    cancelAnimationFrame(playFrame);
    draw();
    callbacks.onPlay?.(false);
  }

  // --- The camera

  /** What is cut, with as much of the way there as is near: a retract to the end of the machine would leave a dot of the part. */
  function near() {
    if (!d.all) return [[-10, -10, -10], [10, 10, 10]];
    if (!d.cut) return d.all;
    const around = Math.max(...d.cut[1].map((v, i) => v - d.cut[0][i])) / 4;
    const box = [d.cut[0].map((v, i) => Math.max(v - around, d.all[0][i])), d.cut[1].map((v, i) => Math.min(v + around, d.all[1][i]))];
    if (d.lathe) box[0][0] = Math.min(box[0][0], 0);
    return box;
  }

  /** The box around the pieces that `counts` says; null without any. */
  function boxOf(counts) {
    const box = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
    for (let i = 1; i < d.count; i++) {
      if (!counts(i)) continue;
      for (let k = 0; k < 3; k++) for (const end of [i - 1, i]) {
        const value = k === 2 ? Math.min(Math.max(d.points[3 * end + k], section[0]), section[1]) : d.points[3 * end + k];
        box[0][k] = Math.min(box[0][k], value);
        box[1][k] = Math.max(box[1][k], value);
      }
    }
    return box[0][0] <= box[1][0] ? box : null;
  }

  const isFiltered = () => hiddenTools.size > 0 || hiddenSections.size > 0 || section.some(Number.isFinite);

  /** All that is shown; where nothing is hidden, the part and not every retract. */
  function fit() {
    isFit = true;
    isUnfitted = d.count === 0;
    if (isUnfitted) { draw(); return; }
    const isIn = (i) => [i - 1, i].some((end) => d.points[3 * end + 2] >= section[0] && d.points[3 * end + 2] <= section[1]);
    const shown = isFiltered() ? boxOf((i) => !isHidden(i) && d.kinds[i] !== KIND.RAPID && isIn(i)) : null;
    camera.fit(shown ?? near());
    draw();
  }

  /** What is chosen; all that is shown when nothing is. */
  function fitSelection() {
    const box = selected && boxOf((i) => (marks[2 * i + 1] & CHOSEN) !== 0);
    if (!box) { fit(); return false; }
    // A drilled hole, or a move that is seen from its end, has no size.
    isFit = false;
    const least = Math.max(...box[1].map((v, i) => v - box[0][i]), 1) / 4;
    camera.fit([box[0].map((v, i) => Math.min(v, (v + box[1][i]) / 2 - least)), box[1].map((v, i) => Math.max(v, (v + box[0][i]) / 2 + least))]);
    draw();
    return true;
  }

  function setView(name) {
    camera.rows = VIEWS[name] ?? VIEWS.iso;
    fit();
  }

  const moved = (by) => (...how) => { isFit = false; by(...how); drawMoving(); };
  const turn = moved((dx, dy) => camera.turn(dx, dy, d.lathe ? [1, 0, 0] : [0, 0, 1]));
  const shift = moved(camera.shift), zoom = moved(camera.zoom);

  // --- Picks and measures

  const pieceAt = (x, y) => pieceNear(d, camera, size(), section, isHidden, x, y);
  const measure = createMeasure({
    data: () => d, current: () => current, onScreen: camera.onScreen, pieceAt,
    changed: (state) => { canvas.style.cursor = state.isOn ? "crosshair" : ""; draw(); callbacks.onMeasure?.(state); },
  });

  function pick(x, y) {
    if (measure.state().isOn) { measure.pick(x, y); return; }
    const piece = pieceAt(x, y);
    if (piece) current = piece;
    callbacks.onPick?.(piece ? placeOf(piece) : null);
  }

  // --- Pictures

  /** The view as it is, as a promise of a PNG. */
  function png() {
    if (painter.isLost()) return Promise.reject(new Error("the graphics card is lost"));
    fitCanvases();
    painter.begin(view(), 1);
    if (d.count) annotate(canvasPaper(context, theme.background), { ...scene(), marks: shownFindings() });
    const page = document.createElement("canvas");
    [page.width, page.height] = [canvas.width, canvas.height];
    const both = page.getContext("2d");
    both.drawImage(canvas, 0, 0);
    both.drawImage(overlay, 0, 0);
    return new Promise((resolve, reject) => page.toBlob((blob) => blob ? resolve(blob) : reject(new Error("the browser makes no PNG")), "image/png"));
  }

  /** The view as the text of an SVG picture. */
  function svg(title) {
    const [width, height] = size();
    const paper = svgPaper(width, height, theme.background, title, (words) => context.measureText(words).width);
    drawPieces(paper, { ...scene(), marks });
    annotate(paper, { ...scene(), marks: shownFindings() });
    return paper.finish();
  }

  // --- Pointer and keys

  const listening = new AbortController();
  const listen = (on, name, then, options = {}) => on.addEventListener(name, then, { ...options, signal: listening.signal });
  const fingers = new Map();
  let travelled = 0, hovering = 0;

  listen(canvas, "pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
    travelled = fingers.size > 1 ? Infinity : 0;
  });
  listen(canvas, "pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) {
      if (measure.state().isOn && !hovering && d.count < MOST_HOVERED) {
        const [x, y] = [event.offsetX, event.offsetY];
        hovering = requestAnimationFrame(() => { hovering = 0; measure.hover(x, y); });
      }
      return;
    }
    const now = [event.offsetX, event.offsetY], [dx, dy] = [now[0] - before[0], now[1] - before[1]];
    fingers.set(event.pointerId, now);
    travelled += Math.hypot(dx, dy);
    if (travelled < 4) return;
    if (fingers.size > 1) {
      const other = [...fingers].find(([id]) => id !== event.pointerId)[1];
      const apart = (p) => Math.max(Math.hypot(p[0] - other[0], p[1] - other[1]), 1);
      shift(dx / 2, dy / 2);
      zoom(apart(now) / apart(before), (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    } else if (event.shiftKey || event.buttons & 6) shift(dx, dy);
    else turn(dx, dy);
  });
  for (const name of ["pointerup", "pointercancel"]) listen(canvas, name, (event) => {
    const isClick = fingers.delete(event.pointerId) && travelled < 4 && name === "pointerup" && event.button === 0;
    if (isClick) pick(event.offsetX, event.offsetY);
  });
  listen(canvas, "contextmenu", (event) => event.preventDefault());
  listen(canvas, "wheel", (event) => {
    event.preventDefault();
    const pixels = event.deltaY * (event.deltaMode === 1 ? 16 : 1);
    zoom(Math.exp(-Math.min(Math.max(pixels, -300), 300) * 0.0015), event.offsetX, event.offsetY);
  }, { passive: false });
  listen(canvas, "keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const views = { 1: "top", 2: "front", 3: "side", 4: "iso", 5: "lathe" };
    const [width, height] = size(), way = ways[event.key], isMeasuring = measure.state().isOn;
    const keys = {
      "+": () => zoom(1.25, width / 2, height / 2), "=": () => zoom(1.25, width / 2, height / 2), "-": () => zoom(0.8, width / 2, height / 2),
      f: fit, z: fitSelection, m: measure.toggle, ...(isMeasuring ? { Escape: measure.stop, Enter: () => measure.take("end") } : {}),
    };
    const key = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (way) (event.shiftKey ? shift : turn)(way[0] * 20, way[1] * 20);
    else if (views[event.key]) setView(views[event.key]);
    else if (key) key();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  listen(canvas, "webglcontextlost", (event) => { event.preventDefault(); painter.forget(); });
  listen(canvas, "webglcontextrestored", () => { painter.setPoints(d); painter.setFormer(former); colorAgain(); });
  const watcher = new ResizeObserver(() => { if (isFit) fit(); else draw(); });
  watcher.observe(canvas);

  /**
   * Other data. `keep` leaves the camera, the colours and the section as they are; `former`, where the data are those of the
   * same program after an edit, shows what the path had before.
   */
  function setData(next, { keep = false, former: isEdit = false } = {}) {
    raw = decode(next);
    adopt({ keep, isEdit });
  }

  /** Draws a rotary axis in a way of `rotaryWays`; what is chosen and marked is to be told again. */
  function setRotary(way) {
    const [time, where] = [clock, at < last()];
    rotaryWay = way;
    // The path is drawn elsewhere, so that none of the one before can be shown beside it.
    former = null;
    adopt({ keep: true });
    if (where) goToTime(time);
    fit();
  }

  function adopt({ keep, isEdit = false }) {
    stopPlay();
    const wasLathe = d?.lathe;
    d = drawnWith(raw, rotaryWay);
    if (d.count) {
      const less = isEdit && drawn ? formerOf(drawn, d) : null;
      // An edit that leaves the path as it is does not end the comparison.
      if (less !== undefined) former = less;
      drawn = d;
    }
    ({ sections, sectionOf } = sectionsOf(d));
    marks = new Uint8Array(Math.max(Math.ceil(d.count / ROW), 1) * ROW * 2);
    selected = null; findings = []; hiddenTools = new Set(); hiddenSections = new Set();
    at = Math.max(last(), 0);
    part = 1;
    current = at;
    clock = d.count ? d.seconds[at] : 0;
    tip = d.count ? pointOf(at) : [0, 0, 0];
    measure.forget();
    painter.setPoints(d);
    painter.setFormer(former);
    if (!keep) section = [-Infinity, Infinity];
    colorAgain();
    if (!keep || wasLathe !== d.lathe) setView(d.lathe ? "lathe" : "iso");
    else if (isUnfitted) fit();
  }

  /** Draws nothing, until there are other data; the view, the colours and the section stay. */
  const clear = () => setData(withoutPoints(d), { keep: true });

  /** Ends all that is under way and leaves an empty canvas, on which another viewer may draw. */
  function destroy() {
    isDestroyed = true;
    stopPlay();
    listening.abort();
    watcher.disconnect();
    for (const under of [frame, hovering]) cancelAnimationFrame(under);
    clearTimeout(moving);
    finish = null;
    overlay.remove();
    painter.clear(rgb(theme.background));
    painter.destroy();
  }

  try { setData(data); } catch (error) { destroy(); throw error; }
  return {
    setView, fit, fitSelection, select, setMarks, goTo, goToTime, step, stepBlock, stepTool, stepOperation, play, pause: stopPlay, draw, setData, clear, measure, png, svg,
    setSpeed: (factor) => { speed = factor; },
    showRapids: (yes) => { rapids = yes; draw(); },
    showFormer: (yes) => { isFormerShown = yes; draw(); },
    setHidden: (tools, sections) => { hiddenTools = new Set(tools); hiddenSections = new Set(sections); filterAgain(); },
    setHeights: (low, high) => { section = [low ?? -Infinity, high ?? Infinity]; draw(); },
    setRotary,
    rotaryWays: () => rotaryWays(raw),
    setColoring: (name) => { wantedColoring = name; colorAgain(); },
    setTheme: (wanted) => { theme = { ...THEMES.dark, ...wanted }; colorAgain(); },
    colorings: () => coloringsOf(d),
    coloring: () => coloringName,
    legend: () => colors.legend,
    toolColor: (index) => css(onGround(rgb(d.tools[index].color), theme)),
    rapidColor: () => theme.rapid,
    formerColor: () => theme.former,
    heightRange: () => d.all ? [d.all[0][2], d.all[1][2]] : null,
    sections: () => sections,
    data: () => d,
    hasSelection: () => selected !== null,
    place: () => placeOf(at),
    pieces: () => Math.max(d.count - 1, 0),
    duration: () => d.count ? d.seconds[last()] : 0,
    isPlaying: () => playing,
    destroy,
  };
}
