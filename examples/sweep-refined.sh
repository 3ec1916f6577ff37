#!/bin/sh
# The map of sweep-frequency-kappa.sh in fine steps, of which only the neighbourhood of the boundaries is computed.
#
#   examples/sweep-refined.sh [COUNT [N]]      COUNT x COUNT points, first every 2^N-th of them; 1024 and 5 unless told:
#                                              some minutes on two cores with AVX-512
#
# The same command again goes on where it was stopped; with a smaller N it looks for smaller islands, and keeps all rows.
# Files are left in the current folder.
set -eu
count=${1-1024}
levels=${2-5}
festoon=${FESTOON-$(command -v festoon || echo "$(dirname "$0")/../build/festoon")}

"$festoon" sweep --set run.periods=100 --set run.discard=50 --set run.until=settled \
    --over "drive.frequency=1Hz:40Hz:$count" --over "model.kappa=0.1:3:$count" --refine "$levels" -o sweep-refined.db
"$festoon" plot sweep-refined.db -o sweep-refined.png
