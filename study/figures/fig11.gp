# Fig. 11: static characteristic of the R1-400, with its bench sets.
TITLE = "The spring of Table A1 gives a bench set of 100 to 300 kPa, not of 80 to 240 kPa"
SUBTITLE = "Static characteristic of the R1-400, pressure raised and lowered slowly; dry friction opens the loop"
NAME = "Static_characteristic_of_the_R1_400"
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig11")

# Bench sets [kPa]: of six springs, Table 1, and what Table A1 prints: k x_0/A to k (x_0 + travel)/A
TRAVEL = 20 # [mm]
kPa(travel) = 400e3*travel*1e-3/400e-4*1e-3
array NAMED[2] = ["bench set of six springs, Table 1", "bench set of the spring of Table A1"]
array LOW[2] = [80, kPa(10)]
array HIGH[2] = [240, kPa(10 + TRAVEL)]
array HEIGHT_OF[2] = [25.2, 22.2]

# an arrow head on every 25th row at which the stem moves, along the step from the row before
x_before = p_before = NaN
dp = dx = 0
advance(p, x) = (dp = p - p_before, dx = x - x_before, p_before = p, x_before = x)
has_head(row) = int(row) % 25 == 12 && abs(dx) > 0

set lmargin at screen 0.08
set rmargin at screen 0.97
set tmargin at screen 0.80
set key at screen 0.97, screen 0.86 horizontal
set label 1 "Travel x [mm]" @ABOVE
do for [set = 1:2] {
  set arrow 10 + set from LOW[set], HEIGHT_OF[set] to HIGH[set], HEIGHT_OF[set] heads size screen 0.008,90 lw 2 lc rgb INK
  set arrow 20 + set from LOW[set], 0 to LOW[set], TRAVEL + 1 nohead back lw 1 dt (2,4) lc rgb GREY
  set arrow 30 + set from HIGH[set], 0 to HIGH[set], TRAVEL + 1 nohead back lw 1 dt (2,4) lc rgb GREY
  set label 10 + set sprintf("%s: %g to %g kPa", NAMED[set], LOW[set], HIGH[set]) at LOW[set], HEIGHT_OF[set] left offset 0,0.8 textcolor rgb INK
}
set xlabel "Chamber pressure p [kPa, gauge]"
set xrange [0:400]
set yrange [-0.5:28]
set ytics 0,5,TRAVEL
colour(branch) = branch eq "rising" ? BLUE : VERMILLION
plot for [branch in "rising falling"] file using "p [kPa]":(strcol("branch") eq branch ? column("x [mm]") : NaN) with lines lw 2 lc rgb colour(branch) title "pressure ".branch, \
     for [branch in "rising falling"] file using (advance(column("p [kPa]"), column("x [mm]")), strcol("branch") eq branch && has_head(column(0)) ? column("p [kPa]") : NaN):"x [mm]":(dp):(dx) with vectors head filled size screen 0.018,18 fixed lw 2 lc rgb colour(branch) notitle
