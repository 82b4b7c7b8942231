//! Patterns of paths, counted from the folder of the configuration that holds them.
//!
//! Knows: globs. Must not know: what a pattern is used for.

use std::path::{Path, PathBuf};

use globset::{GlobBuilder, GlobMatcher};

/// Braces in braces in a pattern. The matcher is built by recursion, and gives up by a panic when there are too many.
const MAX_DEPTH: usize = 10;
/// Characters of a pattern.
const MAX_LENGTH: usize = 4_096;

/// A pattern: `legacy/**`, `*.nc` (in any folder), `build/` (everything in it).
#[derive(Debug, Clone)]
pub struct PathPattern {
    base: PathBuf,
    matcher: GlobMatcher,
}

impl PathPattern {
    /// Reads a pattern; the error is in words.
    pub fn new(base: &Path, pattern: &str) -> Result<Self, String> {
        if pattern.len() > MAX_LENGTH {
            return Err(format!("it is longer than {MAX_LENGTH} characters"));
        }
        if depth(pattern) > MAX_DEPTH {
            return Err(format!("its braces are nested deeper than {MAX_DEPTH}"));
        }
        let trimmed = pattern.trim_start_matches("./");
        let trimmed = trimmed.strip_prefix('/').unwrap_or(trimmed);
        let mut glob = trimmed.trim_end_matches('/').to_owned();
        // A name alone fits in any folder, as in ignore files.
        if !pattern.trim_end_matches('/').contains('/') {
            glob.insert_str(0, "**/");
        }
        let glob = GlobBuilder::new(&glob)
            .literal_separator(true)
            .build()
            .map_err(|error| error.kind().to_string())?;
        Ok(Self { base: base.to_owned(), matcher: glob.compile_matcher() })
    }

    /// Does the pattern name this path? The path is absolute.
    pub fn fits(&self, path: &Path) -> bool {
        path.strip_prefix(&self.base).is_ok_and(|path| self.matcher.is_match(path))
    }

    /// Does the pattern name this path, or a folder above it?
    pub fn fits_or_holds(&self, path: &Path) -> bool {
        path.strip_prefix(&self.base)
            .is_ok_and(|path| path.ancestors().any(|p| !p.as_os_str().is_empty() && self.matcher.is_match(p)))
    }
}

/// How deep braces are nested; those that are quoted count too, since nobody writes so many.
fn depth(pattern: &str) -> usize {
    let mut open = 0_usize;
    let mut deepest = 0;
    for byte in pattern.bytes() {
        match byte {
            b'{' => open += 1,
            b'}' => open = open.saturating_sub(1),
            _ => {}
        }
        deepest = deepest.max(open);
    }
    deepest
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::PathPattern;

    fn fits(pattern: &str, path: &str) -> bool {
        PathPattern::new(Path::new("/shop"), pattern).unwrap().fits(&Path::new("/shop").join(path))
    }

    #[test]
    fn names_fit_in_any_folder_and_paths_from_the_base() {
        assert!(fits("*.nc", "a.nc") && fits("*.nc", "x/y/a.nc"));
        assert!(fits("legacy/**", "legacy/x/a.nc") && !fits("legacy/**", "new/legacy/a.nc"));
        assert!(fits("/top/*.nc", "top/a.nc") && !fits("top/*.nc", "top/x/a.nc"));
        assert!(!fits("*.nc", "/elsewhere/a.nc"));
    }

    #[test]
    fn a_folder_holds_what_is_in_it() {
        let pattern = PathPattern::new(Path::new("/shop"), "old/").unwrap();
        assert!(pattern.fits_or_holds(Path::new("/shop/x/old/y/a.nc")));
        assert!(!pattern.fits_or_holds(Path::new("/shop/x/older/a.nc")));
    }

    #[test]
    fn a_broken_pattern_is_refused_in_words() {
        assert!(PathPattern::new(Path::new("/"), "[a").unwrap_err().contains("unclosed"));
    }

    #[test]
    fn a_pattern_that_would_take_the_matcher_down_is_refused() {
        let nested = |depth: usize| format!("{}b{}", "{a,".repeat(depth), "}".repeat(depth));
        assert!(PathPattern::new(Path::new("/"), &nested(10)).is_ok());
        for depth in [11, 240, 1_000, 1_000_000] {
            assert!(PathPattern::new(Path::new("/"), &nested(depth)).is_err(), "{depth}");
        }
        assert!(PathPattern::new(Path::new("/"), &"*".repeat(100_000)).is_err());
        assert!(PathPattern::new(Path::new("/"), &"{a,b}*".repeat(600)).is_ok());
    }
}
