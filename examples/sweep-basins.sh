#!/bin/sh
# Basins of attraction at 8.8 Hz, close to where corotation is lost: which start (r, Phi) leads to which motion.
set -eu
festoon sweep --set drive.frequency=8.8Hz --set start.spin=rest --over start.r=0.3:1.5:96 --over start.phi=0:180:96 \
    -o sweep-basins.db
festoon plot sweep-basins.db -o sweep-basins.png
