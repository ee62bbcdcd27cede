; [program-end-missing] 4:1: error: the program runs into O2000 (hint: end the main program with M30)
O1000
G0 X5
O2000
M99
