; [program-twice] 6:1: error: program O1 is already on line 2 (hint: give each program of the file its own number)
O1
M30
O2
M99
O1
M99
