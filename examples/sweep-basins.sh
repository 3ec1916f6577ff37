#!/bin/sh
# Basins of attraction at 10.7 Hz: a bead left at rest at (r, Phi) ends on one of two counter-rotating orbits, which
# are each other's image under half a turn of the magnet (S2).  The sign of <n_z> tells them apart; starts that lie
# half a turn from each other end on different ones.
#
#   examples/sweep-basins.sh [COUNT]      COUNT x COUNT points, 96 unless told: about two minutes on two cores
#
# The same command again goes on where it was stopped.  Files are left in the current folder.
set -eu
count=${1-96}
festoon=${FESTOON-$(command -v festoon || echo "$(dirname "$0")/../build/festoon")}

"$festoon" sweep --set drive.frequency=10.7Hz --set run.periods=200 --set run.discard=100 --set start.spin=rest \
    --over "start.r=0.1:3:$count" --over "start.phi=0:360:$count" -o sweep-basins.db
"$festoon" plot sweep-basins.db --quantity mean_nz --units lab -o sweep-basins.png
