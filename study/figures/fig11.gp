# Fig. 11: static characteristic of the R1-400.
TITLE = "Dry friction opens a loop between the R1-400 going out and coming back"
SUBTITLE = "Static characteristic, the pressure raised and lowered slowly"
NAME = "Static_characteristic_of_the_R1_400"
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig11")

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
set xlabel "Chamber pressure p [kPa, gauge]"
set xrange [0:400]
set yrange [-0.5:21]
colour(branch) = branch eq "rising" ? BLUE : VERMILLION
plot for [branch in "rising falling"] file using "p [kPa]":(strcol("branch") eq branch ? column("x [mm]") : NaN) with lines lw 2 lc rgb colour(branch) title "pressure ".branch, \
     for [branch in "rising falling"] file using (advance(column("p [kPa]"), column("x [mm]")), strcol("branch") eq branch && has_head(column(0)) ? column("p [kPa]") : NaN):"x [mm]":(dp):(dx) with vectors head filled size screen 0.018,18 fixed lw 2 lc rgb colour(branch) notitle
