; [missing-return] 5:5: error: there is no N10 to go back to (hint: P of M99 names a block of the program that called this one)
M98 P2000
M30
O2000
M99 P10
