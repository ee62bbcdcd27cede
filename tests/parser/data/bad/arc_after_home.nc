; [position-unknown] 4:1: error: the start of the arc is not known: X is not known since G28 on line 3 (hint: move to the start with G0 or G1 in G90 first)
G0 X0 Y0
G28 X0
G2 X10 Y0 I5 F100
