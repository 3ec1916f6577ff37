#!/bin/sh
# The drive frequency from 1 to 120 Hz: where the bead locks, librates and counter-rotates, and how fast.
# About 20 seconds on two cores.  The same command again goes on where it was stopped.
set -eu
festoon sweep --over drive.frequency=1Hz:120Hz:240 -o sweep-frequency.db
festoon plot sweep-frequency.db -o sweep-frequency.svg
festoon export sweep-frequency.db --csv -o sweep-frequency.csv
