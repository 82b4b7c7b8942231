//! From configuration text to a checked layer, with messages that point at the place.
//!
//! Knows: TOML, files, `extend`, `KEY=VALUE`. Must not know: which programs a configuration rules over.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::text::Text;
use super::{ConfigFile, Layer};
use crate::nearest::did_you_mean;
use crate::quoting::Workspace;
use crate::{Problem, paths, reading};

/// More configurations than this, each extending the next, are a mistake.
const MAX_BASES: usize = 16;

/// A larger file is not a configuration.
const MAX_BYTES: u64 = 1 << 20;

/// Reads a file and everything it extends; the most basic layer first.
pub(super) fn file_with_bases(path: &Path) -> Result<Vec<Arc<Layer>>, Problem> {
    let mut layers: Vec<Arc<Layer>> = Vec::new();
    let workspace = Workspace::around(path);
    let mut next = Some(path.to_owned());
    while let Some(path) = next {
        let may_quote = workspace.may_quote(&path);
        let (layer, base) =
            file(&path).map_err(|problem| if may_quote { problem } else { problem.without_text() })?;
        let layer = if may_quote { layer } else { layer.unquoted() };
        if let Some(base) = &base
            && (layers.len() >= MAX_BASES || is_read(&layers, &layer, base))
        {
            let message = format!("`extend` leads back to {}", paths::shown_from_here(base));
            return Err(problem(&path, message));
        }
        next = base;
        layers.push(Arc::new(layer));
    }
    layers.reverse();
    Ok(layers)
}

/// A problem with a configuration file as a whole.
fn problem(path: &Path, message: impl Into<String>) -> Problem {
    Problem::with_file(Path::new(&paths::shown_from_here(path)), message)
}

fn is_read(layers: &[Arc<Layer>], newest: &Layer, base: &Path) -> bool {
    let base = paths::absolute(base);
    let is_it = |layer: &Layer| layer.path.as_ref().is_some_and(|path| paths::absolute(path) == base);
    is_it(newest) || layers.iter().any(|layer| is_it(layer))
}

/// Reads one file; the second part is what it extends.
fn file(path: &Path) -> Result<(Layer, Option<PathBuf>), Problem> {
    if path.is_dir() {
        return Err(problem(path, "is a folder, not a configuration file"));
    }
    let bytes = reading::regular(path, MAX_BYTES)
        .map_err(|reason| Problem::with_file(path, format!("cannot read the configuration: {reason}")))?;
    let text = String::from_utf8(bytes)
        .map_err(|_| problem(path, "is not a configuration: it holds bytes that are not UTF-8"))?;
    let name = paths::shown_from_here(path);
    let absolute = paths::absolute(path);
    let folder = absolute.parent().unwrap_or(&absolute).to_owned();
    let file = parse(&name, &text)?;
    let base = file.extend.as_ref().map(|base| folder.join(&base.value));
    if let (Some(base), Some(placed)) = (&base, &file.extend)
        && !base.is_file()
    {
        let message = format!("`extend` names `{}`, which is not a file", placed.value);
        return Err(Problem::at(&name, &text, &placed.range, message));
    }
    let layer = Layer::new(Some(absolute), file, Text { name: &name, text: &text, folder: &folder })?;
    Ok((layer, base))
}

/// Whether a text would do as the configuration of this path; what it extends is not read.
pub(crate) fn check_text(path: &Path, text: &str) -> Result<(), Problem> {
    layer_of_text(path, text).map(|_| ())
}

/// A text as the configuration of this path; what it extends is not read.
pub(crate) fn layer_of_text(path: &Path, text: &str) -> Result<Layer, Problem> {
    let name = paths::shown_from_here(path);
    let absolute = paths::absolute(path);
    let folder = absolute.parent().unwrap_or(&absolute).to_owned();
    let file = parse(&name, text)?;
    Layer::new(Some(absolute), file, Text { name: &name, text, folder: &folder })
}

/// Reads `KEY=VALUE` of the command line; a value that is not TOML is text.
pub(super) fn inline(argument: &str) -> Result<Layer, Problem> {
    let folder = paths::absolute(Path::new("."));
    let as_written = parse(NAME, argument);
    let (text, file) = match as_written {
        Ok(file) => (argument.to_owned(), file),
        Err(problem) => {
            let (key, value) = argument.split_once('=').unwrap_or((argument, ""));
            let quoted = format!("{key}={}", toml::Value::String(value.trim().to_owned()));
            if toml::from_str::<toml::Table>(argument).is_ok() {
                return Err(problem);
            }
            match parse(NAME, &quoted) {
                Ok(file) => (quoted, file),
                Err(_) if toml::from_str::<toml::Table>(&quoted).is_err() => return Err(problem),
                Err(problem) => return Err(problem),
            }
        }
    };
    if let Some(extend) = &file.extend {
        return Err(Problem::at(NAME, &text, &extend.range, "`extend` works in a file only"));
    }
    Layer::new(None, file, Text { name: NAME, text: &text, folder: &folder })
}

/// What messages call the command line's text.
const NAME: &str = "--config";

fn parse(name: &str, text: &str) -> Result<ConfigFile, Problem> {
    toml::from_str(text).map_err(|error| {
        let range = error.span().unwrap_or(0..0);
        Problem::at(name, text, &range, in_words(error.message()))
    })
}

/// Serde's message in our words: a suggestion for what is misspelt, no names of Rust types.
pub(crate) fn in_words(message: &str) -> String {
    if let Some((what, name, known)) = misspelt(message) {
        let near = did_you_mean(name, known.iter().copied());
        let list = if near.is_empty() && !known.is_empty() {
            format!("; known are {}", known.join(", "))
        } else {
            near
        };
        return format!("unknown {what} `{name}`{list}");
    }
    if let Some(key) = message.strip_prefix("missing field `").and_then(|rest| rest.strip_suffix('`')) {
        return format!("the key `{key}` is missing");
    }
    let mut words = message.lines().next().unwrap_or_default().to_owned();
    words = words.replace("invalid type: ", "wrong type: ").replace("invalid value: ", "wrong value: ");
    for (rust, plain) in RUST_WORDS {
        words = words.replace(rust, plain);
    }
    // What serde calls a struct is a table of TOML.
    if let Some((before, _)) = words.split_once("expected struct ") {
        words = format!("{before}expected a table");
    }
    words
}

/// Names of types in messages, and what they are called outside Rust.
const RUST_WORDS: [(&str, &str); 14] = [
    ("expected an array of length 2", "expected a list of two numbers"),
    ("floating point `", "number `"),
    ("integer `", "number `"),
    ("boolean `", "`"),
    ("string \"", "text \""),
    ("expected f64", "expected a number"),
    ("expected u32", "expected a whole number from 0"),
    ("expected u8", "expected a whole number from 0 to 255"),
    ("expected i8", "expected a whole number"),
    ("expected a string", "expected a text"),
    ("expected a sequence", "expected a list"),
    ("expected a map", "expected a table"),
    ("sequence, expected", "list, expected"),
    ("map, expected", "table, expected"),
];

/// Takes apart ``unknown field `a`, expected one of `b`, `c` `` and the like of serde.
fn misspelt(message: &str) -> Option<(&'static str, &str, Vec<&str>)> {
    let (what, rest) = [("key", "unknown field `"), ("value", "unknown variant `")]
        .into_iter()
        .find_map(|(what, start)| Some((what, message.strip_prefix(start)?)))?;
    let (name, rest) = rest.split_once('`')?;
    Some((what, name, rest.split('`').skip(1).step_by(2).collect()))
}

#[cfg(test)]
mod tests {
    use super::{inline, parse};

    fn check(text: &str, expected: &str) {
        let problem = match parse("gcheck.toml", text) {
            Err(problem) => problem.to_string(),
            Ok(_) => "fine".to_owned(),
        };
        assert_eq!(problem.lines().next().unwrap_or_default(), expected, "{text}");
    }

    #[test]
    fn messages_point_at_the_place_and_suggest() {
        check("contrl = \"x\"\n", "gcheck.toml:1:1: unknown key `contrl`; did you mean `control`?");
        check("[machine]\nmax-rpm = 1\n", "gcheck.toml:2:1: unknown key `max-rpm`; did you mean `max_rpm`?");
        check(
            "[machine]\nunits = \"inches\"\n",
            "gcheck.toml:2:9: unknown value `inches`; did you mean `inch`?",
        );
        check(
            "[machine]\nmax_rpm = \"fast\"\n",
            "gcheck.toml:2:11: wrong type: text \"fast\", expected a number",
        );
        check("control = 5\n", "gcheck.toml:1:11: wrong type: number `5`, expected a text");
        check("[rules]\nselect = \"all\"\n", "gcheck.toml:2:10: wrong type: text \"all\", expected a list");
        check(
            "[rules]\nunknown-code = \"loud\"\n",
            "gcheck.toml:2:16: unknown value `loud`; known are off, hint, info, warning, error",
        );
        check(
            "[format]\nword-spacing = \"two\"\n",
            "gcheck.toml:2:16: unknown value `two`; known are keep, one, none",
        );
        check(
            "[format]\nword_spacing = 1\n",
            "gcheck.toml:2:1: unknown key `word_spacing`; did you mean `word-spacing`?",
        );
        check(
            "[format]\ncomment-column = 300\n",
            "gcheck.toml:2:18: wrong value: number `300`, expected a whole number from 0 to 255",
        );
        check("machine = 3\n", "gcheck.toml:1:11: wrong type: number `3`, expected a table");
        check(
            "[settings]\n34 = [1]\n",
            "gcheck.toml:2:6: wrong type: list, expected `true`, `false`, a number or a text",
        );
        check(
            "[tools]\n1 = { lenght = 5 }\n",
            "gcheck.toml:2:7: unknown key `lenght`; did you mean `length`?",
        );
        check(
            "[[overrides]]\nfile = [\"a\"]\n",
            "gcheck.toml:2:1: unknown key `file`; did you mean `files`?",
        );
    }

    #[test]
    fn values_of_the_command_line_need_no_quotes() {
        let first = gcheck_controls::names()[0];
        let layer = inline(&format!("control={first}")).unwrap();
        assert_eq!(layer.base.control.as_deref(), Some(first));
        let layer = inline("machine.axes=[\"X\", \"Z\"]").unwrap();
        assert_eq!(layer.file.machine.axes.unwrap().value.len(), 2);
        let problem = inline("contrl=x").unwrap_err().to_string();
        assert!(
            problem.starts_with("--config:1:1: unknown key `contrl`; did you mean `control`?"),
            "{problem}"
        );
        assert!(inline("=").unwrap_err().to_string().starts_with("--config:1:1: "));
    }
}
