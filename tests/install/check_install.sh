#!/bin/bash
# What somebody has who installs Espalier and deletes the checkout: a prefix, moved once, whose library builds
# the five examples, whose headers need no others, and whose program finds its data there and nowhere else.
#   check_install.sh BUILD   a build folder in which the program is built
# CXXFLAGS are those of the examples. HEADERS=each compiles each header alone.
set -euo pipefail

build=$(readlink -f "$1")
source_dir=$(readlink -f "$(dirname "$(readlink -f "$0")")/../..")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix=$scratch/moved
share=$prefix/share/espalier
unset ESPALIER_DATA_DIR

fail() {
  echo "check_install: $1" >&2
  exit 1
}

# quietly COMMAND…: its output only where it fails.
quietly() { "$@" >"$scratch/log" 2>&1 || { cat "$scratch/log" >&2; fail "failed: $*"; }; }

# expect FILE PATTERN: the file has a line that matches.
expect() { grep -qE -- "$2" "$1" || { head -c 2000 "$1" >&2; fail "got the above in $1, expected $2"; }; }

# expect_picture FILE…: PNGs.
expect_pictures() {
  local file
  for file in "$@"; do
    [[ $(head -c 4 "$file" | tail -c 3) == PNG ]] || fail "$file: got no picture"
  done
}

install_and_move() {
  quietly cmake --install "$build" --prefix "$scratch/installed"
  mv "$scratch/installed" "$prefix"
  if grep -rlF "$source_dir" "$prefix/lib/cmake" "$prefix/include"; then fail "the files above name the checkout"; fi
}

# build_with_package FOLDER OPTIONS…: a project that finds the installed package.
build_with_package() {
  quietly cmake -S "$source_dir/$1" -B "$scratch/build-$(basename "$1")" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" "${@:2}"
  quietly cmake --build "$scratch/build-$(basename "$1")" --parallel 2
}

run_examples() {
  local bin=$scratch/build-examples fir=$share/targets/fir.png
  "$bin/grow" quaking_aspen aspen.glb >grow.txt
  expect grow.txt '^[0-9]+ stems, [0-9]{4,} leaves, [0-9.]+ m high$'
  [[ $(head -c 4 aspen.glb) == glTF ]] || fail "grow: got no glb file"

  "$bin/mask" quaking_aspen front.png side.png >mask.txt
  expect mask.txt '^[0-9]{4,} pixels in front, [0-9]{4,} from the side, IoU 0\.[2-9]'
  expect_pictures front.png side.png

  "$bin/fit" "$fir" fitted 40 >fit.txt 2>/dev/null
  expect fit.txt '^fitness 0\.[4-9][0-9]*, IoU 0\.[0-9]+, 40 evaluations, from [a-z_]+$'
  "$prefix/bin/espalier" species --check fitted/best.toml >/dev/null || fail "fit: best.toml is no preset"

  "$bin/own_optimizer" "$fir" climbed 60 >climbed.txt
  expect climbed.txt '^fitness 0\.[4-9][0-9]*, 60 evaluations, stopped by evaluations$'
  expect climbed/run.toml '^optimizer = "climber"$'

  "$bin/own_model" "$fir" whorled 200 >whorled.txt
  expect whorled.txt '^fitness 0\.[5-9][0-9]*, height [0-9.]+, reach '
  expect whorled/best.toml '^model = "whorled_fir"$'
}

# hidden COMMAND…: runs it where an empty folder lies over the checkout and the build, as if both were deleted;
# where the system forbids that, it just runs it.
hidden() {
  local unshare=(unshare --mount)
  ((EUID == 0)) || unshare+=(--map-root-user)
  if ! "${unshare[@]}" mount --bind "$scratch/empty" "$source_dir" 2>/dev/null; then
    "$@"
    return
  fi
  "${unshare[@]}" bash -c 'mount --bind "$1" "$2" && mount --bind "$1" "$3" && exec "${@:4}"' \
    bash "$scratch/empty" "$build" "$source_dir" "$@"
}

run_program() {
  local espalier=(hidden "$prefix/bin/espalier")
  quietly "${espalier[@]}" fit --evaluations 20 --branch-rounds 0 --size 32 --out bundled
  expect bundled/run.toml "^picture = \"$share/targets/"
  quietly "${espalier[@]}" mask quaking_aspen -o mask.png
  quietly "${espalier[@]}" render palm --size 64 --samples 1 -o render.png
  quietly "${espalier[@]}" lsystem topiary_dinosaur --steps 3 -o dinosaur.png
  quietly "${espalier[@]}" lsystem obstacle --steps 3 -o obstacle.png
  expect_pictures mask.png render.png dinosaur.png obstacle.png
  quietly "${espalier[@]}" experiment run "$share/experiments/quick.toml" --set evaluations=20 'seeds=[1]' 'targets=["fir"]' \
    --out quick
  quietly "${espalier[@]}" experiment report quick
  expect quick/report/index.html '<html'
}

# Even where the checkout cannot be hidden, that nothing is read from it shows when what is installed is damaged.
damage_data() {
  echo damaged >"$share/lsystem/models/obstacle.obj"
  "$prefix/bin/espalier" lsystem obstacle -o none.png 2>damaged.txt && fail "a mesh was read from elsewhere"
  expect damaged.txt "mesh '$share/lsystem/models/obstacle.obj': not readable"
  echo 'raise SystemExit(3)' >"$share/experiments/report/report.py"
  "$prefix/bin/espalier" experiment report quick 2>damaged.txt && fail "report.py was run from elsewhere"
  expect damaged.txt "$share/experiments/report/report.py ended with exit code 3"
}

cd "$scratch"
mkdir empty
install_and_move
build_with_package examples
build_with_package tests/install/headers -DEACH="$([[ ${HEADERS-} == each ]] && echo ON || echo OFF)"
run_examples
run_program
damage_data
echo "check_install: five examples, all headers and the program of $(du -sh "$prefix" | cut -f1) installed"
