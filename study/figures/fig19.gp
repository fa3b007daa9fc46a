# Fig. 19, hypothesis 5: the flow coefficient of both orifices is varied.
FILE = "fig19"
TITLE = "The size of the orifices stretches time and leaves the shapes alone"
SUBTITLE = "R1-400, flow coefficient of both orifices varied; dotted: Table A1"
NAME = "Flow_coefficient_varied"
XLABEL = "C/C_0, relative flow coefficient [1]"
NOMINAL = 1
load system("dirname '".ARG0."'")."/varied.gp"
