// Numbers as people read them: lengths, times, feeds, where the tool is.
//
// Knows: the data of a drawing, units. Must not know: elements of a page, how anything is drawn.

/** A length in the units shown, without a sign for zero. */
export function lengthText(mm, units) {
  const text = units === "inch" ? (mm / 25.4).toFixed(4) : mm.toFixed(3);
  return /^-0\.0*$/.test(text) ? text.slice(1) : text;
}

/** `1:23`, or `2:19:58` from an hour on. */
export function timeText(seconds) {
  const whole = Math.round(seconds), pad = (n) => String(n).padStart(2, "0");
  const [hours, minutes] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60];
  return hours ? `${hours}:${pad(minutes)}:${pad(whole % 60)}` : `${minutes}:${pad(whole % 60)}`;
}

/** X, Y, Z; without Y where a lathe does not move it. */
export function axesOf(d) {
  return [0, 1, 2].filter((axis) => axis !== 1 || !d.lathe || d.all?.some((end) => end[1] !== 0));
}

/** A coordinate as it is shown: X of a lathe as a diameter. */
export const coordinateText = (d, value, axis) => lengthText(axis === 0 && d.diameter ? 2 * value : value, d.units);

/** What a tool is called: `T3 END MILL 8`. */
export function toolText(tool) {
  const number = tool.number === null ? "unknown tool" : tool.number === 0 ? "no tool" : `T${tool.number}`;
  return tool.name ? `${number} ${tool.name}` : number;
}

/** The feed of a place with its unit, as the program has it. */
export function feedText(d, drive) {
  if (!drive || drive.feed === null) return null;
  const unit = d.units === "inch" ? "inch" : "mm", value = +(drive.feed / (unit === "inch" && drive.mode !== "inverse" ? 25.4 : 1)).toPrecision(6);
  return `F${value} ${{ minute: `${unit}/min`, turn: `${unit}/turn`, inverse: "moves/min" }[drive.mode]}`;
}

const speedText = (drive) => !drive || drive.rpm === null ? null : drive.rpm === 0 ? "spindle off" : `S${+drive.rpm.toPrecision(5)}`;
const KIND_WORDS = ["", "rapid", "feed", "arc", "probe", "with the spindle"];
const RAPID_KIND = 1;

/** What is known of a place, each part with what it is: `{ is, words }`. */
export function placeText(d, place, duration) {
  const axes = axesOf(d).map((axis) => `${"XYZ"[axis]}${coordinateText(d, place.point[axis], axis)}`);
  const angles = place.angles.map(({ axis, degrees }) => `${axis}${Number.isFinite(degrees) ? +degrees.toFixed(3) : "?"}`);
  const parts = [
    ["line", `line ${place.line}`],
    ["kind", KIND_WORDS[place.kind]],
    ["point", [...axes, ...angles].join(" ")],
    ["feed", place.kind === RAPID_KIND ? null : feedText(d, place.drive)],
    ["speed", speedText(place.drive)],
    ["tool", place.tool?.number == null ? null : `T${place.tool.number}`],
    ["time", timeText(place.seconds)],
    ["left", `${timeText(Math.max(duration - place.seconds, 0))} left`],
  ];
  return parts.filter(([, words]) => words).map(([is, words]) => ({ is, words }));
}

/** Speeds of play for a run: factors, and the whole run in a minute. `usual` shows a long run in less than that. */
export function speedsFor(duration) {
  const factors = [0.5, 1, 2, 5, 10, 20, 50, 100, 500, 1000];
  const usual = factors.find((factor) => duration / factor <= 40) ?? Math.max(duration / 60, 1);
  const speeds = factors.map((factor) => ({ factor, words: `${factor}×`, usual: factor === usual }));
  return [...speeds, { factor: Math.max(duration / 60, 0.01), words: "all in 1 min", usual: !factors.includes(usual) }];
}
