# Installs gcheck @VERSION@ for the user who runs it: downloads the archive for this system, compares its checksum with
# the one below, and puts the binary into $env:GCHECK_INSTALL_DIR (default: %LOCALAPPDATA%\Programs\gcheck).
$ErrorActionPreference = 'Stop'
$version = '@VERSION@'
$download = if ($env:GCHECK_DOWNLOAD) { $env:GCHECK_DOWNLOAD } else { '@URL@/releases/download/v@VERSION@' }
$folder = if ($env:GCHECK_INSTALL_DIR) { $env:GCHECK_INSTALL_DIR } else { Join-Path $env:LOCALAPPDATA 'Programs\gcheck' }

function Stop-Install([string] $reason) {
    [Console]::Error.WriteLine("gcheck is not installed: $reason")
    exit 1
}

# A 32-bit shell on a 64-bit system names the processor in the other variable.
$processor = if ($env:PROCESSOR_ARCHITEW6432) { $env:PROCESSOR_ARCHITEW6432 } else { $env:PROCESSOR_ARCHITECTURE }
switch ($processor) {
    'AMD64' { $target = 'x86_64-pc-windows-msvc'; $sum = '@SHA256:x86_64-pc-windows-msvc@' }
    'ARM64' { $target = 'aarch64-pc-windows-msvc'; $sum = '@SHA256:aarch64-pc-windows-msvc@' }
    default { Stop-Install "there is no binary for Windows on $processor; build it from source (see README.md)" }
}

$name = "gcheck-v$version-$target"
$work = Join-Path ([IO.Path]::GetTempPath()) ([IO.Path]::GetRandomFileName())
New-Item -ItemType Directory -Path $work | Out-Null
try {
    $archive = Join-Path $work "$name.zip"
    try {
        Invoke-WebRequest -UseBasicParsing -Uri "$download/$name.zip" -OutFile $archive
    } catch {
        Stop-Install "$download/$name.zip cannot be downloaded: $($_.Exception.Message)"
    }
    $found = (Get-FileHash -Algorithm SHA256 -Path $archive).Hash.ToLowerInvariant()
    if ($found -ne $sum) {
        Stop-Install "the checksum of $name.zip is $found and not $sum"
    }
    Expand-Archive -Path $archive -DestinationPath $work
    New-Item -ItemType Directory -Force -Path $folder | Out-Null
    Copy-Item -Force -Path (Join-Path $work "$name\gcheck.exe") -Destination $folder
} finally {
    Remove-Item -Recurse -Force -Path $work
}
Write-Output "gcheck $version is in $folder"
if (-not (($env:Path -split ';') -contains $folder)) {
    Write-Output 'This folder is not on the search path; add it in the settings of the environment.'
}
