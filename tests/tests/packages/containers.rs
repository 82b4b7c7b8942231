//! The image without a container: what its Dockerfile says, done in a folder.
//!
//! Knows: the instructions that the Dockerfile has. Must not know: docker; the base image, which has no shell and no files
//! that gcheck needs.

use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::process::Command;

use gcheck_packages::{Target, archive, image};

use crate::place::{Place, VERSION, here, output, with_build};

/// An image as far as its Dockerfile says it.
#[derive(Default)]
struct Image {
    base: String,
    folder: String,
    environment: Vec<(String, String)>,
    entry: Vec<String>,
    command: Vec<String>,
}

/// Follows the Dockerfile of the folder `docker` for a processor; copied files come into the folder `root`.
fn build(place: &Place, processor: &str) -> Image {
    let mut image = Image::default();
    let file = fs::read_to_string(place.path("docker/Dockerfile")).unwrap();
    for line in file.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        let (instruction, rest) = line.split_once(' ').unwrap();
        // Without a shell in the image only lists of words can be started.
        let words = || serde_json::from_str::<Vec<String>>(rest).unwrap();
        match instruction {
            "FROM" => rest.clone_into(&mut image.base),
            "ARG" => assert_eq!(rest, "TARGETARCH"),
            "COPY" => {
                let [mode, from, to] = rest.split(' ').collect::<Vec<_>>().try_into().unwrap();
                let mode = u32::from_str_radix(mode.strip_prefix("--chmod=").unwrap(), 8).unwrap();
                let copy = place.path(&format!("root{to}"));
                fs::create_dir_all(copy.parent().unwrap()).unwrap();
                let from = format!("docker/{}", from.replace("${TARGETARCH}", processor));
                fs::copy(place.path(&from), &copy).unwrap();
                fs::set_permissions(&copy, fs::Permissions::from_mode(mode)).unwrap();
            }
            "WORKDIR" => rest.clone_into(&mut image.folder),
            "ENV" => {
                let (name, value) = rest.split_once('=').unwrap();
                image.environment.push((name.to_owned(), value.to_owned()));
            }
            "ENTRYPOINT" => image.entry = words(),
            "CMD" => image.command = words(),
            unknown => panic!("the test does not know `{unknown}`"),
        }
    }
    image
}

#[test]
fn the_image_starts_what_its_dockerfile_copies() {
    let linux = Target::named(&here().triple.replace("-gnu", "-musl")).unwrap();
    let archives: Vec<_> = gcheck_packages::PUBLISHED
        .iter()
        .filter(|target| !target.image.is_empty())
        .map(|target| with_build(target, archive))
        .collect();
    let place = Place::with(&image(VERSION, &archives).unwrap());
    let image = build(&place, linux.image);
    // No shell, no C library, and not the superuser.
    assert!(image.base.contains("distroless/static") && image.base.ends_with(":nonroot"), "{}", image.base);
    assert!(!linux.needs_libc);
    // The program is where the image starts it, and may be started by everybody.
    let [program] = image.entry.try_into().unwrap();
    let program = place.path(&format!("root{program}"));
    assert_eq!(fs::metadata(&program).unwrap().permissions().mode() & 0o777, 0o755);

    let folder = place.path(&format!("root{}", image.folder));
    fs::create_dir_all(&folder).unwrap();
    fs::copy(place.path("part.nc"), folder.join("part.nc")).unwrap();
    let run = |arguments: &[String]| {
        let mut command = Command::new(&program);
        command.args(arguments).current_dir(&folder).env_clear().envs(image.environment.iter().cloned());
        // The cache is in a folder of the container.
        command.env("GCHECK_CACHE", place.path("cache"));
        let output = output(&mut command);
        (output.status.code(), String::from_utf8([output.stdout, output.stderr].concat()).unwrap())
    };
    let (code, said) = run(&image.command);
    assert!(code == Some(0) && said.contains("Usage: gcheck"), "{said}");
    let (code, said) = run(&["check", "--control", "haas-mill"].map(str::to_owned));
    assert!(code == Some(1) && said.contains("error[unknown-code]"), "{said}");
    let cache = image.environment.iter().find(|(name, _)| name == "GCHECK_CACHE");
    assert!(
        cache.is_some_and(|(_, folder)| folder.starts_with("/tmp/")),
        "results are kept where anybody may write"
    );
}
