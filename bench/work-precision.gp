# Error against time of a trajectory: gnuplot -e "data='FILE.csv'" -e "figure='FILE.svg'" work-precision.gp
# (drawn as docs/figures.md says: 480 pixels wide, title and key outside the frame)
set terminal svg size 480,484 enhanced background 'white' font 'sans-serif,13'
set output figure
set encoding utf8
set datafile separator ','
set border lc rgb '#333333' lw 1
set tics textcolor rgb '#333333' nomirror font ',12'
set logscale xy
set format xy '10^{%T}'
set xtics 100
unset mxtics
set grid lc rgb '#e4e4e4'
set lmargin at screen 66.0/480
set rmargin at screen 462.0/480
set tmargin at screen 1 - 52.0/484
set bmargin at screen 158.0/484
set label 1 'What an error costs' at screen 10.0/480, 1 - 18.0/484 font ',15'
set label 2 'a trajectory of 200 drive periods, one thread' at screen 10.0/480, 1 - 37.0/484 font ',12' tc rgb '#555555'
set xlabel 'greatest error of a final state' offset 0,0.3
set ylabel 'processor time, ms' offset 0.5,0
set xrange [1e-13:1]
set yrange [0.3:20000]
set key at screen 0.5, 104.0/484 center top maxrows 4 Left reverse samplen 2 spacing 1.15 width -2 font ',12'
series = "'SciPy DOP853' 'GSL msadams' 'GSL rk8pd' 'Boost.odeint fehlberg78' 'festoon scalar' 'festoon portable 8 lanes' 'festoon avx2' 'festoon avx512'"
names = "'SciPy DOP853' 'GSL msadams' 'GSL rk8pd' 'Boost.odeint fehlberg78' 'festoon, one at a time' 'festoon, 8 portable lanes' 'festoon, AVX2' 'festoon, AVX-512'"
colours = "#222222 #888888 #cc79a7 #e69f00 #56b4e9 #009e73 #0072b2 #d55e00"
shapes = "4 6 8 10 7 5 9 13"
plot for [i=1:words(series)] data using 3:(strcol(1) eq word(series, i) ? $4 : NaN) with linespoints \
    pt int(word(shapes, i)) ps 0.6 lw 1.5 lc rgb word(colours, i) title word(names, i)
