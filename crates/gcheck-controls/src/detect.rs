//! Which control a program is written for, guessed from what it uses.
//!
//! Knows: the hints of each control and how to weigh them. Must not know: how evidence is found in a program; the caller
//! collects [`Evidence`] from comments, codes and forms of syntax.

use crate::Hint;
use crate::loader::all_control_files;
use crate::schema::ControlFile;
use crate::unsupported::{OtherControl, other_controls};
use crate::whole_word::Words;
use crate::{SyntaxForm, UnsupportedDialect};

/// What a program shows of itself.
#[derive(Debug, Clone, Default)]
pub struct Evidence {
    /// Texts of the comments of the first lines.
    pub comments: Vec<String>,
    /// Codes the program uses, canonical (`G154`).
    pub codes: Vec<String>,
    /// Forms of syntax the program uses.
    pub forms: Vec<SyntaxForm>,
    /// How the name of its file ends, without the dot, in lower case; `None` where it has no name.
    pub extension: Option<String>,
    /// It is of a dialect that no control here reads.
    pub unsupported: Option<&'static UnsupportedDialect>,
}

/// A guess and its reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Guess {
    /// The control's name.
    pub control: String,
    /// The piece of the program that counted most: a comment, a code or the end of its name, as written, or a form in words.
    pub because: String,
    /// Another control that the program speaks for nearly as much.
    pub rival: Option<String>,
    /// The program says enough, and much more of this control than of another: what is beside it cannot outweigh that.
    pub is_clear: bool,
}

/// A control or builder that no control here is for, as a program names it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Foreign {
    /// What it is, in words: "a Mazak control".
    pub name: String,
    /// The comment, as written.
    pub comment: String,
}

/// What the evidence is worth for one control.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Score {
    /// The control and the piece of the program that counted most for it.
    pub guess: Guess,
    /// Sum of the weights of the hints found.
    pub points: i32,
    /// Hints found that speak against the control.
    pub against: usize,
}

/// What the evidence is worth for each control, the best first. Controls without any hint found are left out.
pub fn scores(evidence: &Evidence) -> Vec<Score> {
    Weighed::new(evidence).scores
}

/// Evidence, and what it is worth for each control.
pub struct Weighed<'e> {
    evidence: &'e Evidence,
    comments: Comments<'e>,
    /// The best first.
    scores: Vec<Score>,
}

/// The comments of a program, made ready for many words to be looked for.
struct Comments<'e> {
    all: &'e [String],
    /// Where each begins in the text of all.
    starts: Vec<usize>,
    /// All of them, each on a line of its own.
    words: Words,
    forms: &'e [SyntaxForm],
}

impl<'e> Comments<'e> {
    fn of(evidence: &'e Evidence) -> Self {
        let starts = evidence.comments.iter().scan(0, |end, comment| {
            let start = *end;
            *end += comment.len() + 1;
            Some(start)
        });
        Self {
            all: &evidence.comments,
            starts: starts.collect(),
            words: Words::of(&evidence.comments.join("\n")),
            forms: &evidence.forms,
        }
    }

    /// The first one that has a word, as written.
    fn with(&self, word: &str) -> Option<&'e str> {
        let at = self.words.find(word)?;
        let after = self.starts.partition_point(|start| *start <= at);
        self.all.get(after.checked_sub(1)?).map(String::as_str)
    }

    /// The foreign control that one of them names, unless its programs are read as those of `control`.
    fn foreign_unlike(&self, control: &str) -> Option<Foreign> {
        let is_possible = |other: &&OtherControl| !other.without.iter().any(|form| self.forms.contains(form));
        let is_unlike = |other: &&OtherControl| !other.like.iter().any(|like| like == control);
        let mut others = other_controls().iter().filter(is_possible).filter(is_unlike);
        let told = |other: &OtherControl| {
            let comment = other.comments.iter().find_map(|word| self.with(word))?;
            Some(Foreign { name: other.name.clone(), comment: format!("({comment})") })
        };
        others.find_map(told)
    }
}

fn score(control: &str, hints: &[Hint], evidence: &Evidence, comments: &Comments<'_>) -> Option<Score> {
    let mut points = 0;
    let mut against = 0;
    let mut best: (i32, Option<String>) = (i32::MIN, None);
    for hint in hints {
        let found = match (&hint.comment, &hint.code, &hint.form) {
            (Some(text), _, _) => comments.with(text).map(|comment| format!("({comment})")),
            (None, Some(code), _) => evidence.codes.iter().find(|c| *c == code).cloned(),
            (None, None, Some(form)) => evidence.forms.contains(form).then(|| form.to_string()),
            (None, None, None) => {
                let same = hint.extension.is_some() && hint.extension == evidence.extension;
                hint.extension.as_ref().filter(|_| same).map(|extension| format!(".{extension}"))
            }
        };
        if let Some(found) = found {
            points += hint.weight;
            against += usize::from(hint.weight < 0);
            if hint.weight > best.0 {
                best = (hint.weight, Some(found));
            }
        }
    }
    let guess = Guess { control: control.to_owned(), because: best.1?, rival: None, is_clear: false };
    Some(Score { guess, points, against })
}

/// Fewer points than these are too little to name a control: comments after `;` or words in lower case alone.
const ENOUGH_POINTS: i32 = 3;

/// With a lead of fewer points another control fits nearly as well.
const LEAD: i32 = 2;

/// With so many points a guess is clear: more than one weak hint.
const CLEAR_POINTS: i32 = 5;

impl<'e> Weighed<'e> {
    /// Weighs the evidence.
    pub fn new(evidence: &'e Evidence) -> Self {
        let comments = Comments::of(evidence);
        let of_control = |file: &'static ControlFile| score(&file.name, &file.detect, evidence, &comments);
        let mut scores: Vec<Score> = all_control_files().filter_map(of_control).collect();
        scores.sort_by(|a, b| b.points.cmp(&a.points).then_with(|| a.guess.control.cmp(&b.guess.control)));
        Self { evidence, comments, scores }
    }

    /// The control that the evidence speaks for, or `None` when it says too little, or the same of two, or when the program
    /// is for something that no control here reads.
    pub fn guess(&self) -> Option<Guess> {
        if self.evidence.unsupported.is_some() {
            return None;
        }
        let first = self.scores.first().filter(|first| first.points >= ENOUGH_POINTS)?;
        let second = self.scores.get(1);
        let lead = second.map_or(i32::MAX, |second| first.points - second.points);
        if lead == 0 || self.comments.foreign_unlike(&first.guess.control).is_some() {
            return None;
        }
        let rival = second.filter(|_| lead < LEAD).map(|second| second.guess.control.clone());
        let is_clear = rival.is_none() && first.points >= CLEAR_POINTS;
        Some(Guess { rival, is_clear, ..first.guess.clone() })
    }

    /// The control or builder that a comment names and that no control here is for.
    pub fn foreign(&self) -> Option<Foreign> {
        self.comments.foreign_unlike("")
    }

    /// May the program be for a control that its neighbours are for? Not where anything in it speaks against that, or more for
    /// another one.
    pub fn may_be_for(&self, control: &str) -> bool {
        let of_control = self.scores.iter().find(|score| score.guess.control == control);
        let points = of_control.map_or(0, |score| score.points);
        let speaks_against = of_control.is_some_and(|score| score.against > 0);
        let speaks_for_another = self.scores.first().is_some_and(|first| first.points >= points + LEAD);
        self.evidence.unsupported.is_none()
            && !speaks_against
            && !speaks_for_another
            && self.comments.foreign_unlike(control).is_none()
    }
}

/// The control that the evidence speaks for: [`Weighed::guess`].
pub fn guess(evidence: &Evidence) -> Option<Guess> {
    // Before any word is looked for: most of what has no control here is a dialect that none reads.
    if evidence.unsupported.is_some() { None } else { Weighed::new(evidence).guess() }
}

#[cfg(test)]
mod tests {
    use super::{Evidence, Foreign, SyntaxForm, Weighed, guess};

    fn foreign(evidence: &Evidence) -> Option<Foreign> {
        Weighed::new(evidence).foreign()
    }

    fn may_be_for(evidence: &Evidence, control: &str) -> bool {
        Weighed::new(evidence).may_be_for(control)
    }

    fn with_comment(text: &str, forms: &[SyntaxForm]) -> Evidence {
        Evidence { comments: vec![text.to_owned()], forms: forms.to_vec(), ..Evidence::default() }
    }

    #[test]
    fn a_builder_that_no_control_here_is_for_is_not_guessed_over() {
        let mill = with_comment("MAZAK VTC-20", &[SyntaxForm::SemicolonComment, SyntaxForm::LowerCase]);
        assert_eq!(guess(&mill), None);
        assert_eq!(foreign(&mill).map(|foreign| foreign.comment).as_deref(), Some("(MAZAK VTC-20)"));
        let lathe = with_comment("MAZAK QT-15", &[SyntaxForm::PackedTool, SyntaxForm::TurningWords]);
        assert_eq!(guess(&lathe).map(|guess| guess.control).as_deref(), Some("fanuc-lathe"));
        assert!(foreign(&with_comment("HAAS VF-2", &[])).is_none());
        let subroutine = with_comment("x and y of the centroid", &[SyntaxForm::OWord]);
        assert_eq!(guess(&subroutine).map(|guess| guess.control).as_deref(), Some("linuxcnc"));
    }

    #[test]
    fn names_of_controls_count_where_they_are_no_other_words() {
        let named = |text: &str| foreign(&with_comment(text, &[])).map(|foreign| foreign.name);
        for text in [
            "MITSUBISHI M70",
            "SIEMENS 840D",
            "BROTHER S700",
            "SYNTEC 21MA",
            "DELTA NC300",
            "NUM 1060",
            "TinyG",
            "DDCSV3.1",
            "Smoothieware",
            "Estlcam",
            "Marlin 2.1",
            "Duet 3",
        ] {
            assert!(named(text).is_some(), "{text}");
        }
        for text in ["TOOL NUM 3", "MITSUBISHI INSERT", "POSTED BY SIEMENS NX", "DELTA X", "HAAS BRACKET"] {
            assert_eq!(named(text), None, "{text}");
        }
        let control = |text: &str, codes: &[&str]| {
            let codes = codes.iter().map(|code| (*code).to_owned()).collect();
            guess(&Evidence { codes, ..with_comment(text, &[]) }).map(|guess| guess.control)
        };
        assert_eq!(control("PathPilot", &[]).as_deref(), Some("linuxcnc"));
        // They read more than grbl does, and would get its findings for what is right on them.
        assert_eq!(control("FOR grblHAL", &[]).as_deref(), Some("grblhal"));
        assert_eq!(control("FluidNC, grbl", &["M6"]).as_deref(), Some("fluidnc"));
    }

    #[test]
    fn a_guess_names_the_control_that_fits_nearly_as_well() {
        let lathe = with_comment("", &[SyntaxForm::PackedTool]);
        assert_eq!(guess(&lathe).and_then(|guess| guess.rival).as_deref(), Some("haas-lathe"));
        assert_eq!(guess(&with_comment("VF-2", &[])).map(|guess| guess.is_clear), Some(true));
        let weak = guess(&Evidence { codes: vec!["M29".to_owned()], ..Evidence::default() });
        assert_eq!(weak.map(|guess| (guess.rival, guess.is_clear)), Some((None, false)));
    }

    #[test]
    fn what_speaks_against_a_control_outweighs_its_neighbours() {
        let named = with_comment("", &[SyntaxForm::NamedParameter]);
        assert!(!may_be_for(&named, "fanuc-mill"));
        assert!(may_be_for(&named, "linuxcnc"));
        assert!(may_be_for(&Evidence::default(), "fanuc-mill"));
        let fanuc = with_comment("FANUC 31I", &[]);
        assert!(may_be_for(&fanuc, "fanuc-mill") && !may_be_for(&fanuc, "haas-mill"), "it names another");
    }
}
