; [position-unknown] 2:1: error: the start of the arc is not known: X has not been programmed yet (hint: move to the start with G0 or G1 in G90 first)
G2 X10 Y0 I5 F100
