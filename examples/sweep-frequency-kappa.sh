#!/bin/sh
# Frequency against magnetic strength, runs of 200 drive periods: the regimes of motion and the radius as maps.
#
#   examples/sweep-frequency-kappa.sh [COUNT]      COUNT x COUNT points, 256 unless told: several minutes on two
#                                                  cores with AVX-512
#
# The same command again goes on where it was stopped.  Files are left in the current folder.
set -eu
count=${1-256}
festoon=${FESTOON-$(command -v festoon || echo "$(dirname "$0")/../build/festoon")}

"$festoon" sweep --set run.periods=200 --set run.discard=100 --over "drive.frequency=1Hz:40Hz:$count" \
    --over "model.kappa=0.1:3:$count" -o sweep-frequency-kappa.db
"$festoon" plot sweep-frequency-kappa.db -o sweep-frequency-kappa.png
"$festoon" plot sweep-frequency-kappa.db --quantity mean_r --units lab -o sweep-frequency-kappa-radius.png
