; [arc-radius-zero] 3:8: error: R is zero (hint: give the radius, or the centre by I and J)
G0 X0 Y0
G2 X10 R0 F100
