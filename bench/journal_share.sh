#!/bin/sh
# How much of a sweep's processor time goes to its database: the thread that writes the rows does nothing else.
set -eu
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for periods in 20 200; do
    "$program" sweep --set run.periods="$periods" --set run.discard=$((periods / 2)) --over drive.omega=0.36:1.20:2048 \
        -o "$folder/$periods.db" --json |
        awk -v periods="$periods" '{ gsub(",", "") } { of[$1] = $2 } END {
            printf "database of a sweep: %.2f %% of the processor time (2048 runs of %d periods, %.1f s)\n",
                100 * of["\"journal_seconds\":"] / of["\"processor_seconds\":"], periods, of["\"processor_seconds\":"] }'
done
