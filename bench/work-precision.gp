# Error against time of a trajectory: gnuplot -e "data='work-precision.csv'; figure='work-precision.svg'" work-precision.gp
set terminal svg size 860,520 enhanced background 'white' font 'sans-serif,14'
set output figure
set datafile separator ','
set logscale xy
set format xy '10^{%T}'
set grid lc rgb '#e4e4e4'
set xlabel 'greatest error of a final state after 200 drive periods'
set ylabel 'ms a trajectory, one thread'
set xrange [1e-13:1]
set yrange [0.3:20000]
set key outside right center Left reverse samplen 2 spacing 1.2
series = "'GSL msadams' 'SciPy DOP853' 'Boost.odeint fehlberg78' 'GSL rk8pd' 'festoon scalar' 'festoon portable 8 lanes' 'festoon avx2' 'festoon avx512'"
colours = "#888888 #222222 #e69f00 #cc79a7 #56b4e9 #009e73 #0072b2 #d55e00"
plot for [i=1:words(series)] data using 3:(strcol(1) eq word(series, i) ? $4 : NaN) with linespoints pt 7 ps 0.5 lw 1.5 \
    lc rgb word(colours, i) title word(series, i)
