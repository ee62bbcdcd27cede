; [endless-loop] 3:1: error: M99 in the main program would repeat it for ever (hint: end the main program with M30)
G0 X5
M99
