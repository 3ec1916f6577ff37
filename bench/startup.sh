#!/bin/sh
# How long the program takes to start: `festoon --version`, and `true` for comparison; medians of 41 runs in turn.
set -eu
program=$1
milliseconds() {
    begin=$(date +%s%N)
    "$@" >/dev/null
    echo $((($(date +%s%N) - begin) / 10000))
}
ours= nothing=
for _ in $(seq 41); do
    ours="$ours $(milliseconds "$program" --version)"
    nothing="$nothing $(milliseconds /bin/true)"
done
# shellcheck disable=SC2086 # the lists are meant to be split
median() { printf '%s\n' $1 | sort -n | sed -n 21p | awk '{printf "%.1f", $1 / 100}'; }
echo "start-up: festoon --version $(median "$ours") ms, /bin/true $(median "$nothing") ms (medians of 41)"
