//! `--fix`, `--unsafe-fixes`, `--diff`: what is fixed, what is left, and that no program is ever damaged.

use expect_test::expect;

use crate::shop::{GOOD, Shop};

/// One finding with a safe fix (an unclosed comment), one with a fix for the programmer to judge (O for zero).
const MENDABLE: &str = "%\r\nO0001 (PART\r\nG21 G90 G17\r\nG0 X1O. Y2.\r\nM30\r\n%\r\n";

const CHECK: &str =
    "check --control haas-mill --output-format concise --select unclosed-comment,letter-o-for-zero";

#[test]
fn a_safe_fix_is_made_and_the_rest_reported() {
    let shop = Shop::with(&[("part.nc", MENDABLE)]);
    expect![[r#"
        part.nc:4:6: error[letter-o-for-zero] letter `O` instead of a zero in `X1O.`
        ! part.nc: control haas-mill, set by `--control`
        ! 1 error in 1 file (6 lines); 1 fixed
        exit 1
    "#]]
    .assert_eq(&shop.gcheck(&format!("{CHECK} --fix")).to_string());
    assert_eq!(shop.read("part.nc"), MENDABLE.replace("(PART", "(PART)"));
    let run = shop.gcheck(&format!("{CHECK} --fix"));
    assert!(!run.stderr.contains("fixed"), "{run}");
}

#[test]
fn other_fixes_are_made_on_request() {
    let shop = Shop::with(&[("part.nc", MENDABLE)]);
    expect![[r#"
        ! part.nc: control haas-mill, set by `--control`
        ! no findings in 1 file (6 lines); 2 fixed
        exit 0
    "#]]
    .assert_eq(&shop.gcheck(&format!("{CHECK} --fix --unsafe-fixes")).to_string());
    assert_eq!(shop.read("part.nc"), MENDABLE.replace("(PART", "(PART)").replace("X1O.", "X10."));
}

#[test]
fn a_difference_changes_nothing() {
    let shop = Shop::with(&[("part.nc", MENDABLE), ("good.nc", GOOD)]);
    expect![[r#"
        --- a/part.nc
        +++ b/part.nc
        @@ -1,5 +1,5 @@
         %
        -O0001 (PART
        +O0001 (PART)
         G21 G90 G17
         G0 X1O. Y2.
         M30
        ! 1 finding would be fixed in 1 file
        exit 1
    "#]]
    .assert_eq(&shop.gcheck(&format!("{CHECK} --diff")).to_string().replace('\r', ""));
    assert_eq!(shop.read("part.nc"), MENDABLE);
    let run = shop.gcheck(&format!("{CHECK} --diff good.nc"));
    assert_eq!((run.code, run.stdout.as_str()), (0, ""), "{run}");
    let run = shop.gcheck_reading(&format!("{CHECK} --diff -"), MENDABLE.as_bytes());
    assert!(run.code == 1 && run.stdout.contains("+O0001 (PART)"), "{run}");
}

#[test]
fn bytes_of_code_pages_and_a_byte_order_mark_stay() {
    let shop = Shop::new();
    let program = b"\xEF\xBB\xBF%\r\nO1 (D\xE9P\r\nG21 G0 X1. (\xB5)\r\nM30\r\n%";
    shop.file("part.nc", program);
    let run = shop.gcheck(&format!("{CHECK} --fix"));
    let expected = b"\xEF\xBB\xBF%\r\nO1 (D\xE9P)\r\nG21 G0 X1. (\xB5)\r\nM30\r\n%";
    assert_eq!(std::fs::read(shop.path("part.nc")).unwrap(), expected, "{run}");
}

#[cfg(unix)]
#[test]
fn a_read_only_file_is_left_alone_and_permissions_stay() {
    use std::os::unix::fs::PermissionsExt as _;

    let shop = Shop::with(&[("locked.nc", MENDABLE), ("part.nc", MENDABLE)]);
    shop.chmod("locked.nc", 0o444);
    shop.chmod("part.nc", 0o640);
    let run = shop.gcheck(&format!("{CHECK} --quiet --fix"));
    expect![[r#"
        part.nc:4:6: error[letter-o-for-zero] letter `O` instead of a zero in `X1O.`
        ! error: locked.nc: cannot fix: the file is read-only
        exit 2
    "#]]
    .assert_eq(&run.to_string());
    assert_eq!(shop.read("locked.nc"), MENDABLE);
    assert_eq!(shop.path("part.nc").metadata().unwrap().permissions().mode() & 0o777, 0o640);
    assert_eq!(shop.names(), ["locked.nc", "part.nc"], "nothing else stays behind");
}

#[cfg(unix)]
#[test]
fn a_link_stays_a_link() {
    let shop = Shop::with(&[("real/part.nc", MENDABLE)]);
    std::os::unix::fs::symlink("real/part.nc", shop.path("link.nc")).unwrap();
    let run = shop.gcheck(&format!("{CHECK} --fix link.nc"));
    assert!(shop.path("link.nc").symlink_metadata().unwrap().is_symlink(), "{run}");
    assert!(shop.read("real/part.nc").contains("(PART)"));
}

#[test]
fn standard_input_and_flags_without_their_command() {
    let shop = Shop::new();
    expect![[r#"
        ! error: standard input cannot be fixed
        !   help: `--diff` shows what would change
        exit 2
    "#]]
    .assert_eq(&shop.gcheck("check --fix -").to_string());
    assert_eq!(shop.gcheck("check --unsafe-fixes").code, 2);
    assert_eq!(shop.gcheck("check --fix --diff").code, 2);
}

/// The second input is a pipe that is not filled before the first file was checked and changed by somebody else.
#[cfg(unix)]
#[test]
fn a_file_that_changes_while_it_is_fixed_is_left_alone() {
    use std::fs;
    use std::process::{Command, Stdio};

    let shop = Shop::with(&[("part.nc", MENDABLE)]);
    assert!(Command::new("mkfifo").arg(shop.path("pipe")).status().unwrap().success());
    let mut command = shop.command();
    command.args(format!("{CHECK} --quiet --fix --jobs 1 part.nc pipe").split_whitespace());
    let child = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    // Opening it waits for its reader.
    let mut pipe = fs::File::options().write(true).open(shop.path("pipe")).unwrap();
    let theirs = MENDABLE.replace("Y2.", "Y3.");
    shop.file("part.nc", &theirs);
    std::io::Write::write_all(&mut pipe, GOOD.as_bytes()).unwrap();
    drop(pipe);
    let output = child.wait_with_output().unwrap();
    expect![[r#"
        error: part.nc: was changed by another program in the meantime, and is not written
          help: run gcheck again
    "#]]
    .assert_eq(&String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(shop.read("part.nc"), theirs);
    assert_eq!(shop.names(), ["part.nc", "pipe"], "nothing else stays behind");
}
