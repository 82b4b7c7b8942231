// Two things to write and draw on: a canvas, and the text of an SVG picture.
//
// Knows: lines, words, discs in pixels. Must not know: what they mean.
//
// Both have `line(points, style)` with style { color, width, dash, opacity }, `text(words, at, style)` with { color, align },
// `disc(at, radius, style)` with { fill, color, width }, and `width(words)`. Words have a field in the colour of the ground, so
// that a line under them is not read as a sign.

/** How much of what is under words is hidden. */
const FIELD = 0.85;

/** The field of words of a width at a place. */
function fieldOf(width, x, y, align) {
  const left = align === "left" ? x : align === "right" ? x - width : x - width / 2;
  return [left - 2, y - 8, width + 4, 16];
}

const FONT = "12px system-ui, sans-serif";

/** The context of a canvas as paper. */
export function canvasPaper(context, ground) {
  const stroke = (color, width, dash, opacity) => {
    context.strokeStyle = color;
    context.lineWidth = width;
    context.globalAlpha = opacity;
    context.setLineDash(dash);
    context.stroke();
    context.setLineDash([]);
    context.globalAlpha = 1;
  };
  context.font = FONT;
  return {
    line(points, { color, width = 1, dash = [], opacity = 1 }) {
      context.beginPath();
      points.forEach(([x, y], i) => i ? context.lineTo(x, y) : context.moveTo(x, y));
      stroke(color, width, dash, opacity);
    },
    text(words, [x, y], { color, align = "center" }) {
      context.textAlign = align;
      context.textBaseline = "middle";
      const [left, top, wide, high] = fieldOf(context.measureText(words).width, x, y, align);
      context.globalAlpha = FIELD;
      context.fillStyle = ground;
      context.fillRect(left, top, wide, high);
      context.globalAlpha = 1;
      context.fillStyle = color;
      context.fillText(words, x, y);
    },
    disc([x, y], radius, { fill, color, width = 1 }) {
      context.beginPath();
      context.arc(x, y, radius, 0, 2 * Math.PI);
      if (fill) { context.fillStyle = fill; context.fill(); }
      if (color) stroke(color, width, [], 1);
    },
    width: (words) => context.measureText(words).width,
  };
}

const number = (value) => String(+value.toFixed(2));
const escaped = (text) => text.replace(/[&<>"]/g, (sign) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[sign]);

/** An SVG picture as paper; `finish` gives its text. */
export function svgPaper(width, height, ground, title, measure) {
  const parts = [];
  return {
    line(points, { color, width: thick = 1, dash = [], opacity = 1 }) {
      const way = points.map(([x, y], i) => `${i ? "L" : "M"}${number(x)} ${number(y)}`).join("");
      parts.push(`<path d="${way}" stroke="${color}" stroke-width="${thick}"${dash.length ? ` stroke-dasharray="${dash.join(" ")}"` : ""}${opacity < 1 ? ` opacity="${opacity}"` : ""}/>`);
    },
    text(words, [x, y], { color, align = "center" }) {
      const [left, top, wide, high] = fieldOf(measure(words), x, y, align).map(number);
      parts.push(`<rect x="${left}" y="${top}" width="${wide}" height="${high}" fill="${ground}" opacity="${FIELD}"/>`);
      const anchor = { center: "middle", left: "start", right: "end" }[align];
      parts.push(`<text x="${number(x)}" y="${number(y)}" text-anchor="${anchor}" fill="${color}">${escaped(words)}</text>`);
    },
    disc([x, y], radius, { fill, color, width: thick = 1 }) {
      parts.push(`<circle cx="${number(x)}" cy="${number(y)}" r="${radius}" fill="${fill ?? "none"}"${color ? ` stroke="${color}" stroke-width="${thick}"` : ""}/>`);
    },
    width: measure,
    finish: () => [
      `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" fill="none" stroke-linecap="round" stroke-linejoin="round" font-family="system-ui, sans-serif" font-size="12">`,
      `<title>${escaped(title)}</title>`,
      `<style>text{dominant-baseline:central}</style>`,
      `<rect width="${width}" height="${height}" fill="${ground}"/>`,
      ...parts, "</svg>", "",
    ].join("\n"),
  };
}
