//! The cache of results: findings out of it are those that a check finds, whatever became of the folder.

use std::fs;
use std::path::PathBuf;

use expect_test::expect;
use gcheck_report::Format;

use crate::shop::{BAD, GOOD, Run, Shop, WARNED};

/// A call of another file, a finding with a fix, letters beyond ASCII, a byte of a code page.
const CALLER: &[u8] =
    b"%\r\nO0002 G21 G90 (D\xE9P, \xC3\x84)\r\nM98 P100\r\nG0 X1O. Y2.\r\nM98 P200\r\nM30\r\n%\r\n";
const CALLED: &str = "%\nO0100\nG0 Z5.\nM99\n%\n";

fn shop() -> Shop {
    let shop = Shop::with(&[
        ("a.nc", BAD),
        ("jobs/b.nc", WARNED),
        ("jobs/good.nc", GOOD),
        ("jobs/O0100.nc", CALLED),
    ]);
    shop.file("jobs/caller.nc", CALLER);
    shop
}

/// Runs `check` with a cache beside the programs.
fn check(shop: &Shop, arguments: &str) -> Run {
    shop.gcheck(&format!("check --control haas-mill --cache-dir .cache/gcheck {arguments}"))
}

/// The entries of the cache.
fn entries(shop: &Shop) -> Vec<PathBuf> {
    let mut entries = Vec::new();
    for shelf in fs::read_dir(shop.path(".cache/gcheck")).unwrap().map(|e| e.unwrap().path()) {
        if shelf.is_dir() {
            entries.extend(fs::read_dir(shelf).unwrap().map(|e| e.unwrap().path()));
        }
    }
    entries.sort();
    entries
}

#[test]
fn every_format_is_the_same_byte_for_byte() {
    let shop = shop();
    for format in Format::ALL {
        let arguments = format!("--output-format {}", format.name());
        let fresh = check(&shop, &format!("{arguments} --no-cache"));
        assert_eq!(check(&shop, &arguments).to_string(), fresh.to_string(), "{}, stored", format.name());
        assert_eq!(check(&shop, &arguments).to_string(), fresh.to_string(), "{}, read", format.name());
    }
    assert_eq!(entries(&shop).len(), 5, "one for each program, whatever the format");
}

/// What becomes of an entry.
type Damage = fn(&[u8]) -> Vec<u8>;

/// Puts something else into every entry that only a reader of the cache would notice.
fn poison(shop: &Shop, with: Damage) {
    for entry in entries(shop) {
        let bytes = with(&fs::read(&entry).unwrap());
        fs::write(entry, bytes).unwrap();
    }
}

#[test]
fn damaged_entries_are_ignored_and_written_anew() {
    let shop = shop();
    let fresh = check(&shop, "").to_string();
    let good: Vec<Vec<u8>> = entries(&shop).iter().map(|entry| fs::read(entry).unwrap()).collect();
    let damages: [(&str, Damage); 6] = [
        ("empty", |_| Vec::new()),
        ("torn", |bytes| bytes[..bytes.len() / 2].to_vec()),
        ("of another version", |bytes| [b"gcheck result 9\n", &bytes[16..]].concat()),
        ("one byte wrong", |bytes| {
            let mut bytes = bytes.to_vec();
            *bytes.last_mut().unwrap() ^= 1;
            bytes
        }),
        ("merged badly", |bytes| {
            [b"<<<<<<< HEAD\n", bytes, b"\n=======\n", bytes, b"\n>>>>>>> b\n"].concat()
        }),
        ("something else", |_| b"%\nO1\nM30\n%\n".repeat(1_000)),
    ];
    for (name, damage) in damages {
        poison(&shop, damage);
        assert_eq!(check(&shop, "").to_string(), fresh, "{name}");
        let now: Vec<Vec<u8>> = entries(&shop).iter().map(|entry| fs::read(entry).unwrap()).collect();
        assert_eq!(now, good, "{name}");
    }
}

#[test]
fn an_entry_under_a_wrong_name_is_ignored() {
    let shop = shop();
    let fresh = check(&shop, "").to_string();
    let entries = entries(&shop);
    let first = fs::read(&entries[0]).unwrap();
    for entry in &entries {
        fs::write(entry, &first).unwrap();
    }
    assert_eq!(check(&shop, "").to_string(), fresh);
}

#[test]
fn entries_are_really_read() {
    let shop = shop();
    check(&shop, "jobs/good.nc");
    let entry = &entries(&shop)[0];
    let written = || fs::metadata(entry).unwrap().modified().unwrap();
    let before = written();
    check(&shop, "jobs/good.nc");
    assert_eq!(written(), before, "what is read is not written again");
}

#[test]
fn a_change_of_anything_in_force_is_seen() {
    let shop = shop();
    let count = |shop: &Shop, arguments: &str| {
        check(shop, &format!("--output-format concise {arguments}")).findings().len()
    };
    let all = count(&shop, "");
    assert_eq!(count(&shop, ""), all);
    assert!(count(&shop, "--select unknown-code") < all, "rules of the command line");
    shop.file("gcheck.toml", "[rules]\nignore = [\"unknown-code\"]\n");
    assert_eq!(count(&shop, ""), all - 1, "rules of a configuration");
    shop.file("gcheck.toml", "[codes]\nG999 = { title = \"air blast\" }\n");
    assert_eq!(count(&shop, ""), all - 1, "codes of a configuration");
    shop.file("gcheck.toml", "[per-file-ignores]\n\"a.nc\" = [\"unknown-code\"]\n");
    assert_eq!(count(&shop, ""), all - 1, "rules for some files");
    fs::remove_file(shop.path("gcheck.toml")).unwrap();
    assert_eq!(count(&shop, ""), all);
    shop.file("a.nc", BAD.replace("G999", "G999\nG998"));
    assert_eq!(count(&shop, ""), all + 1, "the program");
    let run = |control: &str| {
        let arguments = format!("check --control {control} --cache-dir .cache/gcheck --output-format json");
        shop.gcheck(&arguments).stdout
    };
    assert_ne!(run("linuxcnc"), run("haas-mill"), "the control");
}

#[test]
fn a_change_of_called_programs_is_seen() {
    let shop = Shop::with(&[("main.nc", "%\nO0001 G21 G90 G17\nM98 P100\nM30\n%\n")]);
    let rules = |shop: &Shop| {
        check(
            shop,
            "--select subprogram-missing,subprogram-without-return,unknown-code main.nc --output-format concise",
        )
        .rules()
    };
    assert_eq!(rules(&shop), ["subprogram-missing"]);
    assert_eq!(rules(&shop), ["subprogram-missing"]);
    shop.file("sub.nc", CALLED);
    assert_eq!(rules(&shop), [""; 0], "the program came");
    assert_eq!(rules(&shop), [""; 0]);
    fs::remove_file(shop.path("sub.nc")).unwrap();
    assert_eq!(rules(&shop), ["subprogram-missing"], "the program went");
}

#[test]
fn a_change_inside_a_called_program_is_seen() {
    let main = "%\nO0001 G21 G90 G17 G54\nT1 M6\nG43 H1 Z5.\nM3 S1000\nG1 X2. F100.\nM98 P100\nG1 X5. F100.\nM30\n%\n";
    let shop = Shop::with(&[("main.nc", main), ("sub.nc", "%\nO0100\nM3 S1000\nM99\n%\n")]);
    let rules = |shop: &Shop| check(shop, "--select spindle main.nc --output-format concise").rules();
    let turning = rules(&shop);
    assert_eq!(rules(&shop), turning);
    shop.file("sub.nc", "%\nO0100\nM5\nM99\n%\n");
    let stopped = rules(&shop);
    assert_ne!(stopped, turning);
    assert_eq!(rules(&shop), stopped);
    shop.file("sub.nc", "%\nO0100\nM3 S1000\nM99\n%\n");
    assert_eq!(rules(&shop), turning);
}

#[test]
fn a_change_of_a_tool_table_is_seen() {
    let shop = Shop::with(&[
        ("main.nc", "%\nO0001 G21 G90 G17\nT2 M6\nM30\n%\n"),
        ("gcheck.toml", "[tools]\ntable = \"tool.tbl\"\n"),
        ("tool.tbl", "T1 P1 Z50.\n"),
    ]);
    let rules = |shop: &Shop| check(shop, "--select tool-not-in-table --output-format concise").rules();
    assert_eq!(rules(&shop), ["tool-not-in-table"]);
    shop.file("tool.tbl", "T1 P1 Z50.\nT2 P2 Z60.\n");
    assert_eq!(rules(&shop), [""; 0]);
}

#[test]
fn a_baseline_stands_over_the_cache() {
    let shop = shop();
    let known = "--baseline known.json --output-format concise";
    let all = check(&shop, "--output-format concise").findings().len();
    assert_eq!(check(&shop, &format!("{known} --update-baseline")).code, 0);
    assert_eq!(check(&shop, known).findings().len(), 0);
    assert_eq!(check(&shop, "--output-format concise").findings().len(), all);
}

#[test]
fn the_folder_keeps_itself_out_of_version_control() {
    let shop = shop();
    check(&shop, "");
    expect![[r#"
        # Written by gcheck.
        *
    "#]]
    .assert_eq(&shop.read(".cache/gcheck/.gitignore"));
    assert!(
        shop.read(".cache/gcheck/CACHEDIR.TAG").starts_with("Signature: 8a477f597d28d172789f06886806bc55\n")
    );
}

#[test]
fn a_folder_that_holds_other_things_is_refused() {
    let shop = shop();
    let run = shop.gcheck("check --control haas-mill --cache-dir jobs a.nc");
    expect![[r#"
        ! error: jobs: holds other files, so it cannot be the cache
        !   help: name a folder of its own: one that is empty or does not exist yet
        exit 2
    "#]]
    .assert_eq(&run.to_string());
    let run = shop.gcheck("check --control haas-mill --cache-dir a.nc jobs/good.nc");
    expect![[r#"
        ! error: a.nc: cannot be the cache: file exists
        exit 2
    "#]]
    .assert_eq(&run.to_string());
}

#[test]
fn the_environment_names_the_folder_and_a_flag_wins() {
    let shop = shop();
    let cache = [("GCHECK_CACHE", ".cache/gcheck")];
    shop.gcheck_with(&cache, "check --control haas-mill --no-cache");
    assert!(!shop.path(".cache").exists());
    let run = shop.gcheck_with(&[("GCHECK_CACHE", "")], "check --control haas-mill");
    assert!(run.code == 1 && !shop.path(".cache").exists(), "{run}");
    shop.gcheck_with(&cache, "check --control haas-mill");
    assert_eq!(entries(&shop).len(), 5);
}

#[test]
fn without_a_name_it_lies_among_the_users_caches() {
    let shop = shop();
    let home = shop.path("home").to_string_lossy().into_owned();
    for (variable, place) in [("XDG_CACHE_HOME", "home/gcheck"), ("HOME", "home/.cache/gcheck")] {
        if cfg!(target_os = "linux") {
            shop.gcheck_with(&[(variable, &home)], "check --control haas-mill a.nc jobs");
            assert!(shop.path(place).join("CACHEDIR.TAG").exists(), "{variable}");
        }
    }
    // Nobody named this one, so that it cannot be made is not an error.
    let run = shop.gcheck_with(
        &[("HOME", &shop.path("a.nc").to_string_lossy())],
        "check --control haas-mill jobs/good.nc",
    );
    assert_eq!((run.code, run.stderr.contains("error")), (0, false), "{run}");
}

#[test]
fn processes_share_a_folder() {
    let shop = shop();
    let fresh = check(&shop, "--no-cache").to_string();
    std::thread::scope(|scope| {
        let runs: Vec<_> = (0..8).map(|_| scope.spawn(|| check(&shop, "").to_string())).collect();
        for run in runs {
            assert_eq!(run.join().unwrap(), fresh);
        }
    });
    let strays = entries(&shop).iter().filter(|entry| entry.extension().is_some()).count();
    assert_eq!((entries(&shop).len(), strays), (5, 0));
}

#[test]
fn fixes_do_not_come_out_of_it() {
    let shop = shop();
    let arguments = "--select letter-o-for-zero --fix --unsafe-fixes --quiet jobs/caller.nc";
    check(&shop, "--select letter-o-for-zero jobs/caller.nc");
    assert_eq!(check(&shop, arguments).code, 0);
    assert!(fs::read(shop.path("jobs/caller.nc")).unwrap().windows(4).any(|w| w == b"X10."));
    assert_eq!(check(&shop, "--select letter-o-for-zero jobs/caller.nc").code, 0);
}
