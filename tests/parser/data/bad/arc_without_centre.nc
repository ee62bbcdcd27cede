; [arc-centre-missing] 3:1: error: G2 without a centre (hint: give I and J, or R)
G0 X0 Y0
G2 X10 F100
