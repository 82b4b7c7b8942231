//! The same programs give the same bytes, whatever the number of threads and the order of the arguments.

use std::fmt::Write as _;

use crate::shop::Shop;

/// Sixty programs of several controls, with and without mistakes.
fn many_programs() -> Shop {
    let shop = Shop::new();
    shop.file("lathe/gcheck.toml", "control = \"haas-lathe\"\n");
    for number in 1..=60 {
        let folder = ["mill", "lathe", "mill/deep"][number % 3];
        let mut text = format!("%\nO{number:04} (PART {number})\nG21 G90\n");
        for line in 1..=number {
            let _ = writeln!(text, "N{line} G1 X{line} Y{}. F{}", line % 7, 100 + line);
            if line % 11 == 0 {
                let _ = writeln!(text, "G{} M98 P{}\nZ", 990 + number % 9, line + 30);
            }
        }
        text.push_str("M30\n%\n");
        shop.file(&format!("{folder}/{number}.nc"), text);
    }
    shop
}

#[test]
fn threads_do_not_show() {
    let shop = many_programs();
    for format in ["json", "full", "concise --show-all", "sarif", "github --statistics --summary"] {
        let run = |jobs: usize| shop.gcheck(&format!("check --output-format {format} --jobs {jobs}"));
        let (one, eight) = (run(1), run(8));
        assert_eq!(one.stdout, eight.stdout, "{format}");
        assert_eq!(one.stderr, eight.stderr, "{format}");
        assert_eq!(one.code, 1, "{format}: {}", one.stderr);
        assert!(one.stdout.len() > 1_000, "{format}");
    }
}

#[test]
fn the_order_of_the_arguments_does_not_show() {
    let shop = many_programs();
    let run = |paths: &str| shop.gcheck(&format!("check {paths} --output-format json")).stdout;
    assert_eq!(run("mill lathe"), run("lathe mill/deep mill mill/deep/2.nc"));
}
