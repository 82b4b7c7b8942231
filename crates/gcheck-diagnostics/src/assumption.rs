//! An assumption that a result rests on, in words, with the line of the configuration that settles it.
//!
//! Knows: text and lines of configuration. Must not know: which assumptions exist and how an analysis makes them.

/// An assumption in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StatedAssumption {
    /// What is assumed, or not known: one sentence without its full stop.
    pub text: String,
    /// What to write in `gcheck.toml`, on one line: `[offsets] G54 = { X = …, Y = …, Z = … }`. `…` is what only the machine
    /// can tell.
    pub pin: Option<String>,
}

impl StatedAssumption {
    /// Words, without a line of configuration that would settle it.
    pub fn new(text: impl Into<String>) -> Self {
        Self { text: text.into(), pin: None }
    }

    /// With the line of the configuration that settles it.
    #[must_use]
    pub fn pin(mut self, pin: impl Into<String>) -> Self {
        self.pin = Some(pin.into());
        self
    }
}

/// The lines of `gcheck.toml` that settle all of these, each under its table.
pub fn pins<'a>(assumptions: impl IntoIterator<Item = &'a StatedAssumption>) -> Vec<String> {
    let mut tables: Vec<(&str, Vec<&str>)> = Vec::new();
    for pin in assumptions.into_iter().filter_map(|assumption| assumption.pin.as_deref()) {
        let (table, line) = match pin.split_once("] ") {
            Some((table, line)) => (table.trim_start_matches('['), line),
            None => ("", pin),
        };
        match tables.iter_mut().find(|(known, _)| *known == table) {
            Some((_, lines)) if lines.contains(&line) => {}
            Some((_, lines)) => lines.push(line),
            None => tables.push((table, vec![line])),
        }
    }
    let heading = |table: &str| (!table.is_empty()).then(|| format!("[{table}]"));
    let lines = |(table, lines): (&str, Vec<&str>)| {
        heading(table).into_iter().chain(lines.into_iter().map(str::to_owned)).collect::<Vec<_>>()
    };
    tables.into_iter().flat_map(lines).collect()
}
