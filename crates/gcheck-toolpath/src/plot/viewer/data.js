// The data of a drawing as arrays with one entry a point.
//
// Knows: how the data are written; viewer.js says what they mean. Must not know: what is drawn.

/** How a point is reached. At START a new path begins: nothing leads to it. */
export const KIND = { START: 0, RAPID: 1, FEED: 2, ARC: 3, PROBE: 4, SPINDLE: 5 };

const VERSION = 2;
const UNKNOWN_ANGLE = 1e9;

function bytesOf(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** A function that reads one number after the other: seven bits a byte, the lowest first; throws where there are no more. */
function reader(text) {
  const bytes = bytesOf(text);
  let at = 0;
  return () => {
    let byte = bytes[at++], value = byte & 127, factor = 128;
    while (byte > 127) {
      byte = bytes[at++];
      value += (byte & 127) * factor;
      factor *= 128;
    }
    if (byte === undefined) throw new Error("toolpath data end before their last point");
    return value;
  };
}

/** `width` numbers a point, each told as its difference to the one before. */
function differences(Type, value, count, width, step) {
  if (typeof value !== "string") return value ?? null;
  const next = reader(value), made = new Type(count * width), last = new Float64Array(width);
  for (let i = 0; i < made.length; i++) {
    const number = next(), axis = i % width;
    last[axis] += number % 2 ? -(number + 1) / 2 : number / 2;
    // A division is exact where a product with 0.0001 is not.
    made[i] = last[axis] / step;
  }
  return made;
}

/** How often a number comes, and the number. */
function runs(Type, value, count) {
  if (typeof value !== "string") return value ?? null;
  const next = reader(value), made = new Type(count);
  for (let at = 0; at < count;) {
    const end = at + next();
    if (end === at || end > count) throw new Error(`toolpath data with a run from ${at} to ${end} of ${count} points`);
    made.fill(next(), at, end);
    at = end;
  }
  return made;
}

/** The data with typed arrays; everything else as it is. */
export function decode(data) {
  if (data.version !== VERSION) throw new Error(`toolpath data of version ${data.version}; this viewer reads version ${VERSION}`);
  const { count } = data;
  let rotary = data.rotary ?? null;
  if (rotary) {
    const values = differences(Float32Array, rotary.values, count * rotary.axes.length, 1, 1e4);
    rotary = { axes: rotary.axes, values: values.map((angle) => angle >= UNKNOWN_ANGLE ? NaN : angle) };
  }
  return {
    ...data,
    points: differences(Float32Array, data.points, count, 3, 1e4),
    seconds: differences(Float32Array, data.seconds, count, 1, 1e3),
    lines: differences(Uint32Array, data.lines, count, 1, 1),
    kinds: runs(Uint8Array, data.kinds, count),
    toolOf: runs(Uint8Array, data.toolOf, count),
    fileOf: runs(Uint8Array, data.fileOf, count),
    driveOf: runs(Uint16Array, data.driveOf, count),
    drives: data.drives ?? [],
    callOf: runs(Uint16Array, data.callOf, count),
    calls: data.calls ?? [[]],
    rotary,
    headings: data.headings ?? [],
    changes: data.changes ?? [],
    alarms: data.alarms ?? [],
    zeros: data.zeros ?? [],
    travel: data.travel ?? [null, null],
  };
}

/** Data without points, as decoded ones, in the units and on the kind of machine of others. */
export const withoutPoints = ({ units, lathe, diameter }) => ({
  version: VERSION, units, lathe, diameter, tools: [], files: [""], count: 0, points: new Float32Array(0), seconds: new Float32Array(0),
  lines: new Uint32Array(0), kinds: new Uint8Array(0), toolOf: new Uint8Array(0), fileOf: null, driveOf: null, drives: [], callOf: null, calls: [[]], rotary: null,
  thinned: false, cut: null, all: null,
});

/** What is a part of the work: the moves of one tool under one heading, wherever in the run. */
export function sectionsOf(d) {
  // By file: the lines at which a part begins, with the heading there.
  const starts = new Map();
  const at = (file, line) => {
    if (!starts.has(file)) starts.set(file, new Map());
    const own = starts.get(file);
    if (!own.has(line)) own.set(line, null);
    return own;
  };
  for (const [file, line] of d.changes) at(file, line);
  for (const { file, line, name } of d.headings) at(file, line).set(line, name);
  const sorted = new Map([...starts].map(([file, own]) => [file, [...own].sort((a, b) => a[0] - b[0])]));
  const found = [], byKey = new Map(), sectionOf = new Uint16Array(d.count);
  let now = 0, file = -1, line = -1, heading = null, headingLine = 0, tool = -1;
  for (let i = 0; i < d.count; i++) {
    const here = d.fileOf ? d.fileOf[i] : 0;
    if (here !== file || d.lines[i] !== line || d.toolOf[i] !== tool || i === 0) {
      [file, line, tool] = [here, d.lines[i], d.toolOf[i]];
      const own = sorted.get(file);
      // A program without parts of its own belongs to what calls it.
      if (own) {
        let low = 0, high = own.length;
        while (low < high) {
          const middle = (low + high) >> 1;
          if (own[middle][0] <= line) low = middle + 1; else high = middle;
        }
        [headingLine, heading] = low ? own[low - 1] : [0, null];
      }
      const key = `${file}:${headingLine}:${heading}:${tool}`;
      if (!byKey.has(key) && found.length < 65535) {
        byKey.set(key, found.length);
        found.push({ name: heading, tool, file, first: line, last: line, seconds: 0 });
      }
      now = byKey.get(key) ?? found.length - 1;
    }
    sectionOf[i] = now;
    const part = found[now];
    if (here === part.file) { part.first = Math.min(part.first, line); part.last = Math.max(part.last, line); }
    if (i && d.kinds[i] !== KIND.START) part.seconds += d.seconds[i] - d.seconds[i - 1];
  }
  return { sections: found, sectionOf };
}
