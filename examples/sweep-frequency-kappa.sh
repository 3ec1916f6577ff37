#!/bin/sh
# Frequency against magnetic strength, 256 x 256 points of 200 drive periods: the regimes of motion as a map.
# Several minutes on two cores with AVX-512.
set -eu
festoon sweep --set run.periods=200 --set run.discard=100 --over drive.frequency=1Hz:40Hz:256 \
    --over model.kappa=0.1:3:256 -o sweep-frequency-kappa.db
festoon plot sweep-frequency-kappa.db -o sweep-frequency-kappa.png
festoon plot sweep-frequency-kappa.db --key mean_r -o sweep-frequency-kappa-radius.png
