# Style that the figures share. A script sets TITLE, SUBTITLE and, where it needs more than the default, HEIGHT,
# then loads this file from its own folder. IN is the folder of tables, OUT the SVG to write; without it, standard output.
if (!exists("HEIGHT")) HEIGHT = 560
if (!exists("NAME")) NAME = "libpneu"
WIDTH = 820

set encoding utf8
set terminal svg enhanced size WIDTH,HEIGHT font "sans-serif,14" background "#ffffff" name NAME
if (exists("OUT")) set output OUT

# Tables: named columns. A filter gives NaN for the rows of another curve, which are skipped, so that rows of
# several curves may alternate; a line runs on past an empty field, its marker is left out.
set datafile separator comma
set datafile columnheaders
set datafile missing NaN
table(name) = IN."/".name.".csv"
is_there(file) = int(system("test -r '".file."' && echo 1 || echo 0"))

# Okabe and Ito, https://jfly.uni-koeln.de/color: told apart by colour-blind readers
BLUE = "#0072B2"; VERMILLION = "#D55E00"; GREEN = "#009E73"; PURPLE = "#CC79A7"; ORANGE = "#E69F00"; SKY = "#56B4E9"
INK = "#222222"; GREY = "#767676"; RULE = "#E2E2E2"; BAND = "#F1EEDD"

# The four laws: colour is the gas law, dash the flow law
GASES = "isothermal polytropic"
FLOWS = "paper choked"
gas_of(law) = word(GASES, (law + 1) / 2)
flow_of(law) = word(FLOWS, (law - 1) % 2 + 1)
is_law(law) = strcol("gas") eq gas_of(law) && strcol("flow") eq flow_of(law)
flow_name(flow) = flow eq "paper" ? "flow as in the paper" : "choked nozzle"
law_name(law) = gas_of(law).", ".flow_name(flow_of(law))
set style line 1 lc rgb BLUE lw 2 dt solid
set style line 2 lc rgb BLUE lw 2 dt (7,4)
set style line 3 lc rgb VERMILLION lw 2 dt solid
set style line 4 lc rgb VERMILLION lw 2 dt (7,4)

set tics nomirror out scale 0.6 textcolor rgb INK
set style fill solid noborder
set xlabel textcolor rgb INK
set ylabel textcolor rgb INK
set title textcolor rgb INK font ",15"
set key Left reverse textcolor rgb INK samplen 2.5
set bars small

# A plot without a frame carries heading and key over the panels of a multiplot
BLANK = 'unset border; unset xtics; unset ytics; unset grid'
FRAME = 'set border 3 back lc rgb GREY; set tics nomirror out scale 0.6 textcolor rgb INK; set xtics nomirror; set ytics nomirror; set grid back lc rgb RULE lt 1 lw 1'
@FRAME

# The name of the y axis lies flat above it: set label 1 "..." @ABOVE
ABOVE = 'at graph 0, graph 1 left offset 0,0.8 textcolor rgb INK'

# The key in two columns below the heading
KEY = 'set key at screen 0.06, screen 1 - 75.0/HEIGHT left top horizontal maxcols 2 width -8'

# Heading, over the first plot; the others of a multiplot `@NEXT` first
NEXT = 'unset label; unset key'
set label 101 TITLE at screen 0.02, screen 1 left offset 0,-1.25 font ",18" textcolor rgb INK
set label 102 SUBTITLE at screen 0.02, screen 1 left offset 0,-2.75 textcolor rgb GREY
