//! The tour: every mistake that `fixtures/tour/README.md` promises is found, and nothing else.

use std::path::Path;
use std::process::Command;

use expect_test::expect;

#[test]
fn the_tour_shows_its_mistakes() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let output = Command::new(env!("CARGO_BIN_EXE_gcheck"))
        .args(["check", "fixtures/tour", "--output-format", "concise", "--quiet"])
        .current_dir(root)
        .env_clear()
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    expect![[r#"
        fixtures/tour/bore.nc:23:6: warning[touches-do-not-meet] the first touch was not along Y
        fixtures/tour/bore.nc:29:5: error[probing-in-wrong-mode] work offset measured with a tool length on (`G43`)
        fixtures/tour/bore.nc:29:15: warning[probe-feed-too-high] probing at 150 inch/min (`F`)
        fixtures/tour/bore.nc:38:5: error[word-forbidden] `X6.` in a block with `G37`
        fixtures/tour/bracket.nc:9:1: warning[lasting-word-never-given] `G43` without `H`, which no earlier block gives
        fixtures/tour/bracket.nc:11:5: warning[missing-decimal-point] decimal point missing: `F45`
        fixtures/tour/bracket.nc:15:9: error[unknown-code] unknown code `G54.1`
        fixtures/tour/bracket.nc:17:5: warning[lasting-word-never-given] `G83` without `Q`, which no earlier block gives
        fixtures/tour/bracket.nc:23:5: warning[missing-decimal-point] decimal point missing: `X-15`
        fixtures/tour/bushing.nc:13:7: error[letter-o-for-zero] letter `O` instead of a zero in `Z-O.125`
        fixtures/tour/bushing.nc:16:10: error[jump-target-missing] jump target `N210` does not exist in this program
        fixtures/tour/bushing.nc:25:17: warning[subprogram-missing] called program `O3099` is missing
        fixtures/tour/impeller.nc:9:1: error[five-axis-length-without-offset] 5-axis length compensation without a length offset (`G143` without `H`)
        fixtures/tour/impeller.nc:12:9: warning[five-axis-axis-left-out] `Y` and `Z` do not move while `A` and `B` tilt the tool (`G143`)
        fixtures/tour/impeller.nc:15:1: warning[five-axis-feed-per-minute] feed per minute (`G94`) while the tool tilts (`G143`)
        fixtures/tour/impeller.nc:16:1: error[refused-in-five-axis-mode] arc (`G2`) under `G143`
        fixtures/tour/impeller.nc:18:1: error[five-axis-length-in-incremental] incremental words under 5-axis length compensation (`G143`)
        fixtures/tour/impeller.nc:20:4: warning[five-axis-length-left-on] 5-axis length compensation is still on at the tool change (`G143`)
        fixtures/tour/impeller.nc:25:19: error[cutter-vector-not-unit] direction is not a unit vector: I² + J² + K² is 0.82, not 1 (`G141`)
        fixtures/tour/impeller.nc:27:1: warning[cutter-vector-incomplete] move without a direction under 3D cutter compensation (`G141`)
        fixtures/tour/manifold.nc:10:1: info[checked-past-alarm] the rest is checked past the alarm of this block
        fixtures/tour/manifold.nc:10:1: error[loop-end-missing] loop `DO1` has no `END1`
        fixtures/tour/manifold.nc:15:1: warning[arc-without-centre] arc without centre or radius: `G3`
        fixtures/tour/manifold.nc:16:8: warning[two-codes-of-one-group] `G0` and `G1` belong to one modal group
        fixtures/tour/manifold.nc:18:19: error[jump-target-missing] jump target `N900` does not exist in this program
        fixtures/tour/pin.nc:14:1: warning[chuck-opened-while-turning] the chuck opens while the spindle turns (`M11`)
        fixtures/tour/pin.nc:15:1: info[chuck-moved-at-bar-feed] chuck is open before the bar is fed (`M11`)
        fixtures/tour/pin.nc:15:1: warning[turret-in-the-way-of-bar] tool is in the way of the bar
        fixtures/tour/pin.nc:15:12: warning[bar-push-shorter-than-part] bar is pushed by less than the part is long
        fixtures/tour/plate.nc:3:1: info[program-number-missing] program has no number
        fixtures/tour/plate.nc:8:5: error[malformed-number] number `-2.5.0` has two decimal points
        fixtures/tour/plate.nc:9:4: error[number-out-of-range] value too large for `G4`: `X100000.`
        fixtures/tour/plate.nc:11:1: warning[arc-breaks-contour] the arc breaks the contour: corners before and after it
        fixtures/tour/probe-grid.ngc:6:1: error[assignment-to-read-only-variable] variable `#5420` can only be read
        fixtures/tour/probe-grid.ngc:11:1: error[o-word-unmatched] O-word `o100 while` has no `endwhile`
        fixtures/tour/probe-grid.ngc:14:3: error[required-word-missing] `G4` without `P`
        fixtures/tour/probe-grid.ngc:15:13: error[word-given-twice] two `Z` words in one block
        fixtures/tour/shaft.nc:6:1: error[decimal-point-on-integer] decimal point on a whole number: `T0202.`
        fixtures/tour/shaft.nc:9:4: error[address-without-value] address `Z` has no value
        fixtures/tour/shaft.nc:11:7: error[unclosed-comment] comment is not closed
        fixtures/tour/sleeve.nc:11:10: warning[cylinder-word-value-ignored] the value of `A90.` does not count (`G107`)
        fixtures/tour/sleeve.nc:24:4: warning[cylinder-left-on] Y is still wrapped at the tool change (`G107`)
        fixtures/tour/sleeve.nc:28:6: error[cylinder-without-rotary-axis] the cylinder has no rotary axis (`G107`)
    "#]].assert_eq(&String::from_utf8_lossy(&output.stdout));
}
