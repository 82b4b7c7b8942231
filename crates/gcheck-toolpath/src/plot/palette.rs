//! Colours of tools.
//!
//! Knows: which colours are told apart on light and on dark ground. Must not know: what is coloured.

/// Of middling lightness, neighbours far apart in hue.
const COLORS: [&str; 12] = [
    "#2f8fdd", "#e8743b", "#1fa187", "#c94fbf", "#b39a16", "#6f6ae0", "#d64550", "#4b9e3f", "#0fa3b1",
    "#a0703c", "#8f5fb0", "#7d8894",
];

/// The colour of a tool by its place in the list of tools; colours come again when there are many.
pub(super) fn color(index: usize) -> &'static str {
    COLORS.get(index % COLORS.len()).copied().unwrap_or("#808080")
}
