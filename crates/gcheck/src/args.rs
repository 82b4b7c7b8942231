//! The arguments of the command line.
//!
//! Knows: names, help texts, what excludes what. Must not know: what an argument does.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use gcheck_report::Format;
use gcheck_rules::Severity;

/// Reads CNC part programs (G-code) the way the control will, before the control does.
#[derive(Debug, Parser)]
#[command(name = "gcheck", version, max_term_width = 100)]
pub struct Arguments {
    /// What every command takes.
    #[command(flatten)]
    pub global: Global,
    /// The command.
    #[command(subcommand)]
    pub command: Command,
}

/// What every command takes.
#[derive(Debug, Args)]
pub struct Global {
    /// The control that runs the programs; `gcheck controls` lists them
    #[arg(long, global = true, value_name = "NAME")]
    pub control: Option<String>,
    /// A configuration file, or a key of one: `--config control=NAME` (may be repeated)
    #[arg(long, global = true, value_name = "FILE|KEY=VALUE")]
    pub config: Vec<String>,
    /// Read no configuration file
    #[arg(long, global = true)]
    pub isolated: bool,
    /// Colours in the output
    #[arg(long, global = true, value_enum, default_value_t, value_name = "WHEN")]
    pub color: When,
    /// Say nothing but findings and errors
    #[arg(long, short, global = true)]
    pub quiet: bool,
}

/// When colours are used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum When {
    /// On a terminal, unless `NO_COLOR` is set; or when `CLICOLOR_FORCE` is.
    #[default]
    Auto,
    /// In any case.
    Always,
    /// Not at all.
    Never,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Check files and folders
    Check(CheckOptions),
    /// Explain a rule, or a code as a control reads it
    Explain(ExplainOptions),
    /// List the rules
    Rules(ListOptions),
    /// List the codes of a control
    Codes(ListOptions),
    /// List the controls
    Controls(ListOptions),
    /// Write a `gcheck.toml` with comments into this folder
    Init,
    /// Print the JSON schema of `gcheck.toml`
    Schema,
    /// Print completions for a shell
    Completions {
        /// The shell
        #[arg(value_enum)]
        shell: clap_complete::Shell,
    },
}

/// Options of `gcheck check`.
#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of the command line")]
pub struct CheckOptions {
    /// Files and folders; `-` reads standard input
    #[arg(default_value = ".", value_name = "PATHS")]
    pub paths: Vec<PathBuf>,
    /// What standard input is called
    #[arg(long, value_name = "PATH")]
    pub stdin_filename: Option<PathBuf>,
    /// Run these rules, groups or sets in place of those configured
    #[arg(long, value_delimiter = ',', value_name = "RULES")]
    pub select: Vec<String>,
    /// Do not run these
    #[arg(long, value_delimiter = ',', value_name = "RULES")]
    pub ignore: Vec<String>,
    /// Run these as well
    #[arg(long, value_delimiter = ',', value_name = "RULES")]
    pub extend_select: Vec<String>,
    /// Exit with 1 from this severity on
    #[arg(long, value_enum, default_value_t, value_name = "SEVERITY")]
    pub fail_on: FailOn,
    /// Exit with 1 when there are more warnings than this
    #[arg(long, value_name = "N")]
    pub max_warnings: Option<usize>,
    /// How findings are printed
    #[arg(long, value_parser = format, default_value = "full", env = "GCHECK_OUTPUT_FORMAT", value_name = "FORMAT")]
    pub output_format: Format,
    /// Write to this file instead of standard output
    #[arg(long, short, value_name = "FILE")]
    pub output_file: Option<PathBuf>,
    /// Count findings by rule
    #[arg(long)]
    pub statistics: bool,
    /// Let no comment silence a rule
    #[arg(long)]
    pub no_suppressions: bool,
    /// Files checked at a time; the number of processors without it
    #[arg(long, value_name = "N")]
    pub jobs: Option<usize>,
    /// Print the files that would be checked
    #[arg(long)]
    pub show_files: bool,
    /// Print what is in force for each file
    #[arg(long)]
    pub show_settings: bool,
}

/// From which severity on a check fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum FailOn {
    /// The control alarms, or the move is certainly wrong.
    #[default]
    Error,
    /// A likely crash, scrap or trap.
    Warning,
    /// Worth knowing.
    Info,
    /// Findings do not fail.
    Never,
}

impl FailOn {
    /// The mildest severity that fails.
    pub fn severity(self) -> Option<Severity> {
        match self {
            Self::Error => Some(Severity::Error),
            Self::Warning => Some(Severity::Warning),
            Self::Info => Some(Severity::Info),
            Self::Never => None,
        }
    }
}

/// Options of `gcheck explain`.
#[derive(Debug, Args)]
pub struct ExplainOptions {
    /// A rule (`unknown-code`) or a code (`G143`)
    #[arg(value_name = "RULE|CODE")]
    pub subject: String,
}

/// Options of the lists.
#[derive(Debug, Args)]
pub struct ListOptions {
    /// How the list is printed
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub output_format: ListFormat,
}

/// How a list is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum ListFormat {
    /// Columns.
    #[default]
    Text,
    /// One JSON array.
    Json,
}

fn format(name: &str) -> Result<Format, String> {
    Format::parse(name).ok_or_else(|| {
        let names: Vec<&str> = Format::ALL.iter().map(|f| f.name()).collect();
        format!("there are {}", names.join(", "))
    })
}
