//! The arguments of the command line.
//!
//! Knows: names, help texts, what excludes what. Must not know: what an argument does.

mod edit;
mod values;

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use gcheck_diagnostics::Severity;
use gcheck_format::Numbering;
use gcheck_report::Format;

use crate::Problem;
use crate::nearest::did_you_mean;

pub use edit::{About, EditCommand, EditTarget, Lines, MirrorAxis, QuarterTurns};
pub(crate) use values::FUEL;
pub use values::{Assignment, BlockSkip, Switch, VariableName};
use values::{assignment, block_skip, control_name, count, fuel, jobs, numbering, tolerance};

/// Checks CNC part programs (G-code) before they run on the machine.
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
    #[arg(long, global = true, value_name = "NAME", value_parser = control_name)]
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

/// What a JSON schema describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum SchemaOf {
    /// `gcheck.toml`
    #[default]
    Configuration,
    /// The output of `--output-format json`; a line of `jsonl` is its `$defs/Line`
    Findings,
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
    /// Format programs, and renumber their blocks
    Fmt(FmtOptions),
    /// Change the path, the feeds or the speeds of a program, and prove what the change does
    ///
    /// gcheck executes the program before and after the change and compares all moves. It writes the file only if every move
    /// is as the change says, within 0.001 mm, and if both runs come to the end of the program. Otherwise the file stays as
    /// it is, and a message names the reason and its line.
    ///
    /// Exit codes: 0 the file is changed, or there is nothing to change; 1 `--check` or `--diff` would change it; 2 the
    /// change is refused, or its proof failed.
    #[command(subcommand)]
    Edit(EditCommand),
    /// Execute a program and print its moves
    Run(RunOptions),
    /// Cycle time, distances, extents, feeds and speeds of a program, by tool and in total
    Stats(StatsOptions),
    /// Compare two programs by what they make the machine do
    ///
    /// The verdict is about moves, feeds, speeds, tools, offsets, coolant, dwells, stops and how corners are taken. It is not
    /// about codes whose effect gcheck does not follow (air blast, clamps, conveyors, relays of the shop), diameters of tools
    /// that a program writes (`G10 L12`), or messages. Where two programs differ in such codes, the verdict is "the same as far
    /// as known" and names them, and it is so too where cutting moves start or end at unknown coordinates. `--strict` makes that
    /// exit code 1.
    Diff(DiffOptions),
    /// Draw the toolpath of a program: a picture (SVG), or a page with a view in three dimensions (HTML)
    Plot(PlotOptions),
    /// Explain a rule, or a code as a control reads it
    Explain(ExplainOptions),
    /// List the rules
    Rules(ListOptions),
    /// List the codes of a control
    Codes(ListOptions),
    /// List the controls
    Controls(ListOptions),
    /// Write a `gcheck.toml` with comments into this folder
    Init {
        /// Also write `gcheck.schema.json`, and the line by which editors (Even Better TOML, taplo) complete and check keys
        #[arg(long)]
        schema: bool,
    },
    /// Import a machine into `gcheck.toml`, and list the models of machines that gcheck knows
    #[command(subcommand)]
    Machine(MachineCommand),
    /// Print a JSON schema: that of `gcheck.toml`, or of the findings as `json` and `jsonl` have them
    Schema {
        /// What it describes
        #[arg(value_enum, default_value_t)]
        of: SchemaOf,
    },
    /// Serve an editor: the language server on standard input and output
    Lsp(LspOptions),
    /// Print completions for a shell
    Completions {
        /// The shell
        #[arg(value_enum)]
        shell: clap_complete::Shell,
    },
}

/// Refuses an option that is the name of a file as well.
///
/// `gcheck check *` in somebody else's folder would take a file called `-ofile.nc` for `-o file.nc`, and write to it. After
/// `--` everything is a path.
///
/// # Errors
/// The problem that says how to write it.
pub(crate) fn refuse_names_among_options(arguments: &[OsString]) -> Result<(), Problem> {
    let options = arguments.iter().skip(1).take_while(|argument| *argument != "--");
    let is_name = |argument: &&OsString| {
        argument.len() > 1
            && argument.as_encoded_bytes().starts_with(b"-")
            && Path::new(argument).symlink_metadata().is_ok()
    };
    let Some(name) = { options }.find(is_name) else { return Ok(()) };
    let name = name.to_string_lossy();
    Err(Problem::new(format!("`{name}` is an option and the name of a file here"))
        .help(format!("put `--` before paths, or write `./{name}`")))
}

/// Options of `gcheck check`.
#[derive(Debug, Clone, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of the command line")]
pub struct CheckOptions {
    /// Files, folders and patterns (`'parts/**/*.nc'`); `-` reads standard input
    #[arg(default_value = ".", value_name = "PATHS")]
    pub paths: Vec<PathBuf>,
    /// A file that lists what to check in place of PATHS, a path a line, `#` for comments; `-` reads the list from standard input
    #[arg(long, value_name = "FILE", conflicts_with_all = ["paths", "watch"])]
    pub files_from: Option<PathBuf>,
    /// The name of the program on standard input, for messages and for its settings
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
    /// Exit with 1 when a file was not analysed to its end: fuel or a budget used up, a rule failed
    #[arg(long)]
    pub fail_on_incomplete: bool,
    /// Exit with 1 when there are more warnings than this
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub max_warnings: Option<usize>,
    /// How findings are printed
    #[arg(long, value_parser = format(), default_value = "full", env = "GCHECK_OUTPUT_FORMAT", value_name = "FORMAT")]
    pub output_format: Format,
    /// Write to this file instead of standard output; with a format before it, besides (may be repeated):
    /// `-o sarif=gcheck.sarif -o junit=gcheck.xml`
    #[arg(long, short, value_name = "[FORMAT=]FILE", value_parser = output_file)]
    pub output_file: Vec<OutputFile>,
    /// The folder from which the formats of servers name files; without it the folder of `CI_PROJECT_DIR` or
    /// `GITHUB_WORKSPACE`, or the root of the repository, that holds the file
    #[arg(long, value_name = "DIR")]
    pub path_base: Option<PathBuf>,
    /// Fix what has a fix that changes no move
    #[arg(long, group = "fixing")]
    pub fix: bool,
    /// Print what `--fix` would change instead of findings; exit with 1 if it would change anything
    #[arg(long, group = "fixing", conflicts_with = "fix")]
    pub diff: bool,
    /// With `--fix` or `--diff`: take fixes too that may change moves, or whose intent only the programmer knows
    #[arg(long, requires = "fixing")]
    pub unsafe_fixes: bool,
    /// Show only findings that this file does not know; `--update-baseline` writes it
    #[arg(long, value_name = "FILE")]
    pub baseline: Option<PathBuf>,
    /// Make all that is found known to the baseline, and forget what is not found any more
    #[arg(long, requires = "baseline", conflicts_with_all = ["select", "ignore", "extend_select", "stdin_filename"])]
    pub update_baseline: bool,
    /// Count findings by rule instead of printing them; with a format for programs, besides and on standard error
    #[arg(long)]
    pub statistics: bool,
    /// Count findings by file, the worst first, instead of printing them; with a format for programs, besides
    #[arg(long)]
    pub summary: bool,
    /// Show every finding: formats for people fold repeats of a rule in a file after the fifth
    #[arg(long)]
    pub show_all: bool,
    /// Let no comment silence a rule
    #[arg(long)]
    pub no_suppressions: bool,
    /// A variable's value before programs start: `--set '#100=2.5'`, `--set '#<name>=1'` (may be repeated)
    #[arg(long, value_name = "VARIABLE=VALUE", value_parser = assignment)]
    pub set: Vec<Assignment>,
    /// The block delete switch: whether blocks with `/` are skipped; every position is looked at without it
    #[arg(long, value_enum, value_name = "on|off")]
    pub block_skip: Option<Switch>,
    /// Blocks of a program that may be executed, moves of repeats and cycles included; by default 2,000,000, and 64 more for each block of the program
    #[arg(long, value_name = "BLOCKS", value_parser = fuel, allow_negative_numbers = true, default_value_t = FUEL, hide_default_value = true)]
    pub fuel: u64,
    /// Files checked at a time; the number of processors without it
    #[arg(long, value_name = "N", value_parser = jobs, allow_negative_numbers = true)]
    pub jobs: Option<usize>,
    /// Check everything again, and store nothing
    #[arg(long)]
    pub no_cache: bool,
    /// The folder for results of earlier runs; without it that of `GCHECK_CACHE`, or one among the user's caches
    #[arg(long, value_name = "DIR")]
    pub cache_dir: Option<PathBuf>,
    /// Check again whenever a program or a configuration changes, until Ctrl-C
    #[arg(long, conflicts_with_all = ["fix", "diff", "update_baseline", "show_files", "show_settings", "stdin_filename"])]
    pub watch: bool,
    /// Print the files that would be checked
    #[arg(long, conflicts_with = "show_settings")]
    pub show_files: bool,
    /// Print what is in force for each file
    #[arg(long)]
    pub show_settings: bool,
}

/// Options of `gcheck fmt`.
#[derive(Debug, Args)]
pub struct FmtOptions {
    /// Files and folders; `-` reads standard input and writes standard output
    #[arg(default_value = ".", value_name = "PATHS")]
    pub paths: Vec<PathBuf>,
    /// The name of the program on standard input, for messages and for its settings
    #[arg(long, value_name = "PATH")]
    pub stdin_filename: Option<PathBuf>,
    /// Change nothing; print the files that would change and exit with 1 if there are any
    #[arg(long, conflicts_with = "diff")]
    pub check: bool,
    /// Change nothing; print what would change and exit with 1 if anything would
    #[arg(long)]
    pub diff: bool,
    /// Renumber the blocks that have an `N` number, and every word that names one of them: `--renumber 10:10`
    #[arg(long, value_name = "START:STEP", value_parser = numbering)]
    pub renumber: Option<Numbering>,
    /// Files formatted at a time; the number of processors without it
    #[arg(long, value_name = "N", value_parser = jobs, allow_negative_numbers = true)]
    pub jobs: Option<usize>,
}

/// A file for findings.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct OutputFile {
    /// Its own format; without one it is that of `--output-format`, and takes the place of standard output.
    pub format: Option<Format>,
    /// Where it is.
    pub path: PathBuf,
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

/// What every command takes that executes a program.
#[derive(Debug, Args)]
pub struct ExecutionOptions {
    /// The program; `-` reads standard input
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// How it is executed.
    #[command(flatten)]
    pub conditions: Conditions,
}

/// How programs are executed.
#[derive(Debug, Clone, Args)]
pub struct Conditions {
    /// The name of the program on standard input, for messages and for its settings
    #[arg(long, value_name = "PATH")]
    pub stdin_filename: Option<PathBuf>,
    /// A variable's value before a program starts: `--set '#100=2.5'`, `--set '#<name>=1'` (may be repeated)
    #[arg(long, value_name = "VARIABLE=VALUE", value_parser = assignment)]
    pub set: Vec<Assignment>,
    /// The block delete switch: whether blocks with `/` are skipped; a list such as `1,3` switches those levels on
    #[arg(long, value_name = "on|off|LEVELS", value_parser = block_skip, default_value = "off")]
    pub block_skip: BlockSkip,
    /// The optional stop switch: whether `M1` stops
    #[arg(long, value_enum, value_name = "on|off", default_value_t)]
    pub optional_stop: Switch,
    /// Blocks of a program that may be executed; moves of repeats and cycles count as blocks, too
    #[arg(long, value_name = "BLOCKS", value_parser = fuel, allow_negative_numbers = true, default_value_t = FUEL)]
    pub fuel: u64,
}

impl Conditions {
    /// A program that is executed so.
    pub(crate) fn of(&self, file: &Path) -> ExecutionOptions {
        ExecutionOptions { file: file.to_owned(), conditions: self.clone() }
    }
}

/// Options of `gcheck run`.
#[derive(Debug, Args)]
pub struct RunOptions {
    /// What is executed, and how.
    #[command(flatten)]
    pub execution: ExecutionOptions,
    /// Go on after an alarm as if its block were corrected, and report every one
    #[arg(long)]
    pub past_alarms: bool,
    /// How moves are printed
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub output_format: RunFormat,
    /// Write to this file instead of standard output
    #[arg(long, short, value_name = "FILE")]
    pub output_file: Option<PathBuf>,
}

/// How the moves of a run are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum RunFormat {
    /// NIST RS274/NGC canonical functions
    Canonical,
    /// One JSON object a move
    Jsonl,
    /// A table for spreadsheets
    Csv,
    /// A table for people
    #[default]
    Text,
}

/// Options of `gcheck stats`.
#[derive(Debug, Args)]
pub struct StatsOptions {
    /// Programs and folders; `-` reads standard input. More than one program gives a table
    #[arg(value_name = "FILE|FOLDER", required = true)]
    pub files: Vec<PathBuf>,
    /// How the programs are executed.
    #[command(flatten)]
    pub conditions: Conditions,
    /// How the figures are printed
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub output_format: StatsFormat,
    /// Write to this file instead of standard output
    #[arg(long, short, value_name = "FILE")]
    pub output_file: Option<PathBuf>,
}

/// Options of `gcheck diff`.
#[derive(Debug, Args)]
pub struct DiffOptions {
    /// A program or a folder; `-` reads standard input
    #[arg(value_name = "A")]
    pub a: PathBuf,
    /// The program or folder that it is compared with
    #[arg(value_name = "B")]
    pub b: PathBuf,
    /// Paths are the same while they stay this close on every axis: millimetres, or degrees on rotary axes
    #[arg(long, value_name = "MM", value_parser = tolerance, default_value = "0.001")]
    pub tolerance: f64,
    /// The control that runs B, where it is another one than that of A
    #[arg(long, value_name = "NAME", value_parser = control_name)]
    pub control_b: Option<String>,
    /// How the programs are executed.
    #[command(flatten)]
    pub conditions: Conditions,
    /// How differences are printed
    #[arg(long, value_enum, default_value_t, value_name = "FORMAT")]
    pub output_format: DiffFormat,
    /// Differences that are accepted, each with its reason: a TOML file
    #[arg(long, value_name = "FILE")]
    pub accepted: Option<PathBuf>,
    /// Exit with 1 too where the programs are the same only as far as known
    #[arg(long)]
    pub strict: bool,
    /// Write to this file instead of standard output
    #[arg(long, short, value_name = "FILE")]
    pub output_file: Option<PathBuf>,
}

/// Options of `gcheck plot`.
#[derive(Debug, Args)]
pub struct PlotOptions {
    /// What is executed, and how.
    #[command(flatten)]
    pub execution: ExecutionOptions,
    /// Write to this file: `.svg` a picture, `.html` a page that needs nothing else; `-` prints a picture to standard output
    #[arg(long, short, value_name = "FILE")]
    pub output_file: PathBuf,
}

/// What is done with the machine in `gcheck.toml`.
#[derive(Debug, Subcommand)]
pub enum MachineCommand {
    /// Write the machine into `gcheck.toml` from what the shop has
    ///
    /// Reads INI files of LinuxCNC with the files that they include and the limits that their HAL files set, its tool tables,
    /// `$$` dumps of Grbl and its kin, configurations of FluidNC, machines and tool libraries of FreeCAD, tool libraries of
    /// Fusion (JSON), MTConnect probe documents, and offsets that a control wrote as blocks of `G10`. Each value gets a comment that
    /// says where it is from; what is in the file already stays.
    Import(ImportOptions),
    /// List the models of machines that `[machine] preset` takes
    List(ListOptions),
    /// Print a model of a machine as a table for `gcheck.toml`, with the source of each value
    Show {
        /// Its name in the list
        name: String,
    },
}

/// Options of `gcheck machine import`.
#[derive(Debug, Args)]
pub struct ImportOptions {
    /// Files that describe the machine
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// Write to this file instead of the `gcheck.toml` of this folder
    #[arg(long, short, value_name = "FILE")]
    pub output_file: Option<PathBuf>,
    /// What the files are, where their content does not show it
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub format: Option<ImportFormat>,
    /// The unit of lengths in files that do not say it
    #[arg(long, value_enum, value_name = "mm|inch")]
    pub units: Option<LengthUnit>,
    /// Replace values that are in the file and differ
    #[arg(long)]
    pub overwrite: bool,
    /// Print the file as it would be, and write nothing
    #[arg(long)]
    pub dry_run: bool,
}

/// What describes a machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ImportFormat {
    /// INI file of a PC control, with `[TRAJ]` and `[AXIS_X]`
    Ini,
    /// Tool table: a line a tool, or CSV
    ToolTable,
    /// Numbered settings as `$$` prints them
    Settings,
    /// Tool library of Fusion, as JSON
    Fusion,
    /// Tool library of FreeCAD (`.fctl`)
    Freecad,
    /// Machine of FreeCAD (`.fcm`)
    FreecadMachine,
    /// Configuration of FluidNC, as YAML
    Yaml,
    /// MTConnect probe document
    Mtconnect,
    /// Program with blocks of `G10`
    Offsets,
}

/// Unit of lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum LengthUnit {
    /// Millimetres
    Mm,
    /// Inches
    Inch,
}

impl From<LengthUnit> for crate::config::Units {
    fn from(unit: LengthUnit) -> Self {
        match unit {
            LengthUnit::Mm => Self::Mm,
            LengthUnit::Inch => Self::Inch,
        }
    }
}

/// Options of `gcheck lsp`.
#[derive(Debug, Args)]
pub struct LspOptions {
    /// Taken for editors that say so; there is no other way to talk to the server
    #[arg(long, hide = true)]
    pub stdio: bool,
}

/// Options of `gcheck explain`.
#[derive(Debug, Args)]
pub struct ExplainOptions {
    /// A rule (`unknown-code`), a code (`G143`), an address (`E`), a variable (`'#4003'`), an answer of the control (`'error 22'`)
    /// or a setting (`'$32'`)
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

/// How figures are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum StatsFormat {
    /// Columns.
    #[default]
    Text,
    /// Comma-separated values, a row a program.
    Csv,
    /// One JSON object.
    Json,
}

/// How differences are printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum DiffFormat {
    /// For people.
    #[default]
    Text,
    /// One JSON object.
    Json,
    /// Test results, a suite a program.
    Junit,
    /// Annotations of GitHub Actions.
    Github,
    /// A page with both paths over each other.
    Html,
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

/// Reads the name of a format; help and completions list them.
fn format() -> impl TypedValueParser<Value = Format> {
    PossibleValuesParser::new(Format::ALL.map(Format::name))
        .map(|name| Format::parse(&name).unwrap_or_default())
}

/// Reads `FILE` or `FORMAT=FILE`; a name before `=` that is not a format belongs to the file's name, unless a format has nearly
/// the same.
fn output_file(text: &str) -> Result<OutputFile, String> {
    let whole = || OutputFile { format: None, path: PathBuf::from(text) };
    let Some((name, path)) = text.split_once('=') else { return Ok(whole()) };
    if let Some(format) = Format::parse(name) {
        return Ok(OutputFile { format: Some(format), path: PathBuf::from(path) });
    }
    let near = did_you_mean(name, Format::ALL.map(Format::name));
    if near.is_empty() {
        return Ok(whole());
    }
    Err(format!("no format is called `{name}`{near} A file of this name is `./{text}`"))
}
