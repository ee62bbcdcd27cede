; [machine-coordinates] 2:1: error: G53 without a straight move (hint: machine coordinates belong to a straight move, for example G53 G0 Z0)
G53 X0
