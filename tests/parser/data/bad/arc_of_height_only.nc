; [arc-centre-missing] 3:1: error: G2 without a centre (hint: give I and J, or R)
G0 X0 Y0 Z0
G2 Z5 F100
