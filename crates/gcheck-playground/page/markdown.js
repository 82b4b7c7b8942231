// The few forms of Markdown that gcheck writes, as elements.
//
// Knows: paragraphs, rules, lists, tables, `code`, **strong**, *emphasis* and [links](…). Must not know: what is written. What
// is none of these is text; no text becomes markup, and a link leads to https only.

const make = (name, ...children) => {
  const element = document.createElement(name);
  element.append(...children);
  return element;
};

const INLINE = /(`+)(.+?)\1|\*\*(.+?)\*\*|\*(?=\S)(.+?)\*|\[([^\]]+)\]\((https:\/\/[^\s)]+)\)|\\([\\`*_[\]<>#|])/gs;

function inline(text) {
  const parts = [];
  let end = 0;
  for (const found of text.matchAll(INLINE)) {
    const [all, , code, strong, emphasis, words, address, sign] = found;
    parts.push(text.slice(end, found.index));
    end = found.index + all.length;
    if (code !== undefined) parts.push(make("code", code));
    else if (strong !== undefined) parts.push(make("strong", ...inline(strong)));
    else if (emphasis !== undefined) parts.push(make("em", ...inline(emphasis)));
    else if (address !== undefined) {
      const link = make("a", ...inline(words));
      Object.assign(link, { href: address, target: "_blank", rel: "noopener" });
      parts.push(link);
    } else parts.push(sign);
  }
  parts.push(text.slice(end));
  return parts.filter((part) => part !== "");
}

const cells = (row) => row.trim().replace(/^\||\|$/g, "").split(/(?<!\\)\|/).map((cell) => cell.trim());

function table([head, , ...rows]) {
  const row = (text, name) => make("tr", ...cells(text).map((cell) => make(name, ...inline(cell))));
  return make("table", make("thead", row(head, "th")), make("tbody", ...rows.map((text) => row(text, "td"))));
}

/** Elements for a text in Markdown. */
export function markdown(text) {
  return text.split(/\n{2,}/).flatMap((block) => {
    const lines = block.split("\n").filter((line) => line.trim() !== "");
    if (!lines.length) return [];
    if (lines.length === 1 && /^-{3,}$/.test(lines[0].trim())) return [make("hr")];
    if (lines.length > 1 && lines[0].startsWith("|") && /^[|\s:-]+$/.test(lines[1])) return [table(lines)];
    if (lines.every((line) => /^[-*] /.test(line))) return [make("ul", ...lines.map((line) => make("li", ...inline(line.slice(2)))))];
    return [make("p", ...lines.flatMap((line, i) => (i ? [make("br"), ...inline(line)] : inline(line))))];
  });
}
