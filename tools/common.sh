# shellcheck shell=sh disable=SC2034,SC2154,SC2164
# Sourced by the scripts beside this file (POSIX sh). Wants `root`, the top of the source tree.

say() { printf '%s\n' "$*" >&2; }
die() {
  say "${0##*/}: $*"
  exit 1
}

# The packages of the named groups of packages.txt.
packages_of() {
  for group in "$@"; do
    awk -v wanted="[$group]" '
      /^# \[/ { open = $2 == wanted; next }
      /^#/ || NF == 0 { next }
      open { print $1 }' "$root/tools/packages.txt"
  done | sort -u
}

is_installed() {
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# Runs a command as root: directly, or through sudo.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  else
    sudo "$@"
  fi
}

# Installs what is missing of the named groups. Touches nothing when nothing is missing.
install_packages() {
  if ! command -v dpkg-query >/dev/null 2>&1; then
    say "This is not a Debian system: the packages of tools/packages.txt are taken to be there."
    return 0
  fi
  missing=
  for package in $(packages_of "$@"); do
    is_installed "$package" || missing="$missing $package"
  done
  [ -n "$missing" ] || return 0
  if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null 2>&1; then
    die "these packages are missing, and there is neither root nor sudo to install them:$missing"
  fi
  say "Installing:$missing"
  as_root apt-get update -q
  # Word splitting is wanted: one argument per package.
  # shellcheck disable=SC2086
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends $missing
}

program=$root/build/release/tools/hedgerow

# Builds the release program. Messages go to standard error: standard output is the program's.
build_program() {
  (
    cd "$root"
    # Where the tree was configured before, perhaps with more in it, that choice stays.
    [ -f build/release/build.ninja ] ||
      cmake --preset release -DHEDGEROW_BUILD_TESTS=OFF -DHEDGEROW_BUILD_BENCH=OFF
    cmake --build --preset release --target hedgerow_program
  ) >&2
}
