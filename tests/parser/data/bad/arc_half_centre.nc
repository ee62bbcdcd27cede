; [arc-centre-missing] 3:8: error: G2 has half a centre (hint: after G90.1 give both I and J)
G90.1 G0 X0 Y0
G2 X10 I5 F100
