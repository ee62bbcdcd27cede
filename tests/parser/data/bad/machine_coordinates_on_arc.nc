; [machine-coordinates] 3:1: error: G53 without a straight move (hint: machine coordinates belong to a straight move, for example G53 G0 Z0)
G0 X0 Y0
G53 G2 X0 F1
