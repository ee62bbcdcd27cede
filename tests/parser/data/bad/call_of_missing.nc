; [missing-subprogram] 3:5: error: subprogram O3000 does not exist (hint: the file holds O1000 O2000)
O1000
M98 P3000
M30
O2000
M99
