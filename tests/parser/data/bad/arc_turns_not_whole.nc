; [not-whole] 3:13: error: P1.5 is not a whole number (hint: give P without decimals)
G0 X0 Y0
G2 X0 Y0 I5 P1.5 F100
