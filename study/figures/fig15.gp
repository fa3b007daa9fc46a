# Fig. 15, hypothesis 1: the rate of the spring is varied, its force at rest kept.
FILE = "fig15"
TITLE = "The softer the spring, the more alike the two strokes"
SUBTITLE = "R1-400, spring rate varied alike for both strokes, spring force at rest kept; dotted: Table A1"
NAME = "Spring_rate_varied"
XLABEL = "Spring rate k [kN/m]"
NOMINAL = 400
load system("dirname '".ARG0."'")."/varied.gp"
