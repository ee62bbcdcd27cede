; [function-domain] 2:5: error: ACOS of -2 (hint: its argument is between -1 and 1)
G0 XACOS[-2]
