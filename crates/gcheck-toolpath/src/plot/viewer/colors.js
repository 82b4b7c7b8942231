// Colours: themes, scales, and which piece of the path has which.
//
// Knows: the data of a drawing, grounds, contrast. Must not know: how pieces are drawn, elements of a page.
//
// Scales go from dark to light (or the other way on light ground) while their hue turns from violet over green to yellow, so
// that they also order in grey and for people who see few colours. Rapid moves are red and dashed whatever the rest shows.

import { KIND } from "./data.js";
import { lengthText, timeText } from "./words.js";

/** Colours, as CSS writes them. `least` is the contrast of a line to the ground (WCAG 2), `faint` how near to the ground what is still to come is. */
export const THEMES = {
  dark: { background: "#15181c", text: "#d6dbe1", muted: "#5d6773", accent: "#ffffff", rapid: "#ff5c5c", former: "#9c8abb", measure: "#ffd54a", error: "#ff6b6b", warning: "#f5b041", info: "#5dade2", least: 4.2, faint: 0.78 },
  light: { background: "#fbfbfa", text: "#23282e", muted: "#9aa3ad", accent: "#000000", rapid: "#d21f2b", former: "#a48fc6", measure: "#8a00b8", error: "#c62828", warning: "#b26a00", info: "#1565c0", least: 2.4, faint: 0.78 },
  contrast: { background: "#000000", text: "#ffffff", muted: "#b8b8b8", accent: "#ffffff", rapid: "#ff7b7b", former: "#d6b8ff", measure: "#ffff00", error: "#ff8080", warning: "#ffd080", info: "#80d0ff", least: 6, faint: 0.45 },
  contrastLight: { background: "#ffffff", text: "#000000", muted: "#555555", accent: "#000000", rapid: "#b00012", former: "#7a4aa6", measure: "#5c0080", error: "#a00000", warning: "#7a4800", info: "#003e90", least: 4.5, faint: 0.45 },
};

/** What colours may show. */
export const COLORINGS = [["tool", "Tool"], ["feed", "Feed"], ["height", "Z"], ["time", "Time"], ["spindle", "Spindle speed"]];

/** Red, green, blue from 0 to 1. */
export function rgb(css) {
  const n = parseInt(css.slice(1), 16);
  return [(n >> 16 & 255) / 255, (n >> 8 & 255) / 255, (n & 255) / 255];
}

export const css = (color) => `#${color.map((part) => Math.round(Math.min(Math.max(part, 0), 1) * 255).toString(16).padStart(2, "0")).join("")}`;

function luminance(color) {
  const [r, g, b] = color.map((part) => part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a, b) {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

const isDark = (theme) => luminance(rgb(theme.background)) < 0.18;

/** A colour moved to white or black as far as it must to be seen on the ground. */
export function onGround(color, theme) {
  const ground = rgb(theme.background), to = isDark(theme) ? 1 : 0;
  let seen = color;
  for (let part = 0.08; part < 1 && contrast(seen, ground) < theme.least; part += 0.08) {
    seen = color.map((value) => value + (to - value) * part);
  }
  return seen;
}

/** Linear light of a colour given by lightness, chroma and hue in Oklab, and whether a screen shows it. */
function oklch(lightness, chroma, degrees) {
  const a = chroma * Math.cos(degrees * Math.PI / 180), b = chroma * Math.sin(degrees * Math.PI / 180);
  const [l, m, s] = [
    lightness + 0.3963377774 * a + 0.2158037573 * b, lightness - 0.1055613458 * a - 0.0638541728 * b, lightness - 0.0894841775 * a - 1.291485548 * b,
  ].map((root) => root ** 3);
  return [
    4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
    -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
    -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
  ];
}

/** The colour of a place on the scale, 0 to 1. */
export function scaleColor(part, theme) {
  const [low, high] = isDark(theme) ? [theme.least > 4.3 ? 0.62 : 0.5, 0.95] : [theme.least > 4.3 ? 0.22 : 0.3, theme.least > 4.3 ? 0.55 : 0.76];
  const lightness = low + (high - low) * part, hue = 305 - 205 * part;
  for (let chroma = 0.17; chroma > 0; chroma -= 0.01) {
    const linear = oklch(lightness, chroma, hue);
    if (linear.every((value) => value >= 0 && value <= 1)) {
      return linear.map((value) => value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);
    }
  }
  return [lightness, lightness, lightness];
}

/** Entries of the palette that a scale has; after them what is unknown. */
export const SCALE = 254;
const UNKNOWN = 254;
/** Up to so many values have their own rows in the legend. */
const MOST_ROWS = 8;

const unknownColor = (theme) => onGround([0.55, 0.55, 0.55], theme);

function paletteOf(colors) {
  const bytes = new Uint8Array(256 * 4);
  colors.forEach((color, i) => bytes.set([...color.map((part) => Math.round(part * 255)), 255], 4 * i));
  return bytes;
}

function scalePalette(theme) {
  const colors = [];
  for (let i = 0; i < SCALE; i++) colors.push(scaleColor(i / (SCALE - 1), theme));
  return paletteOf([...colors, unknownColor(theme)]);
}

/** Round values from `low` to `high`, the ends among them. */
function ticks(low, high, words) {
  const all = [0, 0.25, 0.5, 0.75, 1].map((at) => ({ at, words: words(low + (high - low) * at) }));
  return all.filter((tick, i) => all.findIndex((other) => other.words === tick.words) === i);
}

function scaleLegend(title, low, high, theme, words) {
  const colors = [0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1].map((at) => css(scaleColor(at, theme)));
  return { title, rows: [], colors, ticks: ticks(low, high, words) };
}

/** Colours by a number of each piece, given by its drive; few values have rows, many a scale. */
function byDrive(d, theme, title, valueOf, words, counts) {
  const values = d.drives.map(valueOf), used = new Set();
  let isUnknown = false;
  for (let i = 1; i < d.count; i++) {
    if (!counts(d.kinds[i])) continue;
    const value = values[d.driveOf[i]];
    if (value === null || value === undefined) isUnknown = true; else used.add(value);
  }
  const sorted = [...used].sort((a, b) => a - b), [low, high] = [sorted[0] ?? 0, sorted.at(-1) ?? 0];
  const isFew = sorted.length <= MOST_ROWS;
  // Few values are as far apart in colour as can be; many are where they are on the scale.
  const place = (value) => isFew ? (sorted.length > 1 ? sorted.indexOf(value) / (sorted.length - 1) : 0.5) : (value - low) / (high - low);
  const ofDrive = values.map((value) => value === null || value === undefined || !used.has(value) ? UNKNOWN : Math.round(place(value) * (SCALE - 1)));
  const legend = isFew ? { title, rows: sorted.map((value) => ({ color: css(scaleColor(place(value), theme)), words: words(value) })), colors: [], ticks: [] }
    : scaleLegend(title, low, high, theme, words);
  if (isUnknown) legend.rows.push({ color: css(unknownColor(theme)), words: "unknown" });
  return { toneOf: (i) => ofDrive[d.driveOf[i]] ?? UNKNOWN, palette: scalePalette(theme), heights: null, legend };
}

const isCut = (kind) => kind !== KIND.START && kind !== KIND.RAPID;

/** Which colourings the data allow. */
export function coloringsOf(d) {
  const has = (key) => d.driveOf !== null && d.drives.some((drive) => drive[key] !== null);
  return COLORINGS.filter(([name]) => name === "feed" ? has("along") : name === "spindle" ? has("rpm") : true);
}

/** Tones of pieces, the palette that they are entries of, and the legend. `heights` is set where the tone follows from Z. */
export function coloring(d, name, theme) {
  const perMinute = d.units === "inch" ? 25.4 : 1, unit = d.units === "inch" ? "inch" : "mm";
  switch (name) {
    case "feed": {
      const words = (value) => `${+(value / perMinute).toPrecision(4)}`;
      return byDrive(d, theme, `Feed along the path, ${unit}/min`, (drive) => drive.along, words, isCut);
    }
    case "spindle":
      return byDrive(d, theme, "Spindle, turns/min", (drive) => drive.rpm, (value) => `${+value.toPrecision(4)}`, isCut);
    case "height": {
      const box = d.cut ?? d.all ?? [[0, 0, 0], [0, 0, 0]], [low, high] = [box[0][2], Math.max(box[1][2], box[0][2] + 1e-6)];
      const legend = scaleLegend(`Z, ${unit}`, low, high, theme, (value) => lengthText(value, d.units));
      return { toneOf: () => 0, palette: scalePalette(theme), heights: [low, high], legend };
    }
    case "time": {
      const end = d.count ? d.seconds[d.count - 1] || 1 : 1;
      const legend = scaleLegend("Time, min:s", 0, end, theme, timeText);
      const tone = (i) => Math.round(Math.min((d.seconds[i] + d.seconds[i - 1]) / 2 / end, 1) * (SCALE - 1));
      return { toneOf: (i) => i ? tone(i) : 0, palette: scalePalette(theme), heights: null, legend };
    }
    default: {
      const colors = d.tools.slice(0, 256).map((tool) => onGround(rgb(tool.color), theme));
      return { toneOf: (i) => d.toolOf[i], palette: paletteOf(colors), heights: null, legend: { title: "", rows: [], colors: [], ticks: [] } };
    }
  }
}
