//! Which files are checked: those named, the programs in folders, standard input.

use crate::shop::{BAD, GOOD, Shop};

fn check_files(shop: &Shop, arguments: &str, expected: &[&str]) {
    let run = shop.gcheck(&format!("check --show-files {arguments}"));
    assert_eq!(run.stdout.lines().collect::<Vec<_>>(), expected, "{arguments}\n{run}");
    assert_eq!(run.code, 0, "{run}");
}

#[test]
fn programs_are_known_by_extension_in_any_case_and_by_number() {
    let shop = Shop::new();
    let programs = [
        "O1234", "a.NC", "b.ngc", "c.Cnc", "d.tap", "e.eia", "f.ncf", "g.gcode", "h.iso", "i.din", "j.prg",
        "k.MPF", "l.spf", "m.MIN", "o7",
    ];
    for name in programs.iter().chain(&["readme.txt", "O12A", "tool.tbl", "notes", "x.nc.bak"]) {
        shop.file(name, GOOD);
    }
    check_files(&shop, "", &programs);
}

#[test]
fn the_order_is_that_of_the_names() {
    let shop = Shop::with(&[("b.nc", GOOD), ("a/z.nc", GOOD), ("a.nc", GOOD), ("c/a.nc", GOOD)]);
    check_files(&shop, "", &["a/z.nc", "a.nc", "b.nc", "c/a.nc"]);
}

#[test]
fn a_file_is_checked_once() {
    let shop = Shop::with(&[("a.nc", GOOD), ("b/c.nc", GOOD)]);
    check_files(&shop, "a.nc . ./a.nc b b/../a.nc b/c.nc", &["a.nc", "b/c.nc"]);
}

#[test]
fn ignore_files_are_honoured() {
    let shop = Shop::with(&[
        (".gitignore", "old/\n"),
        (".ignore", "ignored.nc\n"),
        (".gcheckignore", "*.tap\n!keep.tap\n"),
        ("old/a.nc", GOOD),
        ("ignored.nc", GOOD),
        ("b.tap", GOOD),
        ("keep.tap", GOOD),
        ("c.nc", GOOD),
        ("deep/.gcheckignore", "d.nc\n"),
        ("deep/d.nc", GOOD),
        ("deep/e.nc", GOOD),
    ]);
    check_files(&shop, "", &["c.nc", "deep/e.nc", "keep.tap"]);
}

#[test]
fn the_files_table_includes_and_excludes() {
    let shop = Shop::with(&[
        ("gcheck.toml", "[files]\ninclude = [\"*.txt\", \"jobs/*.nc\"]\nexclude = [\"old/\", \"draft-*\"]\n"),
        ("a.txt", GOOD),
        ("b.nc", GOOD),
        ("jobs/c.nc", GOOD),
        ("jobs/draft-d.nc", GOOD),
        ("jobs/old/e.txt", GOOD),
    ]);
    check_files(&shop, "", &["a.txt", "jobs/c.nc"]);
}

#[test]
fn a_named_file_is_always_read() {
    let shop = Shop::with(&[
        (".gitignore", "*.txt\n"),
        ("gcheck.toml", "[files]\nexclude = [\"b.nc\"]\n"),
        ("a.txt", BAD),
        ("b.nc", BAD),
    ]);
    check_files(&shop, "", &[]);
    check_files(&shop, "a.txt b.nc", &["a.txt", "b.nc"]);
}

#[cfg(unix)]
#[test]
fn a_configuration_among_the_named_files_is_not_a_program() {
    let shop = Shop::with(&[("gcheck.toml", "control = \"haas-mill\"\n"), ("a.nc", GOOD), ("b.nc", BAD)]);
    shop.file(".gcheck.toml", "control = \"haas-mill\"\n");
    shop.file("changed.txt", "a.nc\ngcheck.toml\n");
    // As a shell expands `*`, as gcheck does, and as a list of changed files has it.
    check_files(&shop, "a.nc b.nc gcheck.toml .gcheck.toml", &["a.nc", "b.nc"]);
    check_files(&shop, "[abg.]*[cl]", &["a.nc", "b.nc"]);
    check_files(&shop, "--files-from changed.txt", &["a.nc"]);
    assert_eq!(shop.gcheck("check a.nc gcheck.toml").code, 0);
    let alone = shop.gcheck("check gcheck.toml");
    assert_eq!((alone.code, alone.stdout.as_str()), (0, "no programs found\n"), "{alone}");
    // The schema that `init --schema` writes beside it is not one either.
    shop.file("gcheck.schema.json", "{\n\"$schema\": 1\n}\n");
    check_files(&shop, "a.nc gcheck.toml gcheck.schema.json", &["a.nc"]);
    // Named alone it is checked as what it is.
    shop.file("gcheck.toml", "contrl = 1\n");
    let wrong = shop.gcheck("check gcheck.toml");
    assert_eq!(wrong.code, 2, "{wrong}");
    assert_eq!(wrong.stderr.matches("unknown key `contrl`").count(), 1, "{wrong}");
    shop.file("sub/gcheck.toml", "contrl = 1\n");
    shop.file("gcheck.toml", "");
    assert_eq!(shop.gcheck("check a.nc sub/gcheck.toml").code, 2);
}

#[test]
fn links_are_no_trap() {
    use std::os::unix::fs::symlink;

    let shop = Shop::with(&[("jobs/a.nc", GOOD)]);
    symlink("..", shop.path("jobs/loop")).unwrap();
    symlink("nowhere.nc", shop.path("jobs/broken.nc")).unwrap();
    symlink("self.nc", shop.path("jobs/self.nc")).unwrap();
    check_files(&shop, "", &["jobs/a.nc"]);
    let run = shop.gcheck("check jobs/broken.nc jobs/self.nc");
    assert_eq!(run.code, 2);
    assert_eq!(
        run.stderr,
        "error: jobs/broken.nc: no such file or folder\nerror: jobs/self.nc: no such file or folder\n"
    );
}

#[cfg(unix)]
#[test]
fn a_folder_that_cannot_be_entered_is_a_problem() {
    let shop = Shop::with(&[("a.nc", GOOD), ("locked/b.nc", GOOD)]);
    if !shop.permissions_count("a_folder_that_cannot_be_entered_is_a_problem") {
        return;
    }
    shop.chmod("locked", 0);
    let run = shop.gcheck("check");
    shop.chmod("locked", 0o755);
    assert_eq!(run.code, 2, "{run}");
    assert!(run.stderr.contains("locked"), "{run}");
}

#[test]
fn names_with_blanks_and_other_letters() {
    let shop = Shop::with(&[("mein ordner/fräsen 1.nc", BAD)]);
    let run = shop.gcheck("check --control haas-mill --output-format concise --quiet");
    assert_eq!(run.findings(), ["mein ordner/fräsen 1.nc:3:1: error[unknown-code]"]);
}

#[test]
fn standard_input_has_the_name_it_is_given() {
    let shop = Shop::with(&[("lathe/gcheck.toml", "control = \"haas-lathe\"")]);
    let run = shop.gcheck_reading(
        "check - --stdin-filename lathe/part.nc --output-format json --fail-on warning",
        BAD.as_bytes(),
    );
    let json = run.json();
    assert_eq!(json["files"][0]["file"], "lathe/part.nc");
    assert_eq!(json["files"][0]["control"]["name"], "haas-lathe");
    assert_eq!(json["findings"][0]["file"], "lathe/part.nc");
    assert_eq!(run.code, 1);
}

#[test]
fn standard_input_without_a_name() {
    let shop = Shop::with(&[("gcheck.toml", "control = \"haas-mill\""), ("a.nc", BAD)]);
    let run = shop.gcheck_reading("check - --output-format concise --quiet", BAD.as_bytes());
    assert_eq!(run.findings(), ["stdin:3:1: error[unknown-code]"]);
    let run = shop.gcheck_reading("check - a.nc --output-format concise --quiet", BAD.as_bytes());
    assert_eq!(run.findings(), ["a.nc:3:1: error[unknown-code]", "stdin:3:1: error[unknown-code]"]);
    assert_eq!(
        shop.gcheck_reading("check -", b"\x7fELF\x02\x01\x01\0\0\0\0\0").stderr,
        "error: stdin: is not text, so it is not a part program\n"
    );
}

#[test]
fn a_file_may_list_what_is_checked() {
    let shop = Shop::with(&[
        ("a.nc", GOOD),
        ("b/c.nc", GOOD),
        ("d.txt", GOOD),
        ("list.txt", "a.nc\r\n\n d.txt\nb\n"),
    ]);
    check_files(&shop, "--files-from list.txt", &["a.nc", "d.txt", "b/c.nc"]);
    let run = shop.gcheck_reading("check --show-files --files-from -", b"b/c.nc\0a.nc\0");
    assert_eq!((run.code, run.stdout.as_str()), (0, "b/c.nc\na.nc\n"), "{run}");
    shop.file("bad.txt", "a.nc\nmissing.nc\n");
    let run = shop.gcheck("check -q --files-from bad.txt");
    assert!(run.code == 2 && run.stderr.contains("missing.nc: no such file or folder"), "{run}");
    shop.file("empty.txt", "\n\n");
    let run = shop.gcheck("check --files-from empty.txt");
    assert!(run.code == 0 && run.stderr.contains("empty.txt: lists no files"), "{run}");
    let run = shop.gcheck("check a.nc --files-from list.txt");
    assert_eq!(run.code, 2, "{run}");
}

#[test]
fn patterns_that_the_shell_left_are_expanded() {
    let shop = Shop::with(&[("a.nc", GOOD), ("b/c.nc", GOOD), ("b/d.txt", GOOD), ("b/e/f.nc", GOOD)]);
    check_files(&shop, "*.nc", &["a.nc"]);
    check_files(&shop, "b/*", &["b/c.nc", "b/d.txt"]);
    check_files(&shop, "**/*.nc", &["a.nc", "b/c.nc", "b/e/f.nc"]);
    check_files(&shop, "./b/{c,x}.nc", &["b/c.nc"]);
    let run = shop.gcheck("check x*.nc");
    assert!(run.code == 2 && run.stderr.contains("x*.nc: no file fits this pattern"), "{run}");
    let run = shop.gcheck("check [a");
    assert!(run.code == 2 && run.stderr.contains("as a pattern it cannot be read"), "{run}");
    // A file of this very name is that file.
    let shop = Shop::with(&[("part[1].nc", GOOD), ("part1.nc", GOOD)]);
    check_files(&shop, "part[1].nc", &["part[1].nc"]);
}

#[test]
fn programs_with_the_names_of_other_files_are_told_and_not_read() {
    let program = "%\nO0001 (A)\nG21 G90\nG0 X1.\nG1 Y2. F100.\nM30\n%\n";
    let shop = Shop::with(&[
        ("part.nc", program),
        ("a.txt", program),
        ("B.TXT", program),
        ("notes.txt", "Tighten the vise.\nThen start.\n"),
        ("plate.h", "0 BEGIN PGM PLATE MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n2 TOOL CALL 5 Z S2000\n"),
        ("main.h", "int main(void);\n"),
    ]);
    let run = shop.gcheck("check --control haas-mill");
    assert!(
        run.stderr.contains(
            "1 file ending in .h looks like a program and is not checked: name it, or set `include` under `[files]` in \
             `gcheck.toml`"
        ) && run.stderr.contains("2 files ending in .txt look like programs and are not checked: name them"),
        "{run}"
    );
    assert!(run.stdout.contains("in 1 file"), "{run}");
    assert!(!shop.gcheck("check --control haas-mill -q").stderr.contains("look like"));
    // What the configuration leaves out is left out.
    shop.file("gcheck.toml", "[files]\nexclude = [\"*.txt\", \"*.TXT\", \"*.h\"]\n");
    assert!(!shop.gcheck("check --control haas-mill").stderr.contains("look"));
    shop.file("gcheck.toml", "[files]\ninclude = [\"*.nc\"]\n");
    assert!(!shop.gcheck("check --control haas-mill").stderr.contains("look"));
}

#[test]
fn a_pattern_below_a_folder_that_is_not_there_is_one_mistake() {
    let run = Shop::new().command().args(["check", "sub/**/*.nc"]).output().unwrap();
    assert_eq!(
        String::from_utf8(run.stderr).unwrap(),
        "error: sub/**/*.nc: no file fits this pattern: there is no folder sub\n"
    );
}
