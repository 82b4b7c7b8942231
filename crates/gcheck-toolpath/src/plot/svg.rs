//! A drawing as SVG: views from the main directions beside each other, as on a workshop drawing.
//!
//! Knows: views, layout, SVG's syntax. Must not know: how paths come about.

use std::fmt::Write as _;

use gcheck_engine::Units;

use super::drawing::{Drawing, Kind, Point};
use super::note::Note;
use super::thin;
use crate::number;
use crate::summary::Names;

/// Points drawn in each view. More are thinned.
const MAX_POINTS: usize = 50_000;
/// Around everything, pixels.
const MARGIN: f64 = 56.0;
/// Between views: room for titles and sizes.
const GAP: f64 = 76.0;
/// Most that views beside each other, and above each other, cover.
const MOST: [f64; 2] = [1_060.0, 760.0];

const STYLE: &str = "\
svg:not(.view){background:#fff;font:12px system-ui,sans-serif;fill:#23282e;--line:#9aa3ad}\
path{fill:none;stroke-width:1.2;stroke-linecap:round;stroke-linejoin:round}\
.rapid{stroke-dasharray:5 4;stroke-width:.8;opacity:.75}.probe{stroke-dasharray:1 3}\
.box{fill:none;stroke:var(--line);stroke-width:.8;stroke-dasharray:2 3}\
.axis{stroke:var(--line);stroke-dasharray:14 4 3 4;stroke-width:.8}\
.zero{stroke-width:1.4}.h{font-size:15px;font-weight:600}.m{fill:#6b747e}\
@media(prefers-color-scheme:dark){svg:not(.view){background:#15181c;fill:#d6dbe1;--line:#5d6773}.m{fill:#98a2ad}}";

/// From where one looks.
#[derive(Debug, Clone, Copy)]
struct Look {
    title: &'static str,
    /// To the right on the paper, and up.
    right: [f64; 3],
    up: [f64; 3],
}

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];
const TOP: Look = Look { title: "XY, from above", right: X, up: Y };
const FRONT: Look = Look { title: "XZ, from the front", right: X, up: Z };
const SIDE: Look = Look { title: "YZ, from the right", right: Y, up: Z };
const LATHE: Look = Look { title: "ZX", right: Z, up: X };
const FACE: Look = Look { title: "XY, along the spindle", right: X, up: Y };
const ISOMETRIC: Look = Look {
    title: "isometric",
    right: [std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2, 0.0],
    up: [-0.408_248_290_463_863, 0.408_248_290_463_863, 0.816_496_580_927_726],
};

impl Look {
    fn of(&self, point: [f64; 3]) -> [f64; 2] {
        [self.right, self.up].map(|way| way.iter().zip(point).map(|(part, value)| part * value).sum())
    }

    /// The rectangle that a box covers: smallest and largest.
    fn rectangle(&self, [low, high]: [[f64; 3]; 2]) -> [[f64; 2]; 2] {
        let mut rectangle = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
        for corner in 0..8_u8 {
            let mut ends = low.iter().zip(high).enumerate();
            let at = [(); 3].map(|()| match ends.next() {
                Some((axis, (low, high))) => {
                    if corner >> axis & 1 == 0 {
                        *low
                    } else {
                        high
                    }
                }
                None => 0.0,
            });
            for ((least, most), value) in halves(&mut rectangle).zip(self.of(at)) {
                *least = least.min(value);
                *most = most.max(value);
            }
        }
        rectangle
    }

    /// The axis that a way of the paper shows, if it is one.
    fn axis(way: [f64; 3]) -> Option<usize> {
        way.iter().position(|part| *part >= 1.0)
    }
}

fn halves(rectangle: &mut [[f64; 2]; 2]) -> impl Iterator<Item = (&mut f64, &mut f64)> {
    let [low, high] = rectangle;
    low.iter_mut().zip(high.iter_mut())
}

/// A view on its place of the paper.
#[derive(Debug, Clone, Copy)]
struct Panel {
    look: Look,
    /// Left upper corner, and size.
    at: [f64; 2],
    size: [f64; 2],
    /// Pixels a millimetre.
    scale: f64,
    /// What is in the middle, in the coordinates of the look.
    middle: [f64; 2],
}

impl Panel {
    fn on_paper(&self, [right, up]: [f64; 2]) -> [f64; 2] {
        let [x, y] = self.at;
        let [width, height] = self.size;
        let [middle_right, middle_up] = self.middle;
        [
            x + width / 2.0 + (right - middle_right) * self.scale,
            y + height / 2.0 - (up - middle_up) * self.scale,
        ]
    }
}

impl Drawing {
    /// Is this the work of a lathe, which is drawn with Z to the right and X up?
    pub(super) fn is_lathe(&self) -> bool {
        self.lathe
    }

    /// The drawing as an SVG file. `title` is above it, `further` notes below those of the drawing.
    pub fn to_svg(&self, title: &str, further: &[Note], names: &Names<'_>) -> String {
        let mut notes = self.notes();
        notes.extend_from_slice(further);
        let mut points = std::borrow::Cow::Borrowed(self.points.as_slice());
        if points.len() > MAX_POINTS {
            let before = points.len();
            thin::to(points.to_mut(), MAX_POINTS);
            notes.push(format!("each view is drawn with {} of {before} points", points.len()).into());
        }
        let panels = panels(near(self.all, self.cut), self.is_lathe());
        let right = panels.iter().map(|panel| panel.at[0] + panel.size[0]).fold(600.0, f64::max);
        let bottom = panels.iter().map(|panel| panel.at[1] + panel.size[1]).fold(80.0, f64::max);
        let mut body = String::new();
        for panel in &panels {
            self.panel(&mut body, panel, &points);
        }
        let legend_at = bottom + GAP;
        let end = self.legend(&mut body, legend_at, right, &notes, names);
        let (width, height) = (right + MARGIN, end + 24.0);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" viewBox=\"0 0 {width:.0} {height:.0}\">\n<style>{STYLE}</style>\n"
        );
        // Writing to a string cannot fail.
        let _ = writeln!(svg, "<title>{}</title>", escaped(title));
        text(&mut svg, [MARGIN, 32.0], "h", &escaped(title));
        svg.push_str(&body);
        svg.push_str("</svg>\n");
        svg
    }

    /// This path, in grey, with a later one over it, as an SVG element: what of the first shows is not in the second.
    pub fn overlaid(&self, later: &Self) -> String {
        let shown = both(near(self.all, self.cut), near(later.all, later.cut));
        let panels = panels(shown, self.is_lathe());
        let right = panels.iter().map(|panel| panel.at[0] + panel.size[0]).fold(200.0, f64::max);
        let bottom = panels.iter().map(|panel| panel.at[1] + panel.size[1]).fold(80.0, f64::max);
        let (width, height) = (right + MARGIN, bottom + MARGIN);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" role=\"img\">\n"
        );
        for panel in &panels {
            text(&mut svg, [panel.at[0], panel.at[1] - 26.0], "m", panel.look.title);
            open_view(&mut svg, panel);
            for (class, drawing) in [("was", self), ("is", later)] {
                // Writing to a string cannot fail.
                let _ = writeln!(svg, "<g class=\"{class}\">");
                let mut points = std::borrow::Cow::Borrowed(drawing.points.as_slice());
                if points.len() > MAX_POINTS {
                    thin::to(points.to_mut(), MAX_POINTS);
                }
                drawing.paths(&mut svg, panel, &points);
                svg.push_str("</g>\n");
            }
            svg.push_str("</svg>\n");
            zero(&mut svg, panel);
        }
        svg.push_str("</svg>\n");
        svg
    }

    fn panel(&self, svg: &mut String, panel: &Panel, points: &[Point]) {
        let ([x, y], [width, _]) = (panel.at, panel.size);
        text(svg, [x, y - 26.0], "m", panel.look.title);
        if let Some(cut) = self.cut {
            self.extents(svg, panel, cut);
        }
        open_view(svg, panel);
        if self.lathe {
            let [_, axis] = panel.on_paper([0.0, 0.0]);
            let _ =
                writeln!(svg, "<path class=\"axis\" d=\"M{:.1} {axis:.1}h{:.1}\"/>", x - 6.0, width + 12.0);
        }
        self.paths(svg, panel, points);
        self.alarms(svg, panel);
        svg.push_str("</svg>\n");
        zero(svg, panel);
    }

    /// A red cross where the control would stop.
    fn alarms(&self, svg: &mut String, panel: &Panel) {
        for at in self.alarms.iter().filter_map(|alarm| alarm.at) {
            let [x, y] = panel.on_paper(panel.look.of(at.map(f64::from)));
            let (x, y) = (x - 6.0, y - 6.0);
            // Writing to a string cannot fail.
            let _ = writeln!(
                svg,
                "<path stroke=\"#c62828\" stroke-width=\"2.5\" d=\"M{x:.1} {y:.1}l12 12m-12 0l12 -12\"/>"
            );
        }
    }

    /// The box of what is cut, with its sizes.
    fn extents(&self, svg: &mut String, panel: &Panel, cut: [[f64; 3]; 2]) {
        let [low, high] = panel.look.rectangle(cut);
        let ([left, bottom], [right, top]) = (panel.on_paper(low), panel.on_paper(high));
        let (across, down) = (Look::axis(panel.look.right), Look::axis(panel.look.up));
        let (Some(across), Some(down)) = (across, down) else { return };
        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<rect class=\"box\" x=\"{left:.2}\" y=\"{top:.2}\" width=\"{:.2}\" height=\"{:.2}\"/>",
            right - left,
            bottom - top
        );
        let words = |axis: usize| {
            let [low, high] = cut.map(|end| end.get(axis).copied().unwrap_or(0.0));
            let size = if axis == 0 && self.view.has_diameters() { 2.0 } else { 1.0 };
            let name = ["X", "Y", "Z"].get(axis).copied().unwrap_or_default();
            format!("{name} {} to {}", self.length(low * size), self.length(high * size))
        };
        let middle = f64::midpoint(left, right);
        let under = bottom.max(panel.at[1] + panel.size[1]) + 18.0;
        let _ = writeln!(
            svg,
            "<text x=\"{middle:.1}\" y=\"{under:.1}\" text-anchor=\"middle\">{}</text>",
            words(across)
        );
        let (beside, middle) = (left.min(panel.at[0]) - 10.0, f64::midpoint(top, bottom));
        let is_long = bottom - top > 130.0;
        let _ = if is_long {
            writeln!(
                svg,
                "<text transform=\"translate({beside:.1} {middle:.1})rotate(-90)\" text-anchor=\"middle\">{}</text>",
                words(down)
            )
        } else {
            // No room along the side: the words go above.
            writeln!(
                svg,
                "<text x=\"{left:.1}\" y=\"{:.1}\">{}</text>",
                top.min(panel.at[1]) - 8.0,
                words(down)
            )
        };
    }

    fn paths(&self, svg: &mut String, panel: &Panel, points: &[Point]) {
        let mut lines: Vec<Line> = Vec::new();
        lines.resize_with(self.tools.len() * CLASSES.len(), Line::default);
        let on_paper = |point: &Point| panel.on_paper(panel.look.of(point.at.map(f64::from)));
        let mut before: Option<&Point> = None;
        for (ix, point) in points.iter().enumerate() {
            let class = match point.kind {
                Kind::Start => None,
                Kind::Rapid => Some(0),
                Kind::Feed | Kind::Arc | Kind::Spindle => Some(1),
                Kind::Probe => Some(2),
            };
            let line = class.and_then(|class| lines.get_mut(usize::from(point.tool) * CLASSES.len() + class));
            if let (Some(line), Some(before)) = (line, before) {
                line.piece(ix, on_paper(before), on_paper(point));
            }
            before = Some(point);
        }
        // Rapid moves lie under what is cut.
        for (class, name) in CLASSES.into_iter().enumerate() {
            for (line, tool) in lines.iter().skip(class).step_by(CLASSES.len()).zip(&self.tools) {
                if !line.text.is_empty() {
                    let _ = writeln!(
                        svg,
                        "<path class=\"{name}\" stroke=\"{}\" d=\"{}\"/>",
                        tool.color, line.text
                    );
                }
            }
        }
    }

    fn legend(&self, svg: &mut String, top: f64, right: f64, notes: &[Note], names: &Names<'_>) -> f64 {
        let (mut x, mut y) = (MARGIN, top);
        let mut entry = |svg: &mut String, line: &str, words: &str| {
            let width = 48.0 + 7.2 * f64::from(words.chars().count() as u32);
            if x > MARGIN && x + width > right {
                (x, y) = (MARGIN, y + 22.0);
            }
            let _ = writeln!(svg, "<path {line} d=\"M{x:.0} {:.0}h24\"/>", y - 4.0);
            text(svg, [x + 32.0, y], "", &escaped(words));
            x += width;
            y
        };
        let mut bottom = top;
        for tool in &self.tools {
            let words = tool.words(tool.number.and_then(names.tool).as_deref());
            bottom = entry(svg, &format!("stroke=\"{}\" stroke-width=\"2.5\"", tool.color), &words);
        }
        if !self.tools.is_empty() {
            entry(svg, "class=\"rapid\" stroke=\"#7d8894\"", "rapid moves");
            bottom = entry(svg, "class=\"box\"", &format!("extents of what is cut, {}", self.units_name()));
        }
        for note in notes {
            bottom += 22.0;
            text(svg, [MARGIN, bottom], "m", &escaped(&note.words));
        }
        bottom
    }

    fn units_name(&self) -> &'static str {
        match self.units {
            Units::Inch => "inch",
            Units::Mm => "mm",
        }
    }

    /// A coordinate in the units shown.
    fn length(&self, mm: f64) -> String {
        let mut out = Vec::new();
        match self.units {
            Units::Inch => number::brief(&mut out, mm / 25.4, 4, "?"),
            Units::Mm => number::brief(&mut out, mm, 3, "?"),
        }
        String::from_utf8_lossy(&out).into_owned()
    }
}

/// Begins the frame of a view, which cuts off what goes far away.
fn open_view(svg: &mut String, panel: &Panel) {
    let ([x, y], [width, height]) = (panel.at, panel.size);
    // Writing to a string cannot fail.
    let _ = writeln!(
        svg,
        "<svg class=\"view\" x=\"{0:.1}\" y=\"{1:.1}\" width=\"{2:.1}\" height=\"{3:.1}\" viewBox=\"{0:.1} {1:.1} {2:.1} {3:.1}\">",
        x - 6.0,
        y - 6.0,
        width + 12.0,
        height + 12.0
    );
}

/// Where the views of what lies in these bounds are on the paper.
fn panels(shown: Option<[[f64; 3]; 2]>, is_lathe: bool) -> Vec<Panel> {
    let Some(mut shown) = shown else { return Vec::new() };
    // The zero is drawn as well where it is near.
    let sides: Vec<f64> = three_halves(&mut shown).map(|(low, high)| *high - *low).collect();
    let largest = sides.into_iter().fold(1e-6, f64::max);
    let is_near = three_halves(&mut shown).all(|(low, high)| *low < largest && *high > -largest);
    if is_near {
        for (low, high) in three_halves(&mut shown) {
            *low = low.min(0.0);
            *high = high.max(0.0);
        }
    }
    let [[x0, y0, z0], [x1, y1, z1]] = shown;
    let least = largest * 1e-3;
    let (x, y, z) = ((x1 - x0).max(least), (y1 - y0).max(least), (z1 - z0).max(least));
    let place = |look: Look, at: [f64; 2], size: [f64; 2], scale: Option<f64>| {
        let [[left, bottom], [right, top]] = look.rectangle(shown);
        let scale = scale.unwrap_or_else(|| {
            let [width, height] = size;
            (width / (right - left).max(least)).min(height / (top - bottom).max(least))
        });
        Panel { look, at, size, scale, middle: [f64::midpoint(left, right), f64::midpoint(bottom, top)] }
    };
    let top = 92.0;
    if is_lathe {
        let with_face = y1 - y0 > least;
        let scale = (MOST[0] / (z + if with_face { x } else { 0.0 })).min(MOST[1] / x.max(y));
        let size = [z * scale, (x * scale).max(40.0)];
        let mut panels = vec![place(LATHE, [MARGIN, top], size, Some(scale))];
        if with_face {
            let face = [x * scale, (y * scale).max(40.0)];
            panels.push(place(FACE, [MARGIN + size[0] + GAP, top], face, Some(scale)));
        }
        return panels;
    }
    if z1 - z0 < least {
        let scale = (MOST[0] / x).min(MOST[1] / y);
        return vec![place(TOP, [MARGIN, top], [x * scale, y * scale], Some(scale))];
    }
    let scale = (MOST[0] / (x + y.max(0.4 * x))).min(MOST[1] / (y + z));
    let columns = [(x * scale).max(200.0), (y * scale).max(320.0)];
    let rows = [(y * scale).max(200.0), (z * scale).max(40.0)];
    let (second, below) = (MARGIN + columns[0] + GAP, top + rows[0] + GAP);
    vec![
        place(TOP, [MARGIN, top], [columns[0], rows[0]], Some(scale)),
        place(FRONT, [MARGIN, below], [columns[0], rows[1]], Some(scale)),
        place(SIDE, [second, below], [columns[1], rows[1]], Some(scale)),
        place(ISOMETRIC, [second, top], [columns[1], rows[0]], None),
    ]
}

/// What is cut, with as much of the way there as lies near: a retract to the end of the machine would leave a dot of the
/// part.
fn near(all: Option<[[f64; 3]; 2]>, cut: Option<[[f64; 3]; 2]>) -> Option<[[f64; 3]; 2]> {
    let all = all?;
    let Some(mut near) = cut else { return Some(all) };
    let around = three_halves(&mut near).map(|(low, high)| *high - *low).fold(0.0, f64::max) / 4.0;
    let [lowest, highest] = all;
    for ((low, high), (lowest, highest)) in three_halves(&mut near).zip(lowest.into_iter().zip(highest)) {
        *low = (*low - around).max(lowest);
        *high = (*high + around).min(highest);
    }
    Some(near)
}

/// Bounds around both.
fn both(a: Option<[[f64; 3]; 2]>, b: Option<[[f64; 3]; 2]>) -> Option<[[f64; 3]; 2]> {
    let (Some(mut all), Some([low, high])) = (a, b) else { return a.or(b) };
    for ((least, most), (low, high)) in three_halves(&mut all).zip(low.into_iter().zip(high)) {
        *least = least.min(low);
        *most = most.max(high);
    }
    Some(all)
}

fn three_halves(bounds: &mut [[f64; 3]; 2]) -> impl Iterator<Item = (&mut f64, &mut f64)> {
    let [low, high] = bounds;
    low.iter_mut().zip(high.iter_mut())
}

/// Classes of lines, in the order in which they are drawn.
const CLASSES: [&str; 3] = ["rapid", "cut", "probe"];

/// The pieces of one tool and class as the data of a path.
#[derive(Debug, Default)]
struct Line {
    text: String,
    /// The piece that was written last, and where it ends.
    last: Option<(usize, [f64; 2])>,
}

impl Line {
    fn piece(&mut self, ix: usize, from: [f64; 2], to: [f64; 2]) {
        let is_short = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).abs() < 0.05 && (a[1] - b[1]).abs() < 0.05;
        // Writing to a string cannot fail.
        let _ = match self.last {
            Some((before, at)) if before + 1 == ix => {
                if is_short(at, to) {
                    self.last = Some((ix, at));
                    return;
                }
                write!(self.text, "L{:.2} {:.2}", to[0], to[1])
            }
            // A move toward the eye is a dot.
            _ if is_short(from, to) => write!(self.text, "M{:.2} {:.2}h0", from[0], from[1]),
            _ => write!(self.text, "M{:.2} {:.2}L{:.2} {:.2}", from[0], from[1], to[0], to[1]),
        };
        self.last = Some((ix, to));
    }
}

/// The zero with its axes, where it is on the paper.
fn zero(svg: &mut String, panel: &Panel) {
    let [x, y] = panel.on_paper([0.0, 0.0]);
    let inside = |value: f64, from: f64, size: f64| value > from - 12.0 && value < from + size + 12.0;
    if !inside(x, panel.at[0], panel.size[0]) || !inside(y, panel.at[1], panel.size[1]) {
        return;
    }
    for (ix, (name, color)) in [("X", "#d0382b"), ("Y", "#1e8c4a"), ("Z", "#2f6fd6")].into_iter().enumerate()
    {
        let [right, up] = [panel.look.right, panel.look.up].map(|way| way.get(ix).copied().unwrap_or(0.0));
        if right.hypot(up) < 0.1 {
            continue;
        }
        let end = |by: f64| [x + right * by, y - up * by];
        let ([to_x, to_y], [word_x, word_y]) = (end(24.0), end(34.0));
        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<path class=\"zero\" stroke=\"{color}\" d=\"M{x:.1} {y:.1}L{to_x:.1} {to_y:.1}\"/>\
             <text x=\"{word_x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" style=\"fill:{color}\">{name}</text>",
            word_y + 4.0
        );
    }
}

fn text(svg: &mut String, [x, y]: [f64; 2], class: &str, words: &str) {
    let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
    // Writing to a string cannot fail.
    let _ = writeln!(svg, "<text x=\"{x:.1}\" y=\"{y:.1}\"{class}>{words}</text>");
}

/// Text for XML and HTML; XML has no control characters at all.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '&' => out.push_str("&amp;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}
