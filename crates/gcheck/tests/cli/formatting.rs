//! `gcheck fmt`: which files change and which are left alone, what is printed, and that no program is ever damaged.

use expect_test::expect;

use crate::shop::Shop;

const ROUGH: &str = "%\r\no0001 (PART)\r\nN5g21g90G17\r\n\r\n\r\nN6 g0x1.  y2. \r\nN7 M30\r\n%\r\n";
const SMOOTH: &str = "%\r\nO0001 (PART)\r\nN5 G21 G90 G17\r\n\r\nN6 G0 X1. Y2.\r\nN7 M30\r\n%\r\n";

#[test]
fn programs_are_formatted_and_the_others_left_alone() {
    let shop = Shop::with(&[("a.nc", ROUGH), ("b.nc", SMOOTH), ("notes.txt", "g0  x1.\n")]);
    expect![[r#"
        ! a.nc: formatted for haas-mill
        ! 1 file formatted, 1 left unchanged
        exit 0
    "#]]
    .assert_eq(&shop.gcheck("fmt --control haas-mill").to_string());
    assert_eq!((shop.read("a.nc"), shop.read("b.nc")), (SMOOTH.to_owned(), SMOOTH.to_owned()));
    assert_eq!(shop.read("notes.txt"), "g0  x1.\n");
    assert_eq!(shop.names(), ["a.nc", "b.nc", "notes.txt"], "nothing else stays behind");
    expect![[r#"
        ! 2 files already formatted
        exit 0
    "#]]
    .assert_eq(&shop.gcheck("fmt --control haas-mill").to_string());
}

#[test]
fn a_check_lists_and_changes_nothing() {
    let shop = Shop::with(&[("a.nc", ROUGH), ("b.nc", SMOOTH), ("c.nc", ROUGH)]);
    expect![[r#"
        a.nc
        c.nc
        ! 2 files would change, 1 already formatted
        exit 1
    "#]]
    .assert_eq(&shop.gcheck("fmt --control haas-mill --check").to_string());
    assert_eq!(shop.read("a.nc"), ROUGH);
    expect![[r#"
        ! 1 file already formatted
        exit 0
    "#]]
    .assert_eq(&shop.gcheck("fmt --control haas-mill --check b.nc").to_string());
}

#[test]
fn a_difference_changes_nothing() {
    let shop = Shop::with(&[("a.nc", ROUGH), ("b.nc", SMOOTH)]);
    let run = shop.gcheck("fmt --control haas-mill --diff");
    expect![[r#"
        --- a/a.nc
        +++ b/a.nc
        @@ -1,8 +1,7 @@
         %
        -o0001 (PART)
        -N5g21g90G17
        -
        +O0001 (PART)
        +N5 G21 G90 G17

        -N6 g0x1.  y2. 
        +N6 G0 X1. Y2.
         N7 M30
         %
        ! 1 file would change, 1 already formatted
        exit 1
    "#]]
    // An editor may cut the blank of an empty line in the text above.
    .assert_eq(&run.to_string().replace('\r', "").replace("\n \n", "\n\n"));
    assert_eq!(shop.read("a.nc"), ROUGH);
    assert_eq!(shop.gcheck("fmt --control haas-mill --diff --check").code, 2);
}

#[test]
fn standard_input_goes_to_standard_output() {
    let shop = Shop::new();
    let run = shop.gcheck_reading("fmt --control haas-mill -", ROUGH.as_bytes());
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (0, SMOOTH, ""));
    let run = shop.gcheck_reading("fmt --control haas-mill -", SMOOTH.as_bytes());
    assert_eq!((run.code, run.stdout.as_str()), (0, SMOOTH));
    let run =
        shop.gcheck_reading("fmt --control haas-mill --check --stdin-filename x/a.nc -", ROUGH.as_bytes());
    assert_eq!((run.code, run.stdout.as_str()), (1, "x/a.nc\n"));
    let run = shop.gcheck_reading("fmt --control haas-mill --diff -", ROUGH.as_bytes());
    assert!(run.code == 1 && run.stdout.contains("+O0001 (PART)"), "{run}");
    expect![[r#"
        ! error: standard input is formatted alone, without other files
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("fmt - a.nc").to_string());
}

#[test]
fn the_style_of_the_shop_is_configured() {
    let shop = Shop::with(&[
        (
            "gcheck.toml",
            "control = \"haas-mill\"\n[format]\nleading-zeros = \"add\"\ncomment-column = 24\nindentation = \"nested\"\n\
             [[overrides]]\nfiles = [\"old/**\"]\nformat = { word-spacing = \"none\", leading-zeros = \"drop\" }\n",
        ),
        ("a.nc", "O1\nWHILE [#1 LT 2] DO1\nG1X1.(A)\nEND1\nM30\n"),
        ("old/b.nc", "O1\nG01 X1.   Y2. (A)\nM30\n"),
    ]);
    assert_eq!(shop.gcheck("fmt --quiet").code, 0);
    assert_eq!(shop.read("a.nc"), "O1\nWHILE [#1 LT 2] DO1\n  G01 X1.              (A)\nEND1\nM30\n");
    assert_eq!(shop.read("old/b.nc"), "O1\nG1X1.Y2.               (A)\nM30\n");
    shop.file("gcheck.toml", "[format]\nleading_zeros = \"add\"\n");
    expect![[r#"
        ! error: gcheck.toml:2:1: unknown key `leading_zeros`; did you mean `leading-zeros`?
        !   |
        ! 2 | leading_zeros = "add"
        !   | ^^^^^^^^^^^^^
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("fmt a.nc").to_string());
}

#[test]
fn blocks_are_numbered_anew_with_all_that_names_them() {
    let program = "O1\nN1 G0 X1.\nN2 M97 P9\nIF [#1 EQ 1] GOTO 2\nM30\nN9 G1  X2.\nM99\n";
    let shop = Shop::with(&[("a.nc", program)]);
    expect![[r#"
        --- a/a.nc
        +++ b/a.nc
        @@ -1,7 +1,7 @@
         O1
        -N1 G0 X1.
        -N2 M97 P9
        -IF [#1 EQ 1] GOTO 2
        +N100 G0 X1.
        +N110 M97 P120
        +IF [#1 EQ 1] GOTO 110
         M30
        -N9 G1  X2.
        +N120 G1 X2.
         M99
        ! 1 file would change
        exit 1
    "#]]
    .assert_eq(&shop.gcheck("fmt --control haas-mill --renumber 100:10 --diff").to_string());
    expect![[r#"
        ! a.nc: renumbered and formatted for haas-mill
        ! 1 file formatted
        exit 0
    "#]]
    .assert_eq(&shop.gcheck("fmt --control haas-mill --renumber 100:10").to_string());
    assert_eq!(
        shop.read("a.nc"),
        "O1\nN100 G0 X1.\nN110 M97 P120\nIF [#1 EQ 1] GOTO 110\nM30\nN120 G1 X2.\nM99\n"
    );
    assert_eq!(shop.gcheck("fmt --control haas-mill --renumber 100:10 --check").code, 0);
}

#[test]
fn numbers_that_go_leave_no_gap() {
    let shop = Shop::with(&[("a.nc", "O1\nN1 G0 X1.\nN2 G0 X2.\nN3 GOTO 2\nM30\n")]);
    let config = "--config format.sequence-numbers=drop";
    let run = shop.gcheck(&format!("fmt --control haas-mill {config} --renumber 10:10"));
    assert_eq!(shop.read("a.nc"), "O1\nG0 X1.\nN10 G0 X2.\nGOTO 10\nM30\n", "{run}");
}

#[test]
fn what_cannot_be_renumbered_stays_as_it_is_and_the_place_is_said() {
    let program = "O1\nN1 G0 X1.\nIF [#1 EQ 1] GOTO #2\nM30\n";
    let shop = Shop::with(&[("a.nc", program), ("b.nc", "O2\nN1 G0 X1.\nM30\n")]);
    expect![[r#"
        ! b.nc: renumbered and formatted for haas-mill
        ! 1 file formatted
        ! error: a.nc:3:14: cannot renumber: the block that this names is computed, so its number cannot be followed
        !   |
        ! 3 | IF [#1 EQ 1] GOTO #2
        !   |              ^^^^^^^
        !   note: the file was left as it is
        exit 2
    "#]].assert_eq(&shop.gcheck("fmt --control haas-mill --renumber 10:10").to_string());
    assert_eq!((shop.read("a.nc").as_str(), shop.read("b.nc").as_str()), (program, "O2\nN10 G0 X1.\nM30\n"));
    expect![[r#"
        ! error: b.nc: cannot renumber: block numbers of the control go from 1 to 99999, in steps of 1 or more
        !   note: the file was left as it is
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("fmt --control haas-mill --renumber 100000:10 b.nc").to_string());
    for wrong in ["10", "0:10", "10:0", "a:b", "10:"] {
        assert_eq!(shop.gcheck(&format!("fmt --renumber {wrong}")).code, 2, "{wrong}");
    }
}

#[test]
fn bytes_of_code_pages_and_a_byte_order_mark_stay() {
    let shop = Shop::new();
    shop.file("part.nc", b"\xEF\xBB\xBF%\r\no1 (D\xE9P)\r\ng21g0X1.(\xB5)\rM30\n%");
    let run = shop.gcheck("fmt --control haas-mill");
    let expected = b"\xEF\xBB\xBF%\r\nO1 (D\xE9P)\r\nG21 G0 X1.(\xB5)\rM30\n%";
    assert_eq!(std::fs::read(shop.path("part.nc")).unwrap(), expected, "{run}");
}

#[test]
fn files_that_cannot_be_read_or_are_no_programs() {
    let shop = Shop::new();
    shop.file("picture.nc", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\0\0\0\0\0\0\0");
    shop.file("a.nc", ROUGH);
    let run = shop.gcheck("fmt --control haas-mill --quiet");
    expect![[r#"
        ! error: picture.nc: is not text, so it is not a part program
        exit 2
    "#]]
    .assert_eq(&run.to_string());
    assert_eq!(shop.read("a.nc"), SMOOTH);
    expect![[r#"
        ! error: missing.nc: no such file or folder
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("fmt missing.nc").to_string());
    expect![[r#"
        ! no programs found
        exit 0
    "#]]
    .assert_eq(&Shop::new().gcheck("fmt").to_string());
}

#[cfg(unix)]
#[test]
fn a_read_only_file_is_left_alone_and_permissions_stay() {
    use std::os::unix::fs::PermissionsExt as _;

    let shop = Shop::with(&[("locked.nc", ROUGH), ("part.nc", ROUGH), ("real/c.nc", ROUGH)]);
    shop.chmod("locked.nc", 0o444);
    shop.chmod("part.nc", 0o640);
    std::os::unix::fs::symlink("real/c.nc", shop.path("link.nc")).unwrap();
    let run = shop.gcheck("fmt --control haas-mill locked.nc part.nc link.nc");
    expect![[r#"
        ! part.nc: formatted for haas-mill
        ! link.nc: formatted for haas-mill
        ! 2 files formatted
        ! error: locked.nc: cannot format: the file is read-only
        exit 2
    "#]]
    .assert_eq(&run.to_string());
    assert_eq!((shop.read("locked.nc").as_str(), shop.read("part.nc").as_str()), (ROUGH, SMOOTH));
    assert_eq!(shop.path("part.nc").metadata().unwrap().permissions().mode() & 0o777, 0o640);
    assert!(shop.path("link.nc").symlink_metadata().unwrap().is_symlink());
    assert_eq!(shop.read("real/c.nc"), SMOOTH);
}

#[cfg(unix)]
#[test]
fn a_file_and_a_link_to_it_are_one_file() {
    let shop = Shop::with(&[("real/c.nc", ROUGH)]);
    std::os::unix::fs::symlink("real/c.nc", shop.path("link.nc")).unwrap();
    expect![[r#"
        real/c.nc
        ! 1 file would change
        exit 1
    "#]]
    .assert_eq(&shop.gcheck("fmt --check --control haas-mill").to_string());
    expect![[r#"
        ! real/c.nc: formatted for haas-mill
        ! 1 file formatted
        exit 0
    "#]]
    .assert_eq(&shop.gcheck("fmt --control haas-mill").to_string());
}

#[test]
fn the_output_does_not_depend_on_the_number_of_threads() {
    let files: Vec<(String, String)> =
        (0..40).map(|at| (format!("p{at:02}.nc"), format!("O{at}\nn{at}g0x{at}.\nM30\n"))).collect();
    let files: Vec<(&str, &str)> = files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    let shop = Shop::with(&files);
    let one = shop.gcheck("fmt --control haas-mill --diff --jobs 1").to_string();
    assert_eq!(shop.gcheck("fmt --control haas-mill --diff --jobs 8").to_string(), one);
}
