//! What an image is built from: the Dockerfile, and beside it the binary for each processor.
//!
//! Knows: which archives have them. Must not know: how an image is built.

use std::io::Read as _;

use anyhow::Context as _;
use flate2::read::GzDecoder;

use crate::{PUBLISHED, Package};

const DOCKERFILE: &str = include_str!("../../../packages/Dockerfile");

/// The files of the folder that an image is built from, taken from the archives of a release.
///
/// # Errors
/// When an archive is missing or has no binary.
pub fn image(version: &str, archives: &[Package]) -> anyhow::Result<Vec<Package>> {
    let mut files =
        vec![Package { name: "docker/Dockerfile".to_owned(), bytes: DOCKERFILE.as_bytes().to_vec() }];
    for target in PUBLISHED.iter().filter(|target| !target.image.is_empty()) {
        let name = target.archive_name(version);
        let archive = archives.iter().find(|package| package.name == name);
        let archive = archive.with_context(|| format!("the release has no {name}"))?;
        let wanted = format!("{}/{}", target.stem(version), target.binary_name());
        let bytes = file_of(&archive.bytes, &wanted)?.with_context(|| format!("{name} has no {wanted}"))?;
        files.push(Package { name: format!("docker/bin/{}/{}", target.image, target.binary_name()), bytes });
    }
    Ok(files)
}

/// A file of a `.tar.gz`.
fn file_of(archive: &[u8], wanted: &str) -> anyhow::Result<Option<Vec<u8>>> {
    let mut tar = tar::Archive::new(GzDecoder::new(archive));
    for entry in tar.entries()? {
        let mut entry = entry?;
        if entry.path()?.to_str() == Some(wanted) {
            let mut bytes = Vec::new();
            entry.read_to_end(&mut bytes)?;
            return Ok(Some(bytes));
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::container::{Entry, tar_gz};

    #[test]
    fn every_file_that_the_dockerfile_copies_is_beside_it() {
        let archives: Vec<Package> = PUBLISHED
            .iter()
            .map(|target| {
                let path = format!("{}/{}", target.stem("1.2.3"), target.binary_name());
                let entry = Entry::program(path, target.triple);
                Package { name: target.archive_name("1.2.3"), bytes: tar_gz(&[entry], 1).unwrap() }
            })
            .collect();
        let files = image("1.2.3", &archives).unwrap();
        let copied = DOCKERFILE.lines().find_map(|line| line.strip_prefix("COPY --chmod=755 ")).unwrap();
        let source = copied.split(' ').next().unwrap();
        for processor in ["amd64", "arm64"] {
            let path = format!("docker/{}", source.replace("${TARGETARCH}", processor));
            assert!(files.iter().any(|file| file.name == path && !file.bytes.is_empty()), "{path}");
        }
        assert!(image("1.2.4", &archives).is_err());
    }
}
