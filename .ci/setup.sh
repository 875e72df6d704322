# Sourced by ./run and ./test: installs missing packages, builds a preset.

# Objects are found again by what their sources include, without running the preprocessor first: half as much for what is new.
export CCACHE_DEPEND=1
# What uses a precompiled header is found again, too.
export CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_PCH_EXTSUM=1
# A clone in another folder finds the same objects.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1

say() { printf '\033[1m%s\033[0m\n' "$*" >&2; }
fail() { printf '%s\n' "$*" >&2; exit 1; }

# install_packages [PART]: what .ci/packages.txt lists for everyone, or for that part of .ci/run alone ("name  # parts").
install_packages() {
  local wanted missing=() name part=${1:-}
  mapfile -t wanted < <(awk -v part="$part" '!/^#/ && NF { if (part == "" ? NF == 1 : (" " $0 " ") ~ (" " part " ")) print $1 }' .ci/packages.txt)
  for name in "${wanted[@]}"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] || missing+=("$name")
  done
  [ ${#missing[@]} -eq 0 ] && return
  command -v apt-get >/dev/null || fail "This needs Debian 12 with apt. Install by hand what .ci/packages.txt lists: ${missing[*]}"
  local as=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "Missing packages and no permission to install them. As root: apt-get install ${missing[*]}"
    as=(sudo)
  fi
  say "Installing ${#missing[@]} packages: ${missing[*]}"
  local log
  log=$(mktemp)
  if ! { "${as[@]}" apt-get update -q && "${as[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    tail -5 "$log" >&2
    fail "The packages could not be installed (no network, or no permission?). The whole log: $log"
  fi
  rm -f "$log"
}

# The browser that drives pages, and npm, which some packages of Node bring.
install_web() {
  install_packages web
  command -v npm >/dev/null || install_packages npm
}

configure() {
  local log
  [ ! -f "build/$1/build.ninja" ] || return 0
  log=$(mktemp)
  cmake --preset "$1" >"$log" 2>&1 || { tail -20 "$log" >&2; fail "The build could not be configured. The whole log: $log"; }
  rm -f "$log"
}

# build PRESET [TARGET…]
build() {
  local preset=$1 log
  shift
  configure "$preset"
  log=$(mktemp)
  if [ -t 2 ]; then
    cmake --build "build/$preset" ${1:+--target "$@"} >&2 || fail "The build failed."
  else
    cmake --build "build/$preset" ${1:+--target "$@"} >"$log" 2>&1 || { grep -E -A12 'error|FAILED' "$log" | head -60 >&2; fail "The build failed. The whole log: $log"; }
  fi
  rm -f "$log"
}
