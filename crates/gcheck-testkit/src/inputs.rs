//! Large programs for measurements, the same bytes on every machine.
//!
//! Knows: what typical programs look like. Must not know: who measures what with them. Only integers are used, so that no
//! platform's mathematics changes a digit.

use std::fmt::{self, Write as _};

/// A length in ten-thousandths, written with four decimals.
struct Length(i64);

impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.0 < 0 { "-" } else { "" };
        write!(f, "{sign}{}.{:04}", self.0.abs() / 10_000, self.0.abs() % 10_000)
    }
}

/// Appends a line.
fn line(program: &mut String, text: fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = writeln!(program, "{text}");
}

const HEAD: &str =
    "%\nO1000 (MEASURED)\nG21 G17 G40 G49 G80 G90 G94\nT1 M6\nG54\nS12000 M3\nG0 X0. Y0.\nG43 H1 Z50.\nM8\n";
const TAIL: &str = "G0 Z50.\nM9\nM5\nG49\nM30\n%\n";

/// A three-axis surface in straight moves, as CAM posts it: about 30 bytes a line, `lines` lines in all.
pub fn surfacing(lines: usize) -> String {
    const POINTS: i64 = 1_000;
    let mut program = String::with_capacity(lines * 32);
    program.push_str(HEAD);
    program.push_str("G1 Z-1. F2500.\n");
    let frame = HEAD.lines().count() + 1 + TAIL.lines().count();
    for ix in 0..i64::try_from(lines.saturating_sub(frame)).unwrap_or(0) {
        let (pass, point) = (ix / POINTS, ix % POINTS);
        // To and fro over 200 mm, stepping over by 0.15 mm.
        let along = if pass % 2 == 0 { point } else { POINTS - 1 - point };
        let x = along * 2_003 - 1_000_000;
        let y = pass * 1_501 - 750_000;
        // A shallow bowl with ripples finer than a step.
        let z =
            -250_000 + (x / 1_000) * (x / 1_000) / 10 + (y / 1_000) * (y / 1_000) / 20 + (ix * 7_919) % 97;
        line(&mut program, format_args!("X{} Y{} Z{}", Length(x), Length(y), Length(z)));
    }
    program.push_str(TAIL);
    program
}

/// A drilling cycle over `holes` positions in a grid, a new tool and cycle every 10,000.
pub fn drilling(holes: usize) -> String {
    const CYCLES: [&str; 3] = [
        "G98 G81 X0. Y0. Z-5. R2. F300.",
        "G99 G83 X0. Y0. Z-25. R2. Q3. F250.",
        "G99 G82 X0. Y0. Z-8. R2. P.5 F200.",
    ];
    let mut program = String::with_capacity(holes * 20);
    program.push_str(HEAD);
    for ix in 0..holes {
        let (batch, place) = (ix / 10_000, i64::try_from(ix % 10_000).unwrap_or(0));
        let cycle = CYCLES.get(batch % CYCLES.len()).copied().unwrap_or_default();
        if place == 0 {
            let tool = batch % 20 + 1;
            line(&mut program, format_args!("G80\nT{tool} M6\nS12000 M3\nG0 G43 H{tool} Z50.\n{cycle}"));
        } else {
            line(
                &mut program,
                format_args!("X{} Y{}", Length(place % 100 * 25_000), Length(place / 100 * 25_000)),
            );
        }
    }
    program.push_str("G80\n");
    program.push_str(TAIL);
    program
}

/// Macro statements, about `lines` lines of them: assignments, conditions, loops, computed words, calls.
pub fn macros(lines: usize) -> String {
    let mut program = String::with_capacity(lines * 32);
    program.push_str(HEAD);
    // Labels stay below the 99,999 that all controls accept.
    for part in 0..(lines / 10).min(9_999) {
        let label = (part + 1) * 10;
        line(&mut program, format_args!("N{label} #101=[#100*{}.+SIN[#102]]/2.", part % 90 + 1));
        line(&mut program, format_args!("#102=ROUND[#101]+ABS[#103-{}.5]", part % 50));
        line(&mut program, format_args!("IF [[#101 GT 100.] AND [#102 LT 5.]] GOTO {label}"));
        line(&mut program, format_args!("WHILE [#103 LT 12.] DO1"));
        line(&mut program, format_args!("G1 X[#101*COS[#102]] Y[#101*SIN[#102]] F#104"));
        line(&mut program, format_args!("G2 X#105 Y#106 I[#101/2.] J0."));
        line(&mut program, format_args!("#103=#103+1."));
        line(&mut program, format_args!("END1"));
        line(&mut program, format_args!("IF [#103 EQ #0] THEN #103=0."));
        line(&mut program, format_args!("G65 P9010 A#101 B{}. C-1.5", part % 30));
    }
    program.push_str(TAIL);
    program
}

#[cfg(test)]
mod tests {
    use super::{Length, drilling, macros, surfacing};

    #[test]
    fn lengths_keep_their_sign_and_zeros() {
        assert_eq!(Length(-5).to_string(), "-0.0005");
        assert_eq!(Length(120_000).to_string(), "12.0000");
    }

    #[test]
    fn programs_have_the_size_that_was_asked_for() {
        let program = surfacing(100_000);
        assert_eq!(program.lines().count(), 100_000);
        assert!((27..=33).contains(&(program.len() / 100_000)), "{} bytes", program.len());
        assert!(drilling(20_001).lines().count() > 20_000);
        assert!(macros(10_000).lines().count() >= 10_000);
    }
}
