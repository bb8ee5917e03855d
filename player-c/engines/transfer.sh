#!/usr/bin/env bash
# Trains champions, plays them in Box2D and Chipmunk, and writes how many are usable there as a Markdown table.
# usage: transfer.sh OUT.md [GAMBOL] [TRAINING-OPTION]...
# CREATURES, MOVEMENTS and SEEDS in the environment name others than the seven, running and jumping, 1001 to 1003.
# Needs cargo, g++, Box2D 2.4 and Chipmunk 7 (Debian: libbox2d-dev, libchipmunk-dev). See docs/transfer.md.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
if [ $# -lt 1 ]; then
    sed -n 3p "$0" >&2
    exit 1
fi
out=$1
gambol=$(realpath "${2:-$here/../../target/release/gambol}")
shift $(($# < 2 ? $# : 2))
# Steps, not seconds: the same champions on every machine. About 10 s of one core.
if [ $# -gt 0 ]; then training=("$@"); else training=(--until usable --steps 10000000); fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
creatures=${CREATURES:-apod biped-1 biped-2 tetrapod-1 tetrapod-2 decapod-1 decapod-2}
movements=${MOVEMENTS:-running jumping}
seeds=${SEEDS:-1001 1002 1003}
# An engine, the frames a second, and the settings of its judge.
plays="box2d 50 substeps=8 velocities=10 positions=4
box2d 60 substeps=8 velocities=10 positions=4
box2d 120 substeps=4 velocities=10 positions=4
chipmunk 50 substeps=8 iterations=20
chipmunk 60 substeps=8 iterations=20
chipmunk 120 substeps=4 iterations=20"

(cd "$here/.." && RUSTFLAGS="--cfg gambol_freestanding" cargo build --quiet --package gambol-player-c --profile player \
    --locked --target-dir "$folder/target")
library=$folder/target/player/libgambol_player.a
flags=(-Wall -Wextra -Werror -O2 -I "$here/../include")
g++ "${flags[@]}" "$here/judge_box2d.cpp" "$library" -lbox2d -o "$folder/box2d"
gcc -std=c11 "${flags[@]}" "$here/judge_chipmunk.c" "$library" -lchipmunk -lm -o "$folder/chipmunk"

# One champion: a file for each play, and for Gambol itself, with 0 (usable) or 3 (not usable).
judge() {
    local gambol=$1 folder=$2 creature=$3 movement=$4 seed=$5 plays=$6 seconds=60 engine rate settings code
    shift 6
    local name=$creature-$movement-$seed
    [ "$movement" = jumping ] && seconds=5
    verdict() {
        code=0
        "$gambol" gait "$@" >"$folder/$name.text" 2>&1 || code=$?
        [ $code = 0 ] || [ $code = 3 ] || { cat "$folder/$name.text" >&2; exit 255; }
    }
    code=0
    "$gambol" train "$creature" "$movement" --seed "$seed" "$@" --threads 1 --quiet --no-report \
        --out "$folder/$name" >"$folder/$name.text" 2>&1 || code=$?
    [ $code = 0 ] || [ $code = 3 ] || { cat "$folder/$name.text" >&2; exit 255; }
    "$gambol" export "$folder/$name" --to player --out "$folder/$name.player" >"$folder/$name.text"
    verdict "$folder/$name"
    echo $code >"$folder/$name.gambol-0"
    local commands=()
    if [ "$movement" = playing ]; then
        # What `gambol gait` tells it: a line for each change.
        "$gambol" replay "$folder/$name" --trajectory "$folder/$name.csv" >"$folder/$name.text"
        awk -F, 'NR > 1 && $1 != step { step = $1; now = $12 " " $13; if (now != told) print $2, now; told = now }' \
            "$folder/$name.csv" >"$folder/$name.commands"
        commands=("commands=$folder/$name.commands")
    fi
    while read -r engine rate settings; do
        # shellcheck disable=SC2086
        "$folder/$engine" "$folder/$name.player" "$folder/$name.csv" seconds=$seconds rate="$rate" $settings \
            "${commands[@]}" >"$folder/$name.text" 2>&1 || { cat "$folder/$name.text" >&2; exit 255; }
        verdict "$folder/$name.csv" --creature "$creature" --movement "$movement"
        echo $code >"$folder/$name.$engine-$rate"
    done <<<"$plays"
    rm -rf "${folder:?}/$name" "$folder/$name.csv" "$folder/$name.text"
}
export -f judge
for seed in $seeds; do
    for creature in $creatures; do
        for movement in $movements; do printf '%s\n' "$creature $movement $seed"; done
    done
done | gambol=$gambol folder=$folder plays=$plays xargs -P 2 -I{} bash -c \
    'set -euo pipefail; set -- {} "$@"; judge "$gambol" "$folder" $1 $2 $3 "$plays" "${@:4}"' _ "${training[@]}"

# How many of these champions are usable in a play, of those that are so in Gambol.
cell() {
    local play=$1 usable=0 total=0 file creature movement seed
    for creature in $2; do
        for movement in $3; do
            for seed in $seeds; do
                file=$folder/$creature-$movement-$seed
                [ "$play" = gambol-0 ] || [ "$(cat "$file.gambol-0")" = 0 ] || continue
                total=$((total + 1))
                [ "$(cat "$file.$play")" != 0 ] || usable=$((usable + 1))
            done
        done
    done
    printf ' %s/%s |' $usable $total
}
row() {
    local engine rate settings
    printf '| %s |' "$1"
    cell gambol-0 "$2" "$3"
    while read -r engine rate settings; do cell "$engine-$rate" "$2" "$3"; done <<<"$plays"
    echo
}
{
    printf '| creature, movement | Gambol |'
    while read -r engine rate settings; do printf ' %s, %s Hz |' "$engine" "$rate"; done <<<"$plays"
    printf '\n|---|---|'
    while read -r engine rate settings; do printf -- '---|'; done <<<"$plays"
    echo
    for creature in $creatures; do
        for movement in $movements; do row "$creature $movement" "$creature" "$movement"; done
    done
    for movement in $movements; do row "all, $movement" "$creatures" "$movement"; done
    row all "$creatures" "$movements"
} >"$out"
