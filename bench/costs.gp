# What a run costs against its tolerance, and a drive period against their number:
#   gnuplot -e "data='performance.tsv'" -e "figure='FILE.svg'" costs.gp
# (drawn as docs/figures.md says: 480 pixels wide, title and key outside the frames)
set terminal svg size 480,640 enhanced background 'white' font 'sans-serif,13'
set output figure
set encoding utf8
set datafile separator tab
set border lc rgb '#333333' lw 1
set tics textcolor rgb '#333333' nomirror font ',12'
set grid lc rgb '#e4e4e4'
set logscale xy
set lmargin at screen 66.0/480
set rmargin at screen 462.0/480
rows = "'scalar, full rows' 'scalar, final states' 'portable, 8 lanes, full rows' 'portable, 8 lanes, final states' 'avx2, full rows' 'avx2, final states' 'avx512, full rows' 'avx512, final states'"
names = "'one at a time, rows' 'final states' '8 portable lanes, rows' 'final states' 'AVX2, rows' 'final states' 'AVX-512, rows' 'final states'"
colours = "#56b4e9 #56b4e9 #009e73 #009e73 #0072b2 #0072b2 #d55e00 #d55e00"
shapes = "7 6 5 4 9 8 13 12"
dashes = '1 2 1 2 1 2 1 2'
cell(table, row) = strcol(1) eq table && strcol(2) eq row ? column(4) : NaN
set multiplot
set tmargin at screen 1 - 52.0/640
set bmargin at screen 398.0/640
set label 1 'What tolerance and length cost' at screen 10.0/480, 1 - 18.0/640 font ',15'
set label 2 'a run of 200 drive periods' at screen 10.0/480, 1 - 37.0/640 font ',12' tc rgb '#555555'
set format x '10^{%T}'
set format y '%g'
set xlabel 'tolerance' offset 0,0.3
set ylabel 'processor time, ms' offset 0.5,0
set xrange [3e-14:3e-4]
set yrange [0.3:80]
unset mxtics
unset key
plot for [i=1:words(rows)] data using 3:(cell('cost against tolerance', word(rows, i))) with linespoints \
    pt int(word(shapes, i)) ps 0.6 lw 1.5 dt int(word(dashes, i)) lc rgb word(colours, i)
set tmargin at screen 306.0/640
set bmargin at screen 158.0/640
unset label 1
set label 2 'a drive period, at a tolerance of 10^{-9}' at screen 10.0/480, 322.0/640
set format x '%g'
set xtics (20, 50, 200, 800, 3200)
set xlabel 'drive periods of a run'
set ylabel 'processor time, µs'
set xrange [15:4300]
set yrange [4:150]
set key at screen 0.5, 104.0/640 center top maxrows 4 Left reverse samplen 2 spacing 1.15 font ',12'
plot for [i=1:words(rows)] data using 3:(cell('cost against periods', word(rows, i))) with linespoints \
    pt int(word(shapes, i)) ps 0.6 lw 1.5 dt int(word(dashes, i)) lc rgb word(colours, i) title word(names, i)
unset multiplot
