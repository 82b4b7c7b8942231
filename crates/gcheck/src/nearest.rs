//! The name that somebody probably meant.
//!
//! Knows: how far two names are apart. Must not know: what they name.

/// The candidate nearest to `name`, if one is near enough to be meant.
pub(crate) fn nearest<'c>(name: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    let name = name.to_ascii_lowercase();
    candidates
        .into_iter()
        .map(|candidate| (strsim::damerau_levenshtein(&name, &candidate.to_ascii_lowercase()), candidate))
        .filter(|(distance, candidate)| *distance <= 1 + candidate.chars().count() / 4)
        .min()
        .map(|(_, candidate)| candidate)
}

/// `; did you mean …?`, or nothing.
pub(crate) fn did_you_mean<'c>(name: &str, candidates: impl IntoIterator<Item = &'c str>) -> String {
    let candidates: Vec<&str> = candidates.into_iter().collect();
    // A name that several begin with, as a builder's: `haas`.
    let head = format!("{}-", name.to_ascii_lowercase());
    let begun: Vec<String> = candidates
        .iter()
        .filter(|candidate| candidate.to_ascii_lowercase().starts_with(&head))
        .map(|candidate| format!("`{candidate}`"))
        .collect();
    if let [rest @ .., last] = begun.as_slice() {
        let before = if rest.is_empty() { String::new() } else { format!("{} or ", rest.join(", ")) };
        return format!("; did you mean {before}{last}?");
    }
    nearest(name, candidates).map(|near| format!("; did you mean `{near}`?")).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::{did_you_mean, nearest};

    #[test]
    fn a_builder_is_not_one_control() {
        let controls = ["fanuc-mill", "haas-lathe", "haas-mill", "linuxcnc"];
        assert_eq!(did_you_mean("Haas", controls), "; did you mean `haas-lathe` or `haas-mill`?");
        assert_eq!(did_you_mean("fanuc", controls), "; did you mean `fanuc-mill`?");
        assert_eq!(did_you_mean("linuxcn", controls), "; did you mean `linuxcnc`?");
        assert_eq!(did_you_mean("nonsense", controls), "");
    }

    #[test]
    fn only_near_names_are_suggested() {
        assert_eq!(nearest("Contrl", ["control", "machine"]), Some("control"));
        assert_eq!(nearest("max-rpm", ["max_rpm", "max_feed"]), Some("max_rpm"));
        assert_eq!(nearest("bananas", ["control", "machine"]), None);
    }
}
