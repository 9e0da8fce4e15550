# Sourced by demo and check: what they need, and how it gets there.
# shellcheck shell=bash disable=SC2034

# To build and run the program.
program_packages=(
  g++ cmake ninja-build git
  libeigen3-dev libboost-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libfmt-dev libmd4c-dev libmd4c-html0-dev librandom123-dev libtbb-dev
  libssl-dev libexpat1-dev
  gnuplot-nox
)
program_commands=(c++ cmake ninja git gnuplot)

# To compile the page of `thinwall explore`, on a system that has them.
page_packages=(clang-16 lld-16 libc++-16-dev-wasm32 libc++abi-16-dev-wasm32 libclang-rt-16-dev-wasm32 wasi-libc)

# To build and run the tests and benchmarks as well.
test_packages=(libgtest-dev librapidcheck-dev libbenchmark-dev libhwy-dev libopenmpi-dev openmpi-bin libflint-dev libflint-arb-dev
  pybind11-dev python3-dev python3-numpy python3-pytest python3-hypothesis)

# To check everything else. clang-format 16 is the first to lay out `requires` clauses well; the compiler is the oldest
# we support; libclang-rt holds its sanitizers and libFuzzer.
check_packages=(clang-14 libclang-rt-14-dev clang-format-16 clang-tidy-14)

# What readers of a result use, for the tests in tests/results/; each is skipped where its program is absent.
check_packages+=(python3-pandas python3-matplotlib mypy)
check_packages+=(chromium texlive-latex-base texlive-latex-recommended python3 python3-jsonschema)
check_commands=(clang++-14 clang-format-16 clang-tidy-14)

# The peers that are measured beside ours where they are installed (THINWALL_PEERS).
check_packages+=(libbullet-dev libode-dev libfcl-dev libccd-dev libbox2d-dev)

say() { printf '\n==> %s\n' "$*"; }
die() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

has_apt() { command -v dpkg-query >/dev/null && command -v apt-get >/dev/null; }

# Prints those of the named Debian packages that are not installed.
missing_packages() {
  local package
  for package in "$@"; do
    [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null) == installed ]] || echo "$package"
  done
}

# Prints those of the named commands that are not there.
missing_commands() {
  local name
  for name in "$@"; do
    command -v "$name" >/dev/null || echo "$name"
  done
}

# install_packages PACKAGE...: installs what is missing of them, and says which.
install_packages() {
  local missing as_root=()
  read -ra missing <<<"$(missing_packages "$@" | tr '\n' ' ')"
  if ((${#missing[@]} == 0)); then
    echo "All $# packages are installed."
    return
  fi
  if ((EUID != 0)); then
    command -v sudo >/dev/null || die "these packages are missing, and installing them needs root or sudo. As root, run:
  apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  echo "Installing: ${missing[*]}"
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300)
  "${apt[@]}" update
  "${apt[@]}" install -y --no-install-recommends "${missing[@]}" </dev/null >"$log" 2>&1 || {
    cat "$log" >&2
    die "apt-get could not install: ${missing[*]}"
  }
}

# known_packages PACKAGE...: prints them if this system has all of them, as far as apt has been told.
known_packages() {
  apt-cache show "$@" >/dev/null 2>&1 && echo "$@"
}

# need_commands NAME...: on a system without apt, stops if a tool is missing. CMake itself names missing libraries.
need_commands() {
  local missing
  read -ra missing <<<"$(missing_commands "$@" | tr '\n' ' ')"
  ((${#missing[@]} == 0)) || die "this is not Debian or Ubuntu, so nothing is installed for you; missing: ${missing[*]}
Install them, then run this again with THINWALL_FETCH=ON ./$(basename "$0"): CMake downloads the missing libraries, but OpenSSL and Expat."
  echo "All of these are there: $*"
}

# The presets take this one option from outside: ON lets CMake download pinned releases of missing libraries.
export THINWALL_FETCH="${THINWALL_FETCH:-OFF}"

log=$(mktemp "${TMPDIR:-/tmp}/thinwall.XXXXXX")
trap 'rm -f "$log"' EXIT
