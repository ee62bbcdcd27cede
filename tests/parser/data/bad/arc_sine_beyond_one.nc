; [function-domain] 2:5: error: ASIN of 1.5 (hint: its argument is between -1 and 1)
G0 XASIN[1.5]
