#!/bin/sh
# Installs gcheck @VERSION@ for the user who runs it: downloads the archive for this system, compares its checksum with
# the one below, and puts the binary into $GCHECK_INSTALL_DIR (default: ~/.local/bin).
#
#   GCHECK_INSTALL_DIR  the folder for the binary
#   GCHECK_DOWNLOAD     the address of the folder with the archives, for a mirror of your own
set -eu

version='@VERSION@'
download=${GCHECK_DOWNLOAD:-'@URL@/releases/download/v@VERSION@'}

fail() {
  printf 'gcheck is not installed: %s\n' "$1" >&2
  exit 1
}

has() {
  command -v "$1" > /dev/null 2>&1
}

system=$(uname -s)
processor=$(uname -m)
case "$system-$processor" in
  Linux-x86_64 | Linux-amd64)
    target=x86_64-unknown-linux-musl
    sum='@SHA256:x86_64-unknown-linux-musl@' ;;
  Linux-aarch64 | Linux-arm64)
    target=aarch64-unknown-linux-musl
    sum='@SHA256:aarch64-unknown-linux-musl@' ;;
  Darwin-x86_64)
    target=x86_64-apple-darwin
    sum='@SHA256:x86_64-apple-darwin@' ;;
  Darwin-arm64)
    target=aarch64-apple-darwin
    sum='@SHA256:aarch64-apple-darwin@' ;;
  *)
    fail "there is no binary for $system on $processor; build it from source (see README.md)" ;;
esac

folder=${GCHECK_INSTALL_DIR:-"${HOME:?}/.local/bin"}
name="gcheck-v$version-$target"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

if has curl; then
  curl --fail --silent --show-error --location --output "$work/$name.tar.gz" "$download/$name.tar.gz" ||
    fail "$download/$name.tar.gz cannot be downloaded"
elif has wget; then
  wget --quiet --output-document="$work/$name.tar.gz" "$download/$name.tar.gz" ||
    fail "$download/$name.tar.gz cannot be downloaded"
else
  fail 'neither curl nor wget is installed'
fi

if has sha256sum; then
  found=$(sha256sum "$work/$name.tar.gz")
elif has shasum; then
  found=$(shasum -a 256 "$work/$name.tar.gz")
else
  fail 'neither sha256sum nor shasum is installed, so the checksum cannot be compared'
fi
found=${found%% *}
[ "$found" = "$sum" ] || fail "the checksum of $name.tar.gz is $found and not $sum"

tar -xzf "$work/$name.tar.gz" -C "$work" || fail "$name.tar.gz cannot be unpacked"
mkdir -p "$folder" || fail "$folder cannot be made"
# To a new name first: a running gcheck keeps its file, and nobody sees half of one.
cp "$work/$name/gcheck" "$folder/.gcheck.new" || fail "$folder cannot be written to"
chmod 755 "$folder/.gcheck.new"
mv -f "$folder/.gcheck.new" "$folder/gcheck" || fail "$folder/gcheck cannot be replaced"
"$folder/gcheck" --version > /dev/null || fail "$folder/gcheck does not start"

printf 'gcheck %s is in %s\n' "$version" "$folder"
case ":${PATH:-}:" in
  *":$folder:"*) ;;
  *) printf 'This folder is not on the search path; add it: export PATH="%s:$PATH"\n' "$folder" ;;
esac
