# Homebrew's formula; `cargo xtask dist release` fills it in.
class Gcheck < Formula
  desc "Checks CNC part programs (G-code) the way the control reads them"
  homepage "@URL@"
  version "@VERSION@"
  license any_of: ["MIT", "Apache-2.0"]

  on_macos do
    on_arm do
      url "@URL@/releases/download/v@VERSION@/gcheck-v@VERSION@-aarch64-apple-darwin.tar.gz"
      sha256 "@SHA256:aarch64-apple-darwin@"
    end
    on_intel do
      url "@URL@/releases/download/v@VERSION@/gcheck-v@VERSION@-x86_64-apple-darwin.tar.gz"
      sha256 "@SHA256:x86_64-apple-darwin@"
    end
  end

  on_linux do
    on_arm do
      url "@URL@/releases/download/v@VERSION@/gcheck-v@VERSION@-aarch64-unknown-linux-musl.tar.gz"
      sha256 "@SHA256:aarch64-unknown-linux-musl@"
    end
    on_intel do
      url "@URL@/releases/download/v@VERSION@/gcheck-v@VERSION@-x86_64-unknown-linux-musl.tar.gz"
      sha256 "@SHA256:x86_64-unknown-linux-musl@"
    end
  end

  def install
    bin.install "gcheck"
    bash_completion.install "completions/gcheck.bash" => "gcheck"
    fish_completion.install "completions/gcheck.fish"
    zsh_completion.install "completions/gcheck.zsh" => "_gcheck"
  end

  test do
    (testpath/"part.nc").write "%\nO0001\nG999\nM30\n%\n"
    assert_match "unknown-code", shell_output("#{bin}/gcheck check --control haas-mill part.nc", 1)
  end
end
