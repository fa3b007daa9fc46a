# Fig. 17, hypothesis 3: the travel is varied by the upper limiter.
FILE = "fig17"
TITLE = "A shorter travel makes the two strokes more alike"
SUBTITLE = "R1-400, upper limiter moved; Table A1 is the right end"
NAME = "Travel_varied"
XLABEL = "Stem travel range over the nominal 20 mm [%]"
load system("dirname '".ARG0."'")."/varied.gp"
