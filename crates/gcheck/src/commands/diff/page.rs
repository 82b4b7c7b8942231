//! Outcomes of comparisons as a page: a table, and of each pair that differs its words and both paths.
//!
//! Knows: HTML. Must not know: how paths are drawn, how outcomes come about.

use std::fmt::Write as _;

use gcheck_toolpath::plot::escaped;

use super::outcome::{Outcome, Outcomes, Verdict};

const STYLE: &str = "\
:root{color-scheme:light dark;--line:#c9d0d8;--muted:#68727d;--was:#9aa3ad;--is:#c2410c}\
@media(prefers-color-scheme:dark){:root{--line:#3a424b;--muted:#98a2ad;--was:#6b747e;--is:#fb923c}}\
body{font:15px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:75rem;padding:0 1rem}\
table{border-collapse:collapse;width:100%}th,td{text-align:left;padding:.3rem .6rem;border-bottom:1px solid var(--line)}\
pre{overflow:auto;padding:.8rem;border:1px solid var(--line);border-radius:4px;font-size:13px}\
.m{color:var(--muted);fill:var(--muted)}svg{font:12px system-ui,sans-serif;fill:currentColor}\
svg:not(.view){width:100%;height:auto}path{fill:none;stroke-width:1.2;stroke-linecap:round;stroke-linejoin:round}\
.was path{stroke:var(--was);stroke-width:2.4}.is path{stroke:var(--is)}.rapid{stroke-dasharray:5 4;opacity:.6}\
.key{display:inline-block;width:1.6rem;border-top:3px solid var(--was);vertical-align:middle}.key.is{border-color:var(--is)}";

/// The page.
pub(super) fn html(all: &Outcomes) -> String {
    let [a, b] = all.titles.each_ref().map(|title| escaped(title));
    let title = format!("{a} and {b}");
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width\">\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\
         <title>{title}</title><style>{STYLE}</style></head>\n<body><h1>{title}</h1>\n<p>{}</p>\n",
        escaped(&all.summary())
    );
    let told: Vec<(usize, &Outcome)> =
        all.pairs.iter().enumerate().filter(|(_, outcome)| outcome.verdict != Verdict::Same).collect();
    if !told.is_empty() || !all.alone.is_empty() {
        out.push_str("<table><thead><tr><th>program</th><th>what it comes to</th></tr></thead><tbody>\n");
        for (index, outcome) in &told {
            // Writing to a string cannot fail.
            let _ = writeln!(
                out,
                "<tr><td><a href=\"#p{index}\">{}</a></td><td>{}</td></tr>",
                escaped(&outcome.pair.name),
                escaped(&outcome.words())
            );
        }
        for alone in &all.alone {
            let title = all.titles.get(alone.side).map_or("", String::as_str);
            let _ = writeln!(
                out,
                "<tr><td>{}</td><td>only in {}{}</td></tr>",
                escaped(&alone.name),
                escaped(title),
                if alone.is_open() { "" } else { ", accepted" }
            );
        }
        out.push_str("</tbody></table>\n");
    }
    for (index, outcome) in told {
        let _ = writeln!(out, "<h2 id=\"p{index}\">{}</h2>", escaped(&outcome.pair.name));
        let digest = outcome.name_of_differences().map(|digest| format!(" Digest {digest}."));
        let digest = digest.unwrap_or_default();
        let _ = writeln!(out, "<p>{}{digest}</p>", escaped(&outcome.words()));
        if !outcome.text.is_empty() {
            let _ = writeln!(out, "<pre>{}</pre>", escaped_lines(&outcome.text));
        }
        if let Some(picture) = &outcome.picture {
            let _ = writeln!(
                out,
                "<p class=\"m\"><span class=\"key\"></span> {a} <span class=\"key is\"></span> {b}; dashed: rapid moves</p>\n{picture}"
            );
        }
    }
    out.push_str("</body></html>\n");
    out
}

/// Several lines for HTML.
fn escaped_lines(text: &str) -> String {
    text.split('\n').map(escaped).collect::<Vec<_>>().join("\n")
}
