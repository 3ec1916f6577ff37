#!/bin/sh
# What sweeps cost: a map of regimes; the share of the database in the processor time; what two threads lose to each
# other; memory.
#
#   sweeps.sh FESTOON PEAK_MEMORY
set -eu
program=$1
peak_memory=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

put() { # row, value with its unit
    echo "$1: $2"
    if [ -n "${PERFORMANCE_TSV:-}" ]; then
        printf 'sweeps\t%s\tmeasured\t%s\n' "$1" "$2" >>"$PERFORMANCE_TSV"
    fi
}

sweep() { # name, points, periods, options ...
    name=$1 points=$2 periods=$3
    shift 3
    rm -f "$folder/$name.db"*
    "$program" sweep --set run.periods="$periods" --set run.discard=$((periods / 2)) \
        --over drive.omega=0.36:1.20:"$points" "$@" -o "$folder/$name.db" --json >"$folder/$name.json"
}

number() { # name, key
    awk -v key="\"$2\":" '{ gsub(",", "") } $1 == key { print $2 }' "$folder/$1.json"
}

for until in periods settled; do
    "$program" sweep --set run.periods=200 --set run.discard=100 --set run.until=$until --over drive.frequency=1Hz:40Hz:64 \
        --over model.kappa=0.1:3:64 -o "$folder/map-$until.db" --json >"$folder/map-$until.json"
    put "processor time of 64 x 64 points, 1 to 40 Hz, kappa 0.1 to 3, run.until $until" \
        "$(printf %.1f "$(number "map-$until" processor_seconds)") s"
done

for periods in 20 200; do
    sweep share 2048 $periods
    put "share of the database in the processor time, 2048 runs of $periods periods" \
        "$(awk -v a="$(number share journal_seconds)" -v b="$(number share processor_seconds)" \
            'BEGIN { printf "%.2f %%", 100 * a / b }')"
done

for round in 1 2 3 4 5; do
    for threads in 1 2; do
        sweep "$threads-$round" 512 200 --threads $threads
    done
    awk -v a="$(number "2-$round" processor_seconds)" -v b="$(number "1-$round" processor_seconds)" \
        'BEGIN { printf "%.3f\n", a / b }'
done | sort -n | sed -n 3p >"$folder/threads"
put "processor time of a sweep on two threads over that on one" "$(cat "$folder/threads")"

# Runs of a hundredth of a period, because the number of points is what counts.
for points in 1000 1000000; do
    "$peak_memory" "$folder/mebibytes" "$program" sweep --set run.periods=0.01 --set run.discard=0.001 --threads 2 \
        --over drive.frequency=5Hz:20Hz:$points -o "$folder/memory.db" --json >/dev/null 2>&1
    put "greatest memory of a sweep of $points points" "$(cat "$folder/mebibytes") MiB"
    rm -f "$folder/memory.db"*
done
