#!/bin/sh
# The drive frequency from 1 to 120 Hz: where the bead locks, librates and counter-rotates, and how fast.
#
#   examples/sweep-frequency.sh [COUNT]      COUNT points, 240 unless told: about 20 seconds on two cores
#
# The same command again goes on where it was stopped.  Files are left in the current folder.
set -eu
count=${1-240}
festoon=${FESTOON-$(command -v festoon || echo "$(dirname "$0")/../build/festoon")}

"$festoon" sweep --over "drive.frequency=1Hz:120Hz:$count" -o sweep-frequency.db
"$festoon" plot sweep-frequency.db -o sweep-frequency.svg
"$festoon" export sweep-frequency.db --csv -o sweep-frequency.csv
