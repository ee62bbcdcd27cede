; [not-whole] 2:5: error: P1.5 is not a whole number (hint: give P without decimals)
M98 P1.5
