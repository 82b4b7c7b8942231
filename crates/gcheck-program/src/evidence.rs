//! What a program shows of the control it is written for.
//!
//! Knows: how comments, codes and forms of text look on all controls together. Must not know: any control; the hints and
//! their weights are data. The scan is lexical and reads only the head of a file, so that it can run before a control is
//! chosen.

use gcheck_controls::{CodeNumber, Evidence, Letter, LetterSet, SyntaxForm};

/// Lines whose comments count: the machine is named at the top.
const COMMENT_LINES: usize = 300;
/// Bytes whose codes and forms count, and the rest of their last line: what a program uses at all, it uses early.
pub const EVIDENCE_BYTES: usize = 64 << 10;

/// Bytes of a line that are looked at: for each `;` and each `#<` the rest of them is looked through.
const MAX_LINE: usize = 1_024;

/// Collects the evidence of a program for [`gcheck_controls::guess`]. Of a long text its head is enough: [`EVIDENCE_BYTES`]
/// bytes and the rest of their last line.
pub fn collect_evidence(text: &str) -> Evidence {
    evidence_of_file(text, None)
}

/// [Collects the evidence](collect_evidence) of a program in a file whose name ends in `extension`, without the dot.
pub fn evidence_of_file(text: &str, extension: Option<&str>) -> Evidence {
    let extension = extension.map(str::to_ascii_lowercase);
    let mut scan = Scan::default();
    for (number, line) in text.split(['\n', '\r']).enumerate() {
        let offset = line.as_ptr() as usize - text.as_ptr() as usize;
        if offset > EVIDENCE_BYTES {
            break;
        }
        scan.keeps_comments = number < COMMENT_LINES;
        scan.line(line);
    }
    let [with_x, with_z, with_y] = scan.blocks_with;
    if scan.twin_tool_with_change && with_y * 2 <= with_x {
        scan.form(SyntaxForm::PackedToolWithChange);
    }
    if with_y >= ENOUGH_BLOCKS && with_y * 2 >= with_x {
        scan.form(SyntaxForm::MillingWords);
    }
    let turns = [50, 96, 97].map(CodeNumber::g).iter().any(|code| scan.codes.contains(code));
    if with_x.min(with_z) >= ENOUGH_BLOCKS && with_y == 0 && turns {
        scan.form(SyntaxForm::TurningWords);
        if scan.limits_by_g92 && scan.codes.contains(&CodeNumber::g(96)) {
            scan.form(SyntaxForm::SpeedLimitByG92);
        }
        if let Some(system) = scan.turning_system() {
            scan.form(system);
        }
    }
    Evidence {
        comments: scan.comments,
        codes: scan.codes.iter().map(ToString::to_string).collect(),
        forms: scan.forms,
        unsupported: gcheck_controls::unsupported_dialect(text, extension.as_deref()),
        extension,
    }
}

#[derive(Debug, Default)]
#[expect(clippy::struct_excessive_bools, reason = "independent yes/no facts of a program, named one by one")]
struct Scan {
    comments: Vec<String>,
    codes: Vec<CodeNumber>,
    forms: Vec<SyntaxForm>,
    keeps_comments: bool,
    /// Blocks with an `X` and a value, with a `Z`, with a `Y`.
    blocks_with: [usize; 3],
    /// A block with `G70` or `G71` and nothing that a turning cycle needs: the code chooses units.
    units_by_cycle_number: bool,
    /// `T0707 M06`: a lathe writes it, and so do some posts for mills.
    twin_tool_with_change: bool,
    /// `G92 S3000`.
    limits_by_g92: bool,
}

/// Blocks with `X` and blocks with `Z` that a program needs before it means something that none has a `Y`.
const ENOUGH_BLOCKS: usize = 4;

/// What a block has that can only be judged at its end.
#[derive(Debug, Clone, Copy, Default)]
#[expect(clippy::struct_excessive_bools, reason = "independent yes/no facts of a block, named one by one")]
struct Seen {
    packed_tool: bool,
    short_tool: bool,
    /// `T0707`: the station and its offset are one number written twice.
    twin_tool: bool,
    turning_cycle: bool,
    threading_cycle: bool,
    /// `T1` to `T99`.
    plain_tool: bool,
    /// `G70` or `G71`: a turning cycle in some sets of codes, units in another.
    unit_or_cycle: bool,
    letters: LetterSet,
    /// Letters with a value.
    valued: LetterSet,
    increment: bool,
    tool_change: bool,
    macro_call: bool,
    /// `G50`: with `S` the highest speed of a lathe's spindle, alone the end of scaling on a mill.
    g50: bool,
    /// `G92`: with `S` alone the highest speed of a lathe's spindle, but for one of system A.
    g92: bool,
    /// No word has come yet but `N` and `/`.
    is_head: bool,
}

impl Scan {
    fn form(&mut self, form: SyntaxForm) {
        if !self.forms.contains(&form) {
            self.forms.push(form);
        }
    }

    /// The set of G codes that a turning program is written in, where what it uses leaves no other: feed per revolution is
    /// `G95` in systems B and C and not a code in A, and A has codes that the others do not.
    fn turning_system(&self) -> Option<SyntaxForm> {
        let has = |numbers: &[u16]| numbers.iter().any(|n| self.codes.contains(&CodeNumber::g(*n)));
        let of_system_a = has(&[32, 50]) || has(&[98, 99]) && !has(&[83, 84, 85, 87, 88, 89]);
        if !has(&[95]) || of_system_a {
            return None;
        }
        let is_c = self.units_by_cycle_number || has(&[24]);
        Some(if is_c { SyntaxForm::TurningSystemC } else { SyntaxForm::TurningSystemB })
    }

    fn comment(&mut self, text: &str) {
        let text = text.trim();
        if self.keeps_comments && !text.is_empty() {
            self.comments.push(text.to_owned());
        }
    }

    fn line(&mut self, line: &str) {
        let line = line.get(..line.floor_char_boundary(MAX_LINE)).unwrap_or(line);
        let mut rest = line.trim_matches([' ', '\t', '\u{FEFF}', '\0']);
        if let Some(after) = rest.strip_prefix('%') {
            self.form(SyntaxForm::TapeMark);
            if after.starts_with(|c: char| c.is_ascii_digit()) {
                self.form(SyntaxForm::TapeMarkWithNumber);
            }
            return;
        }
        if is_system_command(rest) {
            self.form(SyntaxForm::SystemCommand);
            return;
        }
        let whole = rest;
        let mut seen = Seen { is_head: true, ..Seen::default() };
        while let Some(first) = rest.chars().next() {
            rest = match first {
                '(' => {
                    let inside = rest.get(1..).unwrap_or_default();
                    let (text, after) = inside.split_once(')').unwrap_or((inside, ""));
                    self.comment(text);
                    after
                }
                ';' => self.semicolon(rest, rest.len() == whole.len()),
                '[' => after_brackets(rest, self),
                '#' => self.variable(rest),
                ':' if seen.is_head && number(rest.get(1..).unwrap_or_default()).0 > 0 => {
                    self.form(SyntaxForm::ProgramNumber);
                    seen.is_head = false;
                    rest.get(1..).unwrap_or_default()
                }
                c if c.is_ascii_alphabetic() => self.letters(rest, &mut seen),
                c => rest.get(c.len_utf8()..).unwrap_or_default(),
            };
        }
        self.tools_and_counts(&seen);
        self.turning_cycles(&seen);
        self.limits_and_increments(&seen);
    }

    /// From a semicolon on: a comment, or what follows an end of block. `is_first`: nothing of the line is in front of it.
    fn semicolon<'t>(&mut self, rest: &'t str, is_first: bool) -> &'t str {
        let after = rest.get(1..).unwrap_or_default().trim();
        if after.is_empty() {
            ""
        } else if is_first || is_prose(after) {
            self.form(SyntaxForm::SemicolonComment);
            self.comment(after);
            ""
        } else {
            after
        }
    }

    /// How a line that was read calls its tool, and which axes it moves.
    fn tools_and_counts(&mut self, seen: &Seen) {
        if seen.packed_tool && !seen.tool_change {
            self.form(SyntaxForm::PackedTool);
            if seen.short_tool {
                self.form(SyntaxForm::PackedToolShort);
            }
        }
        self.twin_tool_with_change |= seen.twin_tool && seen.tool_change;
        for (count, letter) in self.blocks_with.iter_mut().zip(['X', 'Z', 'Y']) {
            *count += usize::from(seen.valued.contains(Letter::of(letter)));
        }
        if seen.plain_tool && seen.valued.contains(Letter::of('D')) && !seen.tool_change {
            self.form(SyntaxForm::ToolWithD);
        }
    }

    /// In one block or in two: the cycle of a lathe on a line that was read.
    fn turning_cycles(&mut self, seen: &Seen) {
        let has = |letter| seen.letters.contains(Letter::of(letter));
        self.units_by_cycle_number |=
            seen.unit_or_cycle && !seen.letters.intersects(LetterSet::of("DPQRUWXZ"));
        let is_one_block = seen.turning_cycle && has('P') && has('Q') || seen.threading_cycle && has('K');
        if is_one_block && has('D') {
            self.form(SyntaxForm::TurningCycleOneBlock);
        }
        let prepares = !seen.letters.intersects(LetterSet::of("XZUWKF"));
        let prepares_thread = seen.threading_cycle && has('P') && has('Q') && prepares;
        if seen.turning_cycle && !has('P') && has('R') && (has('U') || has('W')) || prepares_thread {
            self.form(SyntaxForm::TurningCycleTwoBlocks);
        }
    }

    /// Limits of the speed, and words that are increments whatever the mode, on a line that was read.
    fn limits_and_increments(&mut self, seen: &Seen) {
        if seen.g50 && seen.valued.contains(Letter::of('S')) {
            self.form(SyntaxForm::SpeedLimitByG50);
        }
        self.limits_by_g92 |= seen.g92
            && seen.valued.contains(Letter::of('S'))
            && !seen.valued.intersects(LetterSet::of("XYZUVW"));
        if seen.increment && !seen.macro_call {
            self.form(SyntaxForm::IncrementalWords);
        }
    }

    /// `#100`, `#<name>`.
    fn variable<'t>(&mut self, rest: &'t str) -> &'t str {
        let after = rest.get(1..).unwrap_or_default();
        match after.strip_prefix('<').and_then(|name| name.split_once('>')) {
            Some((_, after)) => {
                self.form(SyntaxForm::NamedParameter);
                after
            }
            None => after,
        }
    }

    /// A keyword, or an address with its number.
    fn letters<'t>(&mut self, rest: &'t str, seen: &mut Seen) -> &'t str {
        let letters = rest.bytes().take_while(u8::is_ascii_alphabetic).count();
        let (word, after) = rest.split_at_checked(letters).unwrap_or((rest, ""));
        if word.len() > 1 {
            seen.is_head = false;
            if is_one_of(word, &["IF", "WHILE", "GOTO", "DO", "END", "DPRNT", "BPRNT", "POPEN", "PCLOS"]) {
                self.form(SyntaxForm::MacroStatement);
            }
            return after;
        }
        let written = word.bytes().next().unwrap_or(0);
        let letter = written.to_ascii_uppercase();
        if let Some(letter) = Letter::new(letter) {
            seen.letters.insert(letter);
        }
        let value = after.trim_start_matches([' ', '\t']);
        let (len, digits) = number(value);
        let after = value.get(len..).unwrap_or_default();
        if let Some(letter) = Letter::new(letter)
            && (len > 0 || value.starts_with(['#', '[']))
        {
            seen.valued.insert(letter);
        }
        match letter {
            b'O' if seen.is_head => {
                seen.is_head = false;
                return self.o_word(value);
            }
            b'G' | b'M' => {
                let code = value
                    .get(..len)
                    .and_then(|v| v.parse().ok())
                    .and_then(|v| CodeNumber::from_value(letter, v));
                if let Some(code) = code {
                    if written != letter {
                        self.form(SyntaxForm::LowerCase);
                    }
                    seen.turning_cycle |= [71, 72, 73].map(CodeNumber::g).contains(&code);
                    seen.threading_cycle |= code == CodeNumber::g(76);
                    seen.unit_or_cycle |= [70, 71].map(CodeNumber::g).contains(&code);
                    seen.tool_change |= code == CodeNumber::m(6);
                    seen.g50 |= code == CodeNumber::g(50);
                    seen.g92 |= code == CodeNumber::g(92);
                    seen.macro_call |= code == CodeNumber::g(65) || code == CodeNumber::g(66);
                    if !self.codes.contains(&code) {
                        self.codes.push(code);
                    }
                }
            }
            // `T0101=…` gives something that is called so a value.
            b'T' if after.trim_start().starts_with('=') => {}
            b'T' => {
                seen.plain_tool |= len == digits && (1..=2).contains(&digits);
                seen.packed_tool |= len == digits && (3..=4).contains(&digits);
                seen.short_tool |= len == digits && digits == 3;
                let halves = value.get(..2).zip(value.get(2..4));
                seen.twin_tool |=
                    len == 4 && digits == 4 && halves.is_some_and(|(tool, offset)| tool == offset);
            }
            b'U' | b'W' => seen.increment |= len > 0 || value.starts_with(['#', '[']),
            _ => {}
        }
        seen.is_head &= letter == b'N';
        after
    }

    /// `O1234`, `O100 SUB`, `O<name> CALL`: what follows the `O`.
    fn o_word<'t>(&mut self, value: &'t str) -> &'t str {
        let (len, digits) = number(value);
        let after = match value.bytes().next() {
            Some(b'<') => value.split_once('>').map_or("", |(_, after)| after),
            Some(b'[') => after_brackets(value, self),
            Some(b'#') => value.trim_start_matches(|c: char| c == '#' || c.is_ascii_digit()),
            _ => value.get(len..).unwrap_or_default(),
        };
        let next = after.trim_start();
        let keyword = next
            .get(..next.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(next.len()))
            .unwrap_or_default();
        let keywords = [
            "SUB",
            "ENDSUB",
            "CALL",
            "RETURN",
            "IF",
            "ELSEIF",
            "ELSE",
            "ENDIF",
            "WHILE",
            "ENDWHILE",
            "DO",
            "REPEAT",
            "ENDREPEAT",
            "BREAK",
            "CONTINUE",
        ];
        if is_one_of(keyword, &keywords) {
            self.form(SyntaxForm::OWord);
            return next.get(keyword.len()..).unwrap_or_default();
        }
        if digits > 0 {
            self.form(SyntaxForm::ProgramNumber);
            match digits {
                5 => self.form(SyntaxForm::FiveDigitProgram),
                6..=8 => self.form(SyntaxForm::LongProgramNumber),
                _ => {}
            }
        }
        after
    }
}

/// `$H`, `$$`, `$J=G91 X1`, `$110=500`.
fn is_system_command(line: &str) -> bool {
    let Some(after) = line.strip_prefix('$') else { return false };
    let digits = after.bytes().take_while(u8::is_ascii_digit).count();
    match after.as_bytes().get(digits) {
        Some(b'=') if digits > 0 => true,
        Some(b'$') => digits == 0,
        // `$H`, `$SLP`, `$RST=#`; simulators have longer words of their own (`$AddRegPart`).
        Some(_) if digits == 0 => {
            (1..=4).contains(&after.bytes().take_while(u8::is_ascii_alphabetic).count())
        }
        _ => false,
    }
}

/// The text after the bracket that closes the one at its head; inside is an expression, of which only names count.
fn after_brackets<'t>(rest: &'t str, scan: &mut Scan) -> &'t str {
    let mut depth = 0_usize;
    for (at, byte) in rest.bytes().enumerate() {
        match byte {
            b'[' => depth += 1,
            b']' => depth -= 1,
            b'#' => {
                scan.variable(rest.get(at..).unwrap_or_default());
            }
            _ => {}
        }
        if depth == 0 {
            return rest.get(at + 1..).unwrap_or_default();
        }
    }
    ""
}

/// Length of the number at the head, with its sign and point, and how many digits it has.
fn number(text: &str) -> (usize, usize) {
    let sign = usize::from(text.starts_with(['-', '+']));
    let (mut len, mut digits) = (0, 0);
    for byte in text.bytes().skip(sign).take_while(|byte| byte.is_ascii_digit() || *byte == b'.') {
        len += 1;
        digits += usize::from(byte != b'.');
    }
    if digits == 0 { (0, 0) } else { (sign + len, digits) }
}

/// Is the text after `;` words for people, not a block?
fn is_prose(text: &str) -> bool {
    let mut letters = 0;
    for c in text.chars() {
        if c.is_alphabetic() {
            letters += 1;
            if letters > 1 {
                return true;
            }
        } else if c == '(' {
            return false;
        } else {
            // `; a 5 mm end mill`: a letter that is alone has no number.
            if letters == 1 && c == ' ' {
                return true;
            }
            letters = 0;
        }
    }
    letters > 0
}

fn is_one_of(word: &str, list: &[&str]) -> bool {
    list.iter().any(|w| w.eq_ignore_ascii_case(word))
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};
    use gcheck_controls::SyntaxForm;

    use super::collect_evidence;

    fn check(program: &str, expected: &Expect) {
        let evidence = collect_evidence(program);
        let forms: Vec<String> = evidence.forms.iter().map(|form| format!("{form:?}")).collect();
        let lines = [evidence.comments.join(" | "), evidence.codes.join(" "), forms.join(" ")];
        expected.assert_eq(&lines.map(|l| format!("{l}\n")).concat());
    }

    #[test]
    fn a_lathe_program_shows_packed_tools_and_increments() {
        check(
            "%\nO0001 (ST-20)\nG28 U0. W0.;\nT0101\nG96 S200 M03\nG71 P10 Q20\n%\n",
            &expect![[r#"
                ST-20
                G28 G96 M3 G71
                TapeMark ProgramNumber IncrementalWords PackedTool
            "#]],
        );
    }

    #[test]
    fn o_words_and_named_parameters_are_seen_inside_brackets() {
        check(
            "; drill plate\no<drill> sub\n  G0 X[#<_x> + 1]\no100 if [#<n> GT 1]\no<drill> endsub\nG38.2 Z-1 F10 ; probe down\n",
            &expect![[r#"
                drill plate | probe down
                G0 G38.2
                SemicolonComment OWord NamedParameter
            "#]],
        );
    }

    #[test]
    fn a_mill_with_many_tools_has_no_packed_tool_number() {
        check(
            "N10 T101 M6; N20 G65 P9810 X1. W2.\nIF [#1 EQ 0] GOTO 10\n",
            &expect![[r#"

                M6 G65
                MacroStatement
            "#]],
        );
    }

    #[test]
    fn a_lathe_with_a_tool_change_code_writes_station_and_offset_alike() {
        check(
            "N10 T0707 M06\nN15 G99 G96 S100\nG0 X60 Z1\nX58\nG1 Z-5\nX60\nG0 Z1\nX50\nZ0\nY#1 (Y)\n",
            &expect![[r#"
                Y
                M6 G99 G96 G0 G1
                PackedToolWithChange
            "#]],
        );
        check(
            "T0102 M6\nG97 X60 Z1\nX58\nZ-5\nX60\nZ1\nX50\nZ0\n(Y1)\n",
            &expect![[r#"
                Y1
                M6 G97
                TurningWords
            "#]],
        );
    }

    #[test]
    fn a_mill_may_write_a_tool_and_its_offset_alike() {
        check(
            "%1234\nM6 T0101\nG0 X1 Y1\nX2 Y2\nX3 Y3\nG1 Z-1\nX4 Y4\n",
            &expect![[r#"

                M6 G0 G1
                TapeMark TapeMarkWithNumber MillingWords
            "#]],
        );
    }

    #[test]
    fn an_offset_by_d_beside_the_tool_and_threads_of_one_block_are_seen() {
        check(
            "T0101=12\nT1 D1\nT2 M6 D2\nG76 X20. Z-15. K1.2 D.3 F2.\nG76 P010060 Q100 R50\n",
            &expect![[r#"

                M6 G76
                ToolWithD TurningCycleOneBlock TurningCycleTwoBlocks
            "#]],
        );
    }

    #[test]
    fn feed_per_revolution_by_g95_tells_the_systems_of_codes_apart() {
        let body = "T0101\nG97 S800 M3\nG0 X60 Z5\nG1 X58 Z0\nX56 Z-1\nX54 Z-2\n";
        for (head, system) in [
            ("G21 G95\n", Some(SyntaxForm::TurningSystemB)),
            ("G71 G95\n", Some(SyntaxForm::TurningSystemC)),
            ("G71 P10 Q20 U1 W1\nG95\n", Some(SyntaxForm::TurningSystemB)),
            ("G95\nG98 G83 Z-5 R2\n", Some(SyntaxForm::TurningSystemB)),
            ("G21 G99\n", None),
            ("G95 G50 S2000\n", None),
            ("G95 G99\n", None),
            ("G95\nG0 Y1\n", None),
        ] {
            let forms = collect_evidence(&format!("{head}{body}")).forms;
            let systems = [SyntaxForm::TurningSystemB, SyntaxForm::TurningSystemC];
            assert_eq!(forms.into_iter().find(|form| systems.contains(form)), system, "{head}");
        }
    }

    #[test]
    fn a_speed_limit_by_g50_shows_a_lathe_whatever_its_other_words() {
        for (block, is_limit) in
            [("G50 S3000", true), ("G50", false), ("G50 M3 S#1", true), ("G92 S3000", false)]
        {
            let forms = collect_evidence(&format!("{block}\nG0 X1 Y1\n")).forms;
            assert_eq!(forms.contains(&SyntaxForm::SpeedLimitByG50), is_limit, "{block}: {forms:?}");
        }
    }

    #[test]
    fn a_speed_limit_by_g92_shows_a_lathe_of_another_system() {
        for (limit, is_limit) in [("G92 S3000", true), ("G92 X200 S3000", false), ("G92 S", false)] {
            let body = "X20 Z1\nX21 Z2\nX22 Z3\nX23 Z4\n";
            let forms = collect_evidence(&format!("T0101\nG96 S200 M3\n{limit}\n{body}")).forms;
            assert_eq!(forms.contains(&SyntaxForm::SpeedLimitByG92), is_limit, "{limit}: {forms:?}");
        }
        assert!(
            !collect_evidence("G96 S200\nG92 S3000\nX1 Y1\n").forms.contains(&SyntaxForm::SpeedLimitByG92)
        );
    }

    #[test]
    fn a_line_for_the_firmware_is_seen_where_it_opens_the_line() {
        check(
            "$H\nG0 X1\n",
            &expect![[r#"

                G0
                SystemCommand
            "#]],
        );
        check(
            "$1 S100 M3\n$[1] S2\nG0 X1 ($H)\n",
            &expect![[r#"
                $H
                M3 G0

            "#]],
        );
        for line in ["$$", "$110=500.", " $J=G91 X1 F100", "$x"] {
            assert_eq!(collect_evidence(line).forms, [SyntaxForm::SystemCommand], "{line}");
        }
    }

    #[test]
    fn of_a_long_line_the_head_counts() {
        let blocks = format!("G71;{}G96;\nG54\n", "G0;".repeat(100_000));
        let codes: Vec<String> = collect_evidence(&blocks).codes;
        assert_eq!(codes, ["G71", "G0"], "the rest of the line is not looked at, nor is what follows");
        for piece in ["#<", "O<", "[#<", "; G0 (", "(;"] {
            collect_evidence(&piece.repeat(300_000));
        }
    }

    #[test]
    fn text_that_is_not_a_program_does_no_harm() {
        let evidence = collect_evidence("O<\nT\n#<\n[[\n(\n;\nX é G é\nG99999999999999999999\n:");
        assert!(
            evidence.comments.is_empty() && evidence.codes.is_empty() && evidence.forms.is_empty(),
            "{evidence:?}"
        );
    }
}
