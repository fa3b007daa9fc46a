# Fig. 16, hypothesis 2: the force of the spring at rest is varied.
FILE = "fig16"
TITLE = "Without initial compression most of the asymmetry stays"
SUBTITLE = "R1-400, initial compression force varied up to Table A1; below 480 N dry friction holds the stem off its stop"
NAME = "Initial_compression_varied"
XLABEL = "F_0, initial compression force of the spring [N]"
load system("dirname '".ARG0."'")."/varied.gp"
