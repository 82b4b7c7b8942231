//! `cargo xtask`: what developers of gcheck need beside cargo.
//!
//! Knows: which commands there are. Must not know: what they do; each is a module of its own.
//!
//! The alias in `.cargo/config.toml` builds xtask without the product's crates, so that it works while they do not
//! compile; a command that has to read the product (`gen`, `bench`, `corpus`) runs xtask again with them, see [`product`].

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command-line tool for developers")]

#[cfg(feature = "product")]
mod bench;
#[cfg(feature = "product")]
mod binary;
mod blind;
mod browser_target;
mod competitors;
#[cfg(feature = "product")]
mod corpus;
#[cfg(feature = "packages")]
mod dist;
mod fuzz;
mod generate;
#[cfg(feature = "product")]
mod headless;
#[cfg(feature = "product")]
mod kinematics;
#[cfg(feature = "product")]
mod measure;
mod mutations;
mod new_rule;
#[cfg(feature = "playground")]
mod playground;
#[cfg(feature = "product")]
mod precision;
mod product;
mod test;
mod tidy;
#[cfg(feature = "product")]
mod timing;
mod workspace;

use std::env;
use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask COMMAND

  tidy                        check the laws of the repository that no compiler checks
  gen [--check]               write (or check) registries, pages and schemas that come from code and data
  new-rule ID --tier token|block|program --group GROUP
                              scaffold a rule
  test [--quick] [--editors] [--soak] [ARGS…]
                              install what tests need, then run everything that CI runs; ARGS go to the tests;
                              --editors runs the editors of the system as well; --soak types at the language server for
                              as long as an afternoon does
  fuzz [--minutes N] [--keep] [TARGET…]
                              run the fuzzer that is guided by coverage on each target in turn, N minutes in all;
                              `--keep` makes seeds of some of the inputs that it found
  bench [lsp]                 measure speed and memory against the budgets, in one table; `lsp`: of the server alone
  corpus                      check the programs of $GCHECK_CORPUS and write docs/dev/corpus.md
  precision                   draw a sample of those findings, match the verdicts of tests/precision.tsv, write
                              docs/precision.md
  mutations                   forget each field of the machine's state once where paths meet, and write docs/dev/law-4.md with
                              the program for which law 4 then fails
  timing [--again|--missing] [PROGRAM…]
                              run programs in the motion planner of a control, and write fixtures/timing/measured.tsv
  timing speeds               sample the speed along some of them, into fixtures/timing/speeds
  kinematics                  ask a control's kinematics of five axes, and write fixtures/kinematics/measured.tsv
  blind seal FILE… | look draw-N | look mistakes-N | page
                              first looks at programs and mistakes that nobody tuned gcheck to (docs/dev/blind.md)
  dist [--target TRIPLE] [--binary FILE] [--out FOLDER] [--vscode]
                              pack gcheck for one system: archive, wheel, npm and Debian packages, bill of materials,
                              with --vscode the extension; builds it in the profile `dist` unless a binary is named
  dist release [--out FOLDER] from the packages of all systems: npm launcher, installers, manifests, checksums
  playground [--out FOLDER]   build the page that checks programs in a browser, into target/playground
  competitors                 run other checkers on the seeded mistakes and write tests/competitors.tsv";

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let (command, rest) = match arguments.split_first() {
        Some((command, rest)) => (command.as_str(), rest),
        None => ("help", arguments.as_slice()),
    };
    let outcome = match command {
        "blind" => blind::run(rest),
        "tidy" => tidy::run(rest),
        "fuzz" => fuzz::run(rest),
        "gen" => generate::run(rest),
        "mutations" => mutations::run(rest),
        "new-rule" => new_rule::run(rest),
        "test" => test::run(rest),
        #[cfg(feature = "product")]
        "bench" => bench::run(rest),
        #[cfg(feature = "product")]
        "corpus" => corpus::run(rest),
        #[cfg(feature = "product")]
        "precision" => precision::run(rest),
        "competitors" => competitors::run(rest),
        #[cfg(feature = "packages")]
        "dist" => dist::run(rest),
        #[cfg(not(feature = "packages"))]
        "dist" => product::rerun_with("packages", "dist", rest),
        #[cfg(feature = "playground")]
        "playground" => playground::run(rest),
        #[cfg(not(feature = "playground"))]
        "playground" => product::rerun_with("playground", "playground", rest),
        #[cfg(feature = "product")]
        "kinematics" => kinematics::run(rest),
        #[cfg(not(feature = "product"))]
        "kinematics" => product::rerun("kinematics", rest, false),
        #[cfg(feature = "product")]
        "timing" => timing::run(rest),
        #[cfg(not(feature = "product"))]
        "timing" => product::rerun("timing", rest, false),
        #[cfg(feature = "product")]
        "measure" => measure::run(rest),
        #[cfg(not(feature = "product"))]
        "bench" => product::rerun("bench", rest, true),
        #[cfg(not(feature = "product"))]
        "corpus" => product::rerun("corpus", rest, false),
        #[cfg(not(feature = "product"))]
        "precision" => product::rerun("precision", rest, false),
        "help" | "--help" | "-h" => {
            println!("{USAGE}");
            Ok(ExitCode::SUCCESS)
        }
        unknown => {
            eprintln!("xtask: there is no command `{unknown}`\n\n{USAGE}");
            Ok(ExitCode::from(2))
        }
    };
    outcome.unwrap_or_else(|error| {
        eprintln!("xtask {command}: {error:#}");
        ExitCode::from(2)
    })
}
