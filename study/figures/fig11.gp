# Fig. 11: static characteristic of the R1-400.
TITLE = "Dry friction opens a loop between the R1-400 going out and coming back"
SUBTITLE = "Static characteristic, the pressure raised and lowered slowly"
NAME = "Static_characteristic_of_the_R1_400"
load system("dirname '".ARG0."'")."/style.gp"
file = table("fig11")

set tmargin at screen 0.80
set key at screen 0.97, screen 0.865 horizontal
set label 1 "Travel x [mm]" @ABOVE
set xlabel "Chamber pressure p [kPa, gauge]"
set xrange [0:400]
set yrange [-0.5:21]
branch(name) = strcol("branch") eq name ? column("x [mm]") : NaN
plot file using "p [kPa]":(branch("rising")) with lines lw 2 lc rgb BLUE title "pressure rising", \
     file using "p [kPa]":(branch("falling")) with lines lw 2 lc rgb VERMILLION title "pressure falling"
