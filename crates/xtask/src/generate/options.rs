//! `docs/reference/options.md`: every command of the command line with its arguments, as `--help` tells them.
//!
//! Knows: how the parser of arguments describes itself. Must not know: what an argument does.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::{Arg, ArgAction, Command, CommandFactory as _};
use gcheck::args::Arguments;

use super::generated::Generated;
use super::markdown::{codes, header, table};

const PAGE: &str = "docs/reference/options.md";

/// The page.
pub(super) fn generate() -> Generated {
    let mut command = Arguments::command();
    // Arguments of all commands come to each of them, and defaults to all.
    command.build();
    let mut text = header("the arguments of `crates/gcheck/src/args.rs`");
    text.push_str("# Options of the command line\n\n");
    text.push_str("`gcheck COMMAND --help` says the same; `gcheck completions SHELL` completes it.\n\n");
    let shared: Vec<&Arg> = shown(&command).filter(|argument| argument.is_global_set()).collect();
    text.push_str("## For every command\n\n");
    text.push_str(&arguments(shared.iter().copied()));
    describe(&command, "", &mut text);
    vec![(PathBuf::from(PAGE), text)]
}

/// The commands of a command, each with its own.
fn describe(command: &Command, before: &str, text: &mut String) {
    for command in command.get_subcommands().filter(|command| !command.is_hide_set()) {
        let name = format!("{before}{}", command.get_name());
        if name == "help" || name.ends_with(" help") {
            continue;
        }
        // Writing to a string cannot fail.
        let _ = write!(text, "\n## `gcheck {name}`\n\n");
        let about = command.get_long_about().or_else(|| command.get_about());
        let _ = writeln!(text, "{}\n", about.map(ToString::to_string).unwrap_or_default().trim());
        let own: Vec<&Arg> = shown(command).filter(|argument| !argument.is_global_set()).collect();
        if own.is_empty() {
            text.push_str("It has no options of its own.\n");
        } else {
            text.push_str(&arguments(own.into_iter()));
        }
        describe(command, &format!("{name} "), text);
    }
}

fn shown(command: &Command) -> impl Iterator<Item = &Arg> {
    let is_everywhere = |argument: &&Arg| matches!(argument.get_id().as_str(), "help" | "version");
    command.get_arguments().filter(move |argument| !argument.is_hide_set() && !is_everywhere(argument))
}

fn arguments<'c>(arguments: impl Iterator<Item = &'c Arg>) -> String {
    let rows: Vec<Vec<String>> = arguments
        .map(|argument| {
            let help = argument.get_long_help().or_else(|| argument.get_help());
            let help = help.map(ToString::to_string).unwrap_or_default();
            vec![written(argument), help, values(argument), default(argument)]
        })
        .collect();
    table(&["argument", "does", "values", "default"], &rows)
}

/// As it is written: `-q`, `--quiet`; `--control NAME`; `FILE…`.
fn written(argument: &Arg) -> String {
    let takes_values = matches!(argument.get_action(), ArgAction::Set | ArgAction::Append);
    let names = argument.get_value_names().unwrap_or_default();
    let names: Vec<&str> = names.iter().map(clap::builder::Str::as_str).collect();
    let mut value = if takes_values { names.join(" ") } else { String::new() };
    if argument.is_positional() {
        let many = argument.get_num_args().is_some_and(|count| count.max_values() > 1);
        if many {
            value.push('…');
        }
        return format!("`{value}`");
    }
    let short = argument.get_short().map(|short| format!("-{short}"));
    let long = argument
        .get_long()
        .map(|long| if value.is_empty() { format!("--{long}") } else { format!("--{long} {value}") });
    codes(short.into_iter().chain(long))
}

fn values(argument: &Arg) -> String {
    if !matches!(argument.get_action(), ArgAction::Set | ArgAction::Append) {
        return String::new();
    }
    codes(
        argument
            .get_possible_values()
            .iter()
            .filter(|value| !value.is_hide_set())
            .map(|value| value.get_name().to_owned()),
    )
}

fn default(argument: &Arg) -> String {
    if !matches!(argument.get_action(), ArgAction::Set | ArgAction::Append) {
        return String::new();
    }
    if argument.is_hide_default_value_set() {
        // The help says it in words.
        return String::new();
    }
    codes(argument.get_default_values().iter().map(|value| value.to_string_lossy().into_owned()))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// All long names of a command and of its own.
    fn longs<'c>(command: &'c Command, names: &mut BTreeSet<&'c str>) {
        names.extend(shown(command).filter_map(Arg::get_long));
        command.get_subcommands().for_each(|command| longs(command, names));
    }

    #[test]
    fn every_option_of_every_command_is_on_the_page() {
        let (_, page) = generate().pop().unwrap();
        let command = Arguments::command();
        let mut names = BTreeSet::new();
        longs(&command, &mut names);
        assert!(names.len() > 50, "{names:?}");
        for name in names {
            assert!(
                page.contains(&format!("`--{name}`")) || page.contains(&format!("`--{name} ")),
                "--{name}"
            );
        }
        for words in ["## `gcheck check`", "## `gcheck edit translate`", "`--control NAME`", "`warning`"] {
            assert!(page.contains(words), "{words}");
        }
    }
}
