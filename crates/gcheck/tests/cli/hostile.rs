//! Folders of strangers: links, pipes, devices, names and texts that try to make gcheck write, show or hang. Each attack ends
//! in words, at once, and takes no other file with it.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;
use std::process::Command;
use std::time::{Duration, Instant};

use expect_test::{Expect, expect};

use crate::shop::{BAD, GOOD, Shop};

/// Far longer than any of these takes; an endless file or a pipe without a writer takes for ever.
const PATIENCE: Duration = Duration::from_secs(30);
/// A line that nobody outside of its file may see.
const SECRET: &str = "hunter2 = [\n";

const CHECK: &str = "check --no-cache --quiet --output-format concise --control haas-mill";

/// Checks a folder with a finding beside a folder with this configuration, which is put there by `put`.
fn check_configuration(put: impl FnOnce(&Shop), expected: &Expect) {
    expected.assert_eq(&refused(put));
}

/// What is said of a configuration that is refused.
fn refused(put: impl FnOnce(&Shop)) -> String {
    let shop = Shop::with(&[("theirs/a.nc", BAD), ("sound/a.nc", BAD)]);
    put(&shop);
    let start = Instant::now();
    let run = shop.gcheck(&format!("{CHECK} theirs sound"));
    assert!(start.elapsed() < PATIENCE, "{run}");
    assert_eq!(run.findings(), ["sound/a.nc:3:1: error[unknown-code]"], "the other folder is checked: {run}");
    assert_eq!(run.code, 2, "{run}");
    run.stderr
}

#[test]
fn a_configuration_that_is_a_device_is_refused() {
    check_configuration(
        |shop| symlink("/dev/zero", shop.path("theirs/gcheck.toml")).unwrap(),
        &expect![[r#"
            error: [SHOP]/theirs/gcheck.toml: cannot read the configuration: it is a pipe, a device or a folder, not a file
        "#]],
    );
}

#[test]
fn a_configuration_that_is_a_pipe_is_refused() {
    check_configuration(
        |shop| {
            make_pipe(&shop.path("theirs/gcheck.toml"));
        },
        &expect![[r#"
            error: [SHOP]/theirs/gcheck.toml: cannot read the configuration: it is a pipe, a device or a folder, not a file
        "#]],
    );
}

#[test]
fn a_configuration_that_is_too_large_is_refused() {
    check_configuration(
        |shop| shop.file("theirs/gcheck.toml", "# large\n".repeat(200_000)),
        &expect![[r#"
            error: [SHOP]/theirs/gcheck.toml: cannot read the configuration: it is larger than 1 MB
        "#]],
    );
}

fn make_pipe(path: &std::path::Path) {
    let made = Command::new("mkfifo").arg(path).status().unwrap();
    assert!(made.success());
}

#[test]
fn ignore_files_that_never_end_leave_out_their_folder_alone() {
    for name in [".gitignore", ".ignore", ".gcheckignore", ".git/info/exclude"] {
        for kind in ["pipe", "device", "large"] {
            let said = refused(|shop| {
                let path = shop.path(&format!("theirs/{name}"));
                fs::create_dir_all(path.parent().unwrap()).unwrap();
                match kind {
                    "pipe" => make_pipe(&path),
                    "device" => symlink("/dev/zero", path).unwrap(),
                    _ => fs::write(path, "a".repeat(2 << 20)).unwrap(),
                }
            });
            let place = format!("/theirs/{name}: cannot read this ignore file:");
            assert!(said.contains(&place), "{kind}: {said}");
        }
    }
}

#[test]
fn a_folder_with_the_name_of_an_ignore_file_is_a_folder() {
    let shop = Shop::with(&[("a.nc", BAD)]);
    fs::create_dir_all(shop.path(".ignore")).unwrap();
    let run = shop.gcheck("check --no-cache --control haas-mill .");
    assert_eq!((run.code, run.stderr.contains("ignore")), (1, false), "{run}");
}

#[test]
fn an_ignore_file_around_the_folder_is_read_as_carefully() {
    let shop = Shop::with(&[("around/inner/a.nc", BAD)]);
    make_pipe(&shop.path("around/.gitignore"));
    for command in ["check --no-cache --control haas-mill around/inner", "fmt --check around/inner"] {
        let start = Instant::now();
        let run = shop.gcheck(command);
        assert!(start.elapsed() < PATIENCE, "{run}");
        assert!(run.stderr.contains(".gitignore: cannot read this ignore file"), "{run}");
        assert_eq!(run.code, 2, "{run}");
    }
}

#[test]
fn a_baseline_that_is_a_pipe_is_refused() {
    let shop = Shop::with(&[("a.nc", BAD)]);
    make_pipe(&shop.path("known.json"));
    let start = Instant::now();
    let run = shop.gcheck(&format!("{CHECK} --baseline known.json a.nc"));
    assert!(start.elapsed() < PATIENCE, "{run}");
    assert!(run.stderr.contains("it is a pipe, a device or a folder, not a file"), "{run}");
    assert_eq!(run.code, 2, "{run}");
}

#[test]
fn a_pattern_of_braces_in_braces_is_refused() {
    let pattern = format!("{}a{}", "{a,".repeat(240), "}".repeat(240));
    let said = refused(|shop| shop.file("theirs/gcheck.toml", format!("files.include = [\n'{pattern}']\n")));
    assert!(said.starts_with("error: theirs/gcheck.toml:2:1: "), "{said}");
    assert!(said.contains("its braces are nested deeper than 10"), "{said}");
}

#[test]
fn folders_to_search_are_counted() {
    let table = format!("search.paths = [\n{}]\n", "'/usr',\n".repeat(65));
    let said = refused(|shop| shop.file("theirs/gcheck.toml", &table));
    assert!(said.starts_with("error: theirs/gcheck.toml:66:1: more than 64 folders to search"), "{said}");
}

/// A line of this file is shown neither by a link to it nor by a configuration that names it.
fn check_secret(name: &str) {
    let shop = Shop::with(&[("shop/.git/HEAD", ""), ("shop/a.nc", BAD), ("shop/b.nc", BAD), (name, SECRET)]);
    let secret = shop.path(name);
    let put: [&dyn Fn(); 3] = [
        &|| symlink(&secret, shop.path("shop/gcheck.toml")).unwrap(),
        &|| shop.file("shop/gcheck.toml", format!("extend = \"{}\"\n", secret.display())),
        &|| shop.file("shop/gcheck.toml", format!("[tools]\ntable = \"{}\"\n", secret.display())),
    ];
    for put in put {
        put();
        let mut command = shop.command();
        command.current_dir(shop.path("shop")).args(["check", "--no-cache", "--output-format", "json"]);
        let run = shop.finish(&mut command, b"");
        assert_eq!(run.code, 2, "{run}");
        assert!(run.stderr.contains("nothing of it is shown"), "{run}");
        assert!(!run.to_string().contains("hunter2"), "{run}");
        fs::remove_file(shop.path("shop/gcheck.toml")).unwrap();
    }
}

#[test]
fn files_outside_of_the_workspace_are_not_quoted() {
    check_secret("secret");
}

#[test]
fn hidden_files_of_the_workspace_are_not_quoted() {
    check_secret("shop/.git/config");
    check_secret("shop/.env");
}

#[test]
fn links_that_lead_out_are_not_written_through() {
    let unformatted = "O1 (PART\ng0x1.\nM30\n";
    let shop =
        Shop::with(&[("shop/a.nc", GOOD), ("outside.nc", unformatted), ("shop/inside.nc", unformatted)]);
    symlink(shop.path("outside.nc"), shop.path("shop/link.nc")).unwrap();
    symlink("inside.nc", shop.path("shop/near.nc")).unwrap();
    for command in [
        "fmt shop --control haas-mill",
        "fmt shop/link.nc --control haas-mill",
        "check shop --no-cache --fix --unsafe-fixes --select unclosed-comment --control haas-mill",
    ] {
        let run = shop.gcheck(command);
        assert_eq!(run.code, 2, "{run}");
        assert!(run.stderr.contains("shop/link.nc: is a link that leads out of the folder"), "{run}");
        assert_eq!(shop.read("outside.nc"), unformatted);
    }
    assert_ne!(shop.read("shop/inside.nc"), unformatted, "a link that stays inside is no reason to stop");
    assert!(shop.path("shop/near.nc").is_symlink() && shop.path("shop/link.nc").is_symlink());
    // Who names the file means it.
    assert_eq!(shop.gcheck("fmt outside.nc --control haas-mill").code, 0);
}

#[test]
fn outputs_do_not_follow_links_out_of_the_folder() {
    let shop = Shop::with(&[("shop/a.nc", GOOD), ("profile", "mine\n")]);
    symlink(shop.path("profile"), shop.path("shop/gcheck.sarif")).unwrap();
    symlink("real.sarif", shop.path("shop/near.sarif")).unwrap();
    shop.file("shop/real.sarif", "old");
    let check = |output: &str| {
        let mut command = shop.command();
        command.current_dir(shop.path("shop")).args(["check", "--no-cache", "a.nc", "-o"]).arg(output);
        shop.finish(&mut command, b"")
    };
    let run = check("sarif=gcheck.sarif");
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("is a link that leads out of this folder"), "{run}");
    assert_eq!(shop.read("profile"), "mine\n");
    assert_eq!(check("sarif=near.sarif").code, 0);
    assert!(shop.read("shop/real.sarif").contains("2.1.0"));
}

#[test]
fn a_file_called_like_an_option_is_not_one() {
    let shop = Shop::with(&[("-ofile.nc", GOOD), ("a.nc", GOOD)]);
    let run = shop.gcheck("check -ofile.nc a.nc --no-cache --quiet");
    expect![[r#"
        ! error: `-ofile.nc` is an option and the name of a file here
        !   help: put `--` before paths, or write `./-ofile.nc`
        exit 2
    "#]]
    .assert_eq(&run.to_string());
    assert_eq!(shop.names(), ["-ofile.nc", "a.nc"]);
    for paths in ["-- -ofile.nc a.nc", "./-ofile.nc a.nc"] {
        assert_eq!(shop.gcheck(&format!("check --no-cache --quiet {paths}")).code, 0, "{paths}");
    }
}

#[test]
fn names_of_files_do_not_steer_the_terminal() {
    let shop = Shop::with(&[("\u{1b}]0;mine\u{7}\u{1b}[2Ja.nc", BAD), ("\u{1b}[31mgcheck.txt", "")]);
    for arguments in ["check .", "check missing\u{1b}[31m.nc", "check", "fmt --diff", "stats ."] {
        let run = shop.gcheck(&format!("{arguments} --control haas-mill"));
        assert!(!run.stderr.contains('\u{1b}'), "{arguments}: {run}");
    }
    let run = shop.gcheck("check --no-cache --control haas-mill");
    assert!(!run.stdout.contains('\u{1b}') && run.stdout.contains("unknown-code"), "{run}");
}

#[test]
fn a_plot_shows_text_as_text() {
    let text = "</script><script>alert`1`</script> <img src=x> ]]> --> \u{1b}[31m";
    let program = format!("O1 ({text})\nT1 M6 ({text})\nG0 G90 G54 X0. Y0.\nG1 X10. F100.\nM30\n");
    let shop = Shop::with(&[("a<b>.nc", program.as_str())]);
    for picture in ["out.html", "out.svg"] {
        let run = shop.gcheck(&format!("plot a<b>.nc -o {picture} --control haas-mill"));
        assert_eq!(run.code, 0, "{run}");
        let picture = shop.read(picture);
        for raw in ["<script>alert", "<img", "\u{1b}", "a<b>"] {
            assert!(!picture.contains(raw), "{raw}");
        }
    }
}

#[test]
fn blocks_without_end_take_no_other_file_down() {
    let deep = format!("O9\n{}\nM99\n", "IF[#1EQ1]THEN ".repeat(100_000));
    let shop = Shop::with(&[
        ("deep.nc", deep.as_str()),
        ("caller.nc", "%\nO1 (CALLS)\nG999\nM98 P9\nM30\n%\n"),
        ("other.nc", BAD),
    ]);
    let run = shop.gcheck("check --no-cache --quiet --output-format concise --control fanuc-mill");
    assert_eq!(run.code, 1, "{run}");
    for finding in ["caller.nc:3:1: warning[unknown-code]", "other.nc:3:1: warning[unknown-code]"] {
        assert!(run.findings().iter().any(|found| found == finding), "{finding}: {run}");
    }
    assert_eq!(run.rules().iter().filter(|rule| *rule == "expression-too-deep").count(), 1, "{run}");
    for command in ["run", "stats", "fmt --check"] {
        let run = shop.gcheck(&format!("{command} deep.nc --control fanuc-mill"));
        assert!(matches!(run.code, 0..=2), "{command}: {run}");
    }
}

#[test]
fn blocks_that_a_semicolon_ends_are_read_once() {
    let shop = Shop::with(&[("a.nc", &format!("O1\n{}\nM30\n", "G0;".repeat(100_000)))]);
    let start = Instant::now();
    let run = shop.gcheck(&format!("{CHECK} a.nc"));
    assert!(matches!(run.code, 0 | 1) && start.elapsed() < PATIENCE, "{:?}", start.elapsed());
}

#[test]
fn an_analysis_that_did_not_end_can_fail() {
    let shop = Shop::with(&[("a.nc", "%\nO1\nG21 G90\nN1 #1=#1+1\nIF[#1LT1000]GOTO1\nM30\n%\n")]);
    let check = |arguments: &str| shop.gcheck(&format!("check --no-cache --control haas-mill {arguments}"));
    let run = check("--fuel 3 --output-format json");
    assert_eq!(run.json()["summary"]["out_of_fuel"][0], "a.nc");
    assert_eq!(check("--fuel 3 --fail-on never").code, 0);
    assert_eq!(check("--fuel 3 --fail-on never --fail-on-incomplete").code, 1);
    assert_eq!(check("--fail-on never --fail-on-incomplete").code, 0);
}

#[test]
fn files_that_could_not_be_checked_are_in_the_report() {
    let shop = Shop::with(&[("a.nc", GOOD)]);
    shop.file("b.nc", [0_u8, 159, 146, 150].repeat(100));
    let run = shop.gcheck("check --no-cache --output-format json --control haas-mill");
    assert_eq!(run.code, 2, "{run}");
    let skipped = &run.json()["summary"]["skipped"];
    assert_eq!(skipped.as_array().unwrap().len(), 1, "{run}");
    assert_eq!(skipped[0]["file"], "b.nc");
    assert!(skipped[0]["reason"].as_str().is_some_and(|reason| reason.contains("not text")), "{run}");
}
