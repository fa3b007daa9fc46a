# Fig. 16, hypothesis 2: the force of the spring at rest is varied.
FILE = "fig16"
TITLE = "Without initial compression most of the asymmetry stays"
SUBTITLE = "R1-400, spring force at rest varied up to Table A1; below 480 N dry friction keeps the stem from home"
NAME = "Initial_compression_varied"
XLABEL = "Spring force at rest [N]"
load system("dirname '".ARG0."'")."/varied.gp"
