//! Patterns of paths, counted from the folder of the configuration that holds them.
//!
//! Knows: globs. Must not know: what a pattern is used for.

use std::path::{Path, PathBuf};

use globset::{GlobBuilder, GlobMatcher};

/// A pattern: `legacy/**`, `*.nc` (in any folder), `build/` (everything in it).
#[derive(Debug, Clone)]
pub struct PathPattern {
    base: PathBuf,
    matcher: GlobMatcher,
}

impl PathPattern {
    /// Reads a pattern; the error is in words.
    pub fn new(base: &Path, pattern: &str) -> Result<Self, String> {
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
}
