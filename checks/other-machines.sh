#!/usr/bin/env bash
# Makes tables and pictures of the figures on other machines and compares their sums with those of data/SHA256SUMS, and
# the bits of every law, compiled and as a formula, with crates/jam/tests/bits.csv (but under WebAssembly):
#   checks/other-machines.sh [--only PART]... [SUMS]
# PART: here, environment, nehalem, arm64, wasm; and, only when named, i686, riscv64, s390x, windows.
# What a part needs is installed when this is Debian and the user is root; where that is not possible the part is
# reported as skipped. Everything is written under target/other-machines. Exit code 1 when a sum differs.
set -u -o pipefail
cd "$(dirname "$0")/.." || exit 2
root=$PWD
case ${CARGO_TARGET_DIR:-} in
  /*) target=$CARGO_TARGET_DIR ;;
  *) target=$root/${CARGO_TARGET_DIR:-target} ;;
esac
scratch=$root/target/other-machines
passed=0 failed=0 skipped=0
parts=()
while [ "${1:-}" = --only ]; do parts+=("${2:?--only needs a part}"); shift 2; done
[ ${#parts[@]} -gt 0 ] || parts=(here environment nehalem arm64 wasm)
case ${1:-} in
  /*) sums=$1 ;;
  *) sums=$root/${1:-data/SHA256SUMS} ;;
esac
if [ ! -r "$sums" ]; then
  echo "$sums: no such list of sums; cargo xtask figures and cargo xtask bless make one" >&2
  exit 2
fi
mkdir -p "$scratch"

# --- making figures -----------------------------------------------------------------------------------------------

# The panels of a scene that have a run.
run_panels() {
  grep -q '^\[run\]' "$1" || return 0
  local panels
  panels=$(sed -n 's/^\[panel\.\([a-z0-9_]*\).*/\1/p' "$1" | sort -u)
  echo "${panels:-main}"
}

# one_figure SLUG BIN OUT [RUNNER..], with the programs' suffix in the environment: runs, tables and pictures of one figure, from the current folder's scenes.
one_figure() {
  local slug=$1 bin=$2 out=$3 scene=figures/$1/scene.toml id=${1%%-*} panel
  shift 3
  local runs=()
  for panel in $(run_panels "$scene"); do
    "$@" "$bin/simulate${suffix:-}" "$scene" --panel "$panel" --out "$out/runs/$id-$panel" --tables-only || return 1
    runs+=(--run "$panel=$out/runs/$id-$panel")
  done
  "$@" "$bin/$slug${suffix:-}" --scene "$scene" ${runs[@]+"${runs[@]}"} --tables "$out/data/$id" --pictures "$out/figures/$slug"
}
export -f one_figure run_panels

# all_figures BIN OUT JOBS [RUNNER..]: the same for all figures, JOBS at a time.
all_figures() {
  local bin=$1 out=$2 jobs=$3
  shift 3
  rm -rf "$out"
  mkdir -p "$out"
  local figures=(figures/fig[0-9][0-9]-*)
  # xargs puts the slug behind the other arguments
  printf '%s\n' "${figures[@]#figures/}" |
    xargs -P "$jobs" -n 1 bash -c 'one_figure "${@: -1}" "${@:1:$#-1}"' one "$bin" "$out" "$@" >"$out/log" 2>&1 ||
    { tail -n 5 "$out/log" >&2; return 1; }
}

# --- comparing ----------------------------------------------------------------------------------------------------

# The lines of a list of sums that concern the figures of the paper: tables, and pictures unless $1 is "tables".
figure_lines() {
  local pattern='  data/fig[0-9][0-9]/'
  [ "$1" = tables ] || pattern="$pattern|  figures/fig[0-9][0-9]-"
  grep -E "$pattern" | LC_ALL=C sort -k 2
}

# sums_of OUT: the sums of what lies there, by name.
sums_of() (
  cd "$1" || exit
  if command -v sha256sum >/dev/null; then sum=(sha256sum); else sum=(shasum -a 256); fi
  find data figures -type f \( -name '*.csv' -o -name '*.png' -o -name '*.svg' \) -exec "${sum[@]}" {} +
)

# compare NAME KIND FILE SECONDS: the sums in FILE against the known ones.
compare() {
  local differences count
  count=$(figure_lines "$2" <"$sums" | wc -l)
  differences=$(diff <(figure_lines "$2" <"$sums") <(figure_lines "$2" <"$3") | sed -n 's/^[<>] [0-9a-f]*  //p' | sort -u)
  if [ -z "$differences" ] && [ "$count" -gt 0 ]; then
    passed=$((passed + 1))
    echo "passed: $1: $count sums equal, $4 s"
  else
    failed=$((failed + 1))
    echo "failed: $1: $(echo "$differences" | grep -c .) of $count sums differ or are missing:"
    echo "$differences" | sed 's/^/  /'
  fi
}

# figures_as NAME BIN JOBS [RUNNER..]: makes all figures in the current folder and compares them.
figures_as() {
  local name=$1 bin=$2 jobs=$3 out begin=$SECONDS
  shift 3
  out=$PWD/out
  if all_figures "$bin" "$out" "$jobs" "$@"; then
    sums_of "$out" >"$out/sums"
    compare "$name" all "$out/sums" $((SECONDS - begin))
  else
    failed=$((failed + 1))
    echo "failed: $name: a figure could not be made"
  fi
}

# bits_as NAME BIN [RUNNER..]: compares the bits of laws.
bits_as() {
  local name=$1 bin=$2 differences
  shift 2
  if differences=$("$@" "$bin/examples/bits${suffix:-}" | tr -d '\r' | diff - "$root/crates/jam/tests/bits.csv"); then
    passed=$((passed + 1))
    echo "passed: $name: the bits of $(($(wc -l <"$root/crates/jam/tests/bits.csv") - 1)) laws, compiled and as formulas"
  else
    failed=$((failed + 1))
    echo "failed: $name: other bits than in crates/jam/tests/bits.csv:"
    echo "$differences" | sed -n 's/^[<>]/  &/p'
  fi
}

skip() {
  skipped=$((skipped + 1))
  echo "skipped: $1: $2"
}

# --- what the parts need ------------------------------------------------------------------------------------------

is_updated=no
# install PACKAGE..: with apt, as root on Debian; fails elsewhere.
install() {
  [ "$(id -u)" = 0 ] && [ -e /etc/debian_version ] || return 1
  case " $* " in
    *:arm64*) dpkg --print-foreign-architectures | grep -qx arm64 || { dpkg --add-architecture arm64 && is_updated=no; } ;;
  esac
  if [ $is_updated = no ]; then
    apt-get update >"$scratch/apt.log" 2>&1
    is_updated=yes
  fi
  DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "$@" >>"$scratch/apt.log" 2>&1
}

# tools NAME..: whether all these programs are there.
tools() {
  local name
  for name; do command -v "$name" >/dev/null || return 1; done
}

# has_target RUSTC TRIPLE: whether this compiler has the standard library of this target.
has_target() {
  local libraries
  libraries=$("$1" --print target-libdir --target "$2" 2>/dev/null) && [ -d "$libraries" ]
}

# Builds the figures' binaries for this machine.
build_here() {
  cargo build --release --quiet -p figures -p jamming --bins --example bits >"$scratch/build.log" 2>&1 || { tail -n 20 "$scratch/build.log" >&2; return 1; }
}

# folder NAME: a folder with scenes and references and nothing else; its path.
folder() {
  local place=$scratch/$1
  rm -rf "$place"
  mkdir -p "$place/figures" "$place/data"
  cp -R data/reference "$place/data/"
  find figures -name scene.toml | while read -r scene; do
    mkdir -p "$place/$(dirname "$scene")"
    cp "$scene" "$place/$scene"
  done
  echo "$place"
}

# --- the parts ----------------------------------------------------------------------------------------------------

part_here() {
  build_here || { skip here "the binaries do not build"; return; }
  local place
  place=$(folder here)
  bits_as "this machine" "$target/release"
  cd "$place" && figures_as "this machine" "$target/release" 2
}

# Another folder, user, language, time zone and number of jobs; glibc without FMA and AVX2.
part_environment() {
  build_here || { skip environment "the binaries do not build"; return; }
  local place jobs
  place=$(folder 'a place/größer als 1 Å')
  mkdir -p "$place/bin"
  cp "$target"/release/fig[0-9][0-9]-* "$target/release/simulate" "$place/bin/" 2>/dev/null
  cd "$place" || return
  for jobs in 1 2 8; do
    local settings=(PATH="$PATH" USER=somebody LOGNAME=somebody HOME=/nonexistent)
    case $jobs in
      1) settings+=(LANG=C LC_ALL=C TZ=UTC GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2) ;;
      2) settings+=(LANG=tr_TR.UTF-8 LC_ALL=tr_TR.UTF-8 TZ=Asia/Kathmandu GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2) ;;
      8) settings+=(LANG=de_DE.UTF-8 LC_NUMERIC=de_DE.UTF-8 TZ=America/St_Johns RAYON_NUM_THREADS=3) ;;
    esac
    figures_as "another environment, $jobs jobs" "$place/bin" "$jobs" env -i "${settings[@]}"
  done
}

# A processor without AVX and FMA.
part_nehalem() {
  [ "$(uname -m)" = x86_64 ] || { skip nehalem "this machine does not run x86-64 programs"; return; }
  tools qemu-x86_64 || install qemu-user || { skip nehalem "qemu-x86_64 is missing"; return; }
  build_here || { skip nehalem "the binaries do not build"; return; }
  local place
  place=$(folder nehalem)
  bits_as "x86-64 without AVX and FMA" "$target/release" qemu-x86_64 -cpu Nehalem
  bits_as "x86-64 with AVX2 alone" "$target/release" qemu-x86_64 -cpu Haswell
  cd "$place" && figures_as "x86-64 without AVX and FMA" "$target/release" 2 qemu-x86_64 -cpu Nehalem
}

# 64-bit ARM, emulated; the pinned Rust if it has the target, else Debian's.
part_arm64() {
  local triple=aarch64-unknown-linux-gnu compiler=rustc place
  local packages=(gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user)
  if ! has_target rustc $triple; then
    compiler=/usr/bin/rustc
    packages+=(rustc-web libstd-rust-web-dev:arm64)
  fi
  if ! { tools qemu-aarch64 aarch64-linux-gnu-gcc && has_target $compiler $triple; }; then
    install "${packages[@]}" || { skip arm64 "needs ${packages[*]}"; return; }
  fi
  env RUSTC=$compiler CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc \
    CARGO_TARGET_DIR="$scratch/build" cargo build --release --quiet --target $triple -p figures -p jamming --bins --example bits \
    >"$scratch/arm64.log" 2>&1 || { tail -n 20 "$scratch/arm64.log" >&2; skip arm64 "the binaries do not build"; return; }
  place=$(folder arm64)
  bits_as "arm64" "$scratch/build/$triple/release" qemu-aarch64 -L /usr/aarch64-linux-gnu
  cd "$place" && figures_as "arm64" "$scratch/build/$triple/release" 2 qemu-aarch64 -L /usr/aarch64-linux-gnu
}

# WebAssembly: tables only, without fused multiply-add and on 32 bits.
part_wasm() {
  local triple=wasm32-unknown-unknown settings=() options=() begin packages=(rustc-web rust-web-src lld-19)
  tools node || install nodejs || { skip wasm "node is missing"; return; }
  if ! has_target rustc $triple; then
    if ! { tools /usr/bin/rustc wasm-ld-19 && [ -d "$(/usr/bin/rustc --print sysroot)/lib/rustlib/src/rust/library" ]; }; then
      install "${packages[@]}" || { skip wasm "needs the Rust target $triple, or ${packages[*]}"; return; }
    fi
    # Debian has the library's sources only; to build it, a released compiler must be told to allow it
    settings=(RUSTC_BOOTSTRAP=1 RUSTC=/usr/bin/rustc CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER=wasm-ld-19)
    options=(-Zbuild-std=std,panic_abort)
  fi
  env ${settings[@]+"${settings[@]}"} CARGO_TARGET_DIR="$scratch/build" cargo build --release --quiet \
    ${options[@]+"${options[@]}"} --target $triple -p browser \
    >"$scratch/wasm.log" 2>&1 || { tail -n 20 "$scratch/wasm.log" >&2; skip wasm "the module does not build"; return; }
  begin=$SECONDS
  if node checks/wasm-sums.mjs "$scratch/build/$triple/release/browser.wasm" >"$scratch/wasm-sums"; then
    compare "WebAssembly under Node" tables "$scratch/wasm-sums" $((SECONDS - begin))
  else
    failed=$((failed + 1))
    echo "failed: WebAssembly under Node: the tables could not be made"
  fi
}

# Debian's compiler and the sources of its standard library, which is built along.
has_std_source() {
  [ -d "$(/usr/bin/rustc --print sysroot 2>/dev/null)/lib/rustlib/src/rust/library" ]
}

# build_with_std TRIPLE LINKER [RUSTFLAGS]: the binaries with a standard library from source.
build_with_std() {
  local name=${1//-/_}
  name=${name^^}
  env RUSTC_BOOTSTRAP=1 RUSTC=/usr/bin/rustc "CARGO_TARGET_${name}_LINKER=$2" "CARGO_TARGET_${name}_RUSTFLAGS=${3:-}" \
    CARGO_TARGET_DIR="$scratch/build" cargo build --release --quiet -Zbuild-std=std,panic_unwind --target "$1" -p figures -p jamming --bins --example bits \
    >"$scratch/$1.log" 2>&1 || { tail -n 20 "$scratch/$1.log" >&2; return 1; }
}

# from_source NAME TRIPLE PREFIX PACKAGES [RUNNER..]: another Linux, with Debian's cross compiler PREFIX-gcc.
from_source() {
  local name=$1 triple=$2 prefix=$3 packages=(rustc-web rust-web-src) place
  read -ra more <<<"$4"
  packages+=("${more[@]}")
  shift 4
  if ! { has_std_source && tools "$prefix-gcc" ${1:+"$1"}; }; then
    install "${packages[@]}" || { skip "$name" "needs ${packages[*]}"; return; }
  fi
  build_with_std "$triple" "$prefix-gcc" || { skip "$name" "the binaries do not build"; return; }
  place=$(folder "$name")
  bits_as "$name" "$scratch/build/$triple/release" "$@"
  cd "$place" && figures_as "$name" "$scratch/build/$triple/release" 2 "$@"
}

# 32 bits, with SSE2; run by this processor.
part_i686() {
  from_source i686 i686-unknown-linux-gnu i686-linux-gnu 'gcc-i686-linux-gnu libc6-dev-i386-cross libc6-i386 lib32gcc-s1'
}

part_riscv64() {
  from_source riscv64 riscv64gc-unknown-linux-gnu riscv64-linux-gnu 'gcc-riscv64-linux-gnu libc6-dev-riscv64-cross qemu-user' \
    qemu-riscv64 -L /usr/riscv64-linux-gnu
}

# QEMU from Debian's backports, unpacked below target/ with lists of its own: nothing of the system changes.
newer_qemu() {
  local at=$scratch/qemu mirror options
  [ -x "$at/root/usr/bin/qemu-s390x" ] && return
  [ -e /etc/debian_version ] || return
  mkdir -p "$at/lists/partial" "$at/archives/partial"
  mirror=$(apt-get indextargets --format '$(REPO_URI)' | head -n 1)
  echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror bookworm-backports main" >"$at/sources.list"
  options=(-o "Dir::Etc::sourcelist=$at/sources.list" -o Dir::Etc::sourceparts=/dev/null -o "Dir::State::lists=$at/lists"
    -o "Dir::Cache=$at" -o "Dir::Cache::archives=$at/archives" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache=)
  (cd "$at" && apt-get "${options[@]}" update && apt-get "${options[@]}" download qemu-user/bookworm-backports &&
    dpkg-deb -x qemu-user_*.deb root) >>"$scratch/apt.log" 2>&1
}

# Big-endian. QEMU 7.2 computes the product of two f32 as an f64 wrongly there (MDEB, MDEBR), which spoils the pictures:
# QEMU_S390X names a newer one, else that of Debian's backports is fetched.
part_s390x() {
  local qemu=${QEMU_S390X:-$scratch/qemu/root/usr/bin/qemu-s390x}
  [ -n "${QEMU_S390X:-}" ] || newer_qemu || { skip s390x "needs a QEMU newer than 7.2; QEMU_S390X names it"; return; }
  from_source s390x s390x-unknown-linux-gnu s390x-linux-gnu 'gcc-s390x-linux-gnu libc6-dev-s390x-cross' \
    "$qemu" -L /usr/s390x-linux-gnu
}

# Windows programs by mingw, run by Wine.
part_windows() {
  local triple=x86_64-pc-windows-gnu extra=$scratch/windows-extra packages=(rustc-web rust-web-src gcc-mingw-w64-x86-64 wine64) source object place
  if ! { has_std_source && tools x86_64-w64-mingw32-gcc && [ -x /usr/lib/wine/wine64 ]; }; then
    install "${packages[@]}" || { skip windows "needs ${packages[*]}"; return; }
  fi
  # two objects that -Zbuild-std does not make
  source=$(/usr/bin/rustc --print sysroot)/lib/rustlib/src/rust/library/rtstartup
  mkdir -p "$extra"
  for object in rsbegin rsend; do
    RUSTC_BOOTSTRAP=1 /usr/bin/rustc --target $triple --emit=obj -o "$extra/$object.o" "$source/$object.rs" || return
  done
  build_with_std $triple x86_64-w64-mingw32-gcc "-L native=$extra" || { skip windows "the binaries do not build"; return; }
  export WINEPREFIX=$scratch/wine WINEDEBUG=-all WINEARCH=win64
  [ -d "$WINEPREFIX" ] || timeout 300 /usr/lib/wine/wine64 wineboot -i >/dev/null 2>&1
  # Wine 8 lacks the library from which the standard library takes random bytes
  printf '%s\n' '#include <windows.h>' 'BOOLEAN NTAPI SystemFunction036(PVOID, ULONG);' \
    '__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE at, SIZE_T length) { return SystemFunction036(at, (ULONG)length); }' >"$extra/random.c"
  x86_64-w64-mingw32-gcc -shared -O2 -o "$WINEPREFIX/drive_c/windows/system32/bcryptprimitives.dll" "$extra/random.c" -ladvapi32 || return
  place=$(folder windows)
  export suffix=.exe
  bits_as "Windows by Wine" "$scratch/build/$triple/release" /usr/lib/wine/wine64
  cd "$place" && figures_as "Windows by Wine" "$scratch/build/$triple/release" 2 /usr/lib/wine/wine64
}

for part in "${parts[@]}"; do
  case $part in
    here | environment | nehalem | arm64 | wasm | i686 | riscv64 | s390x | windows) cd "$root" && "part_$part" ;;
    *) echo "$part: must be here, environment, nehalem, arm64, wasm, i686, riscv64, s390x or windows" >&2; exit 2 ;;
  esac
done
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ] || exit 1
[ "$passed" -gt 0 ] || { echo "no part could be tried" >&2; exit 5; }
